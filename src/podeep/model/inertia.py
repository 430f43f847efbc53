"""The mass of tubes and of what stands on them, as matrices of both problems.

A tube moves sideways with what fills it (where a filling is given) and with the added mass of the
water around it, CA times the water that its outline displaces, between sea level and the mudline.
Along its axis it takes its filling with it, as it bears its weight, but no water. An open tube
without a filling is empty: water that moves with it is a filling of 1025 kg/m3.

Rotary inertia goes with softness in shear: both matter for short waves alone, and to the same
degree (Timoshenko, Phil. Mag. 41 (1921)).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..arrays import Array
from ..beam.band import band_place, element_band
from ..beam.bubbles import Bubbles, bubbles
from ..beam.field import Field
from ..beam.strings import summed
from ..scene import Foundation, Mass, Scene, Sea, Section
from .assemble import Model
from .mesh import Stretch
from .needs import Needs


@dataclass(frozen=True, eq=False)
class Inertia:
    """Mass of each tube in each interval, shape (intervals, tubes); 0 where a tube is not.

    lateral, axial: what moves across and along the tube, kg/m. rotary: what resists the rotation
    of its section, kg m.
    """

    lateral: Array
    axial: Array
    rotary: Array


def moving_mass(section: Section, sea: Sea, *, submerged: bool) -> float:
    """Mass that moves sideways with a section in air (or soil) or in water, kg/m."""
    water = section.added_mass_coefficient * sea.density if submerged else 0.0
    return carried_mass(section) + water * np.pi / 4.0 * section.outer_diameter**2


def carried_mass(section: Section) -> float:
    """Mass of a section and of what fills it, kg/m."""
    return section.mass + section.fill_density * np.pi / 4.0 * section.inner_diameter**2


def rotary_inertia(section: Section) -> float:
    """Of the tube alone, kg m: its mass at the radius of gyration of its wall."""
    return section.mass * section.second_moment / section.area


def inertia(
    scene: Scene, foundation: Foundation, pieces: Sequence[Stretch], edges: Array
) -> Inertia:
    """What the tubes of each interval between edges (m) weigh down a motion with."""
    middle = 0.5 * (edges[:-1] + edges[1:])
    piece = np.searchsorted([p.bottom for p in pieces], middle)
    amounts = np.zeros((3, len(middle), len(foundation.tubes)))
    for i, (x, number) in enumerate(zip(middle.tolist(), piece.tolist(), strict=True)):
        submerged = foundation.mudline < x < 0.0
        for tube, section in enumerate(pieces[number].sections):
            if section is not None:
                amounts[:, i, tube] = (
                    moving_mass(section, scene.sea, submerged=submerged),
                    carried_mass(section),
                    rotary_inertia(section),
                )
    return Inertia(*amounts)


def mass_band(
    scene: Scene,
    model: Model,
    which: Literal["lateral", "axial"],
    *,
    rotary: bool | None = None,
) -> Array:
    """Mass matrix of one problem, as `System.tangent` is kept: (width, size), Fortran order, kg.

    Held unknowns have their rows and columns too, as their motion drives the others:
    `beam.band.without` takes them out. rotary: with the sections' rotary inertia; None: where the
    tubes are soft in shear.
    """
    problem = model.lateral if which == "lateral" else model.axial
    field, system = problem.system.field, problem.system
    own = inertia(scene, model.foundation, model.pieces, field.edges)
    if which == "axial":
        matrices = field.mass(summed(field.strings, own.axial))
    else:
        turning = model.needs.shear if rotary is None else rotary
        resisting = summed(field.strings, own.rotary) if turning else None
        matrices = field.mass(summed(field.strings, own.lateral), resisting)
    shape = (field.size, system.components)
    band = element_band(field.dofs, matrices, system.width, shape)
    needs = model.needs if which == "lateral" else None
    for mass in scene.masses:
        if mass.tube in model.foundation.tubes:
            for row, column, amount in lumped(scene, model.foundation, needs, field, mass):
                band[band_place(np.array(row), np.array(column), system.width)] += amount
    return band.reshape((system.width, system.size), order="F")


def turning_inside(scene: Scene, model: Model) -> Bubbles | None:
    """Rotations that rotary inertia makes inside elements; None of tubes rigid in shear."""
    field = model.lateral.system.field
    if field.shear_stiffness is None:
        return None
    own = inertia(scene, model.foundation, model.pieces, field.edges)
    return bubbles(field, summed(field.strings, own.rotary))


def arm(scene: Scene, mass: Mass) -> float:
    """Length of the rigid arm from the top of a tube up to a mass, m."""
    return max(mass.elevation - scene.tubes[mass.tube].top, 0.0)


def lumped(
    scene: Scene, foundation: Foundation, needs: Needs | None, field: Field, mass: Mass
) -> Iterator[tuple[int, int, float]]:
    """Entries (row, column, kg) of a lumped mass, row >= column; axial where needs is None.

    Depth grows downwards, so a mass on an arm c above the top moves by y - c y'. With J about
    itself and m on (y, y') this is [[m, -m c], [-m c, J + m c^2]].
    """
    above = arm(scene, mass)
    node = field.node(
        foundation.mudline - mass.elevation + above, foundation.tubes.index(mass.tube)
    )
    if needs is None:
        yield node, node, mass.mass
        return
    length, components = field.slope_length, needs.components
    for c, (x, y) in enumerate(needs.direction):
        about = mass.inertia[1] * x**2 + mass.inertia[0] * y**2
        value, slope = node * components + c, (node + 1) * components + c
        yield value, value, mass.mass
        yield slope, value, -mass.mass * above / length
        yield slope, slope, (about + mass.mass * above**2) / length**2
