"""Results as pictures: PNG files, the same bytes for the same input, none overwritten."""

from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

from .picture import (
    MUDLINE,
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
from .subject import LINE
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
    evolution, of_line = curves.kind == "step_evolution", origin.subject is LINE
    wide = origin.axis == "time" if evolution else of_line
    figure = new_figure(9.0, 5.5) if wide else new_figure(7.0, 7.0)
    axes = figure.add_subplot()
    plain_axes(axes)
    if evolution:
        _evolution(axes, curves, origin)
    elif of_line:
        _along(axes, curves, origin)
    else:
        _profile(axes, curves, origin)
    title = fill(_title(curves, origin), 52)
    axes.set_title(title, loc="left", fontsize=11, pad=12.0, parse_math=False)
    figure.legend(
        loc="outside right upper",
        title=origin.subject.coordinate.capitalize() if evolution else None,
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
    return f"{origin.database}, {origin.name}: {ANALYSES[curves.kind].lower()}{at}"


def _evolution(axes: "Axes", curves: Curves, origin: Origin) -> None:
    """A curve for each point against step or time."""
    from matplotlib.ticker import MaxNLocator

    quantity = QUANTITIES[curves.quantity]
    labels = [f"{point} m" for point in coordinates(curves.points)]
    for number, label in enumerate(labels):
        values = curves.values[:, number] * quantity.scale
        axes.plot(curves.rows, values, label=label, **pen(number, len(labels), len(values)))
    _zero(axes, curves)
    if origin.axis == "step":
        axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.margins(x=0.02)
    axes.set_xlabel(axis_label(origin.axis).capitalize())
    axes.set_ylabel(quantity.label)


def _profile(axes: "Axes", curves: Curves, origin: Origin) -> None:
    """Curves, or the band of an envelope, over depth, which runs downward."""
    quantity = QUANTITIES[curves.quantity]
    depths, values = curves.points, curves.values * quantity.scale
    if curves.kind == "envelope":
        axes.fill_betweenx(depths, values[0], values[1], color=PALETTE[2], alpha=0.25, lw=0.0)
    for row, style in zip(values, _styles(curves, origin), strict=True):
        axes.plot(row, depths, **style)
    axes.axvline(0.0, color=ZERO, linewidth=0.8)
    ground(axes, float(depths[0]), float(depths[-1]), curves.layer_boundaries)
    quantity_on_top(axes, quantity.label)
    axes.set_ylabel("Depth below the mudline (m)")


def _along(axes: "Axes", curves: Curves, origin: Origin) -> None:
    """Curves, or the band of an envelope, along a line, which lies from left to right."""
    quantity = QUANTITIES[curves.quantity]
    points, values = curves.points, curves.values * quantity.scale
    if curves.kind == "envelope":
        axes.fill_between(points, values[0], values[1], color=PALETTE[2], alpha=0.25, lw=0.0)
    for row, style in zip(values, _styles(curves, origin), strict=True):
        axes.plot(points, row, **style)
    _zero(axes, curves)
    axes.margins(x=0.02)
    axes.set_xlabel(f"{origin.subject.where.capitalize()} (m)")
    axes.set_ylabel(quantity.label)


def _zero(axes: "Axes", curves: Curves) -> None:
    """The zero line; that of penetration, which runs downward, is the mudline."""
    if curves.quantity == "penetration":
        axes.axhline(0.0, color=MUDLINE, linewidth=2.0, label="mudline", zorder=1.0)
        axes.invert_yaxis()
    else:
        axes.axhline(0.0, color=ZERO, linewidth=0.8)


def _styles(curves: Curves, origin: Origin) -> list[dict[str, Any]]:
    """Label and pen of each curve over the points."""
    count = len(curves.points)
    if curves.kind == "envelope":
        return [
            {"label": label, **pen(number, 10, count)}
            for label, number in (("minimum", 0), ("maximum", 9))
        ]
    rows = curves.rows
    return [
        {"label": f"{origin.axis} {with_unit(row, origin.axis)}", **pen(number, len(rows), count)}
        for number, row in enumerate(rows)
    ]
