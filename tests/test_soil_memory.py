"""What every memory keeps to, the springs against their tables, and which reaction has which."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memories import DEPTH, LAWS, TIP, paths, reaction, rows, walk
from podeep.errors import InvalidData
from podeep.soil.backbone import SignedUserCurve, UserCurve
from podeep.soil.degrading import Degrading
from podeep.soil.gap import Gap
from podeep.soil.masing import Masing
from podeep.soil.memory import Elastic
from podeep.soil.memory_of import memory_of
from podeep.soil.pisa import PisaClayBaseShear, PisaSandMoment
from podeep.soil.py_simple import PySimple
from podeep.soil.qz_simple import QzSimple
from podeep.soil.reaction import Reaction
from podeep.soil.secant import Secant
from podeep.soil.tip_memory import Settling
from podeep.soil.tz_simple import TzSimple
from test_soil_laws import CASES, SIGNED, draw_law

PEAK, Y50 = np.array([1e3, 2e4, 3e5]), np.array([0.002, 0.01, 0.03])
MAKERS = {
    "elastic": lambda: memory_of(reaction(LAWS["sand"]), "ELASTIC"),
    "masing": lambda: memory_of(reaction(LAWS["sand"]), "MASING"),
    "degrading": lambda: memory_of(reaction(LAWS["shaft"]), "MASING"),
    "gap": lambda: memory_of(reaction(LAWS["soft clay"]), "GAP"),
    "gap, falling": lambda: memory_of(reaction(LAWS["stiff clay"]), "GAP"),
    "tip": lambda: memory_of(reaction(TIP), "MASING"),
    "secant": lambda: Secant(reaction(LAWS["shaft"]), 3),
    "PySimple 1": lambda: PySimple(PEAK, Y50, 1, 0.1),
    "PySimple 2": lambda: PySimple(PEAK, Y50, 2, 0.3),
    "TzSimple 1": lambda: TzSimple(PEAK, Y50, 1),
    "TzSimple 2": lambda: TzSimple(PEAK, Y50, 2),
    "QzSimple 1": lambda: QzSimple(PEAK, Y50, 1, 0.05),
    "QzSimple 2": lambda: QzSimple(PEAK, Y50, 2),
}
every_memory = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
PATH = np.array([1.0, 0.4, -0.2, -1.5, -1.5, 0.3, 0.1, 2.0, -0.9])[:, None] * np.array(
    [0.01, 0.02, 0.05]
)

# --- what every memory keeps to ---------------------------------------------------------------


@every_memory
def test_asking_leaves_no_trace(make):
    memory = make()
    for u in PATH:
        before = memory.state()
        first = memory.evaluate(u)
        memory.evaluate(-3.0 * u)
        second = memory.evaluate(u)
        np.testing.assert_array_equal(first, second)
        after = memory.state()
        assert before.keys() == after.keys()
        for name in before:
            np.testing.assert_array_equal(before[name], after[name])
        memory.commit(u)


@every_memory
def test_a_restored_memory_goes_on_to_the_same_bits(make):
    memory, other = make(), make()
    for u in PATH[:5]:
        memory.commit(u)
    kept = memory.state()
    other.restore(kept)
    ways = []
    for one in (memory, other, memory):
        ways.append([])
        for u in PATH[5:]:
            ways[-1].append((*one.evaluate(u), one.dissipated))
            one.commit(u)
        one.restore(kept)
    np.testing.assert_array_equal(ways[0], ways[1])
    np.testing.assert_array_equal(ways[0], ways[2])


@every_memory
def test_the_committed_place_has_the_committed_force(make):
    memory = make()
    for u in PATH:
        force, _ = memory.evaluate(u)
        memory.commit(u)
        again, _ = memory.evaluate(u)
        np.testing.assert_allclose(again, force, rtol=1e-9, atol=1e-9)


@every_memory
def test_the_derivative_is_that_of_the_force(make):
    memory = make()
    for u in PATH:
        if (u == getattr(memory, "u", np.nan)).all():
            continue
        force, k = memory.evaluate(u)
        step = 1e-6 * (u - getattr(memory, "u", 0.0 * u))
        ahead, _ = memory.evaluate(u + step)
        behind, _ = memory.evaluate(u - step)
        slopes = np.sort([(ahead - force) / step, (force - behind) / step], axis=0)
        slack = 1e-3 * np.abs(slopes).max(axis=0) + 1e-6 * np.abs(force / u)
        assert (k >= slopes[0] - slack).all()
        assert (k <= slopes[1] + slack).all()
        memory.commit(u)


@every_memory
def test_points_are_each_their_own(make):
    rng = np.random.default_rng(5)
    memory, alone = make(), make()
    path = rng.uniform(-0.03, 0.03, (12, 3))
    mixed = walk(memory, path)[0]
    still = path.copy()
    still[:, 1:] = 0.0
    np.testing.assert_allclose(walk(alone, still)[0][:, 0], mixed[:, 0], rtol=1e-8, atol=1e-8)


SPRINGS = [name for name in MAKERS if "Simple" in name]


@settings(deadline=None, max_examples=10)
@given(st.sampled_from(SPRINGS), paths(3, 0.03, 6))
def test_springs_never_create_energy(name, path):
    memory = MAKERS[name]()
    walk(memory, path, 40)
    scale = PEAK * 0.03
    assert (memory.dissipated >= -2e-3 * scale).all()
    before, u = memory.dissipated, memory.u
    walk_on = [u + 0.01, u - 0.01, u]
    start = u
    for goal in walk_on:
        for share in np.linspace(0.0, 1.0, 61)[1:]:
            memory.commit(start + share * (goal - start))
        start = goal
    assert (memory.dissipated >= before - 2e-3 * scale).all()


# --- tables -----------------------------------------------------------------------------------


def cycles(name, make, u, force, top, sign=1.0):
    """Largest difference from a table of paths in even steps, of which every so many are rows.

    A leg that is cut short by a turn shows where the turn was.
    """
    worst, table = 0.0, rows(name)
    groups = {}
    for row in table:
        groups.setdefault((next(iter(row.values())), row["case"]), []).append(row)
    assert len(groups) == 4
    for (_, case), group in groups.items():
        memory, last = make(group[0]), 0.0
        even = abs(group[2][u] - group[1][u])
        tops = iter(top)
        for i, row in enumerate(group):
            cut = case != "mono" and i > 0 and abs(row[u] - last) < 0.999 * even
            for goal in [next(tops), row[u]] if cut else [row[u]]:
                for share in np.linspace(0.0, 1.0, 21)[1:]:
                    memory.commit(sign * np.array([last + share * (goal - last)]))
                last = goal
            value = sign * memory.evaluate(sign * np.array([row[u]]))[0][0]
            worst = max(worst, abs(value - row[force]))
    return worst


def one(value):
    return np.array([value])


def test_table_20_pysimple1():
    def make(row):
        return PySimple(one(row["pult"]), one(row["y50"]), int(row["soilType"]), row["Cd"])

    worst = cycles("soil/20_*.csv", make, "y", "p_opensees", (-0.04, 0.04))
    assert worst < 1e-4 * 100.0


def test_table_21_tzsimple1():
    def make(row):
        return TzSimple(one(row["tult"]), one(row["z50"]), int(row["tzType"]))

    worst = cycles("soil/21_*.csv", make, "z", "t_opensees", (-0.012, 0.012))
    assert worst < 1e-4 * 80.0


def test_table_22_qzsimple1():
    def make(row):
        return QzSimple(one(row["qult"]), one(row["z50"]), int(row["qzType"]), row["suction"])

    worst = cycles("soil/22_*.csv", make, "z", "q_opensees", (0.04,), sign=-1.0)
    assert worst < 1e-7 * 500.0


def test_pr14_unloading_through_the_origin():
    backbone = UserCurve(
        points=(
            (51230.0, 0.0142),
            (73505.0, 0.0427),
            (111375.0, 0.1422),
            (160375.0, 0.4267),
            (6365.0, 2.1336),
        ),
        force_scale=np.ones(1),
    )
    table = rows("valid/PR14_history.csv") + rows("valid/PR14_turning_points.csv")
    table.sort(key=lambda row: row["t_s"])
    forces, _ = walk(Secant(backbone, 1), [[row["u_m"]] for row in table])
    np.testing.assert_allclose(forces[:, 0], [row["fedem_force_N"] for row in table], atol=0.02)


# --- which reaction has which memory ----------------------------------------------------------


ROWS = UserCurve(points=((1e3, 0.1), (1.5e3, 0.2)), force_scale=np.ones(3))
BASE = PisaClayBaseShear(
    diameter=8.0,
    embedded_length=32.0,
    undrained_shear_strength=np.full(3, 1e5),
    initial_shear_modulus=1e8,
)


@pytest.mark.parametrize(
    ("law", "hysteresis", "kind"),
    [
        (LAWS["sand"], "ELASTIC", Elastic),
        (LAWS["sand"], "MASING", Masing),
        (LAWS["cyclic soft clay"], "MASING", Degrading),
        (LAWS["soft clay"], "GAP", Gap),
        (LAWS["shaft"], "MASING", Degrading),
        (LAWS["shaft"], "GAP", Degrading),
        (ROWS, "GAP", Gap),
        (BASE, "GAP", Masing),
        (TIP, "MASING", Settling),
        (TIP, "GAP", Settling),
        (TIP, "ELASTIC", Elastic),
    ],
)
def test_each_reaction_has_its_memory(law, hysteresis, kind):
    assert type(memory_of(reaction(law), hysteresis)) is kind


def test_no_soil_has_a_memory_too():
    memory = memory_of(Reaction(3, ()), "GAP")
    np.testing.assert_array_equal(walk(memory, PATH)[0], 0.0)
    np.testing.assert_array_equal(memory.dissipated, 0.0)


REMEMBERED = [
    (kind, options)
    for kind, options in CASES
    if not kind.follows_lateral and options.get("points") != SIGNED
]


@pytest.mark.parametrize(
    ("kind", "options"),
    REMEMBERED,
    ids=[f"{k.__name__}-{list(o.values())}"[:40] for k, o in REMEMBERED],
)
@settings(deadline=None, max_examples=8, derandomize=True)
@given(st.data())
def test_every_law_remembers_without_creating_energy(kind, options, data):
    law = draw_law(data, kind, options)
    path = data.draw(paths(3, 0.1, 8))
    for hysteresis in ("MASING", "GAP"):
        memory = memory_of(reaction(law), hysteresis)
        first = path[0]
        np.testing.assert_allclose(memory.evaluate(first)[0], law.force(first), rtol=1e-12)
        last, scale = memory.dissipated, 0.1 * law.capacity
        for u in path:
            force, stiffness = memory.evaluate(u)
            assert (np.abs(force) <= law.capacity * (1.0 + 1e-9)).all()
            assert np.isfinite(stiffness).all()
            memory.commit(u)
            lost = memory.dissipated
            assert (lost >= last - 1e-4 * scale).all()
            last = lost


SIDED = SignedUserCurve(points=((-1e3, -0.1), (2e3, 0.1)), force_scale=np.ones(3))
STIFFENING = UserCurve(points=((1e3, 0.1), (5e3, 0.2)), force_scale=np.ones(3))
FOLLOWING = PisaSandMoment(
    depth=DEPTH,
    diameter=8.0,
    embedded_length=32.0,
    effective_overburden=8e3 * DEPTH,
    initial_shear_modulus=1e8,
    relative_density=0.7,
)


@pytest.mark.parametrize(
    ("law", "told"),
    [(SIDED, "sides of its own"), (STIFFENING, "give energy"), (FOLLOWING, "PisaSandMoment")],
)
@pytest.mark.parametrize("hysteresis", ["MASING", "GAP"])
def test_what_cannot_remember_says_so(law, told, hysteresis):
    with pytest.raises(InvalidData, match=told):
        memory_of(reaction(law), hysteresis)
    assert type(memory_of(reaction(law), "ELASTIC")) is Elastic


def test_a_tip_unloads_along_its_first_slope_and_lifts_off():
    memory = memory_of(reaction(TIP), "MASING")
    slope, top = TIP.stiffness(np.zeros(3)), np.full(3, 0.02)
    memory.commit(top)
    peak = TIP.force(top)
    np.testing.assert_allclose(memory.evaluate(top - 1e-3)[0], peak - 1e-3 * slope, rtol=1e-12)
    np.testing.assert_array_equal(memory.evaluate(np.zeros(3)), 0.0)
    lost = memory.dissipated
    for u in (0.0, 0.019, -0.1, 0.02):
        memory.commit(np.full(3, u))
    np.testing.assert_array_equal(memory.dissipated, lost)
    np.testing.assert_allclose(memory.evaluate(np.full(3, 0.03))[0], TIP.force(np.full(3, 0.03)))
