"""Limits of methods of time integration that have a closed form.

    central differences                     h = 2/omega
    with the damping of half a step before  h = 2/omega (sqrt(1 + zeta^2) - zeta)
    a power a v^n of the velocity           h = 2 m/(n a v^(n-1)) for explicit methods
    trapezoidal rule that leaves a contact  energy times at most 1 + (omega h)^2/4

Where a contact of stiffness k opens within a step, from x0 inside to x1 outside, the trapezoidal
rule gains k/2 |x0 x1|, and loses as much where it closes: the force that it works with is the mean
of those at both ends.
"""

from dataclasses import dataclass
from math import exp, log, sqrt

import numpy as np
from scipy.optimize import brentq

from ..solve.conserving import Conserving
from ..solve.integrators import Bathe, CentralDifference, Integrator, Rosenbrock, Weighted
from .trials import CONTACTS, LEAST, SETTLING, SWINGS

GAINED = 1.1  # energy over that at the start, from which a motion counts as wrong
KEPT = 0.5  # share of the energy below which it does
OFF = 0.05  # relative error of an end that is known, above which it does
_DAMPED = ("HHT", "GALPHA", "BATHE", "ROS2")


@dataclass(frozen=True, slots=True)
class Limit:
    """A step, omega h, up to which a method stays within the bounds of a trial.

    exact: it leaves them there; otherwise it may stay within them longer.
    """

    trial: str
    method: str
    step: float
    exact: bool
    words: str


def radius(method: Integrator, h: float) -> float:
    """Growth in a step of free vibrations, h is omega h: the spectral radius, closed forms.

    Sources: Hilber, Hughes and Taylor (1977) and Chung and Hulbert (1993), whose matrix this is;
    Bathe (2007); Verwer, Spee, Blom and Hundsdorfer (1999).
    """
    z = 1j * h
    match method:
        case Weighted():
            return _weighted(method, h)
        case Bathe():
            return abs((12.0 + 5.0 * z) / ((4.0 - z) * (3.0 - z)))
        case Rosenbrock():
            g = 1.0 - sqrt(0.5)
            return abs((1.0 + (1.0 - 2.0 * g) * z) / (1.0 - g * z) ** 2)
        case CentralDifference():
            half = 1.0 - 0.5 * h * h
            return abs(half) + sqrt(max(half * half - 1.0, 0.0)) if h > 2.0 else 1.0
        case Conserving():
            return 1.0
    raise ValueError(f"no closed form for {method}")


def _weighted(method: Weighted, h: float) -> float:
    """Of (q, h v, h^2 a) from one end of a step to the other."""
    am, af, beta, gamma = method.mass_lag, method.force_lag, method.beta, method.gamma
    after = np.array([[1.0, 0.0, -beta], [0.0, 1.0, -gamma], [(1.0 - af) * h * h, 0.0, 1.0 - am]])
    before = np.array([[1.0, 1.0, 0.5 - beta], [0.0, 1.0, 1.0 - gamma], [-af * h * h, 0.0, -am]])
    return float(np.abs(np.linalg.eigvals(np.linalg.solve(after, before))).max())


def damped(method: Integrator) -> float:
    """omega h from which the linear trial keeps less than its share of the energy."""

    def left(logarithm: float) -> float:
        h = exp(logarithm)
        steps = 0.8 * max(SWINGS / h, LEAST) - SETTLING  # from the start to the last fifth
        return 2.0 * steps * log(radius(method, h)) - log(KEPT)

    return exp(brentq(left, log(0.05), log(10.0)))


def release(gain: float) -> float:
    """omega h at which the trapezoidal rule gains so much where a contact opens."""
    return 2.0 * sqrt(gain - 1.0)


def limits(methods: dict[str, Integrator]) -> tuple[Limit, ...]:
    """All that are known of the trials."""
    words = "spectral radius"
    shared = GAINED ** (1.0 / CONTACTS)
    return (
        Limit("linear", "CENTRAL", 2.0, True, "2/omega"),
        *(Limit("linear", name, damped(methods[name]), True, words) for name in _DAMPED),
        Limit("wall", "NEWMARK", release(GAINED), True, "1 + (omega h)^2/4"),
        Limit("gap", "NEWMARK", release(shared), False, f"(1 + (omega h)^2/4)^{CONTACTS}"),
        Limit("power law", "CENTRAL", 2.0, True, "2 m/(n a v^(n-1))"),
    )
