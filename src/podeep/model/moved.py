"""Results of states in motion: the soil's motion has an origin of its own, and mass resists."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array
from ..beam.field import Field
from ..beam.shapes import gauss_interpolation, gauss_points
from ..beam.strings import summed
from .inertia import Inertia
from .points import Points
from .recover import EndForces, Spread, end_forces
from .results import Results, acting, reacted


@dataclass(frozen=True)
class Way:
    """How one problem moves: unknowns, velocities and accelerations, (steps, unknowns) each.

    origin: unknowns from which the soil's motion counts, (unknowns,). resisted: what the soil
    resists at the points beside what it does at the end of statics, (steps, points), in two planes
    (steps, 2, points), where that depends on the way.
    """

    q: Array
    velocity: Array
    acceleration: Array
    origin: Array
    resisted: Array | None = None


@dataclass(frozen=True)
class Viscosity:
    """Rayleigh's factors, 1/s and s, and the soil's dashpots at the points of p-y, N s/m2."""

    mass_factor: float
    stiffness_factor: float
    dashpots: Array


@dataclass(frozen=True)
class Moved(Results):
    """States of a model in motion.

    still: that at the end of statics, with what the soil resists there; None where the soil's
    motion counts from rest. shown: what it resists is part of the soil's reaction. Internal forces
    are in balance with mass and damping: they hold what the damping of the tubes takes.
    """

    deflecting: Way
    stretching: Way
    inertia: Inertia
    viscosity: Viscosity
    still: Results | None
    shown: bool

    def _behind(self, name: str, x: Array) -> Array | float:
        """What the soil resists at the end of statics, as far as it is shown."""
        return getattr(self.still, name)(x) if self.still is not None and self.shown else 0.0

    def lateral_reaction(self, x: Array) -> Array:
        if self.deflecting.resisted is not None:
            found = self._between(self.model.lateral.system.points[0], self.deflecting.resisted, x)
            return found.reshape(len(found), -1, len(x)) + self._behind("lateral_reaction", x)
        reaction = self.model.profile.lateral(x, self.diameter(x))
        moved = self.deflection(x) - self._from(self.deflecting.origin).deflection(x)
        return reacted(moved, reaction) + self._behind("lateral_reaction", x)

    def axial_reaction(self, x: Array) -> Array:
        if self.stretching.resisted is not None:
            found = self._between(self.model.axial.system.points[0], self.stretching.resisted, x)
            return found + self._behind("axial_reaction", x)
        reaction = self.model.profile.shaft(x, self.diameter(x))
        moved = self.settlement(x) - self._from(axial=self.stretching.origin).settlement(x)
        return reaction.evaluate(moved)[0] + self._behind("axial_reaction", x)

    def tip(self) -> tuple[Array, Array]:
        depth, moved = self.model.edges[-1:], self._from(axial=self.stretching.origin)
        if self.model.footing is not None or self.still is None:
            return super().tip()
        u = self.settlement(depth)
        if self.stretching.resisted is not None:
            return u[:, 0], self.stretching.resisted[:, -1] + self._still_tip()
        reaction = self.model.profile.tip(float(depth[0]), float(self.diameter(depth)[0]))
        force = reaction.evaluate(u - moved.settlement(depth))[0][:, 0]
        return u[:, 0], force + self._still_tip()

    def _still_tip(self) -> Array | float:
        return self.still.tip()[1] if self.still is not None and self.shown else 0.0

    def _between(self, points: Points, values: Array, x: Array) -> Array:
        """Values at Gauss points, (..., points), by their polynomials at depths x."""
        edges = self.model.edges
        interval = np.clip(np.searchsorted(edges, x, side="left") - 1, 0, len(edges) - 2)
        first = int(np.searchsorted(edges, points.x[0], side="left")) - 1
        count = len(points.x) // (len(edges) - 1 - first)
        middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
        shares = gauss_interpolation((x - middle[interval]) / half[interval], count)
        place = (interval - first)[:, None] * count + np.arange(count)
        return np.asarray(np.einsum("xg,...xg->...x", shares, values[..., np.maximum(place, 0)]))

    def _from(self, lateral: Array | None = None, axial: Array | None = None) -> Results:
        """One state of the model, at rest where it is not given."""
        rest = np.zeros_like(self.lateral[:1]), np.zeros_like(self.axial[:1])
        return Results(
            self.model,
            rest[0] if lateral is None else lateral[None],
            rest[1] if axial is None else axial[None],
        )

    @cached_property
    def point_forces(self) -> list[Array]:
        system = self.model.lateral.system
        felt = system.motions(self.lateral - self.deflecting.origin)
        resisted = self.deflecting.resisted
        whole, speed = (system.motions(v) for v in (self.lateral, self.deflecting.velocity))
        still = None if self.still is None else self.still.point_forces
        found: list[Array] = []
        end = 0
        for place, points in enumerate(system.points):
            first, end = end, end + len(points.x)
            if points.compressed:
                pressed = self._pressed(points.x, points.tube)[:, None]
                found.append(-pressed * whole[..., first:end])
                continue
            if resisted is None:
                force = reacted(felt[..., first:end], points.reaction)
            else:
                force = resisted.reshape(len(resisted), -1, resisted.shape[-1])[..., first:end]
            if points.follows is not None:
                force *= np.linalg.norm(found[points.follows], axis=1)[:, None]
            if still is not None:
                force = force + still[place]
            if place == 0:
                force = force + self.viscosity.dashpots * speed[..., first:end]
            found.append(force)
        return found

    @cached_property
    def _lateral_ends(self) -> list[EndForces]:
        system, way = self.model.lateral.system, self.deflecting
        field, count, m = system.field, system.field.degree, system.components
        strained = self.lateral + self.viscosity.stiffness_factor * way.velocity
        pulled = way.acceleration + self.viscosity.mass_factor * way.velocity
        heavy = summed(field.strings, self.inertia.lateral)

        def parts(unknowns: Array) -> Array:
            return np.moveaxis(unknowns.reshape(len(unknowns), -1, m), 2, 0)

        found = []
        for c, (q, a) in enumerate(zip(parts(strained), parts(pulled), strict=True)):
            spread = [self._inertial(field, a, heavy, count)]
            for points, force in zip(system.points, self.point_forces, strict=True):
                if points.spread:
                    spread += acting(field, points, force[:, c], count)
            found.append(end_forces(field, q, spread, count))
        return found

    @cached_property
    def _axial_ends(self) -> EndForces:
        system, way = self.model.axial.system, self.stretching
        field, count = system.field, system.field.degree + 1
        strained = self.axial + self.viscosity.stiffness_factor * way.velocity
        pulled = way.acceleration + self.viscosity.mass_factor * way.velocity
        heavy = summed(field.strings, self.inertia.axial)
        spread = [self._inertial(field, pulled, heavy, count)]
        felt = system.motions(self.axial - way.origin)[:, 0]
        resisting = system.react(felt)[0] if way.resisted is None else way.resisted
        if self.still is not None:
            rest = self.still.model.axial.system
            resisting = resisting + rest.react(rest.motions(self.still.axial)[:, 0])[0]
        end = 0
        for points in system.points:
            first, end = end, end + len(points.x)
            if points.spread:
                spread += acting(field, points, resisting[:, first:end], count)
        for w in self.model.axial.weights:
            on = field.elements(w.x[::count], w.tube)
            spread.append(Spread(on, np.broadcast_to(-w.force, (len(self.axial), len(w.force)))))
        return end_forces(field, strained, spread, count)

    @staticmethod
    def _inertial(field: Field, pulled: Array, heavy: Array, count: int) -> Spread:
        """What the mass of all elements resists with, at the Gauss points of each."""
        half = 0.5 * field.lengths[:, None]
        x = (field.tops[:, None] + half * (gauss_points(count)[0] + 1.0)).ravel()
        tube = np.repeat(field.strings.leader, count)
        moved = (field.interpolation(x, 0, tube) @ pulled.T).T
        return Spread(np.arange(len(field.lengths)), moved * np.repeat(heavy, count))
