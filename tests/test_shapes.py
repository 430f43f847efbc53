"""Shape functions: what an element needs of them, for both families and every degree."""

import numpy as np
import pytest

from podeep.beam.shapes import gauss_integrals, gauss_interpolation, gauss_points, shape_functions

FAMILIES = [(1, degree) for degree in (3, 4, 5, 6, 7)] + [(0, degree) for degree in (1, 2, 4, 6)]
ENDS = np.array([-1.0, 1.0])


@pytest.mark.parametrize(("continuity", "degree"), FAMILIES)
def test_nodal_functions_carry_the_shared_values_alone(continuity: int, degree: int) -> None:
    shared = np.stack(
        [shape_functions(ENDS, continuity, degree, order) for order in range(continuity + 1)],
        axis=1,
    )
    nodal = continuity + 1
    expected = np.zeros((2, nodal, degree + 1))
    for order in range(nodal):
        expected[0, order, order] = 1.0
        expected[1, order, degree + 1 - nodal + order] = 1.0
    np.testing.assert_allclose(shared, expected, atol=1e-14)


@pytest.mark.parametrize(("continuity", "degree"), FAMILIES)
def test_every_polynomial_of_the_degree_is_reproduced(continuity: int, degree: int) -> None:
    xi = np.linspace(-1.0, 1.0, 31)
    shape = shape_functions(xi, continuity, degree)
    for power in range(degree + 1):
        _, residual, rank, _ = np.linalg.lstsq(shape, xi**power, rcond=None)
        assert rank == degree + 1
        assert residual.max(initial=0.0) < 1e-24


@pytest.mark.parametrize(("continuity", "degree"), FAMILIES)
def test_internal_functions_are_orthogonal_in_the_strain_energy(
    continuity: int, degree: int
) -> None:
    xi, weight = gauss_points(degree + 1)
    strain = shape_functions(xi, continuity, degree, continuity + 1)
    energy = (strain * weight[:, None]).T @ strain
    nodal = continuity + 1
    internal = slice(nodal, degree + 1 - nodal)
    assert energy[internal, internal] == pytest.approx(np.eye(degree + 1 - 2 * nodal), abs=1e-13)
    energy[internal, internal] = 0.0
    assert np.abs(energy[internal]).max(initial=0.0) < 1e-13


@pytest.mark.parametrize("derivative", [1, 2, 3])
def test_derivatives_are_those_of_the_functions(derivative: int) -> None:
    xi, step = np.linspace(-0.8, 0.8, 9), 1e-5
    above = shape_functions(xi + step, 1, 6, derivative - 1)
    below = shape_functions(xi - step, 1, 6, derivative - 1)
    expected = (above - below) / (2.0 * step)
    np.testing.assert_allclose(shape_functions(xi, 1, 6, derivative), expected, atol=1e-7)


@pytest.mark.parametrize("count", [2, 3, 5, 8])
def test_integrals_from_gauss_points_are_exact_for_their_polynomials(count: int) -> None:
    points, xi = gauss_points(count)[0], np.linspace(-1.0, 1.0, 7)
    first, second = gauss_integrals(xi, count)
    for power in range(count):
        integral = (xi ** (power + 1) - (-1.0) ** (power + 1)) / (power + 1)
        twice = (xi ** (power + 2) - (-1.0) ** (power + 2)) / ((power + 1) * (power + 2))
        twice -= (-1.0) ** (power + 1) / (power + 1) * (xi + 1.0)
        np.testing.assert_allclose(first @ points**power, integral, atol=1e-13)
        np.testing.assert_allclose(second @ points**power, twice, atol=1e-13)
        np.testing.assert_allclose(
            gauss_interpolation(xi, count) @ points**power, xi**power, atol=1e-12
        )
