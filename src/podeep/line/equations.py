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
        #: length that belongs to each Gauss point, m
        self.weight: Array = (0.5 * field.lengths[:, None] * weight).ravel()
        s = (field.tops[:, None] + 0.5 * field.lengths[:, None] * (xi + 1.0)).ravel()
        at = (elements, field.degree, field.local)
        #: of r, r' and r''
        self._shapes = [field.interpolation(s, d).shares.reshape(at) for d in range(3)]
        self._stacked: Array = np.ascontiguousarray(np.stack(self._shapes, axis=2))
        #: element of each Gauss point; EA and EI there, N and N m2
        self.element: Index = np.repeat(np.arange(elements), field.degree)
        self.axial: Array = sections.axial[self.element]
        self.bending: Array = sections.bending[self.element]
        self._dofs = (field.dofs[:, :, None] * m + np.arange(m)).reshape(elements, -1)
        self.width = bandwidth(self._dofs)
        i, j, rows, columns = pairs(self._dofs)
        self._pairs, self._places = (i, j), band_place(rows, columns, self.width)
        weighs = np.zeros((len(self.element), 1, m))
        weighs[:, 0, -1] = -sections.weight[self.element]
        self.load = self.forces(weighs, 0)

    def curve(self, q: Array) -> tuple[Array, Array]:
        """r' and r'' at the Gauss points of the elements, (n, components) each."""
        r = q[self._dofs].reshape(len(self._dofs), -1, self.components)
        first, second = (np.matmul(s, r).reshape(-1, self.components) for s in self._shapes[1:])
        return first, second

    def at_points(self, x: Array) -> Array:
        """Values of a field of unknowns x at the Gauss points of the elements, (n, components)."""
        r = x[self._dofs].reshape(len(self._dofs), -1, self.components)
        return np.asarray(np.matmul(self._shapes[0], r).reshape(-1, self.components))

    def forces(self, densities: Array, first: int = 1) -> Array:
        """Forces per length on r, r' and r'', from derivative `first` on, (n, any, m), on unknowns.

        Returns shape (size,), N.
        """
        count, m = len(self._dofs), self.components
        force = (densities * self.weight[:, None, None]).reshape(count, -1, densities.shape[1], m)
        own = sum(
            np.einsum("enl,enm->elm", self._shapes[first + d], force[:, :, d])
            for d in range(densities.shape[1])
        )
        return scatter(self._dofs, np.asarray(own), self.size)

    def band(self, densities: Array, first: int = 1) -> Array:
        """Symmetric derivatives of `forces`, (n, any, m, any, m), as a lower band (width, size)."""
        return self._banded(self._matrices(densities, first))

    def bands(self, densities: Array) -> tuple[Array, Array]:
        """The lower bands of derivatives of `forces`, not symmetric, and of the transpose."""
        whole = self._matrices(densities, 1)
        return self._banded(whole), self._banded(np.swapaxes(whole, 1, 2))

    def _matrices(self, densities: Array, first: int) -> Array:
        """Derivatives as matrices of the elements, (elements, local, local)."""
        m, (count, local), parts = self.components, self.field.dofs.shape, densities.shape[1]
        shapes = self._stacked[:, :, first : first + parts]
        matrix = (densities * self.weight[:, None, None, None, None]).transpose(0, 1, 2, 4, 3)
        points = shapes.shape[1]
        right = matrix.reshape(count, points, -1, parts) @ shapes
        left = shapes.reshape(count, points * parts, local).swapaxes(1, 2)
        whole = left @ right.reshape(count, points * parts, -1)
        whole = whole.reshape(count, local, m, m, local).swapaxes(3, 4)
        return np.asarray(whole.reshape(count, local * m, local * m))

    def _banded(self, matrices: Array) -> Array:
        """The lower triangles of matrices of the elements, as a lower band (width, size)."""
        i, j = self._pairs
        entries = matrices[:, i, j]
        flat = scatter(self._places, entries, self.width * self.size)
        return np.asarray(flat.reshape((self.width, self.size), order="F"))

    def clamped(self, q: Array) -> Array:
        """What holds directions, (size,)."""
        total = np.zeros(self.size)
        for clamp in self.clamps:
            total[clamp.unknowns] += clamp.matrix @ q[clamp.unknowns]
        return total

    def clamp(self, band: Array, share: float = 1.0) -> None:
        """Add a share of the stiffness of what holds directions to a lower band."""
        for clamp in self.clamps:
            for column, unknown in enumerate(clamp.unknowns):
                below = clamp.unknowns[column:]
                band[below - unknown, unknown] += share * clamp.matrix[column:, column]

    def internal(self, q: Array) -> Array:
        """Internal forces and what the seabed resists at q, (size,)."""
        self._strained = strained(*self.curve(q), self.axial, self.bending)
        total = self.forces(self._strained.gradient)
        total += self.clamped(q)
        if self.bed is not None:
            total += self.bed.internal(q)
        return total

    def _whole_tangent(self) -> Array:
        """Lower band of the tangent at the last `internal`, (width, size)."""
        band = self.band(self._strained.hessian)
        self.clamp(band)
        if self.bed is not None:
            self.bed.stiffen(band)
        return band

    def tangent(self) -> Array:
        """Lower band of the tangent at the last `internal`, (width, size); held ones apart."""
        return self.apart(self._whole_tangent())

    def apart(self, band: Array) -> Array:
        """A lower band with 1 for the held unknowns, which no other one feels."""
        apart: Array = without(band, self.held)
        apart[0, self.held] = 1.0
        return apart

    def led(self, move: Array) -> Array | None:
        """Move of all unknowns that a small move of the held ones asks for, (size,)."""
        band = self._whole_tangent()
        right = -band_times(band, move)
        right[self.held] = move[self.held]
        return self.solve_band(self.apart(band), right)

    @property
    def diagonal(self) -> Array:
        """Of the tangent at the last `internal`, (size,)."""
        return np.asarray(np.abs(self.tangent()[0]))

    def solve(self, right: Array) -> Array | None:
        """Solve with the tangent at the last `internal`; None where that cannot be done."""
        return self.solve_band(self.tangent(), right)

    def solve_band(self, band: Array, right: Array) -> Array | None:
        """Solve with a lower band.

        Where it is not positive definite, as of a line without tension, its diagonal is raised as
        little as makes it so: the energy still falls along the answer.
        """
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
