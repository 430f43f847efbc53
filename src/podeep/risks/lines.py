"""Lines on the seabed that are legal but risky."""

from collections.abc import Iterator
from math import pi, sin

import numpy as np

from ..scene import Line, Scene, SeabedContact
from ..units import short
from .ranges import CONTACT_SLIPS, SLIPS
from .risk import Risk, Value, rounded, slips, wall_slips, written

_TAUT = 0.002  # strain at which steel of X65 is near its yield
_JUMP = 0.01  # of the diameter: jump of an end that matters


def line_risks(scene: Scene, id_: int) -> Iterator[Risk]:
    """All that is risky of a line: its sections, its way between its ends, its seabed."""
    line, subject = scene.lines[id_], f"line {id_}"
    for section in line.sections:
        yield from wall_slips(subject, section)
        weight = section.submerged_weight(scene.sea.density, scene.sea.gravity)
        if weight <= 0.0:
            numbers = (
                f"{rounded(section.total_mass, 'kg/m')} with OD = {short(section.outer_diameter)} m"
            )
            rule = f"it floats in water of {short(scene.sea.density)} kg/m3"
            remedy = "check RHO, MASS and FILL, the density of the contents"
            yield Risk(subject, "weight", numbers, rule, remedy)
    yield from _taut(line, subject)
    yield from _motion(scene, line, subject)
    for contact in scene.seabed_contacts:
        if contact.line == id_:
            yield from _contact(scene, line, contact, subject)


def _motion(scene: Scene, line: Line, subject: str) -> Iterator[Risk]:
    """A line that moves without drag, and ends that do not begin where statics has left them."""
    if scene.dynamics is None:
        return
    start = scene.dynamics.start
    if all(section.drag_coefficient == 0.0 for section in line.sections):
        numbers, rule = (
            "CD = 0 in motion",
            "the water takes no energy: what swings goes on swinging",
        )
        yield Risk(subject, "drag", numbers, rule, "give CD, about 1 for a bare pipe")
    for moved in scene.line_motions:
        if moved.line != line.id:
            continue
        jump = sum(
            wave.amplitude * sin(2.0 * pi * start / wave.period + wave.phase)
            for wave in moved.waves
            if not wave.ramp
        )
        if moved.times:
            jump += float(np.interp(start, moved.times, moved.values))
        if abs(jump) > _JUMP * max(section.outer_diameter for section in line.sections):
            numbers = f"{moved.dof} of end {moved.end} begins {rounded(jump, 'm')} from its place"
            rule = "it jumps there in the first step, which shakes the line"
            remedy = "give the wave a RAMP, or begin the record at 0"
            yield Risk(subject, f"jump of {moved.dof}{moved.end}", numbers, rule, remedy)


def _taut(line: Line, subject: str) -> Iterator[Risk]:
    """A line that is shorter than the way between its ends, by more than steel bears."""
    length, distance = line.length, line.distance
    if distance <= length * (1.0 + _TAUT):
        return
    numbers = f"sections of {short(length)} m in all, ends {rounded(distance, 'm')} apart"
    rule = f"a strain of {100.0 * (distance / length - 1.0):.3g} %, steel yields at 0.2 %"
    remedy = "check LENGTH and the places in *END"
    if distance <= 1e3 * length and length < 100.0:
        remedy = f"write {written(1e3 * length)} if {short(length)} km is meant"
    yield Risk(subject, "length", numbers, rule, remedy)


def _contact(scene: Scene, line: Line, contact: SeabedContact, subject: str) -> Iterator[Risk]:
    """Slips of units in a contact and its suction, and ends that lie below the seabed."""
    for attribute, name, unit, slip in CONTACT_SLIPS:
        amount = getattr(contact, attribute)
        if amount is not None:
            yield from slips(subject, attribute, Value(name, amount, unit), slip)
    if contact.suction is not None:
        strength = scene.suctions[contact.suction].undrained_shear_strength
        if strength is not None:
            key = "undrained_shear_strength"
            of = f"suction {contact.suction}"
            yield from slips(of, key, Value("CU", strength, "Pa"), SLIPS[key])
    for end in line.ends:
        deep = contact.mudline - end.position[2]
        if deep > max(section.outer_diameter for section in line.sections):
            numbers = f"end {end.number} at {short(end.position[2])} m"
            rule = f"it lies {short(deep)} m below the seabed, more than the line's diameter"
            remedy = "give Z in *END as an elevation from sea level, at the seabed or above it"
            yield Risk(subject, f"end {end.number}", numbers, rule, remedy)
