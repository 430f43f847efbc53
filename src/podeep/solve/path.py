"""Beyond a peak: the equilibria that loads lead through as they fall in step with each other.

The problem that failed is followed by arc length from its last stable equilibrium on; the other one
is brought to each of its load factors.
"""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from ..arrays import Array
from ..model.assemble import Model, Problem
from ..model.coupling import pressed, rubs
from .advance import Track
from .continuation import Point, Walk, Way
from .loaded import loaded_at
from .newton import Ending, Limits, Scale, largest
from .statics import Failure, State, Which, advance_deflection, advance_stretch

STRIDE = 0.02  # between states: relative change of displacements and of load together
_MOST = 500  # states
_LEAST_LOAD = 0.05  # of the peak
_STILL = 1e-5  # of the peak: the load changes no more
_FLAT = 20  # states that tell so


class PathEnd(Enum):
    """How a path ended; the value is what the user reads."""

    FLAT = "the load changes no more"
    FALLEN = f"the load has fallen to {_LEAST_LOAD:.0%} of the peak"
    FAR = "the tube has moved by its diameter, and as far again as at the peak"
    RISEN = "the loads of the step are reached again, on the far side of the fall"
    LONG = f"{_MOST} states were followed"
    OTHER = "the other problem (lateral or axial) has no equilibrium at these loads"
    RUBBING = "tubes that rub against each other are not followed beyond a peak"
    LOST = (
        "the curve turns too sharply to be followed, as with a reaction that drops at once; let it "
        "drop over a longer displacement"
    )


@dataclass(frozen=True)
class Path:
    """What came beyond a peak: states with the direction of the curve in each, how it ended.

    start: factors of the last stable equilibrium. states: the first is the peak, none where nothing
    could be followed. ahead: tangents (unknowns of the problem that failed, load factor) in the
    states. growth: what a load factor of 1 adds to the named factors; share: to the forces, as a
    share of them.
    """

    which: Which
    start: Array
    states: tuple[State, ...]
    ahead: tuple[Way, ...]
    growth: Array
    share: float
    end: PathEnd

    @property
    def peak(self) -> int:
        """Place of the state with the largest loads."""
        return int(np.argmax([self.added(s) for s in self.states]))

    def added(self, state: State) -> float:
        """What the loads of a state are above those of `start`, in shares of the step."""
        return float((state.factors - self.start) @ self.growth / (self.growth @ self.growth))


def follow(model: Model, failure: Failure, limits: Limits) -> Path:
    """Follow the equilibria beyond a failure, from the peak on."""
    bare = (failure.which, failure.factors, (), (), failure.growth, 0.0)
    if rubs(model.axial.system):
        return Path(*bare, PathEnd.RUBBING)
    lateral = _track(model, failure, "lateral", limits)
    axial = _track(model, failure, "axial", limits)
    main, other = (lateral, axial) if failure.which == "lateral" else (axial, lateral)
    line = failure.factors, failure.growth
    walk = Walk.start(
        loaded_at(model, failure.which, line, axial.q, limits), main.q, limits, main.scale
    )
    if walk is None:
        return Path(*bare, PathEnd.LOST)
    judge = _Judge(model, failure, walk)
    states: list[State] = []
    ahead: list[Way] = []
    factors, energy, spent = failure.factors, failure.energy, (0, 0)
    main.internal = walk.point.internal
    end: PathEnd | None = None
    while end is None:
        climbing = not states and walk.point.ahead.factor > 0.0
        passed = walk.stride(STRIDE) if states or climbing else [walk.point]
        if passed is None and states:
            end = PathEnd.LOST
            break
        passed = passed or [walk.point]
        if passed[-1].factor > failure.left:
            passed[-1] = walk.level(failure.left) or passed[-1]
        for point in passed:
            energy += 0.5 * float((point.internal + main.internal) @ (point.q - main.q))
            main.q, main.internal = point.q, point.internal
        before, factors = factors, walk.loaded.factors(point.factor)
        if failure.which == "lateral":
            made = advance_stretch(other, before, factors)
        else:
            made = advance_deflection(model, other, main, before, factors)
        if made.outcome.ending is not Ending.CONVERGED:
            end = PathEnd.OTHER
            break
        work = walk.loaded.work
        states.append(
            State(
                failure.step + len(states),
                factors,
                lateral.q,
                axial.q,
                work.iterations - spent[0] + made.work.iterations,
                work.evaluations - spent[1] + made.work.evaluations,
                max(point.residual, made.outcome.residual),
                walk.smallest,
                energy + other.energy,
            )
        )
        ahead.append(point.ahead)
        spent = work.iterations, work.evaluations
        end = judge.end(point)
    return Path(
        *(failure.which, failure.factors, tuple(states), tuple(ahead), failure.growth),
        *(walk.load, end),
    )


def _track(model: Model, failure: Failure, which: Which, limits: Limits) -> Track:
    """A problem at the last equilibrium before a failure."""
    problem: Problem = getattr(model, which)
    q: Array = getattr(failure, which)
    track = Track(problem, limits, q, problem.system.internal(q))
    if which == "lateral" and problem.system.second_order:
        system = pressed(model, failure.axial, q, problem.system)
        track.problem = replace(problem, system=system)
        track.internal = track.problem.system.internal(q)
    track.scale = Scale(largest(track.internal), largest(q))
    return track


class _Judge:
    """Tells where a path ends."""

    def __init__(self, model: Model, failure: Failure, walk: Walk) -> None:
        system = walk.loaded.problem.system
        field = system.field
        self.nodes = np.union1d(field.dofs[:, 0], field.dofs[:, -field.nodal])
        self.size = field.size
        self.diameter = max(p.section.outer_diameter for p in model.pieces)
        self.most = failure.left
        self.loaded = walk.loaded
        self.levels: list[float] = []
        self.peak = 0.0
        self.moved = 0.0

    def end(self, point: Point) -> PathEnd | None:
        """Why the path ends here, if it does."""
        loaded, forces = self.loaded, self.loaded.load_growth
        if forces.any():
            level = float(loaded.problem.load(loaded.factors(point.factor)) @ forces)
        else:
            level = float(point.internal @ loaded.moved)
        shape = point.q.reshape(self.size, -1)[self.nodes]
        moved = float(np.linalg.norm(shape, axis=1).max())
        self.levels.append(level)
        if level >= self.peak:
            self.peak, self.moved = level, moved
        if point.factor >= self.most:
            return PathEnd.RISEN
        recent = self.levels[-_FLAT:]
        if len(recent) == _FLAT and max(recent) - min(recent) <= _STILL * self.peak:
            return PathEnd.FLAT
        if level < _LEAST_LOAD * self.peak:
            return PathEnd.FALLEN
        if moved > self.moved + max(self.diameter, self.moved):
            return PathEnd.FAR
        return PathEnd.LONG if len(self.levels) == _MOST else None
