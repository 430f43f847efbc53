"""The picture of a chart of speed against accuracy."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..picture import PALETTE, ZERO, new_figure, save_picture
from .chart import Chart, Choice, Row
from .settings import PRESETS, Series

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MILLI = 1e3
LEAST = 1e-14  # an error of nothing is drawn here
FRONT, UNSURE, CHOICE = "#c9c9c9", "#f1f1f1", "#111111"
_DEGREES = {3: PALETTE[4], 5: PALETTE[1], 7: PALETTE[0]}
_LUMPED = PALETTE[8]


def save_chart(found: Chart, folder: Path, case: str) -> Path:
    """Draw a chart into `<case>_<foundation>_chart[_n].png`."""
    return save_picture(lambda: draw_chart(found, case), folder, f"{case}_{found.foundation}_chart")


def draw_chart(found: Chart, case: str) -> "Figure":
    """CPU time against error: a line for each series, the front, what the program chooses."""
    figure = new_figure(10.0, 7.0)
    axes = figure.subplots()
    _frame(axes, found)
    front = [_place(row) for row in found.front()]
    if front:
        wide: dict[str, Any] = {"color": FRONT, "linewidth": 7.0, "drawstyle": "steps-pre"}
        axes.plot(*zip(*front, strict=True), label="best of all", zorder=1, **wide)
    for series, rows in found.series().items():
        places = [_place(row) for row in rows if row.errors]
        label = series.name
        if failed := len(rows) - len(places):
            label += f" ({failed} failed)"
        x, y = zip(*places, strict=True) if places else ((), ())
        axes.plot(x, y, label=label, zorder=3, **_pen(series))
    _fastest(axes, found)
    _choices(axes, found)
    title = f"{case}, {found.foundation}: speed against accuracy, {found.steps} steps"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, parse_math=False)
    axes.set_title(found.machine, loc="left", fontsize=8, color=ZERO, parse_math=False)
    figure.legend(loc="outside lower left", frameon=False, fontsize=9, handlelength=3.2, ncols=4)
    return figure


def _frame(axes: "Axes", found: Chart) -> None:
    milliseconds_up(axes)
    every = [*(row.errors for row in found.rows), *(one.errors for one in found.choices)]
    known = [*PRESETS, *(max(e.largest, LEAST) for e in every if e)]
    left, right = 0.5 * min(known), 2.0 * max(known)
    axes.set_xlim(left, right)
    axes.margins(y=0.12)  # room for what is written below points
    if found.reference.error > left:
        label = "below the error of the reference"
        axes.axvspan(left, found.reference.error, color=UNSURE, label=label, zorder=0)
    axes.set_xlabel("Largest relative error of displacement, reaction and moment in any step")
    axes.set_ylabel("CPU time of all steps (ms)")
    for number, preset in enumerate(PRESETS):
        label = "_" if number else f"errors {listed(PRESETS)}"  # matplotlib lists no "_"
        axes.axvline(preset, color=ZERO, linewidth=1.1, linestyle=":", label=label, zorder=2)


def milliseconds_up(axes: "Axes") -> None:
    """Logarithmic scales with round times and a light grid."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.grid(color="#e4e4e4", linewidth=0.7)
    axes.set_axisbelow(True)


def _pen(series: Series) -> dict[str, Any]:
    """Colour by degree or lumping, line by iteration, marker by what else differs."""
    lumped = series.reactions == "lumped"
    style = {"line search": "-", "full steps": "--", "secant": "-."}[series.method]
    return {
        "color": _LUMPED if lumped else _DEGREES[series.degree],
        "linestyle": ":" if series.spatial else style,
        "linewidth": 1.5,
        "marker": "s" if lumped else "^" if series.spatial else "o",
        "markersize": 4.0,
        "markerfacecolor": None if series.method == "line search" else "white",
    }


def _place(row: Row) -> tuple[float, float]:
    """Error and CPU time (ms) of a setting that was solved."""
    assert row.errors is not None
    return max(row.errors.largest, LEAST), _MILLI * (row.seconds or 0.0)


def _fastest(axes: "Axes", found: Chart) -> None:
    """A ring around the fastest setting of a deck for each preset, with elements and degree."""
    rows = [found.fastest(preset, lambda series: series.in_deck) for preset in PRESETS]
    chosen = {row.setting: _place(row) for row in rows if row}
    for setting, place in chosen.items():
        text = f"{setting.elements} of degree {setting.series.degree}"
        below: dict[str, Any] = {"xytext": (0, -18), "textcoords": "offset points", "ha": "center"}
        axes.annotate(text, place, fontsize=8, **below)
    if chosen:
        ring: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 11.0}
        axes.plot(
            *zip(*chosen.values(), strict=True),
            color=CHOICE,
            markerfacecolor="none",
            label="fastest that a deck can ask for",
            zorder=5,
            **ring,
        )


def _choices(axes: "Axes", found: Chart) -> None:
    """Stars for each choice of the program, with the accuracies it was asked for."""
    asked: dict[tuple[int, int], list[Choice]] = {}
    for one in found.choices:
        if one.errors:
            asked.setdefault((one.elements, one.degree), []).append(one)
    for number, same in enumerate(asked.values()):
        x = next(max(one.errors.largest, LEAST) for one in same if one.errors)
        whole, last = (_MILLI * (s or 0.0) for s in (same[0].seconds, same[0].last))
        star: dict[str, Any] = {"linestyle": "", "marker": "*", "color": CHOICE, "zorder": 5}
        words = ("automatic for *ACCURACY, all told", "its last mesh alone")
        labels = words if number == 0 else ("_", "_")  # matplotlib lists no "_"
        axes.plot(x, whole, markersize=12.0, label=labels[0], **star)
        axes.plot(x, last, markersize=12.0, label=labels[1], markerfacecolor="white", **star)
        axes.plot([x, x], [last, whole], color=CHOICE, linewidth=0.7, linestyle="--", zorder=2)
        near: dict[str, Any] = {"xytext": (8, 4), "textcoords": "offset points", "fontsize": 8}
        axes.annotate(listed([one.accuracy for one in same]), (x, whole), **near)


def listed(errors: Sequence[float]) -> str:
    """Errors as 1e-2, 1e-3."""
    return ", ".join(f"{error:.0e}".replace("e-0", "e-") for error in errors)
