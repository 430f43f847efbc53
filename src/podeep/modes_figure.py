"""The picture of mode shapes over depth."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .picture import (
    STYLES,
    ZERO,
    ground,
    new_figure,
    pen,
    plain_axes,
    quantity_on_top,
    save_picture,
)
from .solve.modes import Modes

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def save_modes(found: Modes, title: str, folder: Path, stem: str) -> Path:
    """Draw mode shapes into `<stem>[_n].png`."""
    return save_picture(lambda: draw_modes(found, title), folder, stem)


def draw_modes(found: Modes, title: str) -> "Figure":
    """A panel of lateral shapes and one of axial ones, where there are any; a style each tube."""
    kinds = [
        (name, numbers)
        for name, axial in (("Lateral", False), ("Axial", True))
        if (numbers := [i for i, m in enumerate(found.modes) if (m.kind == "axial") is axial])
    ]
    figure = new_figure(4.0 * len(kinds) + 1.0, 6.0)
    top = min(float(x[0]) for x in found.depths)
    bottom = max(float(x[-1]) for x in found.depths)
    panels = figure.subplots(1, len(kinds), squeeze=False, sharey=True)[0]
    for axes, (name, numbers) in zip(panels, kinds, strict=True):
        plain_axes(axes, 5)
        quantity_on_top(axes, f"{name} displacement over the largest")
        axes.axvline(0.0, color=ZERO, linewidth=0.8)
        for i in numbers:
            mode = found.modes[i]
            line = pen(i, len(found.modes), 2 * len(found.depths[0]))
            for tube, (x, shape) in enumerate(zip(found.depths, mode.shape, strict=True)):
                label = f"{i + 1}: {mode.kind}, {mode.frequency:.4g} Hz" if tube == 0 else None
                style = {**line, "marker": None, "linestyle": STYLES[tube % len(STYLES)]}
                axes.plot(shape, x, label=label, **style)
        axes.legend(loc="best", fontsize=8, frameon=False)
        axes.set_xlim(-1.1, 1.1)
        ground(axes, top, bottom, np.zeros(0))
    panels[0].set_ylabel("Depth below the mudline (m)")
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, parse_math=False)
    return figure
