"""Equilibrium in a stage of a time step, where velocity and acceleration follow the unknowns.

    v = rate q + drift,   a = inertia q + ...,   D q + F(q, v) = right

The right side holds all that is known. Newton's method starts near its end: a step that moves less
than matters ends it without another evaluation. The search along the energy is that of statics.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import numpy as np
from scipy.linalg import blas

from ..arrays import Array
from .equations import Equations
from .newton import largest, search

_DESCENT = 1e-30


@dataclass(frozen=True, slots=True)
class Patience:
    """increment: move of an unknown, m, that no longer matters. iterations: most of them."""

    increment: float
    iterations: int = 30


@dataclass(slots=True)
class Effort:
    """What was spent: solutions with a tangent, evaluations of the internal forces."""

    iterations: int = 0
    evaluations: int = 0


class NoBalance(Exception):
    """A stage without equilibrium that could be found."""


def balanced(
    equations: Equations,
    right: Array,
    start: Array,
    velocity: Callable[[Array], Array],
    patience: Patience,
    effort: Effort,
) -> Array:
    """The unknowns in balance with `right` near `start`, whose held values they keep.

    `weigh` has set D. velocity: v at some q. Raises NoBalance.
    """
    held = equations.held if len(equations.held) else None
    feels = equations.feels_velocity

    def evaluate(q: Array) -> tuple[Array, Array]:
        internal = equations.internal(q, velocity(q) if feels else None)
        effort.evaluations += 1
        residual = right - internal
        residual -= equations.weighed_times(q)
        if held is not None:
            residual[held] = 0.0
        return internal, residual

    q = start
    residual = evaluate(q)[1]
    for _ in range(patience.iterations):
        step = equations.solve(residual)
        effort.iterations += 1
        if step is None:
            break
        size = largest(step)
        if size <= patience.increment:
            return np.asarray(q + step)
        slope = blas.ddot(step, residual)
        if not isfinite(size) or not slope > _DESCENT:
            break
        q, _, residual = search(evaluate, q, step, slope)
    raise NoBalance
