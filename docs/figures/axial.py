"""Figures of the shaft and the tip: t-z and q-z, unit values, capacity by depth."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from podeep.deck.read import read_deck
from podeep.picture import ZERO
from podeep.soil import axial
from podeep.soil.axial_capacity import axial_capacity
from podeep.soil.profile import profile_of

from .canvas import (
    DASHED,
    DOTTED,
    INKS,
    KILO,
    MEGA,
    SOLID,
    depth_down,
    frame,
    legend,
    new_panels,
    reactions,
)

SAMPLE = Path(__file__).parents[2] / "sample_dbs" / "jacket_pile.deck"


def tz_qz() -> Figure:
    figure, (shaft, tip) = new_panels(2, 4.0)
    given: dict[str, Any] = {"diameter": 1.0, "initial_stiffness": 1e8}
    clay = {**given, "unit_friction": np.array([60e3])}
    w = np.linspace(0.0, 0.03, 3001)
    sand: dict[str, Any] = {
        **given,
        "effective_overburden": np.array([100e3]),
        "earth_pressure_coefficient": 0.8,
        "interface_friction_angle": np.radians(30.0),
    }
    for ink, style, law, name in (
        (INKS[0], SOLID, axial.DirectShaft(**clay, shape="2GEO"), "2GEO, residual 1 (sand)"),
        (INKS[1], SOLID, axial.DirectShaft(**clay, shape="2GEO", residual=0.9), "2GEO, 0.9"),
        (INKS[2], SOLID, axial.DirectShaft(**clay, shape="2GEO", residual=0.7), "2GEO, 0.7"),
        (INKS[3], DASHED, axial.CohesionlessShaft(**sand, shape="API"), "API in sand"),
        (INKS[4], DOTTED, axial.DirectShaft(**clay, shape="EP"), "EP"),
    ):
        share = reactions(law, w)[:, 0] / law.capacity
        shaft.plot(w, share, color=ink, ls=style, lw=1.6, label=name)
    frame(shaft, "$w/D$, of a shaft of 1 m (-)", "$t/t_{max}$ (-)", 0.03, 1.1, "Shaft")
    legend(shaft, "lower right")
    w = np.linspace(-0.04, 0.14, 3001)
    for ink, style, shape in ((INKS[1], SOLID, "2GEO"), (INKS[4], DOTTED, "EP")):
        end = axial.DirectTip(**given, tip_pressure=np.array([500e3]), shape=shape)
        name = "API and 2GEO" if shape == "2GEO" else "EP"
        share = reactions(end, w)[:, 0] / end.capacity
        tip.plot(w, share, color=ink, ls=style, lw=1.6, label=name)
    for axis in (tip.axhline, tip.axvline):
        axis(0.0, color=ZERO, linewidth=0.8)
    frame(tip, "$w/D$, of a tip of 1 m (-)", "$q/q_{max}$ (-)", title="Tip")
    tip.set_xlim(-0.04, 0.14)
    tip.set_ylim(-0.06, 1.1)
    legend(tip, "lower right")
    return figure


def unit_friction_bearing() -> Figure:
    figure, (clay, friction, bearing) = new_panels(3, 4.2)
    psi = np.geomspace(0.05, 10.0, 400)
    clay.plot(psi, axial.alpha_friction(psi, 1.0) / psi, color=INKS[1], linewidth=1.8)
    clay.set_xscale("log")
    clay.set_xticks([0.1, 0.25, 1, 3, 10], ["0.1", "0.25", "1", "3", "10"])
    clay.minorticks_off()
    frame(clay, r"$\psi = s_u/\sigma'_v$ (-)", r"$\alpha$ (-)", top=1.1)
    z = np.linspace(0.0, 60.0, 601)
    for ink, beta, limit, Nq, most in (
        (INKS[0], 0.29, 67e3, 12.0, 3e6),
        (INKS[1], 0.37, 81e3, 20.0, 5e6),
        (INKS[3], 0.46, 96e3, 40.0, 10e6),
        (INKS[4], 0.56, 115e3, 50.0, 12e6),
    ):
        f = axial.overburden_friction(10e3 * z, beta, np.radians(45.0), limit)
        q = axial.overburden_bearing(10e3 * z, Nq, most)
        friction.plot(KILO * f, z, color=ink, linewidth=1.8, label=rf"$\beta$ {beta:g}")
        bearing.plot(MEGA * q, z, color=ink, linewidth=1.8, label=f"$N_q$ {Nq:g}")
    depth_down(friction, "$f$ in sand (kPa)", 60.0)
    depth_down(bearing, "$q$ in sand (MPa)", 60.0)
    friction.set_xlim(0.0)
    bearing.set_xlim(0.0, 19.0)
    bearing.set_ylabel("")
    legend(friction, "lower left")
    legend(bearing, "upper right")
    return figure


def axial_capacity_depths() -> Figure:
    scene = read_deck(SAMPLE).scene
    foundation = scene.foundations[0]
    profile, depth = profile_of(scene, foundation), np.linspace(0.0, 70.0, 701)
    edges = np.array(profile.boundaries)
    depth = np.union1d(depth, [*edges, *np.nextafter(edges, np.inf)])
    sections = scene.tubes[foundation.tubes[0]].sections
    found = axial_capacity(profile, sections, depth, mudline=foundation.mudline)
    figure, (pressed, pulled) = new_panels(2, 4.6, sharey=True)
    for axes, title, lesser, ways in (
        (
            pressed,
            "Compression",
            found.compression,
            ("compression_plugged", "compression_unplugged"),
        ),
        (pulled, "Tension", found.tension, ("tension_plugged", "tension_unplugged")),
    ):
        plugged, unplugged = (getattr(found, way) for way in ways)
        axes.plot(MEGA * lesser, depth, color="#cccccc", lw=5.0, label="governs")
        axes.plot(MEGA * plugged, depth, color=INKS[1], ls=SOLID, lw=1.4, label="plugged")
        axes.plot(MEGA * unplugged, depth, color=INKS[4], ls=DASHED, lw=1.4, label="unplugged")
        depth_down(axes, f"{title} (MN)", 70.0, "Depth of the tip (m)")
        axes.set_xlim(0.0, 72.0)
        legend(axes, "upper right")
    pulled.set_ylabel("")
    return figure
