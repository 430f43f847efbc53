"""Small soil databases with known fields, for the tests of what reads them.

Every quantity is the product of an amplitude a (the step; sin(t) of a dynamic database), the
number of the foundation (1 for the first), and a shape over the depth z of `SHAPES`. In a spatial
database the lateral vector points along (0.6, 0.8), so that the magnitude is as in a planar one
where a is not negative.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from podeep.arrays import Array
from podeep.database.schema import Status, variables
from podeep.database.variable import Kind
from podeep.database.write import Grid, Writer

DEPTH = np.array([0.0, 1.0, 2.5, 5.0, 5.000001, 7.5, 10.0, 15.0, 20.0, 30.0])  # jump at 5 m
MUDLINE = -100.0
TUBE = 7  # the outermost
ELEVATION = np.array([-90.0, -95.0, -100.0, -110.0, -130.0])
TUBES = {TUBE: ELEVATION, 12: np.array([-80.0, -120.0])}
DECK = "*TITLE\nsynthetic databäse\n"

# quantity: value at the mudline for a = 1, depth in which it falls to 1/e
SHAPES = {
    "lateral_displacement": (0.01, 10.0),
    "lateral_slope": (-0.001, 10.0),
    "lateral_force": (1e5, 10.0),
    "axial_displacement": (0.002, 40.0),
    "axial_strain": (-5e-5, 40.0),
    "axial_force": (2e4, 40.0),
}
DIRECTION = {"x": 0.6, "y": 0.8}


def field(quantity: str, amplitude: float | Array, depth: float | Array, number: int = 1) -> Array:
    """A quantity of foundation `number`: shape (rows, depths) for arrays of both."""
    size, fall = SHAPES[quantity]
    return number * size * np.multiply.outer(amplitude, np.exp(-np.asarray(depth) / fall))


def static_database(
    path: Path,
    *,
    steps: int = 3,
    depth: Array = DEPTH,
    spatial: bool = False,
    foundations: Sequence[str] = ("F1",),
    loads: Sequence[str] = ("H", "V"),
    title: str = "static case",
    status: Status = "complete",
    stop_reason: str = "",
    force: bool = False,
) -> Path:
    """A .dss with steps 0 to `steps`."""
    axis = np.arange(steps + 1)
    grids = [grid(name, depth, spatial=spatial) for name in foundations]
    with Writer(
        path, kind="static", title=title, deck_text=DECK, grids=grids, loads=loads, force=force
    ) as writer:
        writer.append(axis, row_values("static", grids, axis, loads))
        writer.finish(status, stop_reason)
    return path


def dynamic_database(
    path: Path,
    *,
    times: Array | None = None,
    depth: Array = DEPTH,
    spatial: bool = False,
    foundations: Sequence[str] = ("F1",),
    title: str = "dynamic case",
    dtype: type = np.float32,
    compress: bool = False,
    block: int = 1024,
    force: bool = False,
) -> Path:
    """A .dst over the given times, 0 to 10 s by 0.1 s unless given."""
    axis = np.linspace(0.0, 10.0, 101) if times is None else np.asarray(times, dtype=float)
    grids = [grid(name, depth, spatial=spatial) for name in foundations]
    with Writer(
        path,
        kind="dynamic",
        title=title,
        deck_text=DECK,
        grids=grids,
        loads=(),
        force=force,
        dtype=dtype,
        compress=compress,
        block=block,
    ) as writer:
        for part in np.split(axis, range(block, len(axis), block)):
            writer.append(part, row_values("dynamic", grids, part))
        writer.finish("complete")
    return path


def grid(name: str, depth: Array = DEPTH, *, spatial: bool = False) -> Grid:
    return Grid(
        name=name,
        depth=depth,
        tube=np.full(len(depth), TUBE),
        layer=(depth > 5.0).astype(int),
        layer_boundaries=np.array([5.0]),
        mudline=MUDLINE,
        lateral_axis=None if spatial else 0.0,
        tubes=TUBES,
    )


def amplitude(kind: Kind, axis: Array) -> Array:
    """The factor of all fields at the steps or times."""
    return np.sin(axis) if kind == "dynamic" else np.asarray(axis, dtype=float)


def row_values(
    kind: Kind, grids: Sequence[Grid], axis: Array, loads: Sequence[str] = ()
) -> dict[str, Array]:
    """Everything that `Writer.append` wants for these steps or times."""
    a = amplitude(kind, axis)
    rows = len(axis)
    values: dict[str, Array] = {}
    for number, on in enumerate(grids, start=1):
        spatial = on.lateral_axis is None
        own = {name: field(name, a, on.depth, number) for name in SHAPES}
        if spatial:
            for name in [n for n in own if n.startswith("lateral")]:
                own |= {f"{name}_{c}": share * own[name] for c, share in DIRECTION.items()}
                own[name] = np.abs(own[name])
        own["tip_displacement"] = own["axial_displacement"][:, -1]
        own["tip_force"] = 1e6 * own["tip_displacement"]
        if loads:
            own["load_factor"] = np.multiply.outer(a, np.arange(1, len(loads) + 1))
        for index, variable in enumerate(variables(kind, spatial=spatial, loads=bool(loads))):
            if variable.group == "tubes" and not variable.is_scale:
                for igr, elevation in on.tubes.items():
                    key = f"tubes/{igr}/{variable.name}"
                    own[key] = number * index * np.multiply.outer(a, elevation)
            elif variable.group in ("estimate", "convergence"):
                own[f"{variable.group}/{variable.name}"] = np.full(rows, number)
        values |= {f"{on.name}/{name}": value for name, value in own.items()}
    return values
