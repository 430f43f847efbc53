"""Lateral reaction (p-y) of weak rock."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .initial_line import below_line
from .law import Law
from .polyline import Values

_PLATEAU = 16.0  # y/yrm from which the law is constant
_LEAST = 1e-200  # y/yrm that keeps the fourth root's slope finite, far under the initial line


@dataclass(frozen=True, eq=False, kw_only=True)
class WeakRock(Law):
    """Weak rock of Reese.

        ar = 1 - (2/3) RQD
        pur = min( ar qu D (1 + 1.4 xr/D) , 5.2 ar qu D )
        Kir = min( 100 + 400 xr / (3 D) , 500 ) Eir
        yrm = krm D ,  yA = ( pur / (2 yrm^(1/4) Kir) )^(4/3)

        p = Kir y up to y = yA
        p = (pur/2) (y/yrm)^(1/4) from there up to y = 16 yrm, then p = pur

    The line meets the fourth root at yA, so p is the smallest of line, root and pur, and that is
    what is evaluated. Of a rock so soft for its strength that yA > 16 yrm, the printed law would
    pass pur; here the line is followed up to pur, at y = pur/Kir, and the root not at all. `y_A`
    in what is derived is the end of the line in both cases. Where qu or Eir is 0, p is 0.

    depth_in_rock xr (m below the rock's surface), diameter D (m), compressive_strength qu (Pa,
    uniaxial, intact), rock_mass_modulus Eir (Pa), rock_quality_designation RQD (share, 0 to
    1), strain_rm krm (-), multiplier (-, on p at the same y, group effects). p in N/m.

    Range: qu 0.5 to 5 MPa, krm 5e-5 to 5e-4; the tests behind it are two.
    Source: Reese, J. Geotech. Geoenviron. Eng. ASCE 123 (11), 1010-1017 (1997).
    """

    source: ClassVar[str] = "Reese, J. Geotech. Geoenviron. Eng. 123 (11), 1010-1017 (1997)"

    depth_in_rock: Values
    diameter: Values
    compressive_strength: Values
    rock_mass_modulus: Values
    rock_quality_designation: Values
    strain_rm: Values
    multiplier: Values = 1.0

    @cached_property
    def ultimate_resistance(self) -> Array:
        """pur with its multiplier, N/m, shape (n,)."""
        reduction = 1.0 - np.multiply(2.0 / 3.0, self.rock_quality_designation)
        D = np.asarray(self.diameter)
        width = np.minimum(D + 1.4 * self.depth_in_rock, 5.2 * D)
        return np.atleast_1d(self.multiplier * reduction * self.compressive_strength * width)

    @cached_property
    def initial_stiffness(self) -> Array:
        """Kir with its multiplier, Pa, shape (n,)."""
        ratio = np.divide(self.depth_in_rock, self.diameter)
        k = np.minimum(100.0 + 400.0 / 3.0 * ratio, 500.0)
        return np.atleast_1d(self.multiplier * k * self.rock_mass_modulus)

    @cached_property
    def y_rm(self) -> Array:
        """yrm, m, shape (n,)."""
        return np.atleast_1d(np.multiply(self.strain_rm, self.diameter))

    @property
    def y_A(self) -> Array:
        """Displacement at which the initial line ends, m, shape (n,); inf if Kir is 0."""
        pur, Kir, yrm = np.broadcast_arrays(
            self.ultimate_resistance, self.initial_stiffness, self.y_rm
        )
        ratio = np.divide(pur, Kir * yrm, out=np.full(pur.shape, np.inf), where=Kir > 0.0)
        return np.asarray(yrm * np.minimum(np.cbrt(0.5 * ratio) ** 4, ratio))

    @property
    def derived(self) -> Mapping[str, Array]:
        return {
            "ultimate_resistance": self.ultimate_resistance,
            "initial_stiffness": self.initial_stiffness,
            "y_rm": self.y_rm,
            "y_A": self.y_A,
        }

    @cached_property
    def capacity(self) -> Array:
        return self.ultimate_resistance * (self.initial_stiffness > 0.0)

    @cached_property
    def _factors(self) -> tuple[Array, Array]:
        """Half of pur, and the fourth root's derivative at yrm."""
        half = 0.5 * self.ultimate_resistance
        return half, 0.25 * half / self.y_rm

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        half, quarter = self._factors
        y = np.abs(u)
        s = y / self.y_rm
        held = np.maximum(np.minimum(s, _PLATEAU), _LEAST)
        root = np.sqrt(np.sqrt(held))
        slope = quarter * root
        slope /= held
        slope *= s < _PLATEAU
        force, stiffness = below_line(y, self.initial_stiffness, half * root, slope)
        return np.copysign(force, u), stiffness
