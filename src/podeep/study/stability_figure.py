"""The picture of the map of the methods of time integration."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..picture import ZERO, new_figure, save_picture
from .limits import GAINED, KEPT, OFF, Limit
from .stability import METHODS, Cause, Cell, StabilityMap, Verdict
from .stability_report import mark
from .trials import TRIALS, Trial

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Light, middle and dark, also in grey; no two of them meet in any colour blindness.
_COLOURS = {Verdict.STABLE: "#dcebf5", Verdict.WRONG: "#eda63a", Verdict.FAILED: "#5a1a3a"}
_LINE, _HALO = "#000000", "#ffffff"


def save_stability(found: StabilityMap, folder: Path) -> Path:
    """Draw a map into `stability[_n].png`."""
    return save_picture(lambda: draw_stability(found), folder, "stability")


def draw_stability(found: StabilityMap) -> "Figure":
    """A panel for each trial: methods in rows, omega h along x, closed forms as lines."""
    from matplotlib.patches import Patch

    figure = new_figure(11.0, 11.5)
    panels = figure.subplots(len(TRIALS), 1, sharex=True)
    edges = _edges(found.steps)
    for trial, axes in zip(TRIALS, panels, strict=True):
        _panel(axes, found, trial, edges)
    panels[-1].set_xlabel("Step, omega h    (lines: closed forms)")
    title = "Methods of time integration against the step (GAMMA=1: NEWMARK, gamma 1, beta 1/2)"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    words = {
        Verdict.STABLE: "stable",
        Verdict.WRONG: f"wrong: ×energy grew over {GAINED - 1.0:.0%}, −more than {1.0 - KEPT:.0%} "
        f"of it was lost, ±end over {OFF:.0%} away",
        Verdict.FAILED: "failed: ✕ without bound, N no equilibrium",
    }
    handles: list[Any] = [Patch(color=_COLOURS[v], label=text) for v, text in words.items()]
    figure.legend(handles=handles, loc="outside lower left", frameon=False, fontsize=9, ncols=3)
    return figure


def _edges(steps: tuple[float, ...]) -> list[float]:
    """Of the cells, halfway between steps of even ratio."""
    ratio = (steps[1] / steps[0]) ** 0.5
    return [steps[0] / ratio, *(step * ratio for step in steps)]


def _panel(axes: "Axes", found: StabilityMap, trial: Trial, edges: list[float]) -> None:
    from matplotlib.colors import ListedColormap

    order = list(Verdict)
    rows = [found.row(trial.name, method) for method in METHODS]
    values = np.array([[order.index(one.verdict) for one in row] for row in rows])
    colours = ListedColormap([_COLOURS[v] for v in order])
    grid: dict[str, Any] = {"edgecolor": _HALO, "linewidth": 0.8, "vmin": 0, "vmax": 2}
    axes.pcolormesh(edges, np.arange(len(rows) + 1.0), values, cmap=colours, **grid)
    axes.set_xscale("log")
    axes.set_xlim(edges[0], edges[-1])
    axes.set_ylim(len(rows), 0.0)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.set_yticks(np.arange(len(rows)) + 0.5, list(METHODS), fontsize=8)
    axes.tick_params(axis="y", length=0.0)
    title = f"{trial.name}: {trial.what}; {trial.rate}"
    axes.set_title(title, loc="left", fontsize=9, parse_math=False)
    half = edges[1] / found.steps[0]
    for number, row in enumerate(rows):
        limit = found.boundary(trial.name, row[0].method).limit
        if limit is not None:
            _limit(axes, limit, number, edges)
        for one in row:
            if limit is None or not one.step / half < limit.step < one.step * half:
                _write(axes, one, number + 0.5)


def _write(axes: "Axes", one: Cell, y: float) -> None:
    """How wrong a cell is."""
    if one.cause is Cause.NONE:
        return
    colour = _HALO if one.verdict is Verdict.FAILED else _LINE
    style: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 7, "color": colour}
    axes.text(one.step, y, mark(one), parse_math=False, **style)


def _limit(axes: "Axes", limit: Limit, row: int, edges: list[float]) -> None:
    """A line across the method's row at the closed form, whose words stand on the right."""
    x, ends = [limit.step] * 2, [row + 0.02, row + 0.98]
    style = "-" if limit.exact else (0, (2, 1))
    axes.plot(x, ends, color=_HALO, linewidth=4.5, solid_capstyle="butt", zorder=4)
    axes.plot(x, ends, color=_LINE, linewidth=2.0, linestyle=style, solid_capstyle="butt", zorder=5)
    relation = "" if limit.exact else "at least "
    text = f"| {relation}{limit.step:.3g}: {limit.words}"
    near: dict[str, Any] = {"fontsize": 7.5, "va": "center", "color": ZERO}
    axes.text(edges[-1] * 1.05, row + 0.5, text, parse_math=False, **near)
