"""From unknowns to the quantities of the database, on any depths, for all steps at once."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..soil.reaction import Reaction
from .assemble import Model
from .recover import EndForces, end_forces, inside, internal_forces
from .system import secant


def axial_ends(model: Model, axial: Array) -> EndForces:
    """End forces of the stretch for states of unknowns, shape (..., unknowns)."""
    system = model.axial.system
    shaft = system.points[0]
    if model.reactions == "lumped":  # springs at the ends of an element are no load inside it
        return end_forces(system.field, axial, np.zeros((*axial.shape[:-1], 0)), np.zeros(0, int))
    states = axial.reshape(-1, axial.shape[-1])
    u = system.motions(states)[:, 0, : len(shaft.x)].reshape(*axial.shape[:-1], -1)
    soil = shaft.reaction.evaluate(u)[0]
    return end_forces(system.field, axial, soil, embedded(system.field))


def compression(model: Model, axial: Array, x: Array) -> Array:
    """Normal force at depths x, positive in compression, shape (..., len(x)), N."""
    return internal_forces(axial_ends(model, axial), x)[0]


@dataclass(frozen=True)
class Results:
    """States of one model: unknowns of its two problems, shape (steps, unknowns)."""

    model: Model
    lateral: Array
    axial: Array

    @cached_property
    def directions(self) -> Array:
        """Unit vectors of the lateral components, shape (components, 2)."""
        return np.array(self.model.needs.direction)

    def _components(self) -> Array:
        """Lateral unknowns by component, shape (steps, components, n)."""
        count = self.model.needs.components
        return np.moveaxis(self.lateral.reshape(len(self.lateral), -1, count), 2, 1)

    def deflection(self, x: Array, derivative: int = 0) -> Array:
        """Deflection (m) or slope d/dx by component, shape (steps, components, len(x))."""
        matrix = self.model.lateral.system.field.interpolation(x, derivative)
        return product(self._components(), matrix)

    def rotation(self, x: Array) -> Array:
        """Rotation of the section by component, shape (steps, components, len(x)), rad."""
        return product(self._components(), self.model.lateral.system.field.rotation(x))

    def settlement(self, x: Array, derivative: int = 0) -> Array:
        """Axial displacement, positive down (m), or its strain d/dx, shape (steps, len(x))."""
        return product(self.axial, self.model.axial.system.field.interpolation(x, derivative))

    def diameter(self, x: Array) -> Array:
        """Outer diameter of the tube at depths x, m; at a step of diameter that above it."""
        bottoms = np.array([p.bottom for p in self.model.pieces[:-1]])
        widths = np.array([p.section.outer_diameter for p in self.model.pieces])
        return np.asarray(widths[np.searchsorted(bottoms, x, side="left")])

    def lateral_reaction(self, x: Array) -> Array:
        """Soil reaction by component at embedded depths, shape (steps, components, len(x)), N/m."""
        return reacted(self.deflection(x), self.model.profile.lateral(x, self.diameter(x)))

    def axial_reaction(self, x: Array) -> Array:
        """Shaft reaction at embedded depths, shape (steps, len(x)), N/m."""
        reaction = self.model.profile.shaft(x, self.diameter(x))
        return reaction.evaluate(self.settlement(x))[0]

    def tip(self) -> tuple[Array, Array]:
        """Axial displacement (m) and reaction (N) of the tip, each of shape (steps,)."""
        field = self.model.axial.system.field
        depth = field.edges[-1:]
        u = self.settlement(depth)
        if self.model.footing is not None:
            return u[:, 0], self.model.footing.stiffness.vertical * u[:, 0]
        reaction = self.model.profile.tip(float(depth[0]), float(self.diameter(depth)[0]))
        return u[:, 0], reaction.evaluate(u)[0][:, 0]

    @cached_property
    def _lateral_ends(self) -> list[EndForces]:
        system = self.model.lateral.system
        wet = embedded(system.field)
        found: list[Array] = []
        felt, end = system.motions(self.lateral), 0
        for points in system.points:
            first, end = end, end + len(points.x)
            u = felt[..., first:end]
            if points.compressed:
                found.append(-self.compression(points.x)[:, None] * u)
                continue
            reaction = reacted(u, points.reaction)
            if points.follows is not None:
                reaction *= np.linalg.norm(found[points.follows], axis=1)[:, None]
            found.append(reaction)

        def total(motion: Motion) -> Array | None:
            """Moments along the tube against a motion, (steps, components, n)."""
            pairs = zip(system.points, found, strict=True)
            moments = [r for p, r in pairs if p.spread and p.motion == motion]
            return np.sum(moments, axis=0) if moments else None

        turning, swaying, soil = total("rotation"), total("slope"), found[0]
        if self.model.reactions == "lumped":
            soil, turning = np.zeros((*soil.shape[:2], len(wet) * system.field.degree)), None
        return [
            end_forces(
                system.field,
                q,
                soil[:, c],
                wet,
                None if turning is None else turning[:, c],
                None if swaying is None else swaying[:, c],
            )
            for c, q in enumerate(np.moveaxis(self._components(), 1, 0))
        ]

    @cached_property
    def _axial_ends(self) -> EndForces:
        return axial_ends(self.model, self.axial)

    def shear_and_moment(self, x: Array) -> tuple[Array, Array]:
        """Shear (N) and moment EI u'' (N m) by component, shape (steps, components, len(x)).

        The shear is the force across the tube: EI u''' less what the soil resists to rotation.
        """
        pairs = [internal_forces(ends, x) for ends in self._lateral_ends]
        return np.stack([p[0] for p in pairs], axis=1), np.stack([p[1] for p in pairs], axis=1)

    def compression(self, x: Array) -> Array:
        """Normal force, positive in compression, shape (steps, len(x)), N."""
        return internal_forces(self._axial_ends, x)[0]

    def moment_inside(self, xi: Array) -> Array:
        """Moment at the places xi (-1 to 1) of every element, as `shear_and_moment` gives it.

        Shape (steps, components, elements, len(xi)), N m.
        """
        return np.stack([inside(ends, xi)[1] for ends in self._lateral_ends], axis=1)

    def compression_inside(self, xi: Array) -> Array:
        """Normal force at the places xi of every element, shape (steps, elements, len(xi)), N."""
        return inside(self._axial_ends, xi)[0]

    def global_vector(self, components: Array) -> tuple[Array, Array]:
        """x and y parts of a lateral quantity given by component, shape (steps, n) each."""
        vector = np.einsum("scn,cd->dsn", components, self.directions)
        return vector[0], vector[1]


def reacted(u: Array, reaction: Reaction) -> Array:
    """Reaction by component to motions u of one component or two, shape (steps, components, n)."""
    if u.shape[1] == 1:
        return reaction.evaluate(u[:, 0])[0][:, None]
    distance = np.hypot(u[:, 0], u[:, 1])
    force, modulus = reaction.evaluate(distance)
    return np.asarray(secant(force, distance, modulus)[:, None] * u)


def embedded(field: Field) -> Index:
    """Elements below the mudline."""
    return np.flatnonzero(field.edges[1:] > 1e-6)


def product(unknowns: Array, matrix: sparse.csr_array) -> Array:
    """Apply an interpolation matrix to the last axis of stacked unknowns."""
    flat = unknowns.reshape(-1, unknowns.shape[-1])
    return np.asarray((matrix @ flat.T).T).reshape(*unknowns.shape[:-1], -1)
