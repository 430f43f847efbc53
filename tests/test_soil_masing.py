"""Masing's rules: tables, an Iwan model, energy, and what a memory keeps to itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memories import LAWS, Iwan, paths, reaction, rows, walk
from podeep.soil.backbone import Polyline
from podeep.soil.degrading import Degrading
from podeep.soil.energy import energy, held
from podeep.soil.masing import Masing

ELASTIC_PLASTIC = Polyline.through(((0, 0), (1, 1)), 50e3, 0.005)
SMOOTH = [name for name in LAWS if name in ("soft clay", "soft clay, cube root", "sand")]


class Hyperbola:
    def evaluate(self, u):
        flexible = 1e-7 + np.abs(u) / 50e3
        return u / flexible, 1e-7 / flexible**2


class Tanh:
    def __init__(self, stiffness, peak):
        self.stiffness, self.peak = stiffness, peak

    def evaluate(self, u):
        t = np.tanh(u * self.stiffness / self.peak)
        return self.peak * t, self.stiffness * (1.0 - t * t)


# --- tables -----------------------------------------------------------------------------------


@pytest.mark.parametrize("steps", [1, 7])
@pytest.mark.parametrize(
    ("column", "backbone"),
    [("F_hyperbola_N", Hyperbola()), ("F_tanh_N", Tanh(1e7, 50e3))],
)
def test_cf23_masing_on_hyperbola_and_tanh(column, backbone, steps):
    table = rows("valid/CF23_masing.csv")
    forces, _ = walk(Masing(backbone, 1), [[row["u_m"]] for row in table], steps)
    np.testing.assert_allclose(forces[:, 0], [row[column] for row in table], rtol=1e-8)


def test_cf23_elastic_plastic_force_and_work():
    table, memory = rows("valid/CF23_epp.csv"), Masing(ELASTIC_PLASTIC, 1)
    for row in table:
        memory.commit(np.array([row["u_m"]]))
        stored = memory.force**2 / 2e7
        np.testing.assert_allclose(memory.force, row["F_N"], rtol=1e-8, atol=1e-6)
        np.testing.assert_allclose(memory.dissipated + stored, row["work_J"], rtol=1e-8)


def test_cf23_energy_of_closed_cycles():
    for row in rows("valid/CF23_cycle_energy.csv"):
        memory, top = Masing(ELASTIC_PLASTIC, 1), np.array([row["u_max_m"]])
        memory.commit(top)
        start = memory.dissipated
        for u in (-top, top):
            memory.commit(u)
        np.testing.assert_allclose(memory.dissipated - start, row["energy_per_cycle_J"], rtol=1e-12)


def test_table_27_masing_on_tanh():
    table = rows("soil/27_*.csv")
    pu, y50 = table[0]["pu"], table[0]["y50"]
    backbone = Tanh(np.arctanh(0.5) * pu / y50, pu)
    forces, _ = walk(Masing(backbone, 1), [[row["y"]] for row in table])
    np.testing.assert_allclose(forces[:, 0], [row["p_ref"] for row in table], atol=1e-7 * pu)
    other = [row["p_opensees_multilinear"] for row in table]
    np.testing.assert_allclose(forces[:-1, 0], other[:-1], atol=0.002 * pu)


# --- an Iwan model ----------------------------------------------------------------------------


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.floats(0.1, 5.0), min_size=1, max_size=5),
    st.lists(st.floats(0.05, 1.0), min_size=5, max_size=5),
    paths(2, 3.0, 40),
)
def test_masing_is_elastic_plastic_elements_side_by_side(stiffness, steps, path):
    yields = np.cumsum(steps)[: len(stiffness)]
    models = [Iwan(stiffness, yields) for _ in range(2)]
    memory = Masing(Polyline.through(models[0].points, 1.0, 1.0), 2)
    for u in path:
        expected = memory.evaluate(u)[0]
        memory.commit(u)
        for model, value in zip(models, u, strict=True):
            model.commit(value)
        np.testing.assert_allclose(memory.force, [m.force for m in models], atol=1e-11)
        np.testing.assert_allclose(memory.dissipated, [m.dissipated for m in models], atol=1e-9)
        np.testing.assert_array_equal(expected, memory.force)


def test_a_thousand_equal_cycles_leave_no_trace():
    memory, top = Masing(ELASTIC_PLASTIC, 2), np.array([0.01, 0.02])
    for _ in range(1000):
        memory.commit(top)
        memory.commit(-top)
    assert memory.turns.shape == (8, 2)
    first = 50e3 * (0.02 - 0.005)
    np.testing.assert_allclose(memory.dissipated[1], first + 999.5 * 3000.0, rtol=1e-12)


def test_shrinking_cycles_are_all_remembered():
    memory = Masing(Tanh(1e7, 50e3), 1)
    sizes = 0.02 * 0.95 ** np.arange(60)
    tops = [np.array([size * (-1) ** i]) for i, size in enumerate(sizes)]
    forces, _ = walk(memory, tops)
    assert memory.last[0] > 50
    for top, force in zip(reversed(tops[:-1]), reversed(forces[:-1]), strict=True):
        np.testing.assert_allclose(memory.evaluate(top)[0], force, rtol=1e-9)


# --- energy -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LAWS)
def test_the_energy_of_a_law_is_its_area(name):
    law = LAWS[name]
    u = np.repeat(np.geomspace(1e-6, 0.3, 40)[:, None], 3, axis=1)
    fine = np.linspace(0.0, 1.0, 200_001)[:, None, None] ** 3 * u[::13]
    force = law.force(fine)
    area = (0.5 * (force[1:] + force[:-1]) * np.diff(fine, axis=0)).sum(axis=0)
    np.testing.assert_allclose(energy(reaction(law), u)[::13], area, rtol=1e-4)


@pytest.mark.parametrize("name", LAWS)
def test_work_is_what_is_lost_after_a_closed_loop(name):
    memory = Degrading(reaction(LAWS[name]))
    top = np.array([0.004, 0.02, 0.1])
    memory.commit(top)
    before = memory.dissipated
    _, work = walk_from(memory, top, [-top, top], 4000)
    np.testing.assert_allclose(memory.dissipated - before, work, rtol=2e-3)


def walk_from(memory, u, path, steps):
    force, work = memory.evaluate(u)[0], 0.0
    for goal in path:
        start = u
        for share in np.arange(1, steps + 1) / steps:
            new = start + share * (goal - start)
            after = memory.evaluate(new)[0]
            work = work + 0.5 * (force + after) * (new - u)
            memory.commit(new)
            u, force = new, after
    return force, work


@settings(deadline=None, max_examples=25)
@given(st.sampled_from(sorted(LAWS)), paths(3, 0.1))
def test_energy_is_never_created(name, path):
    memory = Degrading(reaction(LAWS[name]))
    last, scale = memory.dissipated, LAWS[name].capacity * 0.1
    for u in path:
        memory.commit(u)
        lost = memory.dissipated
        assert (lost >= last - 1e-4 * scale).all()
        last = lost


# --- a curve that falls -----------------------------------------------------------------------


@pytest.mark.parametrize("name", LAWS)
def test_first_loading_is_the_curve_itself(name):
    law, memory = LAWS[name], Degrading(reaction(LAWS[name]))
    for u in np.linspace(0.0, 0.3, 41)[1:, None] * np.array([1.0, -0.3, 0.1]):
        force, stiffness = memory.evaluate(u)
        np.testing.assert_allclose(force, law.force(u), rtol=1e-12)
        np.testing.assert_allclose(stiffness, law.stiffness(u), rtol=1e-9)
        memory.commit(u)


def test_friction_past_its_peak_is_lost_for_good():
    law = LAWS["shaft"]
    memory = Degrading(reaction(law))
    peak, residual = law.capacity, law.force(np.full(3, 0.05))
    np.testing.assert_allclose(residual, 0.9 * peak, rtol=1e-12)
    for w in (0.05, -0.05, 0.0, 0.01, 0.05):
        memory.commit(np.full(3, w))
        assert (np.abs(memory.evaluate(np.full(3, w))[0]) <= residual * (1 + 1e-12)).all()
    np.testing.assert_allclose(memory.evaluate(np.full(3, -0.05))[0], -residual, rtol=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_the_envelope_keeps_the_peak(name):
    law = LAWS[name]
    u = np.repeat(np.geomspace(1e-6, 1.0, 2001)[:, None], 3, axis=1)
    force, stiffness = held(reaction(law)).evaluate(u)
    running = np.maximum.accumulate(law.force(u), axis=0)
    np.testing.assert_allclose(force, running, rtol=1e-3)
    assert (stiffness >= 0.0).all()
    np.testing.assert_array_equal(held(reaction(law)).evaluate(-u)[0], -force)
