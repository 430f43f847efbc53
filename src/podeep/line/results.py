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
    """A line in some states of statics."""

    system: LineSystem
    states: Sequence[LineState]

    def position(self, s: Array, derivative: int = 0) -> Array:
        """r, or a derivative d/ds of it, at distances s, (steps, n, components), m."""
        rows = self.system.field.interpolation(s, derivative)
        q = np.array([state.q for state in self.states])
        q = q.reshape(len(q), -1, self.system.components)
        return np.asarray(np.einsum("nk,snkm->snm", rows.shares, q[:, rows.dofs]))

    def _element(self, s: Array) -> Index:
        return self.system.field.elements(s)

    def force(self, s: Array) -> Array:
        """What the part beyond s pulls with on the part before it, (steps, n, components), N.

        From what holds end 1, the weight and the seabed: these are in balance in every element,
        whatever its stretch. Within an element it is a straight line.
        """
        edges = self.system.field.edges
        every = np.array([self._force_at_edges(state) for state in self.states])
        element = np.clip(edges.searchsorted(s, side="right") - 1, 0, len(edges) - 2)
        share = ((s - edges[element]) / np.diff(edges)[element])[:, None]
        return np.asarray(every[:, element] * (1.0 - share) + every[:, element + 1] * share)

    def _force_at_edges(self, state: LineState) -> Array:
        """The same at the ends of elements, (elements + 1, components)."""
        system = self.system
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

    def tension(self, s: Array) -> Array:
        """Effective tension along the line, (steps, n), N."""
        along = self.position(s, 1)
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        return np.asarray(np.einsum("snm,snm->sn", self.force(s), along))

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
        found = np.zeros((len(self.states), len(s), self.system.components))
        bed = self.system.bed
        if bed is not None:
            for step, state in enumerate(self.states):
                for component, values in enumerate(state.reaction.T):
                    found[step, :, component] = np.interp(s, bed.s, values)
        return found

    def touchdown(self) -> Array:
        """Distance at which the line first touches the seabed, seen from its second end, (steps,).

        0 where it touches nowhere, its length where the second end lies on the seabed.
        """
        field = self.system.field
        share = np.arange(_LOOKS) / _LOOKS
        s = (field.edges[:-1, None] + np.diff(field.edges)[:, None] * share).ravel()
        s = np.append(s, field.edges[-1])
        return np.array([_last(self, step, s) for step in range(len(self.states))])


def _last(results: LineResults, step: int, s: Array) -> float:
    one = LineResults(results.system, [results.states[step]])

    def depth(at: float) -> float:
        return float(one.penetration(np.array([at]))[0, 0])

    inside = np.flatnonzero(one.penetration(s)[0] > 0.0)
    if not len(inside):
        return 0.0
    last = int(inside[-1])
    if last == len(s) - 1:
        return float(s[-1])
    return float(brentq(depth, s[last], s[last + 1], xtol=1e-12))
