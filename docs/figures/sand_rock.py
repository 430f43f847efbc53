"""Figures of the p-y laws of sand and weak rock."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from podeep.arrays import Array
from podeep.picture import ZERO
from podeep.soil.reese_sand import ReeseSand
from podeep.soil.sand import Sand, sand_coefficients
from podeep.soil.weak_rock import WeakRock

from .canvas import (
    DASHED,
    INKS,
    KILO,
    MEGA,
    MOVED,
    REACTION,
    SOLID,
    depth_down,
    family,
    frame,
    legend,
    legend_and_styles,
    metres,
    new_panels,
    reactions,
    static_and_cyclic,
)


def sand_at(z: Array, law: type[Sand] | type[ReeseSand] = Sand, **options: Any) -> Sand | ReeseSand:
    """1 m wide, 33 degrees, 10 kN/m3."""
    given: dict[str, Any] = {
        "depth": z,
        "diameter": 1.0,
        "effective_overburden": 10e3 * z,
        "friction_angle": np.radians(33.0),
    }
    return law(**given, **options)


def sand_factors() -> Figure:
    figure, (small, large) = new_panels(2)
    phi = np.linspace(20.0, 42.0, 200)
    read = np.array([20.0, 25.0, 30.0, 35.0, 40.0])
    points = ((0.77, 1.22, 1.96, 3.0, 4.7), (1.58, 2.05, 2.72, 3.5, 4.35), (8, 15, 28.5, 54.5, 101))
    for i, (axes, ink) in enumerate(((small, INKS[1]), (small, INKS[3]), (large, INKS[4]))):
        values = sand_coefficients(np.radians(phi))[i]
        axes.plot(phi, values, color=ink, linewidth=1.8, label=f"$C_{i + 1}$")
        axes.plot(read, points[i], "o", color=ink, markersize=5, fillstyle="none")
    large.set_yscale("log")
    large.set_yticks([10, 20, 50, 100], ["10", "20", "50", "100"])
    large.minorticks_off()
    for axes in (small, large):
        frame(axes, r"Friction angle $\varphi'$ (deg)", "Coefficient (-)")
        axes.plot([], [], "o", color=ZERO, fillstyle="none", label="read off the figure")
        legend(axes, "upper left")
    return figure


def sand_depths() -> Figure:
    figure, (curves, share) = new_panels(2, 4.0, width_ratios=(1.5, 1))
    z, y = np.array([0.5, 1.0, 2.0, 3.0]), np.linspace(0.0, 0.025, 801)
    static_and_cyclic(curves, sand_at, z, y)
    frame(curves, MOVED, REACTION, 25.0, 350.0)
    z = np.linspace(0.01, 6.0, 300)
    for ink, style, cyclic, name in (
        (INKS[1], SOLID, False, "static"),
        (INKS[4], DASHED, True, "cyclic"),
    ):
        ratio = sand_at(z, cyclic=cyclic).capacity / 10e3 / z
        share.plot(ratio, z, color=ink, ls=style, label=name)
    depth_down(share, r"$A\,p_u/(\sigma'_v D)$ (-)", 6.0, "Depth in diameters $X/D$ (-)")
    share.set_xlim(0.0)
    legend(share, "lower left")
    return figure


def reese_sand() -> Figure:
    figure, (curves, beside) = new_panels(2, 4.0)
    z, y = np.array([0.5, 1.0, 2.0, 3.0]), np.linspace(0.0, 0.06, 2001)
    static_and_cyclic(curves, partial(sand_at, law=ReeseSand), z, y)
    frame(curves, MOVED, REACTION, 60.0, 430.0, "By depth")
    one = np.array([2.0])
    for kind, ink, name in ((ReeseSand, INKS[4], "ITYP 9"), (Sand, INKS[1], "ITYP 2 (API)")):
        for cyclic, style in ((False, SOLID), (True, DASHED)):
            p = KILO * reactions(sand_at(one, kind, cyclic=cyclic), y)[:, 0]
            label = None if cyclic else name
            beside.plot(1e3 * y, p, color=ink, ls=style, lw=1.6, label=label)
    frame(beside, MOVED, REACTION, 60.0, 260.0, "At 2 m, beside API's sand")
    legend_and_styles(beside, "lower right", "static", "cyclic")
    return figure


def reese_sand_charts() -> Figure:
    figure, panels = new_panels(2, 3.5, sharey=True)
    ratio = np.linspace(0.01, 6.0, 600)
    for axes, name in zip(panels, "AB", strict=True):
        for cyclic, style, ink in ((False, SOLID, INKS[1]), (True, DASHED, INKS[4])):
            chart = sand_at(ratio, ReeseSand, cyclic=cyclic).derived[name]
            axes.plot(ratio, chart, color=ink, ls=style, label="cyclic" if cyclic else "static")
        frame(axes, "$X/D$ (-)", "", 6.0, 3.0, f"Factor ${name}$ (-)")
        legend(axes, "upper right")
    return figure


def weak_rock() -> Figure:
    figure, (depths, rocks) = new_panels(2, 3.9)
    kind = WeakRock(
        depth_in_rock=np.array([0.0, 1.5, 3.0]),
        diameter=1.0,
        compressive_strength=2e6,
        rock_mass_modulus=200e6,
        rock_quality_designation=0.5,
        strain_rm=2e-4,
    )
    y = np.linspace(0.0, 4e-3, 2001)
    names = metres(np.asarray(kind.depth_in_rock))
    family(depths, 1e3 * y, zip(names, MEGA * reactions(kind, y).T, strict=True))
    one = replace(kind, depth_in_rock=np.array([1.0]))
    for ink, style, changed, name in (
        (INKS[0], SOLID, {"rock_quality_designation": 0.0}, "RQD 0 %"),
        (INKS[1], SOLID, {}, "RQD 50 %"),
        (INKS[2], SOLID, {"rock_quality_designation": 1.0}, "RQD 100 %"),
        (INKS[4], DASHED, {"rock_mass_modulus": 20e6}, "RQD 50 %, $E_{ir}$ 20 MPa"),
    ):
        p = MEGA * reactions(replace(one, **changed), y)[:, 0]
        rocks.plot(1e3 * y, p, color=ink, ls=style, lw=1.6, label=name)
    frame(depths, MOVED, "$p$ (MN/m)", 4.0, 9.0, "By depth below the rock's surface")
    frame(rocks, MOVED, "$p$ (MN/m)", 4.0, 6.5, "At 1 m, by rock")
    legend(depths, "upper left", ncols=3)
    legend(rocks, "upper left", ncols=2)
    return figure
