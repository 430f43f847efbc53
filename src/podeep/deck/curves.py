"""The paragraphs of curves: *PYCURVE and *TZCURVE."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import Place
from ..scene import Curve
from ..soil.group import group_multiplier, mean_multiplier
from .cells import Values, after, option_fields, read_row
from .column import Keyword, Row
from .faults import Faults
from .keywords import KEYWORDS
from .scan import Field, Paragraph

PYCURVE, TZCURVE = KEYWORDS["PYCURVE"], KEYWORDS["TZCURVE"]
_USER, _STATIC_ROWS, _DYNAMIC_ROWS = PYCURVE.rows[-3:]
_TZ_ROWS = TZCURVE.rows[-1]
#: what may stand by name on the first line of a *TZCURVE whose values follow on the next
_ANYWHERE = {"GAMMA", "SHAPE", "RESIDUAL", "METHOD", "PLUG", "IOD"}


def _types(keyword: Keyword) -> Mapping[str, Row]:
    """The rows of a keyword's predefined types by their number."""
    rows = [row for row in keyword.rows if row.column("ITYP")]
    return MappingProxyType({row.columns[1].choices[0]: row for row in rows})


_PY_TYPES, _TZ_TYPES = _types(PYCURVE), _types(TZCURVE)


class Found(NamedTuple):
    """A curve as it was read: its id, None where it is unreadable, and the curve, None likewise."""

    id: int | None
    place: Place
    curve: Curve | None
    notes: tuple[str, ...] = ()


def lateral_curve(paragraph: Paragraph, faults: Faults) -> Found:
    """The curve of a *PYCURVE: NCUR and ITYP on two lines or one, or a user curve with rows."""
    if not paragraph.lines:
        return _empty(paragraph, PYCURVE, "NCUR, or NCUR IANA IOD of a user curve", faults)
    first, *rest = paragraph.lines
    words = [f.text for f in first if not f.name]
    names = {f.name for f in first}
    zero_or_one = all(word in ("0", "1") for word in words[1:3])
    if names & {"IANA", "IOD"} or (len(words) == 3 and (rest or zero_or_one)):
        return _user_curve(paragraph, faults)
    if len(words) == 1 and rest and "ITYP" not in names:
        return _typed(paragraph, PYCURVE, _PY_TYPES, (*first, *rest[0]), rest[1:], None, faults)
    if len(words) == 2 and rest:
        layout = "NCUR alone, or NCUR IANA IOD of a user curve"
        message = "the first line of *PYCURVE has 2 values"
        faults.add(first[-1].place, message, f"it is {layout}; ITYP starts the next line")
        return Found(_quiet_id(first), first[0].place, None)
    return _typed(paragraph, PYCURVE, _PY_TYPES, first, rest, None, faults)


def axial_curve(paragraph: Paragraph, faults: Faults) -> Found:
    """The curve of a *TZCURVE: NCUR IOD and ITYP on two lines, or NCUR ITYP on one; then rows."""
    if not paragraph.lines:
        return _empty(paragraph, TZCURVE, "NCUR IOD", faults)
    first, *rest = paragraph.lines
    words = [f for f in first if not f.name]
    own = {f.name for f in first if f.name} - _ANYWHERE
    if rest and not own and len(words) <= 2:
        in_place = list(first)
        if len(words) == 2:  # the second one is IOD: it goes by name in the joined line
            at = in_place.index(words[1])
            in_place[at] = Field(words[1].text, words[1].place, "IOD")
        joined = (*(f for f in in_place if not f.name), *rest[0], *(f for f in in_place if f.name))
        return _typed(paragraph, TZCURVE, _TZ_TYPES, joined, rest[1:], _TZ_ROWS, faults)
    if len(words) == 2 and not own:
        message = "*TZCURVE lacks the line of ITYP"
        faults.add(after(words[-1].place), message, "ITYP F1 ... follow the line NCUR IOD")
        return Found(_quiet_id(first), first[0].place, None)
    return _typed(paragraph, TZCURVE, _TZ_TYPES, first, rest, _TZ_ROWS, faults)


def _empty(paragraph: Paragraph, keyword: Keyword, layout: str, faults: Faults) -> Found:
    faults.add(paragraph.place, f"*{keyword.name} has no data", f"its first line is {layout}")
    return Found(None, paragraph.place, None)


def _quiet_id(fields: Sequence[Field]) -> int | None:
    """The id at the start of a line that is at fault anyway."""
    text = next((f.text for f in fields if not f.name or f.name == "NCUR"), "")
    return int(text) if text.isascii() and text.isdigit() and len(text) < 7 else None


def _typed(
    paragraph: Paragraph,
    keyword: Keyword,
    types: Mapping[str, Row],
    fields: Sequence[Field],
    below: Sequence[Sequence[Field]],
    rows: Row | None,
    faults: Faults,
) -> Found:
    """A curve of one of the types of a keyword, from NCUR ITYP ... in one line."""
    before, id_ = len(faults.found), _quiet_id(fields)
    positional = [f for f in fields if not f.name]
    named = next((f for f in fields if f.name == "ITYP"), None)
    given = named or (positional[1] if len(positional) > 1 else None)
    row = _type(given, keyword, types, fields, faults)
    if row is None:
        return Found(id_, fields[0].place, None)
    options, flags = option_fields(paragraph, keyword, row, faults)
    values = read_row([*fields, *options], row, keyword, paragraph.place, faults)
    id_ = values.cells.get("NCUR", id_)
    table: tuple[tuple[float, ...], ...] = ()
    notes: tuple[str, ...] = ()
    if below and rows is None:
        faults.add(below[0][0].place, f"*{keyword.name} takes no more lines here", row.layout)
    elif below and rows is not None:
        table = _table(below, rows, keyword, faults)
        for name in ("SHAPE", "RESIDUAL", "METHOD"):
            if name in values.places:
                message = f"{name} has no effect on a curve with rows"
                faults.add(values.places[name], message, "leave out either")
        notes = (f"t-z curve {id_}: its rows replace what its ITYP and F values give",)
    if len(faults.found) > before:
        return Found(id_, values.place, None)
    if not _softens(row, values):
        message = f"RESIDUAL has no effect with SHAPE={values.cells['SHAPE']} in {row.title}"
        faults.add(values.places["RESIDUAL"], message, "leave it out, or give SHAPE=2GEO")
        return Found(id_, values.place, None)
    switches = [c for c in row.columns if c.kind in ("word", "flag") and c.key]
    arguments = values.arguments(row.columns) | group_factor(values, faults)
    if len(faults.found) > before:
        return Found(id_, values.place, None)
    chosen: dict[str, Any] = {
        c.key: c.name in flags if c.kind == "flag" else arguments.pop(c.key) for c in switches
    }
    curve = Curve(
        values.cells["NCUR"],
        row.law,
        MappingProxyType(arguments),
        MappingProxyType(chosen),
        table,
        bool(table) and values.cells["IOD"] == 1,
    )
    return Found(id_, values.place, curve, notes)


def group_factor(values: Values, faults: Faults) -> dict[str, float]:
    """The factor on p-y of a pile in a group, with PMULT; empty without SPACING and ROW."""
    spacing, row = (values.cells.get(name) for name in ("SPACING", "ROW"))
    if spacing is None and row is None:
        return {}
    if spacing is None or row is None:
        given, lacking = ("ROW", "SPACING") if spacing is None else ("SPACING", "ROW")
        message = f"{given} has no effect without {lacking}"
        faults.add(values.places[given], message, f"give both, or leave {given} out")
        return {}
    if row.startswith("MEAN"):
        factor = mean_multiplier(spacing, int(row.removeprefix("MEAN")))
    else:
        factor = group_multiplier(spacing, int(row))
    return {"multiplier": factor * values.cells["PMULT"]}


def _softens(row: Row, values: Values) -> bool:
    """Whether a residual, if one is given, has an effect: on the points of API RP 2GEO alone.

    SHAPE=API takes these in clay and for a direct friction, not in sand.
    """
    shape = values.cells.get("SHAPE")
    return (
        "RESIDUAL" not in values.cells
        or shape == "2GEO"
        or (shape == "API" and row.law != "cohesionless")
    )


def _type(
    given: Field | None,
    keyword: Keyword,
    types: Mapping[str, Row],
    fields: Sequence[Field],
    faults: Faults,
) -> Row | None:
    """The row of a curve's type; None is told."""
    listed = ", ".join(row.title.removeprefix("ITYP ") for row in types.values())
    if given is None:
        faults.add(fields[-1].place, f"*{keyword.name} lacks ITYP", f"types are {listed}")
        return None
    number = given.text.removesuffix(".").removesuffix(".0")
    if number in types:
        return types[number]
    if f"ITYP {number}" in keyword.planned:
        message = f"ITYP {number} of *{keyword.name} is not read by this version"
    else:
        message = f"ITYP is {given.text}"
    faults.add(given.place, message, f"types are {listed}")
    return None


def _user_curve(paragraph: Paragraph, faults: Faults) -> Found:
    """A p-y curve by points."""
    before = len(faults.found)
    first, *below = paragraph.lines
    options, _ = option_fields(paragraph, PYCURVE, _USER, faults)
    values = read_row([*first, *options], _USER, PYCURVE, paragraph.place, faults)
    id_ = values.cells.get("NCUR", _quiet_id(first))
    dynamic = values.cells.get("IANA")
    table: tuple[tuple[float, ...], ...] = ()
    if not below:
        faults.add(values.place, "a user curve has no rows", "give rows P Y, or Ps Ys Pd Yd")
    elif dynamic is not None:
        table = _table(below, _DYNAMIC_ROWS if dynamic else _STATIC_ROWS, PYCURVE, faults)
    if len(faults.found) > before:
        return Found(id_, values.place, None)
    parameters = MappingProxyType(values.arguments(_USER.columns) | group_factor(values, faults))
    if len(faults.found) > before:
        return Found(id_, values.place, None)
    return Found(
        id_,
        values.place,
        Curve(
            values.cells["NCUR"],
            "user",
            parameters,
            rows=table,
            rows_in_diameters=values.cells["IOD"] == 1,
        ),
    )


def _table(
    lines: Sequence[Sequence[Field]], row: Row, keyword: Keyword, faults: Faults
) -> tuple[tuple[float, ...], ...]:
    """The rows of a curve; displacements rise and reactions resist, or it is told once."""
    names = [c.name for c in row.columns]
    read = [read_row(line, row, keyword, line[0].place, faults) for line in lines]
    rows = [r for r in read if r.sound]
    for force, displacement in zip(names[::2], names[1::2], strict=True):
        _check_curve(rows, force, displacement, faults)
    return tuple(tuple(r.cells[name] for name in names) for r in rows)


def _check_curve(rows: Sequence[Values], force: str, displacement: str, faults: Faults) -> None:
    """Tell of the first row of a curve whose displacement does not rise, or that pushes."""
    last: tuple[float, float] | None = None
    for row in rows:
        p, y = row.cells[force], row.cells[displacement]
        if p * y < 0.0 or (y == 0.0 and p != 0.0):
            what = f"{force} is {p:g} at {displacement} = {y:g}"
            rule = "a reaction is 0 at 0 and has the sign of its displacement"
            faults.add(row.places[force], what, rule)
            return
        if last is not None and (y < last[1] or (y == last[1] and p != last[0])):
            what = f"{displacement} is {y:g} after {last[1]:g}, but must rise"
            faults.add(row.places[displacement], what, "order the rows by displacement")
            return
        last = p, y
