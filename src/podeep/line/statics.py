"""Statics of a line by stages: it is laid down first, then its ends move and loads grow.

Contact with friction depends on the way: the load path is that of the stages, each taken in parts
that are as long as Newton's method finds equilibrium in.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from ..solve.newton import Ending, Limits, Outcome, Scale, Work, largest, newton
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

    q: unknowns; load: the factor on the load; forces: what holds the held unknowns, (held,), N;
    reaction: what the bed resists with at its points, (n, components), N/m; energy: work of the
    weight and of what holds the line since it was laid, J; reached: part of the stage; ending:
    CONVERGED, or why it stopped; residual: force out of balance over the largest one; parts, work:
    what it took.
    """

    q: Array
    load: float
    forces: Array
    reaction: Array
    energy: float
    reached: float
    ending: Ending
    residual: float
    parts: int
    work: Work


def laid(system: LineSystem, start: Array, limits: Limits) -> LineState:
    """The line laid down without friction, from a shape `start` that is near to it, (size,)."""
    outcome = newton(system, start, system.load, limits, _scale(system))
    forces = (system.internal(outcome.q) - system.load)[system.held]
    if system.bed is not None and outcome.ending is Ending.CONVERGED:
        system.bed.press()
        system.bed.commit(outcome.q)
    told = (outcome.ending, outcome.residual, 1, outcome.work)
    return LineState(outcome.q, 1.0, forces, system.reaction, 0.0, 1.0, *told)


def follow(
    system: LineSystem, start: LineState, stages: Iterable[Stage], limits: Limits
) -> Iterator[LineState]:
    """Yield the state at the end of each stage; the last one is where a stage stopped, if any does.

    start: where the line was laid, or an earlier stage has ended. Raises ValueError where that is
    no equilibrium.
    """
    if start.ending is not Ending.CONVERGED:
        raise ValueError(f"stages begin in equilibrium, but: {start.ending.value}")
    state = start
    for stage in stages:
        state = _stage(system, state, stage, limits)
        yield state
        if state.ending is not Ending.CONVERGED:
            return


def _stage(system: LineSystem, start: LineState, stage: Stage, limits: Limits) -> LineState:
    limits = replace(limits, iterations=min(_PATIENCE, limits.iterations))
    q, load, begin = start.q, start.load, start.q[system.held]
    work, part, parts, reached, residual = Work(), _LONGEST, 0, 0.0, start.residual
    pushed, energy = _pushed(system, q, load), start.energy
    while True:
        target = min(reached + part, 1.0)
        factor = start.load + target * (stage.load - start.load)
        move = np.zeros_like(q)
        move[system.held] = begin + target * (stage.held - begin) - q[system.held]
        outcome = _part(system, q, move, factor * system.load, limits)
        work.iterations += outcome.work.iterations
        work.evaluations += outcome.work.evaluations
        if outcome.ending is Ending.CONVERGED:
            before, moved = pushed, outcome.q - q
            q, load, residual = outcome.q, factor, outcome.residual
            pushed = _pushed(system, q, load)
            energy += 0.5 * float((before + pushed) @ moved)
            reached, parts = target, parts + 1
            if outcome.work.iterations <= _EASY:
                part = min(2.0 * part, _LONGEST)
        else:
            part *= 0.5
        if reached == 1.0 or part < _SHORTEST:
            forces = (_pushed(system, q, load) - load * system.load)[system.held]
            told = (energy, reached, outcome.ending, residual, parts, work)
            return LineState(q, load, forces, system.reaction, *told)


def _scale(system: LineSystem) -> Scale:
    """What a line without loads is at rest against: a share of EA."""
    return Scale(force=float(system.sections.axial.max()))


def _pushed(system: LineSystem, q: Array, load: float) -> Array:
    """All that acts on a line in equilibrium but the seabed: the weight, and what holds it, N."""
    total = load * system.load
    total[system.held] = system.internal(q)[system.held]
    return total


def _part(system: LineSystem, q: Array, move: Array, load: Array, limits: Limits) -> Outcome:
    """Equilibrium after a move of the held unknowns, whose friction goes with its normal force.

    The bed stays where it was if none is found.
    """
    system.internal(q)
    led = system.led(move)
    start, bed, work = q + (move if led is None else led), system.bed, Work()
    pressing = None if bed is None else bed.pressing
    for _ in range(_PRESSES):
        outcome = newton(system, start, load, limits, _scale(system))
        start = outcome.q
        work.iterations += outcome.work.iterations
        work.evaluations += outcome.work.evaluations
        if outcome.ending is not Ending.CONVERGED or bed is None:
            break
        bearable = limits.residual * max(largest(load), largest(outcome.internal))
        if bed.press() <= bearable:
            bed.commit(outcome.q)
            break
    else:
        outcome = replace(outcome, ending=Ending.EXHAUSTED)
    if bed is not None and pressing is not None and outcome.ending is not Ending.CONVERGED:
        bed.pressing = pressing
    return replace(outcome, work=work)
