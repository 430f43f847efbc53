"""The writer of soil databases: what it has committed survives a kill at any moment.

The run writes `NAME.partial` beside the target. Room for many rows is allocated when that file is
made, and nothing but values is written into it afterwards: first rows, then the number of rows that
readers may trust. When the room is used up, and at the end, everything moves to a fresh file that
takes the place of the partial in one step: at no moment does a half-built file have that name. The
fresh file at the end has no spare room, and is what the target becomes.
"""

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Self

import h5py
import numpy as np
import numpy.typing as npt

from .. import __version__
from ..errors import UserError
from .envelope import Values, widen
from .layout import Grid, Layout
from .schema import (
    COMMITTED,
    CONVENTIONS,
    DECK,
    MAJOR,
    MINOR,
    PARTIAL,
    QUANTITIES,
    SCHEMA,
    Kind,
    Status,
)
from .target import REFUSED, check_target, clear, told

__all__ = ["Grid", "Writer", "check_target"]

_FORMAT = ("v108", "v108")  # old enough for every netCDF, new enough to have checksums
_COPIED = 4096  # rows at a time
_GROWTH = 4  # of the room, each time that it is used up; what is not used takes no space on disk


class Writer:
    """Writes a database row by row; a context manager that leaves the partial unless finished.

    loads: names of the loads of `load_factor`, none in a dynamic database. dtype: of results;
    float64 in a static, float32 in a dynamic database unless given. compress: gzip what is large.
    block: rows that are kept in memory before they are written together, and the least room that
    is allocated ahead. Entering raises UserError for a target that may not be written, and every
    method does where the disk fails.
    """

    def __init__(
        self,
        target: Path,
        *,
        kind: Kind,
        title: str,
        deck_text: str,
        grids: Sequence[Grid],
        loads: Sequence[str],
        history: str = "",
        force: bool = False,
        dtype: npt.DTypeLike | None = None,
        compress: bool = False,
        block: int = 1024,
    ) -> None:
        self.path = target.with_name(target.name + PARTIAL)
        self._fresh = target.with_name(target.name + PARTIAL + ".new")
        self._target, self._force, self._block = target, force, block
        self._deck = deck_text
        self._head = {
            "Conventions": CONVENTIONS,
            "title": title,
            "schema": SCHEMA,
            "schema_version": f"{MAJOR}.{MINOR}",
            "kind": kind,
            "program": "podeep-solve",
            "version": __version__,
            "history": history,
        }
        self._layout = Layout(kind, tuple(grids), tuple(loads), dtype, compress)
        self._axes = {grid.name: f"{grid.name}/{self._layout.axis}" for grid in grids}
        self._wanted = self._layout.rows.keys() - set(self._axes.values())
        self._file: Any = None  # h5py has no types
        self._room = self._committed = self._waiting = 0
        self._pending: list[dict[str, Values]] = []
        self._envelope: dict[str, Values] = {}
        self._last = -np.inf

    def __enter__(self) -> Self:
        check_target(self._target, force=self._force)
        clear(self.path)
        clear(self._fresh)
        self._move(self._block, "running")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        if self._file is None:
            return
        reason = "left before the end" if error is None else str(error) or type(error).__name__
        with suppress(UserError):  # the partial stays as it was; the first error is the one told
            self._settle("interrupted", reason)
        self._close()

    def append(self, axis: npt.ArrayLike, values: Mapping[str, npt.ArrayLike]) -> None:
        """Add rows: their steps or times, and every variable that has a row for each of them.

        Keys are paths as `F1/lateral_displacement` or `F1/tubes/1/moment_y`; the first axis of
        every array is that of the rows. Raises ValueError for missing, unknown, misshapen or
        non-finite values.
        """
        if values.keys() != self._wanted:
            missing, unknown = self._wanted - values.keys(), values.keys() - self._wanted
            raise ValueError(f"missing: {sorted(missing)}; unknown: {sorted(unknown)}")
        at = np.atleast_1d(np.asarray(axis, dtype=np.float64))
        if not np.all(np.diff(at, prepend=self._last) > 0.0):
            raise ValueError(f"{self._layout.axis} does not increase: {at} after {self._last}")
        rows = {}
        for path, place in self._layout.rows.items():
            # A copy: the caller may go on to use its own array.
            given = np.array(values.get(path, at), dtype=place.dtype)
            if given.shape != (len(at), *place.tail):
                raise ValueError(f"{path}: {given.shape} is not {(len(at), *place.tail)}")
            if not np.all(np.isfinite(given)):
                raise ValueError(f"{path}: not finite, {self._layout.axis} {at}")
            rows[path] = given
        self._pending.append(rows)
        self._waiting += len(at)
        self._last = at[-1]
        if self._waiting >= self._block:
            self.flush()

    def flush(self) -> None:
        """Commit what is still in memory."""
        if not self._waiting:
            return
        rows = {path: np.concatenate([p[path] for p in self._pending]) for path in self._pending[0]}
        for name, axis in self._axes.items():
            for quantity in QUANTITIES:
                path = f"{name}/envelope/{quantity}"
                widen(self._envelope, path, rows[f"{name}/{quantity}"], rows[axis])
        first, end = self._committed, self._committed + self._waiting
        if end > self._room:
            self._move(max(_GROWTH * self._room, end), "running")
        with told(self.path):
            for path, values in rows.items():
                self._file[path][first:end] = values
            for path, values in self._envelope.items():
                self._file[path][...] = values
            self._file.flush()
            self._file[COMMITTED][()] = end
            self._file.flush()
        self._pending, self._waiting, self._committed = [], 0, end

    def finish(self, status: Literal["complete", "stopped"], stop_reason: str = "") -> None:
        """Commit everything and put the database under the target's name."""
        if not self._committed + self._waiting:
            raise ValueError("a database without a row")
        self._settle(status, stop_reason)
        try:
            check_target(self._target, force=self._force)
            with told(self._target):
                os.replace(self.path, self._target)
        except UserError as error:
            raise UserError(*error.faults, f"the results are kept in {self.path}") from error

    def _settle(self, status: Status, reason: str) -> None:
        self.flush()
        self._move(self._committed, status, reason)

    def _move(self, room: int, status: Status, reason: str = "") -> None:
        """Put a fresh file with this room, and all that is committed, in place of the partial."""
        running = status == "running"
        with told(self.path):
            fresh = h5py.File(
                self._fresh, "x", libver=_FORMAT, track_order=True, locking="best-effort"
            )
            try:
                fresh.attrs.update({**self._head, "status": status, "stop_reason": reason})
                fresh.flush()  # from here on it can be told to be ours
                fresh[DECK] = self._deck
                fresh[DECK].attrs["sha256"] = sha256(self._deck.encode()).hexdigest()
                self._layout.build(fresh, room, ahead=running, envelope=self._envelope)
                self._copy(fresh)
                if running:
                    fresh[COMMITTED][()] = self._committed
                    fresh.flush()
                else:
                    fresh.close()
                    _synchronise(self._fresh)
                os.replace(self._fresh, self.path)
            except BaseException:
                with suppress(*REFUSED):
                    fresh.close()
                self._fresh.unlink(missing_ok=True)
                raise
        self._close()
        self._file, self._room = (fresh, room) if running else (None, 0)

    def _copy(self, fresh: Any) -> None:
        for path in self._layout.rows:
            for first in range(0, self._committed, _COPIED):
                rows = slice(first, min(first + _COPIED, self._committed))
                fresh[path][rows] = self._file[path][rows]

    def _close(self) -> None:
        if self._file is not None:
            with suppress(*REFUSED):  # what it holds is in place already, or was told to be lost
                self._file.close()
            self._file = None


def _synchronise(path: Path) -> None:
    with path.open("rb+") as file:
        os.fsync(file.fileno())
