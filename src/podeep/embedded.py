"""The outermost tube of a foundation in its ground, and what that bears with the tip at a depth."""

from dataclasses import dataclass
from functools import cached_property
from math import floor, inf, log10
from typing import cast

import numpy as np

from .arrays import Array
from .demand import Demand
from .scene import Foundation, Scene, Tube
from .soil.axial_capacity import PileCapacity, Plug, axial_capacity
from .soil.profile import Profile, profile_of
from .soil.required_length import RequiredLength, required_length

_ROWS = 40  # of equal spacing in a table, at most; half at least
_SAME = 1e-9  # ratio of what counts as no jump
_CLOSE = 1e-6  # depths of one row, m
_DEVELOPED = 3.0  # diameters of penetration at which end bearing has surely developed


@dataclass(frozen=True)
class Pile:
    """The outermost tube of a foundation in its ground."""

    scene: Scene
    foundation: Foundation

    @cached_property
    def tube(self) -> Tube:
        return self.scene.tubes[self.foundation.tubes[0]]

    @cached_property
    def length(self) -> float:
        """Embedded, m."""
        return self.foundation.mudline - self.tube.tip

    @cached_property
    def profile(self) -> Profile:
        return profile_of(self.scene, self.foundation, axial=True)

    @cached_property
    def changes(self) -> Array:
        """Depths at which one section of the tube follows another, m."""
        return np.array([self.foundation.mudline - s.bottom for s in self.tube.sections[:-1]])

    def diameter(self, depth: Array) -> Array:
        widths = np.array([s.outer_diameter for s in self.tube.sections])
        return np.asarray(widths[self.changes.searchsorted(depth)])

    @cached_property
    def plug(self) -> Plug:
        """The option PLUG of the t-z curve at the tip, of the one with the greater share."""
        tip = np.array([self.length])
        terms = self.profile.shaft(tip, self.diameter(tip)).laws
        if not terms:
            return "AUTO"
        weights = [1.0 if t.weight is None else float(t.weight[0]) for t in terms]
        curve = self.scene.ground.axial_curves[terms[int(np.argmax(weights))].curves[0]]
        return cast(Plug, curve.options.get("plug", "AUTO"))

    @cached_property
    def _water(self) -> tuple[float, float]:
        """What weights in water rest on: density (kg/m3) and gravity (m/s2)."""
        return self.scene.sea.density, self.scene.sea.gravity

    def capacity(self, depths: Array) -> PileCapacity:
        """With the tip at depths, m."""
        density, gravity = self._water
        return axial_capacity(
            self.profile,
            self.tube.sections,
            depths,
            plug=self.plug,
            water_density=density,
            gravity=gravity,
            mudline=self.foundation.mudline,
        )

    def required(self, load: Demand, safety: float, longest: float) -> RequiredLength:
        density, gravity = self._water
        return required_length(
            self.profile,
            self.tube.sections,
            longest,
            compression=load.compression,
            tension=load.tension,
            compression_safety=safety,
            tension_safety=safety,
            plug=self.plug,
            water_density=density,
            gravity=gravity,
            mudline=self.foundation.mudline,
        )

    def table(self, end: float, most: int = _ROWS) -> PileCapacity:
        """At round depths down to an end, at the tip, and on both sides of every jump."""
        changes = np.union1d(self.profile.boundaries, self.changes)
        changes = changes[(changes > 0.0) & (changes < end)]
        if not len(changes):
            return self.capacity(rows(end, self.length, changes, most))
        above, below = (
            np.array([c.unit_friction, c.unit_bearing, c.wall_bearing])
            for c in (self.capacity(changes), self.capacity(np.nextafter(changes, inf)))
        )
        jumps = changes[(np.abs(above - below) > _SAME * np.abs(above)).any(axis=0)]
        return self.capacity(rows(end, self.length, jumps, most))

    def young_bearing(self, tip: float) -> float | None:
        """How far a tip stands in a layer whose end bearing has not developed, m; None: it has."""
        top = max((z for z in self.profile.boundaries if z < tip), default=0.0)
        if tip - top >= _DEVELOPED * float(self.diameter(np.array([tip]))[0]):
            return None
        above, below = self.capacity(np.array([top, np.nextafter(top, inf)])).unit_bearing
        return tip - top if below > (1.0 + _SAME) * (above if top else 0.0) else None


def rows(end: float, tip: float, jumps: Array, most: int = _ROWS) -> Array:
    """Depths of a table: round ones, `most` at most, its end, the tip, both sides of jumps."""
    decade = 10.0 ** floor(log10(end / most))
    spacings = [s * decade for s in (1.0, 2.0, 2.5, 5.0, 10.0)]
    spacing = next((s for s in spacings if end <= most * s * (1.0 + _SAME)), 20.0 * decade)
    regular = spacing * np.arange(floor(end / spacing + _SAME) + 1)
    special = np.concatenate(([tip, end], jumps, np.nextafter(jumps, inf)))
    apart = np.abs(regular[:, None] - special).min(axis=1) > _CLOSE
    return np.union1d(np.round(regular[apart], 9), special)
