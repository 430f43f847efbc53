"""Results as pictures: PNG files, the same bytes for the same input, none overwritten."""

from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING

from .picture import (
    PALETTE,
    ZERO,
    ground,
    new_figure,
    pen,
    plain_axes,
    quantity_on_top,
    save_picture,
)
from .query import Curves, Origin
from .table import ANALYSES, axis_label
from .units import QUANTITIES, coordinates, with_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def save(curves: Curves, origin: Origin, folder: Path, case: str) -> Path:
    """Draw the result into a new file of the folder and return its path.

    The name is `<case>_<static|dynamic>_<analysis>_<result>[_n].png` with the first n that is
    free. Raises `UserError` where the folder cannot be written to.
    """
    stem = f"{case}_{origin.database_kind}_{curves.kind}_{curves.quantity}"
    return save_picture(lambda: draw(curves, origin), folder, stem)


def draw(curves: Curves, origin: Origin) -> "Figure":
    """The result as a matplotlib figure."""
    over_time = curves.kind == "step_evolution" and origin.axis == "time"
    figure = new_figure(9.0, 5.5) if over_time else new_figure(7.0, 7.0)
    axes = figure.add_subplot()
    plain_axes(axes)
    if curves.kind == "step_evolution":
        _evolution(axes, curves, origin)
    else:
        _profile(axes, curves, origin)
    title = fill(_title(curves, origin), 52)
    axes.set_title(title, loc="left", fontsize=11, pad=12.0, parse_math=False)
    figure.legend(
        loc="outside right upper",
        title="Depth" if curves.kind == "step_evolution" else None,
        frameon=False,
        fontsize=9,
        handlelength=3.2,
        alignment="left",
    )
    return figure


def _title(curves: Curves, origin: Origin) -> str:
    at = ""
    if curves.kind == "snapshot" and len(curves.rows) == 1:
        at = f" at {origin.axis} {with_unit(curves.rows[0], origin.axis)}"
    return f"{origin.database}, {origin.foundation}: {ANALYSES[curves.kind].lower()}{at}"


def _evolution(axes: "Axes", curves: Curves, origin: Origin) -> None:
    """A curve for each depth against step or time."""
    from matplotlib.ticker import MaxNLocator

    quantity = QUANTITIES[curves.quantity]
    labels = [f"{depth} m" for depth in coordinates(curves.depths)]
    for number, label in enumerate(labels):
        values = curves.values[:, number] * quantity.scale
        axes.plot(curves.rows, values, label=label, **pen(number, len(labels), len(values)))
    axes.axhline(0.0, color=ZERO, linewidth=0.8)
    if origin.axis == "step":
        axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.margins(x=0.02)
    axes.set_xlabel(axis_label(origin.axis).capitalize())
    axes.set_ylabel(quantity.label)


def _profile(axes: "Axes", curves: Curves, origin: Origin) -> None:
    """Curves, or the band of an envelope, over depth, which runs downward."""
    quantity = QUANTITIES[curves.quantity]
    depths, values = curves.depths, curves.values * quantity.scale
    if curves.kind == "envelope":
        axes.fill_betweenx(depths, values[0], values[1], color=PALETTE[2], alpha=0.25, lw=0.0)
        for row, label, number in zip(values, ("minimum", "maximum"), (0, 9), strict=True):
            axes.plot(row, depths, label=label, **pen(number, 10, len(depths)))
    else:
        names = [with_unit(row, origin.axis) for row in curves.rows]
        for number, (row, name) in enumerate(zip(values, names, strict=True)):
            label = f"{origin.axis} {name}"
            axes.plot(row, depths, label=label, **pen(number, len(names), len(depths)))
    axes.axvline(0.0, color=ZERO, linewidth=0.8)
    ground(axes, float(depths[0]), float(depths[-1]), curves.layer_boundaries)
    quantity_on_top(axes, quantity.label)
    axes.set_ylabel("Depth below the mudline (m)")
