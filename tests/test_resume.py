"""Motions that were interrupted go on to the same bits, from wherever a kill has left them."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pexpect
import pytest

import killed_runs
import shaken
from podeep import motion_log, run_motion
from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.errors import ExitCode, Interrupted, UserError
from podeep.resume import Options
from podeep.run import run_deck

KILLS = 20  # 50 and more by `python killed_runs.py FOLDER KILLS SEED`
HERE = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "OMP_NUM_THREADS": "1"}


@pytest.fixture(autouse=True)
def short_blocks(monkeypatch):
    monkeypatch.setattr(motion_log, "BLOCK", 16)


def interrupted(deck: Path, folder: Path, after: int, **options: object) -> Path:
    """A run that the user ends after so many blocks; its partial."""
    told = iter(range(after))

    def end(text: str) -> None:
        if "of motion" in text and next(told, None) is None:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match="go on from"):
        run_deck(deck, folder, **({"force": False, "progress": end} | options))
    return folder / "shaken.dst.partial"


SCENES = {
    "two planes, every step": {"across": 40e3},
    "with a stretch, fewer records": {"heave": 1e5, "record": 0.07},
    "blocks without a record": {"record": 0.5},
    "no iteration": {"method": "ROS2"},
    "two parts of a step": {"method": "BATHE"},
    "what the accuracy chose": {"step": None, "accuracy": 1e-3},
    "steps that follow the error": {"adaptive": True, "record": 0.02, "heave": 1e5},
    "soil that remembers in two planes": {"end": 0.5, "more": shaken.ROUND},
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
@pytest.mark.parametrize("after", [0, 2])
def test_goes_on_to_the_same_bits(tmp_path, scene, after):
    deck = shaken.deck(tmp_path, **{"end": 1.0, **scene})
    run_deck(deck, tmp_path / "whole", force=False)
    partial = interrupted(deck, tmp_path / "cut", after)
    with open_database(partial) as database:
        assert database.status == "interrupted"
        assert database.state is not None
    done = run_deck(deck, tmp_path / "cut", force=False, resume=True)
    assert done.motion is not None
    assert not partial.exists()
    whole, cut = (tmp_path / name / "shaken.dst" for name in ("whole", "cut"))
    assert shaken.differences(whole, cut) == []
    with h5py.File(cut) as file:
        assert "restart" not in file
        assert file.attrs["history"].splitlines() == [
            "podeep-solve run shaken",
            "podeep-solve run shaken --resume",
        ]


def test_a_step_that_turned_out_too_long_is_halved_again(tmp_path, monkeypatch):
    """The trial is made to choose a step whose error is too large for the whole motion."""
    monkeypatch.setattr(run_motion, "pace_for", lambda *_: 0.05)
    deck = shaken.deck(tmp_path, end=2.0, step=None, accuracy=1e-3)
    whole = run_deck(deck, tmp_path / "whole", force=False).motion
    assert whole is not None
    assert whole.step < 0.05
    interrupted(deck, tmp_path / "cut", 0)
    monkeypatch.setattr(run_motion, "pace_for", lambda *_: pytest.fail("chosen anew"))
    run_deck(deck, tmp_path / "cut", force=False, resume=True)
    paths = [tmp_path / name / "shaken.dst" for name in ("whole", "cut")]
    assert shaken.differences(*paths) == []


def test_options_of_the_run_are_kept(tmp_path):
    options = Options(accuracy=1e-3, double=True, compress=True)
    deck = shaken.deck(tmp_path, end=1.0)
    run_deck(deck, tmp_path / "whole", force=False, options=options)
    interrupted(deck, tmp_path / "cut", 1, options=options)
    run_deck(deck, tmp_path / "cut", force=False, resume=True)
    whole, cut = (tmp_path / name / "shaken.dst" for name in ("whole", "cut"))
    assert shaken.differences(whole, cut) == []
    with h5py.File(cut) as file:
        assert file["F1/lateral_displacement"].dtype == np.float64
        assert file["F1/depth"].dtype == np.float64


def test_killed_at_any_moment_of_a_motion(tmp_path):
    """All that was told of is there, but for the last block; runs go on to the same bits."""
    command = [sys.executable, killed_runs.__file__, str(tmp_path), str(KILLS), "3"]
    done = subprocess.run(command, env=HERE, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    lines = [line.split() for line in done.stdout.splitlines()]
    assert len(lines) == KILLS
    for rows, steps, found in lines:
        assert int(rows) >= int(steps)
        assert found in ("-", "nothing")
    assert len([found for _, _, found in lines if found == "nothing"]) == KILLS // killed_runs.TRIED
    assert len({rows for rows, _, _ in lines}) > 3


def command(capsys, *arguments: object) -> tuple[int, str, str]:
    code = main(["run", *map(str, arguments)])
    shown = capsys.readouterr()
    return code, shown.out, shown.err


def test_nothing_to_resume_is_told(tmp_path, capsys):
    deck = shaken.deck(tmp_path, end=1.0)
    code, _, told = command(capsys, deck, "-o", tmp_path, "--resume")
    assert code == ExitCode.USAGE
    assert "shaken.dst.partial does not exist; run without --resume" in told
    still = deck.read_text().split("*DYNAMIC")[0] + "*EXEC\n"
    deck.write_text(still.replace("*HARMONIC\nSWAY 1.3 0 0.5", "*QUASISTATIC\n1 SWAY 1"))
    code, _, told = command(capsys, deck, "-o", tmp_path, "--resume")
    assert (code, "has no motion" in told) == (ExitCode.USAGE, True)


def test_a_finished_run_is_told_to_be_complete(tmp_path, capsys):
    deck = shaken.deck(tmp_path, end=1.0)
    assert command(capsys, deck, "-o", tmp_path, "-q")[0] == 0
    before = (tmp_path / "shaken.dst").read_bytes()
    code, shown, _ = command(capsys, deck, "-o", tmp_path, "--resume")
    assert (code, shown) == (
        0,
        f"{tmp_path}/shaken.dst is complete: there is nothing to resume\n",
    )
    assert (tmp_path / "shaken.dst").read_bytes() == before


def test_options_beside_resume_are_refused(tmp_path, capsys):
    deck = shaken.deck(tmp_path)
    for option in ("--float64", "--compress", "--accuracy=1e-3"):
        code, _, told = command(capsys, deck, "--resume", option)
        assert (code, "options of the run that was interrupted" in told) == (ExitCode.USAGE, True)


def foreign(change: Callable[[h5py.File], None], partial: Path) -> None:
    with h5py.File(partial, "r+") as file:
        change(file)


def other_version(file: h5py.File) -> None:
    file.attrs["version"] = "0.0.9"


def other_minor(file: h5py.File) -> None:
    file.attrs["schema_version"] = "1.7"


def no_state(file: h5py.File) -> None:
    del file["restart"]


def other_state(file: h5py.File) -> None:
    file["restart/names"][3] = "of something else"


def sizes_beyond(file: h5py.File) -> None:
    file["restart/sizes"][...] = 10**12


def no_number(file: h5py.File) -> None:
    file["restart/state"][...] = np.nan


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (other_version, "is of version 0.0.9 of the program"),
        (other_minor, "schema 1.7"),
        (no_state, "holds no state to go on from"),
        (other_state, "another run's state"),
        (sizes_beyond, "restart/sizes is more than there is"),
        (no_number, "not finite"),
    ],
)
def test_partials_that_cannot_be_gone_on_from(tmp_path, change, words):
    deck = shaken.deck(tmp_path, end=1.0)
    partial = interrupted(deck, tmp_path, 1)
    foreign(change, partial)
    with pytest.raises(UserError, match=words):
        run_deck(deck, tmp_path, force=False, resume=True)
    assert partial.exists()


def test_another_deck_is_refused(tmp_path):
    deck = shaken.deck(tmp_path, end=1.0)
    interrupted(deck, tmp_path, 1)
    shaken.deck(tmp_path, end=1.1)
    with pytest.raises(UserError, match="of another deck, or the deck or a file that it includes"):
        run_deck(deck, tmp_path, force=False, resume=True)


def test_statics_that_are_there_stay(tmp_path):
    deck = shaken.deck(tmp_path, end=1.0)
    interrupted(deck, tmp_path, 1)
    before = (tmp_path / "shaken.dss").stat().st_ino
    run_deck(deck, tmp_path, force=False, resume=True)
    assert (tmp_path / "shaken.dss").stat().st_ino == before
    interrupted(deck, tmp_path, 1, force=True)
    (tmp_path / "shaken.dss").unlink()
    run_deck(deck, tmp_path, force=True, resume=True)
    assert (tmp_path / "shaken.dss").exists()


@pytest.mark.parametrize("quiet", [False, True])
def test_interrupted_at_a_terminal(tmp_path, quiet):
    """Progress stands on one line and is erased; the message is the command that goes on."""
    deck = shaken.deck(tmp_path, end=900.0)
    arguments = [str(deck), "-o", str(tmp_path), *(["-q"] if quiet else [])]
    code = "import sys; from podeep.cli.solve import main; sys.exit(main(['run', *sys.argv[1:]]))"
    child = pexpect.spawn(
        sys.executable, ["-c", code, *arguments], env=HERE, dimensions=(24, 200), timeout=60
    )
    if quiet:
        while not (tmp_path / "shaken.dst.partial").exists():
            child.expect([pexpect.TIMEOUT, pexpect.EOF], timeout=0.1)
    else:
        child.expect(r"\r\x1b\[K[\d.]+ of 900 s of motion, about \d+ (s|min|h) to go")
    child.sendintr()
    child.expect(r"podeep-solve: interrupted at [\d.]+ of 900 s; go on from (.*) with: (.*)\r\n")
    before, again = child.before.decode(), child.match[2].decode()
    assert ("\x1b" in before) is not quiet
    assert quiet or before.endswith("\r\x1b[K")
    assert again == f"podeep-solve run {deck} -o {tmp_path} --resume"
    child.expect(pexpect.EOF)
    child.close()
    assert child.exitstatus == ExitCode.INTERRUPTED
    with open_database(tmp_path / "shaken.dst.partial") as database:
        assert database.state is not None
