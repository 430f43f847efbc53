"""Static cases on nonlinear soil: each has a deck, and deviations of a solution from its oracle.

Named after their source: the elastic-plastic shaft of Scott and Motta (CF08: its loading branch,
since statics are path independent here), rigid piles (CF09), beams that lift off their springs
(CF28: Tsai and Westmann 1967, code_aster's SSNL130), springs p = kc sqrt(y) and ks z sqrt(y) of
the Japanese port standard (CF29, PYMethod.jl), OC3's monopile (PR06), the OpenSees pile (PR01).
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np

from closed_forms import DATA, Profile, error
from decks import REACH, deck
from podeep.arrays import Array
from podeep.database.read import Database

RIGID = 1e13  # N m2: of a tube that stands for a rigid one of 5 m
ROWS = 200  # of the curve that stands for a square root


@dataclass(frozen=True)
class Deviation:
    """How far a quantity is from its oracle, and how far it may be."""

    what: str
    found: float
    asked: float


Deviations = list[Deviation]


@dataclass(frozen=True)
class StaticCase:
    """A deck, and what a database of it is compared with."""

    text: str
    compare: Callable[[Database], Deviations]


def rows(name: str) -> list[dict[str, str]]:
    with (DATA / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(given: list[dict[str, str]], name: str) -> Array:
    return np.array([float(row[name]) for row in given])


def apart(found: Array, exact: Array) -> float:
    """Largest relative difference, value by value."""
    return float(np.abs(found / exact - 1.0).max())


def heads(database: Database) -> tuple[Array, Array, Array]:
    """Displacement and slope of the head and largest |moment|, of every step but step 0."""
    tube = database.foundation("F1")
    y = tube.read_tube(1, "displacement_x")[1:, 0]
    slope = -tube.read_tube(1, "rotation_y")[1:, 0]
    moment = np.abs(tube.read_tube(1, "moment_y")[1:]).max(axis=1)
    return y, slope, moment


def in_steps(name: str, factors: Array) -> str:
    """Rows of *QUASISTATIC after the step number of the first one."""
    return "\n".join(f"{i} {name} {f!r}" for i, f in enumerate(factors.tolist(), start=1))


def on_curves(
    ground: str, casing: str, actions: list[str], steps: str = "1", options: str = ""
) -> str:
    """A deck of a tube at elevation 0 in a ground of *GROUNDEPTH, curves and *GROUNDPROP."""
    held = f"*SUPPORT\n1 {casing.split()[1]} Z\n"
    return (
        f"*DEPTH\n0\n{ground}*CASING\n1 PILE\n{casing}\n*FONDATION\n1 1\n{held}"
        + "\n".join(actions)
        + f"\n*QUASISTATIC\n{steps}\n{options}*EXEC\n"
    )


def uniform(points: list[tuple[float, float]], depth: float) -> str:
    """Ground with one p-y user curve through (P, y)."""
    return f"*GROUNDEPTH\n0 {-depth!r}\n{curve(1, points)}*GROUNDPROP\n1 0 1 0\n"


def curve(id_: int, points: list[tuple[float, float]]) -> str:
    """A p-y user curve through (P, y)."""
    return f"*PYCURVE\n{id_} 0 0\n" + "".join(f"{p!r} {y!r}\n" for p, y in points)


def cf08() -> StaticCase:
    """Friction of 100 kN/m that yields at 2 mm over a linear base, from the head to full slip."""
    given = rows("CF08_backbone.csv")
    friction, slope = 100e3 / pi, 50e6 / pi
    text = deck(
        title="elastic-plastic shaft",
        depths=[0, 25],
        moduli=[0, 0],
        axial=[1, 1],
        casing=["0 -25 1 0.1 200e9 7850 EI=1e9 EA=3e9"],
        actions=["*LOAD\nP 1 0 0 0 -1", "*SPRING\n1 -25 Z 80e6"],
        extra=f"*TZCURVE\n1 0\n0 {friction!r} 0 {slope!r}\n",
        steps=in_steps("P", column(given, "N_head_N")),
    )

    def compare(database: Database) -> Deviations:
        u = -database.foundation("F1").read_tube(1, "displacement_z")[1:]
        head, base = column(given, "u_head_m"), column(given, "u_base_m")
        return [
            Deviation("head", apart(u[:, 0], head), 2e-6),
            Deviation("base", float(np.abs((u[:, -1] - base) / head).max()), 2e-6),
        ]

    return StaticCase(text, compare)


def rigid_pile(ground: str, arm: float, load: float, steps: str = "1") -> str:
    """A rigid pile of 5 m under a load at a height above the ground."""
    casing = f"0 -5 1 0.1 200e9 7850 EI={RIGID!r} EA=1e9"
    return on_curves(ground, casing, [f"*LOAD\nP 1 0 {load!r} 0 0 0 {load * arm!r} 0"], steps)


def cf09(given: list[dict[str, str]], text: str, asked: float) -> StaticCase:
    """A rigid pile against displacement and rotation of its head.

    asked: more than what the little that it bends makes of them, 1e-5.
    """

    def compare(database: Database) -> Deviations:
        y, slope, _ = heads(database)
        return [
            Deviation("y", apart(y, column(given, "y0_m")), asked),
            Deviation("slope", apart(slope, column(given, "theta")), asked),
        ]

    return StaticCase(text, compare)


def cf09_elastic(soil: str, arm: float) -> StaticCase:
    """A rigid pile in k = 10 MN/m2, or in k = nh z with nh = 4 MN/m3, under 100 kN."""
    linear = curve(1, [(20e6 * REACH, REACH)])
    ground = {
        "uniform": uniform([(10e6 * REACH, REACH)], 5.0),
        "nh z": f"*GROUNDEPTH\n0 -5\n{linear}*GROUNDPROP\n0 0 1 0\n",
    }[soil]
    every = [r for r in rows("CF09_elastic.csv") if float(r["e_m"]) == arm]
    given = [r for r in every if soil.split()[0] in r["soil"]]
    return cf09(given, rigid_pile(ground, arm, 100e3), 2e-5)


def cf09_elastic_plastic(arm: float) -> StaticCase:
    """A rigid pile in soil that yields at 200 kN/m, up to 0.99 of its capacity."""
    given = [r for r in rows("CF09_elastic_plastic.csv") if float(r["e_m"]) == arm]
    ground = uniform([(200e3, 0.02)], 5.0)
    text = rigid_pile(ground, arm, 1.0, in_steps("P", column(given, "H_N")))
    return cf09(given, text, 1e-4)


def pushing(modulus: float, depth: float) -> str:
    """Ground that resists positive displacements alone."""
    return uniform([(0.0, -REACH), (modulus * REACH, REACH)], depth)


def cf28_rigid() -> StaticCase:
    """A rigid strip of 2 m under 40/3 N at its quarter lifts off beyond 1.5 m."""
    given = rows("CF28_rigid_profile.csv")
    casing = "0 -2 1 0.1 200e9 7850 EI=1e9 EA=1e9"  # k L^4 / EI is 8e-5
    load = f"*LOAD\nP 1 -0.5 {40.0 / 3.0!r} 0 0"

    def compare(database: Database) -> Deviations:
        profile = Profile(database)
        y = np.interp(column(given, "y_m"), profile.depth, profile.y)
        return [Deviation("y", error(y, -column(given, "u_up_m")), 1e-3)]

    return StaticCase(on_curves(pushing(5e3, 2.0), casing, [load]), compare)


def cf28_flexible() -> StaticCase:
    """An infinite beam under a point load, half of it: contact ends at pi/2 over beta."""
    given, stiffness, modulus = rows("CF28_flexible.csv"), 50e6, 8e6
    length = 7.024814731040726
    casing = f"0 {-length!r} 1 0.1 200e9 7850 EI={stiffness!r} EA=1e9"
    actions = ["*LOAD\nP 1 0 200e3 0 0", "*SUPPORT\n1 0 RY"]

    def compare(database: Database) -> Deviations:
        profile, x = Profile(database), column(given, "x_m")
        pressed = np.where(profile.y > 0.0, modulus, 0.0)
        found = profile.lateral(x, pressed, stiffness)
        names = ("y_m", "theta_rad", "M_Nm", "V_N")
        # the sign of moments there is that of a head that turns like H above it
        exact = [column(given, n) for n in names]
        return [
            Deviation(n.split("_")[0], error(f, e), 1e-4)
            for n, f, e in zip(names, found, exact, strict=True)
        ]

    return StaticCase(on_curves(pushing(modulus, length), casing, actions), compare)


def square_root(factor: float) -> list[tuple[float, float]]:
    """Points of P = factor sqrt(y) up to 2 m, within 0.5 / ROWS^2 of the largest P."""
    y = 2.0 * (np.arange(1, ROWS + 1) / ROWS) ** 4
    return list(zip((factor * np.sqrt(y)).tolist(), y.tolist(), strict=True))


def cf29(kind: str) -> StaticCase:
    """1000 kN on a pile of 20 m, 1 m of it free, p = 1000 sqrt(y) (C) or 1000 z sqrt(y) (S), kN/m.

    The square root is a user curve of many rows; times z it is one curve at 19 m and none at 0.
    """
    width, depth = 0.5, 19.0
    if kind == "C":
        ground = uniform(square_root(1e6 / width), depth)
    else:
        rows_below = curve(1, square_root(depth * 1e6 / width))
        ground = f"*GROUNDEPTH\n0 {-depth!r}\n{rows_below}*GROUNDPROP\n0 0 1 0\n"
    given = [r for r in rows("CF29_results.csv") if r["case"].startswith(kind)]
    casing = f"1 {-depth!r} {width!r} 0.1 200e9 7850 EI=10e6 EA=1e9"

    def compare(database: Database) -> Deviations:
        profile = Profile(database)
        at_ground = int(np.argmin(np.abs(profile.depth)))
        found = {
            "y_top_m": profile.y[0],
            "y_ground_m": profile.y[at_ground],
            "theta_top": profile.slope[0],
            "theta_ground": profile.slope[at_ground],
            "M_max": np.abs(profile.moment).max(),
        }
        printed = [
            abs(np.log10(abs(found[r["quantity"]]) * scale) - float(r["printed_log10_kN_m"]))
            for r in given
            for scale in [1e-3 if r["quantity"] == "M_max" else 1.0]
        ]
        own = [abs(found[r["quantity"]] / float(r["value_SI"]) - 1.0) for r in given]
        return [
            Deviation("log10, printed", float(max(printed)), 1.5e-4),
            Deviation("converged", float(max(own)), 1e-4),
        ]

    return StaticCase(on_curves(ground, casing, ["*LOAD\nP 1 1 1e6 0 0"], "5"), compare)


STATIC_CASES: dict[str, StaticCase] = {
    "CF08 backbone": cf08(),
    **{
        f"CF09 elastic {soil} e {arm:g}": cf09_elastic(soil, arm)
        for soil in ("uniform", "nh z")
        for arm in (0.0, 1.0, 2.5, 5.0)
    },
    **{f"CF09 elastic-plastic e {arm:g}": cf09_elastic_plastic(arm) for arm in (0.0, 2.5)},
    "CF28 rigid": cf28_rigid(),
    "CF28 flexible": cf28_flexible(),
    "CF29 C": cf29("C"),
    "CF29 S": cf29("S"),
}
