"""The weight of tubes in air and water.

Every section weighs its mass and what it is filled with; below sea level the water takes off what
its wall displaces, and its filling where it has one. An open tube without filling holds water.
A lumped mass weighs what it does in air.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..scene import Sea, Section


@dataclass(frozen=True, eq=False)
class Weights:
    """Weight along a tube, by its number, at Gauss points: depths x and their shares (m), N/m.

    spread: it is along the tube, not a force (N) at one depth with a share of 1.
    """

    x: Array
    share: Array
    force: Array
    tube: int
    spread: bool = True


def unit_weight(section: Section, sea: Sea, *, submerged: bool) -> float:
    """Weight of a section in air or in water, N/m."""
    inside = np.pi / 4.0 * section.inner_diameter**2
    mass = section.mass + section.fill_density * inside
    if submerged:
        displaced = section.area + (inside if section.fill_density else 0.0)
        mass -= sea.density * displaced
    return sea.gravity * mass
