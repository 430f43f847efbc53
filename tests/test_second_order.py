"""Normal force on a bent tube: CF13 (Hetenyi's beam-column on soil), statics, buckling."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from decks import deck, solved
from podeep.cli.solve import main
from podeep.scene import Numerics
from podeep.solve.analysis import solve
from scenes import reference_pile

DATA = Path(__file__).parent / "data" / "valid"
EI, K = 150e6, 12e6


def table(name):
    with (DATA / name).open() as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def column(force: float, load: str, held: str = "", *, asked: str = "PDELTA") -> str:
    """A pile of 40 m in soil of constant modulus under a constant normal force."""
    actions = [f"*LOAD\nDOWN 1 0 0 0 {-force!r}\nSIDE 1 0 {load}", f"*MODEL, {asked}"]
    return deck(
        title="CF13",
        depths=(0.0,),
        moduli=(K,),
        casing=[f"0 -40 1 0.02 210e9 7850 EI={EI!r}"],
        actions=[*([held] if held else []), *actions, "*ACCURACY\n1e-7"],
    )


ROWS = table("CF13_head.csv")
HEADS = {
    "force": ("100e3 0 0", "", ("y0_H_m", "theta0_H")),
    "moment": ("0 0 0 0 200e3 0", "", ("y0_M_m", "theta0_M")),
    "fixed": ("100e3 0 0", "*SUPPORT\n1 0 RY", ("y0_fixed_m", "M0_fixed_Nm")),
}


@pytest.mark.parametrize("row", ROWS, ids=lambda r: f"N {r['N_over_Ncr']:g}")
@pytest.mark.parametrize(("load", "held", "names"), HEADS.values(), ids=HEADS)
def test_heads_of_cf13(tmp_path, row, load, held, names):
    with solved(tmp_path, column(row["N_N"], load, held)) as database:
        tube = database.foundation("F1")
        y = tube.read_tube(1, "displacement_x", -1)[0, 0]
        if held:
            other = tube.read_tube(1, "moment_y", -1)[0, 0]
        else:
            other = -tube.read_tube(1, "rotation_y", -1)[0, 0]
    assert (y, other) == pytest.approx(tuple(row[n] for n in names), rel=1e-6)


def test_profile_of_cf13(tmp_path):
    given = {n: np.array([r[n] for r in table("CF13_profile_N0.3.csv")]) for n in ("z_m", "y_m")}
    exact = np.array([r["M_Nm"] for r in table("CF13_profile_N0.3.csv")])
    force = next(r["N_N"] for r in table("CF13_head.csv") if r["N_over_Ncr"] == 0.3)
    with solved(tmp_path, column(force, "100e3 0 0")) as database:
        tube = database.foundation("F1")
        depth = -tube.elevations[1]
        y = np.interp(given["z_m"], depth, tube.read_tube(1, "displacement_x", -1)[0])
        moment = np.interp(given["z_m"], depth, tube.read_tube(1, "moment_y", -1)[0])
    assert abs(y - given["y_m"]).max() < 1e-3 * abs(given["y_m"]).max()  # lines between points
    assert abs(moment - exact).max() < 1e-2 * abs(exact).max()


def test_a_column_beyond_half_the_critical_force_buckles(tmp_path, capsys):
    """A free end buckles at sqrt(k EI), whatever pushes it aside."""
    path = tmp_path / "column.deck"
    critical = float(np.sqrt(K * EI))
    for share, code in ((0.98, 0), (1.02, 1)):
        path.write_text(column(share * critical, "1e3 0 0"))
        assert main(["run", str(path), "-o", str(tmp_path), "-q", "--force"]) == code
    assert "the tube buckles" in capsys.readouterr().err


def pile(force, **model):
    scene = reference_pile(force, steps=4, numerics=Numerics(accuracy=1e-6, **model))
    return solve(scene, scene.foundations[0])


def test_the_moment_at_the_mudline_is_that_of_both_forces_about_it():
    one = pile((2e6, 0.0, -5e6), second_order=True).results
    at = np.array([-10.0, 0.0])
    y = one.deflection(at)[-1, 0]
    shear, moment = one.shear_and_moment(at)
    expected = 2e6 * 10.0 + 5e6 * (y[0] - y[1])
    assert moment[-1, 0, 1] == pytest.approx(expected, rel=1e-9)
    assert shear[-1, 0, 0] == pytest.approx(2e6, rel=1e-9)


def test_it_adds_to_the_deflection_and_tension_takes_away():
    heads = [
        pile((2e6, 0.0, vertical), second_order=asked).results.deflection(np.array([-10.0]))[-1]
        for vertical, asked in ((-5e6, False), (-5e6, True), (5e6, True))
    ]
    small, pressed, pulled = (float(h[0, 0]) for h in heads)
    assert 1.03 < pressed / small < 1.10  # some 5 %
    assert 0.92 < pulled / small < 0.98


def test_a_load_at_any_angle_has_the_same_resultant():
    straight = pile((2e6, 0.0, -5e6), second_order=True).results
    scene = reference_pile((1.2e6, 1.6e6, -5e6), 4, Numerics(accuracy=1e-6, second_order=True))
    load = scene.loads[0]
    beside = replace(load, name="NONE", force=(1e-9, -1e-9, 0.0))
    two = replace(
        scene,
        loads=(load, beside),
        steps=replace(
            scene.steps,
            names=("HEAD", "NONE"),
            factors=tuple((*f, 1.0) for f in scene.steps.factors),
        ),
    )
    turned = solve(two, two.foundations[0]).results
    assert turned.model.needs.components == 2
    at = np.array([-10.0, 0.0, 5.0])
    one, other = straight.deflection(at)[-1, 0], turned.deflection(at)[-1]
    np.testing.assert_allclose(np.hypot(*other), np.abs(one), rtol=1e-5)
    moments = np.hypot(*turned.shear_and_moment(at)[1][-1])
    np.testing.assert_allclose(
        moments, np.abs(straight.shear_and_moment(at)[1][-1, 0]), rtol=1e-5, atol=1e-3
    )


@pytest.mark.parametrize("forced", ["PDELTA, SMALL", "PDELTA SMALL"])
def test_both_words_exclude_each_other(tmp_path, capsys, forced):
    path = tmp_path / "a.deck"
    path.write_text(column(1e6, "1e3 0 0", asked=forced))
    assert main(["check", str(path)]) == 2
    assert "SMALL and PDELTA exclude each other" in capsys.readouterr().err


def test_the_report_tells_what_is_missed(tmp_path, capsys):
    path = tmp_path / "a.deck"
    text = column(2e7, "100e3 0 0").replace("*MODEL, PDELTA\n", "")
    path.write_text(text.replace("1e-7", "1e-3"))
    assert main(["run", str(path), "-o", str(tmp_path)]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "P-delta: the normal force adds some" in told
    path.write_text(text.replace("*ACCURACY", "*MODEL, SMALL\n*ACCURACY").replace("1e-7", "1e-3"))
    assert main(["run", str(path), "-o", str(tmp_path), "--force"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "no P-delta: the normal force would add some" in told


@pytest.mark.parametrize(("force", "steep"), [("1e6 0 0", False), ("5e6 0 0", True)])
def test_the_report_tells_of_steep_slopes(tmp_path, capsys, force, steep):
    path = tmp_path / "a.deck"
    path.write_text(column(1e6, force).replace("1e-7", "1e-3"))
    assert main(["run", str(path), "-o", str(tmp_path), "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["foundations"]
    missed = [d for d in told["decisions"] if d.startswith("no large rotations: a slope of 0.")]
    assert len(missed) == steep


def test_the_plane_may_be_forced(tmp_path, capsys):
    path = tmp_path / "a.deck"
    heads = []
    for words in ("PLANAR", "SPATIAL"):
        path.write_text(column(1e6, "1e5 0 0", asked=words))
        assert main(["run", str(path), "-o", str(tmp_path), "--force", "--json"]) == 0
        told = json.loads(capsys.readouterr().out)["foundations"][0]
        assert told["decisions"][0].startswith(words.lower())
        heads.append(told["head_lateral_displacement_m"])
    assert heads[1] == pytest.approx(heads[0], rel=1e-6)
    path.write_text(column(1e6, "1e5 0 0 1e5 0 0", asked="PLANAR"))
    assert main(["check", str(path)]) == 2
    assert "PLANAR, but its loads, supports and springs share no plane" in capsys.readouterr().err
    path.write_text(column(1e6, "1e5 0 0", asked="PLANAR, SPATIAL"))
    assert main(["check", str(path)]) == 2
    assert "PLANAR and SPATIAL exclude each other" in capsys.readouterr().err
