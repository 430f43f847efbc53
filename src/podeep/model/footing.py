"""A spudcan under a tip: three springs, and a surface that its loads stay within."""

from dataclasses import dataclass
from math import hypot

import numpy as np

from ..arrays import Array
from ..scene import Spudcan
from ..soil.spudcan import Stiffness, elastic_stiffness
from ..soil.spudcan_yield import YieldSurface
from .system import System


@dataclass(frozen=True)
class Footing:
    """stiffness: elastic, N/m and N m/rad. surface: None where the spudcan stays elastic.

    tube: number of the tube that it stands under.
    """

    stiffness: Stiffness
    surface: YieldSurface | None
    tube: int

    def vertical(self, axial: System, q: Array) -> float:
        """Vertical load on the spudcan, positive down, N."""
        settlement = axial.field.interpolation(axial.field.edges[-1:], tube=self.tube) @ q
        return float(self.stiffness.vertical * settlement[0])

    def across(self, lateral: System, q: Array) -> tuple[float, float]:
        """Horizontal load (N) and moment (N m) on the spudcan, magnitudes."""
        tip, unknowns = lateral.field.edges[-1:], q.reshape(-1, lateral.components)
        shift = hypot(*(lateral.field.interpolation(tip, tube=self.tube) @ unknowns)[0])
        turn = hypot(*(lateral.field.rotation(tip, self.tube) @ unknowns)[0])
        moment = self.stiffness.rotational * lateral.softening * turn
        return float(self.stiffness.horizontal * shift), float(moment)


def footing(spudcan: Spudcan, tube: int = 0) -> Footing:
    """The springs and the yield surface of a spudcan under a tube, by its number.

    Raises InvalidData as its formulas do.
    """
    factors = (spudcan.vertical_factor, spudcan.horizontal_factor, spudcan.rotational_factor)
    stiffness = elastic_stiffness(
        spudcan.shear_modulus, spudcan.poisson_ratio, 0.5 * spudcan.diameter, factors
    )
    elastic = Stiffness(*(np.asarray(k) for k in stiffness))
    return Footing(elastic, yield_surface(spudcan), tube)


def yield_surface(spudcan: Spudcan) -> YieldSurface | None:
    """The surface that a preload sets; None without one."""
    preload = spudcan.preload
    if preload is None:
        return None
    if spudcan.soil == "SAND":
        return YieldSurface.for_sand(preload, spudcan.diameter)
    strength = spudcan.undrained_shear_strength or 0.0
    return YieldSurface.for_clay(
        preload,
        spudcan.diameter,
        strength,
        strength if spudcan.tip_shear_strength is None else spudcan.tip_shear_strength,
        spudcan.lateral_area,
        spudcan.embedment,
    )
