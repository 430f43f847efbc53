"""Statics of a line by stages: it is laid down first, then its ends move and loads grow.

Contact with friction depends on the way: the load path is that of the stages, each taken in parts
that are as long as Newton's method finds equilibrium in.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from ..solve.newton import Ending, Limits, Outcome, Work, largest, newton
from .equations import LineSystem

_LONGEST, _SHORTEST = 0.25, 2.0**-20  # parts of a stage
_EASY = 8  # iterations: after fewer, the next part is twice as long
_PRESSES = 30  # times that the normal force is brought up to date
_PATIENCE = 25  # iterations of a part before it is halved


@dataclass(frozen=True, slots=True)
class Stage:
    """Where a stage leads: values of the held unknowns, (held,), and the factor on the load."""

    held: Array
    load: float = 1.0


@dataclass(frozen=True, slots=True)
class LineState:
    """Equilibrium at the end of a stage, or where it stopped.

    q: unknowns; forces: what holds the held unknowns, (held,), N; reached: part of the stage;
    ending: CONVERGED, or why it stopped; parts, work: what it took.
    """

    q: Array
    forces: Array
    reached: float
    ending: Ending
    residual: float
    parts: int
    work: Work


def laid(system: LineSystem, start: Array, limits: Limits) -> LineState:
    """The line laid down without friction from a shape `start` that is near to it, (size,)."""
    outcome = newton(system, start, system.load, limits)  # type: ignore[arg-type]
    if system.bed is not None and outcome.ending is Ending.CONVERGED:
        system.internal(outcome.q)
        system.bed.press()
        system.bed.commit(outcome.q)
    return _state(system, outcome.q, 1.0, outcome.ending, outcome.residual, 1, outcome.work)


def _pressed(system: LineSystem, q: Array, load: Array, limits: Limits) -> Outcome:
    """Equilibrium whose friction goes with its own normal force."""
    work, force = Work(), largest(load)
    for _ in range(_PRESSES):
        outcome = newton(system, q, load, limits)  # type: ignore[arg-type]
        work.iterations += outcome.work.iterations
        work.evaluations += outcome.work.evaluations
        if outcome.ending is not Ending.CONVERGED or system.bed is None:
            break
        if system.bed.press() <= limits.residual * max(force, largest(outcome.internal)):
            break
        q = outcome.q
    else:
        outcome = replace(outcome, ending=Ending.EXHAUSTED)
    return replace(outcome, work=work)


def _state(
    system: LineSystem,
    q: Array,
    reached: float,
    ending: Ending,
    residual: float,
    parts: int,
    work: Work,
    load: float = 1.0,
) -> LineState:
    forces = (system.internal(q) - load * system.load)[system.held]
    return LineState(q, forces, reached, ending, residual, parts, work)


def follow(
    system: LineSystem, start: Array, stages: list[Stage], limits: Limits, load: float = 1.0
) -> Iterator[LineState]:
    """Yield the state at the end of each stage; the last one is where a stage stopped, if any does.

    start: equilibrium with friction committed; load: the factor on the load there.
    """
    q = start
    for stage in stages:
        state, q, load = _stage(system, q, load, stage, limits)
        yield state
        if state.ending is not Ending.CONVERGED:
            return


def _stage(
    system: LineSystem, q: Array, load: float, stage: Stage, limits: Limits
) -> tuple[LineState, Array, float]:
    patient = Limits(limits.residual, limits.increment, min(_PATIENCE, limits.iterations))
    begin, first = q[system.held].copy(), load
    reached, part, parts, work, residual = 0.0, _LONGEST, 0, Work(), 0.0
    while reached < 1.0:
        target = min(reached + part, 1.0)
        factor = first + target * (stage.load - first)
        move = np.zeros_like(q)
        move[system.held] = begin + target * (stage.held - begin) - q[system.held]
        system.internal(q)
        led = system.led(move)
        guess = q + (move if led is None else led)
        outcome = _pressed(system, guess, factor * system.load, patient)
        work.iterations += outcome.work.iterations
        work.evaluations += outcome.work.evaluations
        if outcome.ending is Ending.CONVERGED:
            q, reached, load, residual = outcome.q, target, factor, outcome.residual
            parts += 1
            if system.bed is not None:
                system.bed.commit(q)
            if outcome.work.iterations <= _EASY:
                part = min(2.0 * part, _LONGEST)
        elif part > _SHORTEST:
            part *= 0.5
        else:
            return (
                _state(
                    system, q, reached, outcome.ending, outcome.residual, parts, work, load
                ),
                q,
                load,
            )
    state = _state(system, q, 1.0, Ending.CONVERGED, residual, parts, work, load)
    return state, q, load
