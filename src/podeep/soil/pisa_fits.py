"""Parameters of PISA's conics, fitted to finite elements at three sites.

Sources: Byrne et al., Geotechnique 70 (2020) (Cowden till); Burd et al., Geotechnique 70 (2020)
(Dunkirk sand, General Dunkirk Sand Model; Bothkennar clay).
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np

from ..arrays import Array
from .polyline import Values


class Fit(NamedTuple):
    """A parameter: constant + slope x + (density + density_slope x) R + amplitude exp(rate x).

    x is the depth z in diameters or in embedded lengths; z = L at the base.
    """

    constant: float
    slope: float = 0.0
    density: float = 0.0
    density_slope: float = 0.0
    amplitude: float = 0.0
    rate: float = 0.0
    z_over: Literal["D", "L"] = "D"

    def at(self, x: Array, R: Values) -> Array:
        linear = self.constant + self.slope * x + (self.density + self.density_slope * x) * R
        return np.asarray(linear + self.amplitude * np.exp(self.rate * x))


class Fits(NamedTuple):
    """The parameters of one reaction."""

    k: Fit
    n: Fit
    Xu: Fit
    Yu: Fit


#: of n: elastic, then plastic; of Xu: Yu/k
ZERO = Fit(0.0)
Reaction = Literal["p", "m", "HB", "MB"]

Table = Mapping[Reaction, Fits]  # k, n, Xu and Yu of each reaction

COWDEN: Table = MappingProxyType(
    {
        "p": Fits(
            Fit(10.60, -1.650),
            Fit(0.9390, -0.03345),
            Fit(241.4),
            Fit(10.70, amplitude=-7.101, rate=-0.3085),
        ),
        "m": Fits(Fit(1.420, -0.09643), ZERO, ZERO, Fit(0.2899, -0.04775)),
        "HB": Fits(Fit(2.717, -0.3575), Fit(0.8793, -0.03150), Fit(235.7), Fit(0.4038, 0.04812)),
        "MB": Fits(Fit(0.2146, -0.002132), Fit(1.079, -0.1087), Fit(173.1), Fit(0.8192, -0.08588)),
    }
)
BOTHKENNAR: Table = MappingProxyType(
    {
        "p": Fits(
            Fit(12.05, -1.547),
            Fit(0.7204, -0.002679),
            Fit(173.8),
            Fit(7.743, amplitude=-3.945, rate=-0.8456),
        ),
        "m": Fits(Fit(1.698, -0.1576), ZERO, ZERO, Fit(0.4862, -0.05674)),
        "HB": Fits(Fit(3.008, -0.2701), Fit(0.3113, 0.04263), Fit(291.5), Fit(0.5279, 0.06864)),
        "MB": Fits(Fit(0.3409, -0.01995), Fit(0.6990, -0.1155), Fit(187.0), Fit(0.8756, -0.09195)),
    }
)
DUNKIRK: Table = MappingProxyType(
    {
        "p": Fits(
            Fit(8.731, -0.9178, -0.6982),
            Fit(0.917, 0.0, 0.06193),
            Fit(146.1, 0.0, -92.11),
            Fit(0.3667, 0.3375, 25.89, -8.900, z_over="L"),
        ),
        "m": Fits(Fit(17.00), ZERO, ZERO, Fit(0.2605, -0.1989, 0.0, 0.2019, z_over="L")),
        "HB": Fits(
            Fit(6.505, -0.007969, -2.985, -0.4299),
            Fit(0.09978, 0.004994, 0.7974, -0.07005),
            Fit(0.5150, 0.1695, 2.883, -0.7018),
            Fit(0.09952, 0.03988, 0.7996, -0.1606),
        ),
        "MB": Fits(
            Fit(0.3515),
            Fit(0.3000, 0.0, 0.4986),
            Fit(44.89),
            Fit(0.09981, 0.01998, 0.3710, -0.09041),
        ),
    }
)
SITES: Mapping[str, Table] = MappingProxyType({"COWDEN": COWDEN, "BOTHKENNAR": BOTHKENNAR})
