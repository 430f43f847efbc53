"""The numbers of the pages on laws, in tables and in prose, are those of the code."""

import re
from dataclasses import replace
from math import exp, radians

import numpy as np
import pytest

from decks import solved
from manual import PAGES, figures, power, says, table
from podeep.deck.read import read_deck
from podeep.scene import Curve, Ground
from podeep.soil import pisa_fits
from podeep.soil.axial_capacity import axial_capacity
from podeep.soil.group import group_multiplier
from podeep.soil.iso_clay import _TABLES as ISO
from podeep.soil.lateral_capacity import rigid_mechanism
from podeep.soil.profile import Profile, profile_of
from podeep.soil.reese_sand import _CHARTS, ReeseSand
from podeep.soil.required_length import required_length
from podeep.soil.sand import Sand, default_subgrade_modulus, sand_coefficients
from podeep.soil.spudcan_bearing import clay_bearing_capacity, sand_bearing_capacity
from podeep.soil.spudcan_yield import YieldSurface
from podeep.soil.stiff_clay import StiffClay, StiffClayFreeWater

reactions = figures.canvas.reactions

# --- tables -----------------------------------------------------------------------------------


def test_the_tables_of_pages_are_those_of_the_laws():
    for plasticity, rows in ISO.items():
        for row, ocr in zip(rows, ("OCR to 2", "4", "from 10"), strict=True):
            assert table("iso_clay", f"{plasticity}, {ocr}") == row[1:].tolist()
    for cyclic, chart in _CHARTS.items():
        for name, values in zip("AB", chart, strict=True):
            kind = "cyclic" if cyclic else "static"
            assert table("reese_sand", f"${name}$ {kind}") == list(values)
    assert table("spudcan", "$N_c s_c d_c$") == [
        float(clay_bearing_capacity(1.0, 1.0, ratio, 0.0).factors["NcScDc"])
        for ratio in (0.0, 0.1, 0.25, 0.5, 1.0, 2.5)
    ]


def test_the_fits_of_pisa():
    cells = re.findall(r"^\| (?:\$(\w+)\$: )?\$(\w+)\$ \|(.*)\|$", PAGES["pisa"], re.M)
    zeta, eta, R = 1.7, 3.1, 0.6
    lambda_ = zeta / eta
    given = {"zeta": zeta, "eta": eta, "R": R, "lambda_": lambda_, "exp": exp}
    seen, reaction = set(), ""
    for first, parameter, row in cells:
        reaction = first.replace("_", "") or reaction
        for fits, cell in zip(
            (pisa_fits.COWDEN, pisa_fits.BOTHKENNAR, pisa_fits.DUNKIRK), row.split("|"), strict=True
        ):
            text = cell.strip(" $").replace("\\lambda", "lambda_").replace("\\", "")
            text = re.sub(r"e\^\{(.*?)\}", r"*exp(\1)", text)
            text = re.sub(r"(?<=[\d)])(?=[Rzel(])(?!e-)", "*", text).replace("R)", "R) ")
            fit = getattr(fits[reaction], parameter.replace("_", ""))
            at_base = reaction in ("HB", "MB")
            x = eta if at_base else lambda_ if fit.z_over == "L" else zeta
            assert eval(text, given) == pytest.approx(float(fit.at(np.array(x), R))), (cell, text)
        seen.add((reaction, parameter))
    assert len(seen) == 3 * 4 + 2


# --- numbers in prose -------------------------------------------------------------------------

ONE = np.ones(1)


def soft(shape="2GEO", z=20.0, **options):
    return replace(figures.clay.soft_clay_at(z * ONE), shape=shape, **options)


def slope_at_rest(law) -> float:
    return float(law.stiffness(np.zeros(1))[0] * law.y50[0] / law.capacity[0])


def head(tmp_path, shape, load) -> float:
    text = (
        f"*DEPTH\n0\n*GROUNDEPTH\n0 -50\n*PYCURVE, SHAPE={shape}\n1 1 30e3 8e3 0.5 0.015\n"
        "*GROUNDPROP\n1 0 1 0\n*CASING\n1 PILE\n0 -30 1 0.04 210e9 7850\n*FONDATION\n1 1\n"
        f"*SUPPORT\n1 -30 Z\n*LOAD\nHEAD 1 0 {load} 0 0 0 0 0\n*QUASISTATIC\n4\n*EXEC\n"
    )
    with solved(tmp_path, text) as database:
        return 1e3 * float(database.foundation("F1").read_tube(1, "displacement_x", -1)[0, 0])


def test_numbers_of_soft_clay(tmp_path):
    low, high = (
        [head(tmp_path, shape, load) for shape in ("POWER", "2GEO", "WSD")]
        for load in (100e3, 400e3)
    )
    root = soft("POWER")
    lost = 1.0 - root.force(1e-6 * root.y50) / root.capacity / (0.5 * np.cbrt(1e-6))
    steep, *slopes = [slope_at_rest(law) for law in (root, soft(), soft("WSD"))]
    says(
        "soft_clay",
        "moves {:.2f} mm with POWER, {:.2f} mm with 2GEO and {:.1f} mm with WSD".format(*low),
        "under 400 kN {:.1f}, {:.1f} and {:.1f} mm".format(*high),
        f"${power(lost[0])}$ of $p$ at $s = 10^{{-6}}$ and nothing at $s = 0.01$",
        rf"${power(steep, 1)}\, p_u/y_{{50}}$",
        "that of 2GEO {:.1f} and that of WSD {:.1f} $p_u".format(*slopes),
        f"for 1/3: {0.5 * 8.0**0.33:.3f} $p_u$",
    )
    top = soft(z=0.0, cyclic=True)
    assert soft(z=0.0).capacity == 3.0 * 10e3
    assert top.force(15.0 * top.y50) == 0.0


def test_numbers_of_sand():
    angles = np.radians((20.0, 25.0, 30.0, 35.0, 40.0))
    C = sand_coefficients(angles)
    read = np.array([[0.77, 1.22, 1.96, 3.0, 4.7], [1.58, 2.05, 2.72, 3.5, 4.35]])
    k = 1e-6 * default_subgrade_modulus(angles[1:])
    z = np.linspace(0.01, 2.6, 2591)
    top = z[np.argmax(figures.sand_rock.sand_at(z).capacity / z)]
    says(
        "sand",
        "At 30° it gives {:.3f}, {:.3f}, {:.2f}".format(*C[:, 2]),
        f"{(C[2, 2] - C[1, 2]) / C[0, 2]:.1f} D at 30°",
        "or 0: {:g}, {:g}, {:g}, {:g} MN/m3 at 25, 30, 35, 40°".format(*k),
        f"its readings within {100 * np.abs(C[:2] / read - 1.0).max():.1f} %",
        f"{100 * (C[2, 0] / 8.0 - 1.0):.1f} % above the reading at 20°",
        f"its top at {top:.2f} D, falls to {2.1 / 0.8:g} D",
    )


def stiff(law, z, **options):
    return law(
        depth=z * ONE,
        diameter=1.0,
        effective_overburden=9e3 * z,
        undrained_shear_strength=100e3,
        mean_undrained_shear_strength=100e3,
        strain_50=0.005,
        **options,
    )


def test_numbers_of_stiff_clays():
    alone = {"subgrade_modulus": 1e30}  # the law without its initial line
    shallow, deep = (stiff(StiffClayFreeWater, z, **alone) for z in (0.0, 30.0))
    cyclic = stiff(StiffClayFreeWater, 30.0, cyclic=True, **alone)
    tops = [float(law.capacity[0] / law.ultimate_resistance[0]) for law in (shallow, deep)]
    left, left_cyclic = (
        float(law.derived["residual_resistance"][0] / law.ultimate_resistance[0])
        for law in (deep, cyclic)
    )
    says(
        "stiff_clay_free_water",
        "{:.2f} $p_c$ at the mudline and {:.2f} $p_c$ at depth".format(*tops),
        f"falls to {left:.3f} $p_c$ at depth. Cyclic loading leaves {left_cyclic / 0.3:.3f} $A_c",
        f"{left_cyclic:.3f} $p_c$ at depth",
    )
    for place, size in ((6.0, 2.2e-4), (18.0, 2.0e-4)):
        y = place * deep.derived["A"] * deep.y50
        jump = (deep.force(y * (1 + 1e-9)) - deep.force(y * (1 - 1e-9))) / deep.ultimate_resistance
        assert power(jump[0], 1) == power(size, 1)
        says("stiff_clay_free_water", rf"${power(size, 1)}\, p_c$ at ${place:.0f} A_s$")
    below, above = (stiff(StiffClayFreeWater, z).derived for z in (0.0911, 0.0912))
    assert below["residual_resistance"] == 0.0 < above["residual_resistance"]
    clay = stiff(StiffClay, 5.0)
    lost = 1.0 - clay.force(1e-6 * clay.y50) / clay.capacity / (0.5 * 1e-6**0.25)
    more = [replace(clay, cyclic=True, cycles=10.0**n).y50[0] / clay.y50[0] for n in range(4)]
    says(
        "stiff_clay",
        f"${power(lost[0])}$ of $p$ at $s = 10^{{-6}}$",
        rf"${power(slope_at_rest(clay), 1)}\, p_u/y_{{50}}$ at rest",
        "is {:g} at $N = 1$, {:.1f} at 10, {:.1f} at 100 and {:.1f} at 1000".format(*more),
    )


def test_numbers_of_iso_clay_and_pisa():
    gap = replace(figures.clay.iso_clay_at(np.zeros(1)), adhesion=1.0)
    plain, extension = replace(gap, no_gap=True), replace(gap, strength_ratio=0.9)
    says(
        "iso_clay",
        f"is {gap.bearing_factor[0]:.2f} with a gap and {plain.bearing_factor[0]:.2f} without",
        f"by {100 * (1.0 - extension.capacity[0] / gap.capacity[0]):.0f} % at the mudline",
        f"{gap.stiffness(np.zeros(1))[0] / gap.capacity[0]:.0f} $p_u/D$",
    )
    for fits in (pisa_fits.COWDEN, pisa_fits.BOTHKENNAR, pisa_fits.DUNKIRK):
        for eta in np.linspace(2.0, 6.0, 9):  # within the range nothing is clipped
            for reaction, of in fits.items():
                share = np.linspace(float(reaction in ("HB", "MB")), 1.0, 21)[:, None]
                R = np.linspace(0.45, 0.9, 4)
                k, n, Xu, Yu = (f.at(share if f.z_over == "L" else share * eta, R) for f in of)
                assert min(k.min(), Yu.min()) > 1e-3
                assert 0.0 <= n.min() <= n.max() <= 1.0
                assert reaction == "m" or (Xu >= Yu / k).all()


def test_numbers_of_reese_sand():
    y, z = np.linspace(1e-5, 0.06, 60000), np.array([2.0, 3.0, 5.0])
    api, own = (reactions(figures.sand_rock.sand_at(z, law), y) for law in (Sand, ReeseSand))
    ratio = reactions(figures.sand_rock.sand_at(z, ReeseSand, cyclic=True), y) / own
    above = 1e3 * y[api[:, 0] > (1.0 + 1e-6) * own[:, 0]]
    most = 100.0 * (api / own)[:, 0].max() - 100.0
    says(
        "reese_sand",
        f"from {above[0]:.1f} to {above[-1]:.0f} mm, by up to {most:.0f} %",
        f"up to {100 * ratio[:, 1].max() - 100:.0f} % above static below "
        f"{1e3 * y[ratio[:, 1] > 1.0 + 1e-9].max():.1f} mm",
        f"at 5 D up to {100 * ratio[:, 2].max() - 100:.0f} %",
    )


def test_numbers_of_layers_and_groups():
    clay, strong, weak = (
        figures.layers.layer(i, "soft_clay", undrained_shear_strength=su, **figures.layers.FIRM)
        for i, su in ((1, 18e3), (1, 80e3), (2, 18e3))
    )
    given = {"effective_unit_weight": 9.5e3, "friction_angle": radians(33.0)}

    def law(upper, lower, layering="GEORGIADIS", overburden="OWN"):
        ground = Ground((0.0, 4.0, 4.0), (1, 1, 2), (0, 0, 0), {1: upper, 2: lower}, {})
        chosen = replace(ground, layering=layering, layering_overburden=overburden)
        return Profile(chosen).lateral(np.nextafter(4.0, 5.0) * ONE, ONE).laws[0].law

    ways = (("NONE", "OWN"), ("GEORGIADIS", "OWN"), ("GEORGIADIS", "ACTUAL"))
    pu = [law(clay, Curve(2, "sand", given), *way).ultimate_resistance[0] * 1e-3 for way in ways]
    says(
        "layering",
        "{:.0f} kN/m by its actual depth, {:.0f} by `OWN` and {:.0f} by `ACTUAL`".format(*pu),
        f"`ACTUAL`, {100 * (pu[2] / pu[1] - 1):.0f} % more",
        f"{law(strong, weak).depth[0]:.1f} m for 4 m",
    )
    for row in (1, 2, 3):
        (cells,) = re.findall(rf"^\| {row}\b[^|]*\|(.*)\|$", PAGES["groups"], re.M)
        assert [float(c) for c in cells.split("|")] == [group_multiplier(s, row) for s in (3, 5)]


def test_numbers_of_capacities():
    scene = read_deck(figures.axial.SAMPLE).scene
    sections = next(iter(scene.tubes.values())).sections
    ground = profile_of(scene, scene.foundations[0])
    mudline, edge = scene.foundations[0].mudline, np.array([24.0, np.nextafter(24.0, 25.0)])
    at = axial_capacity(ground, sections, edge, mudline=mudline)
    needed = required_length(ground, sections, 75.0, compression=4e6, mudline=mudline)
    ((start, end),) = needed.failing_again
    says(
        "axial_capacity",
        "from {:.2f} to {:.2f} MN".format(*(1e-6 * at.compression)),
        f"needs {needed.length:.1f} m, fails again from {start:.0f} to {end:.1f} m",
    )
    flat = Profile(Ground((0.0,), (1,), (0,), {1: Curve(1, "user", {}, {}, ((1.0, 1e-3),))}, {}))
    push = rigid_mechanism(flat, np.ones_like, 1.0, (1.0, 0.0))
    says("lateral_capacity", rf"$a = {push.pivot:.3f} L$ and $H = {push.lateral_load:.3f}\, p_u L$")
    end = YieldSurface.reduction(np.array([1.0, np.nextafter(1.0, 2.0)]))
    dq = [
        float(sand_bearing_capacity(radians(30.0), 1.0, depth, 1e4, 1e4).factors["dq"])
        for depth in (1.0, 1.0 + 1e-9)
    ]
    says("spudcan", "from {:.1f} to {:g} at $r_f = 1$".format(*end))
    says("spudcan", "from {:.3f} to {:.3f} at $D_p = B$ (30°)".format(*dq))
