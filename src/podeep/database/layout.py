"""How a soil database is laid out in HDF5, whatever stands in it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt

from .envelope import Values
from .grids import Grid, LineGrid
from .schema import AXES, COMMITTED, places, variables
from .variable import Kind, Variable

_CHUNK = (2048, 10)  # rows and depths: serves an evolution in time and a snapshot alike
_GZIP = 4
_RESULT = {"static": np.float64, "dynamic": np.float32}


@dataclass(frozen=True, slots=True)
class Place:
    """A variable in the file: its type there, and the sizes of its dimensions but the axis."""

    variable: Variable
    dtype: npt.DTypeLike
    tail: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Layout:
    """What a database of these foundations and lines consists of.

    loads: names of the loads of `load_factor`, none in a dynamic database. dtype: of results, None
    for float64 in a static and float32 in a dynamic database. compress: gzip what is large.
    """

    kind: Kind
    grids: Sequence[Grid | LineGrid]
    loads: Sequence[str]
    dtype: npt.DTypeLike | None
    compress: bool

    @property
    def axis(self) -> str:
        """The dimension that grows."""
        return AXES[self.kind]

    @cached_property
    def places(self) -> dict[str, dict[str, Place]]:
        """All variables of each group by their path in the file, scales before their users."""
        return {grid.name: self._places(grid) for grid in self.grids}

    def _places(self, grid: Grid | LineGrid) -> dict[str, Place]:
        dtypes: dict[str, npt.DTypeLike] = {
            "result": np.dtype(_RESULT[self.kind] if self.dtype is None else self.dtype),
            "coordinate": np.dtype(np.float64),
            "integer": np.dtype(np.int32),
            "text": h5py.string_dtype(),
        }
        sizes = {grid.subject.coordinate: grid.count, "load": len(self.loads)}
        table = variables(
            self.kind, spatial=grid.spatial, loads=bool(self.loads), subject=grid.subject
        )
        found = {}
        for path, variable, igr in places(table, grid.tubes):
            if igr is not None:
                sizes["elevation"] = len(grid.tubes[igr])
            tail = tuple(sizes[d] for d in variable.dims if d != self.axis)
            found[f"{grid.name}/{path}"] = Place(variable, dtypes[variable.number], tail)
        return found

    @property
    def shown(self) -> list[tuple[str, str, str]]:
        """What has an envelope: name of the group, of the quantity, and its path in the group."""
        return [
            (grid.name, quantity, grid.subject.stored(quantity))
            for grid in self.grids
            for quantity in grid.subject.quantities
        ]

    @cached_property
    def rows(self) -> dict[str, Place]:
        """The variables that have a row for each step or time."""
        every = {path: p for of_grid in self.places.values() for path, p in of_grid.items()}
        return {path: place for path, place in every.items() if self.axis in place.variable.dims}

    def build(self, file: Any, room: int, *, ahead: bool, envelope: Mapping[str, Values]) -> None:
        """Make all groups and variables in an empty h5py file, with room for so many rows.

        ahead: all room is allocated now, so that nothing but values need follow, and the counter
        of committed rows is made; else what is large is compressed, if that is asked for.
        """
        if ahead:
            _create(file, COMMITTED, (), np.dtype(np.int64), ahead=True, compress=False)
        for grid in self.grids:
            group = file.create_group(grid.name, track_order=True)
            group.attrs.update(grid.attributes)
            fixed = {f"{grid.name}/{name}": data for name, data in grid.fixed.items()}
            fixed[f"{grid.name}/load"] = np.array(self.loads, dtype=object)
            self._fill(file, grid.name, room, ahead, fixed | dict(envelope))

    def _fill(
        self, file: Any, name: str, room: int, ahead: bool, known: Mapping[str, Values]
    ) -> None:
        scales: dict[str, Any] = {}
        for path, place in self.places[name].items():
            variable = place.variable
            shape = (room, *place.tail) if path in self.rows else place.tail
            early = ahead and variable.number != "text"
            data = _create(file, path, shape, place.dtype, ahead=early, compress=self.compress)
            if path in known:
                data[...] = known[path]
            for attribute in ("units", "long_name", "comment", "positive"):
                if text := getattr(variable, attribute):
                    data.attrs[attribute] = text
            if variable.is_scale:
                data.make_scale(variable.name)
                scales[variable.name] = data
            else:
                for dimension, scale in zip(data.dims, variable.dims, strict=True):
                    dimension.attach_scale(scales[scale])


def _create(
    file: Any,
    path: str,
    shape: tuple[int, ...],
    dtype: npt.DTypeLike,
    *,
    ahead: bool,
    compress: bool,
) -> Any:
    creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    if ahead:
        creation.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
        creation.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
    # Chunks cost an index; what would fit in one is smaller without.
    large = len(shape) == 2 and shape[0] * shape[1] > _CHUNK[0] * _CHUNK[1]
    chunks = (min(_CHUNK[0], shape[0]), min(_CHUNK[1], shape[1])) if large else None
    filters = {"compression": _GZIP, "shuffle": True} if large and compress and not ahead else {}
    return file.create_dataset(path, shape, dtype, chunks=chunks, dcpl=creation, **filters)
