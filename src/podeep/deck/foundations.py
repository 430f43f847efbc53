"""The paragraphs of foundations: *FONDATION."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..errors import Place
from ..scene import Foundation
from .cells import no_data, read_row
from .faults import Faults
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph
from .structure import ReadTube

_FONDATION = KEYWORDS["FONDATION"]
_TOUCH = 1e-9  # m


@dataclass(frozen=True, slots=True)
class ReadFoundation:
    """A foundation as far as it could be read.

    foundation, id: None if at fault. tubes: their ids, with places; empty if at fault.
    """

    foundation: Foundation | None
    id: int | None
    tubes: tuple[tuple[int, Place], ...]
    place: Place


def read_foundations(
    paragraph: Paragraph, mudline: float | None, tubes: Registry[ReadTube], faults: Faults
) -> list[ReadFoundation]:
    """The foundations of a *FONDATION; `mudline` is that of *DEPTH, None if it is at fault."""
    for option in paragraph.options:
        faults.add(option.place, "*FONDATION has no options", "leave it out")
    if not paragraph.lines:
        no_data(paragraph, _FONDATION.rows[0], faults)
        return [ReadFoundation(None, None, (), paragraph.place)]
    return [_foundation(line, paragraph, mudline, tubes, faults) for line in paragraph.lines]


def _foundation(
    line: Sequence[Field],
    paragraph: Paragraph,
    mudline: float | None,
    tubes: Registry[ReadTube],
    faults: Faults,
) -> ReadFoundation:
    row = _FONDATION.rows[0]
    positional = [f for f in line if not f.name]
    if len(positional) > 2 and positional[-1].text.startswith("-"):
        last = positional[-1]
        line = [Field(f.text, f.place, "Z") if f is last else f for f in line]
    values = read_row(line, row, _FONDATION, paragraph.place, faults)
    id_: int | None = values.cells.get("ID")
    place = values.places.get("ID", values.place)
    if not values.sound:
        return ReadFoundation(None, id_, (), place)
    named = tuple(
        (cells["IGR"], places["IGR"])
        for cells, places in zip(values.group, values.group_places, strict=True)
    )
    made = None
    if id_ is not None:
        made = _made(id_, named, values.cells.get("Z", mudline), tubes, faults)
    return ReadFoundation(made, id_, named, place)


def _made(
    id_: int,
    named: Sequence[tuple[int, Place]],
    mudline: float | None,
    tubes: Registry[ReadTube],
    faults: Faults,
) -> Foundation | None:
    """The foundation of some tubes; None if one is at fault or they do not stand together."""
    known = [tubes.get(igr, place) for igr, place in named]
    spans = [tube.span for tube in known if tube is not None and tube.span is not None]
    if len(spans) < len(named) or mudline is None:
        return None
    igr, where = named[0]
    tip = min(tip for _, tip in spans)
    if tip >= mudline:
        which = f"tube {igr} ends" if len(named) == 1 else "its tubes end"
        faults.add(
            where,
            f"{which} at {tip:g} m, not below the mudline at {mudline:g} m",
            "let ZBOT of its last section be below the mudline",
        )
        return None
    for (_, above), (top, _) in pairwise(_joined(spans)):
        faults.add(
            where,
            f"the tubes of foundation {id_} leave a gap from {above:g} to {top:g} m",
            "tubes of one foundation stand in each other: let their elevations overlap",
        )
        return None
    return Foundation(id_, tuple(igr for igr, _ in named), mudline)


def _joined(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Spans (top, bottom) put together where they touch, from the top down."""
    found: list[tuple[float, float]] = []
    for top, bottom in sorted(spans, reverse=True):
        if found and top >= found[-1][1] - _TOUCH:
            found[-1] = (found[-1][0], min(bottom, found[-1][1]))
        else:
            found.append((top, bottom))
    return found


def check_foundations(foundations: Sequence[ReadFoundation], faults: Faults) -> None:
    """Tell of ids that are given twice, and of tubes that stand in two foundations or twice."""
    ids: dict[int, Place] = {}
    homes: dict[int, int | None] = {}
    for one in foundations:
        if one.id is not None and one.id in ids:
            message = f"foundation {one.id} is defined twice, first at {ids[one.id]}"
            faults.add(one.place, message, "give each its own id")
            continue
        if one.id is not None:
            ids[one.id] = one.place
        for igr, place in one.tubes:
            if igr in homes:
                message = f"tube {igr} already stands in foundation {homes[igr]}"
                where = place if len(one.tubes) > 1 else one.place
                faults.add(where, message, "a tube stands in one foundation, once")
            homes.setdefault(igr, one.id)
