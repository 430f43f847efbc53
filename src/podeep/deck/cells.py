"""Fields become values by the columns of a row."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf, pi
from typing import Any

from ..errors import Place
from .column import Column, Keyword, Row
from .faults import Faults, nearest
from .scan import Field, Paragraph

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?", re.ASCII)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eEdD][+-]?\d+)?", re.ASCII)
_TO_SI = {"deg": pi / 180.0, "%": 0.01}
_SWITCH = {"ON": True, "OFF": False}
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)


@dataclass(slots=True)
class Values:
    """The values of a line by column name, with their places.

    cells: what was given or has a default; group: those of the repeated columns, a list for each
    repetition. sound: nothing was wrong with the line.
    """

    place: Place
    cells: dict[str, Any] = field(default_factory=dict)
    places: dict[str, Place] = field(default_factory=dict)
    group: list[dict[str, Any]] = field(default_factory=list)
    group_places: list[dict[str, Place]] = field(default_factory=list)
    sound: bool = True

    def arguments(self, columns: Sequence[Column]) -> dict[str, Any]:
        """The values by what the scene calls them: angles in radians, percents as shares."""
        return {
            c.key: self.cells[c.name] * _TO_SI[c.unit] if c.unit in _TO_SI else self.cells[c.name]
            for c in columns
            if c.key and c.name in self.cells
        }

    def key_places(self, columns: Sequence[Column]) -> dict[str, Place]:
        """The places by column name, of these columns."""
        return {c.name: self.places[c.name] for c in columns if c.name in self.places}


def read_row(
    fields: Sequence[Field], row: Row, keyword: Keyword, place: Place, faults: Faults
) -> Values:
    """The values of a line.

    A line with a wrong number of values is told once, whatever else is wrong in it: its values
    may stand under the wrong columns. `place` is where a line without fields would stand.
    """
    values = Values(fields[0].place if fields else place)
    before = len(faults.found)
    positional = [f for f in fields if not f.name]
    misplaced = _check_order(fields, row, keyword, faults)
    given, grouped = _assigned(fields, row, keyword, Faults() if misplaced else faults)
    if not misplaced and not any("," in f.text for f in positional):
        _check_count(fields, positional, given, row, keyword, place, faults)
    if len(faults.found) == before or any("," in f.text for f in positional):
        for column, cell in given:
            _set(column, cell, values.cells, values.places, faults)
        for cells in grouped:
            values.group.append({})
            values.group_places.append({})
            for column, cell in zip(row.repeated, cells, strict=False):
                _set(column, cell, values.group[-1], values.group_places[-1], faults)
        if len(faults.found) == before and not row.repeated:
            _tell_commas(positional[len(row.positional) :], keyword, faults)
    else:  # the first value still names the thing, for those that refer to it
        quiet = Faults()
        for column, cell in given[:1]:
            _set(column, cell, values.cells, values.places, quiet)
    values.sound = len(faults.found) == before
    for column in row.columns:
        if column.default is not None and column.name not in {c.name for c, _ in given}:
            values.cells[column.name] = column.default
    return values


def _check_order(fields: Sequence[Field], row: Row, keyword: Keyword, faults: Faults) -> bool:
    """Tell of a flag among the values, or a value after a NAME=VALUE of its line; True if so."""
    flags = {c.name for c in row.columns if c.kind == "flag"}
    for one in fields:
        if not one.name and one.text.upper() in flags:
            word = one.text.upper()
            message = f"{word} is an option, but stands among the values"
            faults.add(one.place, message, f"write it after a comma: *{keyword.name}, {word}")
            return True
    for before, after in pairwise(fields):
        if before.name and not after.name and after.place.line == before.place.line:
            message = f"'{after.text}' follows a value by name"
            faults.add(after.place, message, "give values by name at the end of the line")
            return True
    return False


def _assigned(
    fields: Sequence[Field], row: Row, keyword: Keyword, faults: Faults
) -> tuple[list[tuple[Column, Field]], list[Sequence[Field]]]:
    """Fields with the columns they belong to, and those of the repeated group."""
    positional = [f for f in fields if not f.name]
    given = list(zip(row.positional, positional, strict=False))
    rest = positional[len(row.positional) :]
    size = len(row.repeated)
    grouped: list[Sequence[Field]] = (
        [rest[i : i + size] for i in range(0, len(rest), size)] if size else []
    )
    for one in fields:
        if not one.name:
            continue
        column = row.column(one.name)
        if column is None:
            _strange(one, row, keyword, faults)
        elif any(c is column for c, _ in given):
            faults.add(one.place, f"{column.name} is given twice", "give it once")
        else:
            given.append((column, one))
    return given, grouped


def _strange(found: Field, row: Row, keyword: Keyword, faults: Faults) -> None:
    """Tell of a name that the row does not have."""
    if found.name in keyword.planned:
        message = f"{found.name} of *{keyword.name} is not read by this version"
        faults.add(found.place, message, "leave it out")
        return
    others = [r.title for r in keyword.rows if r is not row and r.column(found.name)]
    if others:
        faults.add(found.place, f"{found.name} has no effect here ({row.title})", "leave it out")
        return
    remedy = nearest(found.name, [c.name for c in row.columns])
    faults.add(found.place, f"*{keyword.name} has no {found.name} here", remedy)


def _check_count(
    fields: Sequence[Field],
    positional: Sequence[Field],
    given: Sequence[tuple[Column, Field]],
    row: Row,
    keyword: Keyword,
    place: Place,
    faults: Faults,
) -> None:
    """Tell of values that are too many or missing, once."""
    layout = f"the line is {row.layout}" if row.layout else "it takes values by name alone"
    names = {c.name for c, _ in given}
    missing = [c.name for c in row.columns if not c.optional and c.name not in names]
    over = len(positional) - len(row.positional)
    end = after((positional or fields)[-1].place) if fields else place
    if over > 0 and not row.repeated:
        first = positional[len(row.positional)]
        if first.text.upper() in keyword.planned:
            _strange(Field(first.text, first.place, first.text.upper()), row, keyword, faults)
            return
        what = "a value" if over == 1 else f"{over} values"
        faults.add(first.place, f"{what} too many for *{keyword.name}", layout)
    elif missing:
        faults.add(end, f"*{keyword.name} lacks {', '.join(missing)}", layout)
    elif row.repeated and (over <= 0 or over % len(row.repeated)):
        short = row.repeated[max(over, 0) % len(row.repeated) :]
        faults.add(end, f"*{keyword.name} lacks {', '.join(c.name for c in short)}", layout)


def _tell_commas(over: Sequence[Field], keyword: Keyword, faults: Faults) -> None:
    """Tell of values with commas that no column takes: options without their first comma."""
    for one in over:
        if "," in one.text:
            remedy = "separate values by blanks"
            if keyword.optioned:
                remedy = f"write options after commas: *{keyword.name}, {one.text.strip(',')}"
            faults.add(one.place, f"commas in '{one.text}'", remedy)
            return


def after(place: Place) -> Place:
    """Just behind a field: where something is missing."""
    return Place(place.file, place.line, place.column + place.width, place.text)


def _set(
    column: Column,
    cell: Field,
    cells: dict[str, Any],
    places: dict[str, Place],
    faults: Faults,
) -> None:
    """Convert a field into a cell, unless it is at fault or counts as left out."""
    places[column.name] = cell.place
    value = convert(cell, column, faults)
    if value is not None and not (column.none_at_zero and value <= 0.0):
        cells[column.name] = value


def convert(cell: Field, column: Column, faults: Faults) -> Any:
    """The value of a field: int, float, str or bool; None, and a fault, where it has none."""
    if not cell.text:
        faults.add(cell.place, f"{column.name}= has no value", column.explained)
        return None
    if column.kind == "word":
        return _word(cell, column, faults)
    if column.kind == "switch":
        if cell.text.upper() in _SWITCH:
            return _SWITCH[cell.text.upper()]
        faults.add(cell.place, f"{column.name} is '{cell.text}'", "write ON or OFF")
        return None
    if column.kind == "flag":
        faults.add(cell.place, f"{column.name} takes no value", f"write {column.name} alone")
        return None
    value = _number(cell, column, faults)
    if value is None:
        return None
    if column.kind == "integer" and value != int(value):
        faults.add(
            cell.place,
            f"{column.name} is {cell.text}, but must be a whole number",
            column.explained,
        )
        return None
    inside = f"{value:g}" in column.choices if column.choices else value in column.bounds
    if not inside:
        rule = f"one of {column.rule}" if len(column.choices) > 1 else column.rule
        message = f"{column.name} is {cell.text}, but must be {rule}"
        faults.add(cell.place, message, column.explained)
        return None
    return int(value) if column.kind == "integer" else value


def plain_number(text: str) -> float | None:
    """The number that a text is, as decks write them; None where it is none or too large."""
    if not _NUMBER.fullmatch(text):
        return None
    value = float(text.lower().replace("d", "e"))
    return value if abs(value) < inf else None


def _number(cell: Field, column: Column, faults: Faults) -> float | None:
    """The number that a field is; None, and a fault, where it is none."""
    text = cell.text
    value = plain_number(text)
    if value is not None:
        return value
    if _NUMBER.fullmatch(text):
        faults.add(cell.place, f"{column.name} is {text}, too large a number", column.explained)
    elif _DECIMAL_COMMA.fullmatch(text):
        point = text.replace(",", ".")
        faults.add(cell.place, f"{text} has a decimal comma", f"write {point}")
    elif "," in text:
        faults.add(cell.place, f"commas in '{text}'", "separate values by blanks")
    elif _NOT_FINITE.fullmatch(text):
        faults.add(cell.place, f"{column.name} is {text}, but must be finite", column.explained)
    else:
        faults.add(cell.place, f"{column.name} is '{text}', not a number", column.explained)
    return None


def _word(cell: Field, column: Column, faults: Faults) -> str | None:
    """The word that a field is; None, and a fault, where it may not stand."""
    if column.choices:
        if cell.text.upper() in column.choices:
            return cell.text.upper()
        remedy = nearest(cell.text, column.choices)
        faults.add(cell.place, f"{column.name} '{cell.text}' is unknown", remedy)
    elif _NUMBER.fullmatch(cell.text) or "," in cell.text:
        message = f"{column.name} is '{cell.text}', but must be a word"
        faults.add(cell.place, message, "a name is no number and has no commas")
    else:
        return cell.text
    return None


def option_fields(
    paragraph: Paragraph, keyword: Keyword, row: Row, faults: Faults
) -> tuple[list[Field], set[str]]:
    """The options of a keyword's line: those by name, and the flags that are set."""
    named, flags = [], set()
    for option in paragraph.options:
        word = option.name or option.text.upper()
        column = row.column(word)
        if keyword.optioned and option.name:
            named.append(option)
        elif column is not None and column.kind == "flag":
            if word in flags:
                faults.add(option.place, f"{word} is given twice", "give it once")
            flags.add(word)
        elif column is not None and column.named:
            faults.add(option.place, f"{word} has no value", f"write {word}=VALUE")
        elif any(c.kind == "flag" and c.name == word for r in keyword.rows for c in r.columns):
            faults.add(option.place, f"{word} has no effect here ({row.title})", "leave it out")
        elif word in keyword.planned:
            message = f"{word} of *{keyword.name} is not read by this version"
            faults.add(option.place, message, "leave it out")
        else:
            known = [c.name for c in row.columns if c.named] if keyword.optioned else []
            message = f"*{keyword.name} has no option '{word}'"
            faults.add(option.place, message, nearest(word, known))
    return named, flags


def read_lines(
    paragraph: Paragraph, keyword: Keyword, faults: Faults, layout: int = 0
) -> list[Values]:
    """The values of each line of a keyword whose lines are all alike; one line if it is unique.

    layout: index of the row that the lines are.
    """
    row = keyword.rows[layout]
    named, flags = option_fields(paragraph, keyword, row, faults)
    if not paragraph.lines and not named and not flags:
        no_data(paragraph, row, faults)
        return []
    if not keyword.once:
        return [read_row(line, row, keyword, line[0].place, faults) for line in paragraph.lines]
    line, *more = paragraph.lines or ((),)
    if more:
        faults.add(more[0][0].place, f"*{keyword.name} takes one line", "& joins two lines")
    places = {o.text.upper(): o.place for o in paragraph.options if not o.name}
    if not row.positional:  # bare words may stand on the line as well as after a comma
        known = {c.name for c in row.columns if c.kind == "flag"}
        bare = [f for f in line if not f.name and f.text.upper() in known]
        line = tuple(f for f in line if f not in bare)
        flags |= {f.text.upper() for f in bare}
        places |= {f.text.upper(): f.place for f in bare}
    values = read_row([*line, *named], row, keyword, paragraph.place, faults)
    for flag in sorted(flags):
        values.cells[flag], values.places[flag] = True, places[flag]
    return [values]


def no_data(paragraph: Paragraph, row: Row, faults: Faults) -> None:
    """Tell that a keyword has no data."""
    comment = next((c for c in paragraph.comments if c.text[1:2].isalnum()), None)
    remedy = f"a line is {row.layout}" if row.layout else "give NAME=VALUE"
    if comment is not None:
        remedy = f"line {comment.line} starts with C, a comment: indent it if it is data"
    faults.add(paragraph.place, f"*{paragraph.keyword} has no data", remedy)
