"""Queries against fields that their interpolation must reproduce exactly."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from fields import Foundation
from podeep.query import envelope, snapshot, spread, step_evolution

GRID = np.array([0.0, 0.7, 2.0, 5.0, 5.0 + 1e-6, 8.0, 9.5, 12.0])
STEPS = np.arange(5)
TIMES = np.array([0.0, 0.25, 1.0, 1.5, 4.0])

coefficients = st.tuples(*[st.floats(-10.0, 10.0)] * 4)
depths = st.lists(st.floats(0.0, 12.0), min_size=1, max_size=6).map(lambda z: np.array(sorted(z)))


def polynomial(c, derivative=0):
    p = np.polynomial.Polynomial(c).deriv(derivative)
    return lambda a, z: (1.0 + a) * p(z)


def cubic(c, **more):
    fields = {
        "lateral_displacement": polynomial(c),
        "lateral_slope": polynomial(c, 1),
        "axial_displacement": polynomial(c),
        "axial_strain": polynomial(c, 1),
    }
    return Foundation(fields, GRID, STEPS, **more)


@pytest.mark.parametrize("quantity", ["lateral_displacement", "axial_displacement"])
@given(coefficients, depths)
def test_displacements_of_cubic_shape_are_exact(quantity, c, z):
    values = step_evolution(cubic(c), quantity, z).values
    assert values.shape == (5, len(z))
    scale = 5.0 * sum(abs(x) * 12.0**n for n, x in enumerate(c)) + 1e-300
    assert_allclose(values, polynomial(c)(STEPS[:, None], z), rtol=0.0, atol=1e-13 * scale)


@given(depths)
def test_forces_are_linear_between_nodes(z):
    data = Foundation({"lateral_force": lambda a, z: a * z**2}, GRID, STEPS)
    values = snapshot(data, "lateral_force", z, [3.0]).values
    assert_allclose(values[0], 3.0 * np.interp(z, GRID, GRID**2), rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("quantity", ["lateral_force", "axial_force"])
def test_a_jump_is_not_crossed_and_itself_shows_the_upper_value(quantity):
    data = Foundation({quantity: lambda a, z: np.where(z <= 5.0, 1.0, 7.0) + 0 * a}, GRID, STEPS)
    z = np.array([4.999, 5.0, 5.0 + 5e-7, 5.0 + 1e-6, 5.001])
    assert snapshot(data, quantity, z, [0.0]).values.tolist() == [[1.0, 1.0, 1.0, 7.0, 7.0]]


def test_a_jump_of_slope_is_not_crossed_by_the_cubic():
    def kink(a, z):
        return a * np.where(z <= 5.0, z, 5.0 + 3.0 * (z - 5.0))

    fields = {
        "lateral_displacement": kink,
        "lateral_slope": lambda a, z: a * np.where(z <= 5.0, 1.0, 3.0),
    }
    z = np.linspace(0.0, 12.0, 25)
    values = snapshot(Foundation(fields, GRID, STEPS), "lateral_displacement", z, [2.0]).values
    assert_allclose(values[0], kink(2.0, z), rtol=0.0, atol=1e-5)


def test_stored_values_come_back_to_the_bit_at_nodes_steps_and_times():
    data = Foundation({"axial_force": lambda a, z: np.sin(1 + a) * np.exp(-z / 3)}, GRID, TIMES)
    stored = data.read("axial_force")
    assert np.array_equal(step_evolution(data, "axial_force", GRID).values, stored)
    assert np.array_equal(snapshot(data, "axial_force", GRID, TIMES).values, stored)


@given(st.lists(st.floats(0.0, 4.0), min_size=1, max_size=9))
def test_times_are_linear_and_keep_the_order_asked_for(at):
    data = Foundation({"axial_force": lambda a, z: a**2 + z}, GRID, TIMES)
    values = snapshot(data, "axial_force", np.array([0.7]), at).values
    assert_allclose(values[:, 0], np.interp(at, TIMES, TIMES**2) + 0.7, rtol=1e-13)


def test_a_spatial_result_is_the_length_of_the_interpolated_components():
    # Between the nodes 0.7 and 2 the vector turns through zero: its length is not linear.
    c = [(-1.35, 1.0, 0.0, 0.0), (2.7, -2.0, 0.0, 0.0)]
    fields = {}
    for name, p in zip("xy", c, strict=True):
        fields[f"lateral_displacement_{name}"] = polynomial(p)
        fields[f"lateral_slope_{name}"] = polynomial(p, 1)
        fields[f"lateral_force_{name}"] = polynomial(p)
    data = Foundation(fields, GRID, STEPS, spatial=True, lateral_axis=None)
    z = np.array([0.7, 1.0, 1.35, 2.0])
    for quantity in ("lateral_displacement", "lateral_force"):
        values = snapshot(data, quantity, z, [1.0]).values[0]
        assert_allclose(values, 2.0 * np.sqrt(5.0) * np.abs(z - 1.35), rtol=0.0, atol=1e-14)


def test_components_are_interpolated_in_time_before_the_length_is_taken():
    fields = {
        "lateral_force_x": lambda a, z: 1.0 - a + 0 * z,
        "lateral_force_y": lambda a, z: 0 * a,
    }
    data = Foundation(fields, GRID, np.array([0.0, 2.0]), spatial=True)
    assert snapshot(data, "lateral_force", np.array([1.0]), [1.0]).values.tolist() == [[0.0]]


def test_axial_results_of_a_spatial_database_keep_their_sign():
    data = cubic((-1.0, 0.0, 0.0, 0.0), spatial=True)
    assert snapshot(data, "axial_displacement", np.array([1.0]), [0.0]).values.tolist() == [[-1.0]]


def test_envelope_holds_the_extremes_and_when_they_were():
    data = Foundation({"axial_force": lambda a, z: np.sin(a) * (1 + z)}, GRID, TIMES)
    curves = envelope(data, "axial_force", np.array([0.0, 0.35, 5.0]))
    factor = np.array([1.0, 1.35, 6.0])
    assert_allclose(curves.values[0], np.sin(4.0) * factor, rtol=1e-14)
    assert_allclose(curves.values[1], np.sin(1.5) * factor, rtol=1e-14)
    assert curves.when.tolist() == [[4.0] * 3, [1.5] * 3]


def test_the_time_of_an_extreme_between_nodes_is_that_of_the_more_extreme_node():
    data = Foundation(
        {"axial_force": lambda a, z: np.where(a == z, 1.0 + z, 0.0)}, STEPS * 1.0, STEPS
    )
    curves = envelope(data, "axial_force", np.array([1.0, 1.5, 2.0]))
    assert curves.values[1].tolist() == [2.0, 2.5, 3.0]
    assert curves.when[1].tolist() == [1.0, 2.0, 2.0]


def test_only_the_depths_around_the_points_are_read():
    data = cubic((1.0, 1.0, 1.0, 1.0))
    step_evolution(data, "lateral_displacement", np.array([2.5, 4.0]))
    assert data.windows == [slice(2, 4)] * 2


@pytest.mark.parametrize("z", [-0.1, 12.1, np.inf])
def test_depths_outside_the_stored_ones_are_an_error(z):
    with pytest.raises(ValueError, match="outside 0 to 12"):
        step_evolution(cubic((1.0, 0.0, 0.0, 0.0)), "lateral_displacement", np.array([z]))


def test_steps_outside_the_stored_ones_are_an_error():
    with pytest.raises(ValueError, match="outside 0 to 4"):
        snapshot(cubic((1.0, 0.0, 0.0, 0.0)), "lateral_displacement", GRID, [5.0])


def test_points_are_spread_evenly_downward_whatever_the_order_of_the_ends():
    assert spread(10.0, 0.0, 5).tolist() == spread(0.0, 10.0, 5).tolist() == [0, 2.5, 5, 7.5, 10]
    assert spread(3.0, 3.0, 1).tolist() == [3.0]
