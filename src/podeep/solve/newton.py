"""Newton's method with a safeguarded line search on the energy."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np
from scipy.linalg import blas

from ..arrays import Array
from ..model.system import System

_CUT = 0.5  # a step is accepted when the slope of the energy fell to this share
_SEARCHES = 40
_FLOOR_CAP = 1e-6  # rounding may excuse a residual up to this share of the forces, never more
_EPS = float(np.finfo(float).eps)


class Ending(Enum):
    """How an iteration ended; the value is what the user reads."""

    CONVERGED = "equilibrium found"
    MECHANISM = "the tangent is singular: nothing holds the tube against this load"
    EXHAUSTED = "no equilibrium within the allowed iterations"


@dataclass(frozen=True, slots=True)
class Limits:
    """When to stop: residual over largest force, increment over largest unknown, iterations."""

    residual: float
    increment: float = np.inf
    iterations: int = 60


@dataclass(slots=True)
class Work:
    """What was spent; a factorisation is one solution with the tangent."""

    iterations: int = 0
    evaluations: int = 0


@dataclass(frozen=True, slots=True)
class Outcome:
    """The last unknowns and internal forces, how the iteration ended, the relative residual."""

    q: Array
    internal: Array
    ending: Ending
    residual: float
    work: Work


def newton(system: System, start: Array, load: Array, limits: Limits) -> Outcome:
    """Equilibrium of `system` under `load` (shape (n,)) from the unknowns `start`.

    Held unknowns keep their value in `start`. The energy of a path independent, non-softening
    reaction is convex, so that the search along each Newton direction makes every step descend.
    """
    work = Work()

    def evaluate(q: Array) -> tuple[Array, Array]:
        internal = system.internal(q)
        work.evaluations += 1
        residual = load - internal
        if len(system.held):
            residual[system.held] = 0.0
        return internal, residual

    load_size = _largest(load)
    q, increment = start, 0.0
    internal, residual = evaluate(q)
    ending = Ending.EXHAUSTED
    for remaining in range(limits.iterations, -1, -1):
        size = max(_largest(internal), load_size)
        worst = _largest(residual)
        accurate = worst <= limits.residual * size and increment <= limits.increment
        if accurate or (worst <= _FLOOR_CAP * size and worst <= rounding(system, q)):
            ending = Ending.CONVERGED
            break
        if remaining == 0:
            break
        step = system.solve(residual)
        work.iterations += 1
        slope = float(step @ residual) if step is not None else 0.0
        if step is None or not slope > 0.0:  # a NaN is no descent either
            ending = Ending.MECHANISM
            break
        q, internal, residual = search(evaluate, q, step, slope)
        size = _largest(q)
        increment = _largest(step) / size if size else 0.0
    return Outcome(q, internal, ending, worst / size if size else 0.0, work)


def _largest(x: Array) -> float:
    """Largest magnitude; BLAS needs one call where NumPy needs two."""
    return abs(float(x[blas.idamax(x)]))


def rounding(system: System, q: Array) -> float:
    """What rounding alone may leave of the residual, N."""
    return 8.0 * _EPS * float((system.diagonal * np.abs(q)).max())


def search(
    evaluate: Callable[[Array], tuple[Array, Array]], q: Array, step: Array, slope: float
) -> tuple[Array, Array, Array]:
    """A point along `step` where the energy falls much less steeply than at its start.

    `slope` is the (positive) product of step and residual at the start. The full step nearly
    always does; one that overshoots, as on the cube root's infinite slope, is cut by the Illinois
    form of the rule of false position. Returns unknowns, internal forces and residual there.
    """
    trial = q + step
    internal, residual = evaluate(trial)
    g = float(step @ residual)
    low, high, g_low, g_high = 0.0, 1.0, slope, g
    for _ in range(_SEARCHES):
        if g >= -_CUT * slope and (g <= _CUT * slope or high == 1.0):
            break
        s = low + (high - low) * g_low / (g_low - g_high)
        margin = 0.02 * (high - low)
        s = min(max(s, low + margin), high - margin)
        trial = q + s * step
        internal, residual = evaluate(trial)
        g = float(step @ residual)
        if g > 0.0:
            low, g_low, g_high = s, g, 0.5 * g_high
        else:
            high, g_high, g_low = s, g, 0.5 * g_low
    return trial, internal, residual
