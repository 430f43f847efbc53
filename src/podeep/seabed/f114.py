"""DNV-RP-F114: penetration of a pipe in undrained clay by its model 2."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.polyline import Values
from .bearing import embedded_area
from .law import NONE, SeabedLaw


@dataclass(frozen=True, eq=False, kw_only=True)
class F114Undrained(SeabedLaw):
    """Undrained clay of DNV-RP-F114, model 2.

        W = D su min( 6 (z/D)^0.25 , 3.4 (10 z/D)^0.5 ) + 1.5 g' A_bm

    with the cross section A_bm below the seabed (`embedded_area`). undrained_shear_strength su at
    the invert, Pa; effective_unit_weight g', N/m3. At z/D = 0.097, where the minimum changes
    sides, the derivative halves. Range: z up to D/2.
    Source: DNV-RP-F114 as two public programs have it.
    """

    source: ClassVar[str] = "DNV-RP-F114 model 2, by two public programs"
    no_dynamic: ClassVar[str] = NONE

    undrained_shear_strength: Values
    effective_unit_weight: Values

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        D, g = self.diameter, self.effective_unit_weight
        u = np.asarray(u, dtype=float)
        z = np.maximum(u, 0.0)
        ratio = z / D
        deep, shallow = 6.0 * ratio**0.25, 3.4 * np.sqrt(10.0 * ratio)
        exponent = np.where(deep <= shallow, 0.25, 0.5)  # the derivative at the kink is the softer
        bearing = D * self.undrained_shear_strength * np.minimum(deep, shallow)
        slope = np.full(np.shape(bearing), np.inf)
        np.divide(exponent * bearing, z, out=slope, where=z > 0.0)
        buoyancy = 1.5 * g * embedded_area(z, D)
        slope = slope + 1.5 * g * self.contact_width(z)
        return np.asarray(bearing + buoyancy), np.where(u < 0.0, 0.0, slope)

    def _penetration(self, weight: Values) -> Array:
        return self.bracketed(weight)
