"""The end of a pipe lifted off a rigid seabed that holds it back, at small slopes and no tension.

Suction q holds down what is less than D above the seabed. Within a of where the pipe leaves the
seabed it bears w + q per length, EI y'''' = -(w + q), up to the end b further on w alone. With
y = y' = y'' = 0 at one end of a and y = D at the other:

    EI y' = 3 D EI/a - (w + q) a^3/24,  EI y'' = 6 D EI/a^2 - (w + q) a^2/4,
    EI y''' = 6 D EI/a^3 - 3 (w + q) a/4                      at the end of a
    b = (EI y''' + sqrt((EI y''')^2 + 2 w EI y''))/w          no moment at the lifted end
    h = D + y' b + y'' b^2/2 + y''' b^3/6 - w b^4/(24 EI)     the root a of this

Where q grows and q D = G is kept, y'' at the end of a goes to sqrt(2 G/EI), that of a film which is
peeled. Source: derived.
"""

from dataclasses import dataclass
from math import sqrt

from scipy.optimize import brentq

from ..seabed.bounds import POSITIVE, within


@dataclass(frozen=True, slots=True)
class Peeled:
    """A pipe whose end is lifted.

    held: length a that suction holds, m; length: all that is off the seabed, a + b, m; lift: force
    at the end, N; reaction: that of the seabed where the pipe leaves it, N; largest_moment, N m;
    curvature where suction ends, 1/m, 0 where it does not end or there is none.
    """

    held: float
    length: float
    lift: float
    reaction: float
    largest_moment: float
    curvature: float


def peeled(
    height: float, bending_stiffness: float, weight: float, suction: float = 0.0, reach: float = 0.0
) -> Peeled:
    """A pipe of no length limit whose end, free to turn, is lifted by h, m.

    bending_stiffness EI, N m2; weight in water w, N/m; suction q, N/m; reach D, m. Raises
    InvalidData for values not above 0, of suction and reach for values below 0.
    """
    within("height", height, POSITIVE)
    within("bending stiffness", bending_stiffness, POSITIVE)
    within("weight", weight, POSITIVE)
    within("suction", suction, 0.0)
    within("reach", reach, 0.0)
    EI, w, D = bending_stiffness, weight, reach
    load = w + suction
    if suction == 0.0 or reach == 0.0:
        return _one_load(height, EI, w, held=False)
    if height <= reach * (1.0 + 1e-12):  # nearer the root has no digits
        return _one_load(height, EI, load, held=True)

    def beyond(a: float) -> tuple[float, float, float, float]:
        turn = 3.0 * D * EI / a - load * a**3 / 24.0
        moment = 6.0 * D * EI / a**2 - load * a**2 / 4.0
        shear = 6.0 * D * EI / a**3 - 0.75 * load * a
        root = sqrt(shear**2 + 2.0 * w * max(moment, 0.0))
        b = (shear + root) / w if shear > 0.0 else 2.0 * moment / (root - shear)
        return turn, moment, shear, b

    def misses(a: float) -> float:
        turn, moment, shear, b = beyond(a)
        bent = b * (turn + b * (moment / 2.0 + b * (shear / 6.0 - w * b / 24.0)))
        return D + bent / EI - height

    most = least = (24.0 * D * EI / load) ** 0.25  # a as the end comes to D
    while misses(least) < 0.0:
        least *= 0.5
    a = float(brentq(misses, least, most, xtol=1e-300, rtol=1e-15))
    _, moment, shear, b = beyond(a)
    reaction = 6.0 * D * EI / a**3 + load * a / 4.0
    outside = shear > 0.0  # that is where the moment is largest
    largest = moment + shear**2 / (2.0 * w) if outside else reaction**2 / (2.0 * load)
    return Peeled(a, a + b, w * b - shear, reaction, largest, moment / EI)


def _one_load(height: float, EI: float, load: float, *, held: bool) -> Peeled:
    """A pipe under the same load all along what is off the seabed."""
    length = (24.0 * EI * height / load) ** 0.25
    force = 0.5 * load * length
    return Peeled(length if held else 0.0, length, force, force, load * length**2 / 8.0, 0.0)
