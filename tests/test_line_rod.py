"""The rod of a line: energy, its derivatives, rotations; a line on the seabed in space."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lines_on_seabed import LIMITS, hung, numbers, riser, straight, system_of, table
from podeep.arrays import Array
from podeep.errors import InvalidData
from podeep.line.boundary_layer import BoundaryLayer
from podeep.line.catenary import grounded, shape
from podeep.line.results import LineResults
from podeep.line.rod import strained
from podeep.line.statics import Stage, follow, laid
from podeep.seabed.friction import limit_pull
from podeep.seabed.normal import Winkler
from podeep.solve.newton import Ending, Limits

EA, EI = 3e5, 40.0


def energy(a: Array, b: Array) -> Array:
    """By the definitions: stretch, and the turn of the tangent per unstretched length."""
    length = np.linalg.norm(a, axis=1)
    across = b - a * (np.einsum("ni,ni->n", a, b) / length**2)[:, None]
    turn = np.linalg.norm(across, axis=1) / length
    return 0.5 * EA * (length - 1.0) ** 2 + 0.5 * EI * turn**2


@st.composite
def curves(draw, components=(2, 3)):
    m = draw(st.sampled_from(components))
    vector = st.lists(st.floats(-1.0, 1.0), min_size=m, max_size=m)
    a, b = (np.array([draw(vector)]) for _ in range(2))
    size = np.linalg.norm(a)
    if size < 0.1:
        a = np.eye(m)[:1]
    return a / max(size, 0.1) * draw(st.floats(0.8, 1.2)), b


@given(curves())
@settings(max_examples=60, deadline=None)
def test_derivatives_are_those_of_the_energy(pair):
    a, b = pair
    n, m = a.shape
    found = strained(a, b, np.full(n, EA), np.full(n, EI))
    scale, h = EA + EI, 1e-6
    for kind in range(2):
        for i in range(m):
            move = [np.zeros_like(a), np.zeros_like(b)]
            move[kind][0, i] = h
            ends = [(a + s * move[0], b + s * move[1]) for s in (1.0, -1.0)]
            slope = (energy(*ends[0]) - energy(*ends[1])) / (2 * h)
            assert found.gradient[0, kind, i] == pytest.approx(slope[0], abs=1e-7 * scale)
            up, down = (strained(*end, np.full(n, EA), np.full(n, EI)).gradient for end in ends)
            change = (up - down)[0] / (2 * h)
            np.testing.assert_allclose(found.hessian[0, :, :, kind, i], change, atol=1e-6 * scale)


@given(curves(components=(3,)), st.floats(-3.0, 3.0), st.floats(-1.5, 1.5))
@settings(max_examples=30, deadline=None)
def test_nothing_is_strained_by_a_rotation(pair, first, second):
    (a, b), (c, s), (d, t) = pair, *((np.cos(x), np.sin(x)) for x in (first, second))
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    turn = turn @ np.array([[1.0, 0.0, 0.0], [0.0, d, -t], [0.0, t, d]])
    one, other = (
        strained(x @ r.T, y @ r.T, np.array([EA]), np.array([EI])).gradient
        for x, y, r in ((a, b, np.eye(3)), (a, b, turn))
    )
    np.testing.assert_allclose(one @ turn.T, other, atol=1e-9 * (EA + EI))


def test_a_rod_bent_to_a_circle_by_end_moments_of_its_ends():
    """An end turned by a quarter: constant moment EI pi/(2 L), no force, whatever the rotation."""
    length = 10.0
    system = system_of(
        np.linspace(0.0, length, 9), 5, (1e8, 2e3, 0.0), None, held={0.0: "xzXZ", length: "XZ"}
    )
    state = laid(system, straight(system), LIMITS)
    goal = state.q[system.held].copy()
    scale = system.field.slope_length
    stages = []
    for turn in np.linspace(0.0, 0.5 * np.pi, 11)[1:]:
        goal = goal.copy()
        goal[-2:] = scale * np.cos(turn), scale * np.sin(turn)
        stages.append(Stage(goal))
    *_, state = follow(system, state, stages, LIMITS)
    assert state.ending is Ending.CONVERGED
    results = LineResults.of(system, [state])
    s = np.linspace(0.0, length, 101)
    moment = results.moment(s)[0]
    np.testing.assert_allclose(moment, 2e3 * 0.5 * np.pi / length, rtol=1e-6)
    radius = length / (0.5 * np.pi)
    np.testing.assert_allclose(results.position(np.array([length]))[0, 0], radius, rtol=1e-5)
    assert np.abs(results.tension(s)).max() < 1.0


def test_in_space_a_riser_is_what_it_is_in_its_plane():
    at = numbers(table("05", "1")[1])
    plane, flat = riser(at, 2.0, degree=5)
    space = system_of(
        plane.field.edges,
        5,
        (at["EA_N"], at["EI_Nm2"], at["w_N_per_m"]),
        Winkler(at["k_Pa"], 1e-9),
        held={0.0: "xyzYZ", at["L_m"]: "xyz"},
        components=3,
    )
    start = hung(space, at["X_m"], at["Z_m"])
    start[2], start[5] = -at["w_N_per_m"] / at["k_Pa"], 0.0
    state = laid(space, start, LIMITS)
    assert state.ending is Ending.CONVERGED
    np.testing.assert_allclose(state.q.reshape(-1, 3)[:, 1], 0.0, atol=1e-9)
    np.testing.assert_allclose(state.q.reshape(-1, 3)[:, [0, 2]], flat.q.reshape(-1, 2), atol=1e-5)
    s = np.linspace(0.0, at["L_m"], 1001)
    one, other = (LineResults.of(x, [y]).moment(s) for x, y in ((plane, flat), (space, state)))
    np.testing.assert_allclose(other, np.abs(one), atol=1e-6 * np.abs(one).max())


@pytest.mark.parametrize("angle", [0.0, 30.0, 60.0, 90.0])
def test_a_rigid_pipe_is_dragged_by_the_limit_pull_at_an_angle(angle):
    """Both ends of a stiff short pipe move together, in space, on a box of friction."""
    weight, length, mu = 1000.0, 4.0, 0.5
    system = system_of(
        np.linspace(0.0, length, 3),
        3,
        (1e10, 1e10, weight),
        Winkler(1e6, 1e-9),
        held={0.0: "xy", length: "xy"},
        components=3,
        friction=mu,
        threshold=1e-4,
    )
    start = straight(system)
    start[2::3] -= 0.0
    state = laid(system, start, LIMITS)
    goal = state.q[system.held] + 0.1 * np.tile(
        [np.cos(np.radians(angle)), np.sin(np.radians(angle))], 2
    )
    (state,) = follow(system, state, [Stage(goal)], Limits(1e-9))
    assert state.ending is Ending.CONVERGED
    pull = state.forces.reshape(2, 2).sum(axis=0) / (weight * length)
    box = np.array([mu, mu]) * [np.cos(np.radians(angle)) > 1e-9, np.sin(np.radians(angle)) > 1e-9]
    np.testing.assert_allclose(pull, box, atol=1e-4)
    if angle in (0.0, 90.0):
        assert np.hypot(*pull) == pytest.approx(
            float(limit_pull(np.array([mu, mu]), np.radians(angle))), rel=1e-4
        )


def test_the_touchdown_has_no_staircase():
    """The upper end is moved by tenths of an element: the touchdown follows as evenly as it."""
    at = numbers(table("05", "1")[1])
    system, state = riser(at, 0.5)
    element = at["L_m"] / len(system.field.lengths)
    stages = []
    for step in range(1, 11):
        goal = state.q[system.held].copy()
        goal[-2] += 0.1 * element * step
        stages.append(Stage(goal))
    states = list(follow(system, state, stages, LIMITS))
    assert all(s.ending is Ending.CONVERGED for s in states)
    touchdown = LineResults.of(system, states).touchdown()
    steps = np.diff(touchdown)
    assert touchdown[-1] - touchdown[0] < -0.5 * element
    assert np.abs(steps - steps.mean()).max() < 0.02 * np.abs(steps.mean())


def test_lumped_at_its_nodes_the_reaction_makes_a_staircase():
    """What the integrated reaction spares: the moment at the touchdown is off by a hundredth."""
    at = numbers(table("05", "1")[1])
    errors = []
    for form in ("nodal", "integrated"):
        system, state = riser(at, 0.5, degree=5, form=form)
        results = LineResults.of(system, [state])
        moment = results.moment(np.array([at["S_td_m"]]))[0, 0]
        errors.append(abs(moment / at["M_td_Nm"] - 1.0))
    assert errors[0] > 0.01 > 20.0 * errors[1]


def test_stages_begin_in_equilibrium():
    at = numbers(table("05", "1")[1])
    system, state = riser(at, 4.0, degree=3)
    lost = laid(system, state.q * 1.5, Limits(1e-12, iterations=1))
    assert lost.ending is Ending.EXHAUSTED
    with pytest.raises(ValueError, match="begin in equilibrium"):
        list(follow(system, lost, [Stage(state.q[system.held])], LIMITS))


def test_a_stage_that_cannot_be_ends_where_it_stops():
    """A line of 10 m whose end is taken through the other one: pressed together, it loses hold."""
    system = system_of(
        np.linspace(0.0, 10.0, 5), 3, (1e3, 1.0, 0.0), None, held={0.0: "xz", 10.0: "xz"}
    )
    state = laid(system, straight(system), LIMITS)
    goal = state.q[system.held].copy()
    goal[2] = -0.5
    (end,) = follow(system, state, [Stage(goal)], Limits(1e-10, iterations=12))
    assert end.ending is not Ending.CONVERGED
    assert 0.0 < end.reached < 1.0
    assert end.residual <= 1e-9
    assert end.q[system.held][2] == pytest.approx(10.0 - end.reached * 10.5)


# --- shapes to begin with -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("span", "heights", "length"),
    [
        (80.0, (0.0, 50.0), 120.0),
        (80.0, (30.0, 50.0), 150.0),
        (80.0, (30.0, 50.0), 90.0),
        (80.0, (50.0, 50.0), 85.0),
        (80.0, (0.0, 0.0), 80.0),
    ],
    ids=["anchor and end", "both hang, middle lies", "taut", "level", "straight"],
)
def test_shapes_are_inextensible_and_meet_both_ends(span, heights, length):
    s = np.linspace(0.0, length, 4001)
    places, tangents, _ = shape(s, span, heights, length)
    np.testing.assert_allclose(places[0], [0.0, heights[0]], atol=1e-6 * length)
    np.testing.assert_allclose(places[-1], [span, heights[1]], atol=1e-6 * length)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1.0)
    way = np.linalg.norm(np.diff(places, axis=0), axis=1)
    np.testing.assert_allclose(way.sum(), length, rtol=1e-6)
    assert places[:, 1].min() >= -1e-9


def test_what_is_no_line_is_told():
    with pytest.raises(InvalidData, match="does not reach"):
        grounded(100.0, 50.0, 80.0, 1e8, 100.0)
    with pytest.raises(InvalidData, match="a tension of 0"):
        BoundaryLayer(1e7, 0.0, 1e3, 1e5)
