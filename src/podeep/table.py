"""Results as text: an aligned table in display units, and CSV in SI at full precision."""

import csv
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from io import StringIO
from textwrap import wrap

from .arrays import Array
from .query import Curves, Origin
from .subject import LINE
from .units import AXIS_UNITS, QUANTITIES, coordinates, number_format, short, with_unit

_WIDTH = 80
_GAP = "  "

ANALYSES = {"step_evolution": "Step evolution", "snapshot": "Snapshot", "envelope": "Envelope"}
"""Titles of the analyses in tables and pictures."""

_LINE_SIGNS = {
    "lateral_displacement": "positive to the left of the way to end 2",
    "lateral_force": "positive against displacement to the left of the way to end 2",
    "axial_displacement": "positive towards end 2",
    "axial_force": "positive against displacement towards end 2",
    "penetration": "penetration, positive into the seabed",
    "normal_reaction": "positive as the seabed pushes the line up",
    "effective_tension": "positive in tension",
    "bending_moment": "positive sagging, in space its size",
}


@dataclass(frozen=True)
class _Column:
    """Cells under a header; `span` is what the headers of neighbouring columns are values of."""

    header: str
    cells: Sequence[str]
    span: str = ""

    @cached_property
    def width(self) -> int:
        return max(len(self.header), *(len(cell) for cell in self.cells))


def text_table(curves: Curves, origin: Origin) -> str:
    """The table as text: header lines, then columns, folded where they pass 80 characters."""
    lines = []
    for name, text in heading(curves, origin):
        lines += wrap(f"{name:<12}{text}", _WIDTH, subsequent_indent=" " * 12)
    index, columns = _columns(curves, origin)
    for block in _fold(index.width, columns):
        lines.append("")
        if block[0].span:
            lines.append(" " * (index.width + len(_GAP)) + f"{block[0].span:>{block[0].width}}")
        shown = [index, *block]
        lines.append(_GAP.join(f"{c.header:>{c.width}}" for c in shown))
        lines.append(_GAP.join("-" * c.width for c in shown))
        for cells in zip(*(c.cells for c in shown), strict=True):
            lines.append(
                _GAP.join(f"{cell:>{c.width}}" for cell, c in zip(cells, shown, strict=True))
            )
    return "\n".join(lines) + "\n"


def axis_label(axis: str) -> str:
    """`step`, `time (s)`, `depth (m)` or `distance (m)`."""
    return f"{axis} ({AXIS_UNITS[axis]})" if AXIS_UNITS[axis] else axis


def heading(curves: Curves, origin: Origin, *, si: bool = False) -> list[tuple[str, str]]:
    """What the table is of, as pairs of a name and its text."""
    quantity = QUANTITIES[curves.quantity]
    unit = quantity.si_unit if si else quantity.unit
    sign = _sign(curves.quantity, origin)
    subject, at = origin.subject, curves.points
    along = subject.coordinate.capitalize()
    extent = short(at[0])
    if len(at) > 1:
        extent += f" to {short(at[-1])}"
    points = "point" if len(at) == 1 else "points"
    pairs = [("Database", f"{origin.database} ({origin.database_kind})")]
    if origin.title:
        pairs.append(("Title", origin.title))
    pairs += [
        (subject.name.capitalize(), f"{origin.name}, mudline at {short(origin.mudline)} m"),
        ("Analysis", ANALYSES[curves.kind]),
        ("Result", f"{quantity.title} ({unit}), {sign}"),
        (f"{along}s", f"{extent} m {subject.reference}, {len(at)} {points}"),
    ]
    rows = curves.rows
    if curves.kind == "snapshot" and len(rows) == 1:
        pairs.append((origin.axis.capitalize(), with_unit(rows[0], origin.axis)))
    elif len(rows):
        name, last = f"{origin.axis}s", with_unit(rows.max(), origin.axis)
        pairs.append((name.capitalize(), f"{short(rows.min())} to {last}, {len(rows)} {name}"))
    return pairs


def _sign(quantity: str, origin: Origin) -> str:
    """Which way a value counts as positive."""
    if origin.subject is LINE:
        return _LINE_SIGNS[quantity]
    lateral, reaction = quantity.startswith("lateral"), quantity.endswith("force")
    if not lateral:
        return "positive against downward displacement" if reaction else "positive down"
    if origin.direction is None:
        return "magnitude"
    against = "against displacement " if reaction else ""
    return f"positive {against}along {origin.direction}"


def _columns(curves: Curves, origin: Origin) -> tuple[_Column, list[_Column]]:
    """The index and the columns of the text table."""
    quantity = QUANTITIES[curves.quantity]
    values = curves.values * quantity.scale
    show = number_format(values.T if curves.kind == "step_evolution" else values)
    axis = axis_label(origin.axis)
    place = _Column(axis_label(origin.subject.coordinate), coordinates(curves.points))
    if curves.kind == "step_evolution":
        index = _Column(axis, _axis_values(curves.rows, origin))
        headers = zip(place.cells, values.T, strict=True)
        return index, [_Column(h, _cells(v, show), place.header) for h, v in headers]
    if curves.when is None:
        headers = zip(_axis_values(curves.rows, origin), values, strict=True)
        return place, [_Column(h, _cells(v, show), axis) for h, v in headers]
    columns = []
    for name, row, when in zip(("minimum", "maximum"), values, curves.when, strict=True):
        columns.append(_Column(name, _cells(row, show)))
        columns.append(_Column(f"at {axis}", _axis_values(when, origin)))
    return place, columns


def _cells(values: Array, show: Callable[[float], str]) -> list[str]:
    return [show(value) for value in values.tolist()]


def _axis_values(rows: Array, origin: Origin) -> list[str]:
    return [str(int(r)) for r in rows] if origin.axis == "step" else coordinates(rows)


def _fold(index_width: int, columns: list[_Column]) -> Iterator[list[_Column]]:
    """Blocks of columns, each with the index no wider than a line; as even as they go."""
    width = max(c.width for c in columns) + len(_GAP)
    fitting = max((_WIDTH - index_width) // width, 1)
    blocks = -(-len(columns) // fitting)
    size = -(-len(columns) // blocks)
    for start in range(0, len(columns), size):
        yield columns[start : start + size]


def csv_table(curves: Curves, origin: Origin) -> str:
    """The table as CSV: `#` header lines, a row of column names with SI units, then the numbers.

    Every number is written with as many digits as tell it from its neighbours.
    """
    out = StringIO()
    for name, text in heading(curves, origin, si=True):
        out.write(f"# {name}: {text}\n")
    writer = csv.writer(out, lineterminator="\n")
    quantity = QUANTITIES[curves.quantity]
    value = f"{quantity.key} [{quantity.si_unit}]"
    axis = _bracketed(origin.axis)
    along = origin.subject.coordinate
    points, rows = _exact(curves.points), _axis_exact(curves.rows, origin)
    if curves.kind == "step_evolution":
        writer.writerow([axis, *(f"{value} at {along} {point} m" for point in points)])
        writer.writerows(zip(rows, *map(_exact, curves.values.T), strict=True))
    elif curves.when is None:
        unit = AXIS_UNITS[origin.axis]
        at = (f"{value} at {origin.axis} {row} {unit}".rstrip() for row in rows)
        writer.writerow([_bracketed(along), *at])
        writer.writerows(zip(points, *map(_exact, curves.values), strict=True))
    else:
        names = [f"minimum {value}", f"{axis} of minimum", f"maximum {value}", f"{axis} of maximum"]
        low_at, high_at = (_axis_exact(when, origin) for when in curves.when)
        low, high = map(_exact, curves.values)
        writer.writerow([_bracketed(along), *names])
        writer.writerows(zip(points, low, low_at, high, high_at, strict=True))
    return out.getvalue()


def _bracketed(axis: str) -> str:
    return f"{axis} [{AXIS_UNITS[axis]}]" if AXIS_UNITS[axis] else axis


def _exact(values: Array) -> list[str]:
    return [repr(value) for value in values.tolist()]


def _axis_exact(rows: Array, origin: Origin) -> list[str]:
    return [str(int(r)) for r in rows] if origin.axis == "step" else _exact(rows)
