"""Error estimates from equilibrium on a finer mesh of richer elements.

Elements that do not follow the soil's force are cut where it bends, and all have one internal
function and one Gauss point more. The finer problem contains the solved state. Equilibrium there is
a step or two away and differs by what the coarser elements could not follow, at the nodes included:
that difference is the estimate.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ..arrays import Array, Flags
from ..model.assemble import Model, Problem
from ..model.coupling import pressed, rubbed, rubs
from ..model.results import Results, reacted
from ..model.system import System
from .across import across
from .newton import NO_SCALE, Ending, Limits, Scale, largest, newton
from .path import Path
from .prolong import prolong
from .refine import REST, Unresolved
from .statics import State, Which
from .together import equilibria

_RESIDUAL = 1e-8  # how near the finer mesh comes to equilibrium: errors of iteration are seen too
_BELOW = 1e-6  # of a depth: where the soil below a boundary is met, m
_WHICH: tuple[Which, ...] = ("axial", "lateral")  # the normal force of the stretch comes first
_PLACES = 12  # depths in each element at which both meshes are compared


@dataclass(frozen=True, slots=True)
class Estimate:
    """Estimated errors of a problem relative to the largest value in each step, shape (steps,).

    displacement, reaction and moment (or normal force): change of the largest value. anywhere:
    largest change of displacement or moment at any depth. force: soil force that elements do not
    resolve, by which the soil's force as it is reported misses the loads. All are 1 in a step whose
    equilibrium on the finer mesh was not found.
    """

    displacement: Array
    reaction: Array
    moment: Array
    anywhere: Array
    force: Array

    @property
    def worst(self) -> Array:
        """Largest relative error of each step, of any kind, shape (steps,)."""
        kinds = (self.displacement, self.reaction, self.moment, self.anywhere, self.force)
        return np.asarray(np.max(kinds, axis=0))


def _corrected(
    fine: Problem, systems: Sequence[System], start: Array, factors: Array, limits: Limits
) -> tuple[Array, Flags]:
    """Equilibria of the fine problem near states of it, by its `systems`; where there are none."""
    held = fine.system.held
    start = start.copy()
    start[:, held] = fine.prescribed(factors)[:, held]
    loads = fine.load(factors)
    found, lost = start, np.ones(len(start), dtype=bool)
    if all(system is systems[0] for system in systems):
        found, settled = equilibria(systems[0], start, loads, limits.residual)
        lost = ~settled
    scale = NO_SCALE
    for i, (q, system, load) in enumerate(zip(start, systems, loads, strict=True)):
        if lost[i]:
            outcome = newton(system, q, load, limits, scale)
            found[i], lost[i] = outcome.q, outcome.ending is not Ending.CONVERGED
        scale = Scale(max(scale.force, largest(load)), max(scale.unknown, largest(found[i])))
    return found, lost


def _finer(
    old: Results, richer: Model, states: Sequence[State], path: Path | None
) -> tuple[Results, Flags, Flags]:
    """Equilibria on the finer mesh near the states, and where deflection and stretch have none."""
    limits, model = Limits(residual=_RESIDUAL), old.model
    factors = np.array([s.factors for s in states])
    start: dict[Which, Array] = {}
    which: Which
    for which in _WHICH:
        one, fine = (getattr(m, which).system for m in (model, richer))
        start[which] = prolong(getattr(old, which), one.field, fine.field, fine.components)
    first, beyond = len(states), None
    if path is not None and path.states:
        first = len(states) - len(path.states)
        begun = {w: q[first:] for w, q in start.items()}
        beyond, factors[first:], known = across(model, richer, path, begun, limits)
    rough = richer.axial.system
    systems = [rubbed(model, s.lateral, rough) if rubs(rough) else rough for s in states]
    found: dict[Which, tuple[Array, Flags]] = {}
    for which in _WHICH:
        n = first if path is not None and path.which == which else len(states)
        if which == "lateral":
            drawn = zip(states, found["axial"][0], start["lateral"], strict=True)
            systems = [_as_in(state, richer, axial, bent) for state, axial, bent in drawn]
        fine = getattr(richer, which)
        q, lost = _corrected(fine, systems[:n], start[which][:n], factors[:n], limits)
        if beyond is not None and n < len(states):
            q, lost = np.concatenate([q, beyond]), np.concatenate([lost, ~known])
        found[which] = q, lost
    new = Results(richer, found["lateral"][0], found["axial"][0])
    return new, found["lateral"][1], found["axial"][1]


def _as_in(state: State, richer: Model, axial: Array, lateral: Array) -> System:
    """The lateral system of a finer model in a state: softened, and under the normal force there.

    axial, lateral: unknowns of the finer model.
    """
    softened = richer.lateral.system.softened(state.softening)
    return pressed(richer, axial, lateral, softened) if softened.second_order else softened


def _largest(values: Array) -> Array:
    """Largest size in each step of values (steps, n), or of vectors (steps, components, n)."""
    size = np.abs(values) if values.ndim == 2 else np.linalg.norm(values, axis=1)
    return np.asarray(size.max(axis=1, initial=0.0))


def _outer_moments(problem: Problem, states: Sequence[State], factors: Array) -> Array:
    """Largest moment of loads and springs on the tube in each state, N m.

    A tube loaded at its foot alone has moments of mere rounding: these are no scale for an error.
    """
    forces = [
        problem.system.softened(s.softening).outer_forces(s.lateral, problem.load(factor))
        for s, factor in zip(states, factors, strict=True)
    ]
    field = problem.system.field
    slopes = np.union1d(field.dofs[:, 1], field.dofs[:, -1])
    turning = np.array(forces).reshape(len(forces), field.size, -1)[:, slopes]
    return _largest(turning) * field.slope_length


@dataclass(frozen=True, eq=False)
class _Pair:
    """A quantity on the finer mesh and as it was, at the same depths, and its least scale."""

    new: Array
    old: Array
    least: Array | float = 0.0

    @cached_property
    def peak(self) -> Array:
        return _largest(self.new)

    @property
    def largest(self) -> Array:
        """Change of the largest value over it."""
        return self._share(np.abs(self.peak - _largest(self.old)))

    @property
    def anywhere(self) -> Array:
        """Largest change over the largest value."""
        return self._share(_largest(self.new - self.old))

    def _share(self, change: Array) -> Array:
        """Change over size; a step at rest is measured by a share of the largest step."""
        size = np.maximum(self.peak, self.least)
        size = np.maximum(size, REST * size.max(initial=0.0))
        return np.asarray(np.divide(change, size, out=np.zeros(len(size)), where=size > 0.0))


def _estimate(moved: _Pair, held: _Pair, inner: _Pair, force: Array, lost: Flags) -> Estimate:
    """From displacement, reaction and moment (or normal force); lost: steps without equilibrium."""
    anywhere = np.maximum(moved.anywhere, inner.anywhere)
    kinds = (moved.largest, held.largest, inner.largest, anywhere, force)
    return Estimate(*(np.where(lost, 1.0, kind) for kind in kinds))


def estimate(
    old: Results,
    richer: Model,
    states: Sequence[State],
    parts: Sequence[Unresolved],
    path: Path | None = None,
) -> tuple[Estimate, Estimate]:
    """Estimate the discretisation errors of solved `states`, lateral and axial.

    old: their results. richer: the model on a finer mesh of a higher degree. parts: what the
    elements do not resolve. path: where the last of the states lie beyond a peak. Errors there are
    at the same place across the path; 1 where none was found.
    """
    model, soil = old.model, old.model.profile
    factors = np.array([s.factors for s in states])
    new, lost, adrift = _finer(old, richer, states, path)
    share = np.arange(_PLACES) / _PLACES
    inside = richer.edges[:-1, None] + np.diff(richer.edges)[:, None] * share
    every = np.append(inside.ravel(), richer.edges[-1])
    wet = np.unique(np.concatenate([every, richer.edges[:-1] + _BELOW]))
    wet = wet[wet >= 0.0]
    lateral, shaft = (react(wet, old.diameter(wet)) for react in (soil.lateral, soil.shaft))
    outer = _outer_moments(model.lateral, states, factors)

    def of_all(value: Callable[[Results, Array, int], Array]) -> tuple[Array, Array]:
        """A quantity of all tubes on the finer mesh and as it was."""
        return new.of_all(partial(value, new), every), old.of_all(partial(value, old), every)

    def both(motion: Callable[[Results, Array], Array]) -> Array:
        """A motion in the soil on the finer mesh, then as it was."""
        return np.concatenate([motion(new, wet), motion(old, wet)])

    return (
        _estimate(
            _Pair(*of_all(lambda r, x, tube: r.deflection(x, 0, tube))),
            _Pair(*np.split(reacted(both(Results.deflection), lateral), 2)),
            _Pair(*of_all(lambda r, x, tube: r.shear_and_moment(x, tube)[1]), outer),
            parts[0].total,
            lost,
        ),
        _estimate(
            _Pair(*of_all(lambda r, x, tube: r.settlement(x, 0, tube))),
            _Pair(*np.split(shaft.evaluate(both(Results.settlement))[0], 2)),
            _Pair(*of_all(Results.compression)),
            parts[1].total,
            adrift,
        ),
    )


def unestimated(steps: int) -> Estimate:
    """Errors of 100 % for states whose estimate was not waited for."""
    return Estimate(*(np.ones(steps) for _ in range(5)))
