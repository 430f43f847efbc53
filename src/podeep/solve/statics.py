"""Quasi-static steps of one foundation: each step from the one before, halved where it must be."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Array
from ..model.assemble import Model
from ..model.results import compression
from .advance import Advance, Track
from .newton import Ending, Limits
from .yielding import advance_yielding

_PARTS = 16  # halvings that find how much of a step a spudcan can carry


@dataclass(frozen=True, slots=True)
class State:
    """Equilibrium of a step: load factors (names,), unknowns of both problems, what it took.

    energy: work of loads and holds since step 0, J. step_size: the smallest part of the step that
    was taken at once. softening: share of its stiffness that a spudcan's rotational spring keeps.
    """

    step: int
    factors: Array
    lateral: Array
    axial: Array
    iterations: int
    evaluations: int
    residual: float
    step_size: float
    energy: float
    softening: float = 1.0


@dataclass(frozen=True, slots=True)
class Failure:
    """Where a step stopped: the part of it that was reached and the problem that gave up.

    lateral, axial: unknowns of the last equilibria; which: the problem without one. softening: as
    of `State`, there.
    """

    step: int
    reached: float
    factors: Array
    which: Literal["lateral", "axial"]
    ending: Ending
    lateral: Array
    axial: Array
    softening: float = 1.0


class NoEquilibrium(Exception):
    """Raised by `steps` when a step has no equilibrium that could be found."""

    def __init__(self, failure: Failure) -> None:
        self.failure = failure
        super().__init__(failure.ending.value)


def steps(model: Model, factors: Array, limits: Limits) -> Iterator[State]:
    """Yield the state of every step, step 0 without load first.

    factors: shape (steps, names), those of steps 1 to n. Raises NoEquilibrium, after the states
    that were found, where a step fails even in its smallest parts.
    """
    lateral, axial = tracks = [
        Track(p, limits, np.zeros(p.system.size), np.zeros(p.system.size))
        for p in (model.lateral, model.axial)
    ]
    before = np.zeros(factors.shape[1])
    alike = same_increment(factors)
    yield State(0, before, lateral.q, axial.q, 0, 0, 0.0, 1.0, 0.0)
    for step, after in enumerate(factors, start=1):
        if not alike[step - 1]:
            for track in tracks:
                track.increment = track.tangent = None
        start = (replace(axial), replace(lateral)) if model.footing else None
        stretched = bent = advance_stretch(axial, before, after)
        if stretched.outcome.ending is Ending.CONVERGED:
            bent = advance_deflection(model, lateral, axial, before, after)
        ending = bent.outcome.ending
        if ending is not Ending.CONVERGED:
            reached = bent.reached
            if start and ending is Ending.YIELDED:
                reached, axial, lateral = largest_part(model, *start, before, after)
            which: Literal["lateral", "axial"] = "axial" if bent is stretched else "lateral"
            at = before + reached * (after - before)
            kept = lateral.problem.system.softening
            raise NoEquilibrium(Failure(step, reached, at, which, ending, lateral.q, axial.q, kept))
        yield State(
            step,
            after,
            lateral.q,
            axial.q,
            stretched.work.iterations + bent.work.iterations,
            stretched.work.evaluations + bent.work.evaluations,
            max(stretched.outcome.residual, bent.outcome.residual),
            min(stretched.smallest, bent.smallest),
            lateral.energy + axial.energy,
            lateral.problem.system.softening,
        )
        before = after


def advance_stretch(axial: Track, before: Array, after: Array) -> Advance:
    """Take the stretch from factors `before` to `after`: it does not depend on the deflection."""
    return axial.advance(before, after)


def advance_deflection(
    model: Model, lateral: Track, axial: Track, before: Array, after: Array
) -> Advance:
    """Take the deflection to `after`, where the stretch already is.

    The normal force bends it further, and the vertical load on a spudcan softens that.
    """
    if model.lateral.system.compressible:
        compress(model, lateral, axial.q)
    if model.footing is None:
        return lateral.advance(before, after)
    load = model.footing.vertical(axial.problem.system, axial.q)
    return advance_yielding(lateral, model.footing, load, before, after)


def largest_part(
    model: Model, axial: Track, lateral: Track, before: Array, after: Array
) -> tuple[float, Track, Track]:
    """The largest part of a step that leaves a spudcan within its surface, and the tracks there.

    axial, lateral: where the step starts.
    """
    held, broken, best = 0.0, 1.0, (axial, lateral)
    for _ in range(_PARTS):
        part = 0.5 * (held + broken)
        trial = replace(axial), replace(lateral)
        factors = before + part * (after - before)
        made = advance_stretch(trial[0], before, factors)
        if made.outcome.ending is Ending.CONVERGED:
            made = advance_deflection(model, trial[1], trial[0], before, factors)
        if made.outcome.ending is Ending.CONVERGED:
            held, best = part, trial
        else:
            broken = part
    return held, *best


def compress(model: Model, lateral: Track, axial: Array) -> None:
    """Put the normal force of a state of the stretch on the deflection."""
    system = lateral.problem.system
    force = compression(model, axial, system.compression_points)
    lateral.problem = replace(lateral.problem, system=system.compressed(force))


def same_increment(factors: Array) -> list[bool]:
    """For each step whether its factors grow just as in the one before."""
    growth = factors.copy()
    growth[1:] -= factors[:-1]
    change = np.abs(growth[1:] - growth[:-1]).max(axis=1, initial=0.0)
    return [False, *(change <= 1e-9 * np.abs(growth).max(initial=0.0)).tolist()]
