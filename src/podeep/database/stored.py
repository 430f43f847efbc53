"""What an open database holds of a foundation or a line; values are read when asked for."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from ..arrays import Array, Index
from ..subject import Subject
from .envelope import Values, widen
from .trust import reading, wrong
from .variable import EXTREMES

_LARGEST_READ = 2**32  # bytes
_BLOCK = 1024  # rows read at once for an envelope


@dataclass(frozen=True, eq=False)
class Stored:
    """What a database holds of a foundation or a line.

    points: its coordinate, depths below the mudline or distances along the line, m, increasing,
    shape (points,). axis: steps or times (s), shape (rows,). mudline: elevation, m.
    layer_boundaries: depths, m; a line has none.
    """

    subject: ClassVar[Subject]

    name: str
    points: Array
    axis: Array
    mudline: float
    layer_boundaries: Array
    load_names: tuple[str, ...]
    path: Path
    finished: bool
    datasets: Mapping[str, Any] = field(repr=False)

    @property
    def spatial(self) -> bool:
        """Whether lateral values are magnitudes, with components beside them."""
        return False

    @cached_property
    def load_factor(self) -> Array:
        """Factor of each named load in each row, shape (rows, loads)."""
        if not self.load_names:
            return np.empty((len(self.axis), 0))
        return self.read("load_factor")

    def read(
        self,
        quantity: str,
        rows: int | slice | Sequence[int] | Index | None = None,
        points: slice | Index | None = None,
    ) -> Array:
        """Values in the given rows (None: all), shape (rows, points), or (rows,) without points.

        Any variable with a row for each step or time: `lateral_force`, `estimate/moment`. points:
        indices that rise. Raises UserError where the file turns out to be damaged, KeyError for an
        unknown name and IndexError for an unknown row.
        """
        wanted = np.atleast_1d(np.arange(len(self.axis))[slice(None) if rows is None else rows])
        # All rows of a long motion are known to be different, and in order.
        every = (wanted, wanted) if rows is None else None
        different, place = every or np.unique(wanted, return_inverse=True)
        tail = self.datasets[quantity].shape[1:]
        columns = tail if points is None else (len(np.arange(*tail)[points]),)
        if 8 * different.size * math.prod(columns) > _LARGEST_READ:
            raise wrong(self.path, f"{quantity} is too much to read at once", "ask for fewer rows")
        at = _as_slice(different)
        if points is None or isinstance(points, slice):
            values = self._load(quantity, (at, *([points] if points else [])))
        else:
            values = self._gathered(quantity, at, different.size, points)
        return values if np.array_equal(wanted, different) else values[place]

    def _gathered(self, quantity: str, rows: slice | Index, count: int, points: Index) -> Array:
        """Values at some points: those in one chunk are read at once, others not at all."""
        chunks = self.datasets[quantity].chunks
        width = chunks[1] if chunks else int(points[-1]) + 1
        cuts = np.flatnonzero(np.diff(points // width)) + 1
        values = np.empty((len(points), count)).T  # what follows goes point by point
        for a, b in pairwise((0, *cuts.tolist(), len(points))):
            window = points[a:b]
            first, last = int(window[0]), int(window[-1]) + 1
            part = self._finite(quantity, (rows, slice(first, last)))
            values[:, a:b] = part if last - first == b - a else part[:, window - first]
        return values

    def envelope(self, quantity: str) -> tuple[Array, Array, Array, Array]:
        """Minimum and maximum over all rows, and the step or time of each, shape (points,)."""
        if self.finished:
            found = {e: self._load(f"envelope/{quantity}_{e}", ()) for e in EXTREMES}
        else:
            found = self._computed_envelope(quantity)
        return found["min"], found["max"], found["min_at"], found["max_at"]

    def _computed_envelope(self, quantity: str) -> dict[str, Array]:
        if not len(self.axis):
            raise wrong(self.path, f"{self.name} holds no rows yet", "wait for the run")
        # The stored one of an unfinished database may be ahead of the rows committed.
        found: dict[str, Values] = {}
        for first in range(0, len(self.axis), _BLOCK):
            block = slice(first, first + _BLOCK)
            rows = self.read(self.subject.stored(quantity), block)
            widen(found, quantity, rows, self.axis[block])
        return {e: found[f"{quantity}_{e}"] for e in EXTREMES}

    def _load(self, name: str, selection: tuple[Any, ...]) -> Array:
        return np.asarray(self._finite(name, selection), dtype=np.float64)

    def _finite(self, name: str, selection: tuple[Any, ...]) -> Values:
        """Values of the type that the file has, none of them infinite or no number."""
        with reading(self.path):
            values = np.asarray(self.datasets[name][selection])
        if not np.all(np.isfinite(values)):
            raise wrong(self.path, f"{self.name}/{name} holds values that are not finite")
        return values


def _as_slice(rows: Index) -> slice | Index:
    """Rising rows as a slice, which HDF5 reads faster, if they are evenly spaced."""
    spacing = np.diff(rows)
    if rows.size == 0:
        return slice(0, 0)
    if np.any(spacing != spacing[:1]):
        return rows
    return slice(int(rows[0]), int(rows[-1]) + 1, int(spacing[0]) if spacing.size else 1)
