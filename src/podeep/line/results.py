"""What a line does at any unstretched distance from its first end."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ..arrays import Array, Index
from .equations import LineSystem

_LOOKS = 16  # places in each element at which the touchdown is looked for


@dataclass(frozen=True, eq=False)
class LineResults:
    """A line in some states, (steps, unknowns)."""

    system: LineSystem
    states: Array

    def position(self, s: Array, derivative: int = 0) -> Array:
        """r, or a derivative d/ds of it, at distances s, (steps, n, components), m."""
        rows = self.system.field.interpolation(s, derivative)
        q = self.states.reshape(len(self.states), -1, self.system.components)
        return np.asarray(np.einsum("nk,snkm->snm", rows.shares, q[:, rows.dofs]))

    def _element(self, s: Array) -> Index:
        return self.system.field.elements(s)

    def tension(self, s: Array) -> Array:
        """Effective tension along the line, (steps, n), N."""
        stretch = np.linalg.norm(self.position(s, 1), axis=-1) - 1.0
        return np.asarray(self.system.sections.axial[self._element(s)] * stretch)

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
        """Into the seabed, positive downwards, (steps, n), m."""
        return -self.position(s)[..., -1]

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
    one = LineResults(results.system, results.states[step : step + 1])

    def depth(at: float) -> float:
        return float(one.penetration(np.array([at]))[0, 0])

    inside = np.flatnonzero(one.penetration(s)[0] > 0.0)
    if not len(inside):
        return 0.0
    last = int(inside[-1])
    if last == len(s) - 1:
        return float(s[-1])
    return float(brentq(depth, s[last], s[last + 1], xtol=1e-12))
