"""The file beneath HDF5 while it is written.

HDF5 does not survive a failed write: it can no longer close its file, and the process ends in a
segmentation fault. So here it never sees one. The first error is kept, nothing is written after
it, and `checked` raises it. As h5py calls this file back from within HDF5, an interrupt would be
such a failure too: all use of HDF5 stands under `uninterrupted`.

Until `publish` the first bytes are held back and others stand in their place, so that what a kill
leaves half made is never taken for a database, and yet can be told to be ours.
"""

import fcntl
import io
import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple, Self

import h5py

from .target import REFUSED, UNFINISHED, lock

_FORMAT = ("v108", "v108")  # old enough for every netCDF, new enough to have checksums
_CACHE = 2**18  # bytes of chunks for each variable, each written once: they would fill any cache


class Stream(io.RawIOBase):
    """A new file, locked against other writers as HDF5 does it; OSError if it exists."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        self._at = self._end = 0  # as HDF5 sees them
        self._error: OSError | None = None
        self._head: bytearray | None = bytearray(len(UNFINISHED))

    def claim(self) -> None:
        """Lock the file and mark it as ours; to be called first."""
        lock(self._descriptor, fcntl.LOCK_EX)
        self._attempt(lambda: self._write(UNFINISHED, 0))

    @contextmanager
    def checked(self) -> Iterator[None]:
        """Raise what a write within or before has met."""
        try:
            yield
        except REFUSED:
            self._raise()
            raise
        self._raise()

    def _raise(self) -> None:
        if self._error is not None:
            raise OSError(self._error.errno, self._error.strerror)

    def seekable(self) -> bool:
        return True

    def tell(self) -> int:
        return self._at

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        origin = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self._end}[whence]
        self._at = origin + offset
        return self._at

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]  # as h5py gives it
        found = b"" if self.closed else os.pread(self._descriptor, len(buffer), self._at)
        if len(found) < len(buffer):
            found = found.ljust(len(buffer), b"\0")  # room that nothing was written to
        buffer[:] = found
        if self._head is not None and self._at < len(self._head):
            held = self._head[self._at : self._at + len(buffer)]
            buffer[: len(held)] = held
        self._at += len(buffer)
        return len(buffer)

    def write(self, data: memoryview) -> int:  # type: ignore[override]  # as h5py gives it
        held = 0
        if self._head is not None and self._at < len(self._head):
            held = min(len(self._head) - self._at, len(data))
            self._head[self._at : self._at + held] = data[:held]
        self._attempt(lambda: self._write(data[held:], self._at + held))
        self._at += len(data)
        self._end = max(self._end, self._at)
        return len(data)

    def put(self, data: memoryview, at: int) -> None:
        """Write bytes behind HDF5's back, to room that it has allocated."""
        self._attempt(lambda: self._write(data, at))

    def _write(self, data: memoryview | bytearray | bytes, at: int) -> None:
        done = 0
        while done < len(data):
            done += os.pwrite(self._descriptor, data[done:], at + done)

    def publish(self) -> None:
        """Let the file begin as HDF5 has written it; to be called when all else is there."""
        head, self._head = self._head, None
        if head is not None:
            self._attempt(lambda: self._write(head, 0))

    def truncate(self, size: int | None = None) -> int:
        end = self._at if size is None else size
        self._attempt(lambda: os.ftruncate(self._descriptor, end))
        self._end = end
        return end

    def _attempt(self, action: Callable[[], None]) -> None:
        if self._error is None and not self.closed:
            try:
                action()
            except OSError as error:
                self._error = error

    def flush(self) -> None:
        """Nothing is held back here; HDF5 may still ask for it when all is closed."""

    def synchronise(self) -> None:
        """Wait until the disk has everything."""
        os.fsync(self._descriptor)

    def close(self) -> None:
        if not self.closed:
            super().close()
            os.close(self._descriptor)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Let SIGINT and SIGTERM wait, where a handler in Python might raise an exception."""
    main = threading.current_thread() is threading.main_thread()
    handlers = {s: h for s in (signal.SIGINT, signal.SIGTERM) if callable(h := signal.getsignal(s))}
    caught: list[tuple[int, FrameType | None]] = []
    for number in handlers if main else ():
        signal.signal(number, lambda *what: caught.append(what))
    try:
        yield
    finally:
        for number, handler in handlers.items() if main else ():
            signal.signal(number, handler)
    for which, frame in caught[:1]:
        handlers[signal.Signals(which)](which, frame)


class Sink(NamedTuple):
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
                options = {"libver": _FORMAT, "track_order": True, "rdcc_nbytes": _CACHE}
                made = sink = cls(h5py.File(stream, "w", **options), stream)
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
