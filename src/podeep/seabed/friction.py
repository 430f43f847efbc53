"""Coulomb's friction of a pipe on the seabed, axial and lateral, with elastic slip.

A spring of stiffness Kt joins the pipe to an anchor on the seabed. The anchor stays until the
spring's force comes to its limit; then it is dragged along (return mapping):

    trial   T = T0 + Kt s
    box     T_i <- clip(T_i, +-mu_i N), for each direction
    ellipse T <- T / max(1, sqrt((T_1/(mu_1 N))^2 + (T_2/(mu_2 N))^2))

s is the slip since the last commit, N the normal force. Nothing depends on velocity: a steady load
below the limit holds for ever.
"""

from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from ..lines import Surface
from ..soil.memory import Kept
from ..soil.polyline import Values
from .bounds import POSITIVE, within

_LEAST = 1e-150  # limit that counts as none, N/m: ratios to it would overflow


class Traction(NamedTuple):
    """Friction against the slip, (n, 2), N/m, and its derivatives.

    by_slip: to the slip, (n, 2, 2), row the force. by_normal: to the normal force, (n, 2); times
    dN/dz it is what couples friction to penetration, which makes a tangent non-symmetric.
    """

    force: Array
    by_slip: Array
    by_normal: Array


class Friction(Kept):
    """Friction at n points in the directions axial, lateral; see the formulas above.

    coefficient mu: (2,) or (n, 2), at least 0. One of
    threshold: slip at which friction reaches its limit, m: Kt = mu N/threshold, as in DeepLines;
    stiffness: Kt, N/m per metre of pipe (N/m at a node), the same whatever the normal force.
    surface: "box", directions checked each by itself, as DeepLines' theory page has it; or
    "ellipse", under which the anchor follows the spring along its own line. In a box of equal
    coefficients the resultant may reach sqrt(2) mu N, and does not point against the slip.

    Loading the contact moves no anchor and leaves the force as it is. With a threshold, unloading
    it makes the spring softer and the force smaller in proportion. So no change of the normal force
    gives energy; Kt = mu N/threshold at the present N on all of the spring's stretch would.

    An ellipse is met at the end of a step: within a step that turns away from its spring it is
    exact to the first order in the step. A box under a steady normal force is exact.

    Source: theory page of DeepLines; return mapping instead of its F = mu F_n u (derived).
    """

    kept: ClassVar[tuple[str, ...]] = ("force", "normal_force", "dissipated")

    def __init__(
        self,
        size: int,
        coefficient: Values,
        *,
        threshold: Values | None = None,
        stiffness: Values | None = None,
        surface: Surface = "box",
    ) -> None:
        spring = threshold if stiffness is None else stiffness
        if spring is None or (threshold is not None and stiffness is not None):
            raise InvalidData("friction takes a threshold or a stiffness, one of the two")
        name = "stiffness" if threshold is None else "threshold"
        within(f"{name} of friction", spring, POSITIVE)
        within("friction coefficient", coefficient, 0.0)
        if surface not in ("box", "ellipse"):
            raise InvalidData(f"friction over a {surface}", 'give "box" or "ellipse"')
        #: mu, and threshold or stiffness, (n, 2)
        self.coefficient: Array = np.ones((size, 2)) * coefficient
        self.spring: Array = np.ones((size, 2)) * spring
        self.softens, self.box = stiffness is None, surface == "box"
        self.force, self.normal_force = np.zeros((size, 2)), np.zeros(size)
        #: energy lost since the start, J/m (J), (n,)
        self.dissipated = np.zeros(size)

    # --- springs ----------------------------------------------------------------------------------

    def _stiffness(self, limit: Array) -> Array:
        return limit / self.spring if self.softens else self.spring

    def _carried(self, normal: Array) -> tuple[Array, Array]:
        """What the springs carry of the last force at the new normal force; its derivative."""
        if not self.softens:
            return self.force, np.zeros_like(self.force)
        before = self.normal_force
        less = (normal < before) & (before > _LEAST)
        share = np.divide(normal, before, out=np.ones_like(normal), where=less)
        slope = np.divide(1.0, before, out=np.zeros_like(normal), where=less)
        return self.force * share[..., None], self.force * slope[..., None]

    def _measured(self, trial: Array, limit: Array) -> tuple[Array, Array]:
        """A trial in units of its limit, and its size: of each direction, or of both together."""
        unit = np.divide(trial, limit, out=np.zeros_like(trial), where=limit > _LEAST)
        size = np.abs(unit)
        if not self.box:
            size = np.repeat(np.hypot(unit[..., :1], unit[..., 1:]), 2, axis=-1)
        return unit, size

    # --- the law ----------------------------------------------------------------------------------

    def evaluate(self, slip: Array, normal_force: Array) -> Traction:
        """Friction after slips (..., n, 2), m, since the last commit, under normal forces (..., n).

        A normal force below 0, as suction has it, carries none.
        """
        normal = np.maximum(normal_force, 0.0)
        limit = self.coefficient * normal[..., None]
        stiffness = self._stiffness(limit)
        carried, by_normal = self._carried(normal)
        trial = carried + stiffness * slip
        if self.softens:
            by_normal = by_normal + self.coefficient / self.spring * slip
        unit, size = self._measured(trial, limit)
        slides, bears = size > 1.0, limit > _LEAST
        size = np.where(slides, size, 1.0)
        force = np.where(bears, trial / size, 0.0)
        by_trial = np.zeros((*force.shape, 2))
        by_trial[..., [0, 1], [0, 1]] = np.where(bears & ~(slides & self.box), 1.0 / size, 0.0)
        if not self.box:  # the size grows with either trial
            towards = np.divide(
                unit / size, size * limit, out=np.zeros_like(unit), where=slides & bears
            )
            by_trial -= force[..., None] * towards[..., None, :]
        slope = (by_trial @ by_normal[..., None])[..., 0]
        slope += np.where(slides, self.coefficient * unit / size, 0.0)
        slope[normal_force < 0.0] = 0.0
        return Traction(force, by_trial * stiffness[..., None, :], slope)

    def commit(self, slip: Array, normal_force: Array) -> None:
        """The pipe has slipped so far, straight, while the normal force came to what it is."""
        normal = np.maximum(normal_force, 0.0)
        limit = self.coefficient * normal[:, None]
        carried, _ = self._carried(normal)
        force = self.evaluate(slip, normal_force).force
        lost = self._stored(self.force, self.coefficient * self.normal_force[:, None])
        lost -= self._stored(carried, limit)
        lost += np.where(
            limit > _LEAST,
            self._dragged(carried, slip, normal, force),
            self._stored(carried, limit),
        )
        self.dissipated = self.dissipated + lost.sum(axis=1)
        self.force, self.normal_force = force, normal

    def _stored(self, force: Array, limit: Array) -> Array:
        """Energy in each spring."""
        stiffness = self._stiffness(limit)
        return np.divide(0.5 * force**2, stiffness, out=np.zeros_like(force), where=stiffness > 0.0)

    def _dragged(self, carried: Array, slip: Array, normal: Array, force: Array) -> Array:
        """Work done on the anchors, by the mean of the forces where they start to move and end.

        They start where a trial that grows evenly meets a limit that changes evenly.
        """
        limit = self.coefficient * normal[:, None]
        stiffness = self._stiffness(limit)
        trial = carried + stiffness * slip
        unit, size = self._measured(trial, limit)
        start, _ = self._measured(carried, limit)
        along = start * unit / np.where(size > 0.0, size, 1.0)
        if not self.box:
            along = np.repeat(along.sum(axis=1)[:, None], 2, axis=1)
        before = np.where(self.normal_force > _LEAST, self.normal_force, 1.0)
        room = np.maximum(1.0 - along * (normal / before)[:, None], 0.0)
        over = np.maximum(size - 1.0, 0.0)
        share = np.divide(room, room + over, out=np.zeros_like(room), where=over > 0.0)
        meeting = along + share * (size - along)
        moved = np.divide(trial - force, stiffness, out=np.zeros_like(force), where=stiffness > 0.0)
        return np.asarray(0.5 * (1.0 + meeting) * force * moved)


def limit_pull(coefficient: Array, angle: Values, surface: Surface = "box") -> Array:
    """Pull that a pipe bears before it slides, over its normal force, at an angle from its axis.

    coefficient: (2,), axial and lateral, above 0; angle: rad.

        box      min(mu_1/|cos a|, mu_2/|sin a|)
        ellipse  1/sqrt((cos a/mu_1)^2 + (sin a/mu_2)^2)
    """
    first, second = np.abs(np.cos(angle)) / coefficient[0], np.abs(np.sin(angle)) / coefficient[1]
    if surface == "box":
        return np.asarray(1.0 / np.maximum(first, second))
    return np.asarray(1.0 / np.hypot(first, second))
