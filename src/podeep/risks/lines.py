"""Lines on the seabed that are legal but risky."""

from collections.abc import Iterator
from math import pi

import numpy as np

from ..scene import TRANSLATIONS, Line, LineMotion, Scene, SeabedContact
from ..solve.drive import change_of, drive
from ..solve.plan import steps_in
from ..units import short
from .ranges import CONTACT_SLIPS, SLIPS
from .risk import Risk, Value, rounded, slips, wall_slips, written
from .site import EDGE

_TAUT = 0.002  # strain at which steel of X65 is near its yield
_JUMP = 0.01  # of the diameter: jump of an end that matters
_FASTEST = 20.0  # m/s, of what moves an end
_FEWEST = 8  # steps in a period


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
    """A line that moves without drag; ends that jump, or move too fast or too finely for DT."""
    dynamics = scene.dynamics
    if dynamics is None:
        return
    if all(section.drag_coefficient == 0.0 for section in line.sections):
        numbers, rule = (
            "CD = 0 in motion",
            "the water takes no energy: what swings goes on swinging",
        )
        yield Risk(subject, "drag", numbers, rule, "give CD, about 1 for a bare pipe")
    factors, names = drive(scene, dynamics.start), scene.steps.names
    width = max(section.outer_diameter for section in line.sections)
    for moved in scene.line_motions:
        if moved.line != line.id or moved.dof not in TRANSLATIONS:
            continue
        which = f"{moved.dof} of end {moved.end}"
        jump = change_of(moved, factors, names, dynamics.start)(dynamics.start)[0]
        if abs(jump) > _JUMP * width:
            numbers = f"{which} begins {rounded(jump, 'm')} from its place"
            rule = "it jumps there in the first step, which shakes the line"
            remedy = "give the wave a RAMP, or begin the record at 0"
            yield Risk(subject, f"jump of {moved.dof}{moved.end}", numbers, rule, remedy)
        periods, speed = _course(scene, moved)
        if speed > _FASTEST:
            numbers = f"{which} moves at up to {rounded(speed, 'm/s')}"
            rule = f"above {_FASTEST:g} m/s it is as a rule a slip of units, or a record that jumps"
            remedy = "check amplitudes and periods, and the times of the record"
            yield Risk(subject, f"speed of {moved.dof}{moved.end}", numbers, rule, remedy)
        if periods and dynamics.step is not None and not dynamics.adaptive:
            whole = dynamics.end - dynamics.start
            step = whole / steps_in(whole, dynamics.step, dynamics.recording)
            if step > min(periods) / _FEWEST * (1.0 + EDGE):
                numbers = f"DT = {short(dynamics.step)} s with a period of {short(min(periods))} s"
                rule = f"with fewer than {_FEWEST} steps in it a wave is not what was asked for"
                remedy = f"give DT of {rounded(min(periods) / 20.0, 's')}, or leave it out"
                yield Risk(subject, f"step of {moved.dof}{moved.end}", numbers, rule, remedy)


def _course(scene: Scene, moved: LineMotion) -> tuple[list[float], float]:
    """Periods, s, of all that moves an end, and the largest speed it can come to, m/s."""
    called = [(h.period, moved.target) for h in scene.harmonics if h.name == moved.name]
    waves = [(wave.period, wave.amplitude) for wave in moved.waves] + called
    speed = sum(2.0 * pi / period * abs(amplitude) for period, amplitude in waves)
    records = [(moved.times, 1.0, moved.values)]
    records += [(s.times, moved.target, s.factors) for s in scene.series if s.name == moved.name]
    for times, size, values in records:
        speed += float(np.max(np.abs(size * np.diff(values) / np.diff(times)), initial=0.0))
    return [period for period, _ in waves], speed


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
