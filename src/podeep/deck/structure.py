"""The paragraphs of tubes: *CASING."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..scene import Section, Tube
from .cells import Values, no_data, read_row
from .column import Keyword
from .faults import Faults, first_bad
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Paragraph

_CASING = KEYWORDS["CASING"]
_SECTIONS = _CASING.rows[1]


@dataclass(frozen=True, slots=True)
class ReadTube:
    """A tube as far as it could be read: its data, and top and tip, each None if at fault."""

    tube: Tube | None
    span: tuple[float, float] | None


def read_tube(paragraph: Paragraph, tubes: Registry[ReadTube], faults: Faults) -> None:
    """Take in the tube of a *CASING."""
    before = len(faults.found)
    head, rows = head_and_rows(paragraph, _CASING, "top to bottom", faults)
    if head is None:
        tubes.add(None, paragraph.place, None)
        return
    sections = [_section(row, faults) if row.sound else None for row in rows]
    id_ = id_of(head)
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


def head_and_rows(
    paragraph: Paragraph, keyword: Keyword, order: str, faults: Faults
) -> tuple[Values | None, list[Values]]:
    """The first line of a paragraph of sections, None without data, and its rows."""
    head, sections = keyword.rows
    for option in paragraph.options:
        message = f"*{keyword.name} has no options"
        faults.add(option.place, message, "EI= and the like end a section's line")
    if not paragraph.lines:
        no_data(paragraph, head, faults)
        return None, []
    first, *below = paragraph.lines
    values = read_row(first, head, keyword, paragraph.place, faults)
    if not below:
        remedy = f"rows are {sections.layout}, {order}"
        faults.add(values.place, f"*{keyword.name} has no sections", remedy)
    return values, [read_row(line, sections, keyword, line[0].place, faults) for line in below]


def id_of(head: Values) -> int | None:
    """The id of a first line, which names its thing even where the line is at fault."""
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
