"""Quasi-static steps of one foundation: each step from the one before, halved where it must be."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Array
from ..model.assemble import Model
from ..model.results import compression
from .advance import Track
from .newton import Ending, Limits
from .yielding import advance_yielding


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

    lateral, axial: unknowns of the last equilibria; which: the problem without one.
    """

    step: int
    reached: float
    factors: Array
    which: Literal["lateral", "axial"]
    ending: Ending
    lateral: Array
    axial: Array


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
        iterations, evaluations, residual, size = 0, 0, 0.0, 1.0
        # a spudcan softens under its vertical load: stretch comes before deflection
        for track in (axial, lateral):
            if track is lateral and len(model.lateral.system.compression_points):
                compress(model, lateral, axial.q)
            if track is lateral and model.footing is not None:
                load = model.footing.vertical(axial.problem.system, axial.q)
                made = advance_yielding(track, model.footing, load, before, after)
            else:
                made = track.advance(before, after)
            if made.outcome.ending is not Ending.CONVERGED:
                at = before + made.reached * (after - before)
                which: Literal["lateral", "axial"] = "lateral" if track is lateral else "axial"
                ending = made.outcome.ending
                raise NoEquilibrium(
                    Failure(step, made.reached, at, which, ending, lateral.q, axial.q)
                )
            iterations += made.work.iterations
            evaluations += made.work.evaluations
            residual, size = max(residual, made.outcome.residual), min(size, made.smallest)
        energy = lateral.energy + axial.energy
        spent = (iterations, evaluations, residual, size, energy)
        kept = lateral.problem.system.softening
        yield State(step, after, lateral.q, axial.q, *spent, kept)
        before = after


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
