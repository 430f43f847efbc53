"""Lines and the seabed under them, in words."""

from collections.abc import Iterator
from math import degrees

from .errors import InvalidData
from .scene import Line, LineEnd, LineMotion, LineSection, Scene, Sea, SeabedContact, Suction
from .seabed.at_rest import penetration_at_rest
from .seabed.models import MODELS
from .seabed.stiffness import pipe_stiffness
from .units import parameter, short


def line_lines(scene: Scene) -> Iterator[str]:
    """Lines with their ends, sections and motions."""
    for line in scene.lines.values():
        ends = " to ".join(_point(end.position) for end in line.ends)
        yield f"line {line.id} {line.name}".rstrip() + f": {short(line.length)} m, from {ends} m"
        for end in line.ends:
            yield f"  end {end.number}: {_held(end)}"
            for moved in scene.line_motions:
                if (moved.line, moved.end) == (line.id, end.number):
                    yield from (f"  end {moved.end}: {words}" for words in _moved(moved))
        for section in line.sections:
            yield f"  {_section(section, scene.sea)}"


def seabed_lines(scene: Scene) -> Iterator[str]:
    """Soils under lines, suctions, and how each line lies on the seabed."""
    for soil in scene.soil_stiffnesses.values():
        values = ", ".join(parameter(name, value) for name, value in soil.parameters.items())
        yield f"soil stiffness {soil.id}: {soil.model}, {values}"
    for suction in scene.suctions.values():
        yield f"suction {suction.id}: {_suction(suction)}"
    for contact in scene.seabed_contacts:
        yield _contact(contact, scene.lines[contact.line])
        for number, section in enumerate(scene.lines[contact.line].sections, start=1):
            weight = section.submerged_weight(scene.sea.density, scene.sea.gravity)
            if weight > 0.0:
                words = _at_rest(scene, contact, section.outer_diameter, weight)
                yield f"  section {number} at rest, under {short(weight)} N/m: {words}"


def _point(position: tuple[float, float, float]) -> str:
    return f"({', '.join(map(short, position))})"


def _held(end: LineEnd) -> str:
    held = f"{' '.join(end.held)} held" if end.held else "free to move"
    if end.tangent is None:
        return f"{held}, free to turn"
    return f"{held}, leaving in the direction {_point(end.tangent)}"


def _section(section: LineSection, sea: Sea) -> str:
    """Geometry, stiffness, mass and weight of a section, and its elements."""
    weight = section.submerged_weight(sea.density, sea.gravity)
    many = f"{section.elements} elements" if section.elements else "elements by accuracy (default)"
    fill = f", contents {short(section.fill_density)} kg/m3" if section.fill_density else ""
    return (
        f"{short(section.length)} m: OD {short(section.outer_diameter)} m, "
        f"WT {short(section.wall_thickness)} m, EI {short(section.bending_stiffness)} N m2, "
        f"EA {short(section.axial_stiffness)} N, mass {short(section.mass)} kg/m{fill}, "
        f"submerged weight {short(weight)} N/m, "
        f"added-mass coefficient {short(section.added_mass_coefficient)}, "
        f"drag coefficient {short(section.drag_coefficient)}, {many}"
    )


def _moved(moved: LineMotion) -> Iterator[str]:
    unit = "rad" if moved.dof.startswith("R") else "m"
    if moved.name:
        yield f"{moved.dof} moved by {short(moved.target)} {unit} times {moved.name}"
    for wave in moved.waves:
        ramp = f", growing over {short(wave.ramp)} s" if wave.ramp else ""
        yield (
            f"{moved.dof} moved in a wave of {short(wave.amplitude)} {unit} and "
            f"{short(wave.period)} s from {short(degrees(wave.phase))} deg on{ramp}"
        )
    if moved.times:
        count = f"{len(moved.times)} rows" if len(moved.times) > 1 else "1 row"
        yield (
            f"{moved.dof} follows {count} from {short(moved.times[0])} to "
            f"{short(moved.times[-1])} s, {short(min(moved.values))} to "
            f"{short(max(moved.values))} {unit}"
        )


def _contact(contact: SeabedContact, line: Line) -> str:
    """How a line lies on the seabed."""
    if contact.stiffness is None:
        stiff = f"soil stiffness {contact.soil_stiffness}"
    else:
        stiff = f"stiffness {short(contact.stiffness)} N/m2"
    rubs = f"friction {short(contact.axial_friction)} along and {short(contact.lateral_friction)}"
    if contact.axial_friction or contact.lateral_friction:
        rubs += (
            f" across, reached at slips of {short(contact.axial_threshold)} and "
            f"{short(contact.lateral_threshold)} m, {_SURFACES[contact.surface]}"
        )
    else:
        rubs = "no friction"
    pulls = "no suction" if contact.suction is None else f"suction {contact.suction}"
    return (
        f"line {line.id} on the seabed at {short(contact.mudline)} m: {stiff}, {rubs}, {pulls}, "
        f"{_FORMS[contact.form]}, taking hold over {short(contact.tolerance)} m"
    )


def _at_rest(scene: Scene, contact: SeabedContact, diameter: float, weight: float) -> str:
    """How deep a stretch of line that lies flat sinks in, and the stiffness that it finds."""
    if contact.stiffness is not None:
        depth = float(penetration_at_rest(weight, contact.stiffness, contact.tolerance))
        return f"{short(1e3 * depth)} mm deep"
    soil = scene.soil_stiffnesses[contact.soil_stiffness or 0]
    try:
        found = pipe_stiffness(MODELS[soil.model].at(diameter, soil.parameters), weight)
    except InvalidData as problem:
        return f"no equilibrium: {problem}"
    words = [f"{short(1e3 * found.penetration)} mm deep", f"Ks {short(1e-3 * found.static)} kPa"]
    if found.dynamic is not None:
        words.append(f"Kd {short(1e-3 * found.dynamic)} kPa")
    return "; ".join([", ".join(words), *found.warnings])


_SURFACES = {"box": "each direction by itself (box)", "ellipse": "both together (ellipse)"}
_FORMS = {"integrated": "integrated along its elements", "nodal": "lumped at its nodes"}


def _suction(suction: Suction) -> str:
    """The laws of a suction, and what else is known of it."""
    if suction.force_factor is None:
        strength = short(suction.undrained_shear_strength or 0.0)
        force = f"force 1.12 OD {strength} Pa (v/OD)^{short(suction.force_exponent)}"
    else:
        force = f"force {short(suction.force_factor)} v^{short(suction.force_exponent)} N/m"
    factor = "0.98 OD" if suction.reach_factor is None else short(suction.reach_factor)
    shares = f"full from {short(suction.mobilised)} and fading from {short(suction.released)} of it"
    words = [force, f"over {factor} v^{short(suction.reach_exponent)} m", shares]
    words.append(f"pulled out at {short(suction.speed)} m/s in statics")
    words.append(f"velocity smoothed over {short(suction.smoothing)} s")
    if suction.remaining is not None and suction.travel_95 is not None:
        words.append(
            f"worn to {short(suction.remaining)}, 95 % of that by a way of "
            f"{short(suction.travel_95)} OD"
        )
    return ", ".join(words)
