"""Figures of the spudcan: its yield surface and its bearing capacity."""

import numpy as np
from matplotlib.figure import Figure

from podeep.soil import spudcan_bearing
from podeep.soil.spudcan_yield import YieldSurface, moment_limit

from .canvas import DASHED, DOTTED, INKS, KILO, SOLID, depth_down, frame, legend, new_panels


def spudcan_yield() -> Figure:
    figure, (section, stiffness) = new_panels(2, 4.0)
    v = np.linspace(0.0, 1.0, 1001)
    for ink, a in zip(INKS[:3], (0.0, 0.5, 1.0), strict=True):
        surface = YieldSurface(1.0, 1.0, 1.0, a)
        limit = [moment_limit(surface, float(share), 0.0) for share in v]
        section.plot(v, limit, color=ink, linewidth=1.8, label=f"$a$ = {a:g}")
    taken = r"$\sqrt{(H/Q_H)^2 + (M/Q_M)^2}$ (-)"
    frame(section, "$V/Q_V$ (-)", taken, 1.0, 1.2, "Yield surface")
    legend(section, "upper right")
    rf = np.linspace(0.0, 1.0, 2001)
    fr = YieldSurface.reduction(rf)
    stiffness.plot(rf, fr, color=INKS[4], linewidth=1.8)
    stiffness.plot([1.0, 1.0, 1.2], [fr[-1], 0.0, 0.0], color=INKS[4], linewidth=1.8)
    frame(stiffness, "$r_f$ (-)", "$f_r$ (-)", 1.2, title="Rotational stiffness that is left")
    stiffness.set_ylim(-0.03, 1.05)
    return figure


def spudcan_capacity() -> Figure:
    figure, (clay, sand, layers) = new_panels(3, 4.0)
    ratio = np.linspace(0.0, 3.0, 301)
    found = spudcan_bearing.clay_bearing_capacity(40e3, 1.0, ratio, 0.0)
    clay.plot(found.factors["NcScDc"], ratio, color=INKS[1], linewidth=1.8)
    depth_down(clay, "$N_c s_c d_c$ in clay (-)", 3.0, "$D_p/B$ (-)")
    clay.set_xlim(5.5, 9.5)
    phi = np.linspace(20.0, 40.0, 201)
    factors = spudcan_bearing.sand_bearing_capacity(np.radians(phi), 1.0, 0.0, 10e3, 0.0).factors
    for ink, name in ((INKS[1], "Nq"), (INKS[4], "Ng")):
        label = "$N_q$" if name == "Nq" else r"$N_\gamma$"
        sand.plot(phi, factors[name], color=ink, linewidth=1.8, label=label)
    sand.set_yscale("log")
    sand.set_yticks([5, 10, 20, 50, 100], ["5", "10", "20", "50", "100"])
    sand.minorticks_off()
    frame(sand, r"$\varphi'$ (deg)", "Factor in sand (-)")
    legend(sand, "upper left")
    B, H = 14.0, np.linspace(0.02, 1.5, 600)
    soft = spudcan_bearing.squeezing_bearing_capacity(30e3, B, 0.0, 0.0, B * H, 1.2e6).unit_capacity
    punch = spudcan_bearing.two_clays_bearing_capacity(80e3, 30e3, B, 0.0, 0.0, B * H).unit_capacity
    over = spudcan_bearing.sand_over_clay_bearing_capacity(
        np.radians(32.0), 30e3, B, 0.0, 10e3, 0.0, B * H
    ).unit_capacity
    for ink, style, values, name in (
        (INKS[0], SOLID, soft, "soft clay on hard"),
        (INKS[1], DASHED, punch, "firm clay on soft"),
        (INKS[4], DOTTED, over, "sand on clay"),
    ):
        layers.plot(H, KILO * values, color=ink, ls=style, lw=1.8, label=name)
    frame(layers, "$T/B$ or $H/B$ (-)", "$q$ (kPa)", 1.5, 950.0)
    legend(layers, "upper right")
    return figure
