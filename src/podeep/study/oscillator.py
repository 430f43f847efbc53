"""Masses on springs, each by itself, as equations of motion: the least that a method can fail at.

m a + c v + spring(u) + drag(v) = push(t)
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Array, Index
from ..soil.way import crossed, mean_of
from ..solve.equations import State
from ..solve.integrators import Integrator, initial
from ..solve.stage import Effort, Patience

#: A force and its derivative at displacements, or at velocities.
Law = Callable[[Array], tuple[Array, Array]]


def nothing(x: Array) -> tuple[Array, Array]:
    """No force."""
    return np.zeros_like(x), np.zeros_like(x)


def linear(stiffness: float) -> Law:
    """k u, N; stiffness k: N/m."""
    return lambda u: (stiffness * u, np.full_like(u, stiffness))


def wall(stiffness: float) -> Law:
    """A wall below u = 0: k u there and nothing above; stiffness k: N/m."""

    def law(u: Array) -> tuple[Array, Array]:
        modulus = np.where(u < 0.0, stiffness, 0.0)
        return modulus * u, modulus

    return law


def gap(stiffness: float, width: float) -> Law:
    """Free play up to |u| = width, m, then k (|u| - width) towards it; stiffness k: N/m."""

    def law(u: Array) -> tuple[Array, Array]:
        beyond = u - np.clip(u, -width, width)
        return stiffness * beyond, np.where(beyond != 0.0, stiffness, 0.0)

    return law


def power(factor: float, exponent: float, floor: float) -> Law:
    """factor x (x^2 + floor^2)^((exponent - 1)/2): a power of |x| with a finite slope at 0.

    The cube root of soft clay is rounded off in this way (exponent 1/3, floor 1e-10 y50), and so is
    suction with a power of the velocity (exponent 0.18).
    """

    def law(x: Array) -> tuple[Array, Array]:
        square = x * x + floor * floor
        share = factor * square ** (0.5 * (exponent - 1.0))
        return share * x, share * (1.0 + (exponent - 1.0) * x * x / square)

    return law


@dataclass
class MeanLaw:
    """The mean force of a law on the way from where it was committed last, with its derivative.

    at: there, m, (n,). corners: displacements at which the law has corners, m.
    """

    law: Law
    at: Array
    corners: tuple[float, ...] = ()

    def __call__(self, u: Array) -> tuple[Array, Array]:
        corners = np.array(self.corners)[:, None]
        return mean_of(self.law, self.at, u, crossed(corners, self.at, u))

    def commit(self, u: Array) -> None:
        self.at = np.array(u)


@dataclass
class Oscillators:
    """n masses side by side, see `Equations`: mass, kg, and damping, N s/m, have shape (n,).

    held, driven: which follow a given motion, and its values, velocities and accelerations.
    commits: told each state that is reached, for a spring that remembers.
    """

    mass: Array
    damping: Array
    spring: Law = nothing
    push: Callable[[float], Array] | None = None
    drag: Law = nothing
    held: Index = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    driven: Callable[[float], tuple[Array, Array, Array]] | None = None
    commits: Callable[[Array], None] | None = None

    def __post_init__(self) -> None:
        self.feels_velocity = self.drag is not nothing
        self._kept = False

    def load(self, time: float) -> Array:
        return np.zeros(len(self.mass)) if self.push is None else self.push(time)

    def given(self, time: float) -> tuple[Array, Array, Array]:
        assert self.driven is not None
        return self.driven(time)

    def mass_times(self, x: Array) -> Array:
        return self.mass * x

    def damping_times(self, x: Array) -> Array:
        return self.damping * x

    def weigh(self, inertia: float, damping: float, rate: float) -> None:
        self._weighed = inertia * self.mass + damping * self.damping
        self._rate = rate

    def weighed_times(self, q: Array) -> Array:
        return self._weighed * q

    def internal(self, q: Array, velocity: Array | None) -> Array:
        force, modulus = self.spring(q)
        self._tangent = modulus, np.zeros_like(q)
        if velocity is not None:
            drag, slope = self.drag(velocity)
            force, self._tangent = force + drag, (modulus, slope)
        if not self._kept:
            self._used = self._tangent
        return np.array(force)

    def solve(self, right: Array) -> Array | None:
        modulus, slope = self._used
        step = right / (self._weighed + modulus + self._rate * slope)
        step[self.held] = 0.0
        return step

    def keep_tangent(self, kept: bool) -> None:
        self._kept = kept

    def solve_weighed(self, right: Array) -> Array:
        step = right / self._weighed
        step[self.held] = 0.0
        return step

    def fastest(self) -> float:
        return float(np.sqrt((self._tangent[0] / self.mass).max()))

    def commit(self, q: Array) -> None:
        if self.commits is not None:
            self.commits(q)


def one(spring: Law, mass: float = 1.0, damping: float = 0.0, **more: object) -> Oscillators:
    """A single mass."""
    return Oscillators(np.array([mass]), np.array([damping]), spring, **more)  # type: ignore[arg-type]


def history(
    method: Integrator,
    equations: Oscillators,
    q: Array,
    velocity: Array,
    h: float,
    steps: int,
    increment: float = 1e-13,
) -> tuple[list[State], Effort]:
    """All states from the start on, and what they took. Raises NoBalance."""
    effort, patience = Effort(), Patience(increment, 100)
    states = [initial(equations, 0.0, q, velocity, effort)]
    for _ in range(steps):
        states.append(method.step(equations, states[-1], h, patience, effort))
        equations.commit(states[-1].q)
    return states, effort
