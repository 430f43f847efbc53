"""Error estimates from equilibrium in richer elements, and refinement where they are large.

The same mesh with one internal function and one Gauss point more an element contains the solved
state. Equilibrium there is a step or two away and differs by what the coarser elements could not
follow, at the nodes included: that difference is the estimate. Where to refine is told by the soil
force that the Gauss points of an element do not resolve.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..beam.field import Field
from ..beam.shapes import gauss_interpolation, gauss_points
from ..model.assemble import Model, Problem
from ..model.results import Results, compression, embedded, reacted
from ..model.system import System
from .newton import Limits, newton
from .statics import State
from .together import equilibria

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


def prolong(states: Array, coarse: Field, fine: Field) -> Array:
    """The same states, shape (steps, unknowns), in elements of a higher degree.

    The internal unknowns that are added are zero.
    """
    steps = len(states)
    given = states.reshape(steps, coarse.size, -1)
    rows = np.zeros((steps, fine.size, given.shape[2]))
    head = coarse.local - coarse.nodal
    rows[:, fine.dofs[:, :head]] = given[:, coarse.dofs[:, :head]]
    rows[:, fine.dofs[:, -fine.nodal :]] = given[:, coarse.dofs[:, -coarse.nodal :]]
    return rows.reshape(steps, -1)


def _corrected(
    coarse: Problem,
    fine: Problem,
    systems: Sequence[System],
    states: Array,
    loads: Array,
    limit: float,
) -> tuple[Array, Array]:
    """States prolonged to the fine problem, and its own equilibria near them, by its `systems`.

    States of one and the same system are corrected together; what that leaves open, one by one.
    """
    before = prolong(states, coarse.system.field, fine.system.field)
    if all(system is systems[0] for system in systems):
        after, settled = equilibria(systems[0], before, loads, limit)
    else:
        after, settled = before.copy(), np.zeros(len(before), dtype=bool)
    for i in np.flatnonzero(~settled).tolist():
        after[i] = newton(systems[i], before[i], loads[i], Limits(limit)).q
    return before, after


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


def _outer_moments(problem: Problem, states: Sequence[State], loads: Array) -> Array:
    """Largest moment of loads and springs on the tube in each state, N m.

    A tube loaded at its foot alone has moments of mere rounding: these are no scale for an error.
    """
    system = problem.system
    if all(s.softening == system.softening for s in states):
        forces = system.outer_forces(np.array([s.lateral for s in states]), loads)
    else:
        forces = np.array(
            [
                system.softened(s.softening).outer_forces(s.lateral, load)
                for s, load in zip(states, loads, strict=True)
            ]
        )
    field = problem.system.field
    slopes = np.union1d(field.dofs[:, 1], field.dofs[:, -1])
    turning = forces.reshape(len(forces), field.size, -1)[:, slopes]
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
    limit = _RESIDUAL * accuracy
    factors = np.array([s.factors for s in states])
    reported = Results(
        model, np.array([s.lateral for s in states]), np.array([s.axial for s in states])
    )
    bent = [_as_in(s, model, richer.lateral.system) for s in states]
    stretched = [richer.axial.system] * len(states)
    loads = richer.lateral.load(factors)
    lateral = _corrected(model.lateral, richer.lateral, bent, reported.lateral, loads, limit)
    axial = _corrected(
        model.axial, richer.axial, stretched, reported.axial, richer.axial.load(factors), limit
    )
    new = Results(richer, lateral[1], axial[1])
    xi = np.concatenate([[-1.0], gauss_points(richer.lateral.system.field.degree)[0], [1.0]])
    moment, force = new.moment_inside(xi), new.compression_inside(xi)
    outer = _outer_moments(model.lateral, states, model.lateral.load(factors))
    least = np.maximum(_largest(moment), outer)
    return (
        _estimated(
            (model.lateral, richer.lateral),
            (reported.lateral, *lateral),
            _ratio(_largest(moment - reported.moment_inside(xi)), least),
        ),
        _estimated(
            (model.axial, richer.axial),
            (reported.axial, *axial),
            _change(force, reported.compression_inside(xi)),
        ),
    )


def _estimated(
    problems: tuple[Problem, Problem], states: tuple[Array, Array, Array], moment: Array
) -> Estimate:
    """What changes at nodes and Gauss points of a problem, coarse and fine.

    states: those reported, the same in the fine elements, and corrected there.
    """
    coarse, fine = (problem.system for problem in problems)
    field = fine.field
    nodes = np.union1d(field.dofs[:, 0], field.dofs[:, -field.nodal])
    given = coarse.motions(states[0])[..., : len(coarse.points[0].x)]
    count = len(fine.points[0].x)
    before, after = (fine.motions(q)[..., :count] for q in states[1:])
    known, old, new = (
        reacted(u, system.points[0].reaction)
        for u, system in ((given, coarse), (before, fine), (after, fine))
    )
    moves = [q.reshape(len(q), field.size, -1)[:, nodes].reshape(len(q), -1) for q in states[1:]]
    return Estimate(
        _ratio(
            np.maximum(_largest(moves[1] - moves[0]), _largest(after - before)),
            np.maximum(_largest(moves[1]), _largest(after)),
        ),
        _change_of_largest(new, old),
        moment,
        _unresolved(coarse.field, known, old),
    )


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
