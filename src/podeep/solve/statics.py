"""Quasi-static steps of one foundation: each step from the one before, halved where it must be."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..arrays import Array
from ..model.assemble import Model, Problem
from .newton import NO_SCALE, Ending, Limits, Outcome, Scale, Work, largest, newton

_HALVINGS = 10


@dataclass(frozen=True, slots=True)
class State:
    """Equilibrium of a step: load factors (names,), unknowns of both problems, what it took.

    energy: work of loads and holds since step 0, J. step_size: the smallest part of the step that
    was taken at once.
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


@dataclass(slots=True)
class _Path:
    """One problem on its way through the steps."""

    problem: Problem
    limits: Limits
    q: Array
    internal: Array
    increment: Array | None = None
    energy: float = 0.0
    scale: Scale = NO_SCALE

    def advance(self, before: Array, after: Array) -> tuple[Outcome, float, float, Work]:
        """Go from factors `before` to `after`; outcome, part reached, smallest part, work."""
        work = Work()
        reached, part, smallest = 0.0, 1.0, 1.0
        guess = self.increment
        while True:
            target = min(reached + part, 1.0)
            factors = before + target * (after - before)
            outcome = self._solve(factors, guess)
            work.iterations += outcome.work.iterations
            work.evaluations += outcome.work.evaluations
            guess = None
            if outcome.ending is Ending.CONVERGED:
                self._accept(outcome)
                reached = target
                if reached == 1.0:
                    return outcome, 1.0, smallest, work
            elif part <= 2.0**-_HALVINGS:
                return outcome, reached, part, work
            else:
                part *= 0.5
                smallest = min(smallest, part)

    def _solve(self, factors: Array, guess: Array | None) -> Outcome:
        system = self.problem.system
        start = self.q + guess if guess is not None else self.q.copy()
        start[system.held] = self.problem.prescribed(factors)[system.held]
        return newton(system, start, self.problem.load(factors), self.limits, self.scale)

    def _accept(self, outcome: Outcome) -> None:
        move = outcome.q - self.q
        self.energy += 0.5 * float((outcome.internal + self.internal) @ move)
        self.q, self.internal, self.increment = outcome.q, outcome.internal, move
        self.scale = Scale(
            max(self.scale.force, largest(outcome.internal)),
            max(self.scale.unknown, largest(outcome.q)),
        )


def steps(model: Model, factors: Array, limits: Limits) -> Iterator[State]:
    """Yield the state of every step, step 0 without load first.

    factors: shape (steps, names), those of steps 1 to n. Raises NoEquilibrium, after the states
    that were found, where a step fails even in parts of 1/1024.
    """
    paths = [
        _Path(p, limits, np.zeros(p.system.size), np.zeros(p.system.size))
        for p in (model.lateral, model.axial)
    ]
    before = np.zeros(factors.shape[1])
    alike = same_increment(factors)
    state = State(0, before, paths[0].q, paths[1].q, 0, 0, 0.0, 1.0, 0.0)
    yield state
    for step, after in enumerate(factors, start=1):
        if not alike[step - 1]:
            for path in paths:
                path.increment = None
        iterations, evaluations, residual, size = 0, 0, 0.0, 1.0
        for path in paths:
            outcome, reached, smallest, work = path.advance(before, after)
            if outcome.ending is not Ending.CONVERGED:
                at = before + reached * (after - before)
                which: Literal["lateral", "axial"] = "lateral" if path is paths[0] else "axial"
                found = (paths[0].q, paths[1].q)
                raise NoEquilibrium(Failure(step, reached, at, which, outcome.ending, *found))
            iterations += work.iterations
            evaluations += work.evaluations
            residual, size = max(residual, outcome.residual), min(size, smallest)
        energy = paths[0].energy + paths[1].energy
        state = State(
            step, after, paths[0].q, paths[1].q, iterations, evaluations, residual, size, energy
        )
        yield state
        before = after


def same_increment(factors: Array) -> list[bool]:
    """For each step whether its factors grow just as in the one before."""
    growth = np.diff(factors, axis=0, prepend=np.zeros((1, factors.shape[1])))
    change = np.abs(np.diff(growth, axis=0)).max(axis=1, initial=0.0)
    return [False, *(change <= 1e-9 * np.abs(growth).max(initial=0.0)).tolist()]
