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

_PARTS = 16  # halvings that find how much of a step both problems can take


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
                track.increment = None
        start = replace(axial), replace(lateral)
        made = [advance_stretch(axial, before, after)]
        if made[0].outcome.ending is Ending.CONVERGED:
            made.append(advance_deflection(model, lateral, axial, before, after))
        last = made[-1]
        if last.outcome.ending is not Ending.CONVERGED:
            reached = last.reached
            if len(made) == 2 and not splits(model):
                reached, axial, lateral = largest_part(model, *start, before, after)
            which: Literal["lateral", "axial"] = "lateral" if len(made) == 2 else "axial"
            at = before + reached * (after - before)
            kept = lateral.problem.system.softening
            ending = last.outcome.ending
            raise NoEquilibrium(Failure(step, reached, at, which, ending, lateral.q, axial.q, kept))
        yield State(
            step,
            after,
            lateral.q,
            axial.q,
            sum(m.work.iterations for m in made),
            sum(m.work.evaluations for m in made),
            max(m.outcome.residual for m in made),
            min(m.smallest for m in made),
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
    if len(model.lateral.system.compression_points):
        compress(model, lateral, axial.q)
    if model.footing is None:
        return lateral.advance(before, after)
    load = model.footing.vertical(axial.problem.system, axial.q)
    return advance_yielding(lateral, model.footing, load, before, after)


def splits(model: Model) -> bool:
    """Whether parts of a step of the deflection are parts of the whole step.

    They are not where the stretch, which is found first, softens a spudcan or bends the tube.
    """
    yields = model.footing is not None and model.footing.surface is not None
    return not yields and len(model.lateral.system.compression_points) == 0


def largest_part(
    model: Model, axial: Track, lateral: Track, before: Array, after: Array
) -> tuple[float, Track, Track]:
    """The largest part of a step that both problems take, and the tracks there.

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
    growth = np.diff(factors, axis=0, prepend=np.zeros((1, factors.shape[1])))
    change = np.abs(np.diff(growth, axis=0)).max(axis=1, initial=0.0)
    return [False, *(change <= 1e-9 * np.abs(growth).max(initial=0.0)).tolist()]
