"""Hierarchical shape functions on the reference element, xi from -1 (top) to +1 (bottom).

Two families, each of any degree: `deflection`, with continuous slope (C1), and `stretch`,
continuous only (C0). Both add to the lowest element (cubic Hermite, linear) internal functions
whose highest derivative in the strain energy is a Legendre polynomial. They vanish at the ends
with all that is shared there, so neighbours couple through nodal values and slopes alone, steps
of stiffness and point loads at a node cost no order, and the stiffness matrix of a uniform
element is diagonal in them. Szabo & Babuska, Finite Element Analysis (1991), section 3.1.

Order of the functions of an element: those of its top node, the internal ones by rising degree,
those of its bottom node. A node of `deflection` has value and slope d/dxi, one of `stretch` its
value.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import Legendre, Polynomial

from ..arrays import Array

_LOWEST = {1: (3, 2), 0: (1, 1)}  # continuity -> degree of the lowest element, nodal functions


def lowest_degree(continuity: int) -> int:
    """Degree of the element without internal functions: 3 for C1, 1 for C0."""
    return _LOWEST[continuity][0]


def nodal_functions(continuity: int) -> int:
    """Functions that belong to one node: value (and slope)."""
    return _LOWEST[continuity][1]


@lru_cache(maxsize=32)
def _polynomials(continuity: int, degree: int, derivative: int) -> tuple[Polynomial, ...]:
    nodal = (
        [
            Polynomial([0.5, -0.75, 0.0, 0.25]),
            Polynomial([0.25, -0.25, -0.25, 0.25]),
            Polynomial([0.5, 0.75, 0.0, -0.25]),
            Polynomial([-0.25, -0.25, 0.25, 0.25]),
        ]
        if continuity == 1
        else [Polynomial([0.5, -0.5]), Polynomial([0.5, 0.5])]
    )
    internal = []
    for order in range(lowest_degree(continuity) + 1, degree + 1):
        strain = Legendre.basis(order - continuity - 1) * np.sqrt(order - continuity - 0.5)
        function = strain.integ(continuity + 1, lbnd=-1)
        internal.append(function.convert(kind=Polynomial))
    half = nodal_functions(continuity)
    functions = [*nodal[:half], *internal, *nodal[half:]]
    return tuple(f.deriv(derivative) if derivative else f for f in functions)


@lru_cache(maxsize=32)
def _coefficients(continuity: int, degree: int, derivative: int) -> Array:
    """Of powers of xi, shape (terms, functions)."""
    return _table(_polynomials(continuity, degree, derivative))


def _table(polynomials: tuple[Polynomial, ...]) -> Array:
    """Coefficients of polynomials as columns, padded with zeros."""
    table = np.zeros((max(len(p.coef) for p in polynomials), len(polynomials)))
    for column, polynomial in enumerate(polynomials):
        table[: len(polynomial.coef), column] = polynomial.coef
    return table


def _values(xi: Array, table: Array) -> Array:
    """Values (n, functions) at xi of polynomials by their table of coefficients."""
    highest, *lower = table[::-1, :, None]
    total = np.repeat(highest, len(xi), axis=1)
    for row in lower:
        total *= xi
        total += row
    return total.T


def shape_functions(xi: Array, continuity: int, degree: int, derivative: int = 0) -> Array:
    """Values of all functions of an element, or of a derivative d/dxi of them.

    xi: shape (n,). Returns shape (n, functions). `continuity` is 1 for deflection, 0 for stretch.
    """
    return _values(xi, _coefficients(continuity, degree, derivative))


@lru_cache(maxsize=64)
def functions_at_gauss_points(continuity: int, degree: int, derivative: int, count: int) -> Array:
    """Values of `shape_functions` at the Gauss points, shape (count, functions)."""
    return shape_functions(gauss_points(count)[0], continuity, degree, derivative)


@lru_cache(maxsize=16)
def gauss_points(count: int) -> tuple[Array, Array]:
    """Gauss-Legendre points on (-1, 1) and their weights, each of shape (count,)."""
    xi, weight = np.polynomial.legendre.leggauss(count)
    return xi, weight


@lru_cache(maxsize=16)
def legendre_integrals(points: int, count: int) -> Array:
    """Matrix (count, points) from values at Gauss points to their products with Legendre
    polynomials, integrated over (-1, 1)."""
    xi, weight = gauss_points(points)
    return np.ascontiguousarray(
        (np.polynomial.legendre.legvander(xi, count - 1) * weight[:, None]).T
    )


@lru_cache(maxsize=16)
def _lagrange(count: int) -> tuple[Polynomial, ...]:
    """The Lagrange polynomials over the Gauss points."""
    xi = gauss_points(count)[0]
    others = [np.delete(xi, i) for i in range(count)]
    return tuple(Polynomial.fromroots(o) / np.prod(x - o) for x, o in zip(xi, others, strict=True))


@lru_cache(maxsize=16)
def _interpolants(count: int) -> Array:
    """Coefficients of the Lagrange polynomials over the Gauss points."""
    return _table(_lagrange(count))


def gauss_interpolation(xi: Array, count: int) -> Array:
    """Matrix (n, count) from values at `count` Gauss points to their polynomial at each xi."""
    return _values(xi, _interpolants(count))


def gauss_integrals(xi: Array, count: int) -> tuple[Array, Array]:
    """Integrate, from xi = -1, what is known at `count` Gauss points.

    Returns two arrays of shape (n, count): times the values at the Gauss points they give the
    first and the second integral at each xi, exact for the interpolating polynomial.
    """
    both = _values(xi, _integrals(count))
    return both[:, :count], both[:, count:]


@lru_cache(maxsize=16)
def _integrals(count: int) -> Array:
    """Coefficients of the first integrals of the Lagrange polynomials, then of the second."""
    return _table(tuple(p.integ(times, lbnd=-1) for times in (1, 2) for p in _lagrange(count)))
