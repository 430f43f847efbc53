"""The mean of a reaction on a way: against differences of its energy, and where ways are cut."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.arrays import Array
from podeep.soil.backbone import SignedUserCurve, UserCurve
from podeep.soil.energy import energy
from podeep.soil.iso_clay import IsoClay
from podeep.soil.law import Law
from podeep.soil.reaction import Reaction, Term
from podeep.soil.sand import Sand
from podeep.soil.soft_clay import SoftClay
from podeep.soil.way import (
    NOWHERE,
    crossed,
    crossed_in_plane,
    mean_of,
    points_between,
    side_by_side,
)

Z = np.array([2.0, 10.0])


def table() -> SoftClay:
    return SoftClay(Z, 1.0, 8e3 * Z, 40e3, 8e3, 0.5, 0.01)


def fan() -> IsoClay:
    return IsoClay(
        depth=Z,
        diameter=1.0,
        effective_overburden=8e3 * Z,
        undrained_shear_strength=40e3,
        mudline_strength=20e3,
        strength_gradient=1e3,
        adhesion=0.5,
        overconsolidation_ratio=np.array([1.0, 6.0]),
    )


def play() -> UserCurve:
    """5 cm of room, then hard."""
    points = ((0.0, 0.0), (0.0, 0.05), (1e6, 0.1), (1.1e6, 0.4))
    return UserCurve(points=points, force_scale=np.array([1.0, 2.0]))


LAWS = {"table": table, "fan": fan, "play": play}


def mean(law: Law, start: Array, end: Array) -> tuple[Array, Array]:
    corners = np.concatenate((law.corners, -law.corners))
    return mean_of(law.evaluate, start, end, crossed(corners, start, end))


@pytest.mark.parametrize("name", LAWS)
@settings(max_examples=60, deadline=None)
@given(ends=st.lists(st.floats(-0.5, 0.5), min_size=4, max_size=4))
def test_of_straight_lines_it_is_exact(name: str, ends: list[float]) -> None:
    """Times the way it is what is stored on it, whatever corners it meets."""
    law, (start, end) = LAWS[name](), np.array(ends).reshape(2, 2)
    force, _ = mean(law, start, end)
    u = np.abs(np.stack([start, end]))
    before, after = energy(law, u)
    known = 1e-5 if name == "fan" else 1e-13  # of the energy
    rounding = known * (before + after + law.capacity * 1e-3)
    assert (np.abs(force * (end - start) - (after - before)) <= rounding).all()


@pytest.mark.parametrize("name", [*LAWS, "sand"])
def test_its_derivative_to_the_end(name: str) -> None:
    law = Sand(Z, 1.0, 8e3 * Z, 0.6, 2e7) if name == "sand" else LAWS[name]()
    start, end, d = np.array([-0.02, 0.03]), np.array([0.07, 0.017]), 1e-7
    change = (mean(law, start, end + d)[0] - mean(law, start, end - d)[0]) / (2.0 * d)
    assert mean(law, start, end)[1] == pytest.approx(change, rel=2e-3)


def test_on_a_way_of_no_length_it_is_the_force_there() -> None:
    law, u = table(), np.array([0.0, 0.02])
    force, slope = mean(law, u, u)
    assert force == pytest.approx(law.force(u))
    assert slope == pytest.approx(0.5 * law.stiffness(u))


def test_corners_are_where_slopes_jump() -> None:
    """Both signs of an odd law meet at 0 without one; a tip has one there."""
    law = table()
    assert law.corners[:, 0] == pytest.approx(law.y50[0] * np.array([0.1, 0.3, 1.0, 3.0, 8.0]))
    assert fan().corners.shape == (11, 2)
    for each in (law, fan(), play()):
        for corner in each.corners:
            before, after = each.stiffness(corner * (1 - 1e-9)), each.stiffness(corner * (1 + 1e-9))
            assert (np.abs(before - after) > 1e-3 * np.abs(before)).all()
    tip = SignedUserCurve(points=((1.0, 0.1), (1.5, 0.3)), force_scale=np.array([2.0]))
    assert tip.corners.ravel() == pytest.approx([0.0, 0.1, 0.3])
    assert Sand(Z, 1.0, 8e3 * Z, 0.6, 2e7).corners.shape == (0, 2)


def test_corners_of_points_side_by_side() -> None:
    one = Reaction(3, (Term(np.array([0, 2]), None, table(), "", ()),))
    assert one.corners.shape == (5, 3)
    assert (one.corners[:, 1] == NOWHERE).all()
    both = side_by_side([one.corners, np.array([[0.4]])])
    assert both.shape == (5, 4)
    assert both[:, 3].tolist() == [0.4, *[NOWHERE] * 4]
    assert Reaction(2, ()).corners.shape == (0, 2)


def test_weights_add_up_and_pieces_are_kept_apart() -> None:
    cuts = np.array([[0.7, 0.0, 1.0], [0.2, 0.5, -3.0]])
    share, weight = points_between(cuts)
    assert weight.sum(axis=0) == pytest.approx(np.ones(3))
    assert (weight * share).sum(axis=0) == pytest.approx(np.full(3, 0.5))
    inside = np.sort(share[weight[:, 0] > 0.0, 0])
    assert ((inside < 0.2).sum(), (inside < 0.7).sum(), len(inside)) == (2, 4, 6)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4), st.floats(1e-3, 1.0))
def test_ways_in_a_plane_are_cut_where_they_cross_a_distance(x: list[float], far: float) -> None:
    start, end = np.array(x).reshape(2, 1, 2)
    cuts = crossed_in_plane(start, end, np.array([[far]]))
    way, length = end - start, float(np.linalg.norm(end - start))
    at = start + cuts[:, :, None] * way
    nearest = np.linalg.norm(at, axis=-1)
    if length > 1e-3:
        lowest = nearest.min()
        assert np.allclose(nearest, far, atol=1e-6) or lowest > far - 1e-6
    if length == 0.0:
        assert not cuts.any()
