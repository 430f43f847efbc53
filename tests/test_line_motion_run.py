"""Decks of lines in motion by the command: databases, resuming, what is told, limits of methods."""

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import shaken
from manual import DOCS
from podeep import motion_log
from podeep.cli.podeep import main as podeep
from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.errors import Interrupted
from podeep.run import run_deck

SAMPLE = DOCS.parent / "sample_dbs" / "riser_heaving.deck"
PIPE = """\
*TITLE
A pipe whose end is moved over the seabed
*DEPTH
-50
*LINE
3 PIPE
60 0.3 0.02 200e9 7850 6 CD=1
*END
3 1 0 0 -50 X Y Z
3 2 60 0 -50 X Y Z
*TYPCONTACT
0 3 3 0.5 0.7 5e4
*MOTION
3 2
{moved}
*DYNAMIC
0 {end} {step} {method}
*DTREC
{record}
*ACCURACY
{accuracy}
{more}
*EXEC
"""


def deck_in(folder: Path, moved: str, **values: object) -> Path:
    """The pipe as a deck of its own."""
    every = {"end": 4, "step": 0.1, "method": "", "record": 0.5, "accuracy": 1e-2, "more": ""}
    path = folder / "pipe.deck"
    path.write_text(PIPE.format(moved=moved, **(every | values)), encoding="utf-8")
    return path


LIFT = "Z 0.5 4 -90 2"


def test_the_database_holds_the_motion_and_its_touchdown(tmp_path):
    deck = deck_in(tmp_path, "Z 0.5 8 0 0\nX 0.02 8 0 0", end=3.2, record=0.4, step=0.05)
    done = run_deck(deck, tmp_path, force=False).motion
    assert done is not None
    assert done.steps == 64
    with open_database(tmp_path / "pipe.dst") as database:
        line = database.line("L3")
        time = line.read("time")
        height = line.read("line/position_z")[:, -1]
        touchdown = line.read("touchdown_distance")
        deepest = line.read("envelope/penetration_max")
        assert line.read("convergence/residual").max() < 1e-3
        assert np.all(line.read("line/effective_tension")[1:].max(axis=1) > 0.0)
    assert time == pytest.approx(np.arange(0.0, 3.21, 0.4))
    assert height == pytest.approx(-50.0 + 0.5 * np.sin(2.0 * np.pi * time / 8.0), abs=1e-5)
    assert np.all(np.diff(touchdown[:6]) < 0.0)  # peeled off as the end rises
    assert done.touchdowns["L3"] == pytest.approx((touchdown.min(), touchdown.max()))
    assert 0.013 < deepest.max() < 0.05
    assert "the touchdown point of L3 moves between" in done.text


def test_a_slow_motion_ends_where_statics_do(tmp_path):
    """A pipe pulled along the seabed by hysteresis of friction alone, in 400 s and in a step."""
    record = "0 0\n200 0.05\n400 0.02"
    moved = deck_in(tmp_path, "{moved}", end=400, step=2, record=400)
    text = moved.read_text(encoding="utf-8").replace("3 2\n{moved}", f"3 2 X\n{record}")
    moved.write_text(text, encoding="utf-8")
    run_deck(moved, tmp_path, force=False)
    still = tmp_path / "still.deck"
    steps = "*QUASISTATIC\n1 L3E2 1\n2 L3E2 0.4\n"
    text = text.split("*DYNAMIC")[0].replace(f"3 2 X\n{record}", "3 2\nX 0.05")
    still.write_text(f"{text}{steps}*EXEC\n", encoding="utf-8")
    run_deck(still, tmp_path, force=False)
    with open_database(tmp_path / "pipe.dst") as database:
        line = database.line("L3")
        friction, tension = line.read("axial_force")[-1], line.read("line/effective_tension")[-1]
    with open_database(tmp_path / "still.dss") as database:
        line = database.line("L3")
        assert friction == pytest.approx(line.read("axial_force")[-1], abs=0.02 * 500.0)
        pulled = line.read("line/effective_tension")[-1]
        assert tension == pytest.approx(pulled, abs=0.01 * np.abs(pulled).max())


def test_a_line_that_nothing_moves_stands_still(tmp_path):
    """Rounding is no error of its displacements, and what statics have lost is not lost again."""
    deck = deck_in(tmp_path, "Z 0.5", more="*QUASISTATIC\n1 L3E2 1", end=1, record=1)
    run = run_deck(deck, tmp_path, force=False)
    assert run.motion is not None
    assert run.warnings() == ()
    assert run.motion.error < 1e-4
    assert abs(run.motion.dissipated) < 1e-3  # J


def test_a_record_that_jumps_is_balanced_all_the_same(tmp_path):
    """What an iteration may leave is a share of the way, not of the velocity of a jump."""
    record = "0 0\n0.5 0\n0.500001 0.05\n1 0.05"
    moved = deck_in(tmp_path, "{moved}", end=1, record=0.1)
    text = moved.read_text(encoding="utf-8").replace("3 2\n{moved}", f"3 2 Z\n{record}")
    moved.write_text(text, encoding="utf-8")
    run_deck(moved, tmp_path, force=False)
    with open_database(tmp_path / "pipe.dst") as database:
        assert database.line("L3").read("convergence/residual").max() < 1e-2


@pytest.mark.parametrize("more", ["", "*DYNIMP\n30 0.5 0.25 1"])
@pytest.mark.parametrize("after", [0, 1])
def test_an_interrupted_motion_goes_on_to_the_same_bits(tmp_path, monkeypatch, more, after):
    monkeypatch.setattr(motion_log, "BLOCK", 16)
    deck = deck_in(tmp_path, LIFT + "\nY 0.3 3 0 1", more=more, end=1.7)
    soil = "*SUCTION\n1 CU=3e3\n*SOILSTIFF\n1 DUNLAP 3e3\n"
    contact = "*TYPCONTACT\n0 3 3 0.5 0.7 "
    text = deck.read_text(encoding="utf-8")
    text = text.replace(f"{contact}5e4", f"{soil}{contact}0 0.01 0.01 1 0 0 1 1")
    deck.write_text(text, encoding="utf-8")
    run_deck(deck, tmp_path / "whole", force=False)
    told = iter(range(after))

    def end(text: str) -> None:
        if "of motion" in text and next(told, None) is None:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match="go on from"):
        run_deck(deck, tmp_path / "cut", force=False, progress=end)
    run_deck(deck, tmp_path / "cut", force=False, resume=True)
    whole, cut = (tmp_path / name / "pipe.dst" for name in ("whole", "cut"))
    assert shaken.differences(whole, cut) == []


@pytest.mark.parametrize("method", ["HHT", "NEWMARK", "GALPHA", "BATHE"])
def test_other_methods_come_to_the_same(tmp_path, method):
    heights = {}
    for name in ("", f"METHOD={method}"):
        deck = deck_in(tmp_path, LIFT, method=name, end=2, record=2, step=0.05)
        run_deck(deck, tmp_path, force=True)
        with open_database(tmp_path / "pipe.dst") as database:
            heights[name] = database.line("L3").read("line/position_z")[-1]
    one, other = heights.values()
    assert one == pytest.approx(other, abs=5e-3)


def test_explicit_differences_are_refused_beyond_their_limit(tmp_path, capsys):
    deck = deck_in(tmp_path, LIFT, method="METHOD=CENTRAL")
    assert main(["run", str(deck), "-o", str(tmp_path)]) == 2
    assert "METHOD=CENTRAL is stable with steps up to" in capsys.readouterr().err


def test_no_drag_and_a_jump_are_told(tmp_path, capsys):
    deck = deck_in(tmp_path, "Z 0.5 8 90")
    deck.write_text(deck.read_text(encoding="utf-8").replace(" CD=1", ""), encoding="utf-8")
    assert main(["check", str(deck)]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "CD = 0 in motion: the water takes no energy" in told
    assert "Z of end 2 begins 0.5 m from its place: it jumps there in the first step" in told


def test_a_line_that_lifts_off_has_no_touchdown_meanwhile(tmp_path):
    deck = deck_in(tmp_path, "Z 5 8 0 1", end=2, record=0.2)
    done = run_deck(deck, tmp_path, force=False).motion
    assert done is not None
    with open_database(tmp_path / "pipe.dst") as database:
        touchdown = database.line("L3").read("touchdown_distance")
    assert touchdown.min() == 0.0
    assert done.touchdowns["L3"] == pytest.approx((touchdown[touchdown > 0.0].min(), 60.0))


def test_damping_is_told_as_that_of_lines(tmp_path, capsys):
    assert main(["check", str(deck_in(tmp_path, LIFT, more="*DAMPING\nBETA=0.01"))]) == 0
    assert "0.01 s of the stiffness of the lines" in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    ("moved", "more", "told"),
    [
        ("Z 0.5", "*HARMONIC\nL3E2 8 90", "Z of end 2 begins 0.5 m from its place"),
        ("Z 0.5", "*QUASISTATIC\n1 L3E2 1\n*HARMONIC\nL3E2 8 90", ""),
        ("Z 0.5", "*TIMESERIES\nL3E2\n0 0\n1 0\n1.001 1", "Z of end 2 moves at up to 500 m/s"),
        ("Z 0.5 0.2 0 1", "", "DT = 0.1 s with a period of 0.2 s: with fewer than 8 steps"),
        ("Z 0.5 0.79 0 1", "*DYNIMP\n30 0.5 0.25 1", ""),
    ],
)
def test_what_moves_an_end_too_abruptly_is_told(tmp_path, capsys, moved, more, told):
    assert main(["check", str(deck_in(tmp_path, moved, more=more))]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert told in shown if told else "risky" not in shown


def test_a_line_moves_beside_a_pile(tmp_path):
    """Both in one database, followed in the same steps."""
    pile = shaken.deck(tmp_path, end=1.0).read_text(encoding="utf-8").split("*DYNAMIC")[0]
    line = PIPE.split("*DEPTH\n-50\n")[1].format(
        moved=LIFT, end=1, step=0.05, method="", record=0.5, accuracy=1e-2, more=""
    )
    depth = float(pile.split("*DEPTH\n")[1].split("\n")[0])
    line = line.replace(" -50 X", f" {depth:g} X")
    path = tmp_path / "both.deck"
    path.write_text(f"{pile}{line}", encoding="utf-8")
    done = run_deck(path, tmp_path, force=False).motion
    assert done is not None
    assert done.failure == ""
    with h5py.File(tmp_path / "both.dst") as file:
        assert {"F1", "L3"} <= set(file)
        assert file["F1/time"].shape == file["L3/time"].shape


def test_the_sample_is_what_its_deck_makes(tmp_path, capsys):
    """Histories to 1e-4 of the largest: steps of a trial, and their rounding, are the machine's.

    The report is that of the page.
    """
    assert main(["run", str(SAMPLE), "-o", str(tmp_path)]) == 0
    told = capsys.readouterr().out.split("Motion to")[1].splitlines()
    page = (DOCS / "lines.md").read_text(encoding="utf-8").split("Motion to")[1].splitlines()
    assert told[:4] == page[:4]
    stored, made = (folder / "riser_heaving.dst" for folder in (SAMPLE.parent, tmp_path))
    with open_database(stored) as kept, open_database(made) as new:
        assert kept.deck_text == new.deck_text
        for name in ("time", "touchdown_distance", "penetration", "line/bending_moment"):
            old, now = kept.line("L1").read(name), new.line("L1").read(name)
            assert now == pytest.approx(old, abs=1e-4 * np.abs(old).max())


def test_the_answers_of_the_sample(tmp_path, monkeypatch, capsys):
    for name in ("riser_heaving.dst", "riser_heaving.answers"):
        shutil.copy(SAMPLE.parent / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert podeep(["riser_heaving", "--answers", "riser_heaving.answers"]) == 0
    assert "Normal displacement (m)" in capsys.readouterr().out
    assert list(tmp_path.glob("*.png"))
