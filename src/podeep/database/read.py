"""The reader of soil databases, finished ones and those that a run is still writing.

Opening checks the whole structure and reads coordinates only; values are read when asked for. Of a
database that is not finished only the rows are seen that were committed when it was opened.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn, Self, TypeVar

import h5py
import numpy as np

from ..arrays import Array
from ..errors import Fault, UserError
from ..subject import FOUNDATION, LINE, SUBJECTS, Subject
from . import restart
from .foundation import FoundationData, LineData
from .schema import (
    AXES,
    COMMITTED,
    DECK,
    ENDINGS,
    MAJOR,
    MINOR,
    PARTIAL,
    SCHEMA,
    STATUSES,
    Status,
    places,
    variables,
)
from .trust import dataset, member, numbers, opened, reading, text, wrong
from .variable import KINDS, Kind, Variable

__all__ = ["Database", "FoundationData", "LineData", "open_database"]

T = TypeVar("T", bound=str)

_NAME = {subject.name: re.compile(rf"{subject.initial}\d+") for subject in SUBJECTS}


@dataclass(frozen=True, eq=False)
class Database:
    """An open database; a context manager that closes it.

    names: of its foundations and lines, in the order of the file.
    """

    path: Path
    kind: Kind
    title: str
    status: Status
    stop_reason: str
    version: str
    schema_version: str
    _file: Any
    _data: Mapping[str, FoundationData | LineData]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._data)

    @property
    def foundations(self) -> tuple[str, ...]:
        return tuple(n for n, data in self._data.items() if isinstance(data, FoundationData))

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(n for n, data in self._data.items() if isinstance(data, LineData))

    def __getitem__(self, name: str) -> FoundationData | LineData:
        """The data of one of `names`."""
        return self._data[name]

    def foundation(self, name: str) -> FoundationData:
        """The data of a foundation; raises UserError for a name that the database does not have."""
        data = self._data.get(name)
        return data if isinstance(data, FoundationData) else self._refuse(FOUNDATION, name)

    def line(self, name: str) -> LineData:
        """The data of a line; raises UserError for a name that the database does not have."""
        data = self._data.get(name)
        return data if isinstance(data, LineData) else self._refuse(LINE, name)

    def _refuse(self, subject: Subject, name: str) -> NoReturn:
        has = ", ".join(self._data)
        raise UserError(Fault(f"{self.path}: there is no {subject.name} {name}", f"it has {has}"))

    @cached_property
    def deck_text(self) -> str:
        """The deck that was solved, includes resolved."""
        with reading(self.path):
            data = member(self.path, self._file, DECK)
            if not isinstance(data, h5py.Dataset) or data.shape != ():
                raise wrong(self.path, f"{DECK} is no text")
            deck = data.asstr()[()]
            if sha256(deck.encode()).hexdigest() != text(self.path, data, "sha256"):
                raise wrong(self.path, f"{DECK} does not agree with its checksum")
        return str(deck)

    @cached_property
    def state(self) -> dict[str, Array] | None:
        """What the run would go on from, flat arrays by name; None if it has come to its end.

        Raises UserError where it is damaged.
        """
        return restart.load(self.path, self._file)

    def close(self) -> None:
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        self.close()


def open_database(path: Path) -> Database:
    """Open a database, finished or not, and check its structure.

    Raises UserError for what is no soil database, of another schema version, damaged or hostile.
    """
    file = opened(path)
    try:
        with reading(path):
            return _database(path, file)
    except BaseException:
        file.close()
        raise


def _database(path: Path, file: Any) -> Database:
    if "schema" not in file.attrs or text(path, file, "schema") != SCHEMA:
        raise wrong(
            path,
            "no soil database: an HDF5 file of another program",
            "name a database that podeep-solve has written",
        )
    _check_version(path, text(path, file, "schema_version"))
    kind = _one_of(path, file, "kind", KINDS)
    status = _one_of(path, file, "status", STATUSES)
    ending = Path(path.name.removesuffix(PARTIAL)).suffix.lower()
    if ENDINGS.get(ending, kind) != kind:
        right = next(e for e, k in ENDINGS.items() if k == kind)
        raise wrong(
            path, f"a {kind} database that ends in {ending}", f"rename it to end in {right}"
        )
    committed = _committed(path, file) if status == "running" else None
    named = {name: s for name in file for s in SUBJECTS if _NAME[s.name].fullmatch(name)}
    if not named:
        raise wrong(path, "it holds no foundation and no line")
    return Database(
        path=path,
        kind=kind,
        title=text(path, file, "title"),
        status=status,
        stop_reason=text(path, file, "stop_reason"),
        version=text(path, file, "version"),
        schema_version=text(path, file, "schema_version"),
        _file=file,
        _data={name: _group(path, file, name, s, kind, committed) for name, s in named.items()},
    )


def _one_of(path: Path, file: Any, name: str, allowed: tuple[T, ...]) -> T:
    value = text(path, file, name)
    for one in allowed:
        if one == value:
            return one
    raise wrong(path, f"{name} is {value!r}, none of {', '.join(allowed)}")


def _check_version(path: Path, version: str) -> None:
    found = re.fullmatch(r"(\d{1,4})\.(\d{1,4})", version)
    if found is None:
        raise wrong(path, f"schema_version is {version!r}, not as {MAJOR}.{MINOR}")
    if int(found[1]) != MAJOR:
        raise wrong(
            path,
            f"its schema is {version}, this program reads {MAJOR}.x",
            "use the version of the program that wrote it, or run the analysis again",
        )


def _committed(path: Path, file: Any) -> int:
    counter = member(path, file, COMMITTED)
    if not isinstance(counter, h5py.Dataset) or counter.shape != () or counter.dtype.kind != "i":
        raise wrong(path, f"{COMMITTED} is no number of rows")
    return int(counter[()])


def _group(
    path: Path, file: Any, name: str, subject: Subject, kind: Kind, committed: int | None
) -> FoundationData | LineData:
    group = member(path, file, name)
    if not isinstance(group, h5py.Group):
        raise wrong(path, f"{name} is no group")
    of_line, loads = subject is LINE, "load" in group
    spatial = "lateral_axis" not in group.attrs
    table = variables(kind, spatial=spatial, loads=loads, subject=subject)
    axis = AXES[kind]
    sizes = {v.name: _length(path, group, v.name) for v in table if v.is_scale and not v.group}
    rows = sizes[axis] if committed is None else committed
    if not 0 <= rows <= sizes[axis]:
        raise wrong(path, f"{name} has room for {sizes[axis]} rows, not for {rows}")
    if committed is None and not rows:
        raise wrong(path, f"{name} holds no {axis}")
    tubes = () if of_line else _tubes(path, group)
    datasets = _datasets(path, group, table, tubes, sizes)
    stored: dict[str, Any] = {
        "name": name,
        "points": _coordinate(path, datasets[subject.coordinate], rising=True),
        "axis": _coordinate(path, datasets[axis], rows, rising=True),
        "mudline": _number(path, group, "mudline"),
        "layer_boundaries": np.empty(0) if of_line else _boundaries(path, group),
        "load_names": tuple(map(str, datasets["load"].asstr()[...])) if loads else (),
        "path": path,
        "finished": committed is None,
        "datasets": datasets,
    }
    if of_line:
        return LineData(**stored)
    return FoundationData(
        **stored,
        lateral_axis=None if spatial else _number(path, group, "lateral_axis"),
        layer=np.asarray(datasets["layer"][...], dtype=np.intp),
        tube=np.asarray(datasets["tube"][...], dtype=np.intp),
        elevations={
            igr: _coordinate(path, datasets[f"tubes/{igr}/elevation"], rising=False)
            for igr in tubes
        },
    )


def _datasets(
    path: Path,
    group: Any,
    table: tuple[Variable, ...],
    tubes: tuple[int, ...],
    sizes: dict[str, int],
) -> dict[str, Any]:
    """The variables of a group by their paths in it, checked; sizes: of its dimensions."""
    found = {}
    for place, variable, igr in places(table, tubes):
        if igr is not None:
            sizes = sizes | {"elevation": _length(path, group, f"tubes/{igr}/elevation")}
        if variable.later and place not in group:
            continue
        shape = tuple(sizes[d] for d in variable.dims)
        found[place] = dataset(path, group, place, variable, shape)
    return found


def _tubes(path: Path, group: Any) -> tuple[int, ...]:
    if "tubes" not in group:
        return ()
    tubes = member(path, group, "tubes")
    return tuple(int(igr) for igr in tubes if re.fullmatch(r"\d{1,9}", igr))


def _length(path: Path, group: Any, name: str) -> int:
    """Length of a coordinate; its own check follows with that of all variables."""
    data = member(path, group, name)
    if not isinstance(data, h5py.Dataset) or data.ndim != 1:
        raise wrong(path, f"{group.name.strip('/')}/{name} is no coordinate")
    return int(data.shape[0])


def _coordinate(path: Path, data: Any, count: int | None = None, *, rising: bool) -> Array:
    values = np.asarray(data[:count], dtype=np.float64)
    steps = np.diff(values) if rising else -np.diff(values)
    empty = not values.size and count != 0  # a run may not have committed a row yet
    if empty or not np.all(np.isfinite(values)) or not np.all(steps > 0.0):
        what = "rising" if rising else "falling"
        raise wrong(path, f"{data.name.strip('/')} does not hold finite, {what} values")
    return values


def _boundaries(path: Path, group: Any) -> Array:
    return np.atleast_1d(numbers(path, group, "layer_boundaries"))


def _number(path: Path, group: Any, name: str) -> float:
    value = numbers(path, group, name)
    if value.ndim:
        raise wrong(path, f"attribute {name} of {group.name.strip('/')} is not one number")
    return float(value)
