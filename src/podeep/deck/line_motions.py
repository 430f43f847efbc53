"""The paragraphs of how ends of lines move: *MOTION."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import radians
from typing import Any, Literal

from ..errors import Place
from ..motion import check_rising
from ..scene import DOFS, Dof, Line, LineMotion, Wave
from .actions import Actions
from .cells import Values, no_data, plain_number, read_row
from .faults import Faults, first_bad
from .histories import told
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph

_MOTION = KEYWORDS["MOTION"]
_HEAD, _TARGET, _WAVE, _RECORD, _ROWS = _MOTION.rows
_OF_WAVES = {column.name for column in _WAVE.columns} - {"DOF"}


@dataclass(slots=True)
class _Moved:
    """What moves one degree of freedom, as it is read; places of what it has one of at most."""

    name: str = ""
    target: float = 0.0
    waves: list[Wave] = field(default_factory=list)
    times: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    places: dict[str, Place] = field(default_factory=dict)


_Key = tuple[int, Literal[1, 2], Dof]


def read_line_motions(
    paragraphs: Sequence[Paragraph], lines: Registry[Line], actions: Actions, faults: Faults
) -> tuple[LineMotion, ...]:
    """How ends of lines move; names of displacements join those of the loads in `actions`."""
    found: dict[_Key, _Moved] = {}
    for paragraph in paragraphs:
        _read(paragraph, lines, found, actions, faults)
    return tuple(
        LineMotion(*key, one.name, one.target, tuple(one.waves), one.times, one.values)
        for key, one in found.items()
    )


def _read(
    paragraph: Paragraph,
    lines: Registry[Line],
    found: dict[_Key, _Moved],
    actions: Actions,
    faults: Faults,
) -> None:
    """Take in one *MOTION."""
    for option in paragraph.options:
        message = f"*MOTION has no option '{option.name or option.text}'"
        faults.add(option.place, message, "write *MOTION IGR END, then its rows or file=F")
    if paragraph.options:
        return
    if not paragraph.lines:
        no_data(paragraph, _HEAD, faults)
        return
    first, *rows = paragraph.lines
    recorded = sum(not f.name for f in first) > len(_HEAD.positional)
    layout = _RECORD if recorded else _HEAD
    head = read_row(first, layout, _MOTION, paragraph.place, faults)
    if not rows and not told(first[0].place, faults):
        what = "a record has no rows" if recorded else "nothing is said of how it moves"
        kinds = (_ROWS,) if recorded else (_TARGET, _WAVE)
        remedy = f"add {' or '.join(row.layout for row in kinds)} below"
        faults.add(head.place, what, remedy)
    if not head.sound:
        actions.complete = False  # its name may be lost
        return
    line = lines.get(head.cells["IGR"], head.places["IGR"])
    if recorded:
        _take_record(head, rows, line, found, faults)
        return
    strange = False  # one fault is enough for a long record
    for row in rows:
        if row[0].name or row[0].text.upper() in DOFS:
            _take_term(head, row, line, found, actions, faults)
        elif not strange:
            strange, actions.complete = True, False
            message = f"'{row[0].text}' stands where a degree of freedom is expected"
            which = f"{head.cells['IGR']} {head.cells['END']}"
            remedy = f"one end a keyword; a record names what it moves: *MOTION {which} X Y Z"
            faults.add(row[0].place, message, remedy)


def _moved(
    head: Values,
    dof: Dof,
    place: Place,
    line: Line | None,
    found: dict[_Key, _Moved],
    faults: Faults,
) -> _Moved:
    """What is known of a degree of freedom; one that nothing holds is told."""
    igr, end = head.cells["IGR"], head.cells["END"]
    if line is not None and not line.ends[end - 1].holds(dof):
        remedy = f"hold {'RX RY RZ' if dof.startswith('R') else dof} in *END"
        faults.add(place, f"{dof} of end {end} of line {igr} is moved, but not held", remedy)
    return found.setdefault((igr, end, dof), _Moved())


def _once(what: str, dof: Dof, place: Place, one: _Moved, faults: Faults) -> bool:
    """Whether a degree of freedom gets this for the first time; a second one is told."""
    first = one.places.setdefault(what, place)
    if first is not place:
        faults.add(place, f"{dof} of this end has {what} already, at {first}", "keep one of them")
    return first is place


def _si(dof: Dof, value: float) -> float:
    return radians(value) if dof.startswith("R") else value


def _take_term(
    head: Values,
    row: Sequence[Field],
    line: Line | None,
    found: dict[_Key, _Moved],
    actions: Actions,
    faults: Faults,
) -> None:
    """Take in a displacement of the steps, or a wave."""
    is_wave = sum(not f.name for f in row) > 2 or any(f.name in _OF_WAVES for f in row)
    values = read_row(row, _WAVE if is_wave else _TARGET, _MOTION, row[0].place, faults)
    name = str(head.cells.get("NAME", f"L{head.cells['IGR']}E{head.cells['END']}"))
    if not is_wave:  # one at fault still names its displacement
        name = actions.names.setdefault(name.upper(), name)
    if not values.sound:
        return
    dof: Dof = values.cells["DOF"]
    one = _moved(head, dof, values.places["DOF"], line, found, faults)
    if is_wave:
        arguments: dict[str, Any] = values.arguments(_WAVE.columns)
        del arguments["dof"]
        one.waves.append(Wave(_si(dof, values.cells["AMPLITUDE"]), **arguments))
    elif _once("a displacement", dof, values.places["DOF"], one, faults):
        one.name, one.target = name, _si(dof, values.cells["VALUE"])


def _take_record(
    head: Values,
    rows: Sequence[Sequence[Field]],
    line: Line | None,
    found: dict[_Key, _Moved],
    faults: Faults,
) -> None:
    """Take in a record of one degree of freedom or more."""
    dofs: list[Dof] = [one["DOF"] for one in head.group]
    places = [where["DOF"] for where in head.group_places]
    known = [
        _moved(head, dof, place, line, found, faults)
        for dof, place in zip(dofs, places, strict=True)
    ]
    new = [
        _once("a record", dof, place, one, faults)
        for dof, place, one in zip(dofs, places, known, strict=True)
    ]
    read = [_row(row, len(dofs), faults) for row in rows]
    sound = [row for row in read if row is not None]
    if not sound or len(sound) < len(read) or not all(new):
        return
    times, *columns = zip(*sound, strict=True)
    bad = first_bad(lambda n: check_rising(times[:n]), len(times))
    if bad is not None:
        faults.add(rows[bad[0]][0].place, bad[1].message, bad[1].remedy)
        return
    for dof, one, values in zip(dofs, known, columns, strict=True):
        one.times, one.values = times, tuple(_si(dof, value) for value in values)


def _row(line: Sequence[Field], count: int, faults: Faults) -> tuple[float, ...] | None:
    """Time and values of a row; None is told. Records are long: numbers are taken as they are."""
    if len(line) == 1 + count and not any(f.name for f in line):
        numbers = [n for f in line if (n := plain_number(f.text)) is not None]
        if len(numbers) == len(line):
            return tuple(numbers)
    values = read_row(line, _ROWS, _MOTION, line[0].place, faults)
    if values.sound and len(values.group) != count:
        message = f"{len(values.group)} values in a row for {count} degrees of freedom"
        faults.add(values.place, message, f"a row is T and {count} values")
        return None
    return (values.cells["T"], *(one["VALUE"] for one in values.group)) if values.sound else None
