"""Databases of a riser made up by closed forms, for the tests of what reads them.

A pipe of 160 m lies from end 1 up to its touchdown point and hangs as a catenary from there to end
2. From state to state the horizontal tension grows, the touchdown point moves towards end 1, and
the laid part is drawn out against friction of the rigid-plastic kind. Nothing moves sideways.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import builders
from podeep.arrays import Array
from podeep.database.schema import variables
from podeep.database.variable import Kind
from podeep.database.write import Grid, LineGrid, Writer
from podeep.subject import LINE

DISTANCE = np.linspace(0.0, 160.0, 81)
MUDLINE = -80.0
WEIGHT = 600.0  # N/m, submerged
STIFFNESS = 5e4  # of the seabed, Pa
FRICTION = 0.5
AXIAL, BENDING = 2e8, 1.6e7  # EA, N; EI, N m2
TENSION = 12e3  # horizontal, as it was laid, N


def grid(name: str = "L1", distance: Array = DISTANCE) -> LineGrid:
    return LineGrid(name, distance, MUDLINE)


def amplitude(kind: Kind, axis: Array) -> Array:
    """How far the line is pulled at the steps; to and fro at the times."""
    return 2.5 * (1.0 - np.cos(axis)) if kind == "dynamic" else np.asarray(axis, dtype=float)


def tension(a: Array) -> Array:
    """Horizontal tension in states of amplitude a, N."""
    return TENSION * (1.0 + 0.15 * a)


def touchdown(a: Array) -> Array:
    """Distance of the touchdown point, m."""
    return 60.0 - 4.0 * a


def riser(distance: Array, a: Array) -> dict[str, Array]:
    """What a group holds of the line in states of amplitude a, shape (states, distances)."""
    s, a = np.asarray(distance), np.asarray(a, dtype=float)[:, None]
    td, H = touchdown(a), tension(a)
    scale, hung, laid = H / WEIGHT, np.maximum(s - td, 0.0), s <= td
    height = np.hypot(scale, hung) - scale
    drawn = (H - TENSION) / (FRICTION * WEIGHT)  # length that slips
    slipped = np.clip(s - td + drawn, 0.0, drawn)  # so much of it lies before each point
    across = np.zeros(height.shape)
    return {
        "lateral_displacement": across,
        "lateral_force": across,
        "axial_displacement": FRICTION * WEIGHT * slipped**2 / (2.0 * AXIAL),
        "axial_force": np.where(laid & (slipped > 0.0), FRICTION * WEIGHT, 0.0),
        "penetration": WEIGHT / STIFFNESS - height,
        "normal_reaction": np.where(laid, WEIGHT, 0.0),
        "touchdown_distance": td[:, 0],
        "touchdown_x": td[:, 0],
        "line/position_x": np.minimum(s, td) + scale * np.arcsinh(hung / scale),
        "line/position_y": across,
        "line/position_z": MUDLINE - WEIGHT / STIFFNESS + height,
        "line/effective_tension": TENSION + FRICTION * WEIGHT * slipped + WEIGHT * height,
        "line/bending_moment": np.where(laid, 0.0, BENDING * scale / (scale**2 + hung**2)),
    }


def row_values(
    kind: Kind, grids: Sequence[Grid | LineGrid], axis: Array, loads: Sequence[str] = ()
) -> dict[str, Array]:
    """Everything that `Writer.append` wants of foundations and lines for these steps or times."""
    a = amplitude(kind, axis)
    values = builders.row_values(kind, [g for g in grids if isinstance(g, Grid)], axis, loads)
    for on in grids:
        if isinstance(on, LineGrid):
            own = riser(on.distance, a)
            if loads:
                own["load_factor"] = np.multiply.outer(a, np.arange(1, len(loads) + 1))
            for v in variables(kind, spatial=False, loads=bool(loads), subject=LINE):
                if v.group in ("estimate", "convergence"):
                    own[f"{v.group}/{v.name}"] = np.full(len(axis), 1)
            values |= {f"{on.name}/{name}": value for name, value in own.items()}
    return values


def static_database(
    path: Path,
    *,
    steps: int = 5,
    lines: Sequence[str] = ("L1",),
    foundations: Sequence[str] = (),
    loads: Sequence[str] = ("PULL",),
    title: str = "riser pulled at its top",
) -> Path:
    """A .dss of steps 0 to `steps`; step 0 is the end of laying."""
    axis = np.arange(steps + 1)
    grids = [*map(builders.grid, foundations), *map(grid, lines)]
    with Writer(
        path, kind="static", title=title, deck_text=builders.DECK, grids=grids, loads=loads
    ) as writer:
        writer.append(axis, row_values("static", grids, axis, loads))
        writer.finish("complete")
    return path


def dynamic_database(
    path: Path, *, times: Array, lines: Sequence[str] = ("L1",), block: int = 1024
) -> Path:
    """A .dst over the given times."""
    grids = list(map(grid, lines))
    with Writer(
        path,
        kind="dynamic",
        title="riser in waves",
        deck_text=builders.DECK,
        grids=grids,
        loads=(),
        dtype=np.float64,
        block=block,
    ) as writer:
        for part in np.split(times, range(block, len(times), block)):
            writer.append(part, row_values("dynamic", grids, part))
        writer.finish("complete")
    return path
