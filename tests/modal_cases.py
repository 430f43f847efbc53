"""Scenes of the validation cases of natural frequencies, and their printed values."""

import csv
import itertools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from podeep.scene import (
    CoupledSpring,
    Dof,
    Foundation,
    Ground,
    Mass,
    Numerics,
    Scene,
    Section,
    Support,
    Tube,
)
from scenes import linear_ground

DATA = Path(__file__).parent / "data" / "valid"
NOTHING = Ground((0.0,), (0,), (0,), {}, {})  # soil without any reaction

#: degrees of freedom held at the top and at the tip of a beam in one plane
ENDS: dict[str, tuple[tuple[Dof, ...], tuple[Dof, ...]]] = {
    "pinned-pinned": (("X",), ("X",)),
    "clamped-free": ((), ("X", "RY")),
    "clamped-clamped": (("X", "RY"), ("X", "RY")),
    "free-free": ((), ()),
    "clamped-pinned": (("X", "RY"), ("X",)),
    "free-pinned": ((), ("X",)),
}


def rows(name: str) -> list[dict[str, str]]:
    with (DATA / name).open() as file:
        return list(csv.DictReader(file))


def beam(section: Section, ends: str, modulus: float, numerics: Numerics) -> Scene:
    """A tube in one plane, wholly in soil of a constant modulus (N/m2), held at its ends."""
    held = (
        Support(1, z, dofs)
        for z, dofs in zip((section.top, section.bottom), ENDS[ends], strict=True)
        if dofs
    )
    ground = linear_ground(modulus, section.outer_diameter) if modulus else NOTHING
    return Scene(
        ends,
        {1: Tube(1, "beam", (section,))},
        (Foundation(1, (1,), 0.0),),
        ground,
        supports=(*held, Support(1, section.bottom, ("Z",))),
        numerics=replace(numerics, components=1),
    )


CF11 = Section(
    *(0.0, -30.0, 1.0, 0.02, 210e9, 7850.0),
    bending_stiffness_override=1.2e9,
    axial_stiffness_override=1e14,  # modes of the stretch are beyond all others
    mass_override=2500.0,
)


def gyration(radius: float) -> tuple[float, float]:
    """Outer diameter and wall of a tube whose section has this radius of gyration, m."""
    outer = 1.02 * 8.0**0.5 * radius
    return outer, 0.5 * (outer - (16.0 * radius**2 - outer**2) ** 0.5)


_OUTER, _WALL = gyration((50.0 / 9.0) ** 0.5)
CF16 = replace(
    CF11,
    outer_diameter=_OUTER,
    wall_thickness=_WALL,
    bending_stiffness_override=50e9,
    shear_stiffness_override=4e9,
    mass_override=9000.0,
)


def oc3(parts: int, numerics: Numerics) -> Scene:
    """PR08: the monopile and tower, its rows of sections cut into parts of uniform sections."""
    table = np.array([[float(v) for v in r.values()] for r in rows("PR08_sections.csv")])
    tube = Tube(1, "OC3", tuple(tapered(table[::-1], parts)))
    arm, mass = 1.966989, 350000.3
    return Scene(
        "PR08",
        {1: tube},
        (Foundation(1, (1,), -20.0),),
        NOTHING,
        supports=(Support(1, -20.0, ("Z",)),),
        numerics=replace(numerics, components=1),
        masses=(Mass(1, 87.6 + arm, mass, (2.353e7, 2.353e7, 2.542e7)),),
        coupled_springs=(CoupledSpring(1, -20.0, 2.5748e9, 2.25325e10, 2.629123e11),),
    )


def tapered(table: np.ndarray, parts: int) -> Iterator[Section]:
    """Uniform sections whose stiffness and mass are those in the middle of linear parts.

    table: rows of elevation, mass, rotary inertia, EI, EA, from the top down.
    """
    for upper, lower in itertools.pairwise(table):
        count = 1 if upper[0] - lower[0] < 0.01 or (upper[1:] == lower[1:]).all() else parts
        for i in range(count):
            ends = upper[0] + (lower[0] - upper[0]) * np.array([i, i + 1]) / count
            _, mass, rotary, ei, ea = upper + (lower - upper) * (i + 0.5) / count
            outer, wall = gyration((rotary / mass) ** 0.5)
            yield Section(
                *(float(ends[0]), float(ends[1]), outer, wall, 210e9, 8500.0),
                bending_stiffness_override=float(ei),
                axial_stiffness_override=float(ea),
                mass_override=float(mass),
            )
