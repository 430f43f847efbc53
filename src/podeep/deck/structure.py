"""The paragraphs of tubes and foundations: *CASING and *FONDATION."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import Place
from ..scene import Foundation, Section, Tube
from .cells import Values, no_data, read_row
from .faults import Faults, first_bad
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph

_CASING, _FONDATION = KEYWORDS["CASING"], KEYWORDS["FONDATION"]
_HEAD, _SECTIONS = _CASING.rows


@dataclass(frozen=True, slots=True)
class ReadTube:
    """A tube as far as it could be read: its data, and top and tip, each None if at fault."""

    tube: Tube | None
    span: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class ReadFoundation:
    """A foundation as far as it could be read: its data, id and tube, each None if at fault."""

    foundation: Foundation | None
    id: int | None
    tube: int | None
    place: Place


def read_tube(paragraph: Paragraph, tubes: Registry[ReadTube], faults: Faults) -> None:
    """Take in the tube of a *CASING."""
    before = len(faults.found)
    for option in paragraph.options:
        faults.add(option.place, "*CASING has no options", "EI= and the like end a section's line")
    if not paragraph.lines:
        no_data(paragraph, _HEAD, faults)
        tubes.add(None, paragraph.place, None)
        return
    first, *below = paragraph.lines
    head = read_row(first, _HEAD, _CASING, paragraph.place, faults)
    if not below:
        remedy = f"rows are {_SECTIONS.layout}, top to bottom"
        faults.add(head.place, "*CASING has no sections", remedy)
    rows = [read_row(line, _SECTIONS, _CASING, line[0].place, faults) for line in below]
    sections = [_section(row, faults) if row.sound else None for row in rows]
    id_ = head.cells.get("IGR") if head.sound else _quiet(head)
    tube = None
    sound = [s for s in sections if s is not None]
    if id_ is not None and sound and len(sound) == len(sections):
        tube = _tube(id_, head.cells.get("NAME", ""), sound, rows, faults)
    top = rows[0].cells.get("ZTOP") if rows else None
    tip = rows[-1].cells.get("ZBOT") if rows and rows[-1].sound else None
    span = (top, tip) if top is not None and tip is not None and top > tip else None
    if len(faults.found) > before:
        tube = None
    tubes.add(id_, head.places.get("IGR", paragraph.place), ReadTube(tube, span))


def _quiet(head: Values) -> int | None:
    value = head.cells.get("IGR")
    return value if isinstance(value, int) else None


def _section(row: Values, faults: Faults) -> Section | None:
    arguments = row.arguments(_SECTIONS.columns)
    return faults.guarded(lambda: Section(**arguments), row.places, row.place)


def _tube(
    id_: int, name: str, sections: Sequence[Section], rows: Sequence[Values], faults: Faults
) -> Tube | None:
    """The tube of its sections; the first one that does not join the one above is told."""

    bad = first_bad(lambda n: Tube(id_, name, tuple(sections[:n])), len(sections))
    if bad is None:
        return Tube(id_, name, tuple(sections))
    row, error = rows[bad[0]], bad[1]
    faults.add(row.places.get(error.field, row.place), error.message, error.remedy)
    return None


def read_foundations(
    paragraph: Paragraph, mudline: float | None, tubes: Registry[ReadTube], faults: Faults
) -> list[ReadFoundation]:
    """The foundations of a *FONDATION; `mudline` is that of *DEPTH, None if it is at fault."""
    for option in paragraph.options:
        faults.add(option.place, "*FONDATION has no options", "leave it out")
    if not paragraph.lines:
        no_data(paragraph, _FONDATION.rows[0], faults)
        return [ReadFoundation(None, None, None, paragraph.place)]
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
        return ReadFoundation(None, id_, None, place)
    if len(values.group) > 1:
        faults.add(
            values.group_places[1]["IGR"],
            f"foundation {id_} has {len(values.group)} tubes",
            "combined casings are not read by this version: give one tube",
        )
        return ReadFoundation(None, id_, None, place)
    igr = values.group[0]["IGR"]
    where = values.group_places[0]["IGR"]
    known = tubes.get(igr, where)
    level = values.cells.get("Z", mudline)
    if id_ is None or known is None or known.span is None or level is None:
        return ReadFoundation(None, id_, igr, place)
    if known.span[1] >= level:
        faults.add(
            where,
            f"tube {igr} ends at {known.span[1]:g} m, not below the mudline at {level:g} m",
            "let ZBOT of its last section be below the mudline",
        )
        return ReadFoundation(None, id_, igr, place)
    return ReadFoundation(Foundation(id_, (igr,), level), id_, igr, place)


def check_foundations(foundations: Sequence[ReadFoundation], faults: Faults) -> None:
    """Tell of ids that are given twice, and of tubes that stand in two foundations."""
    ids: dict[int, Place] = {}
    homes: dict[int, int | None] = {}
    for one in foundations:
        if one.id is not None and one.id in ids:
            message = f"foundation {one.id} is defined twice, first at {ids[one.id]}"
            faults.add(one.place, message, "give each its own id")
        elif one.tube is not None and one.tube in homes:
            message = f"tube {one.tube} already stands in foundation {homes[one.tube]}"
            faults.add(one.place, message, "a tube stands in one foundation")
        if one.id is not None:
            ids.setdefault(one.id, one.place)
        if one.tube is not None:
            homes.setdefault(one.tube, one.id)
