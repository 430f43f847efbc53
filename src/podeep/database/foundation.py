"""What an open database holds of one foundation; values are read when asked for."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Array, Index
from .envelope import Values, widen
from .schema import EXTREMES
from .trust import reading, wrong

_LARGEST_READ = 2**32  # bytes
_BLOCK = 1024  # rows read at once for an envelope


@dataclass(frozen=True, eq=False)
class FoundationData:
    """What a database holds of one foundation.

    depth: m below the mudline, increasing, shape (depths,). axis: steps or times (s), shape
    (rows,). mudline: elevation, m. lateral_axis: degrees from x, None in a spatial scene. layer,
    tube: soil layer and outermost tube at each depth. elevations: of each tube's results, by id.
    """

    name: str
    depth: Array
    axis: Array
    mudline: float
    lateral_axis: float | None
    layer_boundaries: Array
    layer: Index
    tube: Index
    load_names: tuple[str, ...]
    elevations: Mapping[int, Array]
    path: Path
    finished: bool
    datasets: Mapping[str, Any] = field(repr=False)

    @property
    def spatial(self) -> bool:
        """Whether lateral values are magnitudes, with components beside them."""
        return self.lateral_axis is None

    @property
    def tubes(self) -> tuple[int, ...]:
        """Ids of the tubes."""
        return tuple(self.elevations)

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
        depths: slice | Index | None = None,
    ) -> Array:
        """Values in the given rows (None: all), shape (rows, depths), or (rows,) without depths.

        Any variable with a row for each step or time: `lateral_force`, `estimate/moment`. depths:
        indices that rise. Raises UserError where the file turns out to be damaged, KeyError for an
        unknown name and IndexError for an unknown row.
        """
        wanted = np.atleast_1d(np.arange(len(self.axis))[slice(None) if rows is None else rows])
        different, place = np.unique(wanted, return_inverse=True)
        tail = self.datasets[quantity].shape[1:]
        columns = tail if depths is None else (len(np.arange(*tail)[depths]),)
        if 8 * different.size * math.prod(columns) > _LARGEST_READ:
            raise wrong(self.path, f"{quantity} is too much to read at once", "ask for fewer rows")
        at = _as_slice(different)
        if depths is None or isinstance(depths, slice):
            values = self._load(quantity, (at, *([depths] if depths else [])))
        else:
            values = self._gathered(quantity, at, different.size, depths)
        return values if np.array_equal(wanted, different) else values[place]

    def _gathered(self, quantity: str, rows: slice | Index, count: int, depths: Index) -> Array:
        """Values at some depths: those in one chunk are read at once, others not at all."""
        chunks = self.datasets[quantity].chunks
        width = chunks[1] if chunks else int(depths[-1]) + 1
        cuts = np.flatnonzero(np.diff(depths // width)) + 1
        values = np.empty((len(depths), count)).T  # what follows goes depth by depth
        for a, b in pairwise((0, *cuts.tolist(), len(depths))):
            window = depths[a:b]
            first, last = int(window[0]), int(window[-1]) + 1
            part = self._load(quantity, (rows, slice(first, last)))
            values[:, a:b] = part if last - first == b - a else part[:, window - first]
        return values

    def read_tube(
        self, igr: int, quantity: str, rows: int | slice | Sequence[int] | None = None
    ) -> Array:
        """Values of a tube at its elevations, shape (rows, elevations)."""
        return self.read(f"tubes/{igr}/{quantity}", rows)

    def envelope(self, quantity: str) -> tuple[Array, Array, Array, Array]:
        """Minimum and maximum over all rows, and the step or time of each, shape (depths,)."""
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
            widen(found, quantity, self.read(quantity, block), self.axis[block])
        return {e: found[f"{quantity}_{e}"] for e in EXTREMES}

    def _load(self, name: str, selection: tuple[Any, ...]) -> Array:
        data = self.datasets[name]
        with reading(self.path), np.errstate(invalid="ignore"):
            values = np.asarray(data[selection], dtype=np.float64)
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
