"""Models in which the force is a power of the penetration."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.polyline import Values
from .law import NONE, Range, SeabedLaw


@dataclass(frozen=True, eq=False, kw_only=True)
class Power(SeabedLaw):
    """W = c (z/D)^b."""

    exponent: ClassVar[float]

    @property
    @abstractmethod
    def force_at_diameter(self) -> Values:
        """c, the force at z = D, N/m."""

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        b, c, D = self.exponent, self.force_at_diameter, self.diameter
        u = np.asarray(u, dtype=float)
        ratio = np.maximum(u, 0.0) / D
        start = np.inf if b < 1.0 else float(b == 1.0)
        power = np.full(ratio.shape, start)
        np.power(ratio, b - 1.0, out=power, where=ratio > 0.0)
        return np.asarray(c * ratio**b), np.where(u < 0.0, 0.0, c / D * b * power)

    def _penetration(self, weight: Values) -> Array:
        return np.asarray(
            self.diameter * np.divide(weight, self.force_at_diameter) ** (1.0 / self.exponent)
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Dunlap(Power):
    """Soft clay of Dunlap and others.

        W = 7.32 D su (z/D)^0.64

    undrained_shear_strength su, Pa. Range: the one of the tests was not found; z/D up to about 1.
    Source: Dunlap et al. 1990, as an older page of DeepLines prints it. That page's
    dynamic stiffness was not found. (660 su, fitted by others to these tests, is a guess.)
    """

    source: ClassVar[str] = "Dunlap et al. 1990, by an older page of DeepLines"
    exponent: ClassVar[float] = 0.64
    ranges: ClassVar[tuple[Range, ...]] = (Range("z/D", 1.0, "the range of its tests is unknown"),)

    undrained_shear_strength: Values

    @property
    def force_at_diameter(self) -> Values:
        return 7.32 * self.diameter * self.undrained_shear_strength


@dataclass(frozen=True, eq=False, kw_only=True)
class VerleyLundLinear(Power):
    """Clay of Verley and Lund, their linear form.

        z/D = 0.09 S G^0.3,   S = W/(D su),   G = su/(D g)

    undrained_shear_strength su, Pa; verley_lund_unit_weight g, N/m3: bulk in DNV-RP-F109 (from
    memory), effective in Bai 2001. Range: any S G^0.3.
    Source: Verley and Lund 1995 as Bai 2001 chapter 5 prints it.
    """

    source: ClassVar[str] = "Verley and Lund 1995, by Bai 2001"
    exponent: ClassVar[float] = 1.0

    undrained_shear_strength: Values
    verley_lund_unit_weight: Values

    @property
    def force_at_diameter(self) -> Values:
        D, su = self.diameter, self.undrained_shear_strength
        return D * su / (0.09 * np.divide(su, D * self.verley_lund_unit_weight) ** 0.3)


@dataclass(frozen=True, eq=False, kw_only=True)
class VerleySotberg(Power):
    """Sand of Verley and Sotberg, without uplift.

        z/D = 0.037 (g' D^2 / W)^(-2/3)

    effective_unit_weight g', N/m3. Source: Verley and Sotberg 1994 as a public program has it;
    DNV-RP-F109 has the exponent 0.67 (from memory).
    """

    source: ClassVar[str] = "Verley and Sotberg 1994, by a public program"
    exponent: ClassVar[float] = 1.5
    no_dynamic: ClassVar[str] = NONE

    effective_unit_weight: Values

    @property
    def force_at_diameter(self) -> Values:
        weight = self.effective_unit_weight * np.square(self.diameter)
        return np.asarray(weight / 0.037**self.exponent)


@dataclass(frozen=True, eq=False, kw_only=True)
class NgiDrained(Power):
    """Drained sand of NGI.

        z/D = 0.09 (W / (g' D^2))^0.75

    effective_unit_weight g', N/m3. Source: NGI as a public program has it beside DNV-RP-F114.
    """

    source: ClassVar[str] = "NGI, by a public program"
    exponent: ClassVar[float] = 4.0 / 3.0
    no_dynamic: ClassVar[str] = NONE

    effective_unit_weight: Values

    @property
    def force_at_diameter(self) -> Values:
        return np.asarray(
            self.effective_unit_weight * np.square(self.diameter) / 0.09**self.exponent
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Direct(Power):
    """Stiffness that is given: W = KS z.

    given_static_stiffness KS, given_dynamic_stiffness KD, Pa (N/m per metre of pipe).
    """

    source: ClassVar[str] = "as given"
    exponent: ClassVar[float] = 1.0
    ranges: ClassVar[tuple[Range, ...]] = ()

    given_static_stiffness: Values
    given_dynamic_stiffness: Values

    @property
    def force_at_diameter(self) -> Values:
        return self.given_static_stiffness * self.diameter

    def dynamic_stiffness(self, penetration: Values) -> Array | None:
        return self.given_dynamic_stiffness + np.zeros(np.shape(penetration))
