"""Internal forces of a field from equilibrium: end forces of the elements, then the soil between.

Moments and shears from the curvature of the shape functions would lose two orders; those from
equilibrium are as exact as the displacements (and in exact balance with loads and soil).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..beam.shapes import gauss_integrals, gauss_points


@dataclass(frozen=True)
class EndForces:
    """What the part above exerts on the part below at the top of each element, and what acts on it.

    force: shape (..., elements), N; moment: the same, N m (zero for a stretch); pressure: what
    soil and other tubes resist with per length at the Gauss points, shape (..., elements, points),
    N/m, zero where there is nothing; couple: moment per length there, N m/m, None where there is
    none at all.
    """

    field: Field
    force: Array
    moment: Array
    pressure: Array
    couple: Array | None = None


@dataclass(frozen=True)
class Spread:
    """What resists a motion along some elements, at the Gauss points of each of them in order.

    elements: shape (n,), none twice; resistance: (..., n * points), N/m or N m/m.
    """

    elements: Index
    resistance: Array
    motion: Motion = "value"


def end_forces(field: Field, q: Array, spread: Sequence[Spread], count: int) -> EndForces:
    """Equilibrium of each element by virtual work.

    q: unknowns, shape (..., n). count: Gauss points of an element. An element's end forces follow
    from its nodal functions alone, since the internal ones do not work on them.
    """
    lead = q.shape[:-1]
    whole: dict[Motion, Array] = {"value": np.zeros((*lead, len(field.lengths), count))}
    for one in spread:
        total = whole.setdefault(one.motion, np.zeros_like(whole["value"]))
        total[..., one.elements, :] += one.resistance.reshape(*lead, len(one.elements), count)
    nodal = field.top_forces(q)
    if count:
        weight = gauss_points(count)[1]
        half = 0.5 * field.lengths[:, None]
        for motion, values in whole.items():
            functions = field.top_functions(count, motion) * weight[:, None]
            scale = field.scale[:, : field.nodal] * (half if motion == "value" else 1.0)
            nodal += (values[..., None, :] @ functions)[..., 0, :] * scale
    moment = -nodal[..., 1] * field.slope_length if field.nodal == 2 else 0.0 * nodal[..., 0]
    pressure = whole.pop("value")
    couple = sum(whole.values(), start=np.zeros_like(pressure)) if whole else None
    return EndForces(field, nodal[..., 0], moment, pressure, couple)


def internal_forces(ends: EndForces, x: Array, tube: int = 0) -> tuple[Array, Array]:
    """Force and moment of the part above on the part below at depths x, shape (..., len(x)).

    They are those of all tubes that move with one, by its number.

    The force is the shear of a deflection or the compression of a stretch. At a node both are
    those of the element above it, at the very top those of the first element.
    """
    field = ends.field
    element = field.elements(x, tube)
    half = 0.5 * field.lengths[element]
    along = x - field.tops[element]
    force = ends.force[..., element]
    moment = ends.moment[..., element] + force * along
    count = ends.pressure.shape[-1]
    if count:
        first, second = gauss_integrals(along / half - 1.0, count)
        soil = ends.pressure[..., element, :]
        force = force - half * np.einsum("...xg,xg->...x", soil, first)
        moment = moment - half**2 * np.einsum("...xg,xg->...x", soil, second)
        if ends.couple is not None:
            couple = ends.couple[..., element, :]
            moment = moment + half * np.einsum("...xg,xg->...x", couple, first)
    return force, moment
