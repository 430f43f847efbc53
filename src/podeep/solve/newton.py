"""Newton's method with a safeguarded line search on the energy."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from math import isfinite
from typing import Literal, Protocol

import numpy as np
from scipy.linalg import blas

from ..arrays import Array, Index

_CUT = 0.5  # a step is accepted when the slope of the energy fell to this share
_SEARCHES = 40
_GROWTH = 4.0  # of a step too short, after which the energy still falls as steeply
_AWAY = 1e4  # lengths of the tube: one that moved so far, still out of balance, is not held
_PATIENCE = 2  # iterations before it is asked whether the tube runs away
_REST = 1e-6  # share of the run's largest force and unknown below which a state is at rest
STILL = 0.1  # of the limit of the residual: share of the unknowns that a step of rounding moves
ROUNDING_CAP = 1e-3  # rounding may excuse a residual up to this share of the forces, never more
_EPS = float(np.finfo(float).eps)


class Ending(Enum):
    """How an iteration ended; the value is what the user reads."""

    CONVERGED = "equilibrium found"
    MECHANISM = "the tangent is singular: nothing holds the tube against this load"
    YIELDED = "the loads on the spudcan lie outside its yield surface"
    BUCKLED = "the tube buckles: the tangent under its normal force is not positive definite"
    EXHAUSTED = "no equilibrium within the allowed iterations"


#: How the iteration goes on: along tangents with a line search, along tangents with full steps, as
#: plain Newton does, or along secants with a line search.
Method = Literal["line search", "full steps", "secant"]


@dataclass(frozen=True, slots=True)
class Limits:
    """How to iterate and when to stop.

    residual: largest force out of balance over the largest force. increment: largest part of an
    unknown that the last step moved over the largest unknown. iterations: most of them.
    """

    residual: float
    increment: float = np.inf
    iterations: int = 60
    method: Method = "line search"


@dataclass(frozen=True, slots=True)
class Scale:
    """Largest force (N) and unknown (m) of the whole run, for states that are nearly at rest."""

    force: float = 0.0
    unknown: float = 0.0


NO_SCALE = Scale()


@dataclass(slots=True)
class Work:
    """What was spent: solutions with the tangent, evaluations of the internal forces."""

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


class Equilibrium(Protocol):
    """What Newton's method needs of equations; solutions are with the tangent where `internal` was
    asked last."""

    @property
    def held(self) -> Index:
        """Unknowns that keep their values."""

    @property
    def length(self) -> float:
        """Of the tube or line, m."""

    @property
    def diagonal(self) -> Array:
        """Of the stiffness, (size,): what rounding of the unknowns makes forces of."""

    def internal(self, q: Array) -> Array:
        """Internal forces at q, (size,)."""

    def solve(self, right: Array) -> Array | None:
        """Solution with the tangent; None for a mechanism."""

    def solve_by_secants(self, right: Array) -> Array | None:
        """Solution with secant moduli."""

    def total_reaction(self) -> float:
        """Magnitudes of the soil's reaction, added up, N."""


@np.errstate(over="ignore", invalid="ignore")  # what runs away is told as a mechanism
def newton(
    system: Equilibrium, start: Array, load: Array, limits: Limits, scale: Scale = NO_SCALE
) -> Outcome:
    """Equilibrium of `system` under `load` (shape (n,)) from the unknowns `start`.

    Held unknowns keep their value in `start`. The energy of a path independent, non-softening
    reaction is convex, so that the search along each Newton direction makes every step descend.

    Short elements on a stiff tube make forces of mere rounding. Then the residual cannot become
    small, but the step that would remove it can: it is equilibrium when that step moves nothing.
    Rounding is measured against loads and soil, and excuses nothing on a tube that runs away.
    """
    work = Work()
    held = system.held if len(system.held) else None

    def evaluate(q: Array) -> tuple[Array, Array]:
        internal = system.internal(q)
        work.evaluations += 1
        residual = load - internal
        if held is not None:
            residual[held] = 0.0
        return internal, residual

    solve = system.solve_by_secants if limits.method == "secant" else system.solve
    go = whole_step if limits.method == "full steps" else search
    least = max(largest(load), _REST * scale.force)
    q = before = start
    internal, residual = evaluate(q)
    ending = Ending.EXHAUSTED
    for remaining in range(limits.iterations, -1, -1):
        size = max(largest(internal), least)
        worst = largest(residual)
        if not isfinite(worst):
            ending = Ending.MECHANISM
            break
        if worst <= limits.residual * size and moved(q, before, scale) <= limits.increment:
            ending = Ending.CONVERGED
            break
        if remaining == 0:
            break
        if work.iterations >= _PATIENCE and largest(q) > _AWAY * system.length:
            ending = Ending.MECHANISM
            break
        step = solve(residual)
        work.iterations += 1
        if step is None or not isfinite(slope := blas.ddot(step, residual)):
            ending = Ending.MECHANISM
            break
        if (
            worst <= ROUNDING_CAP * size
            and unmoved(system, q, step, (worst, size), limits, scale)
            and largest(q) <= system.length
            and worst <= ROUNDING_CAP * max(least, system.total_reaction())
        ):
            ending = Ending.CONVERGED
            break
        before = q
        q, internal, residual = go(evaluate, q, step, slope)
    return Outcome(q, internal, ending, worst / size if size else 0.0, work)


def moved(q: Array, before: Array, scale: Scale) -> float:
    """Largest part of an unknown that the last step moved over the largest unknown before it."""
    if q is before:
        return 0.0
    reach = reach_of(before, scale)
    return largest(q - before) / reach if reach else 0.0


def reach_of(q: Array, scale: Scale) -> float:
    """Largest unknown, or a share of the run's, m."""
    return max(largest(q), _REST * scale.unknown)


def largest(x: Array) -> float:
    """Largest magnitude; BLAS needs one call where NumPy needs two."""
    return abs(x.item(blas.idamax(x)))


def unmoved(
    system: Equilibrium,
    q: Array,
    step: Array,
    forces: tuple[float, float],
    limits: Limits,
    scale: Scale,
) -> bool:
    """Whether a residual is mere rounding: the step that would remove it moves nothing.

    forces: the largest force out of balance and the largest force, N.
    """
    worst, size = forces
    return (
        worst <= ROUNDING_CAP * size
        and largest(step) <= STILL * limits.residual * reach_of(q, scale)
        and worst <= float(rounding(system, q))
    )


def rounding(system: Equilibrium, q: Array) -> Array:
    """What rounding alone may leave of the residual, N; q: shape (..., size)."""
    return np.asarray(64.0 * _EPS * (system.diagonal * np.abs(q)).max(axis=-1))


def whole_step(
    evaluate: Callable[[Array], tuple[Array, Array]], q: Array, step: Array, slope: float
) -> tuple[Array, Array, Array]:
    """The end of `step`, wherever that leads."""
    trial = q + step
    return trial, *evaluate(trial)


def search(
    evaluate: Callable[[Array], tuple[Array, Array]], q: Array, step: Array, slope: float
) -> tuple[Array, Array, Array]:
    """A point along `step` where the energy falls much less steeply than at its start.

    `slope` is the (positive) product of step and residual at the start. The full step nearly
    always does. One that overshoots, as on the cube root's infinite slope, is cut by the Illinois
    form of the rule of false position. One that is short, as where hardly any soil has a modulus
    left, is lengthened: without end, if nothing holds the tube. Returns unknowns, internal forces
    and residual there.
    """
    low, high, g_low, g_high, s = 0.0, np.inf, slope, 0.0, 1.0
    for _ in range(_SEARCHES):
        trial = q + (step if s == 1.0 else s * step)
        internal, residual = evaluate(trial)
        g = blas.ddot(step, residual)
        if abs(g) <= _CUT * slope:
            break
        if g > 0.0:
            low, g_low, g_high = s, g, 0.5 * g_high
        else:
            high, g_high, g_low = s, g, 0.5 * g_low
        if high == np.inf:
            s *= _GROWTH
        else:
            margin = 0.02 * (high - low)
            s = low + (high - low) * g_low / (g_low - g_high)
            s = min(max(s, low + margin), high - margin)
    return trial, internal, residual
