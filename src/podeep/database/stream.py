"""The file beneath HDF5 while it is written.

HDF5 does not survive a failed write: it cannot close its file any more, and the process ends in a
segmentation fault. So here it never sees one. The first error is kept, nothing is written after
it, and `checked` raises it.
"""

import fcntl
import io
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .target import REFUSED


class Stream(io.RawIOBase):
    """A new file, locked against other writers as HDF5 does it. Raises OSError if it exists."""

    def __init__(self, path: Path) -> None:
        self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self._at = 0
        self._error: OSError | None = None

    @contextmanager
    def checked(self) -> Iterator[None]:
        """Raise the error that a write within met, or one before it."""
        try:
            yield
        except REFUSED:
            self._raise()
            raise
        self._raise()

    def _raise(self) -> None:
        if self._error is not None:
            raise OSError(*self._error.args)

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        match whence:
            case io.SEEK_SET:
                self._at = offset
            case io.SEEK_CUR:
                self._at += offset
            case _:
                self._at = os.fstat(self._descriptor).st_size + offset
        return self._at

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]  # what HDF5 gives
        found = os.pread(self._descriptor, len(buffer), self._at)
        buffer[:] = found.ljust(len(buffer), b"\0")  # room that has not been written yet
        self._at += len(buffer)
        return len(buffer)

    def write(self, data: memoryview) -> int:  # type: ignore[override]  # what HDF5 gives
        self._attempt(self._write_all, data)
        self._at += len(data)
        return len(data)

    def _write_all(self, data: memoryview) -> None:
        done = 0
        while done < len(data):
            done += os.pwrite(self._descriptor, data[done:], self._at + done)

    def truncate(self, size: int | None = None) -> int:
        end = self._at if size is None else size
        self._attempt(os.ftruncate, self._descriptor, end)
        return end

    def _attempt(self, function, *arguments):
        if self._error is None:
            try:
                function(*arguments)
            except OSError as error:
                self._error = error

    def synchronise(self) -> None:
        """Wait until the disk has everything."""
        os.fsync(self._descriptor)

    def close(self) -> None:
        if not self.closed:
            os.close(self._descriptor)
        super().close()
