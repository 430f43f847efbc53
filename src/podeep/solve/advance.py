"""One problem on its way through the steps, each halved where it must be."""

from dataclasses import dataclass, replace

from ..arrays import Array
from ..model.assemble import Problem
from .newton import NO_SCALE, Ending, Limits, Outcome, Scale, Work, largest, newton

HALVINGS = 16  # a peak is found to 1.5e-5 of the step


@dataclass(frozen=True, slots=True)
class Advance:
    """What a step came to: the last outcome, the part of the step that was reached, the smallest
    part that was taken at once, and what it cost."""

    outcome: Outcome
    reached: float
    smallest: float
    work: Work


@dataclass(slots=True)
class Track:
    """One problem on its way through the steps; halvings: of a step that fails."""

    problem: Problem
    limits: Limits
    q: Array
    internal: Array
    increment: Array | None = None
    energy: float = 0.0
    scale: Scale = NO_SCALE
    halvings: int = HALVINGS

    def advance(self, before: Array, after: Array) -> Advance:
        """Go from factors `before` to `after`, or as far as there is equilibrium."""
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
            if self._buckles():
                outcome = replace(outcome, ending=Ending.BUCKLED)
            if outcome.ending is Ending.CONVERGED:
                self._accept(outcome)
                reached = target
                if reached == 1.0:
                    return Advance(outcome, 1.0, smallest, work)
            elif part <= 2.0**-self.halvings:
                return Advance(outcome, reached, part, work)
            else:
                part *= 0.5
                smallest = min(smallest, part)

    def _solve(self, factors: Array, guess: Array | None) -> Outcome:
        system = self.problem.system
        start = self.q + guess if guess is not None else self.q.copy()
        start[system.held] = self.problem.prescribed(factors)[system.held]
        return newton(system, start, self.problem.load(factors), self.limits, self.scale)

    def _buckles(self) -> bool:
        """Whether the state last evaluated is held by nothing but the accident of its balance."""
        system = self.problem.system
        return system.second_order and not system.stable()

    def _accept(self, outcome: Outcome) -> None:
        move = outcome.q - self.q
        self.energy += 0.5 * float((outcome.internal + self.internal) @ move)
        self.q, self.internal, self.increment = outcome.q, outcome.internal, move
        self.scale = Scale(
            max(self.scale.force, largest(outcome.internal)),
            max(self.scale.unknown, largest(outcome.q)),
        )
