"""Pictures of the soil: reaction curves at a depth, and the capacity of a pile over depth."""

from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from .capacity import Capacity
from .picture import (
    PALETTE,
    ZERO,
    ground,
    new_figure,
    plain_axes,
    quantity_on_top,
    save_picture,
)
from .soil.curves import CurveTable
from .units import short

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_KILO = 1e-3
_FINE = 600  # points that a curve is drawn through, besides those of its table
_COLUMNS = 3
_LETTERS = 10.0  # of a title in an inch
_LONG_TICKS = 1e-3  # numbers up to here have many digits
_SETTLED = 1e-3  # share of the largest reaction by which it still changes
_PRESSED, _PULLED, _UNIT = PALETTE[1], PALETTE[8], PALETTE[4]
_TIP = "#222222"
_WAYS = (("-", 2.2, "governs"), ("--", 1.1, "plugged"), (":", 1.3, "unplugged"))
_GROUND = ("mudline", "layer boundary", "tip")
_LEGEND: dict[str, Any] = {
    "loc": "outside lower left",
    "frameon": False,
    "fontsize": 9,
    "handlelength": 3.2,
}


def save_curves(
    tables: Sequence[CurveTable], title: str, folder: Path, stem: str, *, whole: bool = False
) -> Path:
    """Draw the curves of a depth into `<stem>[_n].png`."""
    return save_picture(lambda: draw_curves(tables, title, whole=whole), folder, stem)


def draw_curves(tables: Sequence[CurveTable], title: str, *, whole: bool = False) -> "Figure":
    """One panel for each curve, as far as its reaction still changes, or the whole of its table."""
    columns = 2 if len(tables) == 4 else min(len(tables), _COLUMNS)
    lines = -(-len(tables) // columns)
    figure = new_figure(max(3.7 * columns, 5.0), 3.5 * lines + 0.8)
    panels = figure.subplots(lines, columns, squeeze=False).ravel()
    for axes, table in zip(panels, tables, strict=False):
        _curve(axes, table, whole)
    for axes in panels[len(tables) :]:
        axes.set_visible(False)
    _title(figure, title)
    figure.legend(*panels[0].get_legend_handles_labels(), ncols=3, **_LEGEND)
    return figure


def _title(figure: "Figure", text: str) -> None:
    folded = fill(text, int(_LETTERS * figure.get_figwidth()))
    figure.suptitle(folded, x=0.01, ha="left", fontsize=11, parse_math=False)


def _curve(axes: "Axes", table: CurveTable, whole: bool) -> None:
    kind = table.kind
    shown = table.displacement
    if not whole:
        shown = shown[np.abs(shown) <= _settled(table)]
    plain_axes(axes, 5 if np.abs(shown).max() > _LONG_TICKS else 3)
    u = np.union1d(shown, np.linspace(min(shown.min(), 0.0), max(shown.max(), 0.0), _FINE))
    axes.axhline(0.0, color=ZERO, linewidth=0.8)
    axes.axvline(0.0, color=ZERO, linewidth=0.8)
    axes.plot(u, _KILO * table.at(u), color=PALETTE[1], linewidth=1.5, label="law")
    dots: dict[str, Any] = {"color": PALETTE[1], "linestyle": "", "marker": "o", "markersize": 3.5}
    axes.plot(shown, _KILO * table.at(shown), label="points of the table", **dots)
    capacity = _KILO * table.capacity
    if np.isfinite(capacity):
        axes.axhline(capacity, color=PALETTE[8], linestyle=":", linewidth=1.5, label="capacity")
    axes.margins(x=0.04, y=0.06)
    laws = (f"{t.name.replace('_', ' ')} {_ids(t.curves)}" for t in table.source.laws)
    note = "\nat the capacity of p-y" if table.follows_lateral else ""
    title = f"{table.name}: {kind.title}\n{' and '.join(laws)}{note}"
    axes.set_title(title, loc="left", fontsize=10, parse_math=False)
    axes.set_xlabel(f"{kind.displacement.capitalize()} ({kind.displacement_unit})")
    axes.set_ylabel(f"Reaction (k{kind.unit})")


def _ids(curves: tuple[int, ...]) -> str:
    return f"({', '.join(map(str, curves))})"


def _settled(table: CurveTable) -> float:
    """The size of displacement two points of the table beyond the last change of its reaction."""
    sizes = np.unique(np.abs(table.displacement))
    both = np.stack([table.at(sizes), table.at(-sizes)])
    moved = np.abs(both - both[:, -1:]).max(axis=0) > _SETTLED * np.abs(both).max()
    last = int(np.flatnonzero(moved).max(initial=-1))
    return float(sizes[min(last + 3, len(sizes) - 1)])


def save_capacity(found: Capacity, folder: Path, case: str) -> Path:
    """Draw the axial capacity into `<case>_<foundation>_capacity[_n].png`."""
    stem = f"{case}_{found.pile.foundation.name}_capacity"
    return save_picture(lambda: draw_capacity(found, case), folder, stem)


def draw_capacity(found: Capacity, case: str) -> "Figure":
    """Unit friction, unit bearing and capacities against the depth of the tip."""
    figure = new_figure(11.0, 7.2)
    friction, bearing, capacity = figure.subplots(1, 3, sharey=True, width_ratios=(1, 1, 2.2))
    table = found.fine
    for axes, values, label in (
        (friction, table.unit_friction, "Unit friction (kPa)"),
        (bearing, table.unit_bearing, "Unit end bearing (kPa)"),
    ):
        _frame(axes, found, label, 4)
        axes.plot(_KILO * values, table.depth, color=_UNIT, linewidth=1.5)
        axes.set_xmargin(0.08)
    _frame(capacity, found, "Axial capacity (kN)", 7)
    _capacities(capacity, found)
    friction.set_ylabel("Depth below the mudline (m)")
    title = f"{case}, {found.pile.foundation.name}: axial capacity with the tip at each depth"
    _title(figure, title)
    handles, labels = capacity.get_legend_handles_labels()
    last = len([line for line in labels if line.startswith(_GROUND)])  # drawn first, under all else
    order = [*range(last, len(labels)), *range(last)]
    figure.legend([handles[i] for i in order], [labels[i] for i in order], ncols=4, **_LEGEND)
    return figure


def _frame(axes: "Axes", found: Capacity, label: str, ticks: int) -> None:
    """Axes over depth with the ground, under what is drawn later."""
    plain_axes(axes, ticks)
    axes.axvline(0.0, color=ZERO, linewidth=0.8)
    boundaries = np.unique(found.pile.scene.ground.depths[1:])
    ground(axes, 0.0, float(found.fine.depth[-1]), boundaries)
    axes.axhline(found.pile.length, color=_TIP, lw=1.4, label=f"tip, {short(found.pile.length)} m")
    quantity_on_top(axes, label)


def _capacities(axes: "Axes", found: Capacity) -> None:
    """Plugged, unplugged and governing capacities, and what the loads need."""
    at = found.fine
    pressed = (at.compression, at.compression_plugged, at.compression_unplugged)
    pulled = (at.tension, at.tension_plugged, at.tension_unplugged)
    for name, colour, ways in (("compression", _PRESSED, pressed), ("tension", _PULLED, pulled)):
        for values, (style, width, word) in zip(ways, _WAYS, strict=True):
            label = f"{name}, {word}"
            axes.plot(_KILO * values, at.depth, color=colour, ls=style, lw=width, label=label)
    load, safety = found.demand, short(found.safety)
    if load.compression:
        # a gap where plugged and unplugged pile, of different weights, change places
        needed, plugged = found.needed_compression(at)
        turns = np.flatnonzero(np.diff(plugged)) + 1
        depth, needed = (np.insert(v, turns, np.nan) for v in (at.depth, needed))
        label = f"needed: {safety} x (compression + own weight)"
        axes.plot(_KILO * needed, depth, color=_PRESSED, ls="-.", lw=1.4, label=label)
    if load.tension:
        label = f"needed: {safety} x tension"
        axes.axvline(
            _KILO * found.safety * load.tension, color=_PULLED, ls="-.", lw=1.4, label=label
        )
    required = found.axial.required if found.axial else None
    if required is not None and required.length is not None:
        label = f"required length, {short(round(required.length, 2))} m"
        axes.axhline(required.length, color=PALETTE[6], lw=1.8, ls=(0, (2, 1)), label=label)
