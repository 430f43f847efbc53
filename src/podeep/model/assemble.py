"""From a foundation of the scene to its two independent problems: deflection and stretch.

At small displacements the two do not touch each other, so each is a system of its own, with its
own narrow band and its own convex energy.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..beam.shapes import gauss_points
from ..errors import Fault, UserError
from ..scene import Dof, Foundation, Scene
from ..soil.profile import Profile
from ..soil.reaction import Reaction
from .compression import compression
from .footing import Footing, footing
from .mesh import Stretch, stretches
from .needs import Needs
from .system import Points, Spring, System

#: How the soil acts: along each element, at its Gauss points, or as springs at its two ends, each
#: with half of the element's length.
Reactions = Literal["integrated", "lumped"]
# A spring stands just inside its element, in whose layer its curve lies.
_ENDS = (np.array([-1.0, 1.0]) * (1.0 - 1e-9), np.ones(2))

# Component of the deflection that a degree of freedom moves, its derivative, and its sign there.
_LATERAL: Mapping[Dof, tuple[int, int, float]] = {
    "X": (0, 0, 1.0),
    "Y": (1, 0, 1.0),
    "RX": (1, 1, 1.0),
    "RY": (0, 1, -1.0),
}


@dataclass(frozen=True)
class Problem:
    """One system with its loads: columns of `forces` and `imposed` belong to the named loads.

    forces, imposed: shape (names, unknowns); imposed values stand on held unknowns.
    """

    system: System
    forces: Array
    imposed: Array

    def load(self, factors: Array) -> Array:
        """Force vector of a step; factors has shape (names,) or (steps, names)."""
        return np.asarray(factors.dot(self.forces))

    def prescribed(self, factors: Array) -> Array:
        """Values of the held unknowns in a step, zero elsewhere."""
        return np.asarray(factors.dot(self.imposed))


@dataclass(frozen=True)
class Model:
    """The discrete model of one foundation: lateral and axial problem on one mesh."""

    foundation: Foundation
    needs: Needs
    pieces: tuple[Stretch, ...]
    profile: Profile
    lateral: Problem
    axial: Problem
    footing: Footing | None = None
    reactions: Reactions = "integrated"

    @property
    def edges(self) -> Array:
        return self.lateral.system.field.edges

    @property
    def elements(self) -> int:
        return len(self.edges) - 1


def cut(scene: Scene, foundation: Foundation, profile: Profile) -> tuple[Stretch, ...]:
    """The foundation's stretches of uniform section and soil layer."""
    tube = scene.tubes[foundation.tubes[0]]
    depths = [foundation.mudline - elevation for elevation in scene.marks(foundation)]
    return stretches(tube, foundation.mudline, profile, depths)


def assemble(
    scene: Scene,
    foundation: Foundation,
    needs: Needs,
    profile: Profile,
    pieces: Sequence[Stretch],
    boundaries: Array,
    degree: int,
    reactions: Reactions = "integrated",
) -> Model:
    """Build both problems on the given element boundaries with deflections of a degree."""
    middle = 0.5 * (boundaries[:-1] + boundaries[1:])
    piece = np.searchsorted([p.bottom for p in pieces], middle)
    section = [pieces[i].section for i in piece]
    bending = np.array([s.bending_stiffness for s in section])
    stretching = np.array([s.axial_stiffness for s in section])
    diameter = np.array([s.outer_diameter for s in section])
    slope_length = float(np.mean(np.diff(boundaries)))
    soft = np.array([s.shear_stiffness for s in section]) if needs.shear else None
    deflection = Field(boundaries, bending, degree, 1, slope_length, soft)
    stretch = Field(boundaries, stretching, degree - 1, 0)
    wet = np.flatnonzero(middle > 0.0)

    spudcan = scene.spudcan(foundation)
    under = footing(spudcan) if spudcan else None
    place = (scene, foundation, under)
    lateral = lateral_problem(*place, needs, deflection, profile, wet, diameter, reactions)
    axial = axial_problem(*place, stretch, profile, wet, diameter, reactions)
    return Model(foundation, needs, tuple(pieces), profile, lateral, axial, under, reactions)


def quadrature(boundaries: Array, elements: Index, count: int) -> tuple[Array, Array]:
    """Depths and weights (m) of the Gauss points of some elements, shape (elements * count,)."""
    return _spread(boundaries, elements, gauss_points(count))


def _spread(boundaries: Array, elements: Index, rule: tuple[Array, Array]) -> tuple[Array, Array]:
    xi, weight = rule
    half = 0.5 * np.diff(boundaries)[elements, None]
    x = boundaries[elements, None] + half * (xi + 1.0)
    return x.ravel(), (half * weight).ravel()


def in_soil(
    boundaries: Array, elements: Index, count: int, diameter: Array, reactions: Reactions
) -> tuple[Array, Array, Array]:
    """Depths, weights and diameters where the soil acts on elements below the mudline.

    An edge may stand off the mudline by a millimetre. diameter: of every element.
    """
    rule = gauss_points(count) if reactions == "integrated" else _ENDS
    x, weight = _spread(boundaries, elements, rule)
    return np.maximum(x, 0.0), weight, np.repeat(diameter[elements], len(rule[0]))


def lateral_problem(
    scene: Scene,
    foundation: Foundation,
    under: Footing | None,
    needs: Needs,
    field: Field,
    profile: Profile,
    wet: Index,
    diameter: Array,
    reactions: Reactions,
) -> Problem:
    """Deflection on p-y reactions, in one plane or two."""
    x, weight, width = in_soil(field.edges, wet, field.degree, diameter, reactions)
    reaction = profile.lateral(x, width)
    points = [Points(x, weight, reaction), *turning(profile, x, weight, width)]
    shear, moment = profile.base(float(field.edges[-1]), float(diameter[-1]))
    bases: tuple[tuple[Reaction, Motion], ...] = ((shear, "value"), (moment, "rotation"))
    for base, motion in bases:
        if base.laws:
            points.append(Points(field.edges[-1:], np.ones(1), base, motion, spread=False))
    if needs.second_order:
        every, share = quadrature(field.edges, np.arange(len(field.lengths)), field.degree)
        free = compression(np.zeros(len(every)))
        points.append(Points(every, share, free, "slope", compressed=True))
    if needs.components == 2 and not reaction.odd:
        raise UserError(
            Fault(
                f"{foundation.name}: a p-y curve with rows of negative displacement acts along one "
                "direction, but the loads or supports share no plane",
                "give all loads of the foundation one plane, or a curve without negative rows",
            )
        )
    collect = _Collector(scene, foundation, under, needs, field)
    system = System(field, needs.components, points, *collect.holds())
    return Problem(system, *collect.loads())


def turning(profile: Profile, x: Array, weight: Array, width: Array) -> list[Points]:
    """Moments against rotation at the points of p-y: those of their own, those that follow p."""
    whole = profile.moment(x, width)
    own = whole.part(lambda law: not law.follows_lateral)
    following = whole.part(lambda law: law.follows_lateral)
    both = (
        Points(x, weight, own, "rotation"),
        Points(x, weight, following, "rotation", follows=0),
    )
    return [points for points in both if points.reaction.laws]


def axial_problem(
    scene: Scene,
    foundation: Foundation,
    under: Footing | None,
    field: Field,
    profile: Profile,
    wet: Index,
    diameter: Array,
    reactions: Reactions,
) -> Problem:
    """Stretch on t-z reactions along the shaft and Q-z at the tip."""
    x, weight, width = in_soil(field.edges, wet, field.degree + 1, diameter, reactions)
    shaft = profile.shaft(x, width)
    points = [Points(x, weight, shaft)]
    if under is None:
        tip = profile.tip(float(field.edges[-1]), float(diameter[-1]))
        points.append(Points(field.edges[-1:], np.ones(1), tip, spread=False))
    collect = _Collector(scene, foundation, under, None, field)
    return Problem(System(field, 1, points, *collect.holds()), *collect.loads())


class _Collector:
    """Translates the scene's point data to unknowns of one field (axial where needs is None)."""

    def __init__(
        self,
        scene: Scene,
        foundation: Foundation,
        under: Footing | None,
        needs: Needs | None,
        field: Field,
    ) -> None:
        self.scene, self.field, self.under = scene, field, under
        self.mudline, self.tube = foundation.mudline, foundation.tubes[0]
        self.axes = needs.direction if needs else ()
        self.size = field.size * max(len(self.axes), 1)

    def unknowns(self, elevation: float, dof: Dof) -> list[tuple[int, float, float]]:
        """Unknowns that share in a degree of freedom.

        Each comes with the cosine between the two and with the length by which the unknown is
        scaled: the unknown is cosine * length * value, its force cosine / length * force.
        """
        node = self.field.node(self.mudline - elevation)
        if not self.axes:
            return [(node, -1.0, 1.0)] if dof == "Z" else []
        if dof not in _LATERAL:
            return []
        component, derivative, sign = _LATERAL[dof]
        length = self.field.slope_length if derivative else 1.0
        return [
            ((node + derivative) * len(self.axes) + c, sign * axis[component], length)
            for c, axis in enumerate(self.axes)
            if axis[component] != 0.0
        ]

    def holds(self) -> tuple[list[Spring], Index]:
        """Springs to ground and the held unknowns."""
        springs: list[Spring] = []
        held: set[int] = set()
        for spring in self.scene.springs:
            if spring.tube == self.tube:
                for unknown, cosine, length in self.unknowns(spring.elevation, spring.dof):
                    springs.append(Spring(unknown, spring.stiffness * (cosine / length) ** 2))
        if self.under is not None:
            tip = self.mudline - float(self.field.edges[-1])
            k1, k2, k3, _ = (float(k) for k in self.under.stiffness)
            sides: tuple[tuple[Dof, float], ...] = (
                *(("Z", k1), ("X", k2), ("Y", k2)),
                *(("RX", k3), ("RY", k3)),
            )
            for side, stiffness in sides:
                for unknown, cosine, length in self.unknowns(tip, side):
                    softens = side.startswith("R")
                    amount = stiffness * (cosine / length) ** 2
                    springs.append(Spring(unknown, amount, softens))
        for support in self.scene.supports:
            if support.tube == self.tube:
                for dof in support.dofs:
                    held.update(u for u, *_ in self.unknowns(support.elevation, dof))
        for d in self.scene.displacements:
            if d.tube == self.tube:
                held.update(u for u, *_ in self.unknowns(d.elevation, d.dof))
        return springs, np.array(sorted(held), dtype=np.intp)

    def loads(self) -> tuple[Array, Array]:
        """Forces and imposed values of each named load, shape (names, unknowns)."""
        names = self.scene.steps.names
        forces = np.zeros((len(names), self.size))
        imposed = np.zeros((len(names), self.size))
        moved: tuple[Dof, ...] = ("X", "Y", "Z", "RX", "RY")
        for load in self.scene.loads:
            if load.tube == self.tube:
                amounts = (*load.force, *load.moment[:2])
                for dof, amount in zip(moved, amounts, strict=True):
                    for unknown, cosine, length in self.unknowns(load.elevation, dof):
                        forces[names.index(load.name), unknown] += amount * cosine / length
        for d in self.scene.displacements:
            if d.tube == self.tube:
                for unknown, cosine, length in self.unknowns(d.elevation, d.dof):
                    imposed[names.index(d.name), unknown] += d.value * cosine * length
        return forces, imposed
