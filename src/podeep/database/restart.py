"""What an interrupted run goes on from: its state after the last commit, in one of two slots.

    /restart/names(name), sizes(slot, name), state(slot, value), commits

A commit writes the slot that is not in force, and `commits` advances once all of it is there; the
slot in force is `commits` modulo 2. The arrays of a slot follow each other in the order of their
names. All numbers are float64, so that nothing is rounded.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..arrays import Array
from .trust import member, reading, wrong

GROUP = "restart"

#: Arrays of any shape by their names, which stay the same for a run; read back, they are flat.
State = Mapping[str, Array]

#: Open datasets of the group by their names.
Data = Mapping[str, Any]


def size(state: State) -> int:
    """Numbers in a state."""
    return sum(map(np.size, state.values()))


def build(file: Any, state: State, room: int) -> None:
    """Make the group, with a state in force and room for so many numbers in later ones."""
    group = file.create_group(GROUP)
    group.create_dataset("names", data=list(state), dtype=h5py.string_dtype())
    shapes = {"commits": (), "sizes": (2, len(state)), "state": (2, room)}
    for name, shape in shapes.items():
        creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        creation.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
        dtype = np.float64 if name == "state" else np.int64
        group.create_dataset(name, data=np.zeros(shape, dtype), dcpl=creation)
    put(written(file), state)
    confirm(written(file))


def written(file: Any) -> Data:
    """What `put` and `confirm` write to."""
    return {name: file[f"{GROUP}/{name}"] for name in ("commits", "sizes", "state")}


def put(data: Data, state: State) -> None:
    """Write a state into the slot that is not in force."""
    slot = (int(data["commits"][()]) + 1) % 2
    values = np.concatenate([np.ravel(v).astype(np.float64) for v in state.values()])
    data["sizes"][slot] = list(map(np.size, state.values()))
    data["state"][slot, : len(values)] = values


def confirm(data: Data) -> None:
    """Let what was put be in force."""
    data["commits"][()] = int(data["commits"][()]) + 1


def load(path: Path, file: Any) -> dict[str, Array] | None:
    """The state in force, flat float64 arrays; None of a database that holds none.

    Raises UserError where the group is damaged.
    """
    if GROUP not in file:
        return None
    with reading(path):
        data = {n: member(path, file, f"{GROUP}/{n}") for n in _SHAPES}
        for name, (dimensions, kinds) in _SHAPES.items():
            one = data[name]
            if not isinstance(one, h5py.Dataset) or one.ndim != dimensions:
                raise wrong(path, f"{GROUP}/{name} is no part of a state")
            if one.dtype.kind not in kinds or one.nbytes > path.stat().st_size:
                raise wrong(path, f"{GROUP}/{name} is of type {one.dtype}, {one.nbytes} bytes")
        names = list(data["names"].asstr()[...])
        commits = int(data["commits"][()])
        if data["sizes"].shape != (2, len(names)) or data["state"].shape[0] != 2 or commits < 1:
            raise wrong(path, f"{GROUP} holds no state")
        sizes = data["sizes"][commits % 2]
        if (sizes < 0).any() or sizes.sum() > data["state"].shape[1]:
            raise wrong(path, f"{GROUP}/sizes is more than there is")
        values = np.asarray(data["state"][commits % 2, : int(sizes.sum())], dtype=np.float64)
    if not np.isfinite(values).all():
        raise wrong(path, f"{GROUP}/state holds values that are not finite")
    return dict(zip(names, np.split(values, np.cumsum(sizes)[:-1]), strict=True))


_SHAPES = {"names": (1, "O"), "sizes": (2, "i"), "state": (2, "f"), "commits": (0, "i")}
