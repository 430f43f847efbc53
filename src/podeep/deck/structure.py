"""The paragraphs of tubes: *CASING."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..scene import Section, Tube
from .cells import Values, no_data, read_row
from .faults import Faults, first_bad
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Paragraph

_CASING = KEYWORDS["CASING"]
_HEAD, _SECTIONS = _CASING.rows


@dataclass(frozen=True, slots=True)
class ReadTube:
    """A tube as far as it could be read: its data, and top and tip, each None if at fault."""

    tube: Tube | None
    span: tuple[float, float] | None


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
