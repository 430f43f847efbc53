"""Internal forces of a field from equilibrium: end forces of the elements, then the soil between.

Moments and shears from the curvature of the shape functions would lose two orders; those from
equilibrium are as exact as the displacements (and in exact balance with loads and soil).
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..beam.shapes import gauss_integrals, gauss_points


@dataclass(frozen=True)
class EndForces:
    """What the part above exerts on the part below at the top of each element, and the soil on it.

    force: shape (..., elements), N; moment: the same, N m (zero for a stretch); soil: reaction per
    length at the Gauss points, shape (..., elements, points), N/m, zero where there is no soil;
    couple: moment per length there, N m/m, None where there is none at all.
    """

    field: Field
    force: Array
    moment: Array
    soil: Array
    couple: Array | None = None


def end_forces(
    field: Field,
    q: Array,
    soil: Array,
    elements: Index,
    turning: Array | None = None,
    swaying: Array | None = None,
) -> EndForces:
    """Equilibrium of each element by virtual work.

    q: unknowns, shape (..., n). soil: reaction at the Gauss points of `elements` in order, shape
    (..., elements * points), N/m; turning: moment against rotation there, N m/m; swaying: moment
    against the slope at the Gauss points of all elements. An element's end forces follow from its
    nodal functions alone, since the internal ones do not work on them.
    """
    count = soil.shape[-1] // max(len(elements), 1)
    lead = q.shape[:-1]

    def by_element(values: Array, where: Index) -> Array:
        whole = np.zeros((*lead, len(field.lengths), count))
        whole[..., where, :] = values.reshape(*lead, len(where), count)
        return whole

    spread = by_element(soil, elements)
    every = np.arange(len(field.lengths))
    couples: list[tuple[Array, Motion]] = []
    if turning is not None:
        couples.append((by_element(turning, elements), "rotation"))
    if swaying is not None:
        couples.append((by_element(swaying, every), "slope"))
    rows = range(field.nodal)
    local = field.element_stiffness[:, rows, :]
    nodal = (local @ q[..., field.dofs][..., None])[..., 0]
    if count:
        weight = gauss_points(count)[1]
        half = 0.5 * field.lengths[:, None]
        for values, motion in [(spread, "value"), *couples]:
            shape = field.top_functions(count, motion) * weight[:, None]
            scale = field.scale[:, rows] * (half if motion == "value" else 1.0)
            nodal += (values[..., None, :] @ shape)[..., 0, :] * scale
    moment = -nodal[..., 1] * field.slope_length if field.nodal == 2 else 0.0 * nodal[..., 0]
    couple = sum((c for c, _ in couples), start=np.zeros_like(spread)) if couples else None
    return EndForces(field, nodal[..., 0], moment, spread, couple)


def internal_forces(ends: EndForces, x: Array) -> tuple[Array, Array]:
    """Force and moment of the part above on the part below at depths x, shape (..., len(x)).

    The force is the shear of a deflection or the compression of a stretch. At a node both are
    those of the element above it, at the very top those of the first element.
    """
    field = ends.field
    element = field.elements(x)
    half = 0.5 * field.lengths[element]
    along = x - field.edges[element]
    force = ends.force[..., element]
    moment = ends.moment[..., element] + force * along
    count = ends.soil.shape[-1]
    if count:
        first, second = gauss_integrals(along / half - 1.0, count)
        soil = ends.soil[..., element, :]
        force = force - half * np.einsum("...xg,xg->...x", soil, first)
        moment = moment - half**2 * np.einsum("...xg,xg->...x", soil, second)
        if ends.couple is not None:
            couple = ends.couple[..., element, :]
            moment = moment + half * np.einsum("...xg,xg->...x", couple, first)
    return force, moment


def inside(ends: EndForces, xi: Array) -> tuple[Array, Array]:
    """Force and moment as `internal_forces`, at the places xi (-1 to 1) of every element.

    Shape (..., elements, len(xi)).
    """
    half = 0.5 * ends.field.lengths[:, None]
    force = ends.force[..., None]
    moment = ends.moment[..., None] + force * (half * (xi + 1.0))
    count = ends.soil.shape[-1]
    if count:
        first, second = (table.T for table in gauss_integrals(xi, count))
        moment -= (ends.soil @ second) * half**2
        force = force - (ends.soil @ first) * half
        if ends.couple is not None:
            moment += (ends.couple @ first) * half
    return np.broadcast_to(force, moment.shape), moment
