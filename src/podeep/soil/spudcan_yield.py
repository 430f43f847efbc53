"""Loads that a preloaded spudcan can carry together, by ISO 19905-1; symbols as `spudcan`."""

from dataclasses import dataclass
from math import pi

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .polyline import Values
from .spudcan import require_positive
from .spudcan_bearing import DEEP


@dataclass(frozen=True)
class YieldSurface:
    """Vertical, horizontal and moment loads that a preloaded spudcan can carry together.

        F = (H/QH)^2 + (M/QM)^2 - 16 (1 - a) v^2 (1 - v)^2 - 4 a v (1 - v),   v = V/QV
        rf = sqrt( ((H/QH)^2 + (M/QM)^2) / (16 (1 - a) v^2 (1 - v)^2 + 4 a v (1 - v)) )
        fr = sqrt(1 - rf) + 0.1 e^(100 (rf - 1))   up to rf = 1

    Inside F < 0 and rf < 1. The rotational stiffness becomes fr K3; K1 and K2 stay.
    vertical_capacity QV (N, preload), horizontal_capacity QH (N), moment_capacity QM (N m),
    embedment a (-). V is positive down; H and M are resultants of either sign.
    Outside 0 < V < QV nothing can be carried: rf is infinite, and v^2 (1 - v)^2, whose printed
    square would be positive again, takes the sign of v (1 - v) so that F >= 0.

    Source: ISO 19905-1 A.9.3.3, A.9.3.4, SNAME T&R 5-5A 6.3.4; all from memory, QH, QM and a too.
    ISO's hyperbolic fr of clay is not public: this one is of sand. SNAME's suction is left out.
    """

    vertical_capacity: float
    horizontal_capacity: float
    moment_capacity: float
    embedment: float = 0.0

    def __post_init__(self) -> None:
        require_positive("vertical capacity", self.vertical_capacity, "V_PRELOAD")
        require_positive("horizontal capacity", self.horizontal_capacity, "QH")
        require_positive("moment capacity", self.moment_capacity, "QM")
        if not 0.0 <= self.embedment <= 1.0:
            remedy = "it is Dp/(2.5 B) in clay, at most 1, and 0 in sand"
            raise InvalidData("the embedment a is not between 0 and 1", remedy, "EMBED")

    @classmethod
    def for_sand(cls, vertical_capacity: float, diameter: float) -> "YieldSurface":
        """QH = 0.12 QV, QM = 0.075 B QV, a = 0."""
        Q = vertical_capacity
        return cls(Q, 0.12 * Q, 0.075 * diameter * Q)

    @classmethod
    def for_clay(
        cls,
        vertical_capacity: float,
        diameter: float,
        undrained_shear_strength: float,
        tip_shear_strength: float,
        lateral_area: float,
        depth: float,
        area: float | None = None,
    ) -> "YieldSurface":
        """QH = su0 A + (su0 + su1) As, QM = 0.1 B QV, a = Dp/(2.5 B), at most 1.

        su0 and su1 (Pa): undrained_shear_strength at the largest bearing area, tip_shear_strength
        at the tip; lateral_area As (m2): embedded, projected sideways; area A: None is pi B^2/4.
        """
        require_positive("diameter", diameter, "B")
        A = 0.25 * pi * diameter**2 if area is None else area
        QH = undrained_shear_strength * (A + lateral_area) + tip_shear_strength * lateral_area
        deep = min(max(depth, 0.0) / (DEEP * diameter), 1.0)
        return cls(vertical_capacity, QH, 0.1 * diameter * vertical_capacity, deep)

    def _room(self, V: Values) -> Array:
        """What V leaves for (H/QH)^2 + (M/QM)^2; negative outside 0 < V < QV."""
        v, a = np.divide(V, self.vertical_capacity), self.embedment
        parabola = v * (1.0 - v)
        return np.asarray(parabola * (16.0 * (1.0 - a) * np.abs(parabola) + 4.0 * a))

    def _taken(self, H: Values, M: Values) -> Array:
        shear, moment = np.divide(H, self.horizontal_capacity), np.divide(M, self.moment_capacity)
        return np.asarray(np.square(shear) + np.square(moment))

    def value(self, V: Values, H: Values, M: Values) -> Array:
        """F."""
        return np.asarray(self._taken(H, M) - self._room(V))

    def utilisation(self, V: Values, H: Values, M: Values) -> Array:
        """rf; infinite outside 0 < V < QV, whatever H and M."""
        taken, room = np.broadcast_arrays(self._taken(H, M), self._room(V))
        square = np.full(taken.shape, np.inf)
        with np.errstate(over="ignore"):  # hardly any room: infinite is the answer
            np.divide(taken, room, out=square, where=room > 0.0)
        return np.asarray(np.sqrt(square))

    @staticmethod
    def reduction(failure_ratio: Values) -> Array:
        """fr at rf up to 1, and 0 beyond.

        It falls all the way, from 1 at rf = 0 to 0.1 at rf = 1: the root's slope outweighs the
        exponential's everywhere, least at rf = 0.995 (fr = 0.131) with 1.17 times.
        """
        inside = 1.0 - np.minimum(failure_ratio, 1.0)
        reduced = np.sqrt(inside) + 0.1 * np.exp(-100.0 * inside)
        return np.where(np.less_equal(failure_ratio, 1.0), reduced, 0.0)


def target_factor(surface: YieldSurface, V: float, H: float, M: float) -> float:
    """The share of K3 that loads found with a share kappa ask for: fr, and 0 outside the surface.

    It never rises with M, nor M falls with kappa: kappa - target changes sign once in 0..1. There
    is the answer, also in the jump at rf = 1, where any share up to 0.1 keeps the loads on F = 0.
    Bracket it: putting the target in for kappa, again and again, need not converge.
    """
    return float(surface.reduction(surface.utilisation(V, H, M)))


def moment_limit(surface: YieldSurface, V: float, H: float) -> float:
    """The moment (N m) at which F = 0; 0 where V or H alone is already too much."""
    return surface.moment_capacity * float(np.sqrt(np.maximum(-surface.value(V, H, 0.0), 0.0)))
