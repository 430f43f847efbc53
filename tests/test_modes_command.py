"""podeep-solve modes as a user runs it: table, data, picture, refusals."""

import csv
import io
import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from podeep.cli.solve import main
from podeep.errors import ExitCode

ROOT = Path(__file__).parents[1]
DECK = ROOT / "sample_dbs" / "jacket_pile.deck"
Run = Callable[..., tuple[str, str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Run `podeep-solve modes` and return what it printed, on standard output and error."""

    def command(*options: object, code: int = ExitCode.DONE) -> tuple[str, str]:
        assert main(["modes", *map(str, options)]) == code
        told = capsys.readouterr()
        return told.out, told.err

    return command


def test_the_manual_shows_what_the_command_prints(run: Run) -> None:
    page = (ROOT / "docs" / "modes.md").read_text(encoding="utf-8")
    shown = re.findall(r"```sh\npodeep-solve modes (.*?)\n```\n\n```text\n(.*?)```", page, re.S)
    assert len(shown) == 2
    for options, text in shown:
        deck, *rest = options.split()
        out, _ = run(ROOT / deck, *rest)
        assert without_errors(out) == without_errors(text)


def without_errors(text: str) -> str:
    """The report without its last column, which rounding has a part in."""
    return re.sub(r"  \de-\d\d$", "", text, flags=re.M)


def test_the_table_fits_a_terminal(run: Run) -> None:
    out, err = run(DECK, "-n", 7, "--step", 6, "--shapes")
    assert max(map(len, out.splitlines())) <= 80
    assert not err
    assert "about the state of step 6: 7 modes" in out
    assert out.count("depth (m)") == 1
    assert len(re.findall(r"^ *-?\d+\.\d+( +-?\d\.\d{5}){7}$", out, re.M)) == 41


def test_data_for_other_programs(run: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(run(DECK, "-n", 3, "--csv")[0])))
    data = json.loads(run(DECK, "-n", 3, "--json", "--shapes")[0])
    assert [row["kind"] for row in rows] == [mode["kind"] for mode in data["modes"]]
    for row, mode in zip(rows, data["modes"], strict=True):
        assert set(row) == set(mode) - {"shape"}
        assert float(row["frequency_Hz"]) == mode["frequency_Hz"] == 1.0 / mode["period_s"]
        assert float(row["participating_share"]) < 1.0
    shapes = list(csv.DictReader(io.StringIO(run(DECK, "-n", 3, "--csv", "--shapes")[0])))
    assert [float(row["depth_m"]) for row in shapes] == data["depths_m"][0]
    assert [float(row["mode_2"]) for row in shapes] == data["modes"][1]["shape"][0]
    assert max(float(row["mode_1"]) for row in shapes) == pytest.approx(1.0, abs=1e-3)


def test_pictures_have_the_same_bytes_again(run: Run, tmp_path: Path) -> None:
    out, err = run(DECK, "-n", 4, "-o", tmp_path)
    first = tmp_path / "jacket_pile_F1_modes.png"
    assert out.endswith(f"written: {first}\n")
    assert not err
    out, err = run(DECK, "-n", 4, "--csv", "-o", tmp_path)
    second = tmp_path / "jacket_pile_F1_modes_2.png"
    assert err == f"written: {second}\n"
    assert first.read_bytes() == second.read_bytes()
    assert first.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--step", 7), "there is no step 7; the deck has steps 0 to 6"),
        (("--step", -1), "there is no step -1"),
        (("--foundation", "F2"), "no foundation F2"),
    ],
)
def test_refusals(run: Run, options: tuple[object, ...], words: str) -> None:
    out, err = run(DECK, *options, code=ExitCode.USAGE)
    assert not out
    assert words in err


@pytest.mark.parametrize("options", [("-n", "0"), ("-n", "1.5"), ("--secant", "0"), ("-n", "999")])
def test_options_out_of_bounds(options: tuple[str, str], capsys: object) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["modes", str(DECK), *options])
    assert stop.value.code == 2


def test_accuracy_that_is_not_reached_is_told(run: Run, tmp_path: Path) -> None:
    coarse = tmp_path / "coarse.deck"
    coarse.write_text(f"*ACCURACY 1e-9\n*MODEL ELEMENTS=12\n{DECK.read_text()}")
    text = coarse.read_text()
    coarse.write_text(re.sub(r"^\*ACCURACY(?! 1e-9).*\n(?:[^*\n].*\n)*", "", text, flags=re.M))
    _, err = run(coarse, "-n", 2)
    assert "warning: F1: the accuracy asked, 1e-09, was not reached" in err


def test_a_stiff_column_on_mudline_springs_has_two_motions(run: Run, tmp_path: Path) -> None:
    """The mass on its arm and the coupled springs through a deck, against 2 by 2 matrices."""
    column = tmp_path / "column.deck"
    column.write_text(
        "*DEPTH\n-20\n*GROUNDEPTH\n0\n*GROUNDPROP\n0 0\n"
        "*CASING\n1 COLUMN\n30 -20.01 5 0.05 210e9 7850 EI=1e16 EA=1e14 MASS=1e-3\n"
        "*FONDATION\n1 1\n"
        "*SUPPORT\n1 -20 Z\n*MASS\n1 34 350e3 1e6 2.5e7 0\n"
        "*STIFFNESS\n1 -20 2.5748e9 2.25325e10 2.629123e11\n*MODEL PLANAR\n*STOP\n"
    )
    rows = list(csv.DictReader(io.StringIO(run(column, "-n", 2, "--csv")[0])))
    height, mass, turning = 54.0, 350e3, 2.5e7  # about y, as the deflection is along x
    inertia = np.array([[mass, -mass * height], [-mass * height, turning + mass * height**2]])
    stiffness = np.array([[2.5748e9, 2.25325e10], [2.25325e10, 2.629123e11]])
    exact = np.sqrt(eigh(stiffness, inertia)[0]) / (2.0 * np.pi)
    found = [float(row["frequency_Hz"]) for row in rows]
    assert found[0] == pytest.approx(exact[0], rel=1e-4)
    assert found[1] == pytest.approx(exact[1], rel=1e-2)  # the column bends a little
