"""Figures of the p-y laws of clay: soft, stiff, and ISO's table."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from podeep.arrays import Array
from podeep.soil.iso_clay import IsoClay
from podeep.soil.soft_clay import SoftClay
from podeep.soil.stiff_clay import StiffClay, StiffClayFreeWater

from .canvas import (
    DASHED,
    DOTTED,
    INKS,
    KILO,
    MOVED,
    REACTION,
    SOLID,
    depth_down,
    family,
    frame,
    legend,
    metres,
    new_panels,
    reactions,
    static_and_cyclic,
)


def soft_clay_at(z: Array, **options: Any) -> SoftClay:
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


def soft_clay_shapes() -> Figure:
    figure, (whole, close) = new_panels(2)
    names = (("POWER", "POWER, cube root"), ("2GEO", "2GEO"), ("WSD", "WSD"))
    for axes, end in ((whole, 10.0), (close, 1.5)):
        s = np.linspace(0.0, end, 2001)
        for ink, style, (shape, name) in zip(
            INKS[1:], (SOLID, DASHED, DOTTED), names, strict=False
        ):
            law = soft_clay_at(np.array([5.0]), shape=shape)
            share = reactions(law, s * law.y50)[:, 0] / law.capacity
            axes.plot(s, share, color=ink, linestyle=style, linewidth=1.8, label=name)
    frame(whole, "$y/y_{50}$ (-)", "$p/p_u$ (-)", 10.0, 1.05, "Static shapes")
    frame(close, "$y/y_{50}$ (-)", "$p/p_u$ (-)", 1.5, 0.6, "The same close to rest")
    legend(whole, "lower right")
    return figure


def soft_clay_depths() -> Figure:
    figure, (curves, resistance) = new_panels(2, 4.2, width_ratios=(1.5, 1))
    z, y = np.array([0.0, 2.0, 5.0, 12.0]), np.linspace(0.0, 0.5, 2001)
    static_and_cyclic(curves, soft_clay_at, z, y, "upper right")
    frame(curves, MOVED, REACTION, 500.0, 330.0)
    z = np.linspace(0.0, 15.0, 301)
    static, cyclic = soft_clay_at(z), soft_clay_at(z, cyclic=True)
    for ink, style, values, name in (
        (INKS[1], SOLID, static.capacity, "static"),
        (INKS[3], DASHED, cyclic.capacity, r"cyclic, at $3\,y_{50}$"),
        (INKS[4], DOTTED, cyclic.force(20.0 * cyclic.y50), r"cyclic, from $15\,y_{50}$"),
    ):
        resistance.plot(KILO * values, z, color=ink, ls=style, lw=1.8, label=name)
    depth_down(resistance, "Resistance (kN/m)", 15.0)
    resistance.set_xlim(0.0)
    legend(resistance, "lower left")
    return figure


def stiff_clay_free_water() -> Figure:
    figure, (static, cyclic) = new_panels(2, 4.0)
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
        share = (reactions(law, r * law.y50) / law.ultimate_resistance).T
        names = [f"{ratio:g}" for ratio in z]
        family(axes, r, zip(names, share, strict=True))
        title = "Cyclic" if moving else "Static"
        frame(axes, "$y/y_{50}$ (-)", "$p/p_c$ (-)", end, 0.6, title)
    legend(cyclic, "upper right", title="$z/D$ (-)")
    return figure


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

    figure, (cycles, depths) = new_panels(2, 4.0)
    s, one = np.linspace(0.0, 60.0, 3001), np.array([2.0])
    y50 = law(one).y50
    kinds: tuple[dict[str, Any], ...] = (
        {},
        *({"cyclic": True, "cycles": n} for n in (10.0, 100.0, 1000.0)),
    )
    shares = [(reactions(law(one, **k), s * y50) / law(one).capacity)[:, 0] for k in kinds]
    names = ("static", "10 cycles", "100 cycles", "1000 cycles")
    family(cycles, s, zip(names, shares, strict=True))
    frame(cycles, "$y/y_{50}$, $y_{50}$ static (-)", "$p/p_u$ (-)", 60.0, 1.05)
    legend(cycles, "lower right")
    z, y = np.array([0.0, 2.0, 5.0]), np.linspace(0.0, 0.6, 2001)
    static_and_cyclic(depths, law, z, y, cyclic="100 cycles")
    frame(depths, MOVED, REACTION, 600.0, 850.0)
    return figure


def iso_clay_at(z: Array, **options: Any) -> IsoClay:
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


def iso_clay_shapes() -> Figure:
    figure, panels = new_panels(2, sharey=True)
    y = np.linspace(0.0, 0.42, 4001)
    for axes, plasticity in zip(panels, ("HIGH", "LOW"), strict=True):
        for ink, ocr, name in (
            (INKS[0], 1.0, "OCR up to 2"),
            (INKS[1], 3.0, "3, between two columns"),
            (INKS[2], 4.0, "4"),
            (INKS[4], 10.0, "10 and more"),
        ):
            law = iso_clay_at(
                np.array([5.0]), plasticity=plasticity, overconsolidation_ratio=np.array([ocr])
            )
            style = DASHED if ocr == 3.0 else SOLID
            share = reactions(law, y)[:, 0] / law.capacity
            axes.plot(y, share, color=ink, ls=style, lw=1.6, label=name)
        frame(axes, "$y/D$ (-)", "", 0.42, 1.05, f"IP={plasticity}")
    panels[0].set_ylabel("$p/p_u$ (-)")
    legend(panels[1], "lower right")
    return figure


def iso_clay_factor() -> Figure:
    figure, (factor, curves) = new_panels(2, 4.2, width_ratios=(1, 1.4))
    z = np.linspace(0.0, 12.0, 401)
    for ink, style, options, name in (
        (INKS[0], SOLID, {}, "gap"),
        (INKS[3], DASHED, {"strength_ratio": 0.9}, "gap, TE=0.9"),
        (INKS[1], SOLID, {"no_gap": True}, "NOGAP"),
    ):
        factor.plot(iso_clay_at(z, **options).bearing_factor, z, color=ink, ls=style, label=name)
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
    depth_down(factor, "$p_u/(s_u D)$ (-)", 12.0, "Depth in diameters $X/D$ (-)")
    factor.set_xlim(0.0, 13.0)
    legend(factor, "lower left")
    z, y = np.array([1.0, 3.0, 6.0, 10.0]), np.linspace(0.0, 0.3, 2001)
    family(curves, 1e3 * y, zip(metres(z), KILO * reactions(iso_clay_at(z), y).T, strict=True))
    frame(curves, MOVED, REACTION, 300.0, 230.0)
    legend(curves, "upper left", ncols=2)
    return figure
