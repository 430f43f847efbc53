"""A pipe pulled out of the seabed through a spring: where statics comes to its end, and the jump.

The pulled end is lifted by U, the pipe by y; the spring k_p between them carries the pull.

    U(y) = y + pull(y)/k_p,   pull(y) = R(z0) - R(z0 - y)

so that U follows from y by the seabed's law alone: no iteration can fail. Where pull falls faster
than k_p, U has a maximum: a limit point. Lifted further the pipe jumps.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from ..arrays import Array
from ..errors import InvalidData
from ..soil.memory import Memory
from .bounds import POSITIVE, within


@dataclass(frozen=True, slots=True)
class LimitPoint:
    """Where a static pull has no neighbouring equilibrium any more.

    lift: of the pulled end U, m; pull, N/m; penetration of the pipe there, m. jump: how far up the
    pipe comes to rest again, m. energy: set free by the jump, J/m. falls: stiffness by which the
    pull falls beyond, less that of the spring, N/m per metre. For a pipe of N and N/m: N, J.
    """

    lift: float
    pull: float
    penetration: float
    jump: float
    energy: float
    falls: float

    def growth_rate(self, mass: float) -> float:
        """Rate at which the jump starts, 1/s; mass: kg/m. A time step has to be well below its
        inverse."""
        return sqrt(self.falls / mass)

    def peak_speed(self, mass: float) -> float:
        """Velocity of a mass (kg/m) where the pull is nil again, m/s, if nothing damps it."""
        return sqrt(2.0 * self.energy / mass)

    def __str__(self) -> str:
        return (
            f"limit point at a pull of {self.pull:.6g} N/m, the pulled end lifted by "
            f"{self.lift:.6g} m, the pipe at a penetration of {self.penetration:.6g} m: suction "
            "falls faster there than the pulling stiffness, and no static state is near; lifted "
            f"further the pipe jumps up by {self.jump:.6g} m and sets {self.energy:.6g} J/m free; "
            "follow the path by arc length, or the jump in time"
        )


@dataclass(frozen=True, slots=True)
class StaticPull:
    """Static states of a pull, one for each lift of its end; pull in N/m, penetration in m.

    limits: the limit points that were passed, in order.
    """

    lift: Array
    penetration: Array
    pull: Array
    limits: tuple[LimitPoint, ...]


def static_pull(
    law: Memory, start: float, stiffness: float, reach: float, points: int = 1001
) -> StaticPull:
    """Pull a pipe out from a penetration at which it rests, through a spring, by a reach.

    law: of one point, which rests at `start` (m) as committed there; it is left as it is.
    stiffness k_p of the spring, N/m per metre of pipe (N/m at a node), above 0. reach: of the pipe,
    m, above 0; points: its even parts, each shorter than the way over which suction falls. Beyond
    a limit point the states are those after the jump.

    Raises InvalidData where the numbers make no pull, and where a jump leads beyond the reach.
    """
    within("pulling stiffness", stiffness, POSITIVE)
    within("reach of a pull, m,", reach, POSITIVE)
    within("number of points of a pull", points, 2)
    weight = law.evaluate(np.array([start]))[0][0]

    def pull(y: float) -> float:
        return float(weight - law.evaluate(np.array([start - y]))[0][0])

    def lift(y: float) -> float:
        return y + pull(y) / stiffness

    def growth(y: float) -> float:
        """Derivative of U."""
        return 1.0 + float(law.evaluate(np.array([start - y]))[1][0]) / stiffness

    way = np.linspace(0.0, reach, points)
    end = np.array([lift(y) for y in way])
    limits, kept, i = [], [0], 1
    while i < points:
        if end[i] >= end[kept[-1]]:
            kept.append(i)
            i += 1
            continue
        place = _summit(growth, lift, way[max(i - 2, 0)], way[i])
        top = lift(place)
        beyond = np.flatnonzero(end[i:] > top)
        if not beyond.size:
            raise InvalidData(
                f"the pipe jumps at a pull of {pull(place):.6g} N/m, and beyond a reach of "
                f"{reach:g} m",
                "give a longer reach",
            )
        i += int(beyond[0])
        landing = brentq(lambda y, top=top: lift(y) - top, way[i - 1], way[i], xtol=1e-14)
        free, _ = quad(lambda y, top=top: stiffness * (top - lift(y)), place, landing, limit=200)
        falls = -stiffness * growth(place + 1e-6 * (landing - place))
        limits.append(LimitPoint(top, pull(place), start - place, landing - place, free, falls))
    path = way[kept]
    pulls = np.array([pull(y) for y in path])
    return StaticPull(end[kept], start - path, pulls, tuple(limits))


def _summit(
    growth: Callable[[float], float], value: Callable[[float], float], low: float, high: float
) -> float:
    """Where a curve is highest between two places: its derivative changes its sign or jumps."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        if growth(middle) > 0.0:
            low = middle
        else:
            high = middle
    return max(low, high, key=value)
