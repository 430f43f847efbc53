"""A chart of speed against accuracy in words, and as CSV."""

import csv
from collections.abc import Iterator, Sequence
from io import StringIO

from ..report import folded
from .chart import Chart, Choice, RelativeErrors, Row, S, Setting

_MILLI = 1e3
_NAME, _CELL = 26, 13  # widths of the table's columns
_MESH = ("kind", "series", "elements")
_ERRORS = ("accuracy asked", "status", "error")
_WORK = (
    *("estimated error", "CPU time [s]", "runs", "CPU time of building [s]"),
    "CPU time of the last mesh [s]",
    *("unknowns", "iterations", "evaluations", "on the front", "reason"),
)
_LEGEND = (
    "-: no mesh that was measured reaches it. {}; automatic: *ACCURACY alone, with building, "
    "estimates of the error and refinement."
)


def chart_report(found: Chart[S]) -> str:
    """A chart in words: a table of series against errors, then lines for the deck."""
    lines = [found.title] if found.title else []
    lines += folded(
        f"{found.name}: speed against accuracy, {steps(found)}, {len(found.rows)} settings"
    )
    lines += folded(found.machine)
    lines += folded(_known(found))
    lines += ["", "CPU time of all steps in ms, and elements, of the fastest within an error"]
    lines += ["(it and all finer meshes of its series; building is not counted)"]
    lines += [
        f"medians of {_runs(found)}",
        "",
        *_table(found),
        "",
        *folded(_LEGEND.format(found.words.legend)),
        *_failures(found),
        *_cut(found),
    ]
    lines += ["", f"lines for the deck, in place of its own {found.words.replaced}"]
    for choice in found.choices:
        lines += ["", *_asked(found, choice)]
    return "\n".join(lines)


def steps(found: Chart[S]) -> str:
    """How many steps there are."""
    return f"{found.steps} step{'s' * (found.steps != 1)}"


def _runs(found: Chart[S]) -> str:
    """How often what was solved was timed; slow runs are not repeated."""
    runs = [row.runs for row in found.rows if row.errors]
    runs += [one.runs for one in found.choices if one.errors]
    few, many = min(runs, default=0), max(runs, default=0)
    return f"{few} to {many} runs" if few < many else f"{many} run{'s' * (many != 1)}"


def _known(found: Chart[S]) -> str:
    """What the errors are measured against."""
    one = found.reference
    text = (
        f"converged reference: {one.elements} elements of degree {one.degree}; half as many "
        f"are off by {one.errors.largest:.1e}"
    )
    if not found.sure:
        share, least = found.words.margin, min(found.accuracies)
        text += f", more than {share:g} of {least:.0e}: errors near it are not sure"
    return text


def _table(found: Chart[S]) -> Iterator[str]:
    def line(name: str, cells: list[str]) -> str:
        return f"{name:<{_NAME}}" + "".join(f"{cell:>{_CELL}}" for cell in cells)

    yield line("series", [f"{accuracy:.0e}" for accuracy in found.accuracies])
    for series in found.series():
        rows = [found.fastest(accuracy, series.__eq__) for accuracy in found.accuracies]
        yield line(series.name, [_cell(row, "-") for row in rows])
    yield line("automatic", [_cell(choice, "failed") for choice in found.choices])


def _cell(one: Row[S] | Choice[S] | None, otherwise: str) -> str:
    if one is None or one.setting is None or one.errors is None:
        return otherwise
    return f"{milliseconds(one.seconds)} ({one.setting.elements})"


def milliseconds(seconds: float | None) -> str:
    """Three digits of milliseconds."""
    value = _MILLI * (seconds or 0.0)
    return f"{value:.3g}" if value < 1e3 else f"{value:.0f}"


def _failures(found: Chart[S]) -> Iterator[str]:
    """Settings that failed, those of a series with the same reason together."""
    failed = [row for row in found.rows if row.failure]
    if failed:
        yield from ("", "failed")
    for why in dict.fromkeys((row.setting.series, row.failure) for row in failed):
        same = [row.setting for row in failed if (row.setting.series, row.failure) == why]
        yield from folded(f"  {_several(same)}: {why[1]}")


def _cut(found: Chart[S]) -> Iterator[str]:
    """Settings that were left out."""
    if found.cut:
        yield from ("", "left out, for time")
    for series in dict.fromkeys(setting.series for setting in found.cut):
        yield from folded(f"  {_several([one for one in found.cut if one.series == series])}")


def _several(settings: Sequence[Setting[S]]) -> str:
    """Settings of a series."""
    return f"{settings[0].series.name}, {', '.join(str(s.elements) for s in settings)} elements"


def _asked(found: Chart[S], choice: Choice[S]) -> Iterator[str]:
    """The fastest setting that a deck can ask for, and the program's own choice."""
    accuracy, row = choice.accuracy, found.fastest(choice.accuracy, lambda series: series.in_deck)
    reached = choice.errors is not None and choice.errors.largest <= accuracy
    if row is not None and row.errors is not None:
        yield from folded(
            f"{accuracy:.0e}: {row.setting.mesh}, error {row.errors.largest:.1e}, "
            f"{milliseconds(row.seconds)} ms, built in {milliseconds(row.building)} ms"
        )
    else:
        yield f"{accuracy:.0e}: {found.words.unreached}"
    if row is not None or reached:
        setting = row.setting if row else None
        yield from (f"    {line}" for line in found.deck_lines(accuracy, setting).splitlines())
    if choice.errors is None or choice.setting is None:
        yield from folded(f"  automatic choice: failed, {choice.failure}")
        return
    yield from folded(
        f"  automatic choice: {choice.setting.mesh}, error {choice.errors.largest:.1e} (estimated "
        f"{choice.estimate:.1e}), {milliseconds(choice.seconds)} ms all told, its last mesh alone "
        f"{milliseconds(choice.last)} ms"
    )


def chart_csv(found: Chart[S]) -> str:
    """Every setting and every choice at full precision: `#` lines, column names, the table."""
    out = StringIO()
    reference, front = found.reference, found.front()
    for name, value in (
        ("Title", found.title),
        (found.words.subject, found.name),
        ("Steps", found.steps),
        ("Machine", found.machine),
        ("Reference", f"{reference.elements} elements of degree {reference.degree}"),
        ("Error of the reference", repr(reference.errors.largest)),
    ):
        out.write(f"# {name}: {value}\n")
    writer = csv.writer(out, lineterminator="\n")
    parts = [f"error of {name}" for name in reference.errors.parts]
    writer.writerow([*_MESH, *found.words.columns, *_ERRORS, *parts, *_WORK])
    for row in found.rows:
        work = [row.unknowns, row.iterations, row.evaluations, "yes" if row in front else "no"]
        start = ["setting", row.setting.series.name, *_setting(found, row.setting), ""]
        times = ["", _number(row.seconds), row.runs, repr(row.building), "", *work, row.failure]
        writer.writerow([*start, *_measured(found, row.errors), *times])
    for one in found.choices:
        start = ["automatic", "automatic", *_setting(found, one.setting), repr(one.accuracy)]
        estimate = "" if one.setting is None else repr(one.estimate)
        times = [estimate, _number(one.seconds), one.runs, "", _number(one.last)]
        writer.writerow([*start, *_measured(found, one.errors), *times, *[""] * 4, one.failure])
    return out.getvalue()


def _setting(found: Chart[S], setting: Setting[S] | None) -> list[object]:
    """Its elements, and what else it is."""
    if setting is None:
        return [""] * (1 + len(found.words.columns))
    return [setting.elements, *setting.series.cells]


def _measured(found: Chart[S], errors: RelativeErrors | None) -> list[str]:
    """Status and errors."""
    if errors is None:
        return ["failed", *[""] * (1 + len(found.reference.errors.parts))]
    return ["solved", *map(repr, (errors.largest, *errors.parts.values()))]


def _number(value: float | None) -> str:
    return "" if value is None else repr(value)
