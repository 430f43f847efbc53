"""`podeep-solve check` tells in words what was understood of motion."""

from pathlib import Path

import pytest

from podeep.cli.solve import main

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
EVERYTHING = """*DYNAMIC
5 65 0.05 7 1
*DYNIMP
50 0.6 0.4 1
*NEWTONDYN
40 0.02
*DTREC
0.5
*DAMPING ALPHA=0.1 BETA=2e-3
*MASS
1 -58 350e3 0 4e6 0
1 -50 20
*STIFFNESS
1 -60 4e9 -6e10 9e11
*RADIATION
1 4e5
*INITIAL
1 -58 X 0.05 -0.2
1 -58 RY 0 90
*HARMONIC
STORM 12.5 90 25
WEIGHT 4 0
*TIMESERIES PUSH
0 -1
2.5 1.5
*MODEL HYSTERESIS=MASING
*EXEC"""
MODEL = "*MODEL ELEMENTS=20 ORDER=5\n"


def checked(folder: Path, capsys: pytest.CaptureFixture[str], more: str, text: str = BASE) -> str:
    """The report on the base deck with more keywords, each fact on one line."""
    path = folder / "a.deck"
    path.write_text(text.replace("*EXEC", more), encoding="utf-8")
    assert main(["check", str(path)]) == 0
    return capsys.readouterr().out.replace("\n      ", " ")


def section(report: str, name: str) -> list[str]:
    lines = report.partition(f"\n{name}\n")[2].partition("\n\n")[0].splitlines()
    return [line.strip() for line in lines]


def test_everything_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = BASE.replace(MODEL, "").replace("3 2 3 2", "3 2 3 2 1e8 2")
    report = checked(tmp_path, capsys, EVERYTHING, text)
    assert section(report, "motion") == [
        "from 5 to 65 s",
        "method Newmark with gamma 0.6 and beta 0.4",
        "step 0.05 s at first, following the error",
        "at most 40 iterations a step, balanced to 0.02 or better",
        "a record each 0.5 s",
        "force of the soil: the static curve, in statics and in motion",
        "STORM follows a sine of 12.5 s from 90 deg on, growing over 25 s",
        "WEIGHT follows a sine of 4 s from 0 deg on",
        "PUSH follows 2 rows from 0 to 2.5 s, factors -1 to 1.5",
        "tube 1 at -58 m: X starts at 0.05 m with -0.2 m/s",
        "tube 1 at -58 m: RY starts at 0 rad with 1.5708 rad/s",
        "damping 0.1 1/s of the mass and 0.002 s of the stiffness of the tubes",
    ]
    held = section(report, "held and loaded")
    assert "tube 1 at -58 m: mass 350000 kg, JYY 4e+06 kg m2" in held
    assert "tube 1 at -50 m: mass 20 kg, on a rigid arm of 8 m" in held
    spring = "spring of deflection and slope, 4e+09 N/m, -6e+10 N/rad, 9e+11 N m/rad"
    assert f"tube 1 at -60 m: {spring}" in held
    assert "p-y 1: dashpot 400000 N s/m2 per metre of width" in section(report, "soil")
    numerics = section(report, "numerics")
    assert "the soil remembers its motion (HYSTERESIS=MASING)" in numerics
    assert "ITEMAX of *NEWTONDYN holds in place of that of *DYNIMP" in section(report, "assumed")


@pytest.mark.parametrize(
    ("run", "lines"),
    [
        (
            "*DYNAMIC\n0 60",
            [
                "from 0 to 60 s",
                "method HHT with alpha = -0.05 (default)",
                "step as the accuracy asks for (default)",
                "at most 30 iterations a step, balanced to 0.1 or better",
                "a record each step or thousandth of the run, whichever is longer (default)",
                "force of the soil: the static force at the end of the steps, and the dynamic "
                "curve from there",
            ],
        ),
        ("*DYNAMIC\n0 60 METHOD=HHT", ["from 0 to 60 s", "method HHT with alpha = -0.05"]),
        ("*DYNAMIC\n0 60 METHOD=GALPHA", ["from 0 to 60 s", "method generalised alpha"]),
        ("*DYNAMIC\n0 60 METHOD=BATHE", ["from 0 to 60 s", "method Bathe's of two stages"]),
        ("*DYNAMIC\n0 60 METHOD=ROS2", ["from 0 to 60 s", "method Rosenbrock's of two stages"]),
        (
            "*DYNAMIC\n0 60 METHOD=CENTRAL",
            ["from 0 to 60 s", "method explicit central differences"],
        ),
        (
            "*DYNAMIC\n0 60 METHOD=CONSERVE",
            [
                "from 0 to 60 s",
                "method trapezoidal with the mean force of a step, which keeps energy",
            ],
        ),
        (
            "*DYNAMIC\n0 60 0.1 METHOD=NEWMARK",
            ["from 0 to 60 s", "method Newmark with gamma 0.5 and beta 0.25", "step 0.1 s"],
        ),
    ],
)
def test_the_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], run: str, lines: list[str]
) -> None:
    report = checked(tmp_path, capsys, f"{run}\n*EXEC")
    assert section(report, "motion")[: len(lines)] == lines


def test_statics_have_no_motion(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = checked(tmp_path, capsys, "*EXEC")
    assert "\nmotion\n" not in report
    assert "remembers" not in report


def test_one_row_is_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = checked(tmp_path, capsys, "*DYNAMIC\n0 60\n*TIMESERIES PUSH\n3 2\n*EXEC")
    assert "PUSH follows 1 row from 3 to 3 s, factors 2 to 2" in section(report, "motion")
