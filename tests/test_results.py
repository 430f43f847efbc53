"""What is recovered from the unknowns: equilibrium, the reference pile, the output grid."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest

from podeep.model.grid import JUMP, output_depths, tube_depths
from podeep.model.needs import common_axis, needs
from podeep.scene import Displacement, Load, Numerics, Scene, Spring, Steps, Support
from podeep.solve.analysis import Solved, solve
from scenes import reference_pile


def solved(scene: Scene) -> Solved:
    return solve(scene, scene.foundations[0])


@pytest.fixture(scope="module")
def reference() -> Solved:
    return solved(reference_pile(numerics=Numerics(elements=13)))


def test_the_reference_pile_is_exact_to_1e4_in_12_embedded_elements(reference: Solved) -> None:
    """0.35697907 m and 31.275442 MN m by two independent methods, 4.2900 mm of settlement."""
    results = reference.results
    x = np.linspace(0.0, 40.0, 4001)
    moment = np.abs(results.shear_and_moment(x)[1][-1, 0])
    head = np.array([-10.0])
    assert reference.model.elements == 13
    assert results.deflection(head)[-1, 0, 0] == pytest.approx(0.35697907, rel=1e-7)
    assert moment.max() == pytest.approx(31.275442e6, rel=1e-6)
    assert x[moment.argmax()] == pytest.approx(9.637, abs=0.01)
    assert results.settlement(head)[-1, 0] == pytest.approx(4.29e-3, rel=1e-3)


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-4])
def test_the_soil_carries_the_load(accuracy: float) -> None:
    """Force and moment of the pointwise reactions balance the load, in the smallest step too."""
    results = solved(reference_pile(numerics=Numerics(accuracy=accuracy))).results
    force, overturning, axial = np.zeros((3, 11))
    for top, bottom in ((0.0, 15.0), (15.0, 40.0)):
        cells = np.linspace(top, bottom, 40_001)
        x, dx = 0.5 * (cells[1:] + cells[:-1]), cells[1] - cells[0]
        p = results.lateral_reaction(x)[:, 0]
        force += p.sum(axis=1) * dx
        overturning += p @ (x + 10.0) * dx
        axial += results.axial_reaction(x).sum(axis=1) * dx
    factors = np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(force[1:], 2e6 * factors[1:], rtol=3 * accuracy)
    lever = np.abs(results.lateral_reaction(x)[1:, 0]).max()
    assert np.abs(overturning[1:]).max() < 3 * accuracy * max(2e6 * 20.0, lever)
    np.testing.assert_allclose(axial + results.tip()[1], 5e6 * factors, rtol=3 * accuracy)


def test_internal_forces_are_those_of_the_loads_above_and_zero_at_the_tip(
    reference: Solved,
) -> None:
    results, free = reference.results, np.array([-10.0, -6.0, -1e-9])
    shear, moment = results.shear_and_moment(free)
    np.testing.assert_allclose(shear[-1, 0], 2e6, rtol=1e-9)
    np.testing.assert_allclose(moment[-1, 0], 2e6 * (free + 10.0), rtol=1e-9, atol=1e-2)
    np.testing.assert_allclose(results.compression(free)[-1], 5e6, rtol=1e-9)
    tip = np.array([40.0])
    shear, moment = results.shear_and_moment(tip)
    assert abs(shear[-1, 0, 0]) < 1.0
    assert abs(moment[-1, 0, 0]) < 1.0
    assert results.compression(tip)[-1, 0] == pytest.approx(results.tip()[1][-1], rel=1e-6)


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-4])
def test_estimates_bound_the_error_of_head_and_moment(accuracy: float) -> None:
    """Against elements of degree 7 on a fine mesh; steps as small as a hundredth included."""
    scene = reference_pile(numerics=Numerics(accuracy=accuracy), steps=4)
    exact = solved(reference_pile(steps=4, numerics=Numerics(elements=90, degree=7))).results
    found = solved(scene)
    x = np.linspace(-10.0, 40.0, 801)
    largest = [
        np.abs(r).max(axis=(1, 2))
        for both in (found.results, exact)
        for r in (both.deflection(x), both.shear_and_moment(x)[1])
    ]
    for ours, theirs in zip(largest[:2], largest[2:], strict=True):
        assert np.abs(ours[1:] / theirs[1:] - 1.0).max() <= accuracy
    assert max(e.worst.max() for e in found.estimates) <= accuracy


@pytest.mark.parametrize("angle", [30.0, 45.0, 120.0])
def test_a_load_at_an_angle_gives_the_same_resultant(reference: Solved, angle: float) -> None:
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turned = solved(reference_pile((2e6 * c, 2e6 * s, -5e6), numerics=Numerics(elements=13)))
    assert turned.model.needs.components == 1
    spring = Spring(1, 10.0, "X", 1e-6)  # differs in x and y, so both directions are solved
    scene = reference_pile((2e6 * c, 2e6 * s, -5e6), numerics=Numerics(elements=13))
    spatial = solved(replace(scene, springs=(spring,)))
    assert spatial.model.needs.components == 2
    head = np.array([-10.0])
    expected = reference.results.deflection(head)[-1, 0, 0]
    for one in (turned, spatial):
        x, y = (v[-1, 0] for v in one.results.global_vector(one.results.deflection(head)))
        assert hypot(x, y) == pytest.approx(expected, rel=1e-10)
        assert y * c == pytest.approx(x * s, abs=1e-9)


def test_an_imposed_displacement_needs_the_force_that_would_cause_it(reference: Solved) -> None:
    """Push the head of the reference pile to where 2 MN push it: the shear is 2 MN."""
    scene = reference_pile((0.0, 0.0, -5e6), numerics=Numerics(elements=13), steps=2)
    push = Displacement("PUSH", 1, 10.0, "X", 0.35697907)
    factors = ((0.5, 0.5), (1.0, 1.0))
    pushed = solved(replace(scene, displacements=(push,), steps=Steps(("HEAD", "PUSH"), factors)))
    shear = pushed.results.shear_and_moment(np.array([-5.0]))[0][-1, 0, 0]
    assert shear == pytest.approx(2e6, rel=1e-6)


def test_a_fixed_head_does_not_turn() -> None:
    scene = reference_pile(numerics=Numerics(elements=13))
    fixed = solved(replace(scene, supports=(Support(1, 10.0, ("RX", "RY")),)))
    assert fixed.model.needs.components == 1
    slope = fixed.results.deflection(np.array([-10.0]), 1)
    assert np.abs(slope).max() < 1e-14
    moment = fixed.results.shear_and_moment(np.array([-10.0]))[1][-1, 0, 0]
    assert moment < -1e7


def test_vectors_share_an_axis_or_none() -> None:
    assert common_axis([]) == 0.0
    assert common_axis([(-3.0, 0.0)]) == 0.0
    assert common_axis([(0.0, -2.0), (0.0, 5.0)]) == 90.0
    assert common_axis([(1.0, 1.0), (-2.0, -2.0)]) == 45.0
    assert common_axis([(1.0, -1.0)]) == -45.0
    assert common_axis([(1.0, 0.0), (1.0, 1e-6)]) is None


def test_a_moment_about_y_shares_the_plane_of_a_force_in_x() -> None:
    scene = reference_pile()
    load = Load("M", 1, 10.0, (0.0, 0.0, 0.0), (0.0, 1e6, 0.0))
    wanted = needs(replace(scene, loads=(*scene.loads, load)), scene.foundations[0])
    assert (wanted.components, wanted.lateral_axis) == (1, 0.0)
    diagonal = reference_pile((1e6, 1e6, 0.0))
    along = Load("M", 1, 10.0, (0.0, 0.0, 0.0), (-1e6, 1e6, 0.0))
    turned = needs(replace(diagonal, loads=(*diagonal.loads, along)), scene.foundations[0])
    assert (turned.components, turned.lateral_axis) == (1, 45.0)
    across = Load("M", 1, 10.0, (0.0, 0.0, 0.0), (1e6, 0.0, 0.0))
    assert needs(replace(scene, loads=(*scene.loads, across)), scene.foundations[0]).components == 2


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-4])
def test_the_output_grid_is_as_fine_as_the_accuracy_asks(
    reference: Solved, accuracy: float
) -> None:
    results = reference.results
    x = output_depths(results, accuracy)
    assert x[0] == 0.0
    assert x[-1] == 40.0
    jump = np.flatnonzero(np.diff(x) < 2.0 * JUMP)
    np.testing.assert_allclose(x[jump], [15.0])
    assert set(np.arange(0.0, 40.1, 2.5)) <= set(np.round(x, 9))
    probes = np.setdiff1d(np.random.default_rng(3).uniform(0.0, 40.0, 2000), x)
    for quantity in (results.lateral_reaction, results.axial_reaction):
        true, stored = quantity(probes), quantity(x)
        true, stored = (v.reshape(len(v), -1, v.shape[-1])[:, 0] for v in (true, stored))
        for step in range(1, 11):
            line = np.interp(probes, x, stored[step])
            error = np.abs(line - true[step]) / np.abs(stored[step]).max()
            assert np.quantile(error, 0.999) <= accuracy


def test_a_tube_has_two_depths_where_a_load_acts(reference: Solved) -> None:
    depth = output_depths(reference.results, 1e-2)
    x = tube_depths(reference.results, depth, np.array([-10.0, -4.0, 7.3]))
    assert x[0] == -10.0
    assert (np.diff(x) > 0.0).all()
    for mark in (-4.0, 7.3):
        at = np.flatnonzero(np.abs(x - mark) < 2.0 * JUMP)
        assert len(at) == 2
