"""Closed forms on linear soil, run from decks and read back from the database.

Cases named after their source: Hetenyi (1946) for the infinite (CF01) and semi-infinite (CF02)
beam, Matlock and Reese (1960) for k = nh z (CF04), an exact chain of segments for layers and a
stiffness step (CF05), Randolph and Wroth (1978) for the axial pile (CF06). Heads to 1e-6, whole
profiles to 2e-6 of their largest value (CF04 1e-5), with at most 40 elements.
"""

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from decks import deck, solved
from podeep.arrays import Array
from podeep.database.read import Database, FoundationData

DATA = Path(__file__).parent / "data" / "valid"
HEAD, PROFILE = 1e-6, 2e-6


def table(name: str, case: str | None = None) -> Mapping[str, Array]:
    with (DATA / name).open(encoding="utf-8") as file:
        rows = [r for r in csv.DictReader(file) if case is None or r["case"] == case]
    return {k: np.array([float(r[k]) for r in rows]) for k in rows[0] if k != "case"}


class Profile:
    """The last step of a planar tube over depth (positive down), in the conventions of the cases.

    Displacement, slope and moment are interpolated with their stored derivatives, the shear with
    the soil's reaction.
    """

    def __init__(self, database: Database, igr: int = 1) -> None:
        data: FoundationData = database.foundation("F1")
        depth = data.mudline - data.tubes[igr]
        keep = np.concatenate([[True], np.diff(depth) > 2e-6])
        self.depth = depth[keep]

        def last(name: str) -> Array:
            return data.read_tube(igr, name, -1)[0][keep]

        self.y, self.slope = last("displacement_x"), -last("rotation_y")
        self.moment, self.shear = last("moment_y"), last("shear_x")
        self.settlement, self.normal = -last("displacement_z"), last("normal_force")

    def at(self, values: Array, slopes: Array, depth: Array) -> Array:
        return np.asarray(CubicHermiteSpline(self.depth, values, slopes)(depth))


def close(found: Array, exact: Array, tolerance: float) -> None:
    assert np.abs(found - exact).max() <= tolerance * np.abs(exact).max()


def lateral(
    profile: Profile,
    z: Array,
    exact: Mapping[str, Array],
    names: tuple[str, str, str, str],
    modulus: Array,
    tolerance: float = PROFILE,
    stiffness: float | Array = 1.0,
) -> None:
    """Compare displacement, slope, moment and shear; `modulus` is that of the soil on the grid."""
    y, slope, moment, shear = names
    curvature = profile.moment / stiffness
    close(profile.at(profile.y, profile.slope, z), exact[y], tolerance)
    close(profile.at(profile.slope, curvature, z), exact[slope], tolerance)
    close(profile.at(profile.moment, profile.shear, z), exact[moment], tolerance)
    reaction = -modulus * profile.y
    close(profile.at(profile.shear, reaction, z), exact[shear], tolerance)


# CF01: a rail, half model with a guided end

EI, K, BETA = 7.38e6, 14e6, 0.829856348282308


def rail(actions: list[str]) -> str:
    row = f"0 -20 1 0.1 200e9 7850 EI={EI!r} EA=1e9"
    return deck(title="rail", depths=[0, 20], moduli=[K, K], casing=[row], actions=actions)


@pytest.mark.parametrize("how", ["*ACCURACY 1e-7", "*MODEL ELEMENTS=40"])
def test_cf01_point_load(tmp_path: Path, how: str) -> None:
    load = "*LOAD\nP 1 0 85e3 0 0"
    database = solved(tmp_path, rail(["*SUPPORT\n1 0 RY", load, how]))
    profile, exact = Profile(database), table("CF01_point_load.csv")
    assert profile.y[0] == pytest.approx(0.00503841354314259, rel=HEAD)
    assert profile.moment[0] == pytest.approx(-51213.6830524576, rel=HEAD)
    exact = {**exact, "M_sagging_Nm": -exact["M_sagging_Nm"], "Q_N": -exact["Q_N"]}
    names = ("y_m", "slope_rad", "M_sagging_Nm", "Q_N")
    keep = exact["x_m"] <= 12.0
    exact = {k: v[keep] for k, v in exact.items()}
    modulus = np.full(len(profile.depth), K)
    lateral(profile, exact["x_m"], exact, names, modulus, stiffness=EI)


@pytest.mark.parametrize("how", ["*ACCURACY 1e-7", "*MODEL ELEMENTS=40"])
def test_cf01_point_moment(tmp_path: Path, how: str) -> None:
    actions = ["*SUPPORT\n1 0 X", "*LOAD\nP 1 0 0 0 0 0 25e3 0", how]
    profile = Profile(solved(tmp_path, rail(actions)))
    exact = dict(table("CF01_point_moment.csv"))
    assert profile.slope[0] == pytest.approx(-exact["slope_rad"][0], rel=HEAD)
    signed = {k: (v if k == "x_m" else -v) for k, v in exact.items()}
    signed["M_Nm"], signed["Q_N"] = exact["M_Nm"], exact["Q_N"]
    keep = signed["x_m"] <= 12.0
    signed = {k: v[keep] for k, v in signed.items()}
    names = ("y_m", "slope_rad", "M_Nm", "Q_N")
    lateral(profile, signed["x_m"], signed, names, np.full(len(profile.depth), K), stiffness=EI)


# CF02: semi-infinite pile, five kinds of head, and a stick-up of 1 m

CHANG, CHANG_K = 5.014e7, 2.25e6
CF02_NAMES = ("y_m", "theta_rad", "M_Nm", "V_N")
CF02_HEADS = {
    "free_H": ["*LOAD\nP 1 0 10e3 0 0"],
    "free_M": ["*LOAD\nP 1 0 0 0 0 0 20e3 0"],
    "free_H_and_M": ["*LOAD\nP 1 0 10e3 0 0 0 10e3 0"],
    "fixed_head": ["*LOAD\nP 1 0 10e3 0 0", "*SUPPORT\n1 0 RY"],
    "rot_spring_20MNm_per_rad": ["*LOAD\nP 1 0 10e3 0 0", "*SPRING\n1 0 RY 20e6"],
}


def chang(top: float, actions: list[str]) -> str:
    row = f"{top:g} -30 1 0.1 200e9 7850 EI={CHANG!r} EA=1e9"
    moduli = [CHANG_K, CHANG_K]
    return deck(title="Chang", depths=[0, 30], moduli=moduli, casing=[row], actions=actions)


@pytest.mark.parametrize("case", CF02_HEADS)
def test_cf02_heads(tmp_path: Path, case: str) -> None:
    actions = [*CF02_HEADS[case], "*ACCURACY 1e-7"]
    profile, exact = Profile(solved(tmp_path, chang(0.0, actions))), table("CF02_heads.csv", case)
    assert profile.y[0] == pytest.approx(exact["y_m"][0], rel=HEAD)
    modulus = np.full(len(profile.depth), CHANG_K)
    lateral(profile, exact["z_m"], exact, CF02_NAMES, modulus, stiffness=CHANG)


def test_cf02_stick_up(tmp_path: Path) -> None:
    """The case's own finite length of 19 m is off by 6e-6; 30 m stand in for the infinite pile."""
    actions = ["*LOAD\nP 1 1 10e3 0 0", "*MODEL ELEMENTS=40"]
    profile, exact = Profile(solved(tmp_path, chang(1.0, actions))), table("CF02_stickup.csv")
    x = exact["x_m_above_ground_negative"]
    assert profile.y[0] == pytest.approx(exact["y_m"][0], rel=HEAD)
    close(profile.at(profile.y, profile.slope, x), exact["y_m"], PROFILE)


# CF04: modulus nh z, in coefficients of T

NH, STIFF = 5e6, 80e6
T = (STIFF / NH) ** 0.2


@pytest.mark.parametrize("length", [2.0, 3.0, 4.0, 5.0, 10.0])
@pytest.mark.parametrize("head", ["A", "B", "F"])
def test_cf04_matlock_reese(tmp_path: Path, length: float, head: str) -> None:
    every = table("CF04_profiles.csv")
    exact = {k: v[every["Zmax"] == length] for k, v in every.items()}
    load = {"A": "1e3 0 0", "B": "0 0 0 0 1e3 0", "F": "1e3 0 0"}[head]
    actions = [f"*LOAD\nP 1 0 {load}", "*ACCURACY 1e-7"]
    actions += ["*SUPPORT\n1 0 RY"] if head == "F" else []
    tip = length * T
    row = f"0 {-tip!r} 1 0.1 200e9 7850 EI={STIFF!r} EA=1e9"
    text = deck(
        title="Matlock and Reese",
        depths=[0, tip],
        moduli=[0, NH * tip],
        casing=[row],
        actions=actions,
    )
    profile = Profile(solved(tmp_path, text))
    unit = 1e3 if head != "B" else 1e3 / T  # force that the coefficients multiply
    scaled = {
        "y": exact[head + "y"] * unit * T**3 / STIFF,
        "s": exact[head + "s"] * unit * T**2 / STIFF,
        "m": exact[head + "m"] * unit * T,
        "v": exact[head + "v"] * unit,
    }
    assert profile.y[0] == pytest.approx(scaled["y"][0], rel=HEAD)
    modulus, names = NH * profile.depth, ("y", "s", "m", "v")
    lateral(profile, exact["Z"] * T, scaled, names, modulus, tolerance=1e-5, stiffness=STIFF)


# CF05: stick-up, three layers, a step of stiffness

CF05_LOADS = {
    "H100kN_free": ["*LOAD\nP 1 2 100e3 0 0"],
    "M200kNm_free": ["*LOAD\nP 1 2 0 0 0 0 200e3 0"],
    "H100kN_fixedhead": ["*LOAD\nP 1 2 100e3 0 0", "*SUPPORT\n1 2 RY"],
}


@pytest.mark.parametrize("case", CF05_LOADS)
@pytest.mark.parametrize("how", ["*ACCURACY 1e-7", "*MODEL ELEMENTS=40"])
def test_cf05_layers_and_step(tmp_path: Path, case: str, how: str) -> None:
    rows = [
        "2 -3 1 0.1 200e9 7850 EI=300e6 EA=1e9",
        "-3 -18 1 0.1 200e9 7850 EI=180e6 EA=1e9",
    ]
    depths, moduli = [0, 3, 3, 8, 8, 18], [4e6, 4e6, 20e6, 20e6, 12e6, 12e6]
    actions = [*CF05_LOADS[case], how]
    text = deck(title="layers", depths=depths, moduli=moduli, casing=rows, actions=actions)
    database, exact = solved(tmp_path, text), table("CF05_profiles.csv", case)
    profile, depth = Profile(database), exact["z_from_head_m"] - 2.0
    names = ("y_m", "theta", "M_Nm", "V_N")
    assert profile.y[0] == pytest.approx(exact["y_m"][0], rel=HEAD)
    # grid depths hold every depth of the case, so nothing is interpolated across a step
    at = np.searchsorted(profile.depth, depth - 1e-9)
    np.testing.assert_allclose(profile.depth[at], depth, atol=1e-9)
    for values, name in zip(
        (profile.y, profile.slope, profile.moment, profile.shear), names, strict=True
    ):
        close(values[at], exact[name], PROFILE)


# CF06: axial, four bases

CF06_BASES = {
    "floating_Kb0": [],
    "Kb_50MN_per_m": ["*SPRING\n1 -25 Z 50e6"],
    "Kb_500MN_per_m": ["*SPRING\n1 -25 Z 500e6"],
    "rigid_base": ["*SUPPORT\n1 -25 Z"],
}


@pytest.mark.parametrize("case", CF06_BASES)
def test_cf06_axial_elastic(tmp_path: Path, case: str) -> None:
    shaft = f"*TZCURVE\n1 0\n0 1e12 0 {20e6 / np.pi!r}\n"
    row = "0 -25 1 0.1 200e9 7850 EI=1e9 EA=3e9"
    actions = ["*LOAD\nP 1 0 0 0 -1e6", *CF06_BASES[case], "*ACCURACY 1e-7"]
    text = deck(
        title="axial",
        depths=[0, 25],
        moduli=[0, 0],
        axial=[1, 1],
        casing=[row],
        actions=actions,
        extra=shaft,
    )
    profile, exact = Profile(solved(tmp_path, text)), table("CF06_profiles.csv", case)
    strain = -profile.normal / 3e9
    assert profile.settlement[0] == pytest.approx(exact["u_m"][0], rel=HEAD)
    close(profile.at(profile.settlement, strain, exact["z_m"]), exact["u_m"], PROFILE)
    reaction = -20e6 * profile.settlement
    close(profile.at(profile.normal, reaction, exact["z_m"]), exact["N_N"], PROFILE)
