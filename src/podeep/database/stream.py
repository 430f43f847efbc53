"""The file beneath HDF5 while it is written.

HDF5 does not survive a failed write: it can no longer close its file, and the process ends in a
segmentation fault. So here it never sees one. The first error is kept, nothing is written after
it, and `checked` raises it. As h5py calls this file back from within HDF5, an interrupt would be
such a failure too: it waits until HDF5 is done.
"""

import fcntl
import io
import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from .target import REFUSED, lock


class Stream(io.RawIOBase):
    """A new file, locked against other writers as HDF5 does it. Raises OSError if it exists."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        self._at = 0
        self._error: OSError | None = None
        lock(self._descriptor, fcntl.LOCK_EX)

    @contextmanager
    def checked(self) -> Iterator[None]:
        """Hold interrupts back, then raise what a write within or before has met."""
        try:
            with _uninterrupted():
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
        origin = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self._size()}[whence]
        self._at = origin + offset
        return self._at

    def _size(self) -> int:
        return 0 if self.closed else os.fstat(self._descriptor).st_size

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]  # as h5py gives it
        found = b"" if self.closed else os.pread(self._descriptor, len(buffer), self._at)
        buffer[:] = found.ljust(len(buffer), b"\0")  # room that nothing was written to
        self._at += len(buffer)
        return len(buffer)

    def write(self, data: memoryview) -> int:  # type: ignore[override]  # as h5py gives it
        self._attempt(lambda: self._write(data))
        self._at += len(data)
        return len(data)

    def _write(self, data: memoryview) -> None:
        done = 0
        while done < len(data):
            done += os.pwrite(self._descriptor, data[done:], self._at + done)

    def truncate(self, size: int | None = None) -> int:
        end = self._at if size is None else size
        self._attempt(lambda: os.ftruncate(self._descriptor, end))
        return end

    def _attempt(self, action: Callable[[], None]) -> None:
        if self._error is None and not self.closed:
            try:
                action()
            except OSError as error:
                self._error = error

    def synchronise(self) -> None:
        """Wait until the disk has everything."""
        os.fsync(self._descriptor)

    def close(self) -> None:
        if not self.closed:
            super().close()
            os.close(self._descriptor)


@contextmanager
def _uninterrupted() -> Iterator[None]:
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
