"""Methods of time integration, each a small class over one engine.

Most go by stages: at the end of a stage velocity and acceleration are linear in the unknowns, which
`stage.balanced` finds. The soil is met at one time, at the end of a stage; a method that weighs two
times weighs the forces there.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .equations import Equations, State
from .stage import Effort, NoBalance, Patience, balanced


class Integrator(ABC):
    """Takes equations of motion a step further.

    mean: it needs the mean of `internal` on the way from where a step begins.
    """

    mean: ClassVar[bool] = False

    @property
    def order(self) -> int:
        """Of its error in the step."""
        return 2

    @abstractmethod
    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        """The state h seconds later, which is not committed yet. Raises NoBalance."""

    def limit(self, equations: Equations) -> float:
        """The longest step, s, that stays stable where the equations are; inf: any."""
        return np.inf


@dataclass(frozen=True, slots=True)
class _Stage:
    """v = rate q + drift and a = inertia q + pull at the end of a stage, at a time, s."""

    time: float
    rate: float
    drift: Array
    inertia: float
    pull: Array

    def from_start(self, equations: Equations, start: Array) -> Array:
        """The start with the held unknowns where they are driven; v and a follow them."""
        held = equations.held
        if not len(held):
            return start
        value, velocity, acceleration = equations.given(self.time)
        start = start.copy()
        start[held] = value
        self.drift[held] = velocity - self.rate * value
        self.pull[held] = acceleration - self.inertia * value
        return start

    def velocity(self, q: Array) -> Array:
        return self.rate * q + self.drift

    def end(
        self,
        equations: Equations,
        start: Array,
        load: Array,
        inertia_share: float,
        patience: Patience,
        effort: Effort,
        *,
        resisting: bool = False,
    ) -> State:
        """The state in which inertia_share M a + C v + F(q, v) = load, with C v + F if asked."""
        start = self.from_start(equations, start)
        equations.weigh(inertia_share * self.inertia, self.rate, self.rate)
        right = load - equations.mass_times(inertia_share * self.pull)
        right -= equations.damping_times(self.drift)
        q = balanced(equations, right, start, self.velocity, patience, effort)
        acceleration = self.inertia * q + self.pull
        resists = load - equations.mass_times(inertia_share * acceleration) if resisting else None
        return State(self.time, q, self.velocity(q), acceleration, resists)


@dataclass(frozen=True, slots=True)
class Weighted(Integrator):
    """The family of Newmark, HHT and the generalised-alpha method.

        (1 - am) M a1 + am M a0 + (1 - af) (C v1 + F1) + af (C v0 + F0) = (1 - af) P1 + af P0
        q1 = q0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1),   v1 = v0 + h ((1 - gamma) a0 + gamma a1)

    Sources: Newmark, J. Eng. Mech. ASCE 85 (1959); Hilber, Hughes and Taylor, Earthq. Eng. Struct.
    Dyn. 5 (1977); Chung and Hulbert, J. Appl. Mech. 60 (1993).
    """

    gamma: float = 0.5
    beta: float = 0.25
    mass_lag: float = 0.0  # am
    force_lag: float = 0.0  # af

    @property
    def order(self) -> int:
        second = 0.5 - self.mass_lag + self.force_lag
        return 2 if abs(self.gamma - second) < 1e-12 else 1

    @classmethod
    def hht(cls, alpha: float) -> "Weighted":
        """HHT: alpha from -1/3 (most numerical damping) to 0 (none)."""
        return cls(0.5 - alpha, 0.25 * (1.0 - alpha) ** 2, 0.0, -alpha)

    @classmethod
    def generalised_alpha(cls, radius: float) -> "Weighted":
        """With this spectral radius, 0 to 1, of what is much faster than the step."""
        am, af = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
        return cls(0.5 - am + af, 0.25 * (1.0 - am + af) ** 2, am, af)

    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        q, v, a, time = state.q, state.velocity, state.acceleration, state.time + h
        inertia = 1.0 / (self.beta * h * h)
        rate = self.gamma * h * inertia
        moved = q + h * v
        pull = -inertia * moved
        pull += (1.0 - 0.5 / self.beta) * a
        drift = v + (h * (1.0 - self.gamma)) * a
        drift += (self.gamma * h) * pull
        load = equations.load(time)
        share = 1.0
        if self.force_lag or self.mass_lag:
            kept = 1.0 - self.force_lag
            share = (1.0 - self.mass_lag) / kept
            before = -self.mass_lag * equations.mass_times(a)
            if state.resisting is not None:
                before += self.force_lag * (equations.load(state.time) - state.resisting)
            load = load + before / kept
        stage = _Stage(time, rate, drift, inertia, pull)
        lags = self.force_lag != 0.0
        return stage.end(equations, moved, load, share, patience, effort, resisting=lags)


@dataclass(frozen=True, slots=True)
class Bathe(Integrator):
    """Half the step by the trapezoidal rule, the whole by three-point backward differences.

    Source: Bathe, Comput. Struct. 85 (2007) 437-445.
    """

    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        half = Weighted().step(equations, state, 0.5 * h, patience, effort)
        rate, time = 3.0 / h, state.time + h
        drift = (state.q - 4.0 * half.q) / h
        pull = (state.velocity - 4.0 * half.velocity) / h + rate * drift
        stage = _Stage(time, rate, drift, rate * rate, pull)
        start = half.q + 0.5 * h * half.velocity
        return stage.end(equations, start, equations.load(time), 1.0, patience, effort)


@dataclass(frozen=True, slots=True)
class Rosenbrock(Integrator):
    """Two linearly implicit stages with one tangent, without iteration (ROS2).

        (1 - g h J) k1 = f(y0),   (1 - g h J) k2 = f(y0 + h k1) - 2 k1
        y1 = y0 + h (3 k1 + k2) / 2

    with y = (q, v), g = 1 - 1/sqrt(2). L-stable, of order 2 with any J; unsafe where things meet.
    Source: Verwer, Spee, Blom and Hundsdorfer, SIAM J. Sci. Comput. 20 (1999).
    """

    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        part, time = (1.0 - sqrt(0.5)) * h, state.time + h
        equations.weigh(1.0 / part**2, 1.0 / part, 1.0 / part)

        def stage(q: Array, v: Array, at: float, less: tuple[Array, Array] | None) -> Array:
            """What pushes at a stage, right side of the equation for its move kq."""
            force = equations.internal(q, v if equations.feels_velocity else None)
            effort.evaluations += 1
            pushed = equations.load(at) - force - equations.damping_times(v)
            if less is not None:
                pushed -= 2.0 * equations.mass_times(less[1])
                v = v - 2.0 * less[0]
            return equations.weighed_times(v) + pushed / part

        def moved(right: Array, velocity: Array) -> tuple[Array, Array]:
            effort.iterations += 1
            move = equations.solve(right)
            if move is None or not np.isfinite(move).all():
                raise NoBalance
            return move, (move - velocity) / part

        try:
            first = moved(stage(state.q, state.velocity, state.time, None), state.velocity)
            equations.keep_tangent(True)
            q, v = state.q + h * first[0], state.velocity + h * first[1]
            second = moved(stage(q, v, time, first), v - 2.0 * first[0])
        finally:
            equations.keep_tangent(False)
        q = state.q + (0.5 * h) * (3.0 * first[0] + second[0])
        v = state.velocity + (0.5 * h) * (3.0 * first[1] + second[1])
        return State(time, q, v, (v - state.velocity) / h, None)


@dataclass(frozen=True, slots=True)
class CentralDifference(Integrator):
    """Explicit: q from what is known, then the acceleration that balances there.

        q1 = q0 + h v0 + h^2/2 a0,   (M + h/2 C) a1 = P1 - F(q1) - C (v0 + h/2 a0)

    Stable up to 2 over the largest natural frequency.
    """

    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        time, held = state.time + h, equations.held
        halfway = state.velocity + (0.5 * h) * state.acceleration
        q = state.q + h * halfway
        acceleration = np.zeros_like(q)
        if len(held):
            q[held], _, acceleration[held] = equations.given(time)
        force = equations.internal(q, halfway if equations.feels_velocity else None)
        effort.evaluations += 1
        effort.iterations += 1
        equations.weigh(1.0, 0.5 * h, 0.0)
        pushed = equations.load(time) - force
        right = pushed - equations.damping_times(halfway)
        if len(held):
            right -= equations.weighed_times(acceleration)
        acceleration = acceleration + equations.solve_weighed(right)
        if not np.isfinite(acceleration).all():
            raise NoBalance
        velocity = halfway + (0.5 * h) * acceleration
        if len(held):
            velocity[held] = equations.given(time)[1]
        return State(time, q, velocity, acceleration, None)

    def limit(self, equations: Equations) -> float:
        fastest = equations.fastest()
        return 2.0 / fastest if fastest > 0.0 else np.inf


def initial(equations: Equations, time: float, q: Array, velocity: Array, effort: Effort) -> State:
    """The state at the start, with the acceleration that balances there."""
    held = equations.held
    acceleration = np.zeros_like(q)
    q, velocity = q.copy(), velocity.copy()
    if len(held):
        q[held], velocity[held], acceleration[held] = equations.given(time)
    force = equations.internal(q, velocity if equations.feels_velocity else None)
    effort.evaluations += 1
    resisting = force + equations.damping_times(velocity)
    equations.weigh(1.0, 0.0, 0.0)
    right = equations.load(time) - resisting - equations.mass_times(acceleration)
    return State(time, q, velocity, acceleration + equations.solve_weighed(right), resisting)
