"""Curves, profiles and tubes that tests of axial capacity are made of."""

from math import pi

from podeep.scene import Curve, Ground, Section
from podeep.soil.profile import Profile

G, WATER, STEEL = 9.80665, 1025.0, 7850.0


def clay(id, strength, weight):
    given = {"undrained_shear_strength": strength, "effective_unit_weight": weight}
    return Curve(id, "cohesive", given)


def sand(id, beta, factor, weight, **limits):
    given = {"earth_pressure_coefficient": beta, "bearing_factor": factor, **limits}
    given |= {"interface_friction_angle": pi / 4.0, "effective_unit_weight": weight}
    return Curve(id, "cohesionless", given)


def direct(id, friction, pressure=0.0, **given):
    return Curve(id, "direct", {"unit_friction": friction, "tip_pressure": pressure, **given})


def profile(*layers):
    """Layers (bottom, curve at the top, curve at the bottom), from the mudline on."""
    depths, curves, top = [], [], 0.0
    for bottom, above, below in layers:
        depths, curves, top = [*depths, top, bottom], [*curves, above, below], bottom
    ids = tuple(c.id for c in curves)
    return Profile(Ground(tuple(depths), (0,) * len(ids), ids, {}, {c.id: c for c in curves}))


def uniform(curve):
    return profile((10.0, curve, curve))


def pile(*parts):
    """Tubes (diameter, wall, length) from the mudline, at elevation 0, down."""
    sections, top = [], 0.0
    for diameter, wall, length in parts:
        sections.append(Section(top, top - length, diameter, wall, 210e9, STEEL))
        top -= length
    return tuple(sections)
