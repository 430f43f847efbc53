"""Quasi-static steps of one foundation: each step from the one before, halved where it must be."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Array
from ..model.assemble import Model
from ..model.coupling import pressed, rubs
from .advance import HALVINGS, Advance, Track
from .newton import Ending, Limits
from .rubbing import advance_rubbing
from .yielding import advance_yielding

Which = Literal["lateral", "axial"]


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

    factors, lateral, axial, energy: of the last equilibrium, of both problems at the same factors;
    which: the problem without one. growth: what the whole step adds to the factors. softening: as
    of `State`, there.
    """

    step: int
    reached: float
    factors: Array
    growth: Array
    which: Which
    ending: Ending
    lateral: Array
    axial: Array
    energy: float
    softening: float = 1.0

    @property
    def left(self) -> float:
        """The part of the step that was not reached."""
        return 1.0 - self.reached


class NoEquilibrium(Exception):
    """Raised by `steps` when a step has no equilibrium that could be found."""

    def __init__(self, failure: Failure) -> None:
        self.failure = failure
        super().__init__(failure.ending.value)


def steps(model: Model, factors: Array, limits: Limits) -> Iterator[State]:
    """Yield the state of every step, step 0 without load but the tubes' own weight first.

    factors: shape (steps, names), those of steps 1 to n. Raises NoEquilibrium, after the states
    that were found, where a step fails even in its smallest parts.
    """
    lateral, axial = tracks = [
        Track(p, limits, np.zeros(p.system.size), np.zeros(p.system.size))
        for p in (model.lateral, model.axial)
    ]
    before = np.zeros(factors.shape[1])
    alike = same_increment(factors)
    yield at_rest(axial, before, lateral.q)
    for step, after in enumerate(factors, start=1):
        if not alike[step - 1]:
            for track in tracks:
                track.increment = track.tangent = None
        start = axial.copy(), lateral.copy()
        made, which = advance_both(model, axial, lateral, before, after)
        if made[-1].outcome.ending is not Ending.CONVERGED:
            span = (step, before, after)
            raise NoEquilibrium(stopped(model, start, (axial, lateral), (made, which), span))
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


def at_rest(axial: Track, factors: Array, lateral: Array) -> State:
    """The state before loading; raises NoEquilibrium where the tubes do not bear their weight."""
    if not axial.problem.weights:
        return State(0, factors, lateral, axial.q, 0, 0, 0.0, 1.0, 0.0)
    made = axial.advance(factors, factors)
    ending = made.outcome.ending
    if ending is not Ending.CONVERGED:
        growth = np.zeros_like(factors)
        failure = Failure(0, 0.0, factors, growth, "axial", ending, lateral, axial.q, 0.0)
        raise NoEquilibrium(failure)
    work, residual = made.work, made.outcome.residual
    axial.increment = None
    return State(
        *(0, factors, lateral, axial.q, work.iterations, work.evaluations, residual, 1.0),
        axial.energy,
    )


def advance_both(
    model: Model, axial: Track, lateral: Track, before: Array, after: Array
) -> tuple[list[Advance], Which]:
    """Take both problems from factors `before` to `after`.

    Returns what it took and the problem that was solved last: the one without equilibrium, if
    there is one.
    """
    if rubs(model.axial.system):
        return advance_rubbing(model, lateral, axial, before, after)
    made = [advance_stretch(axial, before, after)] if model.needs.axial else []
    if made and made[0].outcome.ending is not Ending.CONVERGED:
        return made, "axial"
    return [*made, advance_deflection(model, lateral, axial, before, after)], "lateral"


def stopped(
    model: Model,
    start: tuple[Track, Track],
    tried: tuple[Track, Track],
    made: tuple[Sequence[Advance], Which],
    span: tuple[int, Array, Array],
) -> Failure:
    """How far a step goes that fails.

    start, tried: axial and lateral track before the step and after it was tried, which took `made`.
    span: the step, its factors before and after. Both problems are under the same factors: the one
    that comes less far tells what is reached.
    """
    (axial, lateral), (step, before, after) = tried, span
    which, last = made[1], made[0][-1]
    reached, ending = last.reached, last.outcome.ending
    if which == "axial" and not rubs(model.axial.system):
        factors = before + reached * (after - before)
        one = advance_deflection(model, lateral, axial, before, factors)
        if one.outcome.ending is not Ending.CONVERGED:
            which, ending = "lateral", one.outcome.ending
            reached *= one.reached
            axial = replace(start[0])
    if rubs(model.axial.system) or (which == "lateral" and not splits(model)):
        reached, axial, lateral = largest_part(model, *start, before, after)
    elif which == "lateral":
        axial = replace(start[0])
        advance_stretch(axial, before, before + reached * (after - before))
    factors = before + reached * (after - before)
    kept = lateral.problem.system.softening
    energy = lateral.energy + axial.energy
    growth = after - before
    return Failure(
        *(step, reached, factors, growth, which, ending, lateral.q, axial.q, energy, kept)
    )


def splits(model: Model) -> bool:
    """Whether parts of a step of the deflection are parts of the whole step.

    They are not where the stretch, which is found first, softens a spudcan or bends the tube.
    """
    yields = model.footing is not None and model.footing.surface is not None
    return not yields and not model.needs.second_order


def advance_stretch(axial: Track, before: Array, after: Array) -> Advance:
    """Take the stretch from factors `before` to `after`: it does not depend on the deflection."""
    return axial.advance(before, after)


def advance_deflection(
    model: Model, lateral: Track, axial: Track, before: Array, after: Array
) -> Advance:
    """Take the deflection to `after`, where the stretch already is.

    The normal force bends it further, and the vertical load on a spudcan softens that.
    """
    if model.needs.second_order:
        system = pressed(model, axial.q, lateral.q, lateral.problem.system)
        lateral.problem = replace(lateral.problem, system=system)
    if model.footing is None:
        return lateral.advance(before, after)
    load = model.footing.vertical(axial.problem.system, axial.q)
    return advance_yielding(lateral, model.footing, load, before, after)


def largest_part(
    model: Model, axial: Track, lateral: Track, before: Array, after: Array
) -> tuple[float, Track, Track]:
    """The largest part of a step that both problems can take together, and the tracks there.

    axial, lateral: where the step starts.
    """
    held, broken = 0.0, 1.0
    best = replace(axial, halvings=0), replace(lateral, halvings=0)
    for _ in range(HALVINGS):
        part = 0.5 * (held + broken)
        trial = replace(best[0]), replace(best[1])
        start, target = (before + share * (after - before) for share in (held, part))
        made, _ = advance_both(model, *trial, start, target)
        if made[-1].outcome.ending is Ending.CONVERGED:
            held, best = part, trial
        else:
            broken = part
    return held, *best


def same_increment(factors: Array) -> list[bool]:
    """For each step whether its factors grow just as in the one before."""
    growth = np.diff(factors, axis=0, prepend=np.zeros((1, factors.shape[1])))
    change = np.abs(np.diff(growth, axis=0)).max(axis=1, initial=0.0)
    return [False, *(change <= 1e-9 * np.abs(growth).max(initial=0.0)).tolist()]
