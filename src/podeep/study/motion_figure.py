"""The picture of a chart of motion."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..picture import PALETTE, ZERO, new_figure, save_picture
from ..units import short
from .chart_figure import CHOICE, FRONT, LEAST, UNSURE, listed, milliseconds_up
from .motion_chart import MotionChart, MotionRow

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MILLI = 1e3
_PENS = {
    "NEWMARK": (PALETTE[0], "-", "o"),
    "HHT": (PALETTE[1], "-", "s"),
    "GALPHA": (PALETTE[2], "--", "^"),
    "BATHE": (PALETTE[4], "-", "D"),
    "ROS2": (PALETTE[7], "-.", "v"),
    "CONSERVE": (PALETTE[6], "-", "X"),
    "CENTRAL": (PALETTE[9], ":", "P"),
}


def save_motion_chart(found: MotionChart, folder: Path, case: str) -> Path:
    """Draw a chart into `<case>_<foundation>_motion_chart[_n].png`."""
    stem = f"{case}_{found.foundation}_motion_chart"
    return save_picture(lambda: draw_motion_chart(found, case), folder, stem)


def draw_motion_chart(found: MotionChart, case: str) -> "Figure":
    """CPU time against error: each method's best, all else as dots, what the program chooses."""
    figure = new_figure(10.0, 7.0)
    axes = figure.subplots()
    _frame(axes, found)
    front = [_place(row) for row in found.front()]
    if front:
        wide: dict[str, Any] = {"color": FRONT, "linewidth": 7.0, "drawstyle": "steps-pre"}
        axes.plot(*zip(*front, strict=True), label="best of all", zorder=1, **wide)
    for method in found.methods():
        _method(axes, found, method)
    _fastest(axes, found)
    _choices(axes, found)
    whole = short(found.dynamics.end - found.dynamics.start)
    span = f"the first {short(found.span)} s of {whole} s"
    title = f"{case}, {found.foundation}: speed against accuracy in motion, {span}"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, parse_math=False)
    axes.set_title(found.machine, loc="left", fontsize=8, color=ZERO, parse_math=False)
    figure.legend(loc="outside lower left", frameon=False, fontsize=9, handlelength=3.2, ncols=4)
    return figure


def _frame(axes: "Axes", found: MotionChart) -> None:
    milliseconds_up(axes)
    every = [row.errors for row in (*found.rows, *(c.row for c in found.choices if c.row))]
    known = [*found.accuracies, *(max(e.largest, LEAST) for e in every if e)]
    left, right = 0.35 * min(known), 2.0 * max(known)
    axes.set_xlim(left, right)
    axes.margins(y=0.12)  # room for what is written below points
    least = min((one.error for one in found.references), default=0.0)
    if least > left:
        axes.axvspan(left, least, color=UNSURE, label="below the error of the reference", zorder=0)
    axes.set_xlabel("Larger relative error of displacements and of the largest moment")
    axes.set_ylabel(f"CPU time of all steps in {short(found.span)} s of motion (ms)")
    for number, preset in enumerate(found.accuracies):
        label = "_" if number else f"errors {listed(found.accuracies)}"  # matplotlib lists no "_"
        axes.axvline(preset, color=ZERO, linewidth=1.1, linestyle=":", label=label, zorder=2)


def _method(axes: "Axes", found: MotionChart, method: str) -> None:
    """A line along what is best of a method, and dots where it is not."""
    rows = [row for row in found.rows if row.setting.series.method == method]
    best = found.front(method)
    color, line, marker = _PENS[method]
    label = method
    if failed := sum(row.errors is None for row in rows):
        label += f" ({failed} failed)"
    places = [_place(row) for row in best]
    x, y = zip(*places, strict=True) if places else ((), ())
    pen: dict[str, Any] = {"color": color, "marker": marker, "markersize": 4.0}
    axes.plot(x, y, label=label, linestyle=line, linewidth=1.5, zorder=3, **pen)
    others = [_place(row) for row in rows if row.errors and row not in best]
    if others:
        axes.plot(*zip(*others, strict=True), linestyle="", alpha=0.35, zorder=2, **pen)


def _place(row: MotionRow) -> tuple[float, float]:
    """Error and CPU time (ms) of a setting that was solved."""
    assert row.errors is not None
    return max(row.errors.largest, LEAST), _MILLI * (row.seconds or 0.0)


def _fastest(axes: "Axes", found: MotionChart) -> None:
    """A ring around the fastest setting for each accuracy, with method and steps."""
    rows = [row for preset in found.accuracies if (row := found.fastest(preset))]
    beside: dict[str, Any] = {"xytext": (-7, -22), "textcoords": "offset points", "fontsize": 8}
    beside |= {"ha": "right"}  # nothing is faster and more exact
    unit = "steps" if found.period is None else "steps a period"  # the shortest
    for row in rows:
        text = f"{row.setting.series.method},\n{found.rate(row)} {unit}"
        axes.annotate(text, _place(row), **beside)
    if rows:
        ring: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 11.0}
        ring |= {"color": CHOICE, "markerfacecolor": "none", "zorder": 5}
        axes.plot(*zip(*map(_place, rows), strict=True), label="fastest within an error", **ring)


def _choices(axes: "Axes", found: MotionChart) -> None:
    """Stars for each choice of the program, with the accuracy it was asked for."""
    rows = [(one, one.row) for one in found.choices if one.row and one.row.errors]
    for number, (one, row) in enumerate(rows):
        x, steps = _place(row)
        whole = _MILLI * (one.seconds or 0.0)
        star: dict[str, Any] = {"linestyle": "", "marker": "*", "color": CHOICE, "zorder": 5}
        words = "automatic for *ACCURACY, all told", "its steps alone"
        labels = ("_", "_") if number else words  # matplotlib lists no "_"
        axes.plot(x, whole, markersize=12.0, label=labels[0], **star)
        axes.plot(x, steps, markersize=12.0, label=labels[1], markerfacecolor="white", **star)
        axes.plot([x, x], [steps, whole], color=CHOICE, linewidth=0.7, linestyle="--", zorder=2)
        near: dict[str, Any] = {"xytext": (8, 4), "textcoords": "offset points", "fontsize": 8}
        axes.annotate(listed([one.accuracy]), (x, whole), **near)
