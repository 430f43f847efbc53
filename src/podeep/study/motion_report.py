"""A chart of motion in words, and as CSV."""

import csv
from collections.abc import Iterator
from io import StringIO

from ..report import folded
from ..units import short
from .chart_report import milliseconds
from .motion_chart import TENTH, MotionChart, MotionChoice, MotionRow
from .motion_settings import EXPLICIT, MotionSeries, motion_lines

_MILLI = 1e3
_NAME, _CELL = 12, 16  # widths of the table's columns

_WORDS = (
    "-: no step that was measured reaches it. Errors are those of steps in time, on the mesh that "
    "the program makes for each accuracy. NEWMARK: with the factors of the deck; HHT: with alpha = "
    "-0.05, what is taken without METHOD; GALPHA: generalised alpha; BATHE: two stages a step; "
    "ROS2: Rosenbrock's, without iteration; automatic: *ACCURACY alone, with building, trials of "
    "steps and a second motion for the estimate of the error."
)

_COLUMNS = (
    *("kind", "method", "accuracy asked", "step [s]", "steps", "steps in the shortest period"),
    *("elements", "degree", "status", "error", "error of displacement", "error of moment"),
    *("estimated error", "CPU time [s]", "runs", "CPU time all told [s]"),
    *("iterations", "evaluations", "on the front", "reason"),
)


def motion_report(found: MotionChart) -> str:
    """The chart of a foundation: a table of methods against errors, then lines for the deck."""
    lines = [found.title] if found.title else []
    whole = found.dynamics.end - found.dynamics.start
    lines += folded(
        f"{found.foundation}: speed against accuracy in motion, the first {short(found.span)} s "
        f"of {short(whole)} s, {len(found.rows)} settings"
    )
    lines += [*folded(found.machine), *_references(found), *folded(_explicit(found))]
    unit = "steps in all" if found.period is None else f"steps in {short(found.period)} s"
    lines += [
        "",
        *folded(f"CPU time of all steps in ms, and {unit}, of the fastest within an error"),
    ]
    lines += ["(it and all shorter steps of its method; building is not counted)"]
    lines += [f"medians of {_runs(found)}", "", *_table(found), "", *folded(_WORDS)]
    lines += [*_failures(found), *_cut(found)]
    lines += ["", "lines for the deck, in place of its own *ACCURACY and *DYNAMIC"]
    for choice in found.choices:
        lines += ["", *_preset(found, choice)]
    return "\n".join(lines)


def _references(found: MotionChart) -> Iterator[str]:
    """What the errors are measured against."""
    yield f"converged motion by {found.default}, on the mesh for"
    for one in found.references:
        text = (
            f"  {one.accuracy:.0e}: {_mesh(one.elements, one.degree)}, steps of {_step(one.step)}, "
            f"error {one.error:.1e}"
        )
        if not one.sure:
            text += f", more than {TENTH:g} of {one.accuracy:.0e}: errors near it are not sure"
        if one.mesh_error:
            text += f"; the mesh adds {one.mesh_error.largest:.1e}"
        yield from folded(text)


def _explicit(found: MotionChart) -> str:
    """What explicit differences need."""
    text = f"{EXPLICIT} is stable with steps up to {_step(found.limit)}"
    return text if EXPLICIT in found.methods() else f"{text} alone: it is not measured"


def _runs(found: MotionChart) -> str:
    """How often what was solved was timed; slow runs are not repeated."""
    runs = {row.runs for row in found.rows if row.errors}
    least, most = min(runs, default=0), max(runs, default=0)
    many = f"{least} to {most}" if least < most else f"{most}"
    return f"{many} run{'s' * (most != 1)}"


def _table(found: MotionChart) -> Iterator[str]:
    def line(name: str, cells: list[str]) -> str:
        return f"{name:<{_NAME}}" + "".join(f"{cell:>{_CELL}}" for cell in cells)

    yield line("method", [f"{preset:.0e}" for preset in found.accuracies])
    for method in found.methods():
        rows = [found.fastest(preset, method) for preset in found.accuracies]
        yield line(method, [_cell(found, r, r.seconds) if r else "-" for r in rows])
    cells = [
        _cell(found, c.row, c.seconds) if c.row and not c.failure else "failed"
        for c in found.choices
    ]
    yield line("automatic", cells)


def _cell(found: MotionChart, row: MotionRow, seconds: float | None) -> str:
    return f"{milliseconds(seconds)} ({found.rate(row)})"


def _failures(found: MotionChart) -> Iterator[str]:
    """Settings that failed, those of a series with the same reason together."""
    reasons: dict[tuple[MotionSeries, str], list[str]] = {}
    for row in found.rows:
        if row.failure:
            key = row.setting.series, row.failure
            reasons.setdefault(key, []).append(_step(row.setting.step))
    if reasons:
        yield from ("", "failed")
    for (series, why), steps in reasons.items():
        yield from folded(f"  {series.method}, steps of {', '.join(steps)}: {why}")


def _cut(found: MotionChart) -> Iterator[str]:
    """Series that were cut short."""
    if found.cut:
        yield from ("", "shorter steps left out, for time")
    for accuracy in dict.fromkeys(series.accuracy for series in found.cut):
        names = [series.method for series in found.cut if series.accuracy == accuracy]
        yield f"  {accuracy:.0e}: {', '.join(names)}"


def _preset(found: MotionChart, choice: MotionChoice) -> Iterator[str]:
    """The fastest setting for an accuracy, and the program's own choice."""
    preset, row = choice.accuracy, found.fastest(choice.accuracy)
    if row is not None and row.errors is not None:
        series = row.setting.series
        yield from folded(
            f"{preset:.0e}: {series.method}, steps of {_step(row.setting.step)}, error "
            f"{row.errors.largest:.1e}, {milliseconds(row.seconds)} ms"
        )
        lines = motion_lines(found.dynamics, preset, series.method, row.setting.step)
        yield from (f"    {line}" for line in lines.splitlines())
    else:
        yield f"{preset:.0e}: no method and step that were measured reach it"
    if choice.failure or choice.row is None or choice.errors is None:
        yield from folded(f"  automatic choice: {choice.failure}")
        return
    yield from folded(
        f"  automatic choice: {choice.row.setting.series.method}, steps of "
        f"{_step(choice.row.setting.step)}, error {choice.errors.largest:.1e} (estimated "
        f"{choice.estimate:.1e}), {milliseconds(choice.seconds)} ms all told, its steps alone "
        f"{milliseconds(choice.row.seconds)} ms"
    )


def _mesh(elements: int, degree: int) -> str:
    return f"{elements} elements of degree {degree}"


def _step(seconds: float) -> str:
    return f"{_MILLI * seconds:.3g} ms"


def motion_csv(found: MotionChart) -> str:
    """Every setting and every choice at full precision: `#` lines, column names, the table."""
    out = StringIO()
    pairs: list[tuple[str, object]] = [
        ("Title", found.title),
        ("Foundation", found.foundation),
        ("Charted [s]", repr(found.span)),
        ("Shortest period [s]", "" if found.period is None else repr(found.period)),
        ("Machine", found.machine),
        ("Longest stable step of CENTRAL [s]", repr(found.limit)),
    ]
    for one in found.references:
        mesh = "not known" if one.mesh_error is None else repr(one.mesh_error.largest)
        pairs.append(
            (
                f"Converged motion for {one.accuracy:g}",
                f"{_mesh(one.elements, one.degree)}, steps of {one.step!r} s, error "
                f"{one.error!r}, error of the mesh {mesh}",
            )
        )
    for name, value in pairs:
        out.write(f"# {name}: {value}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(_COLUMNS)
    front = found.front()
    writer.writerows(_cells(found, row, "yes" if row in front else "no") for row in found.rows)
    writer.writerows(_choice_cells(found, one) for one in found.choices)
    return out.getvalue()


def _cells(found: MotionChart, row: MotionRow, on_front: str) -> list[object]:
    series, e = row.setting.series, row.errors
    errors = ["solved", repr(e.largest), repr(e.displacement), repr(e.moment)] if e else ["failed"]
    errors += [""] * (4 - len(errors))
    return [
        *("setting", series.method, repr(series.accuracy), repr(row.setting.step), row.steps),
        *("" if found.period is None else found.rate(row), row.elements, row.degree, *errors, ""),
        *("" if row.seconds is None else repr(row.seconds), row.runs, "", row.iterations),
        *(row.evaluations, on_front, row.failure),
    ]


def _choice_cells(found: MotionChart, one: MotionChoice) -> list[object]:
    if one.row is None:
        return ["automatic", "", repr(one.accuracy), *[""] * 5, "failed", *[""] * 10, one.failure]
    cells = _cells(found, one.row, "")
    cells[0] = "automatic"
    cells[_COLUMNS.index("estimated error")] = repr(one.estimate)
    told = "" if one.seconds is None else repr(one.seconds)
    cells[_COLUMNS.index("CPU time all told [s]")] = told
    return cells
