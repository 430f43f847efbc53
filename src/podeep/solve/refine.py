"""Where a mesh does not follow the soil's force, and where to cut its elements.

The soil acts at the Gauss points of an element. Where its force bends sharply in between, at the
corner of a curve that the displacement passes at some depth, it is not resolved: an element with an
end at that depth has no such place. Corners move a little when the mesh does, and are met better
the next time.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.integrate import trapezoid

from ..arrays import Array, Index
from ..beam.shapes import gauss_interpolation
from ..model.assemble import Problem
from ..model.results import Results, product

REST = 1e-6  # share of the run's largest value below which a step is at rest
_BULK = 0.8  # share of all unresolved force whose elements are cut (Doerfler 1996)
_SHORTEST = 5e-5  # element over tube
_ROUNDING = 1e-4  # of all soil force: what rounding of displacements may make of it in an element
_SOFTEST = 1e4  # EI / GAs over (h/2)^2: rounding of its square is then 1e-8
_CHECKS = 16  # intervals of an element between the depths where its force is checked
_NEAR_END = 1e-9  # of half an element: a check stays in the element's own soil layer
_ZOOMS = 4  # times that a corner is looked for in an eighth of the interval
_LOOKS = 16  # intervals of each look
_CORNER = (2.0 / _LOOKS) ** (1.5 * (_ZOOMS - 1))  # corners bend by more than this, curves by less
_MARGIN = 0.02  # share of an element that a cut leaves at least

Force = Callable[[Array], Array]
#: From a matrix of motions at depths to these motions: signed in a plane, else their sizes.
Seen = Callable[[sparse.csr_array], Array]


@dataclass(frozen=True)
class Unresolved:
    """One kind of soil force (or couple) that the elements below the mudline do not resolve.

    share: of all of it, shape (steps, intervals below the mudline). force: all of it, (steps,), N.
    states: unknowns of each step, (steps, unknowns). react: from depths and what is seen there of
    a state to the force per length.
    """

    share: Array
    force: Array
    problem: Problem
    states: Array
    react: Callable[[Array, Seen], Array]

    @property
    def total(self) -> Array:
        """Share of all elements together, (steps,)."""
        return np.asarray(self.share.sum(axis=1))

    @property
    def shortest(self) -> Array:
        """Length below which elements are mere rounding, of each interval, m.

        Rounding of a displacement u makes a force of eps u EI / h^3 (eps u EA / h of a stretch).
        Elements soft in shear are sums of powers of EI / GAs over (h/2)^2.
        """
        field, nodes = self.problem.system.field, self.problem.system.field.dofs[:, 0]
        unknowns = self.states.reshape(len(self.states), field.size, -1)[:, nodes]
        noise = np.finfo(float).eps * np.abs(unknowns).max() * field.stiffness
        bearable = _ROUNDING * self.force.max(initial=0.0)
        least = np.full(len(field.edges) - 1, _SHORTEST * (field.edges[-1] - field.edges[0]))
        if bearable > 0.0:
            power = 1.0 / (2 * field.continuity + 1)
            np.maximum.at(least, field.strings.interval, (noise / bearable) ** power)
        if field.shear_stiffness is not None:
            soft = 2.0 * np.sqrt(field.stiffness / field.shear_stiffness / _SOFTEST)
            np.maximum.at(least, field.strings.interval, soft)
        return least


@dataclass(frozen=True)
class Parts:
    """What is not resolved: soil forces of the deflection, couples after them, and the stretch."""

    lateral: tuple[Unresolved, ...]
    axial: tuple[Unresolved, ...]


def unresolved(results: Results) -> Parts:
    """What lies between the soil's force and its polynomial through the Gauss points."""
    model, profile = results.model, results.model.profile
    lateral, axial, edges = model.lateral, model.axial, model.edges
    gauss, shaft = lateral.system.points[0].x, axial.system.points[0].x

    def pushed(x: Array, seen: Seen) -> Array:
        moved = seen(lateral.system.field.interpolation(x, 0, results.outermost(x)))
        return profile.lateral(x, results.diameter(x)).evaluate(moved)[0]

    def turned(x: Array, seen: Seen) -> Array:
        rotation = seen(lateral.system.field.rotation(x, results.outermost(x)))
        couple = profile.moment(x, results.diameter(x))
        own = couple.part(lambda law: not law.follows_lateral).evaluate(rotation)[0]
        following = couple.part(lambda law: law.follows_lateral)
        if not following.laws:
            return own
        return np.asarray(own + following.evaluate(rotation)[0] * np.abs(pushed(x, seen)))

    def rubbed(x: Array, seen: Seen) -> Array:
        moved = seen(axial.system.field.interpolation(x, 0, results.outermost(x)))
        return profile.shaft(x, results.diameter(x)).evaluate(moved)[0]

    def every(matrix: sparse.csr_array) -> Array:
        return _size(product(_by_component(results.lateral, lateral), matrix))

    bent, stretched = (lateral, results.lateral), (axial, results.axial)
    forces = [Unresolved(*_shares(gauss, edges, results.lateral_reaction), *bent, pushed)]
    if any(points.motion == "rotation" and points.spread for points in lateral.system.points):
        couples = _shares(gauss, edges, lambda x: turned(x, every))
        forces.append(Unresolved(*couples, *bent, turned))
    friction = _shares(shaft, edges, results.axial_reaction)
    return Parts(tuple(forces), (Unresolved(*friction, *stretched, rubbed),))


def _by_component(states: Array, problem: Problem) -> Array:
    """Unknowns as (steps, components, unknowns of a component)."""
    unknowns = states.reshape(len(states), -1, problem.system.components)
    return np.moveaxis(unknowns, 2, 1)


def _size(motions: Array) -> Array:
    """Motions (steps, components, n) in a plane as they are, else their sizes, (steps, n)."""
    return motions[:, 0] if motions.shape[1] == 1 else np.linalg.norm(motions, axis=1)


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


def finer(parts: Parts, poor: tuple[Index, Index]) -> Array:
    """Boundaries with those elements cut that resolve least in the steps that `poor` names.

    poor: numbers of steps for deflection and stretch. The fewest elements that leave the bulk of
    an unresolved force of a step are cut: at a corner of the force in their worst step, or in the
    middle where there is none. One that is too short for the arithmetic stays as it is.
    """
    edges = parts.lateral[0].problem.system.field.edges
    shortest = np.maximum(parts.lateral[0].shortest, parts.axial[0].shortest)
    found = edges
    for kind, steps in zip((parts.lateral, parts.axial), poor, strict=True):
        for one in kind:
            cuts = _cuts(one, steps, shortest)
            apart = np.abs(cuts[:, None] - np.setdiff1d(found, edges)).min(axis=1, initial=np.inf)
            interval = np.searchsorted(edges[1:-1], cuts)
            found = np.union1d(found, cuts[apart > shortest[interval]])
    return found


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
    """The soil's force at depths x of each interval in its own step, shape of x, N/m."""
    edges = one.problem.system.field.edges
    inside = edges[interval, None] + np.diff(edges)[interval, None] * _NEAR_END
    depth = np.maximum(np.maximum(x, inside), 0.0).ravel()
    unknowns = _by_component(one.states, one.problem)
    rows = np.repeat(step, x.shape[1])[:, None, None]
    components = np.arange(unknowns.shape[1])[None, :, None]

    def seen(matrix: sparse.csr_array) -> Array:
        dofs = matrix.indices.reshape(len(depth), 1, -1)
        shares = matrix.data.reshape(dofs.shape)
        moved = (unknowns[rows, components, dofs] * shares).sum(axis=2)
        return np.asarray(_size(moved.T[None])[0])

    return np.asarray(one.react(depth, seen).reshape(x.shape))
