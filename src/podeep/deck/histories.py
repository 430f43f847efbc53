"""What named loads do in time: *HARMONIC and *TIMESERIES."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from ..errors import Place
from ..scene import Harmonic, TimeSeries
from .actions import Actions
from .cells import no_data, plain_number, read_lines, read_row
from .faults import Faults, first_bad, nearest
from .keywords import KEYWORDS
from .scan import Field, Paragraph

_HARMONIC, _TIMESERIES = KEYWORDS["HARMONIC"], KEYWORDS["TIMESERIES"]
_HEAD, _ROWS = _TIMESERIES.rows
#: what begins a row, rightly or not, and no name
_LIKE_NUMBER = re.compile(r"[+-]?([\d.,]+([eEdD][+-]?\d*)?|nan|inf)", re.ASCII | re.IGNORECASE)


@dataclass(slots=True)
class Histories:
    """Histories as they are read; places: of the names that have one, as the deck spells them."""

    harmonics: list[Harmonic] = field(default_factory=list)
    series: list[TimeSeries] = field(default_factory=list)
    places: dict[str, Place] = field(default_factory=dict)


def read_histories(
    harmonics: Sequence[Paragraph],
    series: Sequence[Paragraph],
    actions: Actions,
    faults: Faults,
) -> Histories:
    """The histories of all named loads; a name has one at most."""
    found = Histories()
    for paragraph in harmonics:
        for values in read_lines(paragraph, _HARMONIC, faults):
            if not values.sound:
                continue
            name = _known(values.cells["NAME"], values.places["NAME"], found, actions, faults)
            if name is not None:
                arguments = values.arguments(_HARMONIC.rows[0].columns) | {"name": name}
                found.harmonics.append(Harmonic(**arguments))
    for paragraph in series:
        _read_series(paragraph, found, actions, faults)
    return found


def _known(
    name: str, place: Place, found: Histories, actions: Actions, faults: Faults
) -> str | None:
    """A load's name as the deck spells it; None, which is told, without such a load or twice."""
    known = actions.names.get(name.upper())
    if known is None:
        if actions.complete and faults.complete:
            message = f"there is no load or displacement named {name}"
            faults.add(place, message, nearest(name, actions.names.values()))
        return None
    first = found.places.setdefault(known, place)
    if first is not place:
        faults.add(place, f"{name} has a history already, at {first}", "keep one of them")
        return None
    return known


def _read_series(paragraph: Paragraph, found: Histories, actions: Actions, faults: Faults) -> None:
    """Take in the series of a *TIMESERIES: each a line with its name, then its rows.

    Rows of a file stand in another file than the name, and are never taken for one.
    """
    for option in paragraph.options:
        message = f"*TIMESERIES has no option '{option.name or option.text}'"
        faults.add(option.place, message, "write *TIMESERIES NAME, file=F")
    if paragraph.options:
        return
    if not paragraph.lines:
        no_data(paragraph, _HEAD, faults)
        return
    groups: list[tuple[Sequence[Field], list[Sequence[Field]]]] = []
    for line in paragraph.lines:
        first = line[0]
        file = groups[-1][0][0].place.file if groups else first.place.file
        if first.place.file == file and not _LIKE_NUMBER.fullmatch(first.text):
            groups.append((line, []))
        elif groups:
            groups[-1][1].append(line)
        else:
            message = f"'{first.text}' stands before the name of a load"
            faults.add(first.place, message, "write *TIMESERIES NAME, then its rows T FACTOR")
            return
    for head, rows in groups:
        values = read_row(head, _HEAD, _TIMESERIES, paragraph.place, faults)
        name = None
        if values.sound:
            name = _known(values.cells["NAME"], values.places["NAME"], found, actions, faults)
        if not rows and values.sound and not told(head[0].place, faults):
            message = f"the series of {head[0].text} has no rows"
            faults.add(head[0].place, message, f"rows are {_ROWS.layout}, in a file or below")
        series = _rows(name or "", rows, faults)
        if series is not None and name is not None:
            found.series.append(series)


def _rows(name: str, lines: Sequence[Sequence[Field]], faults: Faults) -> TimeSeries | None:
    """The series of its rows; each row at fault is told, and the first time that does not rise."""
    rows = [_row(line, faults) for line in lines]
    sound = [row for row in rows if row is not None]
    if not rows or len(sound) < len(rows):
        return None
    times, factors = zip(*sound, strict=True)
    bad = first_bad(lambda n: TimeSeries(name, times[:n], factors[:n]), len(rows))
    if bad is None:
        return TimeSeries(name, times, factors)
    faults.add(lines[bad[0]][0].place, bad[1].message, bad[1].remedy)
    return None


def _row(line: Sequence[Field], faults: Faults) -> tuple[float, float] | None:
    """Time and factor of a row; None is told. Records are long: two numbers are taken as they are.

    The others go the way of all lines, which is slower and knows what is wrong.
    """
    if len(line) == 2 and not any(f.name for f in line):
        time, factor = (plain_number(f.text) for f in line)
        if time is not None and factor is not None:
            return time, factor
    values = read_row(line, _ROWS, _TIMESERIES, line[0].place, faults)
    return (values.cells["T"], values.cells["FACTOR"]) if values.sound else None


def told(place: Place, faults: Faults) -> bool:
    """Whether something is wrong with a line already: what it lacks may follow from that."""
    where = (place.file, place.line)
    return any(f.place and (f.place.file, f.place.line) == where for f in faults.found)
