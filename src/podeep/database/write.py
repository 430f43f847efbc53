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
from typing import Any, Literal, NamedTuple, Self

import h5py
import numpy as np
import numpy.typing as npt

from .. import __version__
from ..arrays import Array
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
from .stream import Stream, uninterrupted
from .target import REFUSED, check_target, clear, told

__all__ = ["Grid", "Writer", "check_target"]

_FORMAT = ("v108", "v108")  # old enough for every netCDF, new enough to have checksums
_COPIED = 4096  # rows at a time
_GROWTH = 4  # of the room, each time that it is used up; what is not used takes no space on disk


class _Sink(NamedTuple):
    """An HDF5 file that is being written, and the stream beneath it."""

    file: Any  # h5py has no types
    stream: Stream

    @classmethod
    def create(cls, path: Path) -> Self:
        stream = Stream(path)
        made: Stream | Self = stream
        try:
            with stream.checked():
                stream.claim()
                made = sink = cls(h5py.File(stream, "w", libver=_FORMAT, track_order=True), stream)
        except BaseException:
            made.close()  # HDF5 left open would end the process in a segmentation fault
            path.unlink()
            raise
        return sink

    @uninterrupted()
    def close(self) -> None:
        """Close without complaint: what there was to tell has been told."""
        with suppress(*REFUSED), self.stream.checked():
            self.file.close()
        self.stream.close()


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
        self._sink: _Sink
        self._is_open = False
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
        if not self._is_open:
            return
        match error:
            case None:
                reason = "left before the end"
            case KeyboardInterrupt():
                reason = "interrupted by the user"
            case _:
                reason = str(error) or type(error).__name__
        try:
            with suppress(UserError):  # the partial stays as it was; the first error is told
                self._settle("interrupted", reason)
        finally:
            if self._is_open:
                self._sink.close()

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

    def widen(self, axis: Array, values: Mapping[str, Array]) -> None:
        """Widen the envelopes by rows that are computed and not stored.

        axis: their steps or times. Keys are paths as `F1/lateral_displacement`, of all quantities
        that have an envelope, of all foundations.
        """
        for path, rows in values.items():
            name, quantity = path.rsplit("/", 1)
            widen(self._envelope, f"{name}/envelope/{quantity}", rows, axis)

    @uninterrupted()
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
        file, stream = self._sink
        with told(self.path):
            with stream.checked():
                for path, values in rows.items():
                    file[path][first:end] = values
                for path, values in self._envelope.items():
                    file[path][...] = values
                file.flush()
            with stream.checked():
                file[COMMITTED][()] = end
                file.flush()
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

    @uninterrupted()
    def _move(self, room: int, status: Status, reason: str = "") -> None:
        """Put a fresh file with this room, and all that is committed, in place of the partial."""
        running = status == "running"
        with told(self.path):
            fresh = _Sink.create(self._fresh)
            try:
                with fresh.stream.checked():
                    self._build(fresh.file, room, status, reason)
                    if not running:
                        fresh.file.close()
                    fresh.stream.publish()
                fresh.stream.synchronise()
                os.replace(self._fresh, self.path)
            except BaseException:
                fresh.close()
                self._fresh.unlink(missing_ok=True)
                raise
        if self._is_open:
            self._sink.close()
        self._sink, self._room, self._is_open = fresh, room, running
        if not running:
            fresh.close()

    def _build(self, file: Any, room: int, status: Status, reason: str) -> None:
        file.attrs.update({**self._head, "status": status, "stop_reason": reason})
        deck = file.create_dataset(DECK, data=self._deck, dtype=h5py.string_dtype())
        deck.attrs["sha256"] = sha256(self._deck.encode()).hexdigest()
        self._layout.build(file, room, ahead=status == "running", envelope=self._envelope)
        for path in self._layout.rows:
            for first in range(0, self._committed, _COPIED):
                rows = slice(first, min(first + _COPIED, self._committed))
                file[path][rows] = self._sink.file[path][rows]
        if status == "running":
            file[COMMITTED][()] = self._committed
        file.flush()
