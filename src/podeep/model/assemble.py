"""From a foundation of the scene to its two independent problems: deflection and stretch.

At small displacements the two do not touch each other, so each is a system of its own, with its
own narrow band and its own convex energy.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..beam.shapes import gauss_points
from ..beam.strings import summed
from ..errors import Fault, UserError
from ..scene import Foundation, Scene
from ..soil.profile import Profile
from ..soil.reaction import Reaction
from .compression import compression
from .contact import Friction, Gap
from .contact import reaction as touching
from .footing import Footing, footing
from .holds import Collector
from .mesh import Stretch, stretches
from .needs import Decision, Needs
from .points import Points
from .system import System
from .weave import Parts, Touch, bound, lateral_links, parts, ties, touches, weave
from .weight import Weights, unit_weight

#: How the soil acts: along each element, at its Gauss points, or as springs at its two ends, each
#: with half of the element's length.
Reactions = Literal["integrated", "lumped"]
# A spring stands just inside its element, in whose layer its curve lies.
_ENDS = (np.array([-1.0, 1.0]) * (1.0 - 1e-9), np.ones(2))


@dataclass(frozen=True)
class Problem:
    """One system with its loads: columns of `forces` and `imposed` belong to the named loads.

    forces, imposed: shape (names, unknowns); imposed values stand on held unknowns. weights: where
    tubes weigh, in every step.
    """

    system: System
    forces: Array
    imposed: Array
    weights: tuple[Weights, ...] = ()

    @cached_property
    def dead(self) -> Array:
        """Force vector of the weights, shape (unknowns,)."""
        total = np.zeros(self.system.size)
        for w in self.weights:
            matrix = self.system.field.interpolation(w.x, 0, w.tube)
            total += matrix.T @ (w.share * w.force)
        return total

    def load(self, factors: Array) -> Array:
        """Force vector of a step; factors has shape (names,) or (steps, names)."""
        named = np.asarray(factors @ self.forces)
        return named + self.dead if self.weights else named

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
    parts: Parts
    lateral: Problem
    axial: Problem
    footing: Footing | None = None
    reactions: Reactions = "integrated"

    @property
    def edges(self) -> Array:
        return self.lateral.system.field.edges

    @property
    def elements(self) -> int:
        """Of the lateral problem."""
        return len(self.lateral.system.field.lengths)


def cut(scene: Scene, foundation: Foundation, profile: Profile) -> tuple[Stretch, ...]:
    """The foundation's stretches of uniform sections and soil layer."""
    tubes = [scene.tubes[tube] for tube in foundation.tubes]
    depths = [foundation.mudline - elevation for elevation in scene.marks(foundation)]
    depths += [foundation.mudline] if scene.numerics.weight else []  # sea level
    return stretches(tubes, foundation.mudline, profile, depths)


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
    owned, tied = parts(pieces, piece), ties(scene, foundation)
    found = touches(scene, foundation, pieces)
    bent = weave(pieces, piece, lateral_links(tied, found, pieces))
    stretched = weave(pieces, piece, tied)
    length = float(np.mean(np.diff(boundaries)))
    soft = summed(bent, owned.shearing) if needs.shear else None
    bending, stretching = summed(bent, owned.bending), summed(stretched, owned.stretching)
    deflection = Field(boundaries, bending, degree, 1, length, soft, bent)
    stretch = Field(boundaries, stretching, degree - 1, 0, woven=stretched)

    spudcan = scene.spudcan(foundation)
    under = footing(spudcan, foundation.tubes.index(spudcan.tube)) if spudcan else None
    soil = Soil(profile, owned, np.flatnonzero(middle > 0.0), reactions)
    meeting = contacts(found, piece)
    place = (scene, foundation, under)
    lateral = lateral_problem(*place, needs, deflection, soil, meeting)
    axial = axial_problem(*place, pieces, stretch, soil, meeting)
    told = needs.told(*tubes_as_one(foundation, found))
    return Model(foundation, told, tuple(pieces), profile, owned, lateral, axial, under, reactions)


def tubes_as_one(foundation: Foundation, found: Sequence[Touch]) -> Iterator[Decision]:
    """The tubes in contact that deflect as one."""
    for outer, inner in dict.fromkeys((t.outer, t.inner) for t in found if bound(t)):
        names = f"tubes {foundation.tubes[outer]} and {foundation.tubes[inner]}"
        yield Decision(f"{names} deflect as one", "no room and no friction between them")


@dataclass(frozen=True)
class Soil:
    """The soil around a mesh: intervals below the mudline, and the tubes that it acts on."""

    profile: Profile
    parts: Parts
    wet: Index
    reactions: Reactions

    def places(self, boundaries: Array, count: int) -> tuple[Array, Array, Array, Index]:
        """Depths, weights, diameters and numbers of the tubes where the soil acts.

        An edge may stand off the mudline by a millimetre.
        """
        rule = gauss_points(count) if self.reactions == "integrated" else _ENDS
        x, weight = _spread(boundaries, self.wet, rule)
        width = np.repeat(self.parts.width[self.wet], len(rule[0]))
        tube = np.repeat(self.parts.outermost[self.wet], len(rule[0]))
        return np.maximum(x, 0.0), weight, width, tube

    @property
    def tip(self) -> tuple[float, int]:
        """Diameter and number of the tube that reaches deepest."""
        return float(self.parts.width[-1]), int(self.parts.outermost[-1])


@dataclass(frozen=True)
class Contact:
    """Two tubes in contact over some intervals, and the touch of each interval."""

    intervals: Index
    touches: tuple[Touch, ...]

    @property
    def friction(self) -> float:
        return self.touches[0].contact.friction

    def points(self, boundaries: Array, count: int, *, along: bool) -> Points:
        """Where they press against each other or, along them, rub."""
        x, weight = quadrature(boundaries, self.intervals, count)
        one = self.touches[0]
        room, hard = (
            np.repeat([getattr(t, name) for t in self.touches], count)
            for name in ("clearance", "stiffness")
        )
        gap = Gap(hard, room, one.contact.tolerance)
        law: Gap | Friction = gap
        if along:
            law = Friction(self.friction, gap, one.contact.threshold, np.zeros(len(x)))
        return Points(x, weight, touching(law), tube=one.inner, against=one.outer)


def contacts(found: Sequence[Touch], piece: Index) -> list[Contact]:
    """Contacts of tubes that do not deflect as one, by their pairs."""
    pairs: dict[tuple[int, int], dict[int, Touch]] = {}
    for touch in found:
        if not bound(touch):
            pairs.setdefault((touch.outer, touch.inner), {})[touch.piece] = touch
    made = []
    for by_piece in pairs.values():
        intervals = np.flatnonzero(np.isin(piece, list(by_piece)))
        made.append(Contact(intervals, tuple(by_piece[i] for i in piece[intervals].tolist())))
    return made


def quadrature(boundaries: Array, intervals: Index, count: int) -> tuple[Array, Array]:
    """Depths and weights (m) of the Gauss points of some intervals, shape (intervals * count,)."""
    return _spread(boundaries, intervals, gauss_points(count))


def _spread(boundaries: Array, intervals: Index, rule: tuple[Array, Array]) -> tuple[Array, Array]:
    xi, weight = rule
    half = 0.5 * np.diff(boundaries)[intervals, None]
    x = boundaries[intervals, None] + half * (xi + 1.0)
    return x.ravel(), (half * weight).ravel()


def lateral_problem(
    scene: Scene,
    foundation: Foundation,
    under: Footing | None,
    needs: Needs,
    field: Field,
    soil: Soil,
    meeting: Sequence[Contact],
) -> Problem:
    """Deflection on p-y reactions, in one plane or two."""
    x, weight, width, tube = soil.places(field.edges, field.degree)
    reaction = soil.profile.lateral(x, width)
    own = Points(x, weight, reaction, tube=tube)
    points = [own, *turning(soil.profile, own, width)]
    widest, deepest = soil.tip
    shear, moment = soil.profile.base(float(field.edges[-1]), widest)
    bases: tuple[tuple[Reaction, Motion], ...] = ((shear, "value"), (moment, "rotation"))
    for base, motion in bases:
        if base.laws:
            end = (field.edges[-1:], np.ones(1), base, motion)
            points.append(Points(*end, tube=deepest, spread=False))
    if needs.second_order:
        strings = field.strings
        every, share = quadrature(field.edges, strings.interval, field.degree)
        free = compression(np.zeros(len(every)))
        leader = np.repeat(strings.leader, field.degree)
        points.append(Points(every, share, free, "slope", tube=leader, compressed=True))
    points += [contact.points(field.edges, field.degree, along=False) for contact in meeting]
    if needs.components == 2 and not reaction.odd:
        raise UserError(
            Fault(
                f"{foundation.name}: a p-y curve with rows of negative displacement acts along one "
                "direction, but the loads or supports share no plane",
                "give all loads of the foundation one plane, or a curve without negative rows",
            )
        )
    collect = Collector(scene, foundation, under, needs, field)
    system = System(field, needs.components, points, *collect.holds())
    return Problem(system, *collect.loads())


def turning(profile: Profile, lateral: Points, width: Array) -> list[Points]:
    """Moments against rotation at the points of p-y: those of their own, those that follow p."""
    whole = profile.moment(lateral.x, width)
    own = whole.part(lambda law: not law.follows_lateral)
    following = whole.part(lambda law: law.follows_lateral)
    both = (
        replace(lateral, reaction=own, motion="rotation"),
        replace(lateral, reaction=following, motion="rotation", follows=0),
    )
    return [points for points in both if points.reaction.laws]


def heavy(
    scene: Scene, foundation: Foundation, pieces: Sequence[Stretch], field: Field
) -> Iterator[Weights]:
    """The weight of each tube along it, down the stretch."""
    middle = 0.5 * (field.edges[:-1] + field.edges[1:])
    piece = np.searchsorted([p.bottom for p in pieces], middle)
    count = field.degree + 1
    for tube, carrier in enumerate(field.strings.carrier):
        there = np.flatnonzero(carrier >= 0)
        x, share = quadrature(field.edges, there, count)
        weights = [
            unit_weight(section, scene.sea, submerged=x_ > foundation.mudline)
            for x_, i in zip(middle[there], piece[there].tolist(), strict=True)
            for section in pieces[i].sections[tube : tube + 1]
            if section is not None
        ]
        yield Weights(x, share, np.repeat(weights, count), tube)


def axial_problem(
    scene: Scene,
    foundation: Foundation,
    under: Footing | None,
    pieces: Sequence[Stretch],
    field: Field,
    soil: Soil,
    meeting: Sequence[Contact],
) -> Problem:
    """Stretch on t-z reactions along the shaft and Q-z at the tip."""
    x, weight, width, tube = soil.places(field.edges, field.degree + 1)
    points = [Points(x, weight, soil.profile.shaft(x, width), tube=tube)]
    if under is None:
        widest, deepest = soil.tip
        tip = soil.profile.tip(float(field.edges[-1]), widest)
        points.append(Points(field.edges[-1:], np.ones(1), tip, tube=deepest, spread=False))
    rubbing = [c for c in meeting if c.friction]
    points += [c.points(field.edges, field.degree + 1, along=True) for c in rubbing]
    collect = Collector(scene, foundation, under, None, field)
    weights = heavy(scene, foundation, pieces, field) if scene.numerics.weight else ()
    system = System(field, 1, points, *collect.holds())
    return Problem(system, *collect.loads(), tuple(weights))
