"""Friction of a pipe on the seabed: limits, tangents, energy, states."""

from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.errors import InvalidData
from podeep.seabed.friction import Friction, limit_pull
from seabeds import rows

MU = np.array([0.4, 0.7])
KINDS = {
    "box, stiffness": {"stiffness": np.array([2e4, 5e4])},
    "box, threshold": {"threshold": np.array([0.02, 0.01])},
    "ellipse, stiffness": {"stiffness": np.array([2e4, 5e4]), "surface": "ellipse"},
    "ellipse, threshold": {"threshold": np.array([0.02, 0.01]), "surface": "ellipse"},
}
every_kind = pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
ONE_DOF = {row["name"]: float(row["value"]) for row in rows("09_*.csv")}


def made(kind, size: int = 1, coefficient=MU) -> Friction:
    return Friction(size, coefficient, **kind)


def pushed(law: Friction, path, normal) -> np.ndarray:
    """Commit slips, (2,) each, under normal forces; the last force."""
    for slip, load in zip(path, normal, strict=True):
        law.commit(np.array([slip], dtype=float), np.array([load], dtype=float))
    return law.force[0]


# --- limits ---------------------------


@every_kind
def test_force_against_slip_up_to_the_limit(kind) -> None:
    law, normal = made(kind), np.array([1000.0])
    for axis in (0, 1):
        reach = MU[axis] * 1000.0
        k = reach / law.spring[0, axis] if law.softens else law.spring[0, axis]
        for slip, force in ((0.5 * reach / k, 0.5 * reach), (30.0 * reach / k, reach)):
            at = np.zeros((1, 2))
            at[0, axis] = slip
            for sign in (1.0, -1.0):
                found = law.evaluate(sign * at, normal).force[0]
                assert found[axis] == pytest.approx(sign * force)
                assert found[1 - axis] == 0.0


@pytest.mark.parametrize("surface", ["box", "ellipse"])
def test_the_pull_that_slides_at_an_angle(surface) -> None:
    """Slips so far that the force is at its limit; its size against the closed form."""
    for angle in np.linspace(0.0, 2.0 * pi, 25):
        way = np.array([cos(angle), sin(angle)])
        law = made({"stiffness": 1e4, "surface": surface})
        force = pushed(law, [10.0 * way], [500.0])
        heading = np.arctan2(force[1], force[0])
        if surface == "box":
            np.testing.assert_allclose(np.abs(force), 500.0 * MU * (np.abs(way) > 1e-9), atol=1e-9)
            continue
        expected = 500.0 * limit_pull(MU, heading, surface)
        assert np.hypot(*force) == pytest.approx(expected, rel=1e-12)
        assert np.hypot(*(force / (500.0 * MU))) == pytest.approx(1.0, rel=1e-12)


def test_a_load_at_an_angle_slides_where_the_formulas_say() -> None:
    """A pull held below the limit at its angle moves no anchor, above it the anchor follows."""
    for surface in ("box", "ellipse"):
        for angle in (0.1, 0.7, 1.2):
            way = np.array([cos(angle), sin(angle)])
            limit = float(limit_pull(MU, angle, surface)) * 1000.0
            for share, slides in ((0.999, False), (1.001, True)):
                law = Friction(1, MU, stiffness=1e4, surface=surface)
                trial = share * limit * way / 1e4
                force = law.evaluate(trial[None], np.array([1000.0])).force[0]
                assert (not np.allclose(force, 1e4 * trial, rtol=1e-12)) is slides


def test_a_box_bears_the_square_root_of_two_at_45_degrees() -> None:
    """Row F6, by the law itself: and there the box's pull is not against the slip."""
    even = np.array([0.5, 0.5])
    force = {s: pushed(Friction(1, even, stiffness=1e4, surface=s), [[1.0, 1.0]], [1.0])
             for s in ("box", "ellipse")}  # fmt: skip
    found = np.hypot(*force["box"]) / np.hypot(*force["ellipse"])
    assert found == pytest.approx(ONE_DOF["F6_box_vs_ellipse_limit_45deg"], rel=1e-11)
    ratio = limit_pull(even, radians(45.0)) / limit_pull(even, radians(45.0), "ellipse")
    assert ratio == pytest.approx(sqrt(2.0))
    slip = np.array([[1.0, 0.2]])
    law = Friction(1, even, stiffness=1e4, surface="ellipse")
    one_sided = law.evaluate(slip, np.ones(1)).force[0]
    assert one_sided[1] / one_sided[0] == pytest.approx(0.2)
    box = Friction(1, even, stiffness=1e4).evaluate(slip, np.ones(1)).force[0]
    assert box[1] / box[0] == pytest.approx(1.0)


def test_the_anchor_follows_and_the_spring_unloads() -> None:
    """Back and forth over 1 m: a loop of the elastic-plastic element, whose loss is exact."""
    law, normal, k = Friction(1, 0.5, stiffness=1e4), np.array([1000.0]), 1e4
    reach = 500.0 / k
    law.commit(np.array([[1.0, 0.0]]), normal)
    assert law.dissipated == pytest.approx(500.0 * (1.0 - reach))
    back = law.evaluate(np.array([[-reach, 0.0]]), normal).force[0, 0]
    assert back == pytest.approx(0.0, abs=1e-9)
    law.commit(np.array([[-2.0, 0.0]]), normal)
    law.commit(np.array([[2.0, 0.0]]), normal)
    assert law.force[0, 0] == pytest.approx(500.0)
    assert law.dissipated == pytest.approx(500.0 * (1.0 - reach + 2.0 * (2.0 - 2.0 * reach)))


# --- the normal force ---------------------------


@every_kind
def test_no_friction_without_contact(kind) -> None:
    law = made(kind)
    pushed(law, [[0.5, 0.3]], [1000.0])
    for load in (0.0, -300.0, 5e-324, 1e-310):
        away = law.evaluate(np.array([[1.0, 1.0]]), np.array([load]))
        assert np.abs(away.force).max() <= 1e-300
    law.commit(np.zeros((1, 2)), np.array([-300.0]))
    assert not law.force.any()
    law.commit(np.zeros((1, 2)), np.array([1000.0]))
    assert not law.force.any()


@every_kind
def test_a_heavier_pipe_pulls_no_harder_by_itself(kind) -> None:
    law = made(kind)
    before = pushed(law, [[0.003, 0.002]], [1000.0])
    np.testing.assert_allclose(pushed(law, [[0.0, 0.0]], [5000.0]), before)
    after = pushed(law, [[0.0, 0.0]], [2500.0])
    np.testing.assert_allclose(after, before * (0.5 if law.softens else 1.0))


def test_a_coefficient_of_zero_is_no_friction() -> None:
    for kind in KINDS.values():
        law = made(kind, coefficient=np.array([0.0, 0.5]))
        found = law.evaluate(np.array([[1.0, 1.0]]), np.array([100.0]))
        assert found.force[0, 0] == 0.0
        assert found.force[0, 1] == pytest.approx(50.0)
        law.commit(np.array([[1.0, 1.0]]), np.array([100.0]))
        assert np.isfinite(law.dissipated).all()


# --- tangents ---------------------------


@every_kind
@settings(deadline=None, max_examples=60)
@given(data=st.data())
def test_the_tangent_is_that_of_the_force(kind, data) -> None:
    """By slip and by normal force, mu N of a sliding pipe among it; kinks are avoided."""
    law = made(kind)
    numbers = st.floats(-0.1, 0.1)
    pushed(law, [[data.draw(numbers), data.draw(numbers)]], [data.draw(st.floats(100.0, 2e3))])
    slip = np.array([[data.draw(numbers), data.draw(numbers)]])
    normal = np.array([data.draw(st.floats(100.0, 2e3))])
    found = law.evaluate(slip, normal)

    def slope(i: int, step: float) -> np.ndarray:
        move = np.zeros((1, 2))
        if i < 2:
            move[0, i] = step
        load = normal + (step if i == 2 else 0.0)
        return (law.evaluate(slip + move, load).force - found.force)[0] / step

    for i, step, size in ((0, 1e-8, 5e4), (1, 1e-8, 5e4), (2, 1e-5, 1.0)):
        exact = found.by_slip[0, :, i] if i < 2 else found.by_normal[0]
        sides = np.sort([slope(i, step), slope(i, -step)], axis=0)
        assert (exact >= sides[0] - 1e-4 * size).all()
        assert (exact <= sides[1] + 1e-4 * size).all()


@every_kind
def test_a_sliding_pipe_couples_friction_to_the_normal_force(kind) -> None:
    law = made(kind)
    found = law.evaluate(np.array([[-3.0, 0.0]]), np.array([800.0]))
    assert found.by_normal[0] == pytest.approx([-MU[0], 0.0])
    assert np.abs(found.by_slip[0, 0]).max() < 1e-9 * 5e4


# --- energy ---------------------------


@every_kind
@settings(deadline=None, max_examples=6)
@given(seed=st.integers(0, 2**32 - 1))
def test_energy_is_never_created_and_work_is_accounted_for(kind, seed) -> None:
    """Small steps: work by the trapezoidal rule is what is lost and what the springs hold."""
    rng, size, parts = np.random.default_rng(seed), 16, 100
    law, work, normal = made(kind, size), np.zeros(size), np.zeros(size)
    last, lost = law.force, law.dissipated
    for _ in range(6):
        slip = rng.uniform(-0.06, 0.06, (size, 2)) * rng.integers(0, 2, (size, 1))
        start, load = normal, rng.choice([0.0, 1.0, 300.0, 1e3, 2e3], size)
        for share in np.arange(1, parts + 1) / parts:
            normal = start + share * (load - start)
            law.commit(slip / parts, normal)
            work += (0.5 * (last + law.force) * slip / parts).sum(axis=1)
            last = law.force
            assert (law.dissipated >= lost * (1.0 - 1e-12)).all()
            lost = law.dissipated
    held = law._stored(law.force, MU * law.normal_force[:, None]).sum(axis=1)
    scale = 0.06 * 2e3
    assert (work >= held - 0.01 * scale).all()
    np.testing.assert_allclose(work, held + lost, atol=0.02 * scale)


def test_stiffness_by_the_present_normal_force_would_give_energy() -> None:
    """Slip under little load, more load, and back: T = mu N s/threshold on all of the stretch
    gives 4.5 J here; the law loses what it took."""
    law, mu, reach = Friction(1, 0.5, threshold=0.01), 0.5, 0.01
    naive = 0.5 * reach * mu * (100.0 - 1000.0)
    assert naive == pytest.approx(-2.25)
    work, last = 0.0, 0.0
    for slip, normal in [(1e-4, 100.0)] * 100 + [(0.0, 1000.0)] + [(-1e-4, 1000.0)] * 100:
        law.commit(np.array([[slip, 0.0]]), np.array([normal]))
        if slip:
            work += 0.5 * (last + law.force[0, 0]) * slip
        last = law.force[0, 0]
    assert work > 0.0
    assert law.dissipated[0] >= 0.0


@settings(deadline=None, max_examples=50)
@given(
    st.sampled_from(sorted(KINDS)),
    st.floats(-0.2, 0.2),
    st.floats(-0.2, 0.2),
    st.integers(2, 30),
)
def test_a_straight_slip_in_parts_comes_to_the_same_force(name, first, second, parts) -> None:
    """In a box from any state; under an ellipse from a state along the way."""
    slip, normal = np.array([[first, second]]), np.array([900.0])
    whole, split = made(KINDS[name]), made(KINDS[name])
    for law in (whole, split):
        if name.startswith("box"):
            law.commit(np.array([[-0.015, 0.1]]), normal)
    whole.commit(slip, normal)
    for _ in range(parts):
        split.commit(slip / parts, normal)
    np.testing.assert_allclose(split.force, whole.force, atol=1e-9)
    np.testing.assert_allclose(split.dissipated, whole.dissipated, rtol=1e-7, atol=1e-9)


def test_a_turn_under_an_ellipse_is_of_first_order() -> None:
    normal, turns = np.array([900.0]), np.array([[0.0, 0.03]])

    def turned(parts: int) -> np.ndarray:
        law = made(KINDS["ellipse, stiffness"])
        law.commit(np.array([[0.5, 0.0]]), normal)
        for _ in range(parts):
            law.commit(turns / parts, normal)
        return law.force[0]

    exact = turned(4096)
    errors = [np.abs(turned(n) - exact).max() for n in (8, 16, 32)]
    assert errors[0] > 1.8 * errors[1] > 3.2 * errors[2]
    assert errors[2] < 0.02 * 900.0 * MU[1]


# --- states ---------------------------


@every_kind
def test_asking_leaves_no_trace_and_states_come_back_to_the_same_bits(kind) -> None:
    rng = np.random.default_rng(3)
    law, other = made(kind, 4), made(kind, 4)
    for _ in range(6):
        law.commit(rng.normal(0.0, 0.02, (4, 2)), rng.uniform(0.0, 2e3, 4))
    kept = law.state()
    law.evaluate(rng.normal(0.0, 1.0, (4, 2)), rng.uniform(0.0, 2e3, 4))
    for name, value in law.state().items():
        np.testing.assert_array_equal(value, kept[name])
    other.restore(kept)
    for _ in range(5):
        slip, normal = rng.normal(0.0, 0.02, (4, 2)), rng.uniform(-1e2, 2e3, 4)
        law.commit(slip, normal)
        other.commit(slip, normal)
        for name, value in law.state().items():
            np.testing.assert_array_equal(value, other.state()[name])


@every_kind
def test_points_are_each_their_own(kind) -> None:
    rng = np.random.default_rng(4)
    slips, loads = rng.normal(0.0, 0.02, (8, 3, 2)), rng.uniform(0.0, 2e3, (8, 3))
    law, alone = made(kind, 3), made(kind)
    for slip, normal in zip(slips, loads, strict=True):
        law.commit(slip, normal)
        alone.commit(slip[1:2], normal[1:2])
    np.testing.assert_array_equal(law.force[1], alone.force[0])
    np.testing.assert_array_equal(law.dissipated[1], alone.dissipated[0])


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({}, "threshold or a stiffness"),
        ({"threshold": 0.1, "stiffness": 1e4}, "threshold or a stiffness"),
        ({"stiffness": np.inf}, "stiffness of friction of inf"),
        ({"threshold": 0.0}, "threshold of friction of 0"),
        ({"stiffness": np.array([1.0, -2.0])}, "stiffness of friction of -2"),
        ({"stiffness": 1.0, "coefficient": -0.1}, "friction coefficient of -0.1"),
        ({"stiffness": 1.0, "surface": "circle"}, "friction over a circle"),
    ],
)
def test_what_makes_no_friction(more, words: str) -> None:
    with pytest.raises(InvalidData, match=words):
        Friction(1, **{"coefficient": 0.5, **more})
