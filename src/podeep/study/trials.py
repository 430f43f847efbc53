"""Trials of a method of time integration: motions of a few masses whose energy or end is known.

All are free of units: mass 1, and a rate omega of 1, so that a step h is omega h. The masses of a
trial stand side by side and differ in where they start within a step.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np

from ..arrays import Array
from ..solve.integrators import Integrator, initial
from ..solve.stage import Effort, Patience
from .oscillator import Law, MeanLaw, Oscillators, gap, linear, nothing, power, wall

SUCTION = 0.18  # exponent of the velocity
SWINGS = 20.0 * pi  # time of free swings: 10 cycles
LEAST, SETTLING = 120, 20  # steps of them at least; of these, steps that are left out at first
CONTACTS = 11  # of a mass in the gap, at most
_TOE = 1e-10  # of soil, over its displacement at half resistance: as soft clay is rounded off
_FLOOR = 1e-4  # of the power law, over the velocity it ends with
_PLAY = 5.0  # half the width of the gap, over the velocity / omega
_ITERATIONS = 30  # as a deck has it
_INCREMENT = 1e-10
_FAR = 1e9  # a mass that came so far has run away
_PHASES = 24  # starts within a step, where masses touch


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a motion.

    gain: its largest energy over that at the start; kept: the share of its energy at the end; the
    worst of all starts. error: of the end, relative to the exact one.
    """

    gain: float = 1.0
    kept: float = 1.0
    error: float = 0.0


@dataclass(frozen=True, slots=True)
class Trial:
    """A motion to follow.

    rate: what omega is. time: how long at least, in 1/omega; least: steps at least. starts:
    displacements and velocities for a step. measure: from displacements and velocities, shape
    (states, starts). corners: of the spring, where a method asks for its mean force.
    """

    name: str
    what: str
    rate: str
    spring: Law
    time: float
    least: int
    starts: Callable[[float], tuple[Array, Array]]
    measure: Callable[[Array, Array], Outcome]
    drag: Law = nothing
    push: float = 0.0
    corners: tuple[float, ...] = ()

    def steps(self, h: float) -> int:
        return max(int(self.time / h) + 1, self.least)

    def outcome(self, method: Integrator, h: float) -> Outcome:
        """Follow the motion with steps of h, in 1/omega. Raises NoBalance."""
        q, v = self.starts(h)
        push = np.full_like(q, self.push)
        mean = MeanLaw(self.spring, q, self.corners)
        spring = mean if method.mean else self.spring
        equations = Oscillators(
            np.ones_like(q),
            np.zeros_like(q),
            spring,
            lambda t: push,
            self.drag,
            commits=mean.commit,
        )
        effort, patience = Effort(), Patience(_INCREMENT, _ITERATIONS)
        states = [initial(equations, 0.0, q, v, effort)]
        for _ in range(self.steps(h)):
            states.append(method.step(equations, states[-1], h, patience, effort))
            equations.commit(states[-1].q)
            if not np.abs(states[-1].q).max() <= _FAR:  # also where it is no number
                return Outcome(np.inf)
        return self.measure(np.array([s.q for s in states]), np.array([s.velocity for s in states]))


def _energies(
    potential: Callable[[Array], Array], settling: int = 0
) -> Callable[[Array, Array], Outcome]:
    """Measure by energy, of motion and spring.

    settling: so many states are left out at first, in which a method has motions of its own, and
    the next as many are the start.
    """

    def measure(q: Array, v: Array) -> Outcome:
        energy = 0.5 * v * v + potential(q)
        start = energy[settling : max(2 * settling, 1)].max(axis=0)
        gain = energy[settling:].max(axis=0) / start
        last = energy[-max(len(q) // 5, 1) :].max(axis=0)
        return Outcome(float(max(gain.max(), 1.0)), float((last / start).min()))

    return measure


def _phases(count: int) -> Array:
    """Even shares of a step."""
    return (np.arange(count) + 0.5) / count


def _around(_: float) -> tuple[Array, Array]:
    """Four starts around the circle of a linear spring."""
    angle = np.arange(4) * (0.25 * pi)
    return np.cos(angle), np.sin(angle)


def _shares(_: float) -> tuple[Array, Array]:
    """Starts of one energy, more and more of it in the soil, whose potential is 3/4 |u|^(4/3)."""
    share = np.linspace(0.0, 1.0, 5)
    return share**0.75, np.sqrt(1.5 * (1.0 - share))


def _at_wall(h: float) -> tuple[Array, Array]:
    """Masses on their way to the wall, and masses let go that are pressed against it."""
    share = _phases(_PHASES)
    towards, angle = (h * share, -np.ones(_PHASES)), min(h, 0.5 * pi) * share
    pressed = (-np.cos(angle), np.sin(angle))
    q, v = zip(towards, pressed, strict=True)
    return np.concatenate(q), np.concatenate(v)


def _in_gap(h: float) -> tuple[Array, Array]:
    """Masses on their way from within the gap."""
    return min(h, 2.0 * _PLAY) * (_phases(_PHASES) - 0.5), np.ones(_PHASES)


def _pulled(_: float) -> tuple[Array, Array]:
    """From rest, too slow, and too fast."""
    return np.zeros(3), np.array([0.0, 0.5, 2.0])


def _terminal(_: Array, v: Array) -> Outcome:
    """The velocity of the last states against 1."""
    return Outcome(error=float(np.abs(v[-3:] - 1.0).max()))


TRIALS = (
    Trial(
        "linear",
        "a linear spring swings freely for 10 cycles",
        "omega = sqrt(k/m)",
        linear(1.0),
        SWINGS,
        LEAST,
        _around,
        _energies(lambda u: 0.5 * u * u, SETTLING),
    ),
    Trial(
        "soil",
        "a mass swings freely on soft clay's cube root for 10 cycles",
        "omega = sqrt(k/m), k the secant at its amplitude",
        power(1.0, 1.0 / 3.0, _TOE),
        SWINGS,
        LEAST,
        _shares,
        _energies(lambda u: 0.75 * np.abs(u) ** (4.0 / 3.0)),
    ),
    Trial(
        "wall",
        "a mass bounces off a stiff wall once, or is let go from it",
        "omega = sqrt(k/m), k of the wall",
        wall(1.0),
        pi,
        6,
        _at_wall,
        _energies(lambda u: 0.5 * np.minimum(u, 0.0) ** 2),
        corners=(0.0,),
    ),
    Trial(
        "gap",
        "a mass bounces between two walls, 10 times",
        "omega = sqrt(k/m), k of the walls; the gap is 10 v/omega wide",
        gap(1.0, _PLAY),
        (CONTACTS - 1) * (2.0 * _PLAY + pi),
        10,
        _in_gap,
        _energies(lambda u: 0.5 * np.maximum(np.abs(u) - _PLAY, 0.0) ** 2),
        corners=(-_PLAY, _PLAY),
    ),
    Trial(
        "power law",
        "a mass is pulled against suction a v^0.18 to its terminal velocity",
        "omega = n a v^(n-1)/m at the terminal velocity",
        nothing,
        20.0,
        50,
        _pulled,
        _terminal,
        power(1.0 / SUCTION, SUCTION, _FLOOR),
        1.0 / SUCTION,
    ),
)
