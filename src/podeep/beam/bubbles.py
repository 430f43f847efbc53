"""Rotations of sections that inertia alone makes, inside the elements of a tube soft in shear.

In statics moment and shear force are in balance, which ties the rotation to the deflection (see
`Field`). Rotary inertia disturbs this balance. Rotations b that vanish at both ends of an element
make up for it: with them the rotation is any polynomial of the degree of the slope, and frequencies
converge as those of a tube rigid in shear do. Since what they are added to is in balance, no
stiffness couples them with it, but mass does.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from .band import band_place, bandwidth, pairs, scatter
from .field import Field
from .shapes import gauss_points, shape_functions


@dataclass(frozen=True, eq=False)
class Bubbles:
    """Matrices of the added rotations of each element, in the scaling of slopes.

    stiffness, mass: shape (elements, n, n), N/m and kg. coupling: mass shared with the unknowns of
    the field, (elements, n, local), kg.
    """

    field: Field
    stiffness: Array
    mass: Array
    coupling: Array


def bubbles(field: Field, rotary: Array) -> Bubbles:
    """Added rotations of a field with a stiffness in shear; rotary: kg m, (elements,)."""
    assert field.shear_stiffness is not None
    xi, weight = gauss_points(field.degree + 1)
    count, points = len(field.lengths), len(xi)
    value, slope = (shape_functions(xi, 0, field.degree - 1, d)[:, 1:-1] for d in (0, 1))
    turned = field.rotated(xi).reshape(count, points, field.local) * field.scale[:, None, :]
    half, length = 0.5 * field.lengths[:, None, None], field.slope_length
    bent = (slope * weight[:, None]).T @ slope
    moved = (value * weight[:, None]).T @ value
    heavy = rotary[:, None, None] / length
    soft = field.shear_stiffness[:, None, None]
    return Bubbles(
        field,
        (field.stiffness[:, None, None] / half * bent + soft * half * moved) / length**2,
        heavy / length * half * moved,
        heavy * ((value * weight[:, None]).T @ turned),
    )


def enriched(
    added: Bubbles, stiffness: Array, mass: Array, components: int
) -> tuple[Array, Array, Index]:
    """Bands with the added rotations among the unknowns of each component of a field.

    stiffness, mass: lower bands, (width, size), of which the mass has no held unknowns. Returns
    those with more unknowns, and where each unknown that was there has come to, rising, (size,).
    """
    field, m = added.field, components
    count, own = added.mass.shape[1], field.local - field.nodal
    dofs = field.strings.number(field.nodal, own - field.nodal + count)
    before = [*range(own), *range(own + count, dofs.shape[1])]
    numbers = np.zeros(field.size, dtype=np.intp)
    numbers[field.dofs] = dofs[:, before]
    place: Index = (numbers[:, None] * m + np.arange(m)).ravel()

    diagonal, column = np.nonzero((stiffness != 0.0) | (mass != 0.0))
    rows, columns = place[column + diagonal], place[column]
    width = max(bandwidth(dofs) * m, int((rows - columns).max()) + 1)
    size = (int(dofs.max()) + 1) * m
    there = band_place(rows, columns, width)
    bands = [scatter(there, band[diagonal, column], width * size) for band in (stiffness, mass)]

    free = mass[0] > 0.0
    whole = np.zeros((2, len(dofs), dofs.shape[1], dofs.shape[1]))
    inner = slice(own, own + count)
    whole[0, :, inner, inner], whole[1, :, inner, inner] = added.stiffness, added.mass
    coupled = np.zeros((len(dofs), count, dofs.shape[1]))
    coupled[:, :, before] = added.coupling
    whole[1, :, inner] += coupled
    whole[1, :, :, inner] += np.swapaxes(coupled, 1, 2)
    i, j, rows, columns = pairs(dofs)
    for c in range(m):
        kept = np.ones(size, dtype=bool)
        kept[place] = free
        at, below = rows * m + c, columns * m + c
        share = kept[at] & kept[below]
        for band, matrices in zip(bands, whole, strict=True):
            band += scatter(band_place(at, below, width), matrices[:, i, j] * share, len(band))
    shape = width, size
    return bands[0].reshape(shape, order="F"), bands[1].reshape(shape, order="F"), place
