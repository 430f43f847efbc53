"""The reaction curves in force at a depth, through the same laws that the solver calls."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Literal

import numpy as np

from ..arrays import Array
from .profile import Profile
from .reaction import Reaction

Name = Literal["py", "tz", "qz", "mt", "hb", "mb"]

#: displacements shown where none are asked for, in diameters, and rotations, in rad
_SHOWN = np.array(
    (
        *(0.0, 0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01),
        *(0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3),
    )
)
_TURNED = np.array((0.0, 1e-5, 2e-5, 5e-5, *_SHOWN[1:]))


@dataclass(frozen=True, slots=True)
class Kind:
    """What a curve is: in words, and the units of its reaction and of its displacement."""

    title: str
    unit: str
    displacement: str
    displacement_unit: str = "m"

    @property
    def turns(self) -> bool:
        """Whether the displacement is a rotation."""
        return self.displacement_unit == "rad"


KINDS: Mapping[Name, Kind] = MappingProxyType(
    {
        "py": Kind("lateral resistance", "N/m", "lateral displacement"),
        "tz": Kind("friction of the shaft", "N/m", "axial displacement"),
        "qz": Kind("bearing of the tip", "N", "axial displacement"),
        "mt": Kind("moment along the shaft", "N m/m", "rotation", "rad"),
        "hb": Kind("shear at the base", "N", "lateral displacement"),
        "mb": Kind("moment at the base", "N m", "rotation", "rad"),
    }
)
"""The curves of a depth: `qz`, `hb` and `mb` are those of a tip that stands there."""


@dataclass(frozen=True)
class CurveTable:
    """One curve at displacements (m) or rotations (rad), with the laws that make it.

    lateral: of a moment whose laws give it for each unit of |p|, the bound of |p| in N/m: what is
    shown of these laws is what they give under it.
    """

    name: Name
    displacement: Array
    source: Reaction
    lateral: float = 0.0

    @property
    def kind(self) -> Kind:
        return KINDS[self.name]

    @property
    def follows_lateral(self) -> bool:
        return any(term.law.follows_lateral for term in self.source.laws)

    @cached_property
    def reaction(self) -> Array:
        """At each displacement, in the unit of the kind."""
        return self.at(self.displacement)

    @property
    def capacity(self) -> float:
        """Bound of the reaction's size."""
        return sum(factor * float(part.capacity[0]) for part, factor in self._parts)

    def at(self, displacement: Array) -> Array:
        """The reaction at other displacements, shape (n,)."""
        u = displacement[:, None]
        return np.asarray(sum(factor * part.evaluate(u)[0][:, 0] for part, factor in self._parts))

    @cached_property
    def _parts(self) -> list[tuple[Reaction, float]]:
        if not self.follows_lateral:
            return [(self.source, 1.0)]
        own = self.source.part(lambda law: not law.follows_lateral)
        following = self.source.part(lambda law: law.follows_lateral)
        return [(own, 1.0), (following, self.lateral)]


def curves(
    profile: Profile, depth: float, diameter: float, displacement: Array | None = None
) -> tuple[CurveTable, ...]:
    """The curves of a tube at a depth (m), and those of a tip standing there.

    displacement: shape (n,), m, or rad of the curves of rotation; a standard set by default. A
    curve without reaction is left out.
    """
    at, width = np.array([depth]), np.array([diameter])
    lateral = profile.lateral(at, width)
    shear, moment = profile.base(depth, diameter)
    reactions: dict[Name, Reaction] = {
        "py": lateral,
        "tz": profile.shaft(at, width),
        "qz": profile.tip(depth, diameter),
        "mt": profile.moment(at, width),
        "hb": shear,
        "mb": moment,
    }
    shown = {True: _TURNED, False: _SHOWN * diameter}
    bound = float(lateral.capacity[0])
    return tuple(
        CurveTable(
            name, shown[KINDS[name].turns] if displacement is None else displacement, source, bound
        )
        for name, source in reactions.items()
        if source.laws
    )
