"""The figures of the pages on laws, drawn with the laws themselves.

A figure is a function of `FIGURES` named as its file; the docs build writes them all into
docs/generated/laws. The same code gives the same bytes: no pyplot, no settings of the user.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.style import context

from podeep.arrays import Array
from podeep.deck.read import read_deck
from podeep.picture import PALETTE, ZERO, new_figure, plain_axes, quantity_on_top
from podeep.scene import Curve, Ground
from podeep.soil import axial, pisa, spudcan_bearing
from podeep.soil.axial_capacity import axial_capacity
from podeep.soil.group import group_multiplier, mean_multiplier
from podeep.soil.iso_clay import IsoClay
from podeep.soil.lateral_capacity import rigid_mechanism
from podeep.soil.law import Law
from podeep.soil.profile import Profile, profile_of
from podeep.soil.reese_sand import ReeseSand
from podeep.soil.sand import Sand, sand_coefficients
from podeep.soil.soft_clay import SoftClay
from podeep.soil.spudcan_yield import YieldSurface, moment_limit
from podeep.soil.stiff_clay import StiffClay, StiffClayFreeWater
from podeep.soil.weak_rock import WeakRock

SAMPLE = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"
INKS = (PALETTE[0], PALETTE[2], PALETTE[4], PALETTE[6], PALETTE[8])
SOLID, DASHED, DOTTED = "-", (0, (5, 2)), (0, (1, 1.5))
KILO, MEGA = 1e-3, 1e-6
MOVED, REACTION = "Lateral displacement $y$ (mm)", "$p$ (kN/m)"
FIGURES: dict[str, Callable[[], Figure]] = {}


def write_figures(folder: Path) -> None:
    """Write every figure into a folder; a file that is the same already is left alone."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in FIGURES:
        path, picture = folder / f"{name}.png", png(name)
        if not path.exists() or path.read_bytes() != picture:
            path.write_bytes(picture)


def png(name: str) -> bytes:
    """A figure as the bytes of a PNG file."""
    with context("default", after_reset=True):
        figure = FIGURES[name]()
        FigureCanvasAgg(figure)
        picture = BytesIO()
        figure.savefig(picture, format="png", metadata={"Software": None})
    return picture.getvalue()


def _drawn(draw: Callable[[], Figure]) -> Callable[[], Figure]:
    FIGURES[draw.__name__] = draw
    return draw


def _panels(count: int, height: float = 3.7, rows: int = 1, **options: Any) -> tuple[Figure, Any]:
    figure = new_figure(8.8, height)
    panels = figure.subplots(rows, count, squeeze=False, **options).ravel()
    for axes in panels:
        plain_axes(axes, 5)
    return figure, panels


def _frame(
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


def _legend(axes: Axes, where: str, **options: Any) -> None:
    axes.legend(loc=where, **{"fontsize": 9, "framealpha": 0.9, "edgecolor": "#dddddd", **options})


def _family(
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


def _styles(axes: Axes, where: str, *names: str, **options: Any) -> None:
    """A legend of the curves' names, and of what solid, dashed and dotted lines are."""
    handles, labels = axes.get_legend_handles_labels()
    for name, style in zip(names, (SOLID, DASHED, DOTTED), strict=False):
        handles.append(Line2D([], [], color=ZERO, linestyle=style, linewidth=1.6))
        labels.append(name)
    _legend(axes, where, handles=handles, labels=labels, handlelength=2.6, **options)


def _down(
    axes: Axes, label: str, bottom: float, depth: str = "Depth below the mudline (m)"
) -> None:
    """Depth runs down, the quantity stands on top."""
    axes.set_ylim(bottom, 0.0)
    quantity_on_top(axes, label)
    axes.set_ylabel(depth)


def _at(law: Law, u: Array) -> Array:
    """Reactions at displacements (m,), a column for each point of the law: shape (m, n)."""
    return law.force(np.broadcast_to(u[:, None], (len(u), len(law.capacity))))


def _metres(depths: Array) -> list[str]:
    return [f"{z:g} m" for z in depths]


def _static_and_cyclic(
    axes: Axes,
    law: Callable[..., Law],
    z: Array,
    y: Array,
    where: str = "upper left",
    cyclic: str = "cyclic",
) -> None:
    """Curves p(y) of a law at depths, solid static and dashed cyclic."""
    for moving, style in ((False, SOLID), (True, DASHED)):
        p = KILO * _at(law(z, cyclic=moving), y).T
        _family(axes, 1e3 * y, zip(_metres(z), p, strict=True), style, not moving)
    _styles(axes, where, "static", cyclic, ncols=3)


# --- p-y laws ---------------------------------------------------------------------------------


def _soft_clay(z: Array, **options: Any) -> SoftClay:
    """1 m wide, 10 kPa and 1.5 kPa more each metre, 7 kN/m3."""
    return SoftClay(
        depth=z,
        diameter=1.0,
        effective_overburden=7e3 * z,
        undrained_shear_strength=10e3 + 1.5e3 * z,
        effective_unit_weight=7e3,
        j=0.5,
        strain_50=0.01,
        **options,
    )


@_drawn
def soft_clay_shapes() -> Figure:
    figure, (whole, close) = _panels(2)
    names = (("POWER", "POWER, cube root"), ("2GEO", "2GEO"), ("WSD", "WSD"))
    for axes, end in ((whole, 10.0), (close, 1.5)):
        s = np.linspace(0.0, end, 2001)
        for ink, style, (shape, name) in zip(
            INKS[1:], (SOLID, DASHED, DOTTED), names, strict=False
        ):
            law = _soft_clay(np.array([5.0]), shape=shape)
            share = _at(law, s * law.y50)[:, 0] / law.capacity
            axes.plot(s, share, color=ink, linestyle=style, linewidth=1.8, label=name)
    _frame(whole, "$y/y_{50}$ (-)", "$p/p_u$ (-)", 10.0, 1.05, "Static shapes")
    _frame(close, "$y/y_{50}$ (-)", "$p/p_u$ (-)", 1.5, 0.6, "The same close to rest")
    _legend(whole, "lower right")
    return figure


@_drawn
def soft_clay_depths() -> Figure:
    figure, (curves, resistance) = _panels(2, 4.2, width_ratios=(1.5, 1))
    z, y = np.array([0.0, 2.0, 5.0, 12.0]), np.linspace(0.0, 0.5, 2001)
    _static_and_cyclic(curves, _soft_clay, z, y, "upper right")
    _frame(curves, MOVED, REACTION, 500.0, 330.0)
    z = np.linspace(0.0, 15.0, 301)
    static, cyclic = _soft_clay(z), _soft_clay(z, cyclic=True)
    for ink, style, values, name in (
        (INKS[1], SOLID, static.capacity, "static"),
        (INKS[3], DASHED, cyclic.capacity, r"cyclic, at $3\,y_{50}$"),
        (INKS[4], DOTTED, cyclic.force(20.0 * cyclic.y50), r"cyclic, from $15\,y_{50}$"),
    ):
        resistance.plot(KILO * values, z, color=ink, ls=style, lw=1.8, label=name)
    _down(resistance, "Resistance (kN/m)", 15.0)
    resistance.set_xlim(0.0)
    _legend(resistance, "lower left")
    return figure


@_drawn
def sand_factors() -> Figure:
    figure, (small, large) = _panels(2)
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
        _frame(axes, r"Friction angle $\varphi'$ (deg)", "Coefficient (-)")
        axes.plot([], [], "o", color=ZERO, fillstyle="none", label="read off the figure")
        _legend(axes, "upper left")
    return figure


def _sand(z: Array, law: type[Sand] | type[ReeseSand] = Sand, **options: Any) -> Sand | ReeseSand:
    """1 m wide, 33 degrees, 10 kN/m3."""
    given: dict[str, Any] = {
        "depth": z,
        "diameter": 1.0,
        "effective_overburden": 10e3 * z,
        "friction_angle": np.radians(33.0),
    }
    return law(**given, **options)


@_drawn
def sand_depths() -> Figure:
    figure, (curves, share) = _panels(2, 4.0, width_ratios=(1.5, 1))
    z, y = np.array([0.5, 1.0, 2.0, 3.0]), np.linspace(0.0, 0.025, 801)
    _static_and_cyclic(curves, _sand, z, y)
    _frame(curves, MOVED, REACTION, 25.0, 350.0)
    z = np.linspace(0.01, 6.0, 300)
    for ink, style, cyclic, name in (
        (INKS[1], SOLID, False, "static"),
        (INKS[4], DASHED, True, "cyclic"),
    ):
        share.plot(_sand(z, cyclic=cyclic).capacity / 10e3 / z, z, color=ink, ls=style, label=name)
    _down(share, r"$A\,p_u/(\sigma'_v D)$ (-)", 6.0, "Depth in diameters $X/D$ (-)")
    share.set_xlim(0.0)
    _legend(share, "lower left")
    return figure


@_drawn
def stiff_clay_free_water() -> Figure:
    figure, (static, cyclic) = _panels(2, 4.0)
    z = np.array([0.2, 1.0, 3.0])
    for axes, moving, end in ((static, False, 13.0), (cyclic, True, 4.0)):
        law = StiffClayFreeWater(
            depth=z,
            diameter=1.0,
            effective_overburden=9e3 * z,
            undrained_shear_strength=90e3,
            mean_undrained_shear_strength=90e3,
            strain_50=0.007,
            cyclic=moving,
        )
        r = np.linspace(0.0, end, 4001)
        share = (_at(law, r * law.y50) / law.ultimate_resistance).T
        names = [f"{ratio:g}" for ratio in z]
        _family(axes, r, zip(names, share, strict=True))
        title = "Cyclic" if moving else "Static"
        _frame(axes, "$y/y_{50}$ (-)", "$p/p_c$ (-)", end, 0.6, title)
    _legend(cyclic, "upper right", title="$z/D$ (-)")
    return figure


@_drawn
def stiff_clay() -> Figure:
    def law(z: Array, **options: Any) -> StiffClay:
        return StiffClay(
            depth=z,
            diameter=1.0,
            effective_overburden=19e3 * z,
            undrained_shear_strength=100e3,
            mean_undrained_shear_strength=100e3,
            strain_50=0.005,
            **options,
        )

    figure, (cycles, depths) = _panels(2, 4.0)
    s, one = np.linspace(0.0, 60.0, 3001), np.array([2.0])
    y50 = law(one).y50
    kinds: tuple[dict[str, Any], ...] = (
        {},
        *({"cyclic": True, "cycles": n} for n in (10.0, 100.0, 1000.0)),
    )
    shares = [(_at(law(one, **k), s * y50) / law(one).capacity)[:, 0] for k in kinds]
    names = ("static", "10 cycles", "100 cycles", "1000 cycles")
    _family(cycles, s, zip(names, shares, strict=True))
    _frame(cycles, "$y/y_{50}$, $y_{50}$ static (-)", "$p/p_u$ (-)", 60.0, 1.05)
    _legend(cycles, "lower right")
    z, y = np.array([0.0, 2.0, 5.0]), np.linspace(0.0, 0.6, 2001)
    _static_and_cyclic(depths, law, z, y, cyclic="100 cycles")
    _frame(depths, MOVED, REACTION, 600.0, 850.0)
    return figure


@_drawn
def weak_rock() -> Figure:
    figure, (depths, rocks) = _panels(2, 3.9)
    kind = WeakRock(
        depth_in_rock=np.array([0.0, 1.5, 3.0]),
        diameter=1.0,
        compressive_strength=2e6,
        rock_mass_modulus=200e6,
        rock_quality_designation=0.5,
        strain_rm=2e-4,
    )
    y = np.linspace(0.0, 4e-3, 2001)
    names = _metres(np.asarray(kind.depth_in_rock))
    _family(depths, 1e3 * y, zip(names, MEGA * _at(kind, y).T, strict=True))
    one = replace(kind, depth_in_rock=np.array([1.0]))
    for ink, style, changed, name in (
        (INKS[0], SOLID, {"rock_quality_designation": 0.0}, "RQD 0 %"),
        (INKS[1], SOLID, {}, "RQD 50 %"),
        (INKS[2], SOLID, {"rock_quality_designation": 1.0}, "RQD 100 %"),
        (INKS[4], DASHED, {"rock_mass_modulus": 20e6}, "RQD 50 %, $E_{ir}$ 20 MPa"),
    ):
        p = MEGA * _at(replace(one, **changed), y)[:, 0]
        rocks.plot(1e3 * y, p, color=ink, ls=style, lw=1.6, label=name)
    _frame(depths, MOVED, "$p$ (MN/m)", 4.0, 9.0, "By depth below the rock's surface")
    _frame(rocks, MOVED, "$p$ (MN/m)", 4.0, 6.5, "At 1 m, by rock")
    _legend(depths, "upper left", ncols=3)
    _legend(rocks, "upper left", ncols=2)
    return figure


def _iso_clay(z: Array, **options: Any) -> IsoClay:
    """1 m wide, 2 kPa and 1.5 kPa more each metre, 6 kN/m3, alpha 0.8."""
    given = {"overconsolidation_ratio": 1.0, "adhesion": 0.8, **options}
    return IsoClay(
        depth=z,
        diameter=1.0,
        effective_overburden=6e3 * z,
        undrained_shear_strength=2e3 + 1.5e3 * z,
        mudline_strength=2e3,
        strength_gradient=1.5e3,
        **given,
    )


@_drawn
def iso_clay_shapes() -> Figure:
    figure, panels = _panels(2, sharey=True)
    y = np.linspace(0.0, 0.42, 4001)
    for axes, plasticity in zip(panels, ("HIGH", "LOW"), strict=True):
        for ink, ocr, name in (
            (INKS[0], 1.0, "OCR up to 2"),
            (INKS[1], 3.0, "3, between two columns"),
            (INKS[2], 4.0, "4"),
            (INKS[4], 10.0, "10 and more"),
        ):
            law = _iso_clay(
                np.array([5.0]), plasticity=plasticity, overconsolidation_ratio=np.array([ocr])
            )
            style = DASHED if ocr == 3.0 else SOLID
            share = _at(law, y)[:, 0] / law.capacity
            axes.plot(y, share, color=ink, ls=style, lw=1.6, label=name)
        _frame(axes, "$y/D$ (-)", "", 0.42, 1.05, f"IP={plasticity}")
    panels[0].set_ylabel("$p/p_u$ (-)")
    _legend(panels[1], "lower right")
    return figure


@_drawn
def iso_clay_factor() -> Figure:
    figure, (factor, curves) = _panels(2, 4.2, width_ratios=(1, 1.4))
    z = np.linspace(0.0, 12.0, 401)
    for ink, style, options, name in (
        (INKS[0], SOLID, {}, "gap"),
        (INKS[3], DASHED, {"strength_ratio": 0.9}, "gap, TE=0.9"),
        (INKS[1], SOLID, {"no_gap": True}, "NOGAP"),
    ):
        factor.plot(_iso_clay(z, **options).bearing_factor, z, color=ink, ls=style, label=name)
    api = SoftClay(
        depth=z,
        diameter=1.0,
        effective_overburden=6e3 * z,
        undrained_shear_strength=2e3 + 1.5e3 * z,
        effective_unit_weight=6e3,
        j=0.5,
        strain_50=0.01,
    ).ultimate_resistance
    factor.plot(api / (2e3 + 1.5e3 * z), z, color=INKS[4], ls=DOTTED, lw=1.8, label="ITYP 1")
    _down(factor, "$p_u/(s_u D)$ (-)", 12.0, "Depth in diameters $X/D$ (-)")
    factor.set_xlim(0.0, 13.0)
    _legend(factor, "lower left")
    z, y = np.array([1.0, 3.0, 6.0, 10.0]), np.linspace(0.0, 0.3, 2001)
    _family(curves, 1e3 * y, zip(_metres(z), KILO * _at(_iso_clay(z), y).T, strict=True))
    _frame(curves, MOVED, REACTION, 300.0, 230.0)
    _legend(curves, "upper left", ncols=2)
    return figure


@_drawn
def pisa_lateral() -> Figure:
    figure, (clay, sand) = _panels(2, 4.0)
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
        _family(clay, X, zip(names, _at(law, X).T, strict=True), style, site == "COWDEN")
    _frame(clay, "$X = y\\,G_0/(s_u D)$ (-)", "$Y = p/(s_u D)$ (-)", 260.0, 12.5, "Clay")
    _styles(clay, "upper left", "COWDEN", "BOTHKENNAR", ncols=2)
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
        _family(sand, X, zip(names, _at(dense, X).T, strict=True), style, z == 1.0)
    stress = r"(\sigma'_v D)"
    _frame(sand, f"$X = y\\,G_0/{stress}$ (-)", f"$Y = p/{stress}$ (-)", 130.0, 30.0, "Sand")
    _styles(sand, "upper left", "$z/L$ 0.2", "$z/L$ 0.8", ncols=2)
    return figure


@_drawn
def pisa_reactions() -> Figure:
    figure, (p, m, base_shear, base_moment) = _panels(2, 6.4, rows=2)
    z = np.array([2.0, 10.0, 20.0])
    given: dict[str, Any] = {
        "diameter": 7.5,
        "embedded_length": 30.0,
        "initial_shear_modulus": np.full(3, 60e6),
        "undrained_shear_strength": 100e3,
    }
    tip = {**given, "initial_shear_modulus": np.array([60e6])}
    y, turn = np.linspace(0.0, 0.4, 1001), np.linspace(0.0, 0.02, 1001)
    names, rotation = _metres(z), "Rotation (mrad)"
    lateral, along = pisa.PisaClay(depth=z, **given), pisa.PisaClayMoment(depth=z, **given)
    _family(p, 1e3 * y, zip(names, MEGA * _at(lateral, y).T, strict=True))
    _family(m, 50.0 * turn, zip(names, MEGA * _at(along, 0.05 * turn).T, strict=True))
    ink: dict[str, Any] = {"color": PALETTE[1], "linewidth": 1.6}
    base_shear.plot(1e3 * y, MEGA * _at(pisa.PisaClayBaseShear(**tip), y), **ink)
    base_moment.plot(1e3 * turn, MEGA * _at(pisa.PisaClayBaseMoment(**tip), turn), **ink)
    _frame(p, MOVED, "$p$ (MN/m)", 400.0, 6.5, "Along the shaft: $p$")
    _frame(m, rotation, "$m$ (MN m/m)", 1.0, 1.7, "Along the shaft: $m$")
    _frame(base_shear, MOVED, "$H_B$ (MN)", 400.0, 3.5, "At the base: $H_B$")
    _frame(base_moment, rotation, "$M_B$ (MN m)", 20.0, 17.0, "At the base: $M_B$")
    _legend(p, "upper left", ncols=3)
    _legend(m, "lower right")
    return figure


@_drawn
def reese_sand() -> Figure:
    figure, (curves, beside) = _panels(2, 4.0)
    z, y = np.array([0.5, 1.0, 2.0, 3.0]), np.linspace(0.0, 0.06, 2001)
    _static_and_cyclic(curves, partial(_sand, law=ReeseSand), z, y)
    _frame(curves, MOVED, REACTION, 60.0, 430.0, "By depth")
    one = np.array([2.0])
    for kind, ink, name in ((ReeseSand, INKS[4], "ITYP 9"), (Sand, INKS[1], "ITYP 2 (API)")):
        for cyclic, style in ((False, SOLID), (True, DASHED)):
            p = KILO * _at(_sand(one, kind, cyclic=cyclic), y)[:, 0]
            label = None if cyclic else name
            beside.plot(1e3 * y, p, color=ink, ls=style, lw=1.6, label=label)
    _frame(beside, MOVED, REACTION, 60.0, 260.0, "At 2 m, beside API's sand")
    _styles(beside, "lower right", "static", "cyclic")
    return figure


@_drawn
def reese_sand_charts() -> Figure:
    figure, panels = _panels(2, 3.5, sharey=True)
    ratio = np.linspace(0.01, 6.0, 600)
    for axes, name in zip(panels, "AB", strict=True):
        for cyclic, style, ink in ((False, SOLID, INKS[1]), (True, DASHED, INKS[4])):
            chart = _sand(ratio, ReeseSand, cyclic=cyclic).derived[name]
            axes.plot(ratio, chart, color=ink, ls=style, label="cyclic" if cyclic else "static")
        _frame(axes, "$X/D$ (-)", "", 6.0, 3.0, f"Factor ${name}$ (-)")
        _legend(axes, "upper right")
    return figure


def _user(id_: int, *rows: tuple[float, ...]) -> Curve:
    return Curve(id_, "user", {}, {}, rows)


@_drawn
def user_curves() -> Figure:
    figure, (signs, between) = _panels(2)
    one = np.ones(1)
    y = np.linspace(-0.07, 0.07, 1401)
    odd = _user(1, (60e3, 0.01), (90e3, 0.03))
    signed = _user(1, (-40e3, -0.02), (60e3, 0.01), (90e3, 0.03))
    for ink, style, curve, name in (
        (INKS[4], SOLID, signed, "a row of $Y<0$: as given"),
        (INKS[1], DASHED, odd, "no row of $Y<0$: odd"),
    ):
        reaction = Profile(Ground((0.0,), (1,), (0,), {1: curve}, {})).lateral(one, one)
        values = KILO * reaction.evaluate(y[:, None])[0][:, 0]
        signs.plot(1e3 * y, values, color=ink, ls=style, lw=1.8, label=name)
    for axis in (signs.axhline, signs.axvline):
        axis(0.0, color=ZERO, linewidth=0.8)
    _frame(signs, "Displacement $y$ (mm)", "$P$ (kPa)", title="Signs")
    signs.set_xlim(-70.0, 70.0)
    signs.set_ylim(-100.0, 140.0)
    _legend(signs, "upper left")
    stiff = _user(2, (200e3, 0.005))
    pair = Profile(Ground((0.0, 10.0), (1, 2), (0, 0), {1: odd, 2: stiff}, {}))
    z, y = np.array([0.0, 2.5, 5.0, 7.5, 10.0]), np.linspace(0.0, 0.05, 1001)
    force = pair.lateral(z, np.ones(5)).evaluate(np.broadcast_to(y[:, None], (len(y), 5)))[0]
    _family(between, 1e3 * y, zip(_metres(z), KILO * force.T, strict=True))
    title = "Between two curves, at 0 and 10 m"
    _frame(between, "Displacement $y$ (mm)", "$P$ (kPa)", 50.0, 290.0, title)
    _legend(between, "upper left", ncols=3)
    return figure


# --- axial ------------------------------------------------------------------------------------


@_drawn
def tz_qz() -> Figure:
    figure, (shaft, tip) = _panels(2, 4.0)
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
        shaft.plot(w, _at(law, w)[:, 0] / law.capacity, color=ink, ls=style, lw=1.6, label=name)
    _frame(shaft, "$w/D$, of a shaft of 1 m (-)", "$t/t_{max}$ (-)", 0.03, 1.1, "Shaft")
    _legend(shaft, "lower right")
    w = np.linspace(-0.04, 0.14, 3001)
    for ink, style, shape in ((INKS[1], SOLID, "2GEO"), (INKS[4], DOTTED, "EP")):
        end = axial.DirectTip(**given, tip_pressure=np.array([500e3]), shape=shape)
        name = "API and 2GEO" if shape == "2GEO" else "EP"
        tip.plot(w, _at(end, w)[:, 0] / end.capacity, color=ink, ls=style, lw=1.6, label=name)
    for axis in (tip.axhline, tip.axvline):
        axis(0.0, color=ZERO, linewidth=0.8)
    _frame(tip, "$w/D$, of a tip of 1 m (-)", "$q/q_{max}$ (-)", title="Tip")
    tip.set_xlim(-0.04, 0.14)
    tip.set_ylim(-0.06, 1.1)
    _legend(tip, "lower right")
    return figure


@_drawn
def unit_friction_bearing() -> Figure:
    figure, (clay, friction, bearing) = _panels(3, 4.2)
    psi = np.geomspace(0.05, 10.0, 400)
    clay.plot(psi, axial.alpha_friction(psi, 1.0) / psi, color=INKS[1], linewidth=1.8)
    clay.set_xscale("log")
    clay.set_xticks([0.1, 0.25, 1, 3, 10], ["0.1", "0.25", "1", "3", "10"])
    clay.minorticks_off()
    _frame(clay, r"$\psi = s_u/\sigma'_v$ (-)", r"$\alpha$ (-)", top=1.1)
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
    _down(friction, "$f$ in sand (kPa)", 60.0)
    _down(bearing, "$q$ in sand (MPa)", 60.0)
    friction.set_xlim(0.0)
    bearing.set_xlim(0.0, 19.0)
    bearing.set_ylabel("")
    _legend(friction, "lower left")
    _legend(bearing, "upper right")
    return figure


@_drawn
def axial_capacity_depths() -> Figure:
    scene = read_deck(SAMPLE).scene
    foundation = scene.foundations[0]
    profile, depth = profile_of(scene, foundation), np.linspace(0.0, 70.0, 701)
    edges = np.array(profile.boundaries)
    depth = np.union1d(depth, [*edges, *np.nextafter(edges, np.inf)])
    sections = scene.tubes[foundation.tubes[0]].sections
    found = axial_capacity(profile, sections, depth, mudline=foundation.mudline)
    figure, (pressed, pulled) = _panels(2, 4.6, sharey=True)
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
        _down(axes, f"{title} (MN)", 70.0, "Depth of the tip (m)")
        axes.set_xlim(0.0, 72.0)
        _legend(axes, "upper right")
    pulled.set_ylabel("")
    return figure


# --- the ground and the pile ------------------------------------------------------------------


def _layer(id_: int, law: str, **parameters: float) -> Curve:
    return Curve(id_, law, parameters)


_FIRM = {"effective_unit_weight": 8e3, "j": 0.5, "strain_50": 0.01}


@_drawn
def layering() -> Figure:
    figure, panels = _panels(2, 4.4, sharey=True)
    clay = _layer(1, "soft_clay", undrained_shear_strength=18e3, **_FIRM)
    sand = _layer(2, "sand", effective_unit_weight=9.5e3, friction_angle=float(np.radians(33.0)))
    firm = _layer(1, "soft_clay", undrained_shear_strength=80e3, **_FIRM)
    soft = _layer(2, "soft_clay", undrained_shear_strength=18e3, **_FIRM)
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
        _down(axes, f"{title}: $p_u$ (kN/m)", 9.0)
        axes.set_xlim(0.0)
    panels[1].set_ylabel("")
    _legend(panels[0], "upper right")
    return figure


@_drawn
def groups() -> Figure:
    figure, (rows, means) = _panels(2, sharey=True)
    spacing = np.linspace(3.0, 8.0, 501)
    for method, style in (("AASHTO", SOLID), ("ROLLINS", DASHED)):
        curves = (
            (name, np.array([group_multiplier(s, row, method) for s in spacing]))
            for row, name in ((1, "row 1"), (2, "row 2"), (3, "row 3 and on"))
        )
        _family(rows, spacing, curves, style, method == "AASHTO")
    mean = ((f"MEAN{n}", np.array([mean_multiplier(s, n) for s in spacing])) for n in (2, 3, 4, 5))
    _family(means, spacing, mean)
    for axes, title in ((rows, "Each row"), (means, "Mean of the rows, AASHTO")):
        _frame(axes, "Spacing $s/D$ (-)", "", top=1.05, title=title)
        axes.set_xlim(3.0, 8.0)
    rows.set_ylabel("p-multiplier (-)")
    _styles(rows, "lower right", "AASHTO", "Rollins et al.")
    _legend(means, "lower right")
    return figure


@_drawn
def lateral_capacity() -> Figure:
    figure, (soil, loads) = _panels(2, 4.4, width_ratios=(1, 1.4))
    length, D = 12.0, 2.0
    curve = _layer(1, "soft_clay", undrained_shear_strength=20e3, **_FIRM)
    deep = _layer(2, "soft_clay", undrained_shear_strength=44e3, **_FIRM)
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
    _down(soil, "Soil on the pile (kN/m)", length)
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
    _frame(loads, "$H$ at the mudline (MN)", "$M$ at the mudline (MN m)")
    loads.set_xlim(0.0)
    _legend(loads, "upper right")
    return figure


@_drawn
def spudcan_yield() -> Figure:
    figure, (section, stiffness) = _panels(2, 4.0)
    v = np.linspace(0.0, 1.0, 1001)
    for ink, a in zip(INKS[:3], (0.0, 0.5, 1.0), strict=True):
        surface = YieldSurface(1.0, 1.0, 1.0, a)
        limit = [moment_limit(surface, float(share), 0.0) for share in v]
        section.plot(v, limit, color=ink, linewidth=1.8, label=f"$a$ = {a:g}")
    taken = r"$\sqrt{(H/Q_H)^2 + (M/Q_M)^2}$ (-)"
    _frame(section, "$V/Q_V$ (-)", taken, 1.0, 1.2, "Yield surface")
    _legend(section, "upper right")
    rf = np.linspace(0.0, 1.0, 2001)
    fr = YieldSurface.reduction(rf)
    stiffness.plot(rf, fr, color=INKS[4], linewidth=1.8)
    stiffness.plot([1.0, 1.0, 1.2], [fr[-1], 0.0, 0.0], color=INKS[4], linewidth=1.8)
    _frame(stiffness, "$r_f$ (-)", "$f_r$ (-)", 1.2, title="Rotational stiffness that is left")
    stiffness.set_ylim(-0.03, 1.05)
    return figure


@_drawn
def spudcan_capacity() -> Figure:
    figure, (clay, sand, layers) = _panels(3, 4.0)
    ratio = np.linspace(0.0, 3.0, 301)
    found = spudcan_bearing.clay_bearing_capacity(40e3, 1.0, ratio, 0.0)
    clay.plot(found.factors["NcScDc"], ratio, color=INKS[1], linewidth=1.8)
    _down(clay, "$N_c s_c d_c$ in clay (-)", 3.0, "$D_p/B$ (-)")
    clay.set_xlim(5.5, 9.5)
    phi = np.linspace(20.0, 40.0, 201)
    factors = spudcan_bearing.sand_bearing_capacity(np.radians(phi), 1.0, 0.0, 10e3, 0.0).factors
    for ink, name in ((INKS[1], "Nq"), (INKS[4], "Ng")):
        label = "$N_q$" if name == "Nq" else r"$N_\gamma$"
        sand.plot(phi, factors[name], color=ink, linewidth=1.8, label=label)
    sand.set_yscale("log")
    sand.set_yticks([5, 10, 20, 50, 100], ["5", "10", "20", "50", "100"])
    sand.minorticks_off()
    _frame(sand, r"$\varphi'$ (deg)", "Factor in sand (-)")
    _legend(sand, "upper left")
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
    _frame(layers, "$T/B$ or $H/B$ (-)", "$q$ (kPa)", 1.5, 950.0)
    _legend(layers, "upper right")
    return figure
