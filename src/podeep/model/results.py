"""From unknowns to the quantities of the database, on any depths, for all steps at once."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field
from ..beam.rows import Rows
from ..beam.strings import summed
from ..scene import Section
from ..soil.reaction import Reaction
from .assemble import Model
from .moduli import secant
from .points import Points
from .recover import EndForces, Spread, end_forces, internal_forces


def axial_ends(model: Model, axial: Array, deflection: Array) -> EndForces:
    """End forces of the stretch for states of unknowns of both problems, (..., unknowns)."""
    system = model.axial.system
    count = system.field.degree + 1
    spread, end = [], 0
    felt = system.motions(axial.reshape(-1, axial.shape[-1]))[:, 0]
    felt = felt.reshape(*axial.shape[:-1], felt.shape[-1])
    for points in system.points:
        first, end = end, end + len(points.x)
        soil, rubbing = points.against is None, points.friction
        if not points.spread or (soil and model.reactions == "lumped"):
            continue
        u = felt[..., first:end]
        if rubbing is None:
            force = points.reaction.evaluate(u)[0]
        else:
            force = rubbing.pressed(apart(model, deflection, points)).force(u)
        spread += acting(system.field, points, force, count)
    for w in (w for w in model.axial.weights if w.spread):
        on = system.field.elements(w.x[::count], w.tube)
        spread.append(Spread(on, np.broadcast_to(-w.force, (*axial.shape[:-1], len(w.force)))))
    return end_forces(system.field, axial, spread, count)


def apart(model: Model, deflection: Array, points: Points) -> Array:
    """How far the axes of two tubes stand apart at points between them, (..., points), m."""
    system = model.lateral.system
    unknowns = deflection.reshape(*deflection.shape[:-1], -1, system.components)
    moved = product(np.moveaxis(unknowns, -1, 0), points.rows(system.field))
    return np.asarray(np.linalg.norm(moved, axis=0))


def acting(field: Field, points: Points, resistance: Array, count: int) -> list[Spread]:
    """What resists at points as it acts on the elements of their tube, and of the other one."""
    of = partial(field.elements, points.x[::count])
    tube = points.tube if isinstance(points.tube, int) else points.tube[::count]
    on = [Spread(of(tube), resistance, points.motion)]
    if points.against is not None:
        on.append(Spread(of(points.against), -resistance, points.motion))
    return on


def part_of(field: Field, amounts: Array, x: Array, tube: int) -> Array:
    """Share of a tube in the elements that it is part of at depths x, (len(x),).

    amounts: what shares are measured by, of each tube in each interval.
    """
    whole = summed(field.strings, amounts)
    element = field.elements(x, tube)
    return np.asarray(amounts[field.strings.interval[element], tube] / whole[element])


def tube_force(model: Model, ends: EndForces, x: Array, tube: int) -> Array:
    """Normal force of a tube at depths x, positive in compression, shape (..., len(x)), N.

    ends: of the stretch; tubes that stretch together share by their stiffness.
    """
    share = part_of(ends.field, model.parts.stretching, x, tube)
    return np.asarray(share * internal_forces(ends, x, tube)[0])


def joint_force(
    model: Model, ends: EndForces, lateral: Field, x: Array, tube: Index | int
) -> Array:
    """Normal force of all tubes that deflect with one (at each x), shape (..., len(x)), N.

    lateral: the deflection, whose mesh need not be that of the model.
    """
    element = lateral.elements(x, tube)
    interval = lateral.strings.interval[element]
    total = np.zeros((*ends.force.shape[:-1], len(x)))
    for other, carrier in enumerate(lateral.strings.carrier):
        there = np.flatnonzero(carrier[interval] == element)
        total[..., there] += tube_force(model, ends, x[there], other)
    return total


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

    @cached_property
    def _outer(self) -> tuple[Array, Index, Array]:
        """Bottom, outermost tube and its diameter of each stretch, (stretches,)."""
        pieces = self.model.pieces
        widths = np.array([p.section.outer_diameter for p in pieces])
        return np.array([p.bottom for p in pieces]), np.array([p.outermost for p in pieces]), widths

    def piece(self, x: Array) -> Index:
        """Stretch that holds each x; a shared end belongs to the one above it."""
        return self._outer[0][:-1].searchsorted(x, side="left")

    def outermost(self, x: Array) -> Index:
        """Number of the outermost tube at depths x, (len(x),)."""
        return self._outer[1][self.piece(x)]

    def sections(self, x: Array, tube: int) -> list[Section]:
        """Section of a tube at each of some depths that it reaches."""
        found = [self.model.pieces[i].sections[tube] for i in self.piece(x)]
        nearest = next(s for s in found if s is not None)
        return [nearest := s or nearest for s in found]

    def along(self, tube: int, x: Array) -> Array:
        """Those of some depths that a tube reaches."""
        edges, strings = self.model.edges, self.model.lateral.system.field.strings
        first, last = (int(r[tube]) for r in strings.reach)
        there = (x >= edges[first]) & (x <= edges[last + 1])
        return np.asarray(x[there])

    def of_all(self, value: Callable[[Array, int], Array], x: Array) -> Array:
        """Values of all tubes, one after the other, each at those of the depths that it reaches."""
        tubes = range(len(self.model.foundation.tubes))
        return np.concatenate([value(self.along(t, x), t) for t in tubes], axis=-1)

    def deflection(self, x: Array, derivative: int = 0, tube: int | None = None) -> Array:
        """Deflection (m) or slope d/dx by component, shape (steps, components, len(x)).

        tube: its number; None is the outermost at each depth.
        """
        which = self.outermost(x) if tube is None else tube
        matrix = self.model.lateral.system.field.interpolation(x, derivative, which)
        return product(self._components(), matrix)

    def rotation(self, x: Array, tube: int | None = None) -> Array:
        """Rotation of the section by component, shape (steps, components, len(x)), rad."""
        which = self.outermost(x) if tube is None else tube
        return product(self._components(), self.model.lateral.system.field.rotation(x, which))

    def settlement(self, x: Array, derivative: int = 0, tube: int | None = None) -> Array:
        """Axial displacement, positive down (m), or its strain d/dx, shape (steps, len(x))."""
        which = self.outermost(x) if tube is None else tube
        matrix = self.model.axial.system.field.interpolation(x, derivative, which)
        return product(self.axial, matrix)

    def diameter(self, x: Array) -> Array:
        """Diameter of the outermost tube at depths x, m; at a step of diameter that above it."""
        return self._outer[2][self.piece(x)]

    def lateral_reaction(self, x: Array) -> Array:
        """Soil reaction by component at embedded depths, shape (steps, components, len(x)), N/m."""
        return reacted(self.deflection(x), self.model.profile.lateral(x, self.diameter(x)))

    def axial_reaction(self, x: Array) -> Array:
        """Shaft reaction at embedded depths, shape (steps, len(x)), N/m."""
        reaction = self.model.profile.shaft(x, self.diameter(x))
        return reaction.evaluate(self.settlement(x))[0]

    def tip(self) -> tuple[Array, Array]:
        """Axial displacement (m) and reaction (N) of the tip, each of shape (steps,)."""
        depth = self.model.edges[-1:]
        u = self.settlement(depth)
        if self.model.footing is not None:
            return u[:, 0], self.model.footing.stiffness.vertical * u[:, 0]
        reaction = self.model.profile.tip(float(depth[0]), float(self.diameter(depth)[0]))
        return u[:, 0], reaction.evaluate(u)[0][:, 0]

    @cached_property
    def point_forces(self) -> list[Array]:
        """What resists at each set of points of the deflection, (steps, components, points)."""
        system = self.model.lateral.system
        found: list[Array] = []
        felt, end = system.motions(self.lateral), 0
        for points in system.points:
            first, end = end, end + len(points.x)
            u = felt[..., first:end]
            if points.compressed:
                found.append(-self._pressed(points.x, points.tube)[:, None] * u)
                continue
            reaction = reacted(u, points.reaction)
            if points.follows is not None:
                reaction *= np.linalg.norm(found[points.follows], axis=1)[:, None]
            found.append(reaction)
        return found

    @cached_property
    def _lateral_ends(self) -> list[EndForces]:
        system = self.model.lateral.system
        field, count = system.field, system.field.degree

        def ends(q: Array, component: int) -> EndForces:
            spread = []
            for points, force in zip(system.points, self.point_forces, strict=True):
                soil = points.against is None and not points.compressed
                if points.spread and not (soil and self.model.reactions == "lumped"):
                    spread += acting(field, points, force[:, component], count)
            return end_forces(field, q, spread, count)

        return [ends(q, c) for c, q in enumerate(np.moveaxis(self._components(), 1, 0))]

    @cached_property
    def _axial_ends(self) -> EndForces:
        return axial_ends(self.model, self.axial, self.lateral)

    def shear_and_moment(self, x: Array, tube: int = 0) -> tuple[Array, Array]:
        """Shear (N) and moment EI w'' (N m) by component, shape (steps, components, len(x)).

        The shear is the force across the tube, which soil against rotation and the normal force
        on the slope have a part in. Tubes that deflect together share by their stiffness.
        """
        field, parts = self.model.lateral.system.field, self.model.parts
        pairs = [internal_forces(ends, x, tube) for ends in self._lateral_ends]
        shear, moment = (np.stack(each, axis=1) for each in zip(*pairs, strict=True))
        bending = part_of(field, parts.bending, x, tube)
        soft = field.shear_stiffness is not None
        across = part_of(field, parts.shearing, x, tube) if soft else bending
        if self.model.needs.second_order and (bending < 1.0).any():
            slope = self.deflection(x, 1, tube)
            own = self.compression(x, tube)[:, None] * slope
            whole = self._pressed(x, tube)[:, None] * slope
            return across * (shear - whole) + own, bending * moment
        return across * shear, bending * moment

    def compression(self, x: Array, tube: int = 0) -> Array:
        """Normal force of a tube, positive in compression, shape (steps, len(x)), N."""
        return tube_force(self.model, self._axial_ends, x, tube)

    def _pressed(self, x: Array, tube: Index | int) -> Array:
        """Normal force of all tubes that deflect with one (at each x), (steps, len(x)), N."""
        field = self.model.lateral.system.field
        return joint_force(self.model, self._axial_ends, field, x, tube)

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


def product(unknowns: Array, matrix: Rows) -> Array:
    """Apply an interpolation matrix to the last axis of stacked unknowns."""
    flat = unknowns.reshape(-1, unknowns.shape[-1])
    return (matrix @ flat.T).T.reshape(*unknowns.shape[:-1], -1)
