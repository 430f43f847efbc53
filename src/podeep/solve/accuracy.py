"""Error estimates from equilibrium in richer elements, and refinement where they are large.

The same mesh with one internal function and one Gauss point more an element contains the solved
state. Equilibrium there is a step or two away and differs by what the coarser elements could not
follow, at the nodes included: that difference is the estimate. Where to refine is told by the soil
force that the Gauss points of an element do not resolve.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field
from ..beam.shapes import gauss_interpolation, gauss_points
from ..model.assemble import Model, Problem
from ..model.coupling import pressed, rubbed, rubs
from ..model.results import Results
from ..model.system import System
from .newton import Limits, newton
from .statics import State

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


def prolong(q: Array, coarse: Field, fine: Field, components: int) -> Array:
    """The same state in elements of a higher degree: the added internal unknowns are zero."""
    rows = np.zeros((fine.size, components))
    given = q.reshape(-1, components)
    head = coarse.local - coarse.nodal
    rows[fine.dofs[:, :head]] = given[coarse.dofs[:, :head]]
    rows[fine.dofs[:, -fine.nodal :]] = given[coarse.dofs[:, -coarse.nodal :]]
    return rows.ravel()


def _corrected(
    coarse: Problem,
    fine: Problem,
    systems: Sequence[System],
    states: Sequence[Array],
    factors: Array,
    limits: Limits,
) -> tuple[Array, Array]:
    """States prolonged to the fine problem, and its own equilibria near them, by its `systems`."""
    field, components = coarse.system.field, fine.system.components
    before = [prolong(q, field, fine.system.field, components) for q in states]
    after = [
        newton(system, q, fine.load(factor), limits).q
        for q, system, factor in zip(before, systems, factors, strict=True)
    ]
    return np.array(before), np.array(after)


def _as_in(state: State, model: Model, system: System) -> System:
    """A lateral system as a state had it: its softening and its normal force."""
    softened = system.softened(state.softening)
    return pressed(model, state.axial, state.lateral, softened) if system.second_order else softened


def _unresolved(field: Field, coarse: Array, fine: Array) -> Array:
    """Force between the polynomial through the coarse Gauss points and the reaction, by element.

    coarse, fine: reaction at the coarse and the fine Gauss points of the embedded elements in one
    state, shapes (steps, ..., elements * count) and (steps, ..., elements * (count + 1)).
    """
    lengths = np.diff(field.edges)[embedded(field)]
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
    model: Model, richer: Model, states: Sequence[State], accuracy: float
) -> tuple[Estimate, Estimate]:
    """Estimate the discretisation errors of `states` of `model`, lateral and axial.

    accuracy: what is asked of them; equilibrium in the richer elements is found to a share of it.
    """
    limits = Limits(residual=_RESIDUAL * accuracy)
    factors = np.array([s.factors for s in states])
    bent = [_as_in(s, model, richer.lateral.system) for s in states]
    rough = richer.axial.system
    stretched = [rubbed(model, s.lateral, rough) if rubs(rough) else rough for s in states]
    lateral = _corrected(
        model.lateral, richer.lateral, bent, [s.lateral for s in states], factors, limits
    )
    axial = _corrected(
        model.axial, richer.axial, stretched, [s.axial for s in states], factors, limits
    )
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

    def moments(results: Results) -> Array:
        return results.of_all(lambda x, tube: results.shear_and_moment(x, tube)[1], every)

    def deflections(results: Results) -> Array:
        return results.of_all(lambda x, tube: results.deflection(x, 0, tube), every)

    def settlements(results: Results) -> Array:
        return results.of_all(lambda x, tube: results.settlement(x, 0, tube), every)

    moment = moments(new)
    outer = _outer_moments(model.lateral, states, factors)
    return (
        Estimate(
            _change(deflections(new), deflections(old)),
            _change_of_largest(new.lateral_reaction(fine_x), pressed),
            _ratio(
                _largest(moment - moments(reported)),
                np.maximum(_largest(moment), outer),
            ),
            _unresolved(field, old.lateral_reaction(x), pressed),
        ),
        Estimate(
            _change(settlements(new), settlements(old)),
            _change_of_largest(new.axial_reaction(fine_shaft), held),
            _change(*(r.of_all(r.compression, every) for r in (new, reported))),
            _unresolved(field, old.axial_reaction(shaft), held),
        ),
    )


def unestimated(model: Model, steps: int) -> Estimate:
    """Errors of 100 % for states whose estimate was not waited for."""
    whole = np.ones(steps)
    return Estimate(whole, whole, whole, np.zeros((steps, model.elements)))


def embedded(field: Field) -> Index:
    """Intervals below the mudline."""
    return np.flatnonzero(field.edges[1:] > 1e-6)


def refine(model: Model, estimates: Sequence[Estimate], accuracy: float) -> Array:
    """Boundaries with those elements halved that resolve least in steps not accurate enough.

    An element that is too short for the arithmetic stays as it is.
    """
    field = model.lateral.system.field
    poor = np.concatenate([e.unresolved[e.worst > accuracy] for e in estimates])
    lengths = np.diff(field.edges)
    split = np.zeros(len(lengths), dtype=bool)
    split[embedded(field)] = (poor >= _REFINE * poor.max(axis=1, keepdims=True)).any(axis=0)
    split &= lengths > 2.0 * _SHORTEST * (field.edges[-1] - field.edges[0])
    middle = 0.5 * (field.edges[:-1] + field.edges[1:])[split]
    return np.sort(np.concatenate([field.edges, middle]))
