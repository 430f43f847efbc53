"""Mean internal forces of a system on a straight way of its unknowns, and their tangent."""

from functools import partial

import numpy as np

from ..arrays import Array
from ..soil.memory import Memory
from ..soil.way import crossed, crossed_in_plane, mean_of, points_between, side_by_side
from .moduli import NOTHING, directed
from .system import System


def corners_of(system: System) -> Array:
    """Displacements, either way, at which reactions have corners, (corners, points), m."""
    return side_by_side([points.reaction.corners for points in system.points])


def mean_internal(system: System, start: Array, end: Array, corners: Array) -> Array:
    """Mean of the internal forces on the way from `start` to `end`: times it, what is stored on it.

    Linear parts are met halfway, reactions at Gauss points between their corners, (corners,
    points). The tangent to `end` is kept for `solve`, which needs a system with half its linear
    part.
    """
    count, m = system._count, system.components
    if m == 1:
        first, last = system._observe.dot(start), system._observe.dot(end)
        mean = _along_a_line(system, first[:count], last[:count], corners)
    else:
        first, last = (system._observe.dot(q.reshape(-1, m)) for q in (start, end))
        mean = _in_plane(system, first[:count], last[:count], corners)
    seen = first + last
    seen *= 0.5
    seen[:count] = mean
    inner: Array = system._balance.dot(seen).ravel()
    if system.springs.any:
        inner += system.springs.forces(0.5 * (start + end))
    return inner


def _along_a_line(system: System, start: Array, end: Array, corners: Array) -> Array:
    """Mean force between displacements, (n,); what the tangent needs goes into `reached`."""
    if len(corners):
        corners = crossed(np.concatenate((corners, -corners)), start, end)
    remembers = isinstance(system._together, Memory)
    evaluate = partial(_one_by_one, system) if remembers else system.react
    mean, modulus = mean_of(evaluate, start, end, corners)
    size = np.abs(start)
    size += np.abs(end)
    system.reached = size, size, np.abs(mean), modulus, None
    return mean


def _one_by_one(system: System, places: Array) -> tuple[Array, Array]:
    """As `System.react` at (points, n), of soil that remembers."""
    pairs = [system.react(u) for u in places]
    return np.array([force for force, _ in pairs]), np.array([modulus for _, modulus in pairs])


def _in_plane(system: System, start: Array, end: Array, corners: Array) -> Array:
    """As `_along_a_line` between displacements of two components, (n, 2)."""
    if len(corners):
        corners = crossed_in_plane(start, end, corners)
    share, weight = points_between(corners)
    places = start + share[..., None] * (end - start)
    if system._memory is None:
        distance = np.maximum(np.hypot(places[..., 0], places[..., 1]), NOTHING)
        size, along = system.react(distance)
        across = size / distance
        forces, moduli = across[..., None] * places, directed(along, across, places, distance)
    else:
        pairs = [system._memory.evaluate(u) for u in places]
        forces, moduli = np.array([f for f, _ in pairs]), np.array([k for _, k in pairs])
    mean = np.einsum("pn,pnc->nc", weight, forces)
    modulus = np.einsum("pn,pkn->kn", weight * share, moduli)
    system.reached = end, np.hypot(*end.T), np.hypot(*mean.T), modulus, None
    return np.asarray(mean)
