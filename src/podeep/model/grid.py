"""Depths at which results are written, so close that the stated interpolation is exact enough."""

import itertools

import numpy as np

from ..arrays import Array
from .mesh import Stretch
from .results import Results

JUMP = 1e-6  # distance of the two depths of a jump, m
_ROUND = (0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)  # spacings a reader can ask for, m
_MOST_ROUND = 100  # points of the regular grid
_BISECTIONS = 12
_MOST_POINTS = 20_000
_PROBES = np.array([0.25, 0.5, 0.75])


def regular(first: float, last: float) -> Array:
    """Multiples of a round spacing from `first` to `last`, m."""
    spacing = next((s for s in _ROUND if (last - first) / s <= _MOST_ROUND), _ROUND[-1])
    lowest, highest = int(np.ceil(first / spacing - 1e-9)), int(np.floor(last / spacing + 1e-9))
    return np.asarray(spacing * np.arange(lowest, highest + 1), dtype=np.float64)


def merge(*groups: Array) -> Array:
    """Sorted depths without neighbours closer than a jump."""
    x = np.unique(np.concatenate(groups))
    apart = np.diff(x, prepend=-np.inf) > 2.0 * JUMP
    return np.asarray(x[apart])


def soil_jumps(results: Results) -> Array:
    """Depths below the mudline where the reaction jumps: soil layers, steps of diameter."""
    ground = results.model.profile.ground
    pieces: tuple[Stretch, ...] = results.model.pieces
    twice = {d for d in ground.depths if ground.depths.count(d) > 1}
    for above, below in itertools.pairwise(pieces):
        same = above.outermost == below.outermost
        if not same or above.section.outer_diameter != below.section.outer_diameter:
            twice.add(above.bottom)
    tip = pieces[-1].bottom
    return np.array(sorted(d for d in twice if JUMP < d < tip - JUMP))


def split(x: Array, jumps: Array) -> Array:
    """Add to each jump, which must be among x, its second depth just below."""
    return np.sort(np.concatenate([x, jumps + JUMP]))


def output_depths(results: Results, accuracy: float) -> Array:
    """Depths from mudline (or a top below it) to tip, m, rising; a jump is two 1e-6 m apart.

    They hold the element ends, the multiples of a round spacing, and as many halvings of these as
    it takes for cubics through displacements and slopes and straight lines through reactions to
    stay within `accuracy` of the largest value in every step.
    """
    edges = results.model.edges
    tip = float(edges[-1])
    jumps = soil_jumps(results)
    top = max(float(edges[0]), 0.0)
    needed = np.concatenate([[top], jumps[jumps > top], edges[edges >= top]])
    x = split(merge(needed, regular(top, tip)), jumps[jumps > top])
    for _ in range(_BISECTIONS):
        worst = interpolation_error(results, x)
        wide = np.flatnonzero((worst > accuracy) & (np.diff(x) > 100.0 * JUMP))
        if not wide.size or len(x) + len(wide) > _MOST_POINTS:
            break
        x = np.sort(np.concatenate([x, 0.5 * (x[wide] + x[wide + 1])]))
    return x


def interpolation_error(results: Results, x: Array) -> Array:
    """Largest relative interpolation error in each interval of x, shape (len(x) - 1,)."""
    width = np.diff(x)
    probes = (x[:-1, None] + width[:, None] * _PROBES).ravel()
    t = np.tile(_PROBES, len(width))
    left = np.repeat(np.arange(len(width)), len(_PROBES))
    h = width[left]
    worst = np.zeros(len(left))
    for values, slopes, true in (
        (results.deflection(x), results.deflection(x, 1), results.deflection(probes)),
        (results.settlement(x), results.settlement(x, 1), results.settlement(probes)),
    ):
        a, b = values[..., left], values[..., left + 1]
        da, db = slopes[..., left] * h, slopes[..., left + 1] * h
        cubic = (
            a * (1 + 2 * t) * (1 - t) ** 2
            + da * t * (1 - t) ** 2
            + b * t**2 * (3 - 2 * t)
            + db * t**2 * (t - 1)
        )
        np.maximum(worst, relative_error(cubic, true, values), out=worst)
    for reaction in (results.lateral_reaction, results.axial_reaction):
        values = reaction(x)
        line = values[..., left] * (1 - t) + values[..., left + 1] * t
        np.maximum(worst, relative_error(line, reaction(probes), values), out=worst)
    return np.asarray(worst.reshape(-1, len(_PROBES)).max(axis=1))


def relative_error(interpolated: Array, true: Array, values: Array) -> Array:
    """Error at each probe over the largest value of its step, the largest of all steps."""
    size = np.abs(values).reshape(len(values), -1).max(axis=1)
    scale = np.divide(1.0, size, out=np.zeros(len(size)), where=size > 0.0)
    error = np.abs(interpolated - true) * scale.reshape(-1, *[1] * (true.ndim - 1))
    return np.asarray(error.reshape(-1, true.shape[-1]).max(axis=0))


def tube_depths(results: Results, depth: Array, marks: Array, tube: int = 0) -> Array:
    """Depths (negative above the mudline) at which a tube's own results are written.

    They hold the output depths of the soil, the element ends, and two depths a jump apart at each
    of `marks`, where point loads and holds let the internal forces jump.
    """
    edges = results.along(tube, results.model.edges)
    top, tip = edges[0], edges[-1]
    depth = depth[(depth >= top) & (depth <= tip)]
    ends = np.array([p.bottom for p in results.model.pieces if len(p.sections) > 1])
    marks = np.unique(np.concatenate([marks, ends]))  # where other tubes begin and end
    inner = marks[(marks > top + JUMP) & (marks < tip - JUMP)]
    above = np.concatenate([edges, regular(top, 0.0)])
    above = merge(above[above < -JUMP]) if top < -JUMP else np.zeros(0)
    x = np.concatenate([above, depth])
    fresh = inner[np.abs(inner[:, None] - x).min(axis=1) > 2.0 * JUMP] if inner.size else inner
    x = np.sort(np.concatenate([x, fresh]))
    pairs = [m + JUMP for m in inner if np.abs(x - m - JUMP).min() > 0.5 * JUMP]
    return np.sort(np.concatenate([x, pairs]))
