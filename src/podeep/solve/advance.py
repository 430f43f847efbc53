"""One problem on its way through the steps, each halved where it must be."""

from dataclasses import dataclass, replace

from scipy.linalg import blas

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
    """One problem on its way through the steps.

    increment: the last move, None where the next step does not load on as that one did. tangent:
    the move that the tangent asked for at its start. straight: the last move was just as guessed.
    halvings: of a step that fails.
    """

    problem: Problem
    limits: Limits
    q: Array
    internal: Array
    increment: Array | None = None
    tangent: Array | None = None
    straight: bool = False
    energy: float = 0.0
    scale: Scale = NO_SCALE
    halvings: int = HALVINGS

    def copy(self) -> "Track":
        """A track of its own from here on."""
        return Track(
            *(self.problem, self.limits, self.q, self.internal, self.increment, self.tangent),
            *(self.straight, self.energy, self.scale, self.halvings),
        )

    def take(self, other: "Track") -> None:
        """Go where another track of the same problem is."""
        self.problem, self.q, self.internal = other.problem, other.q, other.internal
        self.increment, self.tangent, self.straight = other.increment, other.tangent, other.straight
        self.energy, self.scale = other.energy, other.scale

    def advance(self, before: Array, after: Array) -> Advance:
        """Go from factors `before` to `after`, or as far as there is equilibrium."""
        work = Work()
        reached, part, smallest = 0.0, 1.0, 1.0
        guess = self._guess(before, after)
        while True:
            target = min(reached + part, 1.0)
            factors = after if target == 1.0 else before + target * (after - before)
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
                    self.straight = part == 1.0 and outcome.work.iterations == 0
                    return Advance(outcome, 1.0, smallest, work)
            elif part <= 2.0**-self.halvings:
                return Advance(outcome, reached, part, work)
            else:
                part *= 0.5
                smallest = min(smallest, part)

    def _guess(self, before: Array, after: Array) -> Array | None:
        """Where a whole step is likely to end; None: start from where it begins.

        Steps that load on alike are extrapolated: by the last move and the tangent, and by the
        tangent before it if that bends the path less (Hermite interpolation, carried on).
        """
        problem, move = self.problem, self.increment
        system = problem.system
        imposed = len(system.held) > 0 and problem.imposed.any()
        if move is None:
            fresh = self.scale.unknown == 0.0 and not imposed
            return system.leave_rest(problem.load(after)) if fresh else None
        if imposed or self.straight:
            return self.q + move
        tangent = system.follow(self.q, problem.load(after - before))
        if tangent is None:
            return self.q + move
        bend = tangent - move
        guess = self.q + tangent
        guess += bend
        if self.tangent is not None:
            twist = 2.0 * (bend + self.tangent - move)
            if largest(twist) < largest(bend):
                guess += twist
        self.tangent = tangent
        return guess

    def _solve(self, factors: Array, guess: Array | None) -> Outcome:
        problem = self.problem
        start = self.q if guess is None else guess
        if len(held := problem.system.held):
            start = start.copy()
            start[held] = problem.prescribed(factors)[held]
        return newton(problem.system, start, problem.load(factors), self.limits, self.scale)

    def _buckles(self) -> bool:
        """Whether the state last evaluated is held by nothing but the accident of its balance."""
        system = self.problem.system
        return system.second_order and not system.stable()

    def _accept(self, outcome: Outcome) -> None:
        move = outcome.q - self.q
        self.energy += 0.5 * blas.ddot(outcome.internal + self.internal, move)
        self.q, self.internal, self.increment = outcome.q, outcome.internal, move
        self.scale = Scale(
            max(self.scale.force, largest(outcome.internal)),
            max(self.scale.unknown, largest(outcome.q)),
        )
