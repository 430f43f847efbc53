"""Contact of a tube with one inside it: what resists their relative motion.

The relative deflection d of two concentric tubes is free within the clearance c. Beyond it a
normal force per length presses them apart, smooth over the tolerance e, as on the seabed:

    F = k (d - c)^2 / (2 e)      for 0 < d - c <= e
    F = k (d - c - e / 2)        beyond

Coulomb's friction resists the relative stretch v with mu F, reached at a threshold vs:

    T = mu F clip(v / vs, -1, 1)

It remembers no slip: as the other reactions in statics it follows the state, not the way there.
"""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ..arrays import Array, Index
from ..seabed.normal import rounded
from ..soil.law import Law
from ..soil.reaction import Reaction, Term


@dataclass(frozen=True, eq=False)
class Gap(Law):
    """Normal force per length, N/m; stiffness N/m2 and clearance m, (n,) each; tolerance m."""

    source: ClassVar[str] = "contact of a tube inside a tube, by penalty"

    contact_stiffness: Array
    clearance: Array
    tolerance: float

    def at(self, places: Index) -> "Gap":
        """The same law at some of its points, in any order."""
        return replace(
            self,
            contact_stiffness=self.contact_stiffness[places],
            clearance=self.clearance[places],
        )

    @property
    def capacity(self) -> Array:
        return np.full(len(self.clearance), np.inf)

    @property
    def corners(self) -> Array:
        return np.stack([self.clearance, self.clearance + self.tolerance])

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        depth, slope = rounded(np.abs(u) - self.clearance, self.tolerance)
        return np.copysign(self.contact_stiffness * depth, u), self.contact_stiffness * slope


@dataclass(frozen=True, eq=False)
class Friction(Law):
    """Friction per length, N/m, of tubes that a normal force presses together.

    coefficient: mu. normal: the law of the normal force at the same points. threshold: relative
    displacement at which the friction reaches its limit, m. limit: mu F, N/m, (n,).
    """

    source: ClassVar[str] = "Coulomb's friction of a tube inside a tube"

    coefficient: float
    normal: Gap
    threshold: float
    limit: Array

    def pressed(self, distance: Array) -> "Friction":
        """The same where the tubes' axes stand apart, (n,), m."""
        return replace(self, limit=self.coefficient * np.abs(self.normal.force(distance)))

    @property
    def capacity(self) -> Array:
        return self.limit

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        share = u / self.threshold
        slope = np.where(np.abs(share) < 1.0, self.limit / self.threshold, 0.0)
        return self.limit * np.clip(share, -1.0, 1.0), slope


def reaction(law: Gap | Friction) -> Reaction:
    """A contact law as the reaction at its points."""
    n = len(law.capacity)
    return Reaction(n, (Term(np.arange(n), None, law, "contact", ()),))
