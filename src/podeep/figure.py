"""Results as pictures: PNG files, the same bytes for the same input, none overwritten.

Made without pyplot and without the user's own matplotlib settings. matplotlib takes most of a
second to import, so it is imported when the first picture is drawn.
"""

from io import BytesIO
from itertools import count
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Fault, UserError
from .query import Curves, Origin
from .table import ANALYSES, axis_label
from .units import QUANTITIES, coordinates, with_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PALETTE = (  # from shallow to deep or early to late: dark blue over green to red
    "#30123b", "#3f5fd0", "#2f9df5", "#1bd0b0", "#5fc93a",
    "#b0b800", "#e8a20c", "#f56c16", "#d0330a", "#7a0403",
)  # fmt: skip
_STYLES = ("-", "--", "-.", ":")
_MARKED = 40  # calculation points are marked up to so many, they are a line above
_MUDLINE, _LAYER, _ZERO = "#8a5a2b", "#b59b7c", "#444444"


def save(curves: Curves, origin: Origin, folder: Path, case: str) -> Path:
    """Draw the result into a new file of the folder and return its path.

    The name is `<case>_<static|dynamic>_<analysis>_<result>[_n].png` with the first n that is
    free. Raises `UserError` where the folder cannot be written to.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.style import context

    with context("default", after_reset=True):
        figure = draw(curves, origin)
        FigureCanvasAgg(figure)
        picture = BytesIO()
        figure.savefig(picture, format="png", metadata={"Software": None})
    stem = f"{case}_{origin.database_kind}_{curves.kind}_{curves.quantity}"
    return _write_new(folder, stem, picture.getvalue())


def draw(curves: Curves, origin: Origin) -> "Figure":
    """The result as a matplotlib figure."""
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    layout = ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.1)
    figure = Figure(figsize=(7.0, 7.0), dpi=120, layout=layout)
    axes = figure.add_subplot()
    numbers = FuncFormatter(lambda value, _: f"{value:.6g}")
    axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 2.5, 5, 10]))
    axes.xaxis.set_major_formatter(numbers)
    axes.yaxis.set_major_formatter(numbers)
    axes.grid(color="#e4e4e4", linewidth=0.7)
    axes.set_axisbelow(True)
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
        axes.plot(curves.rows, values, label=label, **_pen(number, len(labels), len(values)))
    axes.axhline(0.0, color=_ZERO, linewidth=0.8)
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
        axes.fill_betweenx(depths, values[0], values[1], color=_PALETTE[2], alpha=0.25, lw=0.0)
        for row, label, number in zip(values, ("minimum", "maximum"), (0, 9), strict=True):
            axes.plot(row, depths, label=label, **_pen(number, 10, len(depths)))
    else:
        names = [with_unit(row, origin.axis) for row in curves.rows]
        for number, (row, name) in enumerate(zip(values, names, strict=True)):
            label = f"{origin.axis} {name}"
            axes.plot(row, depths, label=label, **_pen(number, len(names), len(depths)))
    axes.axvline(0.0, color=_ZERO, linewidth=0.8)
    _ground(axes, curves)
    axes.xaxis.set_ticks_position("top")
    axes.xaxis.set_label_position("top")
    axes.set_xlabel(quantity.label, labelpad=8.0)
    axes.set_ylabel("Depth below the mudline (m)")


def _ground(axes: "Axes", curves: Curves) -> None:
    """Depth axis downward, with the mudline and the layer boundaries that lie in its range."""
    top, bottom = float(curves.depths[0]), float(curves.depths[-1])
    margin = 0.03 * (bottom - top) or 1.0
    axes.set_ylim(bottom + margin, top - margin)
    if top - margin <= 0.0:
        axes.axhline(0.0, color=_MUDLINE, linewidth=2.0, label="mudline")
    boundaries = np.unique(np.round(curves.layer_boundaries, 5))  # a jump's two depths are one
    inside = boundaries[(boundaries > max(top - margin, 0.0)) & (boundaries < bottom + margin)]
    for number, depth in enumerate(inside):
        label = "layer boundary" if number == 0 else None
        axes.axhline(depth, color=_LAYER, linewidth=1.0, linestyle=(0, (6, 3)), label=label)


def _pen(number: int, of: int, points: int) -> dict[str, Any]:
    """Colour, line style and marker of one of so many curves: their order is the palette's."""
    place = 0 if of == 1 else round(number * (len(_PALETTE) - 1) / (of - 1))
    return {
        "color": _PALETTE[place],
        "linestyle": _STYLES[number % len(_STYLES)],
        "linewidth": 1.5,
        "marker": "o" if points <= _MARKED else None,
        "markersize": 3.0,
    }


def _write_new(folder: Path, stem: str, picture: bytes) -> Path:
    """Write under the first name that is free, which no other program can take meanwhile."""
    path = folder / f"{stem}.png"
    numbers = count(2)
    while True:
        try:
            with path.open("xb") as out:
                out.write(picture)
            return path
        except FileExistsError:
            path = folder / f"{stem}_{next(numbers)}.png"
        except OSError as error:
            raise UserError(
                Fault(f"{path} cannot be written: {error.strerror}", "choose a folder with -o")
            ) from error
