"""Error estimates from equilibrium in richer elements, and refinement where they are large.

The same mesh with one internal function and one Gauss point more an element contains the solved
state. Equilibrium there is a step or two away and differs by what the coarser elements could not
follow, at the nodes included: that difference is the estimate. Where to refine is told by the soil
force that the Gauss points of an element do not resolve.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..beam.field import Field
from ..beam.shapes import gauss_interpolation, gauss_points
from ..model.assemble import Model, Problem
from ..model.results import Results, compression, embedded
from ..model.system import System
from .continuation import Control, Metric, Way
from .loaded import loaded_at
from .newton import Limits, Scale, largest, newton
from .path import Path
from .statics import State, Which

_RESIDUAL = 1e-4  # of the accuracy: how near the richer elements come to equilibrium
_SHORTEST = 5e-5  # element over tube: shorter ones on a stiff tube are mere rounding
_REST = 1e-6  # share of the run's largest value below which a step is at rest
_REFINE = 0.2  # elements with at least this share of the largest unresolved force are halved


@dataclass(frozen=True, slots=True)
class Estimate:
    """Estimated errors of a problem relative to the largest value in each step, shape (steps,).

    displacement and moment (or normal force): largest change anywhere; reaction: change of the
    largest value, since pointwise it means nothing where a cube root crosses zero. unresolved: soil
    force that each embedded element does not resolve in each step, as a share of all soil force,
    shape (steps, elements).
    """

    displacement: Array
    reaction: Array
    moment: Array
    unresolved: Array

    @property
    def worst(self) -> Array:
        """Largest relative error of each step, unresolved soil force included, shape (steps,)."""
        force = self.unresolved.sum(axis=1)
        return np.asarray(np.max([self.displacement, self.reaction, self.moment, force], axis=0))

    def where(self, known: npt.NDArray[np.bool_]) -> "Estimate":
        """The same, with errors of 100 % in the steps that are not known."""
        u, p, m = (np.where(known, e, 1.0) for e in (self.displacement, self.reaction, self.moment))
        return Estimate(u, p, m, self.unresolved)


def prolong(q: Array, coarse: Field, fine: Field, components: int) -> Array:
    """The same state in elements of a higher degree: the added internal unknowns are zero."""
    rows = np.zeros((fine.size, components))
    given = q.reshape(-1, components)
    head = coarse.local - coarse.nodal
    rows[fine.dofs[:, :head]] = given[coarse.dofs[:, :head]]
    rows[fine.dofs[:, -fine.nodal :]] = given[coarse.dofs[:, -coarse.nodal :]]
    return rows.ravel()


def _prolonged(coarse: Problem, fine: Problem, states: Sequence[Array]) -> list[Array]:
    field, components = coarse.system.field, fine.system.components
    return [prolong(q, field, fine.system.field, components) for q in states]


def _corrected(
    fine: Problem,
    systems: Sequence[System],
    prolonged: Sequence[Array],
    factors: Array,
    limits: Limits,
) -> list[Array]:
    """Equilibria of the fine problem, by its `systems`, near states prolonged to it."""
    found = []
    for q, system, factor in zip(prolonged, systems, factors, strict=True):
        start = q.copy()
        start[system.held] = fine.prescribed(factor)[system.held]
        found.append(newton(system, start, fine.load(factor), limits).q)
    return found


def _across(
    model: Model,
    richer: Model,
    path: Path,
    states: Mapping[Which, Sequence[Array]],
    limits: Limits,
) -> tuple[list[Array], Array, npt.NDArray[np.bool_]]:
    """Equilibria of the problem that failed in the richer elements, near each state of a path.

    They lie in the plane across the path through the state, where the load may differ: at the same
    load there may be none, or one on another branch. states: those of the path by problem, in the
    richer elements. Returns the unknowns, the factors there, shape (states, names), and where one
    was found.
    """
    coarse: Field = getattr(model, path.which).system.field
    problem: Problem = getattr(richer, path.which)
    field, components = problem.system.field, problem.system.components
    unknowns, factors, known = [], [], []
    for i, (state, (move, change)) in enumerate(zip(path.states, path.ahead, strict=True)):
        q = states[path.which][i]
        line = state.factors, path.growth
        loaded = loaded_at(richer, path.which, line, states["axial"][i], limits)
        scale = Scale(largest(problem.system.internal(q)), largest(q))
        control = Control(Metric.at(q, path.share, scale), limits, scale)
        ahead = Way(prolong(move, coarse, field, components), change)
        found = control.corrected(loaded, q, 0.0, ahead)
        known.append(found is not None)
        unknowns.append(q if found is None else found[0].q)
        factors.append(loaded.factors(0.0 if found is None else found[0].factor))
    return unknowns, np.array(factors), np.array(known)


def _as_in(state: State, model: Model, system: System) -> System:
    """A lateral system as a state had it: its softening and its normal force."""
    softened, x = system.softened(state.softening), system.compression_points
    return softened.compressed(compression(model, state.axial, x)) if len(x) else softened


def _unresolved(field: Field, coarse: Array, fine: Array) -> Array:
    """Force between the polynomial through the coarse Gauss points and the reaction, by element.

    coarse, fine: reaction at the coarse and the fine Gauss points of the embedded elements in one
    state, shapes (steps, ..., elements * count) and (steps, ..., elements * (count + 1)).
    """
    lengths = field.lengths[embedded(field)]
    elements = len(lengths)
    known = coarse.reshape(len(coarse), -1, elements, coarse.shape[-1] // elements)
    true = fine.reshape(len(fine), -1, elements, fine.shape[-1] // elements)
    xi, weight = gauss_points(true.shape[-1])
    error = np.abs(known @ gauss_interpolation(xi, known.shape[-1]).T - true)
    missing = (error @ weight).sum(axis=1) * lengths
    whole = ((np.abs(true) @ weight).sum(axis=1) @ lengths)[:, None]
    whole = np.maximum(whole, _REST * whole.max(initial=0.0))
    share: Array = np.divide(missing, whole, out=np.zeros(missing.shape), where=whole > 0.0)
    return share


def _change(new: Array, old: Array) -> Array:
    """Largest change over the largest value, for each step; 0 where there is nothing."""
    return _ratio(_largest(new - old), _largest(new))


def _change_of_largest(new: Array, old: Array) -> Array:
    return _ratio(np.abs(_largest(new) - _largest(old)), _largest(new))


def _largest(values: Array) -> Array:
    return np.asarray(np.abs(values).reshape(len(values), -1).max(axis=1, initial=0.0))


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


def _ratio(change: Array, size: Array) -> Array:
    """Change over size; a step at rest is measured by a share of the largest step."""
    size = np.maximum(size, _REST * size.max(initial=0.0))
    return np.divide(change, size, out=np.zeros(len(size)), where=size > 0.0)


def estimate(
    model: Model,
    richer: Model,
    states: Sequence[State],
    accuracy: float,
    path: Path | None = None,
) -> tuple[Estimate, Estimate]:
    """Estimate the discretisation errors of `states` of `model`, lateral and axial.

    accuracy: what is asked of them; equilibrium in the richer elements is found to a share of it.
    path: where the last of the states lie beyond a peak. Errors there are at the same place across
    the path, that of the load included; 1 where none was found.
    """
    limits = Limits(residual=_RESIDUAL * accuracy)
    factors = np.array([s.factors for s in states])
    first = len(states) - len(path.states if path else ())
    known = np.ones(len(states), dtype=bool)
    before: dict[Which, list[Array]] = {
        "lateral": _prolonged(model.lateral, richer.lateral, [s.lateral for s in states]),
        "axial": _prolonged(model.axial, richer.axial, [s.axial for s in states]),
    }
    across: list[Array] = []
    at = factors.copy()
    if path is not None and path.states:
        beyond = {which: q[first:] for which, q in before.items()}
        across, at[first:], known[first:] = _across(model, richer, path, beyond, limits)
    bent = [_as_in(s, model, richer.lateral.system) for s in states]
    stretched = [richer.axial.system] * len(states)
    after: dict[Which, list[Array]] = {}
    which: Which
    for which, fine, systems in (
        ("lateral", richer.lateral, bent),
        ("axial", richer.axial, stretched),
    ):
        more = across if path is not None and which == path.which else []
        n = len(states) - len(more)
        after[which] = [*_corrected(fine, systems[:n], before[which][:n], at[:n], limits), *more]
    lateral, axial = ((np.array(before[w]), np.array(after[w])) for w in ("lateral", "axial"))
    reported = Results(
        model, np.array([s.lateral for s in states]), np.array([s.axial for s in states])
    )
    old = Results(richer, lateral[0], axial[0])
    new = Results(richer, lateral[1], axial[1])
    x, shaft = (model.lateral.system.points[0].x, model.axial.system.points[0].x)
    fine_x, fine_shaft = (richer.lateral.system.points[0].x, richer.axial.system.points[0].x)
    every = np.sort(np.concatenate([richer.edges, fine_x]))
    pressed, held = old.lateral_reaction(fine_x), old.axial_reaction(fine_shaft)
    field = model.lateral.system.field
    moment = new.shear_and_moment(every)[1]
    outer = _outer_moments(model.lateral, states, factors)
    found = (
        Estimate(
            _change(new.deflection(every), old.deflection(every)),
            _change_of_largest(new.lateral_reaction(fine_x), pressed),
            _ratio(
                _largest(moment - reported.shear_and_moment(every)[1]),
                np.maximum(_largest(moment), outer),
            ),
            _unresolved(field, old.lateral_reaction(x), pressed),
        ),
        Estimate(
            _change(new.settlement(every), old.settlement(every)),
            _change_of_largest(new.axial_reaction(fine_shaft), held),
            _change(new.compression(every), reported.compression(every)),
            _unresolved(field, old.axial_reaction(shaft), held),
        ),
    )
    return found if known.all() else (found[0].where(known), found[1].where(known))


def unestimated(model: Model, steps: int) -> Estimate:
    """Errors of 100 % for states whose estimate was not waited for."""
    whole = np.ones(steps)
    return Estimate(whole, whole, whole, np.zeros((steps, model.elements)))


def refine(model: Model, estimates: Sequence[Estimate], accuracy: float) -> Array:
    """Boundaries with those elements halved that resolve least in steps not accurate enough.

    An element that is too short for the arithmetic stays as it is.
    """
    field = model.lateral.system.field
    poor = np.concatenate([e.unresolved[e.worst > accuracy] for e in estimates])
    split = np.zeros(len(field.lengths), dtype=bool)
    split[embedded(field)] = (poor >= _REFINE * poor.max(axis=1, keepdims=True)).any(axis=0)
    split &= field.lengths > 2.0 * _SHORTEST * (field.edges[-1] - field.edges[0])
    middle = 0.5 * (field.edges[:-1] + field.edges[1:])[split]
    return np.sort(np.concatenate([field.edges, middle]))
