"""Oscillators of a few masses, each by itself, as equations of motion."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from podeep.arrays import Array, Index
from podeep.solve.equations import State
from podeep.solve.integrators import Integrator, initial
from podeep.solve.stage import Effort, Patience

Law = Callable[[Array], tuple[Array, Array]]


def nothing(x: Array) -> tuple[Array, Array]:
    return np.zeros_like(x), np.zeros_like(x)


@dataclass
class Oscillators:
    """m a + c v + spring(u) + drag(v) = push(t), n of them side by side.

    spring, drag: force and derivative. memory: a spring that remembers, in place of `spring`.
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


def linear(stiffness: float) -> Law:
    return lambda u: (stiffness * u, np.full_like(u, stiffness))


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
    """All states from the start on, and what they took."""
    effort, patience = Effort(), Patience(increment, 100)
    states = [initial(equations, 0.0, q, velocity, effort)]
    for _ in range(steps):
        states.append(method.step(equations, states[-1], h, patience, effort))
        equations.commit(states[-1].q)
    return states, effort
