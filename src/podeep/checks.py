"""Legal but risky: a warning states the numbers, the rule and the remedy.

    F1: L/D = 4: the curves of p-y 1 are for long slender piles ...; compare with PISA ...

Each is one line, `subject: numbers: rule; remedy`. What cannot be evaluated at all is no business
of these checks: it is a fault, told where the model is made.
"""

from collections.abc import Iterator

from .deck.keywords import KEYWORDS
from .errors import InvalidData, UserError
from .risks import bearing, motion, piles
from .risks.curves import curve_risks
from .risks.lines import line_risks
from .risks.ranges import SLIPS
from .risks.risk import Risk, Value, rounded, slips, wall_slips
from .risks.seabed import soil_risks
from .risks.site import EDGE, Site
from .scene import Foundation, Scene, Spudcan, Tube
from .soil.spudcan_bearing import clay_bearing_capacity, sand_bearing_capacity
from .units import short

_THINNEST = 200.0  # D/t
_POISSON = {"CLAY": (0.45, 0.5), "SAND": (0.15, 0.35), None: (0.0, 0.5)}


def warnings(scene: Scene) -> list[str]:
    """All that is risky in a scene: its tubes, its curves by id, its lines, its foundations."""
    first: dict[tuple[str, str], Risk] = {}
    for risk in _risks(scene):
        first.setdefault((risk.subject, risk.about), risk)
    return [str(risk) for risk in first.values()]


def _risks(scene: Scene) -> Iterator[Risk]:
    ground = scene.ground
    for id_ in sorted({tube for foundation in scene.foundations for tube in foundation.tubes}):
        yield from tube_risks(scene.tubes[id_])
    for id_ in sorted(set(ground.lateral) - {0}):
        yield from curve_risks("p-y", ground.lateral_curves[id_])
    for id_ in sorted(set(ground.axial) - {0}):
        yield from curve_risks("t-z", ground.axial_curves[id_])
    for soil in scene.soil_stiffnesses.values():
        yield from soil_risks(f"soil stiffness {soil.id}", soil.parameters)
    for id_ in scene.lines:
        yield from line_risks(scene, id_)
    for foundation in scene.foundations:
        yield from foundation_risks(scene, foundation)


def foundation_risks(scene: Scene, foundation: Foundation) -> Iterator[Risk]:
    """All that is risky of a foundation in its ground and under its loads."""
    site = Site(scene, foundation)
    if site.spudcan:
        yield from spudcan_risks(site, site.spudcan)
    for check in (*piles.CHECKS, *bearing.CHECKS, *motion.CHECKS) if site.length > 0.0 else ():
        try:
            yield from check(site)
        except (UserError, InvalidData):
            continue


def tube_risks(tube: Tube) -> Iterator[Risk]:
    """Slips of units in a tube, and walls that no driven pile has."""
    subject = f"tube {tube.id}"
    for section in tube.sections:
        yield from wall_slips(subject, section)
        width, wall = section.outer_diameter, section.wall_thickness
        if width > _THINNEST * wall * (1.0 + EDGE):
            numbers = f"WT = {short(wall)} m with OD = {short(width)} m, D/t = {width / wall:.4g}"
            least = rounded(1e3 * (0.00635 + 0.01 * width), "mm")
            rule = f"driven piles have 6.35 mm + D/100, here {least} (API RP 2A-WSD 6.10.6)"
            remedy = "check WT and its unit, and buckling if it is meant"
            yield Risk(subject, "wall_thickness", numbers, rule, remedy)


def bearing_capacity(can: Spudcan) -> float | None:
    """What the soil under a spudcan bears, N; None where too little is known of it."""
    weight, depth = can.effective_unit_weight, can.embedment
    if weight is None:
        return None
    if can.soil == "CLAY" and can.undrained_shear_strength is not None:
        strength = can.undrained_shear_strength
        found = clay_bearing_capacity(strength, can.diameter, depth, weight * depth)
    elif can.soil == "SAND" and can.friction_angle is not None:
        angle = can.friction_angle
        found = sand_bearing_capacity(angle, can.diameter, depth, weight, weight * depth)
    else:
        return None
    return float(found.capacity)


def spudcan_risks(site: Site, can: Spudcan) -> Iterator[Risk]:
    """A spudcan's values, its embedment and its preload."""
    subject = f"{site.name} spudcan"
    for column in KEYWORDS["SPUDCAN"].rows[0].columns:
        amount = getattr(can, column.key) if column.key in SLIPS else None
        if amount is not None:
            amount *= 100.0 if column.unit == "%" else 1.0
            value = Value(column.name, amount, column.unit)
            yield from slips(subject, column.key, value, SLIPS[column.key])
    factors = {can.vertical_factor, can.horizontal_factor, can.rotational_factor}
    if can.embedment > 0.0 and factors == {1.0}:
        ratio = f"Dp/B = {can.embedment / can.diameter:.3g}"
        numbers = f"KD1 = KD2 = KD3 = 1 at Dp = {short(can.embedment)} m, {ratio}"
        rule = "1 is the lower bound, embedded spudcans are stiffer (ISO 19905-1 A.9.3.4)"
        remedy = "give the factors of the standard's table, or keep 1 as the soft bound"
        yield Risk(subject, "embedment", numbers, rule, remedy)
    low, high = _POISSON[can.soil]
    if not low - EDGE <= can.poisson_ratio <= high + EDGE:
        numbers = f"NU = {short(can.poisson_ratio)} with SOIL={can.soil}"
        rule = "it is 0.5 in undrained clay, 0.2 to 0.3 in sand (ISO 19905-1 A.9.3.4)"
        yield Risk(subject, "poisson_ratio", numbers, rule, "give that of the soil")
    if site.load.tension:
        step = site.load.tension_step
        numbers = f"uplift of {rounded(site.load.tension, 'N')} (step {step})"
        rule = "a spudcan without suction holds no uplift, its springs do (ISO 19905-1 A.9.3)"
        yield Risk(subject, "uplift", numbers, rule, "add the leg's weight, or lower the uplift")
    bears = bearing_capacity(can)
    if can.preload is not None and bears is not None and can.preload > bears * (1.0 + EDGE):
        numbers = f"V_PRELOAD = {rounded(can.preload, 'N')}, the soil bears {rounded(bears, 'N')}"
        rule = "it would go deeper under such a preload (ISO 19905-1 A.9.3.2)"
        remedy = "give the depth EMBED at which the soil bears it, or a smaller preload"
        yield Risk(subject, "bearing", numbers, rule, remedy)
    load, preload = site.load.compression, can.preload
    if preload is not None and load > preload * (1.0 + EDGE):
        numbers = (
            f"V_PRELOAD = {rounded(preload, 'N')} and a vertical load of {rounded(load, 'N')} "
            f"(step {site.load.compression_step})"
        )
        rule = "the yield surface ends at the preload (ISO 19905-1 A.9.3.3)"
        yield Risk(subject, "preload", numbers, rule, "preload to more than the load, or lower it")
