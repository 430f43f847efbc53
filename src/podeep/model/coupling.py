"""What deflection and stretch owe each other, each time one of them has moved.

The normal force of the stretch works on the slope of the deflection; tubes that press against each
other as they deflect rub as they stretch.
"""

from dataclasses import replace

import numpy as np

from ..arrays import Array
from .assemble import Model
from .compression import compression
from .contact import reaction
from .results import axial_ends, product, tube_force
from .system import Points, System


def pressed(model: Model, axial: Array, lateral: System) -> System:
    """A lateral system of the model's tubes under the normal force of a state of the stretch."""

    def renewed(points: Points) -> Points:
        force = pressing(model, axial, lateral, points)
        return replace(points, reaction=compression(force))

    return lateral.replaced(renewed(p) if p.compressed else p for p in lateral.points)


def pressing(model: Model, axial: Array, lateral: System, points: Points) -> Array:
    """Normal force at points of a lateral system, (..., points), N: of all that deflect there."""
    field, ends = lateral.field, axial_ends(model, axial)
    element = field.elements(points.x, points.tube)
    interval = field.strings.interval[element]
    total = np.zeros((*axial.shape[:-1], len(points.x)))
    for tube, carrier in enumerate(field.strings.carrier):
        there = np.flatnonzero(carrier[interval] == element)
        total[..., there] += tube_force(model, ends, points.x[there], tube)
    return total


def rubbed(model: Model, deflection: Array, axial: System) -> System:
    """An axial system of the model's tubes with the friction that a state of deflection allows."""
    field, components = model.lateral.system.field, model.lateral.system.components
    unknowns = np.moveaxis(deflection.reshape(-1, components), 1, 0)

    def renewed(points: Points) -> Points:
        law = points.friction
        if law is None:
            return points
        apart = np.linalg.norm(product(unknowns, points.matrix(field)), axis=0)
        return replace(points, reaction=reaction(law.pressed(apart)))

    return axial.replaced(map(renewed, axial.points))


def rubs(system: System) -> bool:
    """Whether tubes rub against each other in an axial system."""
    return any(p.friction for p in system.points)


def friction_limit(system: System) -> Array:
    """Largest friction at each place where tubes rub, N/m."""
    limits = [p.friction.limit for p in system.points if p.friction]
    return np.concatenate([np.zeros(0), *limits])
