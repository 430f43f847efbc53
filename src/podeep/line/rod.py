"""Strain energy of an elastic rod without torsion, at finite rotations.

A line is a curve r(s) over its unstretched arc length s. With a = r' and b = r'',

    e = |a| - 1                                   stretch
    k = |d(a/|a|)/ds| = |a x b| / |a|^2           rotation of the tangent per unstretched length
    energy per length = EA e^2 / 2 + EI k^2 / 2

The bending moment is EI k, about the binormal, the tension along the tangent EA e. Positions are
all unknowns there are: a round pipe that nothing twists needs no others.

Source: the extensible Kirchhoff rod, after Meier, Popp and Wall, Comput. Methods Appl. Mech. Engrg.
278 (2014) 445-478, with the curvature per unstretched length.
"""

from typing import NamedTuple

import numpy as np

from ..arrays import Array


class Strained(NamedTuple):
    """Energy per length by a and b at n points, and its derivatives, in m components.

    gradient: (n, 2, m); hessian: (n, 2, m, 2, m); first a, then b.
    """

    gradient: Array
    hessian: Array


def strained(a: Array, b: Array, axial: Array, bending: Array) -> Strained:
    """Derivatives of the strain energy; a, b: (n, m); axial EA (N) and bending EI (N m2): (n,)."""
    n, m = a.shape
    A, B, C = (np.einsum("ni,ni->n", x, y) for x, y in ((a, a), (b, b), (a, b)))
    length = np.sqrt(A)
    # EI k^2/2 = EI (B/A - C^2/A^2)/2, derived by the products A, B and C
    half = 0.5 * bending
    by_A, by_B, by_C = half * (2.0 * C**2 / A - B) / A**2, half / A, -bending * C / A**2
    by_AA, by_AB = half * (2.0 * B - 6.0 * C**2 / A) / A**3, -half / A**2
    by_AC, by_CC = 2.0 * bending * C / A**3, -bending / A**2
    stretched = axial * (1.0 - 1.0 / length)  # EA e / |a|
    first = stretched + 2.0 * by_A
    gradient = np.empty((n, 2, m))
    gradient[:, 0] = first[:, None] * a + by_C[:, None] * b
    gradient[:, 1] = by_C[:, None] * a + 2.0 * by_B[:, None] * b

    aa, ab, bb = (x[:, :, None] * y[:, None, :] for x, y in ((a, a), (a, b), (b, b)))
    unit = np.eye(m)

    def times(factor: Array, matrix: Array) -> Array:
        return np.asarray(factor[:, None, None] * matrix)

    hessian = np.empty((n, 2, m, 2, m))
    mixed = ab + np.swapaxes(ab, 1, 2)
    hessian[:, 0, :, 0] = times(first, unit) + times(4.0 * by_AA + axial / length**3, aa)
    hessian[:, 0, :, 0] += times(2.0 * by_AC, mixed) + times(by_CC, bb)
    cross = times(4.0 * by_AB, ab) + times(2.0 * by_AC, aa)
    cross += times(by_C, unit) + times(by_CC, np.swapaxes(ab, 1, 2))
    hessian[:, 0, :, 1] = cross
    hessian[:, 1, :, 0] = np.swapaxes(cross, 1, 2)
    hessian[:, 1, :, 1] = times(2.0 * by_B, unit) + times(by_CC, aa)
    return Strained(gradient, hessian)
