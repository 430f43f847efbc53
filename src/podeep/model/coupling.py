"""What deflection and stretch owe each other, each time one of them has moved.

The normal force of the stretch works on the slope of the deflection; tubes that press against each
other as they deflect rub as they stretch.
"""

from dataclasses import replace

from ..arrays import Array
from .assemble import Model
from .compression import compression
from .contact import reaction
from .points import Points
from .results import apart, axial_ends, joint_force
from .system import System


def pressed(model: Model, axial: Array, deflection: Array, lateral: System) -> System:
    """A lateral system of the model's tubes under the normal force of a state.

    axial, deflection: unknowns of the model's two problems; friction depends on the latter.
    """
    return under(lateral, pressing(model, axial, deflection, lateral))


def under(lateral: System, force: Array) -> System:
    """A lateral system under normal forces (N) at the points where they work on the slope."""
    law = compression(force)
    return lateral.replaced(replace(p, reaction=law) if p.compressed else p for p in lateral.points)


def pressing(model: Model, axial: Array, deflection: Array, lateral: System) -> Array:
    """Normal force where it works on the slope of a lateral system, (points,), N: that of all
    tubes that deflect there as one."""
    points = next(p for p in lateral.points if p.compressed)
    ends = axial_ends(model, axial, deflection)
    return joint_force(model, ends, lateral.field, points.x, points.tube)


def rubbed(model: Model, deflection: Array, axial: System) -> System:
    """An axial system of the model's tubes with the friction that a state of deflection allows."""

    def renewed(points: Points) -> Points:
        law = points.friction
        if law is None:
            return points
        return replace(points, reaction=reaction(law.pressed(apart(model, deflection, points))))

    return axial.replaced(map(renewed, axial.points))


def rubs(system: System) -> bool:
    """Whether tubes rub against each other in an axial system."""
    return any(p.friction for p in system.points)
