"""What the figures share: panels, labels, legends, inks, and curves of a law.

No pyplot and no settings of the user, so that the same code gives the same bytes.
"""

from collections.abc import Callable, Iterable
from io import BytesIO
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.style import context

from podeep.arrays import Array
from podeep.picture import PALETTE, ZERO, new_figure, plain_axes, quantity_on_top
from podeep.soil.law import Law

INKS = (PALETTE[0], PALETTE[2], PALETTE[4], PALETTE[6], PALETTE[8])
SOLID, DASHED, DOTTED = "-", (0, (5, 2)), (0, (1, 1.5))
KILO, MEGA = 1e-3, 1e-6
MOVED, REACTION = "Lateral displacement $y$ (mm)", "$p$ (kN/m)"


def png_of(draw: Callable[[], Figure]) -> bytes:
    """A figure as the bytes of a PNG file."""
    with context("default", after_reset=True):
        figure = draw()
        FigureCanvasAgg(figure)
        picture = BytesIO()
        figure.savefig(picture, format="png", metadata={"Software": None})
    return picture.getvalue()


def new_panels(
    count: int, height: float = 3.7, rows: int = 1, **options: Any
) -> tuple[Figure, Any]:
    figure = new_figure(8.8, height)
    panels = figure.subplots(rows, count, squeeze=False, **options).ravel()
    for axes in panels:
        plain_axes(axes, 5)
    return figure, panels


def frame(
    axes: Axes,
    x: str,
    y: str,
    right: float | None = None,
    top: float | None = None,
    title: str = "",
) -> None:
    """Labels, and ranges from 0 to `right` and `top` where these are given."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title, loc="left", fontsize=10)
    if right is not None:
        axes.set_xlim(0.0, right)
    if top is not None:
        axes.set_ylim(0.0, top)


def legend(axes: Axes, where: str, **options: Any) -> None:
    axes.legend(loc=where, **{"fontsize": 9, "framealpha": 0.9, "edgecolor": "#dddddd", **options})


def family(
    axes: Axes,
    x: Array,
    curves: Iterable[tuple[str, Array]],
    style: Any = SOLID,
    named: bool = True,
) -> None:
    """Curves in the colours of a family, each with its name in the legend."""
    for ink, (name, values) in zip(INKS, curves, strict=False):
        label = name if named else None
        axes.plot(x, values, color=ink, linestyle=style, linewidth=1.6, label=label)


def legend_and_styles(axes: Axes, where: str, *names: str, **options: Any) -> None:
    """A legend of the curves' names, and of what solid, dashed and dotted lines are."""
    handles, labels = axes.get_legend_handles_labels()
    for name, style in zip(names, (SOLID, DASHED, DOTTED), strict=False):
        handles.append(Line2D([], [], color=ZERO, linestyle=style, linewidth=1.6))
        labels.append(name)
    legend(axes, where, handles=handles, labels=labels, handlelength=2.6, **options)


def depth_down(
    axes: Axes, label: str, bottom: float, depth: str = "Depth below the mudline (m)"
) -> None:
    """Depth runs down, the quantity stands on top."""
    axes.set_ylim(bottom, 0.0)
    quantity_on_top(axes, label)
    axes.set_ylabel(depth)


def reactions(law: Law, u: Array) -> Array:
    """Reactions at displacements (m,), a column for each point of the law: shape (m, n)."""
    return law.force(np.broadcast_to(u[:, None], (len(u), len(law.capacity))))


def metres(depths: Array) -> list[str]:
    return [f"{z:g} m" for z in depths]


def static_and_cyclic(
    axes: Axes,
    law: Callable[..., Law],
    z: Array,
    y: Array,
    where: str = "upper left",
    cyclic: str = "cyclic",
) -> None:
    """Curves p(y) of a law at depths, solid static and dashed cyclic."""
    for moving, style in ((False, SOLID), (True, DASHED)):
        p = KILO * reactions(law(z, cyclic=moving), y).T
        family(axes, 1e3 * y, zip(metres(z), p, strict=True), style, not moving)
    legend_and_styles(axes, where, "static", cyclic, ncols=3)
