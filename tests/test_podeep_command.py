"""The command `podeep`: what it opens, where its output goes, how it ends."""

import csv
import os
import signal
import subprocess
from io import StringIO
from pathlib import Path

import h5py
import numpy as np
import pytest

from builders import DEPTH, SHAPES, dynamic_database, field, static_database
from podeep import __version__
from test_podeep_transcripts import COMMAND

SNAPSHOT = "g\nf\nl\n0 30 4 3\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    static_database(Path("run.dss"))
    return tmp_path


def podeep(*arguments, stdin="", **more):
    return subprocess.run(
        [*COMMAND, *arguments], input=stdin, capture_output=True, encoding="utf-8", **more
    )


def refused(*arguments, stdin="q"):
    done = podeep(*arguments, stdin=stdin)
    assert (done.returncode, done.stdout) == (2, "")
    return done.stderr


def test_all_ways_to_give_answers_give_the_same_transcript(folder):
    Path("answers").write_bytes(SNAPSHOT.replace("\n", "\r\n").rstrip().encode())
    given = podeep("run", "--no-plot", "--answers", "answers")
    assert (given.returncode, given.stderr) == (0, "")
    piped = podeep("run", "--no-plot", stdin=SNAPSHOT)
    shell = " ".join(f"'{part}'" for part in [*COMMAND, "run", "--no-plot"])
    for text in (f"{shell} < answers", f"{shell} <<END\n{SNAPSHOT}END\n", f"cat answers | {shell}"):
        done = subprocess.run(["sh", "-c", text], capture_output=True, encoding="utf-8")
        assert (done.stdout, done.stderr) == (given.stdout, "")
    assert piped.stdout == given.stdout


def test_no_answers_at_all_are_told(folder):
    with Path(os.devnull).open() as nothing:
        done = subprocess.run([*COMMAND, "run"], stdin=nothing, capture_output=True, text=True)
    assert done.returncode == 3
    assert done.stderr == (
        "podeep: <stdin>:1: the answer is missing, the script ends here\n"
        "  asked: Static soil results <g>, Exit <q>:\n"
    )


def test_the_script_is_named_as_given(folder):
    Path("sub").mkdir()
    Path("sub/answers.txt").write_text("z")
    assert podeep("run", "--answers", "./sub/../sub/answers.txt").stderr.startswith(
        "podeep: ./sub/../sub/answers.txt:1: 'z' is not one of g, q\n"
    )


@pytest.mark.parametrize("arguments", [[], ["run"], ["run.dss"], ["run.dss", "run.dss"]])
def test_a_case_is_found(folder, arguments):
    done = podeep(*arguments, stdin="q")
    assert done.returncode == 0
    assert done.stdout.startswith("Static soil results..............<g>\nExit")


def test_both_databases_of_a_case_are_opened(folder):
    dynamic_database(Path("run.dst"))
    for arguments in ([], ["run"], ["run.dst", "run.dss"]):
        assert podeep(*arguments, stdin="q").stdout.splitlines()[:2] == [
            "Static soil results..............<g>",
            "Dynamic soil results.............<h>",
        ]


def test_bytes_that_are_no_text_are_refused_as_answers(folder):
    Path("answers").write_bytes(b"g\n\xff\xfe\n")
    with Path("answers").open() as answers:
        done = subprocess.run([*COMMAND, "run"], stdin=answers, capture_output=True)
    assert done.returncode == 3
    assert done.stderr.startswith(b"podeep: <stdin>:2: '")
    closed = " ".join(f"'{part}'" for part in [*COMMAND, "run"])
    assert subprocess.run(["sh", "-c", f"{closed} <&-"], capture_output=True).returncode == 3


def test_a_title_cannot_play_tricks_on_the_terminal(folder):
    static_database(Path("trick.dss"), title="A\x1b[2Jtitle\n# spoof")
    done = podeep("trick", "--no-plot", "--csv", stdin=SNAPSHOT)
    assert done.stdout.splitlines()[1] == "# Title: A [2Jtitle # spoof"


def test_what_cannot_be_opened_is_told(folder):
    static_database(Path("other.dss"))
    Path("gui.dss").write_bytes(b"DeepLines simulation")
    with h5py.File("foreign.dss", "w") as file:
        file.create_dataset("x", data=np.zeros(3))
    before = Path("gui.dss").read_bytes()
    assert "neither no.dss nor no.dst is there" in refused("no")
    assert "both static" in refused("run", "other")
    assert "several cases are in this folder: foreign, gui, other, run;" in refused()
    assert refused("gui").startswith("podeep: gui.dss: ")
    assert refused("foreign").startswith("podeep: foreign.dss: ")
    assert refused("no.dss").startswith("podeep: no.dss: ")
    assert "absent cannot be read" in refused("run", "--answers", "absent")
    assert "run.dss is no folder" in refused("run", "-o", "run.dss")
    assert Path("gui.dss").read_bytes() == before


def test_an_empty_folder_and_an_unknown_option_are_usage_errors(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "no .dss or .dst is in this folder; name a case" in refused()
    assert "--plots" in refused("--plots")


def test_an_interrupted_run_is_named(folder):
    Path("run.dss").rename("run.dss.partial")
    assert "an interrupted run left run.dss.partial" in refused("run")
    done = podeep("run.dss.partial", "-o", "out", stdin=SNAPSHOT)
    assert done.returncode == 0
    assert [path.name for path in Path("out").iterdir()] == [
        "run_static_snapshot_lateral_displacement.png"
    ]


def test_a_stopped_run_is_told_on_standard_error(folder):
    static_database(Path("half.dss"), status="stopped", stop_reason="no equilibrium")
    done = podeep("half", stdin="q")
    assert done.returncode == 0
    assert done.stderr == "podeep: half.dss: the run's status is stopped: no equilibrium\n"


def test_pictures_go_to_the_folder_and_none_is_overwritten(folder):
    for number in ("", "_2"):
        done = podeep("run", "-o", "deep/er", stdin=SNAPSHOT)
        path = f"deep/er/run_static_snapshot_lateral_displacement{number}.png"
        assert f"\nPicture: {path}\n" in done.stdout
    first, second = Path("deep/er").iterdir()
    assert first.read_bytes() == second.read_bytes()
    assert "Picture" not in podeep("run", "--no-plot", stdin=SNAPSHOT).stdout
    assert not list(folder.glob("*.png"))


@pytest.mark.parametrize("quantity", ["lateral_displacement", "axial_force"])
@pytest.mark.parametrize("spatial", [False, True])
def test_csv_holds_the_closed_form_of_the_database(folder, quantity, spatial):
    static_database(Path("run.dss"), spatial=spatial, force=True)
    sign = {"lateral_displacement": "l", "axial_force": "r"}[quantity]
    done = podeep("run", "--csv", "--no-plot", stdin=f"g\nt\n{sign}\n0 30 7\n")
    rows = [line for line in StringIO(done.stdout) if not line.startswith("#")]
    table = np.array([[float(x) for x in row] for row in list(csv.reader(rows))[1:]])
    z = np.linspace(0.0, 30.0, 7)
    exact = field(quantity, table[:, 0], z)
    nodes = np.isin(z, DEPTH)
    assert nodes.sum() == 6
    np.testing.assert_allclose(table[:, 1:][:, nodes], exact[:, nodes], rtol=1e-14)
    size, fall = SHAPES[quantity]
    h, top = 10.0 / fall, 3.0 * size * np.exp(-20.0 / fall)  # the interval around 25 m
    bound = top * (h**4 / 384 if "displacement" in quantity else h**2 / 8)
    between = np.abs(table[:, 1:] - exact)[:, ~nodes]
    assert 0.0 < between.max() <= bound


def test_csv_leaves_standard_output_to_the_data(folder):
    done = podeep("run", "--csv", stdin=SNAPSHOT)
    assert done.stdout.startswith("# Database: run.dss (static)\n")
    assert "<" not in done.stdout
    assert "Type of results:" in done.stderr
    assert "Picture: run_static_snapshot" in done.stderr


def test_a_record_replays_and_is_not_overwritten(folder):
    done = podeep("run", "--no-plot", "--record", "record", stdin=SNAPSHOT)
    again = podeep("run", "--no-plot", "--answers", "record")
    assert (again.returncode, again.stdout) == (0, done.stdout)
    assert "record exists and is not overwritten" in refused("run", "--record", "record")


def test_version_and_help():
    assert podeep("--version").stdout == f"podeep {__version__}\n"
    text = podeep("--help").stdout
    assert all(word in text for word in ("CASE", "--answers", "--record", "-o DIR", "--csv"))


def test_a_reader_that_has_seen_enough_is_no_error(folder):
    with subprocess.Popen(
        [*COMMAND, "run"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        process.stdout.close()
        _, errors = process.communicate(SNAPSHOT.encode())
    assert (process.returncode, errors) == (0, b"")


def test_an_interrupt_ends_with_130(folder):
    with subprocess.Popen(
        [*COMMAND, "run"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout.readline() == b"Static soil results..............<g>\n"
        process.send_signal(signal.SIGINT)
        errors = process.stderr.read()
    assert (process.returncode, errors) == (130, b"podeep: interrupted\n")
