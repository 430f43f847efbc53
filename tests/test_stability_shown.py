"""What podeep-solve chart --stability shows: words, CSV, a picture, exit codes."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.study.stability import METHODS, Cause, StabilityMap, Verdict, stability_map
from podeep.study.stability_figure import draw_stability, save_stability
from podeep.study.stability_report import stability_csv, stability_report
from podeep.study.trials import TRIALS

JACKET = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"


@pytest.fixture(scope="module")
def quick() -> StabilityMap:
    told: list[str] = []
    found = stability_map(told.append, quick=True)
    assert told[0] == "linear, NEWMARK"
    assert len(told) == len(TRIALS) * len(METHODS)
    return found


def test_every_trial_is_made_with_every_method_and_step(quick: StabilityMap) -> None:
    assert quick.steps == pytest.approx(np.logspace(-1, 2, 7))
    places = [(c.trial, c.method, c.step) for c in quick.cells]
    assert places == [(t.name, m, h) for t in TRIALS for m in METHODS for h in quick.steps]
    for one in quick.cells:
        assert (one.verdict is Verdict.STABLE) is (one.words == "") is (one.cause is Cause.NONE)


def test_the_report_fits_a_terminal(quick: StabilityMap) -> None:
    text = stability_report(quick)
    assert all(len(line) <= 80 for line in text.splitlines())
    rows = [line for line in text.splitlines() if line.startswith("  CENTRAL")]
    *marks, up_to, closed = rows[0].split()
    assert marks == ["CENTRAL", *". . . X X X X".split()]
    assert float(up_to) == pytest.approx(2.0, rel=0.03)
    assert closed == "2"
    assert len(rows) == len(TRIALS)
    scale = next(line for line in text.splitlines() if line.startswith("omega h"))
    for step, place in (("0.1", 0), ("1", 2), ("10", 4), ("100", 6)):
        assert scale[11 + 2 * place :].startswith(step)
    assert ">= 0.187" in text


def test_the_csv_holds_all(quick: StabilityMap) -> None:
    rows = list(csv.DictReader(io.StringIO(stability_csv(quick))))
    cells = [row for row in rows if row["kind"] == "cell"]
    assert len(cells) == len(quick.cells)
    for row, one in zip(cells, quick.cells, strict=True):
        assert (row["trial"], row["method"]) == (one.trial, one.method)
        assert float(row["omega h"]) == one.step
        assert (row["verdict"], row["cause"]) == (one.verdict.value, one.words)
    edges = [row for row in rows if row["kind"] == "boundary"]
    assert [float(row["omega h"]) for row in edges] == [b.step for b in quick.boundaries]
    closed = [row["cause"] for row in rows if row["kind"].startswith("closed form")]
    assert "1 + (omega h)^2/4" in closed
    assert len(closed) == sum(b.limit is not None for b in quick.boundaries)


def test_what_stands_in_the_picture(quick: StabilityMap) -> None:
    figure = draw_stability(quick)
    assert len(figure.axes) == len(TRIALS)
    for axes, trial in zip(figure.axes, TRIALS, strict=True):
        lines = {round(float(x), 9) for line in axes.lines for x in line.get_xdata()}
        known = {b.limit.step for b in quick.boundaries if b.trial == trial.name and b.limit}
        assert lines == {round(x, 9) for x in known}
        assert axes.get_title(loc="left").startswith(trial.name)
    words = {text.get_text() for text in figure.axes[0].texts}
    assert "| 2: 2/omega" in words
    assert "✕" in words
    figure.draw_without_rendering()
    box = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert box.min() >= 0.0
    assert box.max() <= 1.0


def test_the_colours_differ_in_grey() -> None:
    from matplotlib.colors import to_rgb

    from podeep.study.stability_figure import _COLOURS

    grey = [float(np.dot(to_rgb(c), (0.299, 0.587, 0.114))) for c in _COLOURS.values()]
    assert grey[0] - grey[1] > 0.15
    assert grey[1] - grey[2] > 0.3


def test_the_picture_of_the_same_map_has_the_same_bytes(
    quick: StabilityMap, tmp_path: Path
) -> None:
    first, again = (save_stability(quick, tmp_path) for _ in range(2))
    assert (first.name, again.name) == ("stability.png", "stability_2.png")
    assert first.read_bytes() == again.read_bytes()


# --- the command ---------------------------


def test_the_command(quick: StabilityMap, tmp_path: Path, capsys, monkeypatch) -> None:
    import podeep.study.stability as stability

    monkeypatch.setattr(stability, "stability_map", lambda *_, **__: quick)
    assert main(["chart", "--stability", "-o", str(tmp_path / "new")]) == 0
    out, err = capsys.readouterr()
    picture = tmp_path / "new" / "stability.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert out == f"{stability_report(quick)}\nwritten: {picture}\n"
    assert err == ""
    assert main(["chart", "--stability", "--csv", "-o", str(tmp_path / "new")]) == 0
    out, err = capsys.readouterr()
    assert out == stability_csv(quick)
    assert err.startswith("written: ")


def test_faults_of_usage(capsys) -> None:
    assert main(["chart", "--stability", str(JACKET)]) == 2
    assert "--stability is of no deck" in capsys.readouterr().err
    assert main(["chart", "--stability", "--foundation", "F1"]) == 2
    capsys.readouterr()
    assert main(["chart"]) == 2
    assert "there is no deck to chart; give one, or --stability" in capsys.readouterr().err
