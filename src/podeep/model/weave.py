"""Which tubes of a foundation move together, and what stiffness each has a part in.

Cemented tubes move together in every way. Where a tube slides in another without clearance and
without friction, rigidly, the two deflect together and stretch apart: no contact has to be found.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from ..beam.strings import Strings, chain, woven
from ..errors import Fault, UserError
from ..scene import Foundation, Scene, Section, Sliding
from .mesh import TOUCH, Stretch

_ENDS = 2.0  # length over which a rigid contact sets in, in diameters of the inner tube


@dataclass(frozen=True, slots=True)
class Link:
    """Two tubes by their numbers, the outer first, joined between two depths (m) or at both."""

    outer: int
    inner: int
    top: float
    bottom: float
    ends: bool

    def covers(self, piece: Stretch) -> bool:
        """Whether the two are one over all of a stretch."""
        middle = 0.5 * (piece.top + piece.bottom)
        return not self.ends and self.top < middle < self.bottom

    def at(self, depth: float) -> bool:
        """Whether the two are joined at a depth because the link ends there."""
        return min(abs(depth - self.top), abs(depth - self.bottom)) <= TOUCH


@dataclass(frozen=True, slots=True)
class Touch:
    """A sliding contact between two tubes by their numbers over a stretch that ties leave free.

    stiffness: of the contact, N/m2; of a rigid one such that the ends of a contact take up two
    diameters of the inner tube: softer than steel tubes are, and stiff enough for the deflection.
    """

    outer: int
    inner: int
    piece: int
    contact: Sliding
    clearance: float
    stiffness: float


def ties(scene: Scene, foundation: Foundation) -> list[Link]:
    """Links of both problems: those that the scene names."""
    number = {tube: i for i, tube in enumerate(foundation.tubes)}
    return [
        Link(
            number[t.outer],
            number[t.inner],
            foundation.mudline - t.top,
            foundation.mudline - t.bottom,
            t.ends,
        )
        for t in scene.ties
        if t.inner in number
    ]


def touches(scene: Scene, foundation: Foundation, pieces: Sequence[Stretch]) -> list[Touch]:
    """Contacts of tubes that slide in each other, stretch by stretch.

    Raises UserError where diameters shall tell the room between tubes that leave none.
    """
    number = {tube: i for i, tube in enumerate(foundation.tubes)}
    tied = ties(scene, foundation)
    found = []
    for contact in scene.slidings:
        if contact.inner not in number:
            continue
        outer, inner = number[contact.outer], number[contact.inner]
        for i, piece in enumerate(pieces):
            around, inside = piece.sections[outer], piece.sections[inner]
            if around is None or inside is None:
                continue
            groups = _groups(piece, tied)
            if groups[inner] == groups[outer]:
                continue
            room = 0.5 * (around.inner_diameter - inside.outer_diameter)
            if contact.clearance is None and room < 0.0:
                raise UserError(
                    Fault(
                        f"{foundation.name}: tube {contact.inner} of {inside.outer_diameter:g} m "
                        f"does not fit into tube {contact.outer}, {around.inner_diameter:g} m "
                        "inside",
                        "give its own GAP= in *TYPCONTACT, or tubes that fit",
                    )
                )
            clearance = room if contact.clearance is None else contact.clearance
            softer = min(around.bending_stiffness, inside.bending_stiffness)
            rigid = 4.0 * softer / (_ENDS * inside.outer_diameter) ** 4
            stiffness = rigid if contact.stiffness is None else contact.stiffness
            found.append(Touch(outer, inner, i, contact, clearance, stiffness))
    return found


def bound(touch: Touch) -> bool:
    """Whether two tubes in contact deflect as one."""
    contact = touch.contact
    return contact.stiffness is None and touch.clearance == 0.0 and contact.friction == 0.0


def lateral_links(
    tied: Sequence[Link], touching: Sequence[Touch], pieces: Sequence[Stretch]
) -> list[Link]:
    """Links of the deflection: ties, and contacts that bind."""
    binding = (
        Link(t.outer, t.inner, pieces[t.piece].top, pieces[t.piece].bottom, ends=False)
        for t in touching
        if bound(t)
    )
    return [*tied, *binding]


def weave(pieces: Sequence[Stretch], piece: Index, links: Sequence[Link]) -> Strings:
    """The elements of all tubes; piece: index of the stretch of each interval, rising."""
    if len(pieces[0].sections) == 1:
        return chain(len(piece))
    groups = np.array([_groups(p, links) for p in pieces])
    over = groups[piece]
    last = len(piece)
    above, below = over[np.r_[0, :last]], over[np.r_[:last, last - 1]]
    joined = below.copy()
    for edge in [0, *(np.flatnonzero(np.diff(piece)) + 1).tolist(), last]:
        depth = pieces[piece[edge]].top if edge < last else pieces[-1].bottom
        meeting = [(k.outer, k.inner) for k in links if k.at(depth)]
        for side in (above[edge], below[edge]):
            meeting += [(int(g), t) for t, g in enumerate(side) if g >= 0]
        there = np.maximum(above[edge], below[edge]) >= 0
        joined[edge] = _merged(there, [pair for pair in meeting if there[list(pair)].all()])
    return woven(over, joined)


def _groups(piece: Stretch, links: Iterable[Link]) -> Index:
    """The outermost of the tubes that each moves with in a stretch, -1 for one not there."""
    there = np.array([section is not None for section in piece.sections])
    together = [(k.outer, k.inner) for k in links if k.covers(piece)]
    return _merged(there, [pair for pair in together if there[list(pair)].all()])


def _merged(there: Array, pairs: Iterable[tuple[int, int]]) -> Index:
    """Smallest number of those connected to each by pairs; -1 for those not there."""
    label = np.where(there, np.arange(len(there)), -1)
    for a, b in pairs:
        one, other = sorted((label[a], label[b]))
        label[label == other] = one
    return label


@dataclass(frozen=True, eq=False)
class Parts:
    """Stiffness of each tube in each interval, (intervals, tubes); 0 where a tube is not.

    bending: EI, N m2. stretching: EA, N. shearing: GAs, N. outermost: its number, (intervals,).
    width: its diameter, m.
    """

    bending: Array
    stretching: Array
    shearing: Array
    outermost: Index
    width: Array


def parts(pieces: Sequence[Stretch], piece: Index) -> Parts:
    """What the tubes of each interval have; piece: index of its stretch."""

    def of(name: str) -> Array:
        def one(section: Section | None) -> float:
            return 0.0 if section is None else float(getattr(section, name))

        return np.array([[one(s) for s in p.sections] for p in pieces])[piece]

    return Parts(
        of("bending_stiffness"),
        of("axial_stiffness"),
        of("shear_stiffness"),
        np.array([p.outermost for p in pieces])[piece],
        np.array([p.section.outer_diameter for p in pieces])[piece],
    )
