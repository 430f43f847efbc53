"""Moduli of a reaction along the displacement and across it."""

import numpy as np

from ..arrays import Array

NOTHING = 1e-30  # least distance of two components, m: there the secant is the tangent


def directed(along: Array, across: Array, u: Array, distance: Array) -> Array:
    """xx, yy and xy moduli, shape (..., 3, count), of moduli along displacements and across them.

    along, across, distance: shape (..., count); u: (..., count, 2), of no length 0.
    """
    moduli = np.empty((*along.shape[:-1], 3, along.shape[-1]))
    xx, yy, xy = moduli[..., 0, :], moduli[..., 1, :], moduli[..., 2, :]
    share = along - across
    share /= distance
    share /= distance
    x, y = u[..., 0], u[..., 1]
    np.multiply(share, x, out=xx)
    np.multiply(xx, y, out=xy)
    xx *= x
    share *= y
    np.multiply(share, y, out=yy)
    xx += across
    yy += across
    return moduli


def raised(modulus: Array, least: Array) -> Array:
    """Moduli of at least so much, (n,); of matrices, (3, n), with so much more all around."""
    if modulus.ndim == 1:
        return np.maximum(modulus, least)
    return np.asarray(modulus + np.array([[1.0], [1.0], [0.0]]) * least)


def secant(force: Array, u: Array, modulus: Array) -> Array:
    """force / u, with the exact limit at u = 0, where it is the modulus."""
    return np.divide(force, u, out=modulus.copy(), where=u != 0.0)
