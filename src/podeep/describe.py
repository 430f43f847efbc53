"""A scene in words: what the solver understood, in SI, with what was left to a default."""

from collections.abc import Iterator, Sequence
from textwrap import wrap
from typing import Any

from .describe_lines import line_lines, seabed_lines
from .describe_motion import motion_lines, soil_motion_lines
from .scene import (
    CoupledSpring,
    Curve,
    Displacement,
    Foundation,
    Ground,
    Load,
    Mass,
    Newton,
    Numerics,
    Scene,
    Section,
    Spring,
    Spudcan,
    Support,
)
from .units import parameter, short


def scene_report(scene: Scene, notes: tuple[str, ...]) -> str:
    """The whole scene in SI and in words, one fact a line."""
    lines = [scene.title or "(no title)"]
    for number, foundation in enumerate(scene.foundations):
        lines += [*([] if number else [""]), *foundation_lines(scene, foundation)]
    if scene.ties or scene.slidings:
        lines += ["", "tubes in tubes", *(f"  {line}" for line in tie_lines(scene))]
    if scene.lines:
        lines += ["", "lines", *(f"  {line}" for line in line_lines(scene))]
    if scene.foundations:
        lines += ["", "soil", *(f"  {line}" for line in ground_lines(scene.ground))]
    if seabed := list(seabed_lines(scene)):
        lines += ["", "seabed", *(f"  {line}" for line in seabed)]
    if scene.foundations:
        lines += ["", "held and loaded", *(f"  {line}" for line in action_lines(scene))]
    lines += ["", "steps"]
    lines += [f"  {line}" for line in step_lines(scene)]
    if moving := list(motion_lines(scene)):
        lines += ["", "motion", *(f"  {line}" for line in moving)]
    lines += ["", "numerics"]
    lines += [f"  {line}" for line in numerics_lines(scene)]
    if notes:
        lines += ["", "assumed", *(f"  {note}" for note in notes)]
    return _folded(lines)


def risk_report(risks: Sequence[str]) -> str:
    """What is legal but risky, as the last section of the report on a scene; empty for nothing."""
    return _folded(["", "risky", *(f"  {risk}" for risk in risks)]) if risks else ""


def _folded(lines: Sequence[str]) -> str:
    folded = (wrap(line, 80, subsequent_indent=_indent(line)) or [""] for line in lines)
    return "\n".join(part for parts in folded for part in parts)


def _indent(line: str) -> str:
    return " " * (len(line) - len(line.lstrip()) + 4)


def numerics_lines(scene: Scene) -> Iterator[str]:
    """Accuracy, mesh and iteration limits."""
    numerics, newton = scene.numerics, scene.newton
    accuracy = f"requested accuracy {numerics.accuracy:g}"
    yield marked(accuracy, numerics.accuracy, Numerics().accuracy)
    if numerics.elements is None:
        yield "elements as the accuracy needs them (default)"
    else:
        yield f"{numerics.elements} elements, no refinement"
    if numerics.degree is not None:
        yield f"deflection of degree {numerics.degree} in an element"
    if not numerics.axial_curves:
        yield "t-z and Q-z curves are left out (TZ=OFF): supports alone carry the tubes along z"
    if numerics.second_order:
        yield "the normal force bends the tubes further (PDELTA)"
    if numerics.shear:
        yield "tubes are soft in shear (SHEAR=ON)"
    if numerics.weight:
        yield "tubes have their own weight (WEIGHT=ON)"
    if numerics.hysteresis != "ELASTIC":
        yield f"the soil remembers its motion (HYSTERESIS={numerics.hysteresis})"
    limits = (
        f"at most {newton.iterations} iterations, forces balanced to {newton.force:g} or better"
    )
    yield marked(limits, newton, Newton())


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


def tie_lines(scene: Scene) -> Iterator[str]:
    """How tubes that stand in each other hold each other."""
    for tie in scene.ties:
        how = "at the two ends" if tie.ends else "all along"
        yield (
            f"tube {tie.inner} tied to tube {tie.outer} {how}, "
            f"{short(tie.top)} to {short(tie.bottom)} m"
        )
    for one in scene.slidings:
        room = "what the diameters leave" if one.clearance is None else f"{short(one.clearance)} m"
        hard = "rigid" if one.stiffness is None else f"{short(one.stiffness)} N/m2"
        yield (
            f"tube {one.inner} slides in tube {one.outer} where nothing ties it: room {room}, "
            f"contact {hard}, friction {short(one.friction)}"
        )


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
    friction = f"slope of friction {short(ground.friction_stiffness)} Pa/m"
    yield marked(friction, ground.friction_stiffness, 1e8)
    between = "parameters" if ground.interpolation == "PARAMETERS" else "loads"
    yield f"between depths {between} vary linearly; below the last one its curve goes on"
    if ground.layering == "GEORGIADIS":
        own = ground.layering_overburden == "OWN"
        whose = "the overburden of the layer's own soil" if own else "the actual overburden"
        yield f"layers by equivalent depth (Georgiadis), with {whose}"
    for kind, curves in (("p-y", ground.lateral_curves), ("t-z", ground.axial_curves)):
        for curve in curves.values():
            yield f"{kind} {curve.id}: {curve_line(curve)}"
    yield from soil_motion_lines(ground)


def curve_line(curve: Curve) -> str:
    """A curve's law, parameters, options and rows."""
    given: dict[str, Any] = {**curve.parameters, **curve.options}
    parts = [parameter(name, value) for name, value in given.items()]
    if curve.rows:
        unit = "diameters" if curve.rows_in_diameters else "m"
        parts.append(f"{len(curve.rows)} rows, displacement in {unit}")
    return ", ".join([curve.law.replace("_", " "), *parts])


def marked(text: str, given: object, default: object) -> str:
    """A statement that says so where the deck left it to the default."""
    return f"{text} (default)" if given == default else text


def action_lines(scene: Scene) -> Iterator[str]:
    """Supports, springs, masses, loads and imposed displacements."""
    for support in scene.supports:
        yield f"{_place(support)}: {' '.join(support.dofs)} held"
    for spring in scene.springs:
        unit = "N m/rad" if spring.dof.startswith("R") else "N/m"
        yield f"{_place(spring)}: spring {spring.dof} {short(spring.stiffness)} {unit}"
    for both in scene.coupled_springs:
        yield (
            f"{_place(both)}: spring of deflection and slope, {short(both.lateral)} N/m, "
            f"{short(both.coupling)} N/rad, {short(both.rotational)} N m/rad"
        )
    for spudcan in scene.spudcans:
        yield spudcan_line(spudcan)
    for mass in scene.masses:
        yield f"{_place(mass)}: {_mass(mass, scene.tubes[mass.tube].top)}"
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
        yield f"load {load.name} on {_place(load)}: {', '.join(parts) or 'nothing'}"
    for d in scene.displacements:
        unit = "rad" if d.dof.startswith("R") else "m"
        yield f"displacement {d.name} of {_place(d)}: {d.dof} {short(d.value)} {unit}"
    if any(load.moment[2] for load in scene.loads):
        yield "torsion is held: the soil gives no resistance to it, MZ has no effect on the results"


def spudcan_line(spudcan: Spudcan) -> str:
    """A spudcan, its soil as far as it is known, its factors and its preload."""
    factors = (spudcan.vertical_factor, spudcan.horizontal_factor, spudcan.rotational_factor)
    held = "elastic"
    if spudcan.preload is not None:
        held = f"preload {short(spudcan.preload)} N in {(spudcan.soil or '').lower()}"
    return (
        f"tube {spudcan.tube}: spudcan of {short(spudcan.diameter)} m, embedded "
        f"{short(spudcan.embedment)} m, G {short(spudcan.shear_modulus)} Pa, nu "
        f"{short(spudcan.poisson_ratio)}, KD {' '.join(map(short, factors))}, {held}"
    )


def _mass(mass: Mass, top: float) -> str:
    """A mass, its moments of inertia where it has any, and the arm that it stands on."""
    parts = [f"mass {short(mass.mass)} kg"]
    parts += [
        f"J{axis}{axis} {short(inertia)} kg m2"
        for axis, inertia in zip("XYZ", mass.inertia, strict=True)
        if inertia
    ]
    if mass.elevation > top:
        parts.append(f"on a rigid arm of {short(mass.elevation - top)} m")
    return ", ".join(parts)


def _place(item: Support | Spring | CoupledSpring | Mass | Load | Displacement) -> str:
    return f"tube {item.tube} at {short(item.elevation)} m"


def step_lines(scene: Scene) -> Iterator[str]:
    """How many steps, and the factors where they are few."""
    if not scene.steps.names and scene.lines:
        yield "no loads and no displacements"
        return
    yield f"{len(scene.steps.factors)} quasi-static steps of {', '.join(scene.steps.names)}"
    if len(scene.steps.factors) <= 10:
        for number, factors in enumerate(scene.steps.factors, start=1):
            yield f"step {number}: {', '.join(short(f) for f in factors)}"
