"""From solved lines to a static database: the grid, the quantities."""

import numpy as np

from .arrays import Array, Index
from .database.grids import LineGrid
from .line.analysis import SolvedLine
from .line.results import LineResults
from .record import Sheet
from .scene import Scene

_BETWEEN = 4  # distances of the grid in each element: what is stored is read in straight lines


def line_sheet(scene: Scene, solved: SolvedLine) -> Sheet:
    """Evaluate every quantity of a line on a grid of its elements' parts."""
    line, system = solved.line, solved.model.system
    edges = system.field.edges
    share = np.arange(_BETWEEN) / _BETWEEN
    inside = edges[:-1, None] + np.diff(edges)[:, None] * share
    distance = np.append(inside.ravel(), edges[-1])
    contact = scene.seabed_under(line)
    mudline = contact.mudline if contact is not None else _lowest(solved, distance)
    grid = LineGrid(f"L{line.id}", distance, mudline)
    values = {**line_values(solved, distance, mudline), **progress(solved)}
    steps: Index = np.arange(len(solved.states))
    if scene.steps.names:
        factors = np.array(scene.steps.factors).reshape(-1, len(scene.steps.names))
        values["load_factor"] = np.concatenate([np.zeros((1, factors.shape[1])), factors])[steps]
    return Sheet(grid, steps, {f"{grid.name}/{name}": value for name, value in values.items()})


def _lowest(solved: SolvedLine, s: Array) -> float:
    """Elevation of the lowest point as it was laid, where there is no seabed, m."""
    return float(solved.results.position(s)[0, :, -1].min())


def line_values(solved: SolvedLine, s: Array, mudline: float) -> dict[str, Array]:
    """What a database holds of a line at distances s, by the schema's names."""
    results, plane = solved.results, solved.model.plane
    place = plane.outside(results.position(s))
    along, across = _directions(results, solved, s)
    moved = place - place[0]
    reaction = plane_reaction(results, solved, s)
    touchdown = results.touchdown()
    at_touchdown = np.array(
        [plane.outside(results.position(np.array([td])))[i, 0, 0] for i, td in enumerate(touchdown)]
    )
    return {
        "lateral_displacement": np.einsum("snc,nc->sn", moved, across),
        "axial_displacement": np.einsum("snc,nc->sn", moved, along),
        "lateral_force": np.einsum("snc,nc->sn", reaction, across),
        "axial_force": np.einsum("snc,nc->sn", reaction, along),
        "penetration": mudline - place[..., 2],
        "normal_reaction": -reaction[..., 2],
        "touchdown_distance": touchdown,
        "touchdown_x": at_touchdown,
        "line/position_x": place[..., 0],
        "line/position_y": place[..., 1],
        "line/position_z": place[..., 2],
        "line/effective_tension": results.tension(s),
        "line/bending_moment": results.moment(s),
    }


def _directions(results: LineResults, solved: SolvedLine, s: Array) -> tuple[Array, Array]:
    """Unit vectors along the line as it was laid, and horizontally to its left, (n, 3)."""
    plane = solved.model.plane
    slope = results.position(s, 1)[0]
    along = np.concatenate([slope[:, :-1] @ plane.axes, slope[:, -1:]], axis=1)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    flat = np.hypot(along[:, 0], along[:, 1])
    first = np.append(plane.axes[0], 0.0)
    level = np.where(flat[:, None] > 1e-9, along / np.maximum(flat, 1e-9)[:, None], first)
    across = np.stack([-level[:, 1], level[:, 0], np.zeros(len(s))], axis=1)
    return along, across


def plane_reaction(results: LineResults, solved: SolvedLine, s: Array) -> Array:
    """What the seabed resists with at distances s, global components, (steps, n, 3), N/m."""
    plane, reaction = solved.model.plane, results.reaction(s)
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
