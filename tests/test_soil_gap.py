"""A gap around a soil with memory: first loading, contact, drag, rebound, energy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memories import LAWS, paths, reaction, walk
from podeep.soil.approach import reached, recoverable, way, work
from podeep.soil.gap import Gap
from podeep.soil.memory_of import memory_of

LATERAL = [name for name in LAWS if name != "shaft"]
CLAY = "soft clay"


def gap(name=CLAY, drag=0.1) -> Gap:
    memory = memory_of(reaction(LAWS[name]), "GAP", drag)
    assert isinstance(memory, Gap)
    return memory


@pytest.mark.parametrize("name", LATERAL)
def test_first_loading_is_the_curve_itself(name):
    law, memory = LAWS[name], gap(name)
    for u in np.linspace(0.0, 0.3, 41)[1:, None] * np.array([1.0, -0.3, 0.1]):
        force, stiffness = memory.evaluate(u)
        np.testing.assert_allclose(force, law.force(u), rtol=1e-12)
        np.testing.assert_allclose(stiffness, law.stiffness(u), rtol=1e-9)
        memory.commit(u)


def test_y50_is_where_half_the_peak_is():
    np.testing.assert_allclose(gap().y50, np.full(3, LAWS[CLAY].y50[0]), rtol=1e-12)


def test_no_gap_opens_within_the_rebound():
    memory, plain = gap(), memory_of(reaction(LAWS[CLAY]), "MASING")
    path = np.array([1.0, -1.2, 0.4, -1.5, 1.5])[:, None] * LAWS[CLAY].y50
    np.testing.assert_array_equal(walk(memory, path)[0], walk(plain, path)[0])


def test_behind_the_pile_there_is_drag_alone_until_the_far_side():
    law, memory = LAWS[CLAY], gap()
    y50, pult = np.full(3, law.y50[0]), law.capacity
    memory.commit(8.0 * y50)
    lasting = 8.0 * y50 - law.force(8.0 * y50) * y50 / pult
    np.testing.assert_allclose(memory.left, 1.5 * y50 - lasting, rtol=1e-12)
    forces, _ = walk(memory, [y * y50 for y in (5.0, 4.0, 3.0)])
    assert (forces < 0.0).all()
    assert (np.abs(forces) <= 0.1 * pult).all()
    # one point of it in closed form: y = v + g, p(v) by Masing, drag(g)
    g = memory.gap / y50
    np.testing.assert_allclose(-forces[-1] / (0.1 * pult), 1.0 - 0.5 / (0.5 - g), rtol=1e-9)
    memory.commit(-2.0 * y50)
    np.testing.assert_array_equal(memory.gap, memory.left)
    assert (memory.evaluate(memory.u)[0] < -0.2 * pult).all()


@pytest.mark.parametrize("name", LATERAL)
def test_the_derivative_is_that_of_the_force(name):
    memory = gap(name)
    size = np.array([0.3, 0.2, 0.1])
    for share in (1.0, 0.6, 0.3, -0.2, -0.5, 0.1, 0.55, 1.2):
        u, step = share * size, 1e-7 * size
        ahead = np.where(u >= memory.u, 1.0, -1.0)
        first, k = memory.evaluate(u)
        second, _ = memory.evaluate(u + ahead * step)
        slope = (second - first) / (ahead * step)
        np.testing.assert_allclose(k, slope, rtol=1e-3, atol=1e-4 * LAWS[name].capacity.max())
        memory.commit(u)


@pytest.mark.parametrize("steps", [3, 50])
def test_long_steps_come_to_the_same_place(steps):
    path = np.array([0.3, -0.25, 0.1, -0.05, 0.2, -0.4, 0.3])[:, None] * np.array([1.0, 0.5, 0.2])
    one, _ = walk(gap(), path)
    many, _ = walk(gap(), path, steps)
    np.testing.assert_allclose(one, many, atol=1e-6 * LAWS[CLAY].capacity.max())


@settings(deadline=None, max_examples=25)
@given(st.sampled_from(LATERAL), st.sampled_from([0.0, 0.1, 0.3]), paths(3, 0.2))
def test_energy_is_never_created(name, drag, path):
    memory = gap(name, drag)
    last, scale = memory.dissipated, LAWS[name].capacity * 0.2
    for u in path:
        memory.commit(u)
        lost = memory.dissipated
        assert (lost >= last - 1e-4 * scale).all()
        last = lost


def test_work_is_what_is_lost_and_what_can_come_back():
    memory = gap()
    path = [a * np.array([0.1, 0.2, 0.3]) for a in (1.0, -0.9, 0.8, -1.1, 1.0)]
    forces, work_done = walk(memory, path, 400)
    stored = work_done - memory.dissipated
    assert (stored > 0.0).all()
    assert (stored < 0.5 * np.abs(forces).max() * 0.1).all()
    back = walk_back(memory)
    assert (back <= stored * 1.05).all()


def walk_back(memory):
    """The work that comes back on the way down to no force."""
    u, force, back = memory.u, memory.evaluate(memory.u)[0], np.zeros(3)
    while (force > 0.0).any():
        new = u - 2e-4
        after = memory.evaluate(new)[0]
        back += np.where((force > 0) & (after > 0), 0.5 * (force + after) * 2e-4, 0.0)
        memory.commit(new)
        u, force = new, after
    return back


# --- the element that approaches a bound ------------------------------------------------------


@pytest.mark.parametrize("n", [0.85, 1.0, 1.5, 5.0])
def test_work_way_and_what_comes_back_are_those_of_the_force(n):
    P, b, c = 2.0, np.array([-1.5, 0.0, 1.0]), 0.3
    s = np.linspace(0.0, 1.0, 20_001)[:, None] * np.array([0.1, 1.0, 7.0])
    q, k = reached(P, b, s, c, n)
    area = (0.5 * (q[1:] + q[:-1]) * np.diff(s, axis=0)).sum(axis=0)
    np.testing.assert_allclose(work(P, b, s[-1], c, n), area, rtol=1e-6)
    back, rate = way(P, b, q[-1], c, n)
    np.testing.assert_allclose(back, s[-1], rtol=1e-9)
    np.testing.assert_allclose(rate, 1.0 / k[-1], rtol=1e-9)
    # unloading from 1.5 to 0.5, both seen along the unloading as negative
    start = np.full(1, -1.5)
    at, _ = way(P, start, np.full(1, -0.5), c, n)
    end, _ = way(P, start, np.zeros(1), c, n)
    expected = work(P, start, at, c, n) - work(P, start, end, c, n)
    np.testing.assert_allclose(recoverable(P, np.full(1, 0.5), start, c, n), expected, rtol=1e-10)
