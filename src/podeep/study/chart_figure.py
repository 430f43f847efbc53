"""The picture of a chart of speed against accuracy."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..picture import PALETTE, ZERO, new_figure, save_picture
from .chart import AnySeries, Chart, Choice, RelativeErrors, Row, S
from .chart_report import steps
from .line_settings import LineSeries
from .settings import Series

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MILLI = 1e3
LEAST = 1e-14  # an error of nothing is drawn here
FRONT, UNSURE, CHOICE = "#c9c9c9", "#f1f1f1", "#111111"
_DEGREES = {3: PALETTE[4], 5: PALETTE[1], 7: PALETTE[0]}
_LUMPED = PALETTE[8]
_BELOW: dict[str, Any] = {"xytext": (0, -18), "ha": "center"}  # of a point, centred


def save_chart(found: Chart[S], folder: Path, case: str) -> Path:
    """Draw a chart into `<case>_<name>_chart[_n].png`."""
    return save_picture(lambda: draw_chart(found, case), folder, f"{case}_{found.name}_chart")


def draw_chart(found: Chart[S], case: str) -> "Figure":
    """CPU time against parts of the error: series, the front, what the program chooses."""
    drawn = found.words.drawn
    figure = new_figure(10.0 if len(drawn) == 1 else 13.0, 7.0)
    panels = figure.subplots(1, len(drawn), sharey=True, squeeze=False)[0]
    for axes, (part, label) in zip(panels, drawn, strict=True):
        _panel(axes, found, part)
        axes.set_xlabel(label)
    _named(panels[0], found, drawn[0][0])
    panels[0].set_ylabel("CPU time of all steps (ms)")
    title = f"{case}, {found.name}: speed against accuracy, {steps(found)}"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, parse_math=False)
    panels[0].set_title(found.machine, loc="left", fontsize=8, color=ZERO, parse_math=False)
    handles, labels = panels[0].get_legend_handles_labels()
    below: dict[str, Any] = {"loc": "outside lower left", "frameon": False, "fontsize": 9}
    figure.legend(handles, labels, handlelength=3.2, ncols=4, **below)
    return figure


def _panel(axes: "Axes", found: Chart[S], part: str) -> None:
    _frame(axes, found, part)
    front = [_place(row, part) for row in found.front(part)]
    if front:
        wide: dict[str, Any] = {"color": FRONT, "linewidth": 7.0, "drawstyle": "steps-pre"}
        axes.plot(*zip(*front, strict=True), label="best of all", zorder=1, **wide)
    for series, rows in found.series().items():
        places = [_place(row, part) for row in rows if row.errors]
        label = series.name
        if failed := len(rows) - len(places):
            label += f" ({failed} failed)"
        x, y = zip(*places, strict=True) if places else ((), ())
        axes.plot(x, y, label=label, zorder=3, **_pen(series))
    _rings(axes, found, part)
    _choices(axes, found, part)


def _frame(axes: "Axes", found: Chart[S], part: str) -> None:
    milliseconds_up(axes)
    every = [*(row.errors for row in found.rows), *(one.errors for one in found.choices)]
    known = [*found.accuracies, *(_error(e, part) for e in every if e)]
    room = 0.25 if _behind(found) else 0.5  # for words left of the first point
    left, right = room * min(known), 2.0 * max(known)
    axes.set_xlim(left, right)
    axes.margins(y=0.12)  # room for what is written below points
    if (unsure := found.reference.errors.part(part)) > left:
        label = "below the error of the reference"
        axes.axvspan(left, unsure, color=UNSURE, label=label, zorder=0)
    for number, accuracy in enumerate(found.accuracies):
        label = "_" if number else f"errors {listed(found.accuracies)}"  # matplotlib lists no "_"
        axes.axvline(accuracy, color=ZERO, linewidth=1.1, linestyle=":", label=label, zorder=2)


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


def _pen(series: AnySeries) -> dict[str, Any]:
    if isinstance(series, LineSeries):
        return _line_pen(series)
    assert isinstance(series, Series)
    return _foundation_pen(series)


def _foundation_pen(series: Series) -> dict[str, Any]:
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


def _line_pen(series: LineSeries) -> dict[str, Any]:
    """Colour by the form of the contact, line and marker by the mesh."""
    return {
        "color": _LUMPED if series.form == "nodal" else _DEGREES[5],
        "linestyle": "-" if series.graded else "--",
        "linewidth": 1.5,
        "marker": "o" if series.graded else "s",
        "markersize": 4.5,
        "markerfacecolor": None if series.graded else "white",
    }


def _error(errors: RelativeErrors, part: str) -> float:
    return max(errors.part(part), LEAST)


def _place(row: Row[S], part: str) -> tuple[float, float]:
    """Error and CPU time (ms) of a setting that was solved."""
    assert row.errors is not None
    return _error(row.errors, part), _MILLI * (row.seconds or 0.0)


def _rings(axes: "Axes", found: Chart[S], part: str) -> None:
    """A ring around the fastest setting of a deck for each accuracy."""
    places = [_place(row, part) for row in _best(found)]
    if places:
        ring: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 11.0}
        ring |= {"color": CHOICE, "markerfacecolor": "none", "zorder": 5}
        label = "fastest that a deck can ask for"
        axes.plot(*zip(*places, strict=True), label=label, **ring)


def _named(axes: "Axes", found: Chart[S], part: str) -> None:
    """Meshes beside the rings, where no others are."""
    near: dict[str, Any] = {"xytext": (10, 4)} if _behind(found) else _BELOW
    for row in _best(found):
        text = row.setting.mesh.replace(" elements", "", 1)
        axes.annotate(text, _place(row, part), fontsize=8, textcoords="offset points", **near)


def _behind(found: Chart[S]) -> bool:
    """Whether settings of a deck are slower or less exact than others."""
    return any(row not in found.front(found.words.drawn[0][0]) for row in _best(found))


def _best(found: Chart[S]) -> list[Row[S]]:
    """The fastest setting of a deck for each accuracy, once each."""
    rows = [found.fastest(one, lambda series: series.in_deck) for one in found.accuracies]
    return list(dict.fromkeys(row for row in rows if row))


def _choices(axes: "Axes", found: Chart[S], part: str) -> None:
    """Stars for each choice of the program, with the accuracies it was asked for."""
    asked: dict[object, list[Choice[S]]] = {}
    for one in found.choices:
        if one.errors:
            asked.setdefault(one.setting, []).append(one)
    for number, same in enumerate(asked.values()):
        x = next(_error(one.errors, part) for one in same if one.errors)
        whole, last = (_MILLI * (s or 0.0) for s in (same[0].seconds, same[0].last))
        star: dict[str, Any] = {"linestyle": "", "marker": "*", "color": CHOICE, "zorder": 5}
        words = ("automatic for *ACCURACY, all told", "its last mesh alone")
        labels = words if number == 0 else ("_", "_")  # matplotlib lists no "_"
        axes.plot(x, whole, markersize=12.0, label=labels[0], **star)
        axes.plot(x, last, markersize=12.0, label=labels[1], markerfacecolor="white", **star)
        axes.plot([x, x], [last, whole], color=CHOICE, linewidth=0.7, linestyle="--", zorder=2)
        near: dict[str, Any] = {"xytext": (8, 4)}
        if _behind(found):  # rings have theirs on the right
            near = {"xytext": (-8, 4), "ha": "right"}
        near |= {"textcoords": "offset points", "fontsize": 8}
        axes.annotate(listed([one.accuracy for one in same]), (x, whole), **near)


def listed(errors: Sequence[float]) -> str:
    """Errors as 1e-2, 1e-3."""
    return ", ".join(f"{error:.0e}".replace("e-0", "e-") for error in errors)
