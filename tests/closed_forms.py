"""Closed forms on linear soil: each case has a deck and tells the relative errors of a solution.

Named after their source: Hetenyi (1946) for the infinite (CF01) and semi-infinite (CF02) beam,
Matlock and Reese (1960) for k = nh z (CF04), an exact chain of segments for layers and a step of
stiffness (CF05), Randolph and Wroth (1978) for the axial pile (CF06). Errors are those of the head
and, over all depths of the case, of displacement, slope, moment (or normal force) and shear, each
as a share of its largest value.
"""

import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from decks import deck, solved
from podeep.arrays import Array
from podeep.database.read import Database

DATA = Path(__file__).parent / "data" / "valid"
Errors = dict[str, float]
Table = Mapping[str, Array]


def table(name: str, case: str | None = None) -> dict[str, Array]:
    with (DATA / name).open(encoding="utf-8") as file:
        rows = [r for r in csv.DictReader(file) if case is None or r["case"] == case]
    return {k: np.array([float(r[k]) for r in rows]) for k in rows[0] if k != "case"}


@dataclass(frozen=True)
class ClosedForm:
    """A deck, and the errors of a solved one."""

    text: str
    compare: Callable[["Profile"], Errors]

    def errors(self, how: str, folder: Path) -> Errors:
        """Run the deck with one more line, `*ACCURACY 1e-6` for instance, and compare."""
        return self.compare(Profile(solved(folder, f"{how}\n{self.text}")))


class Profile:
    """The last step of a planar tube over depth (positive down), in the conventions of the cases.

    Of the two depths of a jump the upper one is kept.
    """

    def __init__(self, database: Database, igr: int = 1) -> None:
        data = database.foundation("F1")
        depth = data.mudline - data.elevations[igr]
        keep = np.diff(depth, prepend=-np.inf) > 2e-6
        self.depth = depth[keep]

        def last(name: str) -> Array:
            return data.read_tube(igr, name, -1)[0][keep]

        self.y, self.slope = last("displacement_x"), -last("rotation_y")
        self.moment, self.shear = last("moment_y"), last("shear_x")
        self.settlement, self.normal = -last("displacement_z"), last("normal_force")

    def lateral(self, z: Array, modulus: Array, stiffness: float) -> tuple[Array, ...]:
        """Displacement, slope, moment and shear at z, each interpolated with its derivative."""
        chain = (self.y, self.slope, self.moment / stiffness, self.shear / stiffness)
        ends = (*chain[1:], -modulus * self.y / stiffness)
        found = [
            CubicHermiteSpline(self.depth, values, slopes)(z)
            for values, slopes in zip(chain, ends, strict=True)
        ]
        return found[0], found[1], stiffness * found[2], stiffness * found[3]


def error(found: Array, exact: Array) -> float:
    return float(np.abs(found - exact).max() / np.abs(exact).max())


def errors(profile: Profile, z: Array, exact: Table, modulus: Array, stiffness: float) -> Errors:
    """Errors against columns y, slope, moment and shear of a case."""
    found = profile.lateral(z, modulus, stiffness)
    names = ("y", "slope", "moment", "shear")
    profiles = {n: error(f, exact[n]) for n, f in zip(names, found, strict=True)}
    return {"head": abs(profile.y[0] / exact["y"][0] - 1.0) if exact["y"][0] else 0.0, **profiles}


RAIL_EI, RAIL_K = 7.38e6, 14e6


def cf01(kind: str) -> ClosedForm:
    """A rail on springs, half model of 20 m; the case counts moments sagging positive."""
    row = f"0 -20 1 0.1 200e9 7850 EI={RAIL_EI!r} EA=1e9"
    load = {"load": "*SUPPORT\n1 0 RY\n*LOAD\nP 1 0 85e3 0 0"}
    load["moment"] = "*SUPPORT\n1 0 X\n*LOAD\nP 1 0 0 0 0 0 25e3 0"
    text = deck(
        title="rail",
        depths=[0, 20],
        moduli=[RAIL_K, RAIL_K],
        casing=[row],
        actions=[load[kind]],
    )
    given = table(f"CF01_point_{kind}.csv")
    moment, shear = given.get("M_sagging_Nm", given.get("M_Nm")), given["Q_N"]
    # pushed aside the rail moves like the case; turned, it moves against it
    motion, force = (1.0, -1.0) if kind == "load" else (-1.0, 1.0)
    assert moment is not None
    exact = {
        "y": motion * given["y_m"],
        "slope": motion * given["slope_rad"],
        "moment": force * moment,
        "shear": force * shear,
    }

    def compare(profile: Profile) -> Errors:
        modulus = np.full(len(profile.depth), RAIL_K)
        found = errors(profile, given["x_m"], exact, modulus, RAIL_EI)
        if kind == "moment":
            found["head"] = abs(profile.slope[0] / exact["slope"][0] - 1.0)
        return found

    return ClosedForm(text, compare)


CHANG_EI, CHANG_K = 5.014e7, 2.25e6
CF02_HEADS = {
    "free_H": ["*LOAD\nP 1 0 10e3 0 0"],
    "free_M": ["*LOAD\nP 1 0 0 0 0 0 20e3 0"],
    "free_H_and_M": ["*LOAD\nP 1 0 10e3 0 0 0 10e3 0"],
    "fixed_head": ["*LOAD\nP 1 0 10e3 0 0", "*SUPPORT\n1 0 RY"],
    "rot_spring_20MNm_per_rad": ["*LOAD\nP 1 0 10e3 0 0", "*SPRING\n1 0 RY 20e6"],
}


def chang(top: float, actions: list[str]) -> str:
    """45 m stand in for the semi-infinite pile; a tip nearer to 19 m is felt by the profiles."""
    row = f"{top:g} -45 1 0.1 200e9 7850 EI={CHANG_EI!r} EA=1e9"
    moduli = [CHANG_K, CHANG_K]
    return deck(title="Chang", depths=[0, 45], moduli=moduli, casing=[row], actions=actions)


def cf02(head: str) -> ClosedForm:
    """A semi-infinite pile with one of five heads at the mudline."""
    given = table("CF02_heads.csv", head)
    exact = {
        "y": given["y_m"],
        "slope": given["theta_rad"],
        "moment": given["M_Nm"],
        "shear": given["V_N"],
    }

    def compare(profile: Profile) -> Errors:
        modulus = np.full(len(profile.depth), CHANG_K)
        return errors(profile, given["z_m"], exact, modulus, CHANG_EI)

    return ClosedForm(chang(0.0, CF02_HEADS[head]), compare)


def cf02_stick_up() -> ClosedForm:
    """The same pile loaded 1 m above ground: the free part."""
    given = table("CF02_stickup.csv")

    def compare(profile: Profile) -> Errors:
        spline = CubicHermiteSpline(profile.depth, profile.y, profile.slope)
        found = spline(given["x_m_above_ground_negative"])
        head = abs(profile.y[0] / given["y_m"][0] - 1.0)
        return {"head": head, "y": error(found, given["y_m"])}

    return ClosedForm(chang(1.0, ["*LOAD\nP 1 1 10e3 0 0"]), compare)


CF04_NH, CF04_EI = 5e6, 80e6
CF04_T = (CF04_EI / CF04_NH) ** 0.2


def cf04(length: float, head: str) -> ClosedForm:
    """k = nh z: force (A), moment (B) or force on a fixed head (F); length in multiples of T."""
    every, T = table("CF04_profiles.csv"), CF04_T
    given = {k: v[every["Zmax"] == length] for k, v in every.items()}
    load = {"A": "1e3 0 0", "B": "0 0 0 0 1e3 0", "F": "1e3 0 0"}[head]
    actions = [f"*LOAD\nP 1 0 {load}", *(["*SUPPORT\n1 0 RY"] if head == "F" else [])]
    tip = length * T
    row = f"0 {-tip!r} 1 0.1 200e9 7850 EI={CF04_EI!r} EA=1e9"
    moduli = [0, CF04_NH * tip]
    text = deck(title="nh z", depths=[0, tip], moduli=moduli, casing=[row], actions=actions)
    unit = 1e3 if head != "B" else 1e3 / T  # force that the coefficients multiply
    exact = {
        "y": given[head + "y"] * unit * T**3 / CF04_EI,
        "slope": given[head + "s"] * unit * T**2 / CF04_EI,
        "moment": given[head + "m"] * unit * T,
        "shear": given[head + "v"] * unit,
    }

    def compare(profile: Profile) -> Errors:
        return errors(profile, given["Z"] * T, exact, CF04_NH * profile.depth, CF04_EI)

    return ClosedForm(text, compare)


CF05_LOADS = {
    "H100kN_free": ["*LOAD\nP 1 2 100e3 0 0"],
    "M200kNm_free": ["*LOAD\nP 1 2 0 0 0 0 200e3 0"],
    "H100kN_fixedhead": ["*LOAD\nP 1 2 100e3 0 0", "*SUPPORT\n1 2 RY"],
}


def cf05(load: str) -> ClosedForm:
    """A stick-up of 2 m, three layers, a step of stiffness; the grid holds the case's depths."""
    rows = [
        "2 -3 1 0.1 200e9 7850 EI=300e6 EA=1e9",
        "-3 -18 1 0.1 200e9 7850 EI=180e6 EA=1e9",
    ]
    depths, moduli = [0, 3, 3, 8, 8, 18], [4e6, 4e6, 20e6, 20e6, 12e6, 12e6]
    actions = CF05_LOADS[load]
    text = deck(title="layers", depths=depths, moduli=moduli, casing=rows, actions=actions)
    given = table("CF05_profiles.csv", load)
    depth = given["z_from_head_m"] - 2.0

    def compare(profile: Profile) -> Errors:
        at = np.searchsorted(profile.depth, depth - 1e-9)
        np.testing.assert_allclose(profile.depth[at], depth, atol=1e-9)
        return {
            "head": abs(profile.y[0] / given["y_m"][0] - 1.0),
            "y": error(profile.y[at], given["y_m"]),
            "slope": error(profile.slope[at], given["theta"]),
            "moment": error(profile.moment[at], given["M_Nm"]),
            "shear": error(profile.shear[at], given["V_N"]),
        }

    return ClosedForm(text, compare)


CF06_BASES = {
    "floating_Kb0": [],
    "Kb_50MN_per_m": ["*SPRING\n1 -25 Z 50e6"],
    "Kb_500MN_per_m": ["*SPRING\n1 -25 Z 500e6"],
    "rigid_base": ["*SUPPORT\n1 -25 Z"],
}


def cf06(base: str) -> ClosedForm:
    """An elastic pile in linear t-z on one of four bases."""
    ea, kz = 3e9, 20e6
    shaft = f"*TZCURVE\n1 0\n0 1e12 0 {kz / np.pi!r}\n"
    text = deck(
        title="axial",
        depths=[0, 25],
        moduli=[0, 0],
        axial=[1, 1],
        casing=[f"0 -25 1 0.1 200e9 7850 EI=1e9 EA={ea!r}"],
        actions=["*LOAD\nP 1 0 0 0 -1e6", *CF06_BASES[base]],
        extra=shaft,
    )
    given = table("CF06_profiles.csv", base)

    def compare(profile: Profile) -> Errors:
        u = CubicHermiteSpline(profile.depth, profile.settlement, -profile.normal / ea)
        n = CubicHermiteSpline(profile.depth, profile.normal, -kz * profile.settlement)
        return {
            "head": abs(profile.settlement[0] / given["u_m"][0] - 1.0),
            "y": error(u(given["z_m"]), given["u_m"]),
            "moment": error(n(given["z_m"]), given["N_N"]),
        }

    return ClosedForm(text, compare)


CASES: dict[str, ClosedForm] = {
    **{f"CF01 point {kind}": cf01(kind) for kind in ("load", "moment")},
    **{f"CF02 {head}": cf02(head) for head in CF02_HEADS},
    "CF02 stick-up": cf02_stick_up(),
    **{
        f"CF04 Zmax {length:g} {head}": cf04(length, head)
        for length in (2.0, 3.0, 4.0, 5.0, 10.0)
        for head in "ABF"
    },
    **{f"CF05 {load}": cf05(load) for load in CF05_LOADS},
    **{f"CF06 {base}": cf06(base) for base in CF06_BASES},
}
