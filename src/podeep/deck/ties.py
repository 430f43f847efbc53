"""The paragraphs of tubes that stand in each other: *SLAVE and *TYPCONTACT."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from ..errors import Place
from ..scene import Foundation, Sliding, Tie, Tube
from .actions import Actions
from .cells import Values, read_lines
from .faults import Faults
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Paragraph
from .structure import ReadTube

_TOLERANCE = 1e-4  # penetration over which a contact takes hold, m


@dataclass(slots=True)
class Ties:
    """Ties and sliding contacts of all foundations, and what was assumed."""

    ties: tuple[Tie, ...] = ()
    slidings: tuple[Sliding, ...] = ()
    notes: list[str] = field(default_factory=list)


def read_ties(
    slaves: Sequence[Paragraph],
    contacts: Sequence[Paragraph],
    shared: Mapping[str, float],
    foundations: Sequence[Foundation],
    tubes: Registry[ReadTube],
    actions: Actions,
    faults: Faults,
) -> Ties:
    """How the tubes of each foundation hold each other.

    shared: what *CONTACT gives. foundations: empty where one is at fault, so that what refers to
    its tubes is no second fault.
    """
    before = len(faults.found)
    found = Ties()
    homes = {igr: f for f in foundations for igr in f.tubes}
    sound = {igr: t.tube for igr, t in tubes.sound.items() if t.tube is not None}
    where: dict[tuple[int, int], Place] = {}
    ties: list[Tie] = []
    for values in _lines("SLAVE", slaves, faults):
        outer, inner = _pair(values, "OUTER", "INNER", homes, tubes, faults)
        if outer is not None and inner is not None and {outer, inner} <= sound.keys():
            tie = _tie(values, sound[outer], sound[inner], faults)
            ties += [tie] if tie else []
            where.setdefault((outer, inner), values.places["HOW"])
    slidings: list[Sliding] = []
    for values in _lines("TYPCONTACT", contacts, faults):
        outer, inner = _pair(values, "IGR1", "IGR2", homes, tubes, faults)
        if outer is not None and inner is not None:
            slidings.append(_sliding(values, outer, inner, shared))
            found.notes += _unused(values)
    if len(faults.found) > before or not sound.keys() >= homes.keys():
        return found
    for foundation in foundations:
        _complete(foundation, sound, ties, slidings, found.notes)
    sliding = {(s.outer, s.inner) for s in slidings}
    for tie in ties:
        pair = (tie.outer, tie.inner)
        if tie.ends and pair not in sliding:
            faults.add(
                where[pair],
                f"tubes {tie.outer} and {tie.inner} are tied at their ends alone, and no contact "
                "between is defined",
                f"add *TYPCONTACT with the line {tie.outer} {tie.inner} 2",
            )
    held = {t.inner for t in ties}
    for one in slidings:
        reach = sound[one.inner].tip < sound[one.outer].tip
        if one.inner not in held and not (reach or actions.act_axially_on((one.inner,))):
            place = contacts[0].place
            message = f"tube {one.inner} slides in tube {one.outer} and nothing holds it along z"
            faults.add(place, message, f"add *SLAVE with the line {one.outer} {one.inner} ENDS")
    found.ties, found.slidings = tuple(ties), tuple(slidings)
    return found


def _lines(keyword: str, paragraphs: Sequence[Paragraph], faults: Faults) -> Iterator[Values]:
    for paragraph in paragraphs:
        for values in read_lines(paragraph, KEYWORDS[keyword], faults):
            if values.sound:
                yield values


def _pair(
    values: Values,
    outer: str,
    inner: str,
    homes: Mapping[int, Foundation],
    tubes: Registry[ReadTube],
    faults: Faults,
) -> tuple[int | None, int | None]:
    """The two tubes of a line; None where they do not stand in each other, which is told."""
    ids = tuple(values.cells[name] for name in (outer, inner))
    places = [values.places[name] for name in (outer, inner)]
    known = [tubes.get(i, place) for i, place in zip(ids, places, strict=True)]
    if None in known or not homes:
        return None, None
    one, other = homes.get(ids[0]), homes.get(ids[1])
    if one is None or one is not other or ids[0] == ids[1]:
        message = f"tubes {ids[0]} and {ids[1]} are not two tubes of one foundation"
        faults.add(places[1], message, "name both in one line of *FONDATION")
        return None, None
    if one.tubes.index(ids[0]) > one.tubes.index(ids[1]):
        message = f"tube {ids[0]} stands inside tube {ids[1]} by *FONDATION"
        faults.add(places[0], message, f"give the outer tube first: {ids[1]} {ids[0]}")
        return None, None
    return ids[0], ids[1]


def _tie(values: Values, outer: Tube, inner: Tube, faults: Faults) -> Tie | None:
    top, bottom = min(outer.top, inner.top), max(outer.tip, inner.tip)
    if not top > bottom:
        message = f"tubes {outer.id} and {inner.id} have no elevation in common"
        faults.add(values.place, message, "tie tubes that stand in each other")
        return None
    first, last = values.cells.get("ZTOP", top), values.cells.get("ZBOT", bottom)
    for name, z in (("ZTOP", first), ("ZBOT", last)):
        if not bottom <= z <= top:
            message = f"{name} is {z:g} m, but both tubes stand from {top:g} to {bottom:g} m alone"
            faults.add(values.places[name], message, "give an elevation from sea level, on both")
            return None
    if not first > last:
        message = f"ZTOP {first:g} m is not above ZBOT {last:g} m"
        faults.add(values.place, message, "give the top first, as elevations from sea level")
        return None
    return Tie(outer.id, inner.id, first, last, values.cells["HOW"] == "ENDS")


def _sliding(values: Values, outer: int, inner: int, shared: Mapping[str, float]) -> Sliding:
    cells = values.cells
    stiffness = cells["KN"] or shared.get("stiffness", 0.0)
    gap = cells["GAP"]
    return Sliding(
        outer,
        inner,
        stiffness * cells["DENSITY"] if stiffness else None,
        None if gap < 0.0 else gap,
        shared.get("tolerance", _TOLERANCE),
        cells["MU2"],
        cells["XSEUIL2"],
    )


def _unused(values: Values) -> Iterator[str]:
    """A note on values of the original that tubes in tubes have no use for."""
    used = {"IGR1", "IGR2", "ITYP12", "MU2", "KN", "XSEUIL2", "DENSITY", "GAP"}
    names = [n for n, v in values.cells.items() if n not in used and n in values.places and v]
    if names:
        yield f"*TYPCONTACT: {', '.join(names)} have no effect on a tube inside a tube"


def _complete(
    foundation: Foundation,
    tubes: Mapping[int, Tube],
    ties: list[Tie],
    slidings: list[Sliding],
    notes: list[str],
) -> None:
    """Add what a deck leaves to custom: cement, and sliding without room where cement ends."""
    named = {t.inner for t in ties} | {s.inner for s in slidings}
    known = {(s.outer, s.inner) for s in slidings}
    for tie in ties:
        pair = (tie.outer, tie.inner)
        one, other = tubes[tie.outer], tubes[tie.inner]
        whole = (min(one.top, other.top), max(one.tip, other.tip))
        if tie.inner not in foundation.tubes or tie.ends or pair in known:
            continue
        if (tie.top, tie.bottom) != whole:
            known.add(pair)
            slidings.append(Sliding(*pair))
            notes.append(
                f"tube {tie.inner} slides in tube {tie.outer} without room where they are not "
                "cemented (no *TYPCONTACT names them)"
            )
    for number, igr in enumerate(foundation.tubes):
        if number == 0 or igr in named:
            continue
        for outer, top, bottom in _around(foundation.tubes[:number], tubes[igr], tubes):
            ties.append(Tie(outer, igr, top, bottom))
            notes.append(
                f"tube {igr} is cemented to tube {outer} from {top:g} to {bottom:g} m "
                "(no *SLAVE names it)"
            )


def _around(
    outer: Sequence[int], inner: Tube, tubes: Mapping[int, Tube]
) -> Iterator[tuple[int, float, float]]:
    """The outermost of some tubes at each level of an inner one: its id, from and to, m."""
    cuts = {z for i in outer for z in (tubes[i].top, tubes[i].tip) if inner.tip < z < inner.top}
    levels = sorted({inner.top, inner.tip, *cuts}, reverse=True)
    found: list[tuple[int, float, float]] = []
    for top, bottom in pairwise(levels):
        at = 0.5 * (top + bottom)
        which = next((i for i in outer if tubes[i].tip < at < tubes[i].top), None)
        if which is None:
            continue
        if found and found[-1][0] == which and found[-1][2] == top:
            found[-1] = (which, found[-1][1], bottom)
        else:
            found.append((which, top, bottom))
    yield from found
