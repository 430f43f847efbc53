"""The discrete equilibrium of a line of large rotations on the seabed, in band storage.

The unknowns q are those of a field with continuous slope for each component of the position r(s),
interleaved. What statics needs of a system of equations is that of `model.system`: internal forces
at a state, solutions with the tangent there.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack

from ..arrays import Array, Index
from ..beam.band import band_place, band_times, bandwidth, pairs, scatter, without
from ..beam.field import Field
from ..beam.shapes import gauss_points
from .bed import Bed
from .rod import strained

_FAR = 10.0  # times its length: how far from the origin a line may be
_SHIFTS = (1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4)  # of the diagonal, where the tangent has to be raised


@dataclass(frozen=True, eq=False)
class Clamp:
    """A stiff spring that holds the tangent r' of a node against turning from a direction.

    unknowns: of its slope, (m,); direction: a unit vector, (m,); stiffness: N of the field's
    scaling.
    """

    unknowns: Index
    direction: Array
    stiffness: float

    @property
    def matrix(self) -> Array:
        """(m, m)."""
        across = np.eye(len(self.direction)) - np.outer(self.direction, self.direction)
        return np.asarray(self.stiffness * across)


@dataclass(frozen=True, eq=False)
class Sections:
    """Of each element: EA (N), EI (N m2), submerged weight (N/m) per unstretched length, (n,)."""

    axial: Array
    bending: Array
    weight: Array


class LineSystem:
    """Equations of one line; `internal` at a state comes before `solve` with its tangent.

    field: of one component over the unstretched arc length. components: 2 in a vertical plane (x
    and z), 3 in space; the last one is z, upwards. held: unknowns that are given. bed: what the
    seabed does; None for none. clamps: directions that are held.
    """

    def __init__(
        self,
        field: Field,
        components: int,
        sections: Sections,
        held: Index,
        bed: Bed | None,
        clamps: Sequence[Clamp] = (),
    ) -> None:
        self.field, self.components, self.sections = field, components, sections
        self.held, self.bed, self.clamps = held, bed, tuple(clamps)
        self.size = field.size * components
        self.unstretched_length = float(field.edges[-1] - field.edges[0])
        #: no unknown of a line that is held gets as large as that, m
        self.length = _FAR * self.unstretched_length
        m = components
        elements = len(field.lengths)
        xi, weight = gauss_points(field.degree)
        self._weight = (0.5 * field.lengths[:, None] * weight).ravel()
        s = (field.tops[:, None] + 0.5 * field.lengths[:, None] * (xi + 1.0)).ravel()
        at = (elements, field.degree, field.local)
        value, self._slope, self._bend = (
            field.interpolation(s, d).shares.reshape(at) for d in range(3)
        )
        points = np.repeat(np.arange(elements), field.degree)
        self._axial, self._bending = sections.axial[points], sections.bending[points]
        self._dofs = (field.dofs[:, :, None] * m + np.arange(m)).reshape(elements, -1)
        self.width = bandwidth(self._dofs)
        i, j, rows, columns = pairs(self._dofs)
        self._pairs, self._places = (i, j), band_place(rows, columns, self.width)
        self.load = self._dead(value)

    def _dead(self, value: Array) -> Array:
        """Forces of the weight, (size,)."""
        weight = self._weight.reshape(len(self._dofs), -1) * self.sections.weight[:, None]
        total = np.zeros((self.field.size, self.components))
        np.subtract.at(total[:, -1], self.field.dofs, np.einsum("enl,en->el", value, weight))
        return total.ravel()

    def internal(self, q: Array) -> Array:
        """Internal forces and what the seabed resists at q, (size,)."""
        m, count = self.components, len(self._dofs)
        r = q[self._dofs].reshape(count, -1, m)
        a, b = (np.matmul(s, r).reshape(-1, m) for s in (self._slope, self._bend))
        self._strained = strained(a, b, self._axial, self._bending)
        force = (self._strained.gradient * self._weight[:, None, None]).reshape(count, -1, 2, m)
        own = np.einsum("enl,enm->elm", self._slope, force[:, :, 0])
        own += np.einsum("enl,enm->elm", self._bend, force[:, :, 1])
        total = scatter(self._dofs, own, self.size)
        for clamp in self.clamps:
            total[clamp.unknowns] += clamp.matrix @ q[clamp.unknowns]
        if self.bed is not None:
            total += self.bed.internal(q)
        return total

    def _whole_tangent(self) -> Array:
        """Lower band of the tangent at the last `internal`, (width, size)."""
        m, (count, local) = self.components, self.field.dofs.shape
        hessian = self._strained.hessian * self._weight[:, None, None, None, None]
        hessian = hessian.reshape(count, -1, 2, m, 2, m)
        functions = (self._slope, self._bend)
        whole = np.zeros((count, local, m, local, m))
        for one, left in enumerate(functions):
            for other, right in enumerate(functions):
                part = hessian[:, :, one, :, other]
                whole += np.einsum("enl,enij,enk->elikj", left, part, right, optimize=True)
        i, j = self._pairs
        entries = whole.reshape(count, local * m, local * m)[:, i, j]
        flat = scatter(self._places, entries, self.width * self.size)
        band: Array = flat.reshape((self.width, self.size), order="F")
        for clamp in self.clamps:
            for column, unknown in enumerate(clamp.unknowns):
                below = clamp.unknowns[column:]
                band[below - unknown, unknown] += clamp.matrix[column:, column]
        if self.bed is not None:
            self.bed.stiffen(band)
        return band

    def tangent(self) -> Array:
        """Lower band of the tangent at the last `internal`, (width, size); held ones apart."""
        return self._apart(self._whole_tangent())

    def _apart(self, band: Array) -> Array:
        apart: Array = without(band, self.held)
        apart[0, self.held] = 1.0
        return apart

    def led(self, move: Array) -> Array | None:
        """Move of all unknowns that a small move of the held ones asks for, (size,)."""
        band = self._whole_tangent()
        right = -band_times(band, move)
        right[self.held] = move[self.held]
        return self._solve(self._apart(band), right)

    @property
    def diagonal(self) -> Array:
        """Of the tangent at the last `internal`, (size,)."""
        return np.asarray(np.abs(self.tangent()[0]))

    def solve(self, right: Array) -> Array | None:
        """Solve with the tangent at the last `internal`; None where that cannot be done.

        Where the tangent is not positive definite, as of a line without tension, its diagonal is
        raised as little as makes it so: the energy still falls along the answer.
        """
        return self._solve(self.tangent(), right)

    def _solve(self, band: Array, right: Array) -> Array | None:
        _, x, info = lapack.dpbsv(band.copy(order="F"), right, lower=1, overwrite_ab=1)
        if info == 0:
            return np.asarray(x)
        for shift in _SHIFTS:
            raised = band.copy(order="F")
            raised[0] += shift * np.abs(band[0]).mean()
            _, x, info = lapack.dpbsv(raised, right, lower=1, overwrite_ab=1)
            if info == 0:
                return np.asarray(x)
        return None

    def solve_by_secants(self, right: Array) -> Array | None:
        """As `solve`: the tangent is what a line has."""
        return self.solve(right)

    @property
    def reaction(self) -> Array:
        """What the seabed resists with at the last `internal`, (points, components), N/m."""
        return np.zeros((0, self.components)) if self.bed is None else self.bed.reaction

    def total_reaction(self) -> float:
        """Magnitudes of what the seabed gives at the last `internal`, added up, N."""
        return 0.0 if self.bed is None else self.bed.total
