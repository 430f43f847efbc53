"""A curve as elastic springs with slides, side by side: stiffness and yield of each."""

from typing import NamedTuple

import numpy as np

from ..arrays import Array, Index
from ..errors import InvalidData
from .reaction import Reaction

TOLERANCE = 2.5e-4  # of the capacity: what straight lines may leave of a curve
#: displacements at which curves are looked at, m
_GRID = np.concatenate(
    (np.geomspace(1e-11, 1e-6, 80, endpoint=False), np.geomspace(1e-6, 1e2, 273))
)
_ROUNDING = 1e-9  # of the capacity
_FLAT = 1e-12  # of a slope: a change that is rounding


class Sliders(NamedTuple):
    """Springs at n points, stiffness k (N/m2; N/m at a base), each up to its yield y (m), (m, n).

    Together they resist sum k min(|u|, y) on the first way out.
    """

    stiffness: Array
    yields: Array


def sliders(envelope: Reaction) -> Sliders:
    """Springs whose sum is an odd curve, within `TOLERANCE` of its capacity.

    The curve becomes straight lines between as few of its points as that takes; a spring gives way
    at each. A kink is met exactly: tangents on both sides of it cross there. Where the slope at
    rest is infinite, the first line ends it, at about a thousandth of the capacity.

    envelope: it does not fall. Raises InvalidData where its slope rises on the way: no such springs
    make that.
    """
    u, force = _points(envelope)
    size = np.minimum(envelope.capacity, force[-1])
    size = np.where(size > 0.0, size, 1.0)
    place = _corners(u, force / size)
    node, reach = (np.take_along_axis(values, place, axis=0) for values in (u, force))
    length, rise = np.diff(node, axis=0), np.diff(reach, axis=0)
    slope = np.divide(rise, length, out=np.zeros(length.shape), where=length > 0.0)
    after = np.concatenate((slope[1:], np.zeros((1, len(size)))))
    stiffness = slope - after
    if (stiffness * node[1:] < -_ROUNDING * size).any():
        raise InvalidData(
            "a curve grows stiffer on its way: in two planes HYSTERESIS=MASING is springs that "
            "give way one after the other, which none of that kind is made of",
            "give rows whose slope falls from row to row, *MODEL PLANAR where loads share a plane, "
            "or choose ELASTIC",
            "HYSTERESIS",
        )
    return Sliders(np.maximum(stiffness, 0.0), node[1:])


def _points(envelope: Reaction) -> tuple[Array, Array]:
    """Points on the curve from rest on, (m, n): of a grid, and between where tangents cross."""
    at = np.repeat(_GRID[:, None], envelope.size, axis=1)
    force, slope = envelope.evaluate(at)
    width, rise, bend = np.diff(at, axis=0), np.diff(force, axis=0), slope[:-1] - slope[1:]
    curved = bend > _FLAT * slope[:-1]
    way = np.divide(rise - slope[1:] * width, bend, out=0.5 * width, where=curved)
    between = at[:-1] + np.clip(way, 0.0, width)
    points, values = np.zeros((2, 2 * len(at), envelope.size))
    points[1::2], values[1::2] = at, force
    points[2::2], values[2::2] = between, envelope.evaluate(between)[0]
    return points, values


def _corners(u: Array, share: Array) -> Index:
    """Rows of points between which lines stay within the tolerance, rising, (corners, n).

    The worst point over each line becomes a corner until none is left. Where points need fewer
    corners than others they stay at the last row.
    """
    count, size = u.shape
    row = np.tile(np.arange(count), size)
    x, y = u.T.ravel(), share.T.ravel()  # one curve after the other
    corner = (row == 0) | (row == count - 1)
    while True:
        begins, line = np.flatnonzero(corner), np.cumsum(corner) - 1
        first, last = begins[line], begins[np.minimum(line + 1, len(begins) - 1)]
        width = x[last] - x[first]
        part = np.divide(x - x[first], width, out=np.zeros(len(x)), where=width != 0.0)
        off = np.abs(y - y[first] - part * (y[last] - y[first]))
        worst = np.flatnonzero((off > TOLERANCE) & (off == np.maximum.reduceat(off, begins)[line]))
        if not worst.size:
            most = corner.reshape(size, count).sum(axis=1).max(initial=2)
            return np.sort(np.where(corner, row, count - 1).reshape(size, count)).T[:most]
        corner[worst[np.unique(line[worst], return_index=True)[1]]] = True
