"""Figures of the four reactions of PISA."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from podeep.picture import PALETTE
from podeep.soil import pisa

from .canvas import (
    DASHED,
    MEGA,
    MOVED,
    SOLID,
    family,
    frame,
    legend,
    legend_and_styles,
    metres,
    new_panels,
    reactions,
)


def pisa_lateral() -> Figure:
    figure, (clay, sand) = new_panels(2, 4.0)
    D, s, G0 = 1.0, 1.0, 1.0  # all scales 1: the curves are those of the fits
    X, ratios = np.linspace(0.0, 260.0, 2001), np.array([0.5, 2.0, 4.0])
    names = [f"$z/D$ {ratio:g}" for ratio in ratios]
    for site, style in (("COWDEN", SOLID), ("BOTHKENNAR", DASHED)):
        law = pisa.PisaClay(
            diameter=D,
            embedded_length=5.0,
            initial_shear_modulus=G0,
            depth=ratios,
            undrained_shear_strength=s,
            site=site,
        )
        family(clay, X, zip(names, reactions(law, X).T, strict=True), style, site == "COWDEN")
    frame(clay, "$X = y\\,G_0/(s_u D)$ (-)", "$Y = p/(s_u D)$ (-)", 260.0, 12.5, "Clay")
    legend_and_styles(clay, "upper left", "COWDEN", "BOTHKENNAR", ncols=2)
    X, densities = np.linspace(0.0, 130.0, 2001), np.array([0.45, 0.75, 0.9])
    names = [f"{100 * R:g} %" for R in densities]
    for z, style in ((1.0, SOLID), (4.0, DASHED)):
        dense = pisa.PisaSand(
            diameter=D,
            embedded_length=5.0,
            initial_shear_modulus=G0,
            depth=np.full(3, z),
            effective_overburden=s,
            relative_density=densities,
        )
        family(sand, X, zip(names, reactions(dense, X).T, strict=True), style, z == 1.0)
    stress = r"(\sigma'_v D)"
    frame(sand, f"$X = y\\,G_0/{stress}$ (-)", f"$Y = p/{stress}$ (-)", 130.0, 30.0, "Sand")
    legend_and_styles(sand, "upper left", "$z/L$ 0.2", "$z/L$ 0.8", ncols=2)
    return figure


def pisa_reactions() -> Figure:
    figure, (p, m, base_shear, base_moment) = new_panels(2, 6.4, rows=2)
    z = np.array([2.0, 10.0, 20.0])
    given: dict[str, Any] = {
        "diameter": 7.5,
        "embedded_length": 30.0,
        "initial_shear_modulus": np.full(3, 60e6),
        "undrained_shear_strength": 100e3,
    }
    tip = {**given, "initial_shear_modulus": np.array([60e6])}
    y, turn = np.linspace(0.0, 0.4, 1001), np.linspace(0.0, 0.02, 1001)
    names, rotation = metres(z), "Rotation (mrad)"
    lateral, along = pisa.PisaClay(depth=z, **given), pisa.PisaClayMoment(depth=z, **given)
    family(p, 1e3 * y, zip(names, MEGA * reactions(lateral, y).T, strict=True))
    family(m, 50.0 * turn, zip(names, MEGA * reactions(along, 0.05 * turn).T, strict=True))
    ink: dict[str, Any] = {"color": PALETTE[1], "linewidth": 1.6}
    base_shear.plot(1e3 * y, MEGA * reactions(pisa.PisaClayBaseShear(**tip), y), **ink)
    base_moment.plot(1e3 * turn, MEGA * reactions(pisa.PisaClayBaseMoment(**tip), turn), **ink)
    frame(p, MOVED, "$p$ (MN/m)", 400.0, 6.5, "Along the shaft: $p$")
    frame(m, rotation, "$m$ (MN m/m)", 1.0, 1.7, "Along the shaft: $m$")
    frame(base_shear, MOVED, "$H_B$ (MN)", 400.0, 3.5, "At the base: $H_B$")
    frame(base_moment, rotation, "$M_B$ (MN m)", 20.0, 17.0, "At the base: $M_B$")
    legend(p, "upper left", ncols=3)
    legend(m, "lower right")
    return figure
