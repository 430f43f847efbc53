"""The seabed under a line: normal reaction and friction at points of it; the seabed is level.

Points are the Gauss points of the elements (the reaction is integrated along them), or their ends,
each with the length of line that belongs to it (concentrated at the nodes, as DeepLines has it).

In statics the seabed is asked at an end of the way since the last commit; in a step of time it is
asked for the mean of its forces on that way, which gives back what it has stored and no more.
"""

from collections.abc import Mapping

import numpy as np

from ..arrays import Array
from ..beam.band import band_place, bandwidth, pairs, scatter
from ..beam.field import Field
from ..beam.shapes import gauss_points
from ..scene import Form
from ..seabed.friction import Friction
from ..seabed.normal import OneSided, Winkler, mean_force
from ..seabed.suction import Suction
from ..soil.memory import Kept, nested, unnested

_POINTS = 4  # more than the degree: the reaction has a corner where a line touches down
#: places on the way of a step where what has a memory is asked, and their shares of the mean
_SHARES, _WEIGHTS = (0.5 + 0.5 * gauss_points(3)[0], 0.5 * gauss_points(3)[1])


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
        normal: Winkler | OneSided | Suction,
        friction: Friction | None = None,
        level: float = 0.0,
    ) -> None:
        (self.s, self.weight), self.level = places, level
        self.normal, self.friction, self.components = normal, friction, components
        values, slopes = (field.interpolation(self.s, derivative) for derivative in (0, 1))
        m = components
        # points of an element stand together: they feel the same unknowns
        together = len(self.s) // len(field.lengths) if len(self.s) > len(field.edges) else 1
        shape = (-1, together, values.dofs.shape[1])
        self._shares, self._slopes = values.shares.reshape(shape), slopes.shares.reshape(shape)
        self._dofs = values.dofs[::together, :, None] * m + np.arange(m)
        self.size = field.size * m
        flat = self._dofs.reshape(len(self._dofs), -1)
        i, j, rows, columns = pairs(flat)
        self._pairs, self._places = (i, j), band_place(rows, columns, bandwidth(flat))
        self.pressing = np.zeros(len(self.s))
        self._begun: Array | None = None
        self._along: Array = np.zeros((len(self.s), m - 1))

    def places(self, q: Array) -> Array:
        """Positions of the points, (n, m)."""
        return self._values(self._shares, q)

    def _values(self, shares: Array, q: Array) -> Array:
        """What shares of the unknowns make at the points, (n, m)."""
        return np.asarray(np.matmul(shares, q[self._dofs]).reshape(-1, self.components))

    def penetration(self, q: Array) -> Array:
        """Of the points, m."""
        return self.level - self.places(q)[:, -1]

    def internal(self, q: Array) -> Array:
        """What the seabed resists with at q, (size,), N."""
        place = self.places(q)
        normal, self._stiffness = self.normal.evaluate(self.level - place[:, -1])
        self._start(place, normal)
        if self.friction is not None and self._begun is not None:
            traction = self.friction.evaluate(self._slip(place), self.pressing)
            self._drag(traction.force, traction.by_slip)
        return self._spread()

    def mean(self, q: Array) -> Array:
        """Mean of what the seabed resists with on the way from the last commit to q, (size,), N.

        `stiffen` takes its derivatives to q. Friction is that under the normal force of its moment.
        """
        assert self._begun is not None
        place = self.places(q)
        start, end = self.level - self._begun[:, -1], self.level - place[:, -1]
        pressed = slope = np.zeros((len(_SHARES), len(start)))
        if isinstance(self.normal, Suction) or self.friction is not None:
            pressed, slope = self.normal.evaluate(start + _SHARES[:, None] * (end - start))
        if isinstance(self.normal, Suction):
            normal, self._stiffness = _WEIGHTS @ pressed, (_WEIGHTS * _SHARES) @ slope
        else:
            normal, self._stiffness = mean_force(self.normal, start, end)
        self._start(place, normal)
        if self.friction is not None:
            traction = self.friction.evaluate(_SHARES[:, None, None] * self._slip(place), pressed)
            by_slip = np.tensordot(_WEIGHTS * _SHARES, traction.by_slip, 1)
            self._drag(np.tensordot(_WEIGHTS, traction.force, 1), by_slip)
        return self._spread()

    def _start(self, place: Array, normal: Array) -> None:
        """The normal reaction, without friction as yet."""
        flat = self.components - 1
        self.reaction = np.zeros_like(place)
        self.reaction[:, -1] = -normal
        self._dragged = np.zeros((len(self.s), flat, flat))

    def _drag(self, force: Array, by_slip: Array) -> None:
        """Add friction, (n, 2), and its derivative, (n, 2, 2), along and across the line."""
        turn = self._turn
        self.reaction[:, :-1] += np.einsum("nd,ndi->ni", force, turn)
        self._dragged += np.einsum("nde,ndi,nej->nij", by_slip, turn, turn)

    def _spread(self) -> Array:
        """The reaction as forces on the unknowns, (size,), N."""
        force = (self.weight[:, None] * self.reaction).reshape(*self._shares.shape[:2], -1)
        return scatter(self._dofs, np.matmul(np.swapaxes(self._shares, 1, 2), force), self.size)

    def stiffen(self, band: Array) -> None:
        """Add the tangent at the last `internal` to a lower band, (width, size)."""
        m, (groups, together, local) = self.components, self._shares.shape
        matrix = np.zeros((len(self.s), m, m))
        matrix[:, -1, -1] = self._stiffness
        matrix[:, :-1, :-1] = 0.5 * (self._dragged + np.swapaxes(self._dragged, 1, 2))
        matrix *= self.weight[:, None, None]
        each = matrix.reshape(groups, together, m, m)
        acts = np.flatnonzero(each.any(axis=(1, 2, 3)))
        if not len(acts):  # most of a line hangs
            return
        shares = self._shares[acts]
        right = each[acts].reshape(len(acts), together, m * m, 1) * shares[:, :, None]
        own = shares.swapaxes(1, 2) @ right.reshape(len(acts), together, -1)
        own = own.reshape(len(acts), local, m, m, local).swapaxes(3, 4)
        i, j = self._pairs
        entries = own.reshape(len(acts), local * m, local * m)[:, i, j]
        band += scatter(self._places[acts], entries, band.size).reshape(band.shape, order="F")

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
        return np.asarray(np.einsum("ni,ndi->nd", (place - self._begun)[:, :-1], self._turn))

    def commit(self, q: Array, time: float = 0.0) -> None:
        """The line has come to q: anchors follow, and directions are those of the line there.

        time: that it took, s; 0 in statics. Then friction is that under the normal force of q.
        """
        place = self.places(q)
        if self.friction is not None:
            if time > 0.0:
                self.pressing = np.maximum(self.normal.evaluate(self.level - place[:, -1])[0], 0.0)
            slip = np.zeros((len(self.s), 2)) if self._begun is None else self._slip(place)
            self.friction.commit(slip, self.pressing)
        if isinstance(self.normal, Suction):
            self.normal.commit(self.level - place[:, -1], time)
        self._stand(q, place)

    def _stand(self, q: Array, place: Array) -> None:
        """The next way begins at q."""
        slope = self._values(self._slopes, q)[:, :-1]
        size = np.linalg.norm(slope, axis=1, keepdims=True)
        upright = np.zeros_like(slope)
        upright[:, 0] = 1.0
        self._along = np.where(size > 1e-9, slope / np.maximum(size, 1e-9), upright)
        self._begun = place

    def standing(self) -> Array:
        """What it resists with where the last `commit` has left it, (points, components), N/m."""
        assert self._begun is not None
        self._start(self._begun, self.normal.evaluate(self.level - self._begun[:, -1])[0])
        if self.friction is not None:
            self._drag(self.friction.force, np.zeros((len(self.s), 2, 2)))
        return self.reaction

    def state(self) -> dict[str, Array]:
        """All that the way has left, as copies."""
        found = {"pressing": self.pressing.copy()}
        for name, part in {"normal": self.normal, "friction": self.friction}.items():
            if isinstance(part, Kept):
                found |= nested(name, part)
        return found

    def restore(self, state: Mapping[str, Array], q: Array) -> None:
        """Go back to a `state`, which was that of the unknowns q."""
        self.pressing = np.array(state["pressing"])
        for name, part in {"normal": self.normal, "friction": self.friction}.items():
            if isinstance(part, Kept):
                part.restore(unnested(name, state))
        self._stand(q, self.places(q))

    @property
    def dissipated(self) -> float:
        """What the seabed has lost so far, J."""
        lost = 0.0 if self.friction is None else float(self.weight @ self.friction.dissipated)
        if isinstance(self.normal, Suction):
            lost += float(self.weight @ self.normal.dissipated)
        return lost
