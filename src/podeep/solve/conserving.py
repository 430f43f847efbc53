"""Time integration that keeps the energy, contact included: for what bounces."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from .equations import Equations, State
from .integrators import Integrator
from .stage import Effort, Patience, balanced


@dataclass(frozen=True, slots=True)
class Conserving(Integrator):
    """The trapezoidal rule with the mean force of a step.

        M (v1 - v0)/h + C (v0 + v1)/2 + F = (P0 + P1)/2
        q1 = q0 + h (v0 + v1)/2

    For equations whose `internal` is the mean force on the way from the last commit to q1, which
    stores on it what F (q1 - q0) says: (F0 + F1)/2 of a linear spring, `model.mean` of a
    foundation, `seabed.normal.mean_force` of a seabed, the force at the end for friction and
    whatever else gives nothing back. Then energy changes by the work of the loads, less what C and
    the seabed lose, whatever the step: no contact gives energy. Of order 2, without numerical
    damping. Accelerations are means of a step.

    Source: discrete gradients after LaBudde and Greenspan (1976) and Gonzalez (1996), for contact
    after Laursen and Chawla (1997); from memory.
    """

    mean: ClassVar[bool] = True

    def step(
        self, equations: Equations, state: State, h: float, patience: Patience, effort: Effort
    ) -> State:
        q0, v0, time, held = state.q, state.velocity, state.time + h, equations.held
        equations.weigh(2.0 / h**2, 1.0 / h, 1.0 / h)
        right = 0.5 * (equations.load(state.time) + equations.load(time))
        right += equations.weighed_times(q0) + equations.mass_times((2.0 / h) * v0)
        start = q0 + h * v0
        if len(held):
            value, rate, _ = equations.given(time)
            start[held] = value
            # inertia of what is driven: the mean of its given acceleration
            slip = np.zeros_like(q0)
            slip[held] = (2.0 / h) * ((value - q0[held]) / h - v0[held]) - (rate - v0[held]) / h
            right += equations.mass_times(slip)
        q = balanced(equations, right, start, lambda q: (q - q0) / h, patience, effort)
        velocity = (2.0 / h) * (q - q0) - v0
        if len(held):
            velocity[held] = rate
        return State(time, q, np.asarray(velocity), (velocity - v0) / h, None)
