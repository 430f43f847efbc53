"""Looking into a file that may be damaged or hostile: nothing is allocated before it is checked.

Every function raises UserError that names the file and what is wrong with it.
"""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..errors import Fault, UserError
from .variable import Number, Variable

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32}
_DEFLATED = 1032  # deflate cannot shrink data by more
_LARGEST_CHUNK = 2**26  # bytes
_LARGEST_ATTRIBUTE = 2**20  # bytes
_TYPES: Mapping[Number, tuple[str, ...]] = {
    "result": ("f4", "f8"),
    "coordinate": ("f8",),
    "integer": ("i4", "i8"),
    "text": ("O",),
}
# What h5py raises at bytes that are not what it expects.
_DAMAGE = (OSError, RuntimeError, LookupError, TypeError, ValueError, OverflowError, MemoryError)


def wrong(path: Path, what: str, remedy: str = "run the analysis again") -> UserError:
    """The error for a database that cannot be used."""
    return UserError(Fault(f"{path}: {what}", remedy))


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """Turn what HDF5 finds damaged into words."""
    try:
        yield
    except _DAMAGE as error:
        # HDF5 puts its reason in brackets behind h5py's.
        found = re.search(r"\((.*)\)", str(error), re.DOTALL)
        reason = found[1] if found else str(error) or type(error).__name__
        raise wrong(path, f"the file is damaged or cut short: {reason}") from error


def opened(path: Path) -> Any:
    """The h5py file, open for reading beside a writer; a file that is not HDF5 is refused."""
    if path.is_dir():
        raise wrong(path, "a folder, not a database", "name a .dss or .dst file")
    if not path.exists():
        raise wrong(path, "there is no such file", "name a .dss or .dst that exists")
    if not path.is_file():
        raise wrong(path, "not an ordinary file", "name a .dss or .dst file")
    try:
        with path.open("rb") as file:
            head = file.read(len(_SIGNATURE))
    except OSError as error:
        raise wrong(path, f"cannot be read: {error.strerror}", "check its permissions") from error
    if head != _SIGNATURE:
        raise wrong(
            path,
            "no soil database: it is not an HDF5 file"
            + ("; DeepLines' own simulation files have this ending too" * _is_dss(path)),
            "name a database that podeep-solve has written",
        )
    with reading(path):
        return h5py.File(path, "r", locking=False)


def _is_dss(path: Path) -> bool:
    return path.suffix.lower() == ".dss"


def member(path: Path, group: Any, name: str) -> Any:
    """What stands under a path in a group; links elsewhere are not followed."""
    for part in name.split("/"):
        if not isinstance(group, h5py.Group) or part not in group:
            raise wrong(path, f"{name} is missing")
        if group.id.links.get_info(part.encode()).type != h5py.h5l.TYPE_HARD:
            raise wrong(path, f"{name} is a link to elsewhere", "links are not followed")
        group = group[part]
    return group


def text(path: Path, holder: Any, name: str) -> str:
    """An attribute that is a string."""
    value = _attribute(path, holder, name)
    if not isinstance(value, str):
        raise wrong(path, f"{_named(holder, name)} is no text")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise wrong(path, f"{_named(holder, name)} is no UTF-8 text") from error
    return value


def numbers(path: Path, holder: Any, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """An attribute that is a finite number, shape (), or a list of them, shape (n,)."""
    value = np.asarray(_attribute(path, holder, name))
    if value.dtype.kind not in "fi" or value.ndim > 1 or not np.all(np.isfinite(value)):
        raise wrong(path, f"{_named(holder, name)} holds no finite numbers")
    return value.astype(np.float64)


def _attribute(path: Path, holder: Any, name: str) -> Any:
    if name not in holder.attrs:
        raise wrong(path, f"{_named(holder, name)} is missing")
    attribute = holder.attrs.get_id(name)
    # h5py takes the size 0 of an empty list for an error
    filled = attribute.get_space().get_simple_extent_npoints() > 0
    if filled and attribute.get_storage_size() > _LARGEST_ATTRIBUTE:
        raise wrong(path, f"{_named(holder, name)} is absurdly large")
    return holder.attrs[name]


def _named(holder: Any, name: str) -> str:
    where = str(holder.name).strip("/")
    return f"attribute {name} of {where}" if where else f"attribute {name}"


def dataset(path: Path, group: Any, name: str, variable: Variable, shape: tuple[int, ...]) -> Any:
    """The dataset of a variable, its shape, type, units and storage checked, nothing read."""
    data = member(path, group, name)
    what = f"{group.name.strip('/')}/{name}"
    if not isinstance(data, h5py.Dataset):
        raise wrong(path, f"{what} is no variable")
    if data.shape != shape:
        raise wrong(path, f"{what} has shape {data.shape}, its dimensions {shape}")
    if data.dtype.str[1:] not in _TYPES[variable.number] or (
        variable.number == "text" and h5py.check_string_dtype(data.dtype) is None
    ):
        raise wrong(path, f"{what} is of type {data.dtype}")
    if variable.units and text(path, data, "units") != variable.units:
        raise wrong(path, f"{what} is in {data.attrs['units']!r}, not in {variable.units!r}")
    _check_storage(path, what, data)
    return data


def _check_storage(path: Path, what: str, data: Any) -> None:
    creation = data.id.get_create_plist()
    if data.is_virtual or creation.get_external_count():
        raise wrong(path, f"{what} keeps its values in another file", "such files are not read")
    filters = {creation.get_filter(i)[0] for i in range(creation.get_nfilters())}
    if not filters <= _FILTERS:
        raise wrong(path, f"{what} is packed in an unknown way")
    if data.chunks and int(np.prod(data.chunks, dtype=object)) * data.dtype.itemsize > (
        _LARGEST_CHUNK
    ):
        raise wrong(path, f"{what} has absurdly large chunks")
    stored = min(data.id.get_storage_size(), path.stat().st_size)
    declared = int(np.prod(data.shape, dtype=object)) * data.dtype.itemsize
    if declared > stored * (_DEFLATED if filters else 1):
        raise wrong(path, f"{what} declares {declared} bytes and stores {stored}")
