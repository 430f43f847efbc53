"""The seabed under a line: normal reaction and friction at points of it; the seabed is level.

Points are the Gauss points of the elements (the reaction is integrated along them), or their ends,
each with the length of line that belongs to it (concentrated at the nodes, as DeepLines has it).
"""

import numpy as np

from ..arrays import Array
from ..beam.band import band_place, pairs, scatter
from ..beam.field import Field
from ..beam.shapes import gauss_points
from ..scene import Form
from ..seabed.friction import Friction
from ..soil.memory import Backbone, Memory

_POINTS = 4  # more than the degree: the reaction has a corner where a line touches down


def contact_points(field: Field, form: Form) -> tuple[Array, Array]:
    """Arcs at which a line meets the seabed, and the length of each, m."""
    if form == "nodal":
        length = np.diff(field.edges)
        share = np.zeros(len(field.edges))
        share[:-1] += 0.5 * length
        share[1:] += 0.5 * length
        return field.edges, share
    xi, weight = gauss_points(field.degree + _POINTS)
    s = field.edges[:-1, None] + 0.5 * np.diff(field.edges)[:, None] * (xi + 1.0)
    return s.ravel(), (0.5 * np.diff(field.edges)[:, None] * weight).ravel()


class Bed:
    """What the seabed does to a line.

    normal: force per length against penetration, N/m, with or without a memory; friction: with as
    many points, or None. s, weight: `contact_points`. level: elevation of the line's axis where it
    just touches the seabed, m.

    Friction acts along the horizontal tangent of the last `commit` and across it, under the normal
    force `pressing`, N/m: with that fixed it has an energy, and the tangent is symmetric. `press`
    brings it up to where an iteration has ended.
    """

    def __init__(
        self,
        field: Field,
        components: int,
        places: tuple[Array, Array],
        normal: Backbone,
        friction: Friction | None = None,
        level: float = 0.0,
    ) -> None:
        (self.s, self.weight), self.level = places, level
        self.normal, self.friction, self.components = normal, friction, components
        rows = field.interpolation(self.s, 0)
        slopes = field.interpolation(self.s, 1)
        self._shares, self._slopes = rows.shares, slopes.shares
        m = components
        self._dofs = rows.dofs[:, :, None] * m + np.arange(m)
        self.size = field.size * m
        flat = self._dofs.reshape(len(self.s), -1)
        self._pairs = pairs(flat)
        self.pressing = np.zeros(len(self.s))
        self._begun: Array | None = None
        self._along: Array = np.zeros((len(self.s), m - 1))

    def places(self, q: Array) -> Array:
        """Positions of the points, (n, m)."""
        return np.asarray(np.einsum("nl,nlm->nm", self._shares, q[self._dofs]))

    def penetration(self, q: Array) -> Array:
        """Of the points, m."""
        return self.level - self.places(q)[:, -1]

    def internal(self, q: Array) -> Array:
        """What the seabed resists with, (size,), N."""
        place = self.places(q)
        normal, self._stiffness = self.normal.evaluate(self.level - place[:, -1])
        force = np.zeros_like(place)
        force[:, -1] = -normal
        self._dragged = np.zeros((len(self.s), self.components - 1, self.components - 1))
        if self.friction is not None and self._begun is not None:
            traction = self.friction.evaluate(self._slip(place), self.pressing)
            turn = self._turn
            force[:, :-1] = np.einsum("nd,ndi->ni", traction.force, turn)
            self._dragged = np.einsum("nde,ndi,nej->nij", traction.by_slip, turn, turn)
        self.reaction = force
        own = self._shares[:, :, None] * (self.weight[:, None] * force)[:, None, :]
        return scatter(self._dofs, own, self.size)

    def stiffen(self, band: Array) -> None:
        """Add the tangent at the last `internal` to a lower band, (width, size)."""
        m, width = self.components, band.shape[0]
        acts = np.flatnonzero((self._stiffness != 0.0) | self._dragged.any(axis=(1, 2)))
        if not len(acts):  # most of a line hangs
            return
        matrix = np.zeros((len(acts), m, m))
        matrix[:, -1, -1] = self._stiffness[acts]
        dragged = self._dragged[acts]
        matrix[:, :-1, :-1] += 0.5 * (dragged + np.swapaxes(dragged, 1, 2))
        matrix *= self.weight[acts, None, None]
        shares = self._shares[acts]
        own = np.einsum("nl,nij,nk->nlikj", shares, matrix, shares, optimize=True)
        count = shares.shape[1] * m
        i, j, rows, columns = self._pairs
        entries = own.reshape(len(acts), count, count)[:, i, j]
        place = band_place(rows[acts], columns[acts], width)
        band += scatter(place, entries, band.size).reshape(band.shape, order="F")

    @property
    def total(self) -> float:
        """Magnitudes of the normal reaction at the last `internal`, added up, N."""
        return float(self.weight @ np.abs(self.reaction[:, -1]))

    @property
    def _turn(self) -> Array:
        """Unit vectors of axial and lateral friction in the horizontal plane, (n, 2, m - 1)."""
        along = self._along
        if along.shape[1] == 1:
            return np.stack([along, np.zeros_like(along)], axis=1)
        return np.stack([along, np.stack([-along[:, 1], along[:, 0]], axis=1)], axis=1)

    def press(self) -> float:
        """Take the normal force of the last `internal` for friction; by how much that changes, N.

        The change is that of the largest friction at any point.
        """
        if self.friction is None:
            return 0.0
        now = np.maximum(-self.reaction[:, -1], 0.0)
        change = self.friction.coefficient.max(axis=1) * self.weight * np.abs(now - self.pressing)
        self.pressing = now
        return float(change.max())

    def _slip(self, place: Array) -> Array:
        """Axial and lateral way since the last commit, (n, 2), m."""
        assert self._begun is not None
        return np.asarray(np.einsum("ni,ndi->nd", place[:, :-1] - self._begun, self._turn))

    def commit(self, q: Array) -> None:
        """The line has come to q: anchors follow, and directions are those of the line there."""
        place = self.places(q)
        if self.friction is not None:
            slip = np.zeros((len(self.s), 2)) if self._begun is None else self._slip(place)
            self.friction.commit(slip, self.pressing)
        if isinstance(self.normal, Memory):
            self.normal.commit(self.level - place[:, -1])
        slope = np.einsum("nl,nlm->nm", self._slopes, q[self._dofs])[:, :-1]
        size = np.linalg.norm(slope, axis=1, keepdims=True)
        upright = np.zeros_like(slope)
        upright[:, 0] = 1.0
        self._along = np.where(size > 1e-9, slope / np.maximum(size, 1e-9), upright)
        self._begun = place[:, :-1].copy()
