"""Decks of lines solved by the command: reports, databases, sessions, refusals; the sample."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from manual import DOCS
from podeep.cli.podeep import main as podeep
from podeep.cli.solve import main
from podeep.database.read import open_database

SAMPLES = DOCS.parent / "sample_dbs"
DECK = SAMPLES / "riser_pulled.deck"
SHORT = """\
*TITLE
A pipe pulled along the seabed
*DEPTH
-50
*LINE
3 PIPE
200 0.3 0.02 200e9 7850
*END
3 1 0 0 -50 X Y Z RX RY RZ
3 2 200 0 -50 X Y
*TYPCONTACT
0 3 3 {mu} 0 5e4
*MOTION
3 2
X 0.05
*QUASISTATIC
1 L3E2 0.5
2 L3E2 1
*EXEC
"""
WEIGHT = np.pi / 4 * 9.80665 * (7850 * (0.3**2 - 0.26**2) - 1025 * 0.3**2)


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A folder with a short pipe in it, rubbing."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pipe.deck").write_text(SHORT.format(mu=0.5), encoding="utf-8")
    return tmp_path


def test_a_pulled_pipe_is_in_the_database(case, capsys):
    assert main(["run", "pipe.deck"]) == 0
    shown = capsys.readouterr()
    assert "L3 PIPE: " in shown.out
    assert "in a vertical plane, 2 steps" in shown.out
    with open_database(case / "pipe.dss") as database:
        line = database.line("L3")
        s = line.points
        assert (s[0], s[-1]) == (0.0, 200.0)
        assert line.read("load_factor").ravel().tolist() == [0.0, 0.5, 1.0]
        friction = line.read("axial_force")
        moved = line.read("axial_displacement")
        pulled = line.read("line/effective_tension")
    assert moved[2, -1] == pytest.approx(0.05, abs=1e-6)
    np.testing.assert_allclose(moved[0], 0.0, atol=1e-12)
    full = friction[2, (s > 150.0) & (s < 190.0)]
    np.testing.assert_allclose(full, 0.5 * WEIGHT, rtol=1e-3)
    inside = (s > 150.0) & (s < 190.0)
    growth = np.polyfit(s[inside], pulled[2, inside], 1)[0]
    assert growth == pytest.approx(0.5 * WEIGHT, rel=1e-3)


def test_work_is_what_friction_and_stretch_take(case):
    """Without friction the pull does EA u^2/2L; with it, more."""
    (case / "free.deck").write_text(SHORT.format(mu=0), encoding="utf-8")
    energy = {}
    for name in ("pipe", "free"):
        assert main(["run", f"{name}.deck"]) == 0
        with open_database(case / f"{name}.dss") as database:
            energy[name] = database.line("L3").read("convergence/energy")[-1]
    stretching = 200e9 * np.pi / 4 * (0.3**2 - 0.26**2)
    assert energy["free"] == pytest.approx(0.5 * stretching * 0.05**2 / 200.0, rel=1e-3)
    assert energy["pipe"] > 1.05 * energy["free"]


def test_the_report_as_json(case, capsys):
    assert main(["run", "pipe.deck", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    (line,) = told["lines"]
    assert (line["line"], line["steps"], told["foundations"]) == ("L3", 2, [])
    assert line["largest_tension"][2] > line["largest_tension"][1] > 0.0
    assert max(line["estimated_errors"].values()) <= 1e-3


def test_podeep_reads_what_was_solved(case, capsys):
    assert main(["run", "pipe.deck"]) == 0
    capsys.readouterr()
    answers = case / "answers.txt"
    answers.write_text("g\nf\nr\n100 190 4\n2\nq\n", encoding="utf-8")
    assert podeep(["pipe", "--answers", str(answers), "--no-plot"]) == 0
    table = re.findall(r"^ +(\d+) +(\S+)$", capsys.readouterr().out, re.M)
    assert [row[0] for row in table] == ["100", "130", "160", "190"]
    assert float(table[2][1]) == pytest.approx(0.5e-3 * WEIGHT, rel=1e-3)


def test_a_line_beside_a_pile(case, capsys):
    pile = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
    depth = re.search(r"\*DEPTH\s+(\S+)", pile)
    assert depth
    line = SHORT[SHORT.index("*LINE") : SHORT.index("*MOTION")].replace("-50", depth[1])
    (case / "both.deck").write_text(
        pile.replace("*EXEC", f"{line.format(mu=0.3)}*EXEC"), encoding="utf-8"
    )
    assert main(["run", "both.deck"]) == 0
    shown = capsys.readouterr().out
    assert "L3 PIPE: " in shown
    with open_database(case / "both.dss") as database:
        assert (database.foundations, database.lines) == (("F1",), ("L3",))


def test_a_step_that_cannot_be_is_told_and_what_came_before_is_kept(case, capsys):
    """The second step would take the end through the other one."""
    text = SHORT.format(mu=0).replace("X 0.05", "X -1000").replace("1 L3E2 0.5", "1 L3E2 1e-6")
    text = text.replace("200e9 7850\n", "200e9 7850 6\n")
    (case / "lost.deck").write_text(text, encoding="utf-8")
    assert main(["run", "lost.deck"]) == 1
    assert "L3: step 2 stops at " in capsys.readouterr().err
    with open_database(case / "lost.dss") as database:
        assert database.status == "stopped"
        assert len(database.line("L3").axis) == 2


# --- the sample -----------------------------------------------------------------------------------


def test_the_sample_is_what_its_deck_makes(tmp_path, capsys):
    assert main(["run", str(DECK), "-o", str(tmp_path)]) == 0
    (report,) = re.findall(
        r"^```text\n(Riser whose.*?)^```",
        (DOCS / "lines.md").read_text(encoding="utf-8"),
        re.M | re.S,
    )
    out = capsys.readouterr().out
    told, page = (
        re.sub(r"estimated errors.*", "", x.replace(str(tmp_path), "out")) for x in (out, report)
    )
    assert told == page
    name = "riser_pulled.dss"
    with open_database(SAMPLES / name) as kept, open_database(tmp_path / name) as made:
        assert kept.deck_text == made.deck_text
        old, new = kept.line("L1"), made.line("L1")
        np.testing.assert_allclose(new.points, old.points, atol=1e-9)
        for quantity in ("penetration", "line/effective_tension", "line/bending_moment"):
            before, after = old.read(quantity), new.read(quantity)
            np.testing.assert_allclose(after, before, atol=1e-5 * np.abs(before).max())


def test_the_sample_peels_off_against_suction():
    with open_database(SAMPLES / "riser_pulled.dss") as database:
        line = database.line("L1")
        reaction, touchdown = line.read("normal_reaction"), line.read("touchdown_distance")
    assert reaction[1:5].min() < -900.0
    assert (np.diff(touchdown[:5]) < 0.0).all()
    assert touchdown[8] == pytest.approx(touchdown[0], abs=0.2)


def test_the_answers_of_the_sample(capsys, monkeypatch):
    monkeypatch.chdir(SAMPLES)
    assert podeep(["riser_pulled", "--answers", "riser_pulled.answers", "--no-plot"]) == 0
    assert "Normal displacement (m)" in capsys.readouterr().out
