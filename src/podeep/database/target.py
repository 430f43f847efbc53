"""Which files may be written, replaced or removed; what the disk refuses, in words."""

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py

from ..errors import Fault, UserError
from .schema import SCHEMA

UNFINISHED = b"podeep-soil: a file that is being made\n"  # what it begins with until it is HDF5
REFUSED = (OSError, RuntimeError)  # what h5py raises where a file cannot be read or written


def check_target(target: Path, *, force: bool) -> None:
    """Raise UserError unless a database may be written under this name.

    What is not a database of ours is never replaced, and one of ours only by force.
    """
    if not target.parent.is_dir():
        raise UserError(
            Fault(f"{target} cannot be written: {target.parent} is no folder", "make it first")
        )
    if not os.path.lexists(target):
        return
    if not is_ours(target):
        raise UserError(
            Fault(
                f"{target} exists and is no soil database of this program; it is never overwritten",
                "choose another name or folder, or move it away",
            )
        )
    if not force:
        raise UserError(Fault(f"{target} exists", "replace it with --force, or move it away"))


def check_leftover(leftover: Path) -> None:
    """Raise UserError if what has this name is not ours, or if another run is writing it."""
    if os.path.lexists(leftover) and not is_ours(leftover):
        raise UserError(
            Fault(
                f"{leftover} is in the way: it is no readable soil database of this program",
                "move it away",
            )
        )


def clear(leftover: Path) -> None:
    """Remove what an earlier run left under this name; raises UserError if it is not ours."""
    check_leftover(leftover)
    with told(leftover):
        leftover.unlink(missing_ok=True)


def is_ours(path: Path) -> bool:
    """Whether a file carries our schema's name, or was left half made by us.

    Raises UserError while another run writes it.
    """
    if not path.is_file():
        return False
    try:
        with path.open("rb") as file:
            lock(file.fileno(), fcntl.LOCK_SH)
            if file.read(len(UNFINISHED)) == UNFINISHED:
                return True
        with h5py.File(path, "r", locking=False) as database:
            return bool(database.attrs.get("schema") == SCHEMA)
    except BlockingIOError as error:
        raise _busy(path) from error
    except (*REFUSED, KeyError, TypeError, ValueError):
        return False


def lock(descriptor: int, kind: int) -> None:
    """Lock an open file until it is closed, as HDF5 does; BlockingIOError if another holds it."""
    try:
        fcntl.flock(descriptor, kind | fcntl.LOCK_NB)
    except OSError as error:
        # Some network disks have no locks; HDF5 goes without them there too.
        if error.errno not in (errno.ENOSYS, errno.ENOTSUP, errno.ENOLCK):
            raise


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Turn what the disk refuses into words."""
    try:
        yield
    except (FileExistsError, BlockingIOError) as error:
        raise _busy(path) from error
    except REFUSED as error:
        number = getattr(error, "errno", None)
        reason = os.strerror(number) if number else str(error)
        raise UserError(
            Fault(f"{path} cannot be written: {reason}", "free or choose another disk or folder")
        ) from error


def _busy(path: Path) -> UserError:
    return UserError(
        Fault(f"another run is writing {path}", "wait for its end, or choose another name")
    )
