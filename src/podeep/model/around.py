"""What acts on tubes from around them, as points of reaction: soil, other tubes, their weight."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field
from ..beam.shapes import gauss_points
from ..scene import Foundation, Scene
from ..soil.profile import Profile
from .contact import Friction, Gap
from .contact import reaction as touching
from .mesh import Stretch
from .points import Points
from .weave import Parts, Touch, bound
from .weight import Weights, unit_weight

#: How the soil acts: along each element, at its Gauss points, or as springs at its two ends, each
#: with half of the element's length.
Reactions = Literal["integrated", "lumped"]
# A spring stands just inside its element, in whose layer its curve lies.
_ENDS = (np.array([-1.0, 1.0]) * (1.0 - 1e-9), np.ones(2))


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
    """The weight of each tube along it, down the stretch, and of the masses on it."""
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
    for mass in scene.masses:
        if mass.tube in foundation.tubes:
            place = min(mass.elevation, scene.tubes[mass.tube].top)
            at, force = foundation.mudline - place, mass.mass * scene.sea.gravity
            tube = foundation.tubes.index(mass.tube)
            yield Weights(np.array([at]), np.ones(1), np.array([force]), tube, spread=False)
