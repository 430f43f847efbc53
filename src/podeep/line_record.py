"""From solved lines to a static database: the grid, the quantities."""

import numpy as np

from .arrays import Array, Index
from .database.grids import LineGrid
from .line.analysis import SolvedLine
from .line.assemble import Plane
from .line.results import LineResults
from .record import Sheet
from .scene import Scene
from .subject import LINE

_BETWEEN = 4  # distances of the grid in each element: what is stored is read in straight lines


def line_sheet(scene: Scene, solved: SolvedLine) -> Sheet:
    """Evaluate every quantity of a line on a grid of its elements' parts."""
    grid = line_grid(scene, solved)
    results, plane = solved.results, solved.model.plane
    values = {**line_values(results, results, plane, grid), **progress(solved)}
    steps: Index = np.arange(len(solved.states))
    if scene.steps.names:
        factors = np.array(scene.steps.factors).reshape(-1, len(scene.steps.names))
        values["load_factor"] = np.concatenate([np.zeros((1, factors.shape[1])), factors])[steps]
    return Sheet(grid, steps, {f"{grid.name}/{name}": value for name, value in values.items()})


def line_grid(scene: Scene, solved: SolvedLine) -> LineGrid:
    """Where values of a line stand: distances at parts of its elements."""
    edges = solved.model.system.field.edges
    share = np.arange(_BETWEEN) / _BETWEEN
    inside = edges[:-1, None] + np.diff(edges)[:, None] * share
    distance = np.append(inside.ravel(), edges[-1])
    contact = scene.seabed_under(solved.line)
    mudline = contact.mudline if contact is not None else _lowest(solved, distance)
    return LineGrid(f"L{solved.line.id}", distance, mudline)


def _lowest(solved: SolvedLine, s: Array) -> float:
    """Elevation of the lowest point as it was laid, where there is no seabed, m."""
    return float(solved.results.position(s)[0, :, -1].min())


def line_values(
    results: LineResults, laid: LineResults, plane: Plane, grid: LineGrid
) -> dict[str, Array]:
    """What a database holds of a line in some states, by the schema's names.

    laid: results whose first state is that of the line as it was laid.
    """
    s, touchdown = grid.distance, results.touchdown()
    place = plane.outside(results.position(s))
    values = shown(results, laid, plane, grid)
    return {
        **{LINE.stored(name): value for name, value in values.items()},
        "touchdown_distance": touchdown,
        "touchdown_x": np.array(
            [np.interp(at, s, x) for at, x in zip(touchdown, place[..., 0], strict=True)]
        ),
        "line/position_x": place[..., 0],
        "line/position_y": place[..., 1],
        "line/position_z": place[..., 2],
    }


def shown(
    results: LineResults, laid: LineResults, plane: Plane, grid: LineGrid
) -> dict[str, Array]:
    """What is shown of a line, by the names of `subject.LINE`; see `line_values`."""
    s = grid.distance
    place = plane.outside(results.position(s))
    along, across = _directions(laid, plane, s)
    moved = place - plane.outside(laid.position(s)[0])
    reaction = plane_reaction(results, plane, s)
    return {
        "lateral_displacement": np.einsum("snc,nc->sn", moved, across),
        "axial_displacement": np.einsum("snc,nc->sn", moved, along),
        "lateral_force": np.einsum("snc,nc->sn", reaction, across),
        "axial_force": np.einsum("snc,nc->sn", reaction, along),
        "penetration": grid.mudline - place[..., 2],
        "normal_reaction": -reaction[..., 2],
        "effective_tension": results.tension(s),
        "bending_moment": results.moment(s),
    }


def _directions(laid: LineResults, plane: Plane, s: Array) -> tuple[Array, Array]:
    """Unit vectors along the line as it was laid, and horizontally to its left, (n, 3)."""
    slope = laid.position(s, 1)[0]
    along = np.concatenate([slope[:, :-1] @ plane.axes, slope[:, -1:]], axis=1)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    flat = np.hypot(along[:, 0], along[:, 1])
    first = np.append(plane.axes[0], 0.0)
    level = np.where(flat[:, None] > 1e-9, along / np.maximum(flat, 1e-9)[:, None], first)
    across = np.stack([-level[:, 1], level[:, 0], np.zeros(len(s))], axis=1)
    return along, across


def plane_reaction(results: LineResults, plane: Plane, s: Array) -> Array:
    """What the seabed resists with at distances s, global components, (steps, n, 3), N/m."""
    reaction = results.reaction(s)
    flat = reaction[..., :-1] @ plane.axes
    return np.concatenate([flat, reaction[..., -1:]], axis=-1)


def progress(solved: SolvedLine) -> dict[str, Array]:
    """Estimated errors and what the iteration took, per step."""
    states, count = solved.states, len(solved.states)
    position, reaction, tension, moment = solved.errors
    return {
        "estimate/displacement": np.full(count, position),
        "estimate/reaction": np.full(count, reaction),
        "estimate/moment": np.full(count, max(moment, tension)),
        "convergence/iterations": np.array([s.work.iterations for s in states], dtype=float),
        "convergence/residual": np.array([s.residual for s in states]),
        "convergence/step_size": np.array([1.0 / max(s.parts, 1) for s in states]),
        "convergence/energy": np.array([s.energy for s in states]),
    }
