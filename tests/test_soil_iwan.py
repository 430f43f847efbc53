"""Soil that remembers in two planes: Masing's rules on a line, closed forms on a circle, energy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memories import LAWS, reaction
from podeep.errors import InvalidData
from podeep.soil.backbone import Polyline, UserCurve
from podeep.soil.energy import Lines, held
from podeep.soil.iwan import Iwan, dragged
from podeep.soil.memory_of import memory_in_space, memory_of
from podeep.soil.sliders import TOLERANCE, sliders
from test_soil_laws import draw_law
from test_soil_memory import FOLLOWING, REMEMBERED, SIDED, STIFFENING

FORCE, YIELD = 50e3, 0.005
ELASTIC_PLASTIC = reaction(
    Lines(
        Polyline(
            np.array([0.0, 1.0]), np.full((2, 3), [[0.0], [FORCE]]), np.full(3, YIELD)
        ).mirrored()
    )
)
SMOOTH = [name for name in LAWS if not memory_in_space(reaction(LAWS[name])).falls]
every_law = pytest.mark.parametrize("name", LAWS)


def turned(angle):
    """Unit vector at an angle."""
    return np.array([np.cos(angle), np.sin(angle)])


def places(reach=0.1, most=6):
    """Places of three points that move each for itself, to and fro and across, (places, 3, 2)."""
    step = st.sampled_from(np.linspace(-1, 1, 9) * reach) | st.floats(-reach, reach)
    place = st.lists(st.tuples(step, step), min_size=3, max_size=3)
    return st.lists(place, min_size=1, max_size=most).map(np.array)


def walked(memory, path):
    """The forces along a path."""
    forces = []
    for u in path:
        forces.append(memory.evaluate(u)[0])
        memory.commit(u)
    return np.array(forces)


# --- a line ---------------------------------------------------------------------------------------


@every_law
def test_on_a_line_it_is_masings_rules(name):
    """To and fro at an angle, 150 reversals of sizes from a tenth of a millimetre to a decimetre:
    within 1e-3 of the capacity, tables to rounding; energy within 1e-3 of what is lost."""
    law, rng, heading = LAWS[name], np.random.default_rng(1), turned(0.7)
    memory, planar = memory_in_space(reaction(law)), memory_of(reaction(law), "MASING")
    tabled, worst = len(memory.yields) < 10, 0.0
    for u in rng.uniform(-0.1, 0.1, (150, 3)) * 10.0 ** rng.uniform(-3, 0, (150, 1)):
        force, _ = memory.evaluate(u[:, None] * heading)
        off = np.abs(force @ heading - planar.evaluate(u)[0]) / law.capacity
        worst = max(worst, off.max())
        assert (np.abs(force @ turned(0.7 + np.pi / 2)) < 1e-12 * law.capacity).all()
        memory.commit(u[:, None] * heading)
        planar.commit(u)
    assert worst < (1e-12 if tabled else 1e-3)
    assert memory.dissipated == pytest.approx(planar.dissipated, rel=1e-3)


@pytest.mark.parametrize(
    ("kind", "options"),
    [(kind, options) for kind, options in REMEMBERED if kind.odd],
    ids=[f"{k.__name__}-{list(o.values())}"[:40] for k, o in REMEMBERED if k.odd],
)
@settings(deadline=None, max_examples=3, derandomize=True)
@given(st.data())
def test_every_law_remembers_in_space(kind, options, data):
    """First loading is the law within the tolerance, forces stay within the capacity, and no way
    gives energy; what turns forces is no negative stiffness."""
    law = draw_law(data, kind, options)
    memory, path = memory_in_space(reaction(law)), data.draw(places())
    first = path[0]
    size = np.hypot(first[:, 0], first[:, 1])
    force = np.hypot(*memory.evaluate(first)[0].T)
    assert (np.abs(force - law.force(size)) <= 1.1 * TOLERANCE * law.capacity).all()
    lost = np.zeros(3)
    for u in path:
        force, (xx, yy, xy) = memory.evaluate(u)
        assert (np.hypot(*force.T) <= law.capacity * (1.0 + 1e-9)).all()
        assert (xx >= 0.0).all()
        assert (xx * yy - xy * xy >= -1e-9 * (xx + yy) ** 2).all()
        memory.commit(u)
        assert (memory.dissipated >= lost - 1e-9 * law.capacity * 0.1).all()
        lost = memory.dissipated


@every_law
def test_the_springs_are_the_curve(name):
    """Everywhere; where the slope at rest is infinite the first line ends below a thousandth of the
    capacity."""
    law = LAWS[name]
    envelope = held(reaction(law))
    k, y = sliders(envelope)
    u = np.repeat(np.geomspace(1e-9, 1.0, 3001)[:, None], 3, axis=1)
    made = np.array([(k * np.minimum(y, one)).sum(axis=0) for one in u])
    off = np.abs(made - envelope.evaluate(u)[0]) / envelope.capacity
    assert off.max() < 1.1 * TOLERANCE
    assert (k >= 0.0).all()
    first = k.sum(axis=0) * y[0] / envelope.capacity
    if name == "soft clay, cube root":
        assert ((first > 2e-4) & (first < 1e-3)).all()


# --- a circle -------------------------------------------------------------------------------------


def circle(radius, turns, steps):
    """Out to a radius, and round it; (steps, 2)."""
    angles = np.linspace(0.0, 2.0 * np.pi * turns, turns * steps + 1)[1:]
    return radius * np.stack([turned(angle) for angle in angles])


def test_a_spring_dragged_round_a_circle():
    """Its foot goes round a circle of sqrt(R^2 - Y^2); it lags by asin(Y/R)."""
    memory, radius = Iwan(ELASTIC_PLASTIC), np.array([0.006, 0.01, 0.03])
    path = circle(1.0, 3, 1000)[:, None] * radius[:, None]
    walked(memory, path[:2000])
    before, force = memory.dissipated, walked(memory, path[2000:])[-1]
    foot = np.sqrt(radius**2 - YIELD**2)
    assert memory.dissipated - before == pytest.approx(2 * np.pi * FORCE * foot, rel=2e-4)
    assert force[:, 0] == pytest.approx(FORCE * YIELD / radius, rel=2e-3)  # outward, at (R, 0)
    assert force[:, 1] == pytest.approx(FORCE * foot / radius, rel=2e-3)  # with the motion


@every_law
def test_round_after_round_alike(name):
    """Once it goes round, all turns lose the same, and the force turns with the place."""
    memory = memory_in_space(reaction(LAWS[name]))
    path = circle(1.0, 5, 40)[:, None] * np.array([0.003, 0.02, 0.06])[:, None]
    lost, ends = [], []
    for turn in np.array_split(path, 5):
        before = memory.dissipated
        ends.append(walked(memory, turn))
        lost.append(memory.dissipated - before)
    assert lost[4] == pytest.approx(lost[3], rel=3e-3)
    sizes = np.hypot(*ends[4].T)
    assert sizes == pytest.approx(np.broadcast_to(sizes[:, :1], sizes.shape), rel=2e-3)


# --- any way --------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.sampled_from(sorted(LAWS)), places(), st.integers(2, 7))
def test_a_way_in_parts_is_the_whole_way(name, path, parts):
    whole, cut = (memory_in_space(reaction(LAWS[name])) for _ in range(2))
    for u in path:
        start = whole.u
        force = whole.evaluate(u)[0]
        for part in range(1, parts):
            cut.commit(start + part / parts * (u - start))
        assert cut.evaluate(u)[0] == pytest.approx(
            force, rel=1e-7, abs=1e-7 * LAWS[name].capacity[0]
        )
        whole.commit(u)
        cut.commit(u)
    if not whole.falls:
        scale = 0.1 * LAWS[name].capacity
        assert (np.abs(whole.dissipated - cut.dissipated) <= 1e-9 * scale).all()


@settings(deadline=None, max_examples=25)
@given(st.sampled_from(sorted(LAWS)), places(), st.floats(-np.pi, np.pi))
def test_turned_ways_have_turned_forces(name, path, angle):
    turn = np.stack([turned(angle), turned(angle + np.pi / 2)])
    one, other = (memory_in_space(reaction(LAWS[name])) for _ in range(2))
    forces, there = walked(one, path), walked(other, path @ turn)
    scale = LAWS[name].capacity[:, None]
    assert (np.abs(forces @ turn - there) <= 1e-9 * scale).all()
    assert (np.abs(one.dissipated - other.dissipated) <= 1e-9 * 0.1 * scale[:, 0]).all()


def work_along(memory, u, parts=150):
    """Work of the force on a straight way to u, (n,): by its mean on parts, short ones first."""
    start, last = memory.u, 0.0
    force, total = memory.evaluate(start)[0], np.zeros(len(u))
    for share in (np.arange(1, parts + 1) / parts) ** 3:
        there = memory.evaluate(start + share * (u - start))[0]
        total += 0.5 * ((force + there) * (u - start)).sum(axis=1) * (share - last)
        force, last = there, share
    memory.commit(u)
    return total


@settings(deadline=None, max_examples=10)
@given(st.sampled_from(["soft clay", "sand"]), places(most=4))
def test_no_closed_path_gives_energy(name, path):
    """Work is what is stored and lost, to the error of adding it up; round a closed path, and back
    to rest, something is lost."""
    memory = memory_in_space(reaction(LAWS[name]))
    work = sum(work_along(memory, u) for u in (*path, path[0], np.zeros((3, 2))))
    scale = 0.1 * LAWS[name].capacity
    assert (np.abs(work - memory.stored - memory.dissipated) <= 1e-3 * scale).all()
    assert (memory.dissipated >= 0.0).all()
    assert (work >= -1e-3 * scale).all()


def slopes(memory, u, h):
    """The derivative of the force by differences, (n, 2, 2)."""
    ahead, behind = (
        [memory.evaluate(u + sign * h * axis)[0] for axis in np.eye(2)] for sign in (1.0, -1.0)
    )
    return (np.stack(ahead, axis=2) - np.stack(behind, axis=2)) / (2.0 * h)


def matrices(moduli):
    xx, yy, xy = moduli
    return np.moveaxis(np.array([[xx, xy], [xy, yy]]), 2, 0)


@pytest.mark.parametrize("name", SMOOTH)
def test_derivatives_on_a_line_are_exact(name):
    memory, heading = memory_in_space(reaction(LAWS[name])), turned(0.4)
    for u in (0.0123, -0.0071, 0.0051, 0.0199):
        place = np.full((3, 1), u) * heading
        exact = slopes(memory, place, 1e-8)
        found = matrices(memory.evaluate(place)[1])
        assert np.abs(found - exact).max() < 1e-5 * np.abs(exact).max()
        memory.commit(place)


def test_derivatives_elsewhere_are_nearly_exact():
    """On short ways to the way over the yield; on any, to a half of the largest."""
    rng, memory = np.random.default_rng(3), Iwan(ELASTIC_PLASTIC)
    walked(memory, rng.uniform(-0.02, 0.02, (5, 3, 2)))
    for size in (1e-2, 1e-3):
        place = memory.u + size * YIELD * turned(1.0)
        off = matrices(memory.evaluate(place)[1]) - slopes(memory, place, 1e-5 * size * YIELD)
        assert np.abs(off).max() < size * FORCE / YIELD
    worst = 0.0
    for name in SMOOTH:
        memory = memory_in_space(reaction(LAWS[name]))
        for u in rng.uniform(-0.02, 0.02, (60, 3, 2)):
            exact, found = slopes(memory, u, 1e-9), matrices(memory.evaluate(u)[1])
            off = np.abs(found - exact).max(axis=(1, 2)) / np.abs(exact).max(axis=(1, 2))
            worst = max(worst, off.max())
            memory.commit(u)
    assert worst < 0.5


def test_where_it_rests_it_goes_on():
    """No change: the derivative is that of going on as it went, and the force stays."""
    memory = Iwan(ELASTIC_PLASTIC)
    walked(memory, np.multiply.outer([0.02, 0.01], np.ones((3, 1)) * turned(0.3)))
    force, moduli = memory.evaluate(memory.u)
    _, on = memory.evaluate(memory.u - 1e-9 * turned(0.3))
    assert moduli == pytest.approx(on, rel=1e-6, abs=1.0)
    assert np.hypot(*force.T) == pytest.approx(FORCE)


def test_a_foot_that_is_reached_exactly():
    """Springs as long as their yield, pulled across, on and back; and one that is turned round."""
    along, across = np.array([0.0, 1.0, -1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0, -1.0, 0.0])
    far = dragged(along, across, np.full(5, 50.0))
    assert far.along == pytest.approx(np.ones(5))
    assert far.slip == pytest.approx([50.0 - np.log(2.0), 50.0, 48.0, 50.0 - np.log(2.0), 49.0])
    near = dragged(along, across, np.full(5, 1e-30))
    assert (near.along, near.across) == (pytest.approx(along), pytest.approx(across))
    assert (near.turn >= 0.0).all()


# --- curves that fall, and what is refused --------------------------------------------------------


@pytest.mark.parametrize("name", ["stiff clay", "cyclic soft clay"])
def test_what_is_lost_past_a_peak_is_lost_all_around(name):
    law = LAWS[name]
    memory = memory_in_space(reaction(law))
    u = np.full(3, 0.3)
    memory.commit(u[:, None] * turned(0.0))
    assert np.hypot(*memory.evaluate(memory.u)[0].T) == pytest.approx(law.force(u), rel=1e-3)
    back = memory.evaluate(u[:, None] * turned(2.0))[0]
    assert (np.hypot(*back.T) <= law.force(u) * (1.0 + 1e-9)).all()
    assert (memory.ratio < 1.0).any()


@pytest.mark.parametrize(
    ("law", "told"),
    [(SIDED, "sides of its own"), (STIFFENING, "give energy"), (FOLLOWING, "PisaSandMoment")],
)
def test_what_cannot_remember_says_so_as_in_one_plane(law, told):
    with pytest.raises(InvalidData, match=told):
        memory_in_space(reaction(law))


def test_a_slope_that_rises_again_is_refused_in_two_planes_alone():
    rows = ((1e3, 0.01), (1.1e3, 0.05), (1.8e3, 0.1))
    law = UserCurve(points=rows, force_scale=np.ones(3))
    memory_of(reaction(law), "MASING")
    with pytest.raises(InvalidData, match="in two planes"):
        memory_in_space(reaction(law))


# --- what every memory keeps to -------------------------------------------------------------------


@every_law
def test_asking_leaves_no_trace_and_a_restored_memory_goes_on_to_the_same_bits(name):
    rng = np.random.default_rng(7)
    memory, other = (memory_in_space(reaction(LAWS[name])) for _ in range(2))
    path = rng.uniform(-0.05, 0.05, (8, 3, 2))
    walked(memory, path[:4])
    kept = memory.state()
    memory.evaluate(-3.0 * path[5])
    assert all((kept[key] == value).all() for key, value in memory.state().items())
    other.restore(kept)
    for one, same in zip(memory.evaluate(memory.u), other.evaluate(memory.u), strict=True):
        assert (one == same).all()
    assert (walked(memory, path[4:]) == walked(other, path[4:])).all()
    assert (memory.dissipated == other.dissipated).all()


def test_points_are_each_their_own():
    rng = np.random.default_rng(5)
    path = rng.uniform(-0.03, 0.03, (12, 3, 2))
    still = path.copy()
    still[:, 1:] = 0.0
    mixed, alone = (walked(memory_in_space(reaction(LAWS["sand"])), p) for p in (path, still))
    assert alone[:, 0] == pytest.approx(mixed[:, 0], rel=1e-12)
    assert (alone[:, 1:] == 0.0).all()
