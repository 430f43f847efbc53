"""The writer of soil databases: what it has committed survives a kill at any moment.

The run writes `NAME.partial` beside the target. Room for many rows is allocated when that file is
made, and nothing but values is written into it afterwards: first rows, then the number of rows that
readers may trust. When the room is used up, and at the end, everything moves to a fresh file that
takes the place of the partial in one step: at no moment does a half-built file have that name. The
fresh file at the end has no spare room, and is what the target becomes.

A run that gives its state with the rows can be taken up again: see `restart`.
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
from ..arrays import Array
from ..errors import Fault, UserError
from . import restart
from .envelope import Values, widen
from .grids import Grid, LineGrid
from .layout import Layout
from .rows import Room, copy_rows
from .schema import (
    COMMITTED,
    CONVENTIONS,
    DECK,
    MAJOR,
    MINOR,
    PARTIAL,
    SCHEMA,
    Status,
)
from .stream import Sink, uninterrupted
from .target import check_leftover, check_target, clear, told
from .variable import EXTREMES, Kind

__all__ = ["Grid", "LineGrid", "Writer", "check_target"]

_ROWS, _BOUNDS = "rows", "bounds/"  # names in a state that are the writer's own
_STATE_GROWTH = 2  # of the room of a state, some parts of which may grow
_GROWTH = 4  # of the room, each time that it is used up
_WIDER = 2  # the arrays of rows that wait


class Writer:
    """Writes a database row by row; a context manager that leaves the partial unless finished.

    loads: names of the loads of `load_factor`, none in a dynamic database. dtype: of results;
    float64 in a static, float32 in a dynamic database unless given. compress: gzip what is large.
    block: rows that are kept in memory before they are written together. room: rows that are
    expected, for which room is allocated ahead; what is not used takes no space on disk. state: of
    the run before its first row, if it can be taken up again; with `resumes` it is the one that the
    partial holds, and the rows of that time are kept. Entering raises UserError for a target that
    may not be written, and every method does where the disk fails.
    """

    def __init__(
        self,
        target: Path,
        *,
        kind: Kind,
        title: str,
        deck_text: str,
        grids: Sequence[Grid | LineGrid],
        loads: Sequence[str],
        history: str = "",
        force: bool = False,
        dtype: npt.DTypeLike | None = None,
        compress: bool = False,
        block: int = 1024,
        room: int = 0,
        state: restart.State | None = None,
        resumes: bool = False,
    ) -> None:
        self.path = target.with_name(target.name + PARTIAL)
        self._fresh = target.with_name(target.name + PARTIAL + ".new")
        self._target, self._force, self._block = target, force, block
        self._expected = max(room, block)
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
        self._sink: Sink
        self._is_open = False
        self._room = self._committed = self._waiting = 0
        # Rows that wait, in arrays that are used again: fresh memory is slow to come by.
        self._rows = {
            path: np.empty((0, *place.tail), place.dtype)
            for path, place in self._layout.rows.items()
        }
        self._envelope: dict[str, Values] = {}
        self._last = -np.inf
        self._state, self._resumes = state, resumes
        self._state_room = 0
        self._rooms: dict[str, Room] = {}
        self._slots: restart.Data = {}

    def __enter__(self) -> Self:
        check_target(self._target, force=self._force)
        check_leftover(self.path)
        clear(self._fresh)
        if not self._resumes:
            self._state = self._whole(self._state)
        if self._state is not None:
            self._state_room = _STATE_GROWTH * restart.size(self._state)
        try:
            if self._resumes:
                self._take_up()
            else:
                self._move(self._expected, "running")
        except BaseException:
            if self._is_open:
                self._sink.close()
            raise
        return self

    def _whole(self, state: restart.State | None) -> restart.State | None:
        """A state of the run, and what this writer adds to it."""
        if state is None:
            return None
        paths = [f"{g}/envelope/{q}_{e}" for g, q, _ in self._layout.shown for e in EXTREMES]
        bounds = {f"{_BOUNDS}{path}": self._envelope.get(path, np.empty(0)) for path in paths}
        return {**state, _ROWS: np.array(self._committed + self._waiting), **bounds}

    def _take_up(self) -> None:
        """Go on from the rows and the state of the partial; what is in it beyond them is left."""
        assert self._state is not None
        rows = int(self._state[_ROWS][0])
        with told(self.path), h5py.File(self.path, "r", locking=False) as source:
            for path, place in self._layout.rows.items():
                data = source.get(path)
                fits = isinstance(data, h5py.Dataset) and data.shape[1:] == place.tail
                if not fits or data.dtype != place.dtype or not 0 <= rows <= data.shape[0]:
                    raise UserError(
                        Fault(
                            f"{self.path} does not hold what this run would have written: {path} "
                            "differs",
                            "run the deck again without --resume",
                        )
                    )
            self._committed = rows
            self._envelope = {
                name.removeprefix(_BOUNDS): values
                for name, values in self._state.items()
                if name.startswith(_BOUNDS) and values.size
            }
            if rows:
                self._last = float(source[next(iter(self._axes.values()))][rows - 1])
            self._move(max(self._expected, rows), "running", source=source)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        if not self._is_open:
            return
        if not self._committed + self._waiting:
            self._sink.close()  # as it is, it opens, and says that it holds no rows
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
        first, end = self._waiting, self._waiting + len(at)
        for path, place in self._layout.rows.items():
            given, kept = np.asarray(values.get(path, at)), self._rows[path]
            if given.shape != (len(at), *place.tail):
                raise ValueError(f"{path}: {given.shape} is not {(len(at), *place.tail)}")
            if end > len(kept):
                kept = np.empty((max(_WIDER * len(kept), end), *place.tail), place.dtype)
                kept[:first] = self._rows[path][:first]
                self._rows[path] = kept
            kept[first:end] = given
            if not np.all(np.isfinite(kept[first:end])):
                raise ValueError(f"{path}: not finite, {self._layout.axis} {at}")
        self._waiting = end
        self._last = at[-1]
        if self._waiting >= self._block and self._state is None:
            self.flush()

    def widen(self, axis: Array, values: Mapping[str, Array]) -> None:
        """Widen the envelopes by rows that are computed and not stored.

        axis: their steps or times. Keys are paths as `F1/lateral_displacement`, of all quantities
        that have an envelope, of all foundations and lines.
        """
        for path, rows in values.items():
            name, quantity = path.rsplit("/", 1)
            widen(self._envelope, f"{name}/envelope/{quantity}", rows, axis)

    @uninterrupted()
    def flush(self, state: restart.State | None = None) -> None:
        """Commit what is still in memory; state: of the run after it, if it has one."""
        if not self._waiting and state is None:
            return
        rows = self._gathered()
        state = self._whole(state)
        if state is not None and list(state) != list(self._state or ()):
            raise ValueError(f"another state than before: {sorted(state)}")
        first, end = self._committed, self._committed + self._waiting
        need = restart.size(state) if state else 0
        if end > self._room or need > self._state_room:
            self._state_room = max(self._state_room, _STATE_GROWTH * need)
            room = self._room if end <= self._room else max(_GROWTH * self._room, end)
            self._move(room, "running")
        file, stream = self._sink
        with told(self.path):
            with stream.checked():
                for path, values in rows.items():
                    for at, part in self._rooms[path].parts(first, values):
                        stream.put(part.view(np.uint8).data, at)
                if state is not None:
                    restart.put(self._slots, state)
                file.flush()
            with stream.checked():
                file[COMMITTED][()] = end
                if state is not None:
                    restart.confirm(self._slots)
                file.flush()
        self._waiting, self._committed = 0, end
        self._state = state if state is not None else self._state

    def _gathered(self) -> dict[str, Values]:
        """The rows that wait, together; the envelopes are widened by them."""
        if not self._waiting:
            return {}
        rows = {path: kept[: self._waiting] for path, kept in self._rows.items()}
        for name, quantity, stored in self._layout.shown:
            path = f"{name}/envelope/{quantity}"
            widen(self._envelope, path, rows[f"{name}/{stored}"], rows[self._axes[name]])
        return rows

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
    def _move(self, room: int, status: Status, reason: str = "", source: Any = None) -> None:
        """Put a fresh file with this room, and all that is committed, in place of the partial.

        source: the file that holds it, the one that is being written unless given.
        """
        running = status == "running"
        with told(self.path):
            fresh = Sink.create(self._fresh)
            try:
                with fresh.stream.checked():
                    self._build(fresh.file, room, status, reason)
                    if self._committed:
                        self._copy(source or self._sink.file, fresh.file)
                    fresh.file.flush()
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
        if running:
            self._rooms = {path: Room.of(fresh.file[path]) for path in self._layout.rows}
            if self._state is not None:
                self._slots = restart.written(fresh.file)
        else:
            fresh.close()

    def _build(self, file: Any, room: int, status: Status, reason: str) -> None:
        file.attrs.update({**self._head, "status": status, "stop_reason": reason})
        deck = file.create_dataset(DECK, data=self._deck, dtype=h5py.string_dtype())
        deck.attrs["sha256"] = sha256(self._deck.encode()).hexdigest()
        self._layout.build(file, room, ahead=status == "running", envelope=self._envelope)
        if status == "running":
            file[COMMITTED][()] = self._committed
        if self._state is not None and status in ("running", "interrupted"):
            restart.build(file, self._state, self._state_room)

    def _copy(self, source: Any, file: Any) -> None:
        """Copy what is committed to another file."""
        for path in self._layout.rows:
            copy_rows(source[path], file[path], self._committed)
