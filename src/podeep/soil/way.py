"""The mean of a reaction on a straight way: Gauss points between the corners on it."""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from ..arrays import Array

NODES = 2  # between two corners
NOWHERE = 1e30  # m, in place of corners that a point has not


@cache
def gauss(count: int) -> tuple[Array, Array]:
    """Gauss points between 0 and 1, and their weights."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (nodes + 1.0), 0.5 * weights


@cache
def _whole(count: int) -> tuple[Array, Array]:
    """Gauss points and weights of ways without corners, (points, 1)."""
    share, weight = gauss(count)
    return share[:, None], weight[:, None]


def points_between(cuts: Array, nodes: int = NODES) -> tuple[Array, Array]:
    """Shares of ways at which they are asked, and their weights, (points, n) or (points, 1).

    cuts: shares at which something has a corner, (cuts, n); those within 0 and 1 count, in any
    order.
    """
    if not len(cuts):
        return _whole(nodes)
    inside = (cuts > 0.0) & (cuts < 1.0)
    most = int(np.add.reduce(inside).max(initial=0))
    if not most:
        return _whole(nodes)
    edges = np.empty((most + 2, cuts.shape[1]))
    edges[0], edges[-1] = 0.0, 1.0
    edges[1:-1] = np.sort(np.where(inside, cuts, 1.0), axis=0)[:most]
    length = edges[1:] - edges[:-1]
    share, weight = gauss(nodes)
    shares = edges[:-1, None] + length[:, None] * share[:, None]
    weights = length[:, None] * weight[:, None]
    return shares.reshape(-1, cuts.shape[1]), weights.reshape(-1, cuts.shape[1])


def crossed(corners: Array, start: Array, end: Array) -> Array:
    """Shares of ways between displacements, (n,), at which they cross corners, (corners, n).

    Corners that no way crosses are left out.
    """
    before = corners - start
    crosses = before * (corners - end) < 0.0
    if not crosses.any():
        return corners[:0]
    here = np.flatnonzero(crosses.any(axis=1))
    cuts = np.zeros((len(here), len(start)))
    return np.divide(before[here], end - start, out=cuts, where=crosses[here])


def mean_of(
    evaluate: Callable[[Array], tuple[Array, Array]],
    start: Array,
    end: Array,
    cuts: Array,
    nodes: int = NODES,
) -> tuple[Array, Array]:
    """Mean force on the ways between displacements, (n,), and its derivative to their ends.

    Times the way it is what is stored on it: the discrete gradient (U1 - U0)/(u1 - u0) of a
    potential, without its cancellation on short ways. evaluate: force and its derivative at
    (points, n). cuts: of `crossed`; exact where the force is a polynomial of degree 2 nodes - 1
    between them.

    Source: discrete gradients after Gonzalez, J. Nonlinear Sci. 6 (1996), from memory.
    """
    share, weight = points_between(cuts, nodes)
    places = share * (end - start)
    places += start
    force, stiffness = evaluate(places)
    stiffness = stiffness * (weight * share)
    return np.asarray(np.add.reduce(force * weight)), np.asarray(np.add.reduce(stiffness))


def crossed_in_plane(start: Array, end: Array, corners: Array) -> Array:
    """As `crossed` of displacements with two components, (n, 2), and corners in any direction.

    A way that passes by a corner has its nearest point there; one of no length crosses nothing.
    """
    way = end - start
    length = np.einsum("nc,nc->n", way, way)
    along = np.einsum("nc,nc->n", start, way)
    cross = start[:, 0] * way[:, 1] - start[:, 1] * way[:, 0]
    half = np.sqrt(np.maximum(length * np.square(corners) - np.square(cross), 0.0))
    both = np.concatenate((-along - half, half - along))
    return np.asarray(np.divide(both, length, out=np.zeros_like(both), where=length > 0.0))


def side_by_side(corners: Sequence[Array]) -> Array:
    """Corners of some points after those of others, (most corners, points)."""
    count = max((len(one) for one in corners), default=0)
    total = np.full((count, sum(one.shape[1] for one in corners)), NOWHERE)
    start = 0
    for one in corners:
        total[: len(one), start : start + one.shape[1]] = one
        start += one.shape[1]
    return total
