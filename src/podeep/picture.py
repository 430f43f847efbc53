"""What all pictures share: their look, the ground in them, and PNG files of the same bytes.

Made without pyplot and without the user's own matplotlib settings. matplotlib takes most of a
second to import, so it is imported when the first picture is drawn.
"""

from collections.abc import Callable
from io import BytesIO
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import Array
from .errors import Fault, UserError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PALETTE = (  # from shallow to deep or early to late: dark blue over green to red
    "#30123b", "#3f5fd0", "#2f9df5", "#1bd0b0", "#5fc93a",
    "#b0b800", "#e8a20c", "#f56c16", "#d0330a", "#7a0403",
)  # fmt: skip
STYLES = ("-", "--", "-.", ":")
MUDLINE, LAYER, ZERO = "#8a5a2b", "#b59b7c", "#444444"
_MARKED = 40  # points are marked up to so many, they are a line above


def save_picture(draw: Callable[[], "Figure"], folder: Path, stem: str) -> Path:
    """Write what is drawn into a new file of the folder and return its path.

    The name is `<stem>[_n].png` with the first n that is free. The same drawing gives the same
    bytes. Raises `UserError` where the folder cannot be written to.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.style import context

    with context("default", after_reset=True):
        figure = draw()
        FigureCanvasAgg(figure)
        picture = BytesIO()
        figure.savefig(picture, format="png", metadata={"Software": None})
    return _write_new(folder, stem, picture.getvalue())


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure, inches, whose parts find their own places."""
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    layout = ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.1)
    return Figure(figsize=(width, height), dpi=120, layout=layout)


def plain_axes(axes: "Axes", ticks: int = 7) -> None:
    """A light grid behind the curves, and about so many round numbers along x."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    numbers = FuncFormatter(lambda value, _: f"{value:.6g}")
    axes.xaxis.set_major_locator(MaxNLocator(ticks, steps=[1, 2, 2.5, 5, 10]))
    axes.xaxis.set_major_formatter(numbers)
    axes.yaxis.set_major_formatter(numbers)
    axes.grid(color="#e4e4e4", linewidth=0.7)
    axes.set_axisbelow(True)


def quantity_on_top(axes: "Axes", label: str) -> None:
    """The quantity's axis above the picture, as profiles over depth have it."""
    axes.xaxis.set_ticks_position("top")
    axes.xaxis.set_label_position("top")
    axes.set_xlabel(label, labelpad=8.0)


def ground(axes: "Axes", top: float, bottom: float, layer_boundaries: Array) -> None:
    """Depth axis downward, with the mudline and the layer boundaries that lie in its range."""
    margin = 0.03 * (bottom - top) or 1.0
    axes.set_ylim(bottom + margin, top - margin)
    if top - margin <= 0.0:
        axes.axhline(0.0, color=MUDLINE, linewidth=2.0, label="mudline")
    boundaries = np.unique(np.round(layer_boundaries, 5))  # a jump's two depths are one
    inside = boundaries[(boundaries > max(top - margin, 0.0)) & (boundaries < bottom + margin)]
    for number, depth in enumerate(inside):
        label = "layer boundary" if number == 0 else None
        axes.axhline(depth, color=LAYER, linewidth=1.0, linestyle=(0, (6, 3)), label=label)


def pen(number: int, of: int, points: int) -> dict[str, Any]:
    """Colour, line style and marker of one of so many curves: their order is the palette's."""
    place = 0 if of == 1 else round(number * (len(PALETTE) - 1) / (of - 1))
    return {
        "color": PALETTE[place],
        "linestyle": STYLES[number % len(STYLES)],
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
