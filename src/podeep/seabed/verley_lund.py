"""Penetration of a pipe in clay by Verley and Lund."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.polyline import Values
from .law import SHALLOW, Range, SeabedLaw

_LOW, _HIGH = (0.062, 0.7), (0.0071, 3.2)  # factor and exponent of the two terms
_ITERATIONS = 6


@dataclass(frozen=True, eq=False, kw_only=True)
class VerleyLund(SeabedLaw):
    """Clay of Verley and Lund.

        z/D = 0.0071 t^3.2 + 0.062 t^0.7,   t = S G^0.3,   S = W/(D su),   G = su/(D g)

    undrained_shear_strength su, Pa; verley_lund_unit_weight g, N/m3: bulk in DNV-RP-F109 (from
    memory), effective in Bai 2001, which gives a third more penetration.
    Range: data up to t = 2.5, beyond which it gives too much penetration (Bai).
    Source: Verley and Lund 1995 as a public program and Bai 2001 chapter 5 have it. The dynamic
    stiffness of DeepLines' row was not found.
    """

    source: ClassVar[str] = "Verley and Lund 1995, by Bai 2001 and a public program"
    ranges: ClassVar[tuple[Range, ...]] = (
        SHALLOW,
        Range("S G^0.3", 2.5, "its data end there, beyond it gives too much penetration"),
    )

    undrained_shear_strength: Values
    verley_lund_unit_weight: Values

    @property
    def _force_at_one(self) -> Values:
        """W at t = 1, N/m."""
        D, su = self.diameter, self.undrained_shear_strength
        return D * su / np.divide(su, D * self.verley_lund_unit_weight) ** 0.3

    def _load(self, ratio: Array) -> tuple[Array, Array]:
        """t and d ln(z/D) / d ln t at z/D > 0.

        The logarithm of z/D is convex and rises in that of t. Either term alone gives a t that is
        too large, the lesser of both at most by a factor of 2.7: from there Newton's method comes
        down to the root without overshooting, in 5 steps to the last digit.
        """
        level = np.log(ratio)
        x = np.minimum(*((level - np.log(factor)) / power for factor, power in (_LOW, _HIGH)))
        rise = np.ones(ratio.shape)
        for _ in range(_ITERATIONS):
            low, high = (factor * np.exp(power * x) for factor, power in (_LOW, _HIGH))
            rise = (_LOW[1] * low + _HIGH[1] * high) / (low + high)
            x = x - (np.log(low + high) - level) / rise
        return np.exp(x), rise

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        u = np.asarray(u, dtype=float)
        pressed = u > 0.0
        z = np.where(pressed, u, self.diameter)
        t, rise = self._load(np.asarray(z / self.diameter))
        force = self._force_at_one * t
        return np.where(pressed, force, 0.0), np.where(pressed, force / (z * rise), 0.0)

    def _penetration(self, weight: Values) -> Array:
        t = np.divide(weight, self._force_at_one)
        return np.asarray(self.diameter * sum(factor * t**power for factor, power in (_LOW, _HIGH)))

    def measures(self, penetration: Values) -> Mapping[str, Array]:
        load = self.force(np.asarray(penetration)) / self._force_at_one
        return {**super().measures(penetration), "S G^0.3": load}
