"""Figures of the ground beside a pile: user curves, layers, groups, lateral capacity."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from podeep.arrays import Array
from podeep.picture import ZERO
from podeep.scene import Curve, Ground
from podeep.soil.group import group_multiplier, mean_multiplier
from podeep.soil.lateral_capacity import rigid_mechanism
from podeep.soil.profile import Profile

from .canvas import (
    DASHED,
    DOTTED,
    INKS,
    KILO,
    MEGA,
    SOLID,
    depth_down,
    family,
    frame,
    legend,
    legend_and_styles,
    metres,
    new_panels,
)

FIRM = {"effective_unit_weight": 8e3, "j": 0.5, "strain_50": 0.01}


def user_curve(id_: int, *rows: tuple[float, ...]) -> Curve:
    return Curve(id_, "user", {}, {}, rows)


def layer(id_: int, law: str, **parameters: float) -> Curve:
    return Curve(id_, law, parameters)


def user_curves() -> Figure:
    figure, (signs, between) = new_panels(2)
    one = np.ones(1)
    y = np.linspace(-0.07, 0.07, 1401)
    odd = user_curve(1, (60e3, 0.01), (90e3, 0.03))
    signed = user_curve(1, (-40e3, -0.02), (60e3, 0.01), (90e3, 0.03))
    for ink, style, curve, name in (
        (INKS[4], SOLID, signed, "a row of $Y<0$: as given"),
        (INKS[1], DASHED, odd, "no row of $Y<0$: odd"),
    ):
        reaction = Profile(Ground((0.0,), (1,), (0,), {1: curve}, {})).lateral(one, one)
        values = KILO * reaction.evaluate(y[:, None])[0][:, 0]
        signs.plot(1e3 * y, values, color=ink, ls=style, lw=1.8, label=name)
    for axis in (signs.axhline, signs.axvline):
        axis(0.0, color=ZERO, linewidth=0.8)
    frame(signs, "Displacement $y$ (mm)", "$P$ (kPa)", title="Signs")
    signs.set_xlim(-70.0, 70.0)
    signs.set_ylim(-100.0, 140.0)
    legend(signs, "upper left")
    stiff = user_curve(2, (200e3, 0.005))
    pair = Profile(Ground((0.0, 10.0), (1, 2), (0, 0), {1: odd, 2: stiff}, {}))
    z, y = np.array([0.0, 2.5, 5.0, 7.5, 10.0]), np.linspace(0.0, 0.05, 1001)
    force = pair.lateral(z, np.ones(5)).evaluate(np.broadcast_to(y[:, None], (len(y), 5)))[0]
    family(between, 1e3 * y, zip(metres(z), KILO * force.T, strict=True))
    title = "Between two curves, at 0 and 10 m"
    frame(between, "Displacement $y$ (mm)", "$P$ (kPa)", 50.0, 290.0, title)
    legend(between, "upper left", ncols=3)
    return figure


def layering() -> Figure:
    figure, panels = new_panels(2, 4.4, sharey=True)
    clay = layer(1, "soft_clay", undrained_shear_strength=18e3, **FIRM)
    sand = layer(2, "sand", effective_unit_weight=9.5e3, friction_angle=float(np.radians(33.0)))
    firm = layer(1, "soft_clay", undrained_shear_strength=80e3, **FIRM)
    soft = layer(2, "soft_clay", undrained_shear_strength=18e3, **FIRM)
    depth = np.linspace(0.0, 9.0, 901)
    depth = np.union1d(depth, [4.0, np.nextafter(4.0, 5.0)])
    for axes, title, pair in (
        (panels[0], "Soft clay over sand", (clay, sand)),
        (panels[1], "Firm clay over soft clay", (firm, soft)),
    ):
        ground = Ground((0.0, 4.0, 4.0), (1, 1, 2), (0, 0, 0), {c.id: c for c in pair}, {})
        for ink, style, options, name in (
            (INKS[1], SOLID, {}, "NONE"),
            (INKS[4], DASHED, {"layering": "GEORGIADIS"}, "GEORGIADIS, OWN"),
            (
                INKS[3],
                DOTTED,
                {"layering": "GEORGIADIS", "layering_overburden": "ACTUAL"},
                "GEORGIADIS, ACTUAL",
            ),
        ):
            laws = Profile(replace(ground, **options)).lateral(depth, np.ones(len(depth))).laws
            pu = np.zeros(len(depth))
            for term in laws:
                pu[term.at] = term.law.derived["ultimate_resistance"]
            axes.plot(KILO * pu, depth, color=ink, ls=style, lw=1.8, label=name)
        axes.axhline(4.0, color="#b59b7c", linewidth=1.0)
        depth_down(axes, f"{title}: $p_u$ (kN/m)", 9.0)
        axes.set_xlim(0.0)
    panels[1].set_ylabel("")
    legend(panels[0], "upper right")
    return figure


def groups() -> Figure:
    figure, (rows, means) = new_panels(2, sharey=True)
    spacing = np.linspace(3.0, 8.0, 501)
    for method, style in (("AASHTO", SOLID), ("ROLLINS", DASHED)):
        curves = (
            (name, np.array([group_multiplier(s, row, method) for s in spacing]))
            for row, name in ((1, "row 1"), (2, "row 2"), (3, "row 3 and on"))
        )
        family(rows, spacing, curves, style, method == "AASHTO")
    mean = ((f"MEAN{n}", np.array([mean_multiplier(s, n) for s in spacing])) for n in (2, 3, 4, 5))
    family(means, spacing, mean)
    for axes, title in ((rows, "Each row"), (means, "Mean of the rows, AASHTO")):
        frame(axes, "Spacing $s/D$ (-)", "", top=1.05, title=title)
        axes.set_xlim(3.0, 8.0)
    rows.set_ylabel("p-multiplier (-)")
    legend_and_styles(rows, "lower right", "AASHTO", "Rollins et al.")
    legend(means, "lower right")
    return figure


def lateral_capacity() -> Figure:
    figure, (soil, loads) = new_panels(2, 4.4, width_ratios=(1, 1.4))
    length, D = 12.0, 2.0
    curve = layer(1, "soft_clay", undrained_shear_strength=20e3, **FIRM)
    deep = layer(2, "soft_clay", undrained_shear_strength=44e3, **FIRM)
    profile = Profile(Ground((0.0, length), (1, 2), (0, 0), {1: curve, 2: deep}, {}))

    def width(z: Array) -> Array:
        return np.full(len(z), D)

    found = rigid_mechanism(profile, width, length, (1.0, 10.0))
    assert found.pivot is not None
    for ink, top, bottom, sign in (
        (INKS[1], 0.0, found.pivot, -1.0),
        (INKS[4], found.pivot, length, 1.0),
    ):
        z = np.linspace(top, bottom, 200)
        p = sign * KILO * profile.lateral(z, width(z)).capacity
        soil.fill_betweenx(z, 0.0, p, color=ink, alpha=0.25, linewidth=0.0)
        soil.plot(p, z, color=ink, linewidth=1.6)
    soil.axvline(0.0, color=ZERO, linewidth=3.0)
    soil.plot(0.0, found.pivot, "o", color="white", markeredgecolor=ZERO, markersize=8)
    soil.annotate(
        f"pivot {found.pivot:.1f} m",
        (0.0, found.pivot),
        (60.0, found.pivot - 1.0),
        arrowprops={"arrowstyle": "-", "color": ZERO, "shrinkB": 5},
    )
    depth_down(soil, "Soil on the pile (kN/m)", length)
    angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 91)[1:-1]
    turned = [
        rigid_mechanism(profile, width, length, (float(np.cos(t)), length * float(np.sin(t))))
        for t in angles
    ]
    H, M = (np.array([getattr(t, side) for t in turned]) for side in ("lateral_load", "moment"))
    loads.plot(MEGA * H, MEGA * M, color=INKS[1], linewidth=1.8, label="ultimate loads")
    at = MEGA * found.lateral_load, MEGA * found.moment
    loads.plot([0.0, at[0]], [0.0, at[1]], color=ZERO, linestyle=DASHED, label="$M/H$ = 10 m")
    loads.plot(*at, "o", color=INKS[4], label="the mechanism at left")
    loads.axhline(0.0, color=ZERO, linewidth=0.8)
    frame(loads, "$H$ at the mudline (MN)", "$M$ at the mudline (MN m)")
    loads.set_xlim(0.0)
    legend(loads, "upper right")
    return figure
