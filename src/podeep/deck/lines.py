"""The paragraphs of lines: *LINE and *END."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from ..errors import Place
from ..lines import TRANSLATIONS, Point, towards
from ..scene import Dof, Line, LineEnd, LineSection
from .cells import Values, read_lines
from .faults import Faults
from .keywords import KEYWORDS
from .paragraphs import Sorted
from .registry import Registry
from .scan import Paragraph
from .structure import ReadTube, head_and_rows, id_of

_LINE, _END = KEYWORDS["LINE"], KEYWORDS["END"]
_ROTATIONS = ("RX", "RY", "RZ")
_DIRECTION = ("DX", "DY", "DZ")
_AXES = ("X", "Y", "Z")


@dataclass(frozen=True, slots=True)
class _Body:
    """A line without its ends."""

    id: int
    name: str
    sections: tuple[LineSection, ...]


@dataclass(frozen=True, slots=True)
class _Given:
    """An end as *END has it; direction: as given, None for the default where it is held."""

    position: Point
    held: tuple[Dof, ...]
    turns: bool
    direction: Point | None
    places: Mapping[str, Place]
    place: Place


def read_pipes(given: Sorted, tubes: Registry[ReadTube], faults: Faults) -> Registry[Line]:
    """The lines of all *LINE with the ends of all *END; tubes and lines share their numbers."""
    complete = given.complete("LINE")
    bodies: Registry[_Body] = Registry("line", "LINE", faults, complete=complete)
    for id_ in tubes.places:
        bodies.elsewhere[id_] = f"{id_} is a tube, of *CASING"
    for paragraph in given.of["LINE"]:
        _read_body(paragraph, bodies, tubes, faults)
    for id_ in bodies.places:
        tubes.elsewhere[id_] = f"{id_} is a line: *END holds it, *MOTION moves it"
    before = len(faults.found)
    ends = _read_ends(given.of["END"], bodies, faults)
    all_there = len(faults.found) == before and given.complete("END")
    lines: Registry[Line] = Registry("line", "LINE", faults, complete=bodies.complete)
    lines.places, lines.meant, lines.elsewhere = bodies.places, bodies.meant, bodies.elsewhere
    for id_, body in bodies.items.items():
        lines.items[id_] = None
        found = [ends.get((id_, number)) for number in (1, 2)]
        for number, end in enumerate(found, start=1):
            if end is None and all_there:
                remedy = f"add *END with the line {id_} {number} X Y Z and what is held"
                faults.add(bodies.places[id_], f"line {id_} has no end {number}", remedy)
        one, other = found
        if body is not None and one is not None and other is not None:
            lines.items[id_] = _joined(body, one, other, faults)
    return lines


def _read_body(
    paragraph: Paragraph, bodies: Registry[_Body], tubes: Registry[ReadTube], faults: Faults
) -> None:
    """Take in the sections of a *LINE."""
    before = len(faults.found)
    head, rows = head_and_rows(paragraph, _LINE, "from end 1 to end 2", faults)
    if head is None:
        bodies.add(None, paragraph.place, None)
        return
    id_, place = id_of(head), head.places.get("IGR", paragraph.place)
    if id_ in tubes.places:
        message = f"tube {id_} has this number already, at {tubes.places[id_]}"
        faults.add(place, message, "tubes and lines share their numbers: give the line its own")
    sections = [_section(row, faults) for row in rows if row.sound]
    sound = tuple(s for s in sections if s is not None)
    made = None
    if id_ is not None and len(faults.found) == before:
        made = _Body(id_, head.cells.get("NAME", ""), sound)
    bodies.add(id_, place, made)


def _section(row: Values, faults: Faults) -> LineSection | None:
    arguments = row.arguments(_LINE.rows[1].columns)
    return faults.guarded(lambda: LineSection(**arguments), row.places, row.place)


def _read_ends(
    paragraphs: Sequence[Paragraph], bodies: Registry[_Body], faults: Faults
) -> dict[tuple[int, int], _Given]:
    """The ends by line and number."""
    ends: dict[tuple[int, int], _Given] = {}
    for paragraph in paragraphs:
        for values in read_lines(paragraph, _END, faults):
            if not values.sound:
                continue
            key = (values.cells["IGR"], values.cells["END"])
            bodies.get(key[0], values.places["IGR"])
            end = _given_end(values, faults)
            if key in ends:
                message = (
                    f"end {key[1]} of line {key[0]} is given twice, first at {ends[key].place}"
                )
                faults.add(values.places["END"], message, "give each end once")
            elif end is not None:
                ends[key] = end
    return ends


def _given_end(values: Values, faults: Faults) -> _Given | None:
    """The end of a line of *END; None, which is told, where what is held does not go together."""
    cells, places = values.cells, values.places
    where = [at["DOF"] for at in values.group_places]
    named = [one["DOF"] for one in values.group]
    if "FREE" in named and len(named) > 1:
        place = where[named.index("FREE")]
        faults.add(place, "FREE stands beside what is held", "write FREE alone, or leave it out")
        return None
    turned = [dof for dof in named if dof in _ROTATIONS]
    if turned and set(turned) != set(_ROTATIONS):
        faults.add(
            where[named.index(turned[0])],
            f"{' '.join(turned)} of a line's end {'is' if len(turned) == 1 else 'are'} held alone",
            "a line's direction is held or not: give RX RY RZ, or none of them",
        )
        return None
    given = [name for name in _DIRECTION if name in places]
    if given and not turned:
        message = f"{given[0]} has no effect on an end whose direction is not held"
        faults.add(places[given[0]], message, "hold RX RY RZ, or leave it out")
        return None
    x, y, z = (cells[name] for name in _AXES)
    dx, dy, dz = (cells.get(name, 0.0) for name in _DIRECTION)
    at = {**places, "DOF": where[named.index(turned[0])] if turned else values.place}
    return _Given(
        (x, y, z),
        tuple(dof for dof in TRANSLATIONS if dof in named),
        bool(turned),
        (dx, dy, dz) if given else None,
        {**at, "DX": places[given[0]]} if given else at,
        values.place,
    )


def _joined(body: _Body, one: _Given, other: _Given, faults: Faults) -> Line | None:
    first, last = _end(1, one, other, faults), _end(2, other, one, faults)
    if first is None or last is None:
        return None
    return Line(body.id, body.name, body.sections, (first, last))


def _end(number: Literal[1, 2], end: _Given, other: _Given, faults: Faults) -> LineEnd | None:
    def make() -> LineEnd:
        direction = end.direction
        if end.turns and direction is None:
            direction = towards(end.position, other.position)
        return LineEnd(number, end.position, end.held, direction)

    return faults.guarded(make, end.places, end.place)
