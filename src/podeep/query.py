"""What the post-processor reads off a database: step evolution, snapshot and envelope.

Points are depths of a foundation or distances along a line. Between the points of the stored grid
displacements with stored slopes are cubic (Hermite) and all else is linear; in time everything is
linear. A jump of soil, tube or line is two points 1e-6 m apart: nothing is interpolated across it,
and the jump itself shows the value of the first. In a spatial database the two lateral components
of a foundation are interpolated first; the result is their magnitude.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from .arrays import Array, Index
from .database import variable
from .subject import FOUNDATION, Subject

if TYPE_CHECKING:
    from .database.stored import Stored

DatabaseKind = variable.Kind
Kind = Literal["step_evolution", "snapshot", "envelope"]

_JUMP = 2e-6  # a pair of points closer than this is a jump, m
_ROWS = 8192  # interpolated at once, so few that they stay in the processor's cache


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a result comes from: the database and one of its foundations or lines.

    `mudline` is an elevation from sea level, m; lateral values of a foundation are counted along
    `direction`, as `x`, or are magnitudes where it is None.
    """

    database: str
    database_kind: DatabaseKind
    title: str
    name: str
    mudline: float
    direction: str | None
    subject: Subject = FOUNDATION

    @property
    def axis(self) -> Literal["step", "time"]:
        return "step" if self.database_kind == "static" else "time"


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """A result in SI units.

    `values` has shape (rows, points): a row for each step or time of `rows`, or minimum and
    maximum of an envelope, whose steps or times `when` holds in the same shape. `points` are
    depths below the mudline or distances along the line, m, increasing.
    """

    kind: Kind
    quantity: str
    points: Array
    rows: Array
    values: Array
    layer_boundaries: Array
    when: Array | None = None


@dataclass(frozen=True, slots=True)
class _Places:
    """Points between grid nodes: node above, node below (in `nodes`), spacing and fraction."""

    nodes: slice | Index
    above: Index
    below: Index
    spacing: Array
    fraction: Array

    def linear(self, values: Array) -> Array:
        """Values at the nodes, shape (rows, nodes), to the points, linearly."""
        return _blend(values[..., self.above], values[..., self.below], self.fraction)

    def between(self, values: Array, slopes: Array | None = None) -> Array:
        """The same, by the cubic that has the given slopes at both nodes if there are any."""
        if slopes is None:
            return self.linear(values)
        t, h = self.fraction, self.spacing
        # In place: a long motion has millions of values, and each pass over them takes its time.
        start, found = values[..., self.above], values[..., self.below]
        found -= start
        found *= t * t * (3.0 - 2.0 * t)
        found += start
        rise, fall = slopes[..., self.above], slopes[..., self.below]
        rise *= t * (1.0 - t) ** 2 * h
        fall *= t * t * (1.0 - t) * h
        found += rise
        found -= fall
        return np.asarray(found)


def spread(first: float, last: float, count: int) -> Array:
    """Evenly spread points with both ends included, in increasing order; one if the ends agree."""
    return np.linspace(min(first, last), max(first, last), count)


def step_evolution(data: "Stored", quantity: str, points: Array) -> Curves:
    """The quantity at each point over all steps or times.

    Raises ValueError for a point outside the stored ones, as the other queries do.
    """
    values = _magnitude(_at_points(data, quantity, points, None))
    return Curves(
        "step_evolution", quantity, points, np.asarray(data.axis), values, data.layer_boundaries
    )


def snapshot(data: "Stored", quantity: str, points: Array, at: Sequence[float]) -> Curves:
    """The quantity over the points at the given steps or times, which lie within the stored ones.

    Raises ValueError for a step or time outside them.
    """
    wanted = np.asarray(at, dtype=float)
    before, after, fraction = _bracket(np.asarray(data.axis, dtype=float), wanted)
    rows, places = np.unique(np.stack([before, after]), return_inverse=True)
    first, last = places.reshape(2, -1)
    stored = _at_points(data, quantity, points, rows.tolist())
    values = _magnitude(_blend(stored[:, first], stored[:, last], fraction[:, None]))
    return Curves("snapshot", quantity, points, wanted, values, data.layer_boundaries)


def envelope(data: "Stored", quantity: str, points: Array) -> Curves:
    """Minimum and maximum over all computed steps, from the stored envelope, and their times.

    An envelope has no stored slope, so its values are linear between the nodes. The time is
    that of the more extreme of the two nodes: a time between them need not have been computed.
    """
    places = _places(data.points, points)
    low, high, low_at, high_at = (stored[places.nodes] for stored in data.envelope(quantity))
    values = np.stack([places.linear(low), places.linear(high)])
    when = np.stack([_governing(places, -low, low_at), _governing(places, high, high_at)])
    nothing = np.empty(0)
    return Curves("envelope", quantity, points, nothing, values, data.layer_boundaries, when)


def _governing(places: _Places, size: Array, when: Array) -> Array:
    below = (places.fraction > 0.0) & (size[places.below] > size[places.above])
    return np.where(below, when[places.below], when[places.above])


def _at_points(data: "Stored", quantity: str, points: Array, rows: list[int] | None) -> Array:
    """Stored rows at the points, shape (components, rows, points)."""
    places = _places(data.points, points)

    lateral = quantity.startswith("lateral")
    suffixes = ("_x", "_y") if data.spatial and lateral else ("",)
    slope = data.subject.slopes.get(quantity)
    stored = data.subject.stored(quantity)
    names = (stored,) if slope is None else (stored, slope)
    count = len(data.axis) if rows is None else len(rows)
    found = np.empty((len(suffixes), len(points), count)).swapaxes(1, 2)
    for component, suffix in zip(found, suffixes, strict=True):
        read = [data.read(name + suffix, rows, places.nodes) for name in names]
        for first in range(0, count, _ROWS):
            block = slice(first, first + _ROWS)
            component[block] = places.between(*(values[block] for values in read))
    return found


def _magnitude(components: Array) -> Array:
    """One component keeps its sign; two give the length of their vector."""
    return np.asarray(components[0] if len(components) == 1 else np.hypot(*components))


def _blend(first: Array, last: Array, fraction: Array) -> Array:
    """Linear from `first` to `last`; exactly `first` where the fraction is 0."""
    return np.where(fraction == 0.0, first, first + (last - first) * fraction)


def _bracket(grid: Array, points: Array) -> tuple[Index, Index, Array]:
    """Index before and after each point, and its fraction of the way; 0 exactly at a node.

    Raises ValueError for a point outside the grid.
    """
    if points.min() < grid[0] or points.max() > grid[-1]:
        raise ValueError(f"{points.tolist()} reaches outside {grid[0]:g} to {grid[-1]:g}")
    before = np.searchsorted(grid, points, side="right") - 1
    after = np.minimum(before + 1, len(grid) - 1)
    spacing = np.where(after > before, grid[after] - grid[before], 1.0)
    return before, after, (points - grid[before]) / spacing


def _places(grid: Array, points: Array) -> _Places:
    above, below, fraction = _bracket(grid, points)
    spacing = grid[below] - grid[above]
    fraction = np.where(spacing < _JUMP, 0.0, fraction)
    nodes, place = np.unique(np.stack([above, below]), return_inverse=True)
    first, last = place.reshape(2, -1)
    together = slice(int(nodes[0]), int(nodes[-1]) + 1)
    close = together.stop - together.start == len(nodes)
    return _Places(together if close else nodes, first, last, spacing, fraction)
