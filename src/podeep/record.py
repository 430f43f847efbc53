"""From solved foundations to a static database: the grid, the quantities, the writing."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Array, Index
from .database.write import Grid, LineGrid
from .model.grid import output_depths, tube_depths
from .model.results import Results
from .scene import Scene, Section
from .solve.analysis import Solved

_COMPONENTS = ("x", "y")


@dataclass(frozen=True)
class Sheet:
    """A foundation or line ready to be written: its grid and all values by the schema's names."""

    grid: Grid | LineGrid
    steps: Array | Index
    values: dict[str, Array]


@dataclass(frozen=True)
class Places:
    """Where a foundation's values stand: the grid, and the depths of each tube's results, m."""

    grid: Grid
    tubes: dict[int, Array]


def places(scene: Scene, results: Results, accuracy: float) -> Places:
    """Depths that are close enough for the results to be read between them to an accuracy."""
    model = results.model
    foundation = model.foundation
    depth = output_depths(results, accuracy)
    marks = foundation.mudline - np.array(scene.marks(foundation))
    numbers = dict(enumerate(foundation.tubes))
    x = {igr: tube_depths(results, depth, marks, i) for i, igr in numbers.items()}
    grid = Grid(
        name=foundation.name,
        depth=depth,
        tube=np.array(foundation.tubes)[results.outermost(depth)],
        layer=model.profile.layer(depth),
        layer_boundaries=np.array([b for b in model.profile.boundaries if b < depth[-1]]),
        mudline=foundation.mudline,
        lateral_axis=model.needs.lateral_axis,
        tubes={igr: foundation.mudline - at for igr, at in x.items()},
    )
    return Places(grid, x)


def sheet(scene: Scene, solved: Solved) -> Sheet:
    """Evaluate every quantity of a foundation on a grid that is fine enough for the accuracy."""
    results = solved.results
    at = places(scene, results, scene.numerics.accuracy)
    values = {**all_values(results, at), **progress_values(solved)}
    if scene.steps.names:
        values["load_factor"] = np.array([s.factors for s in solved.states])
    named = {f"{at.grid.name}/{name}": value for name, value in values.items()}
    return Sheet(at.grid, np.array([s.step for s in solved.states]), named)


def all_values(results: Results, at: Places) -> dict[str, Array]:
    """What a database holds of the soil and of each tube, by the schema's names."""
    found = soil_values(results, at.grid.depth, at.grid.lateral_axis)
    for i, (igr, x) in enumerate(at.tubes.items()):
        for name, value in tube_values(results, x, i).items():
            found[f"tubes/{igr}/{name}"] = value
    return found


def soil_values(results: Results, depth: Array, axis: float | None) -> dict[str, Array]:
    """Displacements and reactions of the outermost tube over depth, as the schema names them."""
    lateral = {
        "lateral_displacement": results.deflection(depth),
        "lateral_slope": results.deflection(depth, 1),
        "lateral_force": results.lateral_reaction(depth),
    }
    values: dict[str, Array] = {}
    for name, components in lateral.items():
        parts = results.global_vector(components)
        if axis is None:
            values[name] = np.hypot(*parts)
            values |= {f"{name}_{c}": part for c, part in zip(_COMPONENTS, parts, strict=True)}
        else:
            cosine, sine = np.cos(np.radians(axis)), np.sin(np.radians(axis))
            values[name] = parts[0] * cosine + parts[1] * sine
    settlement, force = results.tip()
    return values | {
        "axial_displacement": results.settlement(depth),
        "axial_strain": results.settlement(depth, 1),
        "axial_force": results.axial_reaction(depth),
        "tip_displacement": settlement,
        "tip_force": force,
    }


def tube_values(results: Results, x: Array, tube: int) -> dict[str, Array]:
    """Motion and internal forces of a tube, by its number, at depths x, in global axes, z up."""
    shear, moment = results.shear_and_moment(x, tube)
    displacement = results.global_vector(results.deflection(x, 0, tube))
    turned = results.global_vector(results.rotation(x, tube))
    shears, moments = results.global_vector(shear), results.global_vector(moment)
    force = results.compression(x, tube)
    return {
        "displacement_x": displacement[0],
        "displacement_y": displacement[1],
        "displacement_z": -results.settlement(x, 0, tube),
        "rotation_x": turned[1],
        "rotation_y": -turned[0],
        "moment_x": -moments[1],
        "moment_y": moments[0],
        "shear_x": shears[0],
        "shear_y": shears[1],
        "normal_force": force,
        "stress": stress(results.sections(x, tube), force, np.hypot(*moments)),
    }


def stress(sections: Sequence[Section], force: Array, moment: Array) -> Array:
    """Largest normal stress over each section, Pa: E (N / EA + M D / 2 EI), all magnitudes.

    force, moment: of each section, shape (..., sections). Strains times E, so that it holds for
    sections whose stiffness was given.
    """
    modulus = np.array([s.youngs_modulus for s in sections])
    stretch = np.array([s.axial_stiffness for s in sections])
    bend = np.array([2.0 * s.bending_stiffness / s.outer_diameter for s in sections])
    return np.asarray(modulus * (np.abs(force) / stretch + moment / bend))


def progress_values(solved: Solved) -> dict[str, Array]:
    """Estimated errors and what the iteration took, per step."""
    errors = np.max([(e.displacement, e.reaction, e.moment) for e in solved.estimates], axis=0)
    states = solved.states
    return {
        "estimate/displacement": errors[0],
        "estimate/reaction": errors[1],
        "estimate/moment": errors[2],
        "convergence/iterations": np.array([s.iterations for s in states]),
        "convergence/residual": np.array([s.residual for s in states]),
        "convergence/step_size": np.array([s.step_size for s in states]),
        "convergence/energy": np.array([s.energy for s in states]),
    }
