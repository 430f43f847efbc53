"""A chart of speed against accuracy in words, and as CSV."""

import csv
from collections.abc import Iterator
from io import StringIO

from ..report import folded
from .chart import Chart, Choice, Row
from .settings import PRESETS, Series, Setting, deck_lines

_MILLI = 1e3
_NAME, _CELL = 26, 13  # widths of the table's columns

_WORDS = (
    "-: no mesh that was measured reaches it. Without more words the soil's reaction is "
    "integrated and Newton's iteration has a line search. lumped: springs at the ends of elements "
    "of degree 3, with half an element's length each; full steps: no line search; secant: secant "
    "moduli in place of tangents; spatial: two components of the deflection where one would do; "
    "automatic: *ACCURACY alone, with building, estimates of the error and refinement."
)

_COLUMNS = (
    *("kind", "series", "elements", "degree", "reactions", "iteration", "spatial"),
    *("accuracy asked", "status", "error", "error of displacement", "error of reaction"),
    *("error of moment", "estimated error", "CPU time [s]", "runs", "CPU time of building [s]"),
    "CPU time of the last mesh [s]",
    *("unknowns", "iterations", "evaluations", "on the front", "reason"),
)


def chart_report(found: Chart) -> str:
    """The chart of a foundation: a table of series against errors, then lines for the deck."""
    lines = [found.title] if found.title else []
    lines += folded(
        f"{found.foundation}: speed against accuracy, {found.steps} steps, "
        f"{len(found.rows)} settings"
    )
    lines += folded(found.machine)
    lines += folded(_known(found))
    lines += ["", "CPU time of all steps in ms, and elements, of the fastest within an error"]
    lines += ["(it and all finer meshes of its series; building is not counted)"]
    lines += [
        f"medians of {_runs(found)} runs",
        "",
        *_table(found),
        "",
        *folded(_WORDS),
        *_failures(found),
    ]
    lines += ["", "lines for the deck, in place of its own *ACCURACY and *MODEL"]
    for preset, choice in zip(PRESETS, found.choices, strict=True):
        lines += ["", *_preset(found, preset, choice)]
    return "\n".join(lines)


def _runs(found: Chart) -> str:
    """How often what was solved was timed; slow runs are not repeated."""
    runs = [row.runs for row in found.rows if row.errors]
    runs += [one.runs for one in found.choices if one.errors]
    return " to ".join(map(str, sorted({min(runs, default=0), max(runs, default=0)})))


def _known(found: Chart) -> str:
    """What the errors are measured against."""
    one = found.reference
    text = (
        f"converged reference: {one.elements} elements of degree {one.degree}; with half as many "
        f"its largest values change by {one.error:.1e}"
    )
    if not found.sure:
        text += f"; that is more than a hundredth of {min(PRESETS):g}: errors near it are not sure"
    return text


def _table(found: Chart) -> Iterator[str]:
    def line(name: str, cells: list[str]) -> str:
        return f"{name:<{_NAME}}" + "".join(f"{cell:>{_CELL}}" for cell in cells)

    yield line("series", [f"{preset:.0e}" for preset in PRESETS])
    for series in found.series():
        rows = [found.fastest(preset, series.__eq__) for preset in PRESETS]
        yield line(series.name, [_cell(r.seconds, r.setting.elements) if r else "-" for r in rows])
    cells = ["failed" if c.failure else _cell(c.seconds, c.elements) for c in found.choices]
    yield line("automatic", cells)


def _cell(seconds: float | None, elements: int) -> str:
    return f"{milliseconds(seconds)} ({elements})"


def milliseconds(seconds: float | None) -> str:
    """Three digits of milliseconds."""
    value = _MILLI * (seconds or 0.0)
    return f"{value:.3g}" if value < 1e3 else f"{value:.0f}"


def _failures(found: Chart) -> Iterator[str]:
    """Settings that failed, those of a series with the same reason together."""
    reasons: dict[tuple[Series, str], list[int]] = {}
    for row in found.rows:
        if row.failure:
            key = (row.setting.series, row.failure)
            reasons.setdefault(key, []).append(row.setting.elements)
    if reasons:
        yield from ("", "failed")
    for (series, why), elements in reasons.items():
        yield from folded(f"  {series.name}, {', '.join(map(str, elements))} elements: {why}")


def _preset(found: Chart, preset: float, choice: Choice) -> Iterator[str]:
    """The fastest setting that a deck can ask for, and the program's own choice."""
    row = found.fastest(preset, lambda series: series.in_deck)
    reached = choice.errors is not None and choice.errors.largest <= preset
    if row is not None and row.errors is not None:
        yield from folded(
            f"{preset:.0e}: {_mesh(row.setting)}, error {row.errors.largest:.1e}, "
            f"{milliseconds(row.seconds)} ms, built in {milliseconds(row.building)} ms"
        )
    else:
        yield f"{preset:.0e}: no ELEMENTS and ORDER that were measured reach it"
    if row is not None or reached:
        setting = row.setting if row else None
        yield from (f"    {x}" for x in deck_lines(found.numerics, preset, setting).splitlines())
    if choice.errors is None:
        yield from folded(f"  automatic choice: failed, {choice.failure}")
        return
    mesh = _mesh(Setting(Series(choice.degree), choice.elements))
    yield from folded(
        f"  automatic choice: {mesh}, error {choice.errors.largest:.1e} (estimated "
        f"{choice.estimate:.1e}), {milliseconds(choice.seconds)} ms all told, its last mesh alone "
        f"{milliseconds(choice.last)} ms"
    )


def _mesh(setting: Setting) -> str:
    return f"{setting.elements} elements of degree {setting.series.degree}"


def chart_csv(found: Chart) -> str:
    """Every setting and every choice at full precision: `#` lines, column names, the table."""
    out = StringIO()
    reference = found.reference
    for name, value in (
        ("Title", found.title),
        ("Foundation", found.foundation),
        ("Steps", found.steps),
        ("Machine", found.machine),
        ("Reference", f"{reference.elements} elements of degree {reference.degree}"),
        ("Error of the reference", repr(reference.error)),
    ):
        out.write(f"# {name}: {value}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(_COLUMNS)
    front = found.front()
    writer.writerows(_row_cells(row, row in front) for row in found.rows)
    writer.writerows(map(_choice_cells, found.choices))
    return out.getvalue()


def _row_cells(row: Row, on_front: bool) -> list[object]:
    one = row.setting.series
    return [
        *("setting", one.name, row.setting.elements, one.degree, one.reactions, one.method),
        *("yes" if one.spatial else "no", "", *_measured(row), ""),
        *(_number(row.seconds), row.runs, repr(row.building), "", row.unknowns),
        *(row.iterations, row.evaluations, "yes" if on_front else "no", row.failure),
    ]


def _choice_cells(one: Choice) -> list[object]:
    own = Series(one.degree)
    return [
        *("automatic", "automatic", one.elements, one.degree, own.reactions, own.method, ""),
        *(repr(one.accuracy), *_measured(one), repr(one.estimate), _number(one.seconds)),
        *(one.runs, "", _number(one.last), "", "", "", "", one.failure),
    ]


def _measured(one: Row | Choice) -> list[str]:
    """Status and errors."""
    if one.errors is None:
        return ["failed", "", "", "", ""]
    e = one.errors
    return ["solved", *map(repr, (e.largest, e.displacement, e.reaction, e.moment))]


def _number(value: float | None) -> str:
    return "" if value is None else repr(value)
