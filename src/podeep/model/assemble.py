"""From a foundation of the scene to its two independent problems: deflection and stretch.

At small displacements the two do not touch each other, so each is a system of its own, with its
own narrow band and its own convex energy.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array
from ..beam.field import Field, Motion
from ..beam.strings import summed
from ..errors import Fault, UserError
from ..scene import Foundation, Scene
from ..soil.profile import Profile
from ..soil.reaction import Reaction
from .around import Contact, Reactions, Soil, contacts, heavy, quadrature, turning
from .compression import compression
from .footing import Footing, footing
from .holds import Collector
from .mesh import Stretch, stretches
from .needs import Decision, Needs
from .points import Points
from .system import System
from .weave import Parts, Touch, bound, lateral_links, parts, ties, touches, weave
from .weight import Weights


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
            rows = self.system.field.interpolation(w.x, 0, w.tube)
            np.add.at(total, rows.dofs, rows.shares * (w.share * w.force)[:, None])
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
    water = any(s.added_mass_coefficient for tube in tubes for s in tube.sections)
    depths += [foundation.mudline] if scene.numerics.weight or water else []  # sea level
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
    links = lateral_links(tied, found, pieces)
    bent = weave(pieces, piece, links)
    stretched = bent if links == tied else weave(pieces, piece, tied)
    length = float(np.mean(np.diff(boundaries)))
    soft = summed(bent, owned.shearing) if needs.shear else None
    bending, stretching = summed(bent, owned.bending), summed(stretched, owned.stretching)
    deflection = Field(boundaries, bending, degree, 1, length, soft, bent)
    stretch = Field(boundaries, stretching, degree - 1, 0, woven=stretched)

    spudcan = scene.spudcan(foundation)
    if spudcan and scene.tubes[spudcan.tube].tip > scene.tip(foundation):
        raise UserError(
            Fault(
                f"{foundation.name}: the spudcan stands under tube {spudcan.tube}, but another "
                "tube reaches deeper",
                "put it under the tube that reaches deepest",
            )
        )
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
