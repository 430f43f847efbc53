"""What the solver tells in words: the scene as it was understood, and what came of it."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .arrays import Array
from .scene import Curve, Foundation, Ground, Scene, Section
from .soil.curves import CurveTable
from .soil.reaction import Term
from .solve.analysis import Solved
from .units import short


def scene_report(scene: Scene, notes: tuple[str, ...]) -> str:
    """The whole scene in SI and in words, one fact a line."""
    lines = [scene.title or "(no title)", ""]
    for foundation in scene.foundations:
        lines += foundation_lines(scene, foundation)
    lines += ["", "soil"]
    lines += [f"  {line}" for line in ground_lines(scene.ground)]
    lines += ["", "held and loaded"]
    lines += [f"  {line}" for line in action_lines(scene)]
    lines += ["", "steps"]
    lines += [f"  {line}" for line in step_lines(scene)]
    numerics = scene.numerics
    lines += ["", "numerics", f"  requested accuracy {numerics.accuracy:g}"]
    if numerics.elements is not None:
        lines.append(f"  {numerics.elements} elements, as asked: no refinement")
    if numerics.degree is not None:
        lines.append(f"  deflection of degree {numerics.degree} in an element, as asked")
    if notes:
        lines += ["", "assumed", *(f"  {note}" for note in notes)]
    return "\n".join(lines)


def foundation_lines(scene: Scene, foundation: Foundation) -> Iterator[str]:
    """A foundation and the sections of its tubes."""
    yield f"foundation {foundation.name}: mudline at {short(foundation.mudline)} m"
    for id_ in foundation.tubes:
        tube = scene.tubes[id_]
        embedded = foundation.mudline - tube.tip
        yield (
            f"  tube {tube.id} {tube.name}".rstrip()
            + f": {short(tube.top)} to {short(tube.tip)} m, {short(embedded)} m embedded"
        )
        for section in tube.sections:
            yield f"    {section_line(section)}"


def section_line(section: Section) -> str:
    """Geometry and stiffness of a section."""
    return (
        f"{short(section.top)} to {short(section.bottom)} m: "
        f"OD {short(section.outer_diameter)} m, WT {short(section.wall_thickness)} m, "
        f"EI {short(section.bending_stiffness)} N m2, EA {short(section.axial_stiffness)} N"
    )


def ground_lines(ground: Ground) -> Iterator[str]:
    """Depths with their curves, then the curves."""
    for depth, lateral, axial in zip(ground.depths, ground.lateral, ground.axial, strict=True):
        names = [f"{kind} {id_ or 'none'}" for kind, id_ in (("p-y", lateral), ("t-z", axial))]
        yield f"{short(depth)} m below the mudline: {', '.join(names)}"
    between = "parameters" if ground.interpolation == "PARAMETERS" else "loads"
    yield f"between depths {between} vary linearly; below the last one its curve goes on"
    for kind, curves in (("p-y", ground.lateral_curves), ("t-z", ground.axial_curves)):
        for curve in curves.values():
            yield f"{kind} {curve.id}: {curve_line(curve)}"


def curve_line(curve: Curve) -> str:
    """A curve's law, parameters, options and rows."""
    given: dict[str, Any] = {**curve.parameters, **curve.options}
    parts = [
        f"{name} {short(value) if isinstance(value, float) else value}"
        for name, value in given.items()
    ]
    if curve.rows:
        unit = "diameters" if curve.rows_in_diameters else "m"
        parts.append(f"{len(curve.rows)} rows, displacement in {unit}")
    return ", ".join([curve.law.replace("_", " "), *parts])


def action_lines(scene: Scene) -> Iterator[str]:
    """Supports, springs, loads and imposed displacements."""
    for support in scene.supports:
        held = " ".join(support.dofs)
        yield f"tube {support.tube} at {short(support.elevation)} m: {held} held"
    for spring in scene.springs:
        unit = "N m/rad" if spring.dof.startswith("R") else "N/m"
        yield (
            f"tube {spring.tube} at {short(spring.elevation)} m: spring {spring.dof} "
            f"{short(spring.stiffness)} {unit}"
        )
    for load in scene.loads:
        parts = [
            f"{name} {short(value)} {unit}"
            for name, value, unit in zip(
                ("FX", "FY", "FZ", "MX", "MY", "MZ"),
                (*load.force, *load.moment),
                ("N", "N", "N", "N m", "N m", "N m"),
                strict=True,
            )
            if value
        ]
        where = f"tube {load.tube} at {short(load.elevation)} m"
        yield f"load {load.name} on {where}: {', '.join(parts) or 'nothing'}"
    for d in scene.displacements:
        unit = "rad" if d.dof.startswith("R") else "m"
        yield (
            f"displacement {d.name} of tube {d.tube} at {short(d.elevation)} m: "
            f"{d.dof} {short(d.value)} {unit}"
        )
    if any(load.moment[2] for load in scene.loads):
        yield "torsion is held: the soil gives no resistance to it, MZ has no effect on the results"


def step_lines(scene: Scene) -> Iterator[str]:
    """How many steps, and the factors where they are few."""
    yield f"{len(scene.steps.factors)} quasi-static steps of {', '.join(scene.steps.names)}"
    if len(scene.steps.factors) <= 10:
        for number, factors in enumerate(scene.steps.factors, start=1):
            yield f"step {number}: {', '.join(short(f) for f in factors)}"


def summary(solved: Solved) -> dict[str, Any]:
    """The result of one foundation as numbers: heads, largest values, errors, work."""
    results, model = solved.results, solved.model
    x = np.sort(np.concatenate([model.edges, model.lateral.system.points[0].x]))
    head = x[:1]
    moment = largest(results.shear_and_moment(x)[1][-1])
    place = int(np.argmax(moment))
    last = [(e.displacement[-1], e.reaction[-1], e.moment[-1]) for e in solved.estimates]
    displacements, reactions, moments = np.array(last).T.tolist()
    return {
        "foundation": model.foundation.name,
        "decisions": [str(d) for d in model.needs.decisions],
        "elements": model.elements,
        "degree": model.lateral.system.field.degree,
        "steps": solved.states[-1].step,
        "iterations": sum(s.iterations for s in solved.states),
        "head_lateral_displacement_m": float(largest(results.deflection(head)[-1])[0]),
        "head_axial_displacement_m": float(results.settlement(head)[-1, 0]),
        "largest_moment_Nm": float(moment[place]),
        "largest_moment_depth_m": float(x[place]),
        "estimated_error_displacement": max(displacements),
        "estimated_error_reaction": max(reactions),
        "estimated_error_moment": max(moments),
        "largest_estimated_error": max(float(e.worst.max()) for e in solved.estimates),
    }


def largest(components: Array) -> Array:
    """Magnitude of a lateral vector given by component, shape (components, n)."""
    return np.asarray(np.linalg.norm(components, axis=0))


def run_report(numbers: dict[str, Any]) -> str:
    """The summary of a foundation in words."""
    n = numbers
    return "\n".join(
        [
            f"{n['foundation']}  {'; '.join(n['decisions'])}",
            f"    {n['elements']} elements of degree {n['degree']}, {n['steps']} steps, "
            f"{n['iterations']} iterations",
            f"    last step: head displaced {short(n['head_lateral_displacement_m'])} m, "
            f"settled {short(n['head_axial_displacement_m'])} m",
            f"    largest moment {short(n['largest_moment_Nm'])} N m at "
            f"{n['largest_moment_depth_m']:.2f} m below the mudline",
            f"    estimated errors: displacement {n['estimated_error_displacement']:.1e}, "
            f"reaction {n['estimated_error_reaction']:.1e}, "
            f"moment {n['estimated_error_moment']:.1e}; "
            f"largest in any step {n['largest_estimated_error']:.1e}",
        ]
    )


def step_table(solved: Solved) -> str:
    """A line for each step: factors, work and what was reached."""
    lines = [
        f"    {'step':>5} {'iterations':>10} {'residual':>9} {'smallest part':>13} {'error':>8}"
    ]
    worst = np.maximum(*(e.worst for e in solved.estimates))
    for state, error in zip(solved.states, worst, strict=True):
        lines.append(
            f"    {state.step:>5} {state.iterations:>10} {state.residual:>9.1e} "
            f"{state.step_size:>13.4g} {error:>8.1e}"
        )
    return "\n".join(lines)


def curves_report(tables: Sequence[CurveTable], depth: float) -> str:
    """Curves at a depth as a table, each with its laws and the parameters in force."""
    lines = [f"depth {short(depth)} m below the mudline"]
    for table in tables:
        unit = "N" if table.name == "qz" else "N/m"
        lines += ["", f"{table.name}: capacity {short(float(table.source.capacity[0]))} {unit}"]
        lines += [f"  {line}" for term in table.source.laws for line in term_lines(term)]
        lines.append(f"{'displacement (m)':>18} {f'reaction ({unit})':>18}")
        for u, force in zip(table.displacement, table.reaction, strict=True):
            lines.append(f"{u:>18.6g} {force:>18.6g}")
    if not tables:
        lines.append("no reaction at this depth")
    return "\n".join(lines)


def term_lines(term: Term) -> Iterator[str]:
    """A law in force at one point: its name, the curves it comes from, its parameters."""
    ids = " and ".join(str(i) for i in term.curves)
    share = "" if term.weight is None else f", share {float(term.weight[0]):.4g}"
    yield f"{term.name.replace('_', ' ')} of curve {ids}{share}"
    for name, value in term.parameters.items():
        if value is None or name == "points":
            continue
        shown = value if isinstance(value, str | bool) else short(float(np.ravel(value)[0]))
        yield f"  {name} {shown}"
