"""What every seabed that remembers keeps to: states, sub-steps, derivatives, bounds, energy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memories import paths, walk
from podeep.seabed.hyperbolic import Hyperbolic
from podeep.soil.memory import Memory
from seabeds import SEABEDS

every_seabed = pytest.mark.parametrize("make", SEABEDS.values(), ids=SEABEDS)
seabeds = st.sampled_from(sorted(SEABEDS))
REACH = 0.1
PATH = np.array([0.6, 0.5, 0.57, 0.3, -0.1, -1.0, 0.2, 0.59, 0.9, 0.9, 0.1, 0.95, 0.4])[
    :, None
] * np.array([0.1, 0.05, 0.02])
SCALE = 3000.0 * REACH  # a force times the reach, J/m


def made(name: str) -> Memory:
    return SEABEDS[name]()


@every_seabed
def test_asking_leaves_no_trace(make) -> None:
    law = make()
    for u in PATH:
        before, first = law.state(), law.evaluate(u)
        law.evaluate(-3.0 * u)
        np.testing.assert_array_equal(first, law.evaluate(u))
        assert law.dissipated is not None
        after = law.state()
        assert before.keys() == after.keys()
        for name in before:
            np.testing.assert_array_equal(before[name], after[name])
        law.commit(u)


@every_seabed
def test_a_restored_seabed_goes_on_to_the_same_bits(make) -> None:
    law, other = make(), make()
    for u in PATH[:6]:
        law.commit(u)
    kept = law.state()
    other.restore(kept)
    ways = []
    for one in (law, other, law):
        ways.append([])
        for u in PATH[6:]:
            ways[-1].append((*one.evaluate(u), one.dissipated))
            one.commit(u)
        one.restore(kept)
    np.testing.assert_array_equal(ways[0], ways[1])
    np.testing.assert_array_equal(ways[0], ways[2])


@every_seabed
def test_the_committed_place_has_the_committed_force(make) -> None:
    law = make()
    for u in PATH:
        force, _ = law.evaluate(u)
        law.commit(u)
        np.testing.assert_allclose(law.evaluate(u)[0], force, rtol=1e-9, atol=1e-8)


@every_seabed
def test_points_are_each_their_own(make) -> None:
    path = np.random.default_rng(5).uniform(-0.05, REACH, (15, 3))
    still = path.copy()
    still[:, 1:] = 0.0
    mixed, alone = walk(make(), path)[0], walk(make(), still)[0]
    np.testing.assert_array_equal(mixed[:, 0], alone[:, 0])


@settings(deadline=None, max_examples=40)
@given(seabeds, paths(3, REACH, 10), st.lists(st.floats(-0.5, 1.0), min_size=3, max_size=3))
def test_the_derivative_is_that_of_the_force(name, path, share) -> None:
    """Between the slopes on both sides, which differ at corners alone."""
    law = made(name)
    for u in path:
        law.commit(u)
    u = REACH * np.array(share)
    step = 1e-9
    force, k = law.evaluate(u)
    ahead, behind = law.evaluate(u + step)[0], law.evaluate(u - step)[0]
    slopes = np.sort([(ahead - force) / step, (force - behind) / step], axis=0)
    slack = 2e-3 * np.abs(slopes).max(axis=0) + 2e-3 * np.abs(force) / REACH + 10.0
    off_the_seabed = np.abs(u) <= 2.0 * step  # the hyperbolic one drops there
    assert ((k >= slopes[0] - slack) | off_the_seabed).all()
    assert ((k <= slopes[1] + slack) | off_the_seabed).all()


@settings(deadline=None, max_examples=40)
@given(seabeds, paths(3, REACH, 8), st.integers(2, 9))
def test_a_straight_way_in_parts_comes_to_the_same_state(name, path, parts) -> None:
    one, many = made(name), made(name)
    whole, _ = walk(one, path)
    split, _ = walk(many, path, parts)
    np.testing.assert_allclose(split, whole, rtol=1e-8, atol=1e-6)
    if not isinstance(one, Hyperbolic):  # which sums work by the trapezoidal rule
        np.testing.assert_allclose(many.dissipated, one.dissipated, rtol=1e-8, atol=1e-6)


@settings(deadline=None, max_examples=40)
@given(seabeds, paths(3, REACH, 12))
def test_forces_stay_within_the_first_curve_and_the_suction(name, path) -> None:
    law, size = made(name), np.zeros(3)
    for u in path:
        force, _ = law.evaluate(u)
        law.commit(u)
        size = np.maximum(size, u)
        first = size > 0.0
        most = made(name).evaluate(np.where(first, size, 1e-3))[0]
        pull = 4000.0
        if isinstance(law, Hyperbolic):
            most, _ = law.soil.ultimate(np.where(first, size, 1e-3))
            pull = 0.6 * most
        assert (force <= np.where(first, most, 0.0) * (1.0 + 1e-12)).all()
        assert (force >= -np.where(first, pull, 0.0)).all()
        assert (force[u <= 0.0] <= 1e-9).all()


EXACT = [name for name in SEABEDS if "hyperbolic" not in name]


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(EXACT), paths(3, REACH, 15))
def test_energy_is_never_created(name, path) -> None:
    """What is lost never falls, however long the steps."""
    law = made(name)
    last = law.dissipated
    for u in path:
        law.commit(u)
        assert (law.dissipated >= last - 1e-10 * SCALE).all()
        last = law.dissipated


@settings(deadline=None, max_examples=8)
@given(st.sampled_from(EXACT), paths(3, REACH, 6))
def test_work_is_what_is_lost_and_what_is_held(name, path) -> None:
    """Held: R^2/(2 k) on the elastic line, up and down. Work by the trapezoidal rule."""
    law = made(name)
    _, work = walk(law, path, 200)
    force = law.evaluate(law.u)[0]
    held = 0.5 * force**2 / law.stiffness
    np.testing.assert_allclose(work, law.dissipated + held, atol=4e-3 * SCALE)


@settings(deadline=None, max_examples=10)
@given(st.sampled_from(EXACT), paths(3, REACH, 6))
def test_a_closed_path_takes_work(name, path) -> None:
    """From anywhere, around, and back: work done is at least what the state holds more."""
    law = made(name)
    walk(law, path[:2], 1)
    place, force = law.u, law.evaluate(law.u)[0]
    held, work, last, at = 0.5 * force**2 / law.stiffness, 0.0, force, place
    for goal in [*path[2:], place]:
        for share in np.linspace(0.0, 1.0, 201)[1:]:
            u = at + share * (goal - at)
            now = law.evaluate(u)[0]
            work = work + 0.5 * (last + now) * (u - law.u)
            law.commit(u)
            last = now
        at = np.array(goal)
    held = 0.5 * last**2 / law.stiffness - held
    assert (work >= held - 4e-3 * SCALE).all()


@settings(deadline=None, max_examples=15)
@given(st.sampled_from(["hyperbolic", "hyperbolic, rejoining"]), paths(3, REACH, 6))
def test_the_hyperbolic_seabed_gives_no_more_than_it_took(name, path) -> None:
    """But for shallow touches: uplift is softer than first penetration below a few D/K_max, and
    gives 5e-3 of Pu D/K_max more than that took. A property of the published curves."""
    law = made(name)
    walk(law, path, 60)
    most, _ = law.soil.ultimate(np.full(3, 0.5 * law.soil.diameter))
    assert (law.dissipated >= -5e-3 * most * law.soil.diameter / 200.0).all()
