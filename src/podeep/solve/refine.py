"""Where a mesh does not follow the soil's force, and where to cut its elements.

The soil, or another tube, acts at the Gauss points of an element. Where its force bends sharply in
between, at the corner of a curve that the displacement passes at some depth, it is not resolved: an
element with an end at that depth has no such place. Corners move a little when the mesh does, and
are met better the next time.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from ..arrays import Array, Flags, Index
from ..beam.field import Motion
from ..beam.shapes import gauss_interpolation, gauss_points
from ..model.assemble import Problem
from ..model.contact import Gap
from ..model.contact import reaction as contact
from ..model.points import Points
from ..model.results import Results, product, reacted
from ..soil.reaction import Reaction

REST = 1e-6  # share of the run's largest value below which a step is at rest
_BULK = 0.8  # share of all unresolved force whose elements are cut (Doerfler 1996)
_SHORTEST = 5e-5  # element over tube
_ROUNDING = 1e-4  # of all soil force: what rounding of displacements may make of it in an element
_SOFTEST = 1e4  # EI / GAs over (h/2)^2: rounding of its square is then 1e-8
_CHECKS = 16  # intervals of an element between the depths where its force is checked
_NEAR_END = 1e-9  # of half an element: a check stays in the element's own soil layer
_ZOOMS = 4  # times that a corner is looked for in an eighth of the interval, two at one evaluation
_LOOKS = 16  # intervals of each look
_CORNER = (2.0 / _LOOKS) ** (1.5 * (_ZOOMS - 1))  # corners bend by more than this, curves by less
_WET = 1e-6  # below the mudline, m
_MARGIN = 0.02  # share of an element that a cut leaves at least

Places = Callable[[Array], Points]


@dataclass(frozen=True)
class Unresolved:
    """Force that elements do not resolve in each step, as a share of all force of its kind.

    share: shape (steps, intervals). intervals: where it acts, rising. force: all of it, (steps,),
    N. states: unknowns of each step, (steps, unknowns). at: from depths to what acts there, times
    the size of what `leader` tells of, if that is given.
    """

    share: Array
    force: Array
    intervals: Index
    problem: Problem
    states: Array
    at: Places
    leader: Places | None = None

    @property
    def total(self) -> Array:
        """Share of all elements together, (steps,)."""
        return np.asarray(self.share.sum(axis=1))

    @property
    def shortest(self) -> Array:
        """Length below which elements are mere rounding, for each interval, m.

        Rounding of a displacement u makes a force of eps u EI / h^3 (eps u EA / h of a stretch).
        Elements soft in shear are sums of powers of EI / GAs over (h/2)^2.
        """
        field = self.problem.system.field
        nodes = field.dofs[:, 0]
        unknowns = self.states.reshape(len(self.states), field.size, -1)[:, nodes]
        stiffest = np.where(field.strings.carrier >= 0, field.stiffness[field.strings.carrier], 0.0)
        noise = np.finfo(float).eps * np.abs(unknowns).max() * stiffest.max(axis=0)
        bearable = _ROUNDING * self.force.max(initial=0.0)
        least = _SHORTEST * (field.edges[-1] - field.edges[0])
        power = 1.0 / (2 * field.continuity + 1)
        short = (noise / bearable) ** power if bearable > 0.0 else np.zeros(len(noise))
        if field.shear_stiffness is not None:
            soft = 2.0 * np.sqrt(field.stiffness / field.shear_stiffness / _SOFTEST)
            np.maximum.at(short, field.strings.interval, soft)
        return np.asarray(np.maximum(short, least))


def unresolved(results: Results) -> tuple[Unresolved, ...]:
    """What lies between a force and its polynomial through the Gauss points.

    First that of the soil on the deflection, then on the stretch; then couples of the soil, and
    forces of tubes on each other.
    """
    model, profile = results.model, results.model.profile
    wet = np.flatnonzero(model.edges[1:] > _WET)

    def soil(react: Callable[[Array, Array], Reaction], motion: Motion = "value") -> Places:
        def at(x: Array) -> Points:
            x = np.maximum(x, 0.0)
            reaction = react(x, results.diameter(x))
            return Points(x, np.ones(len(x)), reaction, motion, tube=results.outermost(x))

        return at

    def couple(follows: bool) -> Places:
        def react(x: Array, width: Array) -> Reaction:
            return profile.moment(x, width).part(lambda law: law.follows_lateral == follows)

        return soil(react, "rotation")

    pushed = soil(profile.lateral)
    bent = (model.lateral, results.lateral, wet)
    found = [
        _unresolved(*bent, pushed),
        _unresolved(model.axial, results.axial, wet, soil(profile.shaft)),
    ]
    for points in model.lateral.system.points:
        if points.spread and points.motion == "rotation":
            leader = None if points.follows is None else pushed
            found.append(_unresolved(*bent, couple(points.follows is not None), leader))
    for points in model.lateral.system.points:
        if points.against is not None:
            count = model.lateral.system.field.degree
            inside = np.searchsorted(model.edges, points.x[::count]) - 1
            at = _between(points, model.edges, inside, count)
            found.append(_unresolved(model.lateral, results.lateral, inside, at))
    return tuple(found)


def _between(points: Points, edges: Array, intervals: Index, count: int) -> Places:
    """What acts between two tubes at any depths of the intervals that they meet in."""
    (term,) = points.reaction.laws
    assert isinstance(term.law, Gap)
    gap = term.law

    def at(x: Array) -> Points:
        place = np.searchsorted(intervals, np.searchsorted(edges, x) - 1) * count
        return replace(points, x=x, weight=np.ones(len(x)), reaction=contact(gap.at(place)))

    return at


def _unresolved(
    problem: Problem, states: Array, intervals: Index, at: Places, leader: Places | None = None
) -> Unresolved:
    """Unresolved force by step and interval over all force of the step."""
    field = problem.system.field
    lengths = np.diff(field.edges)[intervals]
    count = field.degree + 1 - field.continuity
    places, interpolation, weight = _checks(count)
    x = (field.edges[intervals, None] + 0.5 * lengths[:, None] * (places + 1.0)).ravel()
    resistance = _resistance(problem, states, at(x))
    if leader is not None:
        resistance = resistance * _norm(_resistance(problem, states, leader(x)))
    shape = (*resistance.shape[:2], len(intervals), len(places))
    resistance = resistance.reshape(shape)
    known, true = resistance[..., :count], resistance[..., count:]
    error = np.abs(known @ interpolation - true)
    half = 0.5 * lengths
    missing = (error @ weight).sum(axis=1) * half
    every = (np.abs(true) @ weight).sum(axis=1) @ half
    whole = np.maximum(every, REST * every.max(initial=0.0))[:, None]
    share: Array = np.divide(missing, whole, out=np.zeros(missing.shape), where=whole > 0.0)
    return Unresolved(share, every, intervals, problem, states, at, leader)


@cache
def _checks(count: int) -> tuple[Array, Array, Array]:
    """Gauss points of an element, then the checks; from the first to the second; their weights."""
    xi = -np.cos(np.pi * np.arange(_CHECKS + 1) / _CHECKS) * (1.0 - _NEAR_END)
    weight = 0.5 * (np.diff(xi, prepend=xi[0]) + np.diff(xi, append=xi[-1]))  # trapezoids
    places = np.concatenate([gauss_points(count)[0], xi])
    return places, gauss_interpolation(xi, count).T, weight


def _norm(vectors: Array) -> Array:
    """Sizes (steps, 1, points) of vectors (steps, components, points)."""
    return np.asarray(np.linalg.norm(vectors, axis=1, keepdims=True))


def _resistance(problem: Problem, states: Array, points: Points) -> Array:
    """What resists at points in each state by component, (steps, components, points)."""
    components = problem.system.components
    unknowns = np.moveaxis(states.reshape(len(states), -1, components), 2, 1)
    u = product(unknowns, points.rows(problem.system.field))
    return reacted(u, points.reaction)


def finer(parts: Sequence[Unresolved], poor: Sequence[Flags]) -> Array:
    """Boundaries with those elements cut that resolve least in the steps that `poor` names.

    poor: shape (steps,) for each part. The fewest elements that leave the bulk of the unresolved
    force of a step are cut: at a corner of the force in their worst step, or in the middle where
    there is none. One that is too short for the arithmetic stays as it is.
    """
    edges = parts[0].problem.system.field.edges
    shortest = np.max([one.shortest for one in parts], axis=0)
    made = np.zeros(0)
    for one, steps in zip(parts, poor, strict=True):
        new = _cuts(one, steps, shortest)
        near = np.abs(new[:, None] - made).min(axis=1, initial=np.inf)
        interval = np.searchsorted(edges[1:-1], new)
        made = np.union1d(made, new[near > shortest[interval]])
    return np.union1d(edges, made)


def _bulk(share: Array) -> Flags:
    """Elements that leave the bulk of the unresolved force in any step, (elements,).

    share: shape (steps, elements).
    """
    order = np.argsort(-share, axis=1)
    falling = np.take_along_axis(share, order, axis=1)
    before = np.cumsum(falling, axis=1) - falling
    first = (before < _BULK * share.sum(axis=1, keepdims=True)) & (falling > 0.0)
    large = np.zeros(share.shape[1], dtype=bool)
    large[order[first]] = True
    return large


def _cuts(one: Unresolved, poor: Flags, shortest: Array) -> Array:
    """Depths at which to cut elements: the corner of an element's worst step, or its middle."""
    edges, among = one.problem.system.field.edges, one.intervals
    large = _bulk(one.share[poor])
    chosen = np.flatnonzero(large & (np.diff(edges)[among] > 2.0 * shortest[among]))
    if not len(chosen):
        return np.zeros(0)
    interval, step = among[chosen], one.share[:, chosen].argmax(axis=0)
    above, below = edges[interval], edges[interval + 1]
    left, right = above, below
    bends, every, half = [], np.arange(len(chosen)), _LOOKS // 2
    for _ in range(_ZOOMS // 2):
        x = left[:, None] + (right - left)[:, None] * np.linspace(0.0, 1.0, _LOOKS * half + 1)
        force = _force(one, x, interval, step)
        at, first = _sharpest(force[:, ::half])
        near = half * at[:, None] + np.arange(_LOOKS + 1)
        at, second = _sharpest(np.take_along_axis(force, near, axis=1))
        left, right = x[every, near[every, at]], x[every, near[every, at + 2]]
        bends += [first, second]
    cornered = bends[-1] > _CORNER * bends[0]
    cut = np.where(cornered, 0.5 * (left + right), 0.5 * (above + below))
    margin = np.maximum(_MARGIN * (below - above), shortest[interval])
    return np.clip(cut, above + margin, below - margin)


def _sharpest(force: Array) -> tuple[Index, Array]:
    """The first of the three points over which each row bends most, and how much it does."""
    bend = np.abs(force[:, 2:] - 2.0 * force[:, 1:-1] + force[:, :-2])
    at = bend.argmax(axis=1)
    return at, bend[np.arange(len(at)), at]


def _force(one: Unresolved, x: Array, interval: Index, step: Index) -> Array:
    """Size of the force at depths x of each interval in its own step, shape of x, N/m."""
    system = one.problem.system
    lengths = np.diff(system.field.edges)[interval]
    inside = system.field.edges[interval] + lengths * _NEAR_END
    depth = np.maximum(x, inside[:, None]).ravel()
    unknowns = one.states.reshape(len(one.states), -1, system.components)
    rows = np.repeat(step, x.shape[1])[:, None]

    def size(points: Points) -> Array:
        own = points.rows(system.field)
        u = np.einsum("rl,rlc->rc", own.shares, unknowns[rows, own.dofs])
        moved = u[:, 0] if system.components == 1 else np.hypot(u[:, 0], u[:, 1])
        return points.reaction.evaluate(moved)[0]

    force = size(one.at(depth))
    if one.leader is not None:
        force = force * np.abs(size(one.leader(depth)))
    return force.reshape(x.shape)
