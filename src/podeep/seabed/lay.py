"""How much deeper a pipe goes as it is laid."""

from math import exp, log, sqrt
from typing import NamedTuple

import numpy as np

from .law import SeabedLaw
from .parameters import require


class Laid(NamedTuple):
    """Factor on the weight as the pipe is laid, and penetration that it leaves, m.

    least_tension: lay tension from which on the factor holds, N.
    """

    factor: float
    penetration: float
    least_tension: float


def laid(law: SeabedLaw, weight: float, bending_stiffness: float, lay_tension: float) -> Laid:
    """Penetration under the touchdown of a pipe that is laid with a tension.

        k_lay = 0.6 + 0.4 (EI k / T0^2)^0.25 >= 1,   k = force(z)/z,   force(z) = k_lay W

    weight W, N/m; bending_stiffness EI, N m2; lay_tension T0, N, the horizontal one. k is the
    secant at the penetration that is sought. Range: T0 above (3 sqrt(EI) W)^(2/3).
    Raises InvalidData for values out of bounds.
    Source: DNV-RP-F114 as a public program has it; within 3.5 % of the exact boundary layer of a
    tensioned beam on springs for EI k / T0^2 from 1 to 1000.
    """
    require(bending_stiffness=bending_stiffness, lay_tension=lay_tension)
    from scipy.optimize import brentq  # slow to load, and rarely needed

    def factor(z: float, force: float) -> float:
        relative = bending_stiffness * force / z / lay_tension**2
        return max(1.0, 0.6 + 0.4 * float(relative**0.25))

    def excess(x: float) -> float:
        z = exp(x)
        force = float(law.force(np.array(z)))
        return log(force / (factor(z, force) * weight))

    # the factor falls, or rises slower than the force: there is one root, at or above that of W
    low = high = log(float(law.penetration(weight)))
    while excess(high) < 0.0:
        high += 1.0
    z = exp(brentq(excess, low - 1e-9, high, xtol=1e-14, rtol=1e-14))
    least = (3.0 * sqrt(bending_stiffness) * weight) ** (2.0 / 3.0)
    return Laid(factor(z, float(law.force(np.array(z)))), z, least)
