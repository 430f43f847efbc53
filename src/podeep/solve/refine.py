"""Where a mesh does not follow the soil's force, and where to cut its elements.

The soil acts at the Gauss points of an element. Where its force bends sharply in between, at the
corner of a curve that the displacement passes at some depth, it is not resolved: an element with an
end at that depth has no such place. Corners move a little when the mesh does, and are met better
the next time.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import trapezoid

from ..arrays import Array, Index
from ..beam.shapes import gauss_interpolation
from ..model.assemble import Problem
from ..model.results import Results
from ..soil.reaction import Reaction

REST = 1e-6  # share of the run's largest value below which a step is at rest
_BULK = 0.8  # share of all unresolved force whose elements are cut (Doerfler 1996)
_SHORTEST = 5e-5  # element over tube
_ROUNDING = 1e-4  # of all soil force: what rounding of displacements may make of it in an element
_CHECKS = 16  # intervals of an element between the depths where its force is checked
_NEAR_END = 1e-9  # of half an element: a check stays in the element's own soil layer
_ZOOMS = 4  # times that a corner is looked for in an eighth of the interval
_LOOKS = 16  # intervals of each look
_CORNER = (2.0 / _LOOKS) ** (1.5 * (_ZOOMS - 1))  # corners bend by more than this, curves by less
_MARGIN = 0.02  # share of an element that a cut leaves at least

Force = Callable[[Array], Array]


@dataclass(frozen=True)
class Unresolved:
    """Soil force that the elements below the mudline do not resolve in each step.

    share: of all soil force, shape (steps, intervals below the mudline). force: all soil force,
    (steps,), N. states: unknowns of each step, (steps, unknowns). react: from depths to the soil's
    reaction there; outermost: from depths to the tube on which it acts.
    """

    share: Array
    force: Array
    problem: Problem
    states: Array
    react: Callable[[Array], Reaction]
    outermost: Callable[[Array], Index]

    @property
    def total(self) -> Array:
        """Share of all elements together, (steps,)."""
        return np.asarray(self.share.sum(axis=1))

    @property
    def shortest(self) -> Array:
        """Length below which elements are mere rounding, of each interval, m.

        Rounding of a displacement u makes a force of eps u EI / h^3 (eps u EA / h of a stretch).
        """
        field, nodes = self.problem.system.field, self.problem.system.field.dofs[:, 0]
        unknowns = self.states.reshape(len(self.states), field.size, -1)[:, nodes]
        noise = np.finfo(float).eps * np.abs(unknowns).max() * field.stiffness
        bearable = _ROUNDING * self.force.max(initial=0.0)
        least = np.full(len(field.edges) - 1, _SHORTEST * (field.edges[-1] - field.edges[0]))
        if bearable > 0.0:
            power = 1.0 / (2 * field.continuity + 1)
            np.maximum.at(least, field.strings.interval, (noise / bearable) ** power)
        return least


def unresolved(results: Results) -> tuple[Unresolved, Unresolved]:
    """Of the deflection and of the stretch: what lies between the soil's force and its polynomial
    through the Gauss points."""
    model, profile = results.model, results.model.profile
    lateral, axial, edges = model.lateral, model.axial, model.edges
    return (
        Unresolved(
            *_shares(lateral.system.points[0].x, edges, results.lateral_reaction),
            lateral,
            results.lateral,
            lambda x: profile.lateral(x, results.diameter(x)),
            results.outermost,
        ),
        Unresolved(
            *_shares(axial.system.points[0].x, edges, results.axial_reaction),
            axial,
            results.axial,
            lambda x: profile.shaft(x, results.diameter(x)),
            results.outermost,
        ),
    )


def _below(edges: Array) -> Index:
    """Intervals below the mudline."""
    return np.flatnonzero(edges[1:] > 1e-6)


def _shares(gauss: Array, edges: Array, force: Force) -> tuple[Array, Array]:
    """Unresolved force by step and interval over all force of the step, and that force.

    gauss: points at which the soil acts. force: from depths (n,) to the reaction there, (steps,
    ..., n).
    """
    wet = _below(edges)
    lengths = np.diff(edges)[wet]
    xi = -np.cos(np.pi * np.arange(_CHECKS + 1) / _CHECKS) * (1.0 - _NEAR_END)
    checks = edges[wet, None] + 0.5 * lengths[:, None] * (xi + 1.0)
    true = force(np.maximum(checks, 0.0).ravel())
    steps, elements = len(true), len(wet)
    true = true.reshape(steps, -1, elements, len(xi))
    known = force(gauss).reshape(steps, -1, elements, len(gauss) // max(elements, 1))
    error = np.abs(known @ gauss_interpolation(xi, known.shape[-1]).T - true)
    half = 0.5 * lengths
    missing = trapezoid(error, xi).sum(axis=1) * half
    every = trapezoid(np.abs(true), xi).sum(axis=1) @ half
    whole = np.maximum(every, REST * every.max(initial=0.0))[:, None]
    share: Array = np.divide(missing, whole, out=np.zeros(missing.shape), where=whole > 0.0)
    return share, every


def finer(parts: tuple[Unresolved, Unresolved], poor: tuple[Index, Index]) -> Array:
    """Boundaries with those elements cut that resolve least in the steps that `poor` names.

    poor: numbers of steps for deflection and stretch. The fewest elements that leave the bulk of
    the unresolved force of a step are cut: at a corner of the force in their worst step, or in the
    middle where there is none. One that is too short for the arithmetic stays as it is.
    """
    edges = parts[0].problem.system.field.edges
    shortest = np.maximum(*(one.shortest for one in parts))
    deflection, stretch = (_cuts(o, s, shortest) for o, s in zip(parts, poor, strict=True))
    near = np.abs(stretch[:, None] - deflection).min(axis=1, initial=np.inf)
    interval = np.searchsorted(edges[1:-1], stretch)
    return np.union1d(edges, np.union1d(deflection, stretch[near > shortest[interval]]))


def _bulk(share: Array) -> Index:
    """Intervals that leave the bulk of the unresolved force in any step.

    share: shape (steps, intervals).
    """
    order = np.argsort(-share, axis=1)
    falling = np.take_along_axis(share, order, axis=1)
    before = np.cumsum(falling, axis=1) - falling
    first = (before < _BULK * share.sum(axis=1, keepdims=True)) & (falling > 0.0)
    return np.unique(order[first])


def _cuts(one: Unresolved, poor: Index, shortest: Array) -> Array:
    """Depths at which to cut elements: the corner of an element's worst step, or its middle."""
    edges = one.problem.system.field.edges
    wet = _below(edges)
    interval = wet[_bulk(one.share[poor])]
    interval = interval[np.diff(edges)[interval] > 2.0 * shortest[interval]]
    if not len(interval):
        return np.zeros(0)
    step = one.share[:, np.searchsorted(wet, interval)].argmax(axis=0)
    above, below = edges[interval], edges[interval + 1]
    left, right = above, below
    bends = []
    for _ in range(_ZOOMS):
        x = left[:, None] + (right - left)[:, None] * np.linspace(0.0, 1.0, _LOOKS + 1)
        force = _force(one, x, interval, step)
        bend = np.abs(force[:, 2:] - 2.0 * force[:, 1:-1] + force[:, :-2])
        at, every = bend.argmax(axis=1), np.arange(len(x))
        left, right = x[every, at], x[every, at + 2]
        bends.append(bend[every, at])
    cornered = bends[-1] > _CORNER * bends[0]
    cut = np.where(cornered, 0.5 * (left + right), 0.5 * (above + below))
    margin = np.maximum(_MARGIN * (below - above), shortest[interval])
    return np.clip(cut, above + margin, below - margin)


def _force(one: Unresolved, x: Array, interval: Index, step: Index) -> Array:
    """Size of the soil's force at depths x of each interval in its own step, shape of x, N/m."""
    field, components = one.problem.system.field, one.problem.system.components
    inside = field.edges[interval, None] + np.diff(field.edges)[interval, None] * _NEAR_END
    depth = np.maximum(np.maximum(x, inside), 0.0).ravel()
    functions = field.interpolation(depth, 0, one.outermost(depth))
    unknowns = one.states.reshape(len(one.states), -1, components)
    rows = np.repeat(step, x.shape[1])[:, None]
    dofs = functions.indices.reshape(len(depth), -1)
    u = np.einsum("rl,rlc->rc", functions.data.reshape(dofs.shape), unknowns[rows, dofs])
    size = u[:, 0] if components == 1 else np.hypot(u[:, 0], u[:, 1])
    return one.react(depth).evaluate(size)[0].reshape(x.shape)
