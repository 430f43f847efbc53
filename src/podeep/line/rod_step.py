"""What a rod resists with in a step of time: the mean of its forces, which keeps its energy.

With a = r' and b = r'' at both ends of a step, and bars for means of these two,

    F_a = N g + 2 D_A a- + D_C b-,     g = (a0 + a1)/(|a0| + |a1|),   N = EA (e0 + e1)/2
    F_b = D_C a- + 2 D_B b-

    D_A = -EI/2 (B- - 2 y- C-)/(A0 A1),   D_B = EI/2 p-,   D_C = -EI y- p-

where A = a.a, B = b.b, C = a.b, p = 1/A and y = C/A. Their work on the step is the energy that the
rod has stored, W1 - W0, to rounding; forces and moments of a step that turns the rod are none.

Source: discrete gradients after Gonzalez, J. Nonlinear Sci. 6 (1996), by the invariants of the
rod's energy EA e^2/2 + EI (B/A - C^2/A^2)/2 (`rod`); derived here.
"""

import numpy as np

from ..arrays import Array
from .rod import Strained


def _dot(x: Array, y: Array) -> Array:
    return np.asarray(np.einsum("ni,ni->n", x, y))


def mean_strained(
    start: tuple[Array, Array], end: tuple[Array, Array], axial: Array, bending: Array
) -> Strained:
    """Mean forces of a step from (a0, b0) to (a1, b1), each (n, m), as `rod.strained` gives them.

    The derivatives are those to a1 and b1, which are not symmetric.
    """
    (a0, b0), (a1, b1) = start, end
    n, m = a1.shape
    A0, B0, C0 = _dot(a0, a0), _dot(b0, b0), _dot(a0, b0)
    A1, B1, C1 = _dot(a1, a1), _dot(b1, b1), _dot(a1, b1)
    L0, L1 = np.sqrt(A0), np.sqrt(A1)
    a, b = 0.5 * (a0 + a1), 0.5 * (b0 + b1)
    p, y = 0.5 * (1.0 / A0 + 1.0 / A1), 0.5 * (C0 / A0 + C1 / A1)
    B, C, AA = 0.5 * (B0 + B1), 0.5 * (C0 + C1), A0 * A1
    N, length = axial * (0.5 * (L0 + L1) - 1.0), L0 + L1
    half = 0.5 * bending
    Q = B - 2.0 * y * C
    D_A, D_B, D_C = -half * Q / AA, half * p, -bending * y * p
    g = 2.0 * a / length[:, None]
    gradient = np.empty((n, 2, m))
    gradient[:, 0] = N[:, None] * g + 2.0 * D_A[:, None] * a + D_C[:, None] * b
    gradient[:, 1] = D_C[:, None] * a + 2.0 * D_B[:, None] * b

    def both(by_a: Array | None, by_b: Array | None) -> Array:
        row = np.zeros((n, 2, m))
        if by_a is not None:
            row[:, 0] = by_a
        if by_b is not None:
            row[:, 1] = by_b
        return row

    def times(factor: Array, row: Array) -> Array:
        return np.asarray(factor[:, None, None] * row)

    dL = both(a1 / L1[:, None], None)
    dA, dB, dC = both(2.0 * a1, None), both(None, 2.0 * b1), both(b1, a1)
    dp = times(-1.0 / A1**2, dA)
    dy = times(C1, dp) + times(1.0 / A1, dC)
    dQ = 0.5 * dB - times(C, dy) - times(y, dC)
    dD_A = times(-half / AA, dQ) + times(half * Q / (AA * A1), dA)
    dD_B, dD_C = times(0.5 * half, dp), times(-0.5 * bending * p, dy) - times(0.5 * bending * y, dp)
    unit = np.eye(m)
    hessian = np.zeros((n, 2, m, 2, m))
    along = times(0.5 * axial, dL) - times(N / length, dL)  # of N g, but for its turn

    def outer(vector: Array, row: Array) -> Array:
        return np.asarray(vector[:, :, None, None] * row[:, None])

    hessian[:, 0] = outer(g, along) + outer(2.0 * a, dD_A) + outer(b, dD_C)
    hessian[:, 1] = outer(a, dD_C) + outer(2.0 * b, dD_B)
    hessian[:, 0, :, 0] += (N / length + D_A)[:, None, None] * unit
    hessian[:, 0, :, 1] += (0.5 * D_C)[:, None, None] * unit
    hessian[:, 1, :, 0] += (0.5 * D_C)[:, None, None] * unit
    hessian[:, 1, :, 1] += D_B[:, None, None] * unit
    return Strained(gradient, hessian)


def material(a: Array, b: Array, axial: Array, bending: Array) -> Array:
    """Stiffness to stretching and bending alone, (n, 2, m, 2, m): turning the rod costs nothing.

        de = t.da,   P dk = P (db - (C/A) da)/|a| - k (t.da)/|a|

    with t = a/|a|, P across it, and k = t', the curvature as a vector.
    """
    n, m = a.shape
    A, C = _dot(a, a), _dot(a, b)
    length = np.sqrt(A)[:, None]
    t = a / length
    across = np.eye(m) - t[:, :, None] * t[:, None, :]
    curvature = np.einsum("nij,nj->ni", across, b) / length
    bend = np.zeros((n, m, 2, m))
    bend[:, :, 1] = across / length[:, :, None]
    bend[:, :, 0] = -(C / A)[:, None, None] * bend[:, :, 1]
    bend[:, :, 0] -= curvature[:, :, None] * t[:, None, :] / length[:, :, None]
    found = np.einsum("n,nkai,nkbj->naibj", bending, bend, bend)
    found[:, 0, :, 0] += axial[:, None, None] * t[:, :, None] * t[:, None, :]
    return np.asarray(found)
