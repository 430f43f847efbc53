"""podeep-solve as a user runs it: outputs, exit codes, databases that survive."""

import csv
import io
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray

from podeep.cli.podeep import main as podeep
from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.errors import ExitCode
from podeep.solve import analysis, statics

ROOT = Path(__file__).parents[1]
SAMPLES = ROOT / "sample_dbs"
NAMES = ("jacket_pile", "oc3_monopile", "opensees_pile")


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    return Path(shutil.copy(SAMPLES / "jacket_pile.deck", tmp_path))


def changed(deck: Path, before: str, after: str) -> Path:
    text = deck.read_text(encoding="utf-8")
    assert before in text
    deck.write_text(text.replace(before, after), encoding="utf-8")
    return deck


@pytest.mark.parametrize("name", NAMES)
def test_sample_databases_are_what_their_decks_make(name: str, tmp_path: Path) -> None:
    """Values to 1e-9 of the largest; the last digits are the processor's business."""
    assert main(["run", str(SAMPLES / f"{name}.deck"), "-o", str(tmp_path), "-q"]) == 0
    with (
        open_database(SAMPLES / f"{name}.dss") as kept,
        open_database(tmp_path / f"{name}.dss") as made,
    ):
        assert kept.deck_text == made.deck_text
        assert kept.status == made.status == "complete"
        for foundation in kept.foundations:
            old, new = kept.foundation(foundation), made.foundation(foundation)
            np.testing.assert_allclose(new.depth, old.depth, atol=1e-9)
            for quantity in old.datasets:
                if quantity.startswith(("estimate", "convergence")) or quantity == "load":
                    continue
                before, after = old.read(quantity), new.read(quantity)
                np.testing.assert_allclose(after, before, atol=1e-9 * np.abs(before).max())


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_opens_every_group_of_a_sample(name: str, engine: str) -> None:
    path = SAMPLES / f"{name}.dss"
    with xarray.open_datatree(path, engine=engine) as tree:
        groups = {node.path for node in tree.subtree}
        assert {"/F1", "/F1/estimate", "/F1/convergence", "/F1/envelope", "/F1/tubes/1"} <= groups
        pile = tree["F1"]
        assert pile["lateral_displacement"].dims == ("step", "depth")
        assert pile["depth"].attrs["positive"] == "down"
        assert pile["lateral_force"].attrs["units"] == "N m-1"
        assert np.isfinite(pile["lateral_force"].values).all()


@pytest.mark.parametrize("name", NAMES)
def test_netcdf4_opens_every_group_of_a_sample(name: str) -> None:
    def walk(group: netCDF4.Group) -> int:
        for variable in group.variables.values():
            assert np.shape(variable[...]) == variable.shape
        return len(group.variables) + sum(walk(inner) for inner in group.groups.values())

    with netCDF4.Dataset(SAMPLES / f"{name}.dss") as database:
        assert walk(database) > 40


def test_the_monopile_moves_as_its_springs_say() -> None:
    """OC3 phase II, linear between the 1 m points: 22.5224459 mm and 2.40506893 mrad, to 1e-6."""
    with open_database(SAMPLES / "oc3_monopile.dss") as database:
        data = database.foundation("F1")
        assert data.read("lateral_displacement", -1)[0, 0] == pytest.approx(
            0.0225224458575252, rel=1e-6
        )
        assert -data.read("lateral_slope", -1)[0, 0] == pytest.approx(0.00240506893070606, rel=1e-6)


def test_the_opensees_pile_moves_as_opensees_says() -> None:
    """PR01: 0.468638688 m, 0.084524407 rad, 15954.16 kN m; springs spread: within 1 %."""
    with open_database(SAMPLES / "opensees_pile.dss") as database:
        data = database.foundation("F1")
        head = data.read_tube(1, "displacement_x", -1)[0, 0]
        slope = data.read_tube(1, "rotation_y", -1)[0, 0]
        moment = np.abs(data.read_tube(1, "moment_y", -1)).max()
    assert head == pytest.approx(0.468638688, rel=1e-2)
    assert slope == pytest.approx(0.084524407, rel=1e-2)
    assert moment == pytest.approx(15954.16e3, rel=1e-2)


def test_opensees_pile_profile() -> None:
    """Displacement over depth at 3.5 MN within 1 % of its largest value."""
    with (ROOT / "tests/data/valid/PR01_profile.csv").open(encoding="utf-8") as file:
        rows = [r for r in csv.DictReader(file) if float(r["z_below_ground_m"]) >= 0.0]
    depth = np.array([float(r["z_below_ground_m"]) for r in rows])
    exact = np.array([float(r["y_m"]) for r in rows])
    with open_database(SAMPLES / "opensees_pile.dss") as database:
        data = database.foundation("F1")
        found = np.interp(depth, data.depth, data.read("lateral_displacement", -1)[0])
    assert np.abs(found - exact).max() < 0.01 * exact.max()


def test_run_reports_in_words_and_as_json(
    deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(deck), "-o", str(tmp_path / "out")]) == 0
    words = capsys.readouterr()
    assert "planar: all loads share the plane at 0 degrees from x" in words.out
    assert words.err == ""
    assert main(["run", str(deck), "-o", str(tmp_path / "out"), "--json", "--force"]) == 0
    report = json.loads(capsys.readouterr().out)
    (pile,) = report["foundations"]
    assert report["database"] == str(tmp_path / "out" / "jacket_pile.dss")
    assert pile["steps"] == 6
    assert pile["largest_estimated_error"] <= 1e-3
    assert main(["run", str(deck), "-o", str(tmp_path / "out"), "-q", "--force"]) == 0
    assert capsys.readouterr().out == ""
    assert main(["run", str(deck), "-o", str(tmp_path / "out"), "-v", "--force"]) == 0
    assert "smallest part" in capsys.readouterr().out


def test_a_second_run_leaves_the_first_database_untouched(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ["-o", str(deck.parent)]
    assert main(["run", str(deck), *out]) == 0
    database = deck.with_suffix(".dss")
    first = database.read_bytes()
    capsys.readouterr()
    assert main(["run", str(deck), *out]) == ExitCode.USAGE
    assert "--force" in capsys.readouterr().err
    assert database.read_bytes() == first
    assert main(["run", str(deck), *out, "--force"]) == 0
    assert database.read_bytes() == first  # the same input makes the same bytes


def test_a_foreign_file_is_never_replaced(deck: Path) -> None:
    foreign = deck.with_suffix(".dss")
    foreign.write_bytes(b"a simulation file of another program")
    assert main(["run", str(deck), "-o", str(deck.parent), "--force"]) == ExitCode.USAGE
    assert foreign.read_bytes() == b"a simulation file of another program"


def test_above_capacity_the_steps_below_are_written(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed(deck, "2.2e6  0   0", "90e6   0   0")
    assert main(["run", str(deck), "-o", str(deck.parent), "-q"]) == ExitCode.FAILED
    message = capsys.readouterr().err
    assert "no lateral equilibrium" in message
    assert "fully mobilised" in message
    assert "jacket_pile.dss" in message
    with open_database(deck.with_suffix(".dss")) as database:
        assert database.status == "stopped"
        assert "no lateral equilibrium" in database.stop_reason
        steps = database.foundation("F1").axis
        assert 1 <= len(steps) < 7


def test_stop_checks_and_solves_nothing(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    changed(deck, "*EXEC", "*STOP")
    assert main(["run", str(deck), "-o", str(deck.parent)]) == 0
    assert "nothing solved" in capsys.readouterr().out
    assert not deck.with_suffix(".dss").exists()


def test_check_tells_the_scene(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(deck)]) == 0
    text = capsys.readouterr().out
    assert "50 m embedded" in text
    assert "(default)" in text
    assert max(len(line) for line in text.splitlines()) <= 80
    assert not deck.with_suffix(".dss").exists()


def test_curves_are_those_of_the_law(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Soft clay at the mudline of the jacket pile: pu = 3 su D, a quarter way at 0.1 y50: 0.23."""
    y50 = 2.5 * 0.02 * 2.134
    at = f"0,{0.1 * y50!r},{8 * y50!r}"
    assert main(["curves", str(deck), "--depth", "0", "--at", at, "--csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert list(rows[0]) == ["curve", "displacement", "reaction"]
    found = [float(r["reaction"]) for r in rows if r["curve"] == "py"]
    pu = 3.0 * 8e3 * 2.134
    np.testing.assert_allclose(found, [0.0, 0.23 * pu, pu], rtol=1e-12)
    assert {r["curve"] for r in rows} == {"py", "tz", "qz"}
    assert main(["curves", str(deck), "--depth", "20"]) == 0
    assert "friction angle 34 deg" in capsys.readouterr().out


def test_a_residual_varies_between_two_curves_like_any_parameter(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """0.9 at the mudline to 0.7 at 9 m: 0.8 of the peak is left at 4.5 m."""
    changed(deck, "*TZCURVE, SHAPE=2GEO\n1 0", "*TZCURVE, SHAPE=2GEO, RESIDUAL=0.9\n1 0")
    changed(deck, "*TZCURVE, SHAPE=2GEO\n2 0", "*TZCURVE, SHAPE=2GEO, RESIDUAL=0.7\n2 0")
    at = f"{0.01 * 2.134!r},{0.02 * 2.134!r},1"
    assert main(["curves", str(deck), "--depth", "4.5", "--at", at, "--csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    peak, left, still = (float(r["reaction"]) for r in rows if r["curve"] == "tz")
    assert left == pytest.approx(0.8 * peak, rel=1e-12)
    assert still == pytest.approx(left, rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--depth", "51"], "outside 0 to 50 m"),
        (["--depth", "-1"], "outside 0 to 50 m"),
        (["--depth", "5", "--foundation", "F2"], "the deck has F1"),
    ],
)
def test_curves_refuse_what_is_not_there(
    deck: Path, arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["curves", str(deck), *arguments]) == ExitCode.USAGE
    assert words in capsys.readouterr().err


def test_usage_errors_end_with_two(capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in ([], ["run"], ["fly"], ["run", "x.deck", "--accuracy", "3"]):
        with pytest.raises(SystemExit) as ending:
            main(arguments)
        assert ending.value.code == ExitCode.USAGE
    assert main(["run", "nowhere.deck"]) == ExitCode.USAGE
    assert "nowhere.deck" in capsys.readouterr().err


def test_keywords_are_listed_and_explained(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["keywords"]) == 0
    listed = capsys.readouterr().out
    assert main(["keywords", "pycurve"]) == 0
    explained = capsys.readouterr().out
    for text in (listed, explained):
        assert max(len(line) for line in text.splitlines()) <= 80
    assert "*GROUNDPROP" in listed
    assert "EPSC" in explained
    assert main(["keywords", "PYCURV"]) == ExitCode.USAGE
    assert "PYCURVE" in capsys.readouterr().err


def test_the_example_runs_from_the_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "first"
    assert main(["example", str(folder)]) == 0
    told = capsys.readouterr().out
    assert all(f"{name}\n" in told for name in ("jacket_pile.dss", "conductor_waves.dst"))
    assert told.count("next: podeep ") == 2
    for case in ("jacket_pile", "conductor_waves"):
        for name in (f"{case}.deck", f"{case}.answers"):
            assert (folder / name).read_bytes() == (SAMPLES / name).read_bytes()
    assert main(["example", str(folder)]) == ExitCode.USAGE
    monkeypatch.chdir(folder)
    for case, last in (("jacket_pile", "Snapshot"), ("conductor_waves", "Envelope")):
        assert podeep([case, "--answers", f"{case}.answers", "--no-plot"]) == 0
        assert f"Analysis    {last}" in capsys.readouterr().out


def test_an_accuracy_that_is_not_reached_is_told(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed(deck, "*EXEC", "*MODEL ELEMENTS=5 ORDER=3\n*EXEC")
    assert main(["run", str(deck), "-o", str(deck.parent), "-q"]) == 0
    assert "the accuracy asked, 0.001, was not reached" in capsys.readouterr().err


def test_an_interrupted_run_leaves_a_partial_that_opens(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = statics.steps

    def impatient(*arguments: Any) -> Iterator[statics.State]:
        for state in found(*arguments):
            yield state
            if state.step == 3:
                raise KeyboardInterrupt

    monkeypatch.setattr(analysis, "steps", impatient)
    assert main(["run", str(deck), "-o", str(deck.parent)]) == ExitCode.INTERRUPTED
    assert "3 of 6 steps are kept in" in capsys.readouterr().err
    assert not deck.with_suffix(".dss").exists()
    with open_database(deck.with_suffix(".dss.partial")) as database:
        assert database.status == "interrupted"
        assert len(database.foundation("F1").axis) == 4


def test_a_full_disk_behind_standard_output_is_no_bug(deck: Path) -> None:
    program = Path(sys.executable).with_name("podeep-solve")
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            [program, "check", str(deck)], stdout=full, stderr=subprocess.PIPE, check=False
        )
    assert done.returncode == ExitCode.USAGE
    assert b"No space left" in done.stderr
    assert b"bug" not in done.stderr


def test_a_deck_without_loads_stays_at_rest(deck: Path) -> None:
    text = deck.read_text(encoding="utf-8")
    start, end = text.index("C Head load"), text.index("*EXEC")
    deck.write_text(text[:start] + text[end:], encoding="utf-8")
    assert main(["run", str(deck), "-o", str(deck.parent), "-q"]) == 0
    with open_database(deck.with_suffix(".dss")) as database:
        assert not database.foundation("F1").read("lateral_displacement").any()


def test_a_null_character_is_a_fault_of_the_deck(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed(deck, "Jacket pile", "Jacket\0pile")
    assert main(["check", str(deck)]) == ExitCode.USAGE
    assert "null character" in capsys.readouterr().err


def test_an_imposed_rotation_is_in_degrees(deck: Path) -> None:
    """A head turned by half a degree against its springs has the slope of half a degree."""
    changed(deck, "STORM     1    -58.0  2.2e6  0   0       0   -4.5e6  0", "STORM 1 -58 1e5 0 0")
    changed(deck, "*QUASISTATIC", "*DISPLACE\nTURN 1 -58.0 RY 0.5\n*QUASISTATIC")
    changed(deck, "6 STORM 1.0", "6 STORM 1.0 TURN 1.0")
    assert main(["run", str(deck), "-o", str(deck.parent), "-q"]) == 0
    with open_database(deck.with_suffix(".dss")) as database:
        head = database.foundation("F1").read_tube(1, "rotation_y", -1)[0, 0]
    assert head == pytest.approx(np.radians(0.5), rel=1e-12)


def test_a_load_along_y_bends_about_x_by_the_right_hand(deck: Path) -> None:
    """FY at the head: it moves to +y, turns about -x, and the moment about x is -FY times arm."""
    changed(deck, "2.2e6  0   0       0   -4.5e6  0", "0  1e6   0       0   0  0")
    changed(deck, "*EXEC", "*MODEL, SMALL\n*EXEC")
    assert main(["run", str(deck), "-o", str(deck.parent), "-q"]) == 0
    with open_database(deck.with_suffix(".dss")) as database:
        data = database.foundation("F1")
        assert data.lateral_axis == 90.0
        elevation = data.elevations[1]
        free = elevation >= -60.0

        def last(name: str) -> np.ndarray:
            return data.read_tube(1, name, -1)[0]

        assert last("displacement_y")[0] > 0.0
        assert last("rotation_x")[0] < 0.0
        np.testing.assert_allclose(last("shear_y")[free], 1e6, rtol=1e-9)
        moment = -1e6 * (-58.0 - elevation[free])
        np.testing.assert_allclose(last("moment_x")[free], moment, rtol=1e-9, atol=1e-3)
        np.testing.assert_allclose(last("normal_force")[0], 12e6, rtol=1e-9)
        for name in ("displacement_x", "rotation_y", "shear_x", "moment_y"):
            assert np.abs(last(name)).max() < 1e-9 * np.abs(last("moment_x")).max()
        slope = np.gradient(last("displacement_y"), elevation)[1:20]
        np.testing.assert_allclose(last("rotation_x")[1:20], -slope, rtol=1e-2)
