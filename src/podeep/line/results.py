"""What a line does at any unstretched distance from its first end."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ..arrays import Array, Index
from .equations import LineSystem
from .statics import LineState

_LOOKS = 16  # places in each element at which the touchdown is looked for


@dataclass(frozen=True, eq=False)
class LineResults:
    """A line in some states.

    q: unknowns, (steps, size). resisted: what the seabed resists with at its points, (steps,
    points, components), N/m. pulls: forces at the ends of elements, (steps, elements + 1,
    components), N; None where inertia has a share in them.
    """

    system: LineSystem
    q: Array
    resisted: Array
    pulls: Array | None = None

    @classmethod
    def of(cls, system: LineSystem, states: Sequence[LineState]) -> "LineResults":
        """In states of statics."""
        resisted = np.array([state.reaction for state in states])
        pulls = np.array([_force_at_edges(system, state) for state in states])
        return cls(system, np.array([state.q for state in states]), resisted, pulls)

    def position(self, s: Array, derivative: int = 0) -> Array:
        """r, or a derivative d/ds of it, at distances s, (steps, n, components), m."""
        rows = self.system.field.interpolation(s, derivative)
        q = self.q.reshape(len(self.q), -1, self.system.components)
        return np.asarray(np.einsum("nk,snkm->snm", rows.shares, q[:, rows.dofs]))

    def _element(self, s: Array) -> Index:
        return self.system.field.elements(s)

    def tension(self, s: Array) -> Array:
        """Effective tension along the line, (steps, n), N.

        In statics from what holds end 1, the weight and the seabed: these are in balance in every
        element, whatever its stretch, and their sum is a straight line in it. In motion from the
        stretch.
        """
        along = self.position(s, 1)
        length = np.linalg.norm(along, axis=-1)
        if self.pulls is None:
            return np.asarray(self.system.sections.axial[self._element(s)] * (length - 1.0))
        edges = self.system.field.edges
        element = np.clip(edges.searchsorted(s, side="right") - 1, 0, len(edges) - 2)
        share = ((s - edges[element]) / np.diff(edges)[element])[:, None]
        pull = self.pulls[:, element] * (1.0 - share) + self.pulls[:, element + 1] * share
        return np.asarray(np.einsum("snm,snm->sn", pull, along / length[..., None]))

    def moment(self, s: Array) -> Array:
        """Bending moment, (steps, n), N m: positive sagging in a plane, its size in space."""
        a, b = self.position(s, 1), self.position(s, 2)
        A = np.einsum("snm,snm->sn", a, a)
        if self.system.components == 2:
            turning = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
        else:
            turning = np.linalg.norm(np.cross(a, b), axis=-1)
        return np.asarray(self.system.sections.bending[self._element(s)] * turning / A)

    def penetration(self, s: Array) -> Array:
        """Of the line's axis into the seabed, positive downwards, (steps, n), m."""
        level = -np.inf if self.system.bed is None else self.system.bed.level
        return np.asarray(level - self.position(s)[..., -1])

    def reaction(self, s: Array) -> Array:
        """What the seabed resists with, (steps, n, components), N/m; straight between points."""
        bed = self.system.bed
        if bed is None:
            return np.zeros((len(self.q), len(s), self.system.components))
        after = np.clip(bed.s.searchsorted(s), 1, len(bed.s) - 1)
        share = np.clip((s - bed.s[after - 1]) / np.diff(bed.s)[after - 1], 0.0, 1.0)[:, None]
        before, behind = self.resisted[:, after - 1], self.resisted[:, after]
        return np.asarray(before * (1.0 - share) + behind * share)

    def touchdown(self) -> Array:
        """Distance at which the line first touches the seabed, seen from its second end, (steps,).

        0 where it touches nowhere, its length where the second end lies on the seabed.
        """
        field = self.system.field
        share = np.arange(_LOOKS) / _LOOKS
        s = (field.edges[:-1, None] + np.diff(field.edges)[:, None] * share).ravel()
        s = np.append(s, field.edges[-1])
        deep = self.penetration(s)
        return np.array([self._last(step, s, depths) for step, depths in enumerate(deep)])

    def _last(self, step: int, s: Array, depths: Array) -> float:
        """The last place of s that touches in a step, and how far beyond it the line does, m."""
        inside = np.flatnonzero(depths > 0.0)
        if not len(inside):
            return 0.0
        last = int(inside[-1])
        if last == len(s) - 1:
            return float(s[-1])
        one = LineResults(self.system, self.q[step : step + 1], self.resisted[:0])

        def depth(at: float) -> float:
            return float(one.penetration(np.array([at]))[0, 0])

        return float(brentq(depth, s[last], s[last + 1], xtol=1e-12))


def _force_at_edges(system: LineSystem, state: LineState) -> Array:
    """What the part beyond pulls with at the ends of elements, (elements + 1, components), N."""
    edges, m = system.field.edges, system.components
    load = np.zeros((len(edges), m))
    load[1:, -1] = -state.load * system.sections.weight * np.diff(edges)
    for unknown, force in zip(system.held, state.forces, strict=True):
        if unknown < m:
            load[0, unknown] += force
    if system.bed is not None:
        pushed = -system.bed.weight[:, None] * state.reaction
        np.add.at(load, np.clip(edges.searchsorted(system.bed.s), 0, len(edges) - 1), pushed)
    return -np.cumsum(load, axis=0)
