"""The dynamic sample: what its deck makes, and what podeep reads off it."""

import csv
import os
import re
from io import StringIO
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

from podeep.cli.podeep import main as podeep
from podeep.cli.solve import main
from podeep.database.read import open_database

ROOT = Path(__file__).parents[1]
SAMPLES = ROOT / "sample_dbs"
PAGE = (ROOT / "docs" / "motion.md").read_text(encoding="utf-8")
DECK, DATABASE = (SAMPLES / f"conductor_waves.{ending}" for ending in ("deck", "dst"))


def test_the_sample_is_what_its_deck_makes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Values to 1e-5 of the largest: they have seven digits, and a step may end its iteration
    one turn earlier where a processor rounds otherwise. Statics to 1e-9. The page has the report.
    """
    assert main(["run", str(DECK), "-o", str(tmp_path)]) == 0
    (report,) = re.findall(r"^```text\n(Motion to .*?)^```", PAGE, re.M | re.S)
    assert capsys.readouterr().out.replace(str(tmp_path), "out").endswith(report)
    for ending, tolerance in (("dss", 1e-9), ("dst", 1e-5)):
        name = f"conductor_waves.{ending}"
        with open_database(SAMPLES / name) as kept, open_database(tmp_path / name) as made:
            assert kept.deck_text == made.deck_text == DECK.read_text(encoding="utf-8")
            assert kept.status == made.status == "complete"
            old, new = kept.foundation("F1"), made.foundation("F1")
            np.testing.assert_allclose(new.depth, old.depth, atol=1e-9)
            np.testing.assert_allclose(new.axis, old.axis, atol=1e-9)
            for quantity in old.datasets:
                if quantity.startswith(("estimate", "convergence")) or quantity == "load":
                    continue
                before, after = old.read(quantity), new.read(quantity)
                size = np.abs(before).max()
                np.testing.assert_allclose(after, before, atol=tolerance * size, err_msg=quantity)


def test_the_sample_is_small_and_its_times_are_round() -> None:
    assert DATABASE.stat().st_size < 900_000
    with open_database(DATABASE) as database:
        times = database.foundation("F1").axis
    assert times == pytest.approx(0.4 * np.arange(81), abs=1e-9)


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_opens_every_group(engine: str) -> None:
    with xarray.open_datatree(DATABASE, engine=engine) as tree:
        groups = {node.path for node in tree.subtree}
        assert {"/F1", "/F1/estimate", "/F1/convergence", "/F1/envelope", "/F1/tubes/1"} <= groups
        pile = tree["F1"]
        assert pile["lateral_displacement"].dims == ("time", "depth")
        assert pile["time"].attrs["units"] == "s"
        assert np.isfinite(pile["lateral_force"].values).all()


def shown(answers: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    """The numbers of each table that podeep shows for some answers, as arrays."""
    reader, writer = os.pipe()
    os.write(writer, answers.encode())
    os.close(writer)
    with open(reader, encoding="utf-8") as script:
        monkeypatch.setattr("sys.stdin", script)
        assert podeep([str(DATABASE), "--csv", "--no-plot"]) == 0
    tables = capsys.readouterr().out.split("# Database")[1:]
    return [
        np.array([row for row in csv.reader(StringIO(t)) if row[0][0].isdigit()], dtype=float)
        for t in tables
    ]


def test_podeep_shows_what_is_stored(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """At depths and times of the database; between two times the mean of both."""
    with h5py.File(DATABASE) as file:
        pile = file["F1"]
        depth, time = pile["depth"][:], pile["time"][:]
        moved, force = pile["lateral_displacement"][:], pile["lateral_force"][:]
    head, ten = (int(np.argmin(np.abs(depth - z))) for z in (0.0, 10.0))
    evolution, snapshots = shown(
        "h\nt\n1\n0 10 2\n5\nf\n2\n0 10 2\nb\n8 8.2 8.4\nq\n", monkeypatch, capsys
    )
    assert evolution[:, 0] == pytest.approx(time)
    assert evolution[:, 1:] == pytest.approx(moved[:, [head, ten]], abs=1e-9)
    before, after = force[20, [head, ten]], force[21, [head, ten]]
    expected = np.array([before, 0.5 * (before + after), after]).T
    assert snapshots[:, 1:] == pytest.approx(expected, abs=1e-6 * float(np.abs(force).max()))


def test_an_envelope_holds_every_time_and_knows_when(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is wider than the stored times show, as it has every step; its times are steps."""
    answers = "h\ne\n1\n0 10 5\n5\nt\n1\n0 10 5\nq\n"
    (_, low, low_at, high, high_at), evolution = (t.T for t in shown(answers, monkeypatch, capsys))
    rows = evolution[1:]
    reach = np.abs(rows).max()
    assert (low <= rows.min(axis=1) + 1e-6 * reach).all()
    assert (high >= rows.max(axis=1) - 1e-6 * reach).all()
    assert low[0] < rows.min(axis=1)[0]
    for when in (low_at, high_at):
        assert when / 0.05 == pytest.approx(np.round(when / 0.05), abs=1e-6)


def test_its_answers_show_all_three_analyses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = SAMPLES / "conductor_waves.answers"
    assert podeep([str(DATABASE), "--answers", str(script), "-o", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    kinds = [line.split()[-1] for line in out.splitlines() if line.startswith("Analysis ")]
    assert kinds == ["evolution", "Snapshot", "Envelope"]
    assert max(map(len, out.replace(str(tmp_path), "").splitlines())) <= 80
    assert len(list(tmp_path.glob("conductor_waves_dynamic_*.png"))) == 3
