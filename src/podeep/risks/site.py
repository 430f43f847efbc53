"""A foundation in its ground, with what the checks of piles share."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array
from ..demand import Demand, demand
from ..embedded import Pile
from ..errors import UserError
from ..scene import Curve, Foundation, Ground, Scene, Spudcan
from ..soil.axial_capacity import PileCapacity
from ..soil.layers import Layers
from ..soil.reaction import Term
from ..soil.surroundings import Family

EDGE = 1e-9  # share of a bound that rounding may pass it by
_SAMPLES = 100  # of the shaft


@dataclass(frozen=True)
class Site:
    """A foundation of some embedded length, as its outermost tube stands in the ground."""

    scene: Scene
    foundation: Foundation

    @property
    def name(self) -> str:
        return self.foundation.name

    @property
    def ground(self) -> Ground:
        return self.scene.ground

    @cached_property
    def pile(self) -> Pile:
        return Pile(self.scene, self.foundation)

    @property
    def length(self) -> float:
        return self.pile.length

    @cached_property
    def width(self) -> float:
        """Largest outer diameter in the soil, m."""
        sections = self.pile.tube.sections
        return max(s.outer_diameter for s in sections if s.bottom < self.foundation.mudline)

    @cached_property
    def load(self) -> Demand:
        return demand(self.scene, self.foundation)

    @property
    def spudcan(self) -> Spudcan | None:
        return self.scene.spudcan(self.foundation)

    @property
    def axial(self) -> bool:
        """Whether t-z and Q-z act when the scene is solved."""
        return self.scene.numerics.axial_curves and self.bearing[0] is not None

    @property
    def held(self) -> bool:
        """Whether anything but t-z and Q-z holds the foundation along z."""
        scene = self.scene
        holds = [s.tube for s in scene.spudcans]
        holds += [s.tube for s in scene.supports if "Z" in s.dofs]
        holds += [s.tube for s in scene.springs if s.dof == "Z"]
        holds += [d.tube for d in scene.displacements if d.dof == "Z"]
        return any(tube in self.foundation.tubes for tube in holds)

    @property
    def propped(self) -> bool:
        """Whether a support holds the foundation along z."""
        supports = [s for s in self.scene.supports if s.tube in self.foundation.tubes]
        return any("Z" in s.dofs for s in supports)

    @property
    def supported(self) -> bool:
        """Whether a support along z stands in for t-z and Q-z: the practice of concept stages."""
        return self.propped and not self.spudcan and not self.axial

    @cached_property
    def layers(self) -> Layers:
        return Layers(self.ground.depths)

    def reached(self) -> Iterator[tuple[float, float, tuple[int, int]]]:
        """Layers that the pile stands in: top and end in it, m, and the places of both ends."""
        bottoms = (*self.layers.boundaries, self.length)
        for top, bottom, ends in zip(self.layers.top, bottoms, self.layers.ends, strict=True):
            if top < self.length:
                yield float(top), min(bottom, self.length), ends

    def acting(self, family: Family) -> dict[int, Curve]:
        """The curves that act somewhere along the pile, by id."""
        lateral, ground = family == "p-y", self.ground
        ids = ground.lateral if lateral else ground.axial
        curves = ground.lateral_curves if lateral else ground.axial_curves
        found = {ids[place] for _, _, ends in self.reached() for place in ends}
        return {id_: curves[id_] for id_ in sorted(found - {0})}

    @cached_property
    def bearing(self) -> tuple[PileCapacity | None, str]:
        """Axial capacity with the tip where it stands; None where it is unknown, and why."""
        try:
            found = self.pile.capacity(np.array([self.length]))
        except UserError as error:
            return None, str(error)
        if not (found.outer_friction[0] or found.unit_bearing[0]):
            return None, "no t-z curve reacts"
        return found, ""

    @cached_property
    def shaft(self) -> tuple[Array, tuple[Term, ...]]:
        """Depths along the shaft, m, and the laws of t-z at them."""
        depth = self.length * (np.arange(_SAMPLES) + 0.5) / _SAMPLES
        return depth, self.pile.profile.shaft(depth, self.pile.diameter(depth)).laws
