"""podeep-solve chart of lines: what it measures is so, and what it recommends works."""

import csv
import io
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from line_charts import (
    CASE_B,
    DECKS,
    EVEN,
    EVEN_NODAL,
    GRADED,
    GRADED_NODAL,
    SHORT,
    SMALL,
    read,
    silent,
)
from manual import DOCS
from podeep.cli.solve import main
from podeep.errors import AnalysisFailed
from podeep.line.analysis import follow_line, refinements, solve_line
from podeep.line.assemble import assemble, mesh
from podeep.lines import Line
from podeep.scene import Scene
from podeep.study import line_measure
from podeep.study.chart import Chart, Setting
from podeep.study.chart_figure import draw_chart, save_chart
from podeep.study.chart_report import chart_csv, chart_report
from podeep.study.line_measure import Gauge, Task, charted_line, choice_of
from podeep.study.line_settings import (
    LineSeries,
)
from podeep.study.measure import Plan
from podeep.study.settings import Series

PAGE = (DOCS / "chart.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("riser")


@pytest.fixture(scope="module")
def riser(folder) -> tuple[Scene, Line]:
    return read(folder, CASE_B)


@pytest.fixture(scope="module")
def found(riser) -> Chart[LineSeries]:
    return charted_line(*riser, SMALL, silent)


def test_every_setting_has_a_row_with_errors_and_time(found):
    assert {series: len(rows) for series, rows in found.series().items()} == {
        GRADED: 4,
        EVEN: 3,
        GRADED_NODAL: 4,
        EVEN_NODAL: 3,
    }
    for one in (*found.rows, *found.choices):
        assert one.failure == ""
        assert one.errors
        assert one.seconds
        assert one.runs == 2
    assert all(row.evaluations >= row.iterations > 0 for row in found.rows)
    assert all(row.unknowns > 10 * row.setting.elements for row in found.rows)
    assert found.sure
    assert found.cut == ()
    assert found.reference.elements > max(row.setting.elements for row in found.rows)
    graded, even = found.series()[GRADED][1:], found.series()[EVEN]
    assert [r.setting.elements for r in graded] == [65, 130, 260]
    assert [r.setting.elements for r in even] == [64, 130, 260]


def test_nodal_contact_is_of_second_order_and_integrated_contact_of_a_higher_one(found):
    """Also at the same number of elements: lumped at nodes, the moment is off 1000 times as far."""
    moments = {
        series: np.array([row.errors.moment for row in found.series()[series]])
        for series in (GRADED, GRADED_NODAL)
    }
    order = {series: np.log2(e[0] / e[-1]) / (len(e) - 1) for series, e in moments.items()}
    assert 1.7 < order[GRADED_NODAL] < 2.2
    assert order[GRADED] > 2.6
    assert (moments[GRADED_NODAL] > 1000.0 * moments[GRADED]).all()


def test_the_table_of_the_manual(found):
    """Errors of the moment in case B, by the number of elements."""
    (rows,) = re.findall(r"^\| elements \| even, nodal.*?\n\n", PAGE, re.M | re.S)
    head, _, *body = [[c.strip() for c in row.split("|")[1:-1]] for row in rows.splitlines() if row]
    series = {one.name: one for one in found.series()}
    for column, name in enumerate(head[1:], start=1):
        errors = {row.setting.elements: row.errors for row in found.series()[series[name]]}
        for cells in body:
            (elements,) = set(map(int, cells[0].split(","))) & set(errors)
            assert float(cells[column]) == pytest.approx(errors[elements].moment, rel=0.06)


def test_graded_elements_beat_even_ones(found):
    series = found.series()
    for graded, even in zip(series[GRADED][1:], series[EVEN], strict=True):
        assert graded.errors.largest < 0.3 * even.errors.largest


def test_what_the_program_chooses_is_that_of_a_run_and_within_what_was_asked(found, riser):
    scene, line = riser
    for one in found.choices:
        asked = replace(scene, numerics=replace(scene.numerics, accuracy=one.accuracy))
        solved = solve_line(asked, line)
        assert one.setting == Setting(GRADED, solved.model.elements)
        assert one.estimate == solved.errors.max() <= one.accuracy
        assert one.errors.largest <= one.estimate
        assert one.last < one.seconds


def test_the_choice_is_the_first_mesh_within_what_is_asked_or_the_last(riser):
    scene, line = riser
    task = Task(scene, line, SMALL, silent)
    every = refinements(scene, line, task.follow_own)
    own = [
        (replace(next(every), errors=np.full(4, error)), seconds)
        for error, seconds in ((5e-3, 1.0), (5e-4, 2.0))
    ]
    gauge = Gauge(task)
    true = gauge.values(own[1][0].results)
    found = [choice_of(task, accuracy, own, gauge, true) for accuracy in (1e-2, 1e-3, 1e-5)]
    assert [one.seconds for one in found] == [1.0, 2.0, 2.0]
    assert [one.estimate for one in found] == [5e-3, 5e-4, 5e-4]
    assert [one.setting.elements for one in found] == [130, 260, 260]
    task.late = True
    assert choice_of(task, 1e-5, own, gauge, true).failure == "left out, for time"


def test_the_fastest_reaches_its_accuracy_when_its_lines_are_solved(found, riser, folder):
    scene, line = riser
    task = Task(scene, line, SMALL, silent)
    gauge = Gauge(task)
    finer = assemble(scene, line, mesh(scene, line, scene.seabed_under(line), 3))
    true = gauge.values(follow_line(scene, finer).results)
    for accuracy in found.accuracies:
        row = found.fastest(accuracy, lambda series: series.in_deck)
        lines = found.deck_lines(accuracy, row.setting)
        start, rest = CASE_B.split("*LINE")
        again, meshed = read(folder, f"{start}{lines}\n*END{rest.split('*END')[1]}")
        solved = solve_line(again, meshed)
        assert again.numerics.accuracy == accuracy
        assert solved.model.elements == row.setting.elements
        assert gauge.errors(gauge.values(solved.results), true).largest <= accuracy


def test_errors_are_over_the_largest_value_of_any_state_and_the_length(riser):
    gauge = Gauge(Task(*riser, SMALL, silent))
    true = tuple(np.array(v) for v in ([[4.0, -8.0]], [[0.0, 0.0]], [500.0, 400.0], [2.0, 5.0]))
    off = tuple(np.array(v) for v in ([[4.4, -8.0]], [[0.0, 0.0]], [500.0, 404.0], [2.1, 5.0]))
    found = gauge.errors(off, true)
    expected = {"tension": 0.05, "moment": 0.0, "touchdown": 4.0 / 1635.0, "reaction": 0.02}
    assert found.parts == pytest.approx(expected)
    assert found.largest == found.tension


# --- what fails, and what there is no time for ---------------------------


def test_without_time_the_coarsest_of_each_is_measured_and_the_rest_named(riser):
    plan = replace(SMALL, accuracies=(1e-2, 1e-6), seconds=0.0)
    found = charted_line(*riser, plan, silent)
    every = {series: [r.setting.elements for r in rows] for series, rows in found.series().items()}
    own = [33, 65, 130]  # those that the program has tried anyway among them
    assert every == {GRADED: own, EVEN: [64], GRADED_NODAL: [33], EVEN_NODAL: [64]}
    assert found.choices[0].errors
    assert found.choices[1].failure == "left out, for time"
    assert not found.sure
    text = chart_report(found)
    assert "errors near it are not sure" in text.replace("\n  ", " ")
    left_out = text.partition("left out, for time\n")[2].partition("\n\n")[0]
    assert sorted(left_out.splitlines()) == [
        "  even, integrated, 130, 260 elements",
        "  even, nodal, 130, 260 elements",
        "  graded, integrated, 260 elements",
        "  graded, nodal, 65, 130, 260 elements",
    ]
    assert "automatic choice: failed, left out, for time" in text
    (automatic,) = (line for line in text.splitlines() if line.startswith("automatic "))
    assert automatic.endswith(" failed")


def test_a_setting_that_finds_no_equilibrium_is_a_row_with_its_reason(riser, monkeypatch):
    def stopped(scene, model):
        found = follow_line(scene, model)
        nodal = scene.seabed_contacts[0].form == "nodal"
        return replace(found, failure="step 1 stops at 0.5 of it: no") if nodal else found

    monkeypatch.setattr(line_measure, "follow_line", stopped)
    found = charted_line(*riser, SHORT, silent)
    good, bad = found.rows
    assert good.errors
    assert (bad.errors, bad.seconds) == (None, None)
    assert "even, nodal, 64 elements: step 1 stops at 0.5 of it: no" in chart_report(found)


def test_a_line_that_stops_has_no_chart(riser, monkeypatch):
    def stopped(scene, model):
        return replace(follow_line(scene, model), failure="step 1 stops at 0.5 of it: no")

    monkeypatch.setattr(line_measure, "follow_line", stopped)
    with pytest.raises(AnalysisFailed, match=r"(?s)L1, 130 elements: step 1.*no chart: every step"):
        charted_line(*riser, SHORT, silent)


# --- what is shown ---------------------------


def test_the_report_fits_a_terminal_and_has_every_series(found):
    text = chart_report(found)
    assert all(len(line) <= 80 for line in text.splitlines())
    assert text.startswith("The riser of table 05, case B\nL1: speed against accuracy, 1 step, 14")
    table = [line[:26].strip() for line in text.splitlines()]
    for name in ("graded, integrated", "even, integrated", "graded, nodal", "even, nodal"):
        assert name in table
    for accuracy in found.accuracies:
        row = found.fastest(accuracy, lambda series: series.in_deck)
        lines = found.deck_lines(accuracy, row.setting).splitlines()
        assert "\n".join(f"    {line}" for line in lines) in text
    assert "in place of its own *ACCURACY and *LINE" in text


def test_the_csv_holds_every_setting_and_choice(found):
    lines = [x for x in chart_csv(found).splitlines() if not x.startswith("#")]
    rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
    assert len(rows) == len(found.rows) + len(found.choices)
    for row, cells in zip((*found.rows, *found.choices), rows, strict=True):
        assert None not in cells.values()
        assert (cells["lengths"], cells["reaction"]) == row.setting.series.cells
        for name, value in row.errors.parts.items():
            assert float(cells[f"error of {name}"]) == value
        assert float(cells["error"]) == max(row.errors.parts.values())
    assert "# Line: L1" in chart_csv(found)


def test_what_stands_in_the_picture(found, tmp_path):
    figure = draw_chart(found, "case")
    for axes, part in zip(figure.axes, ("moment", "tension"), strict=True):
        assert part in axes.get_xlabel()
        named = {line.get_label(): line for line in axes.lines}
        for series, rows in found.series().items():
            x, y = named[series.name].get_data()
            assert list(x) == [row.errors.part(part) for row in rows]
            assert list(y) == pytest.approx([1e3 * row.seconds for row in rows])
    figure.draw_without_rendering()
    box = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert box.min() >= 0.0
    assert box.max() <= 1.0
    assert save_chart(found, tmp_path, "case").name == "case_L1_chart.png"


# --- the command ---------------------------


@pytest.fixture
def short_plans(monkeypatch):
    """Few settings in place of all, of lines and of foundations."""
    import podeep.study.measure as measure

    monkeypatch.setattr(line_measure, "QUICK", SHORT)
    few = Plan((Setting(Series(5), 6),), 1, 60.0)
    monkeypatch.setattr(measure, "plan", lambda model, *, quick: few)


def both() -> str:
    """A deck with a pile and a line."""
    pile = (DECKS / "base.deck").read_text(encoding="utf-8").replace("*EXEC", "")
    line = CASE_B[CASE_B.index("*LINE") :].replace("\n1 ", "\n11 ").replace("\n0 1 3", "\n0 11 3")
    return pile + line.replace("-1000.029", "-60.029").replace("1635", "1000")


@pytest.mark.usefixtures("short_plans")
def test_a_deck_of_lines_is_charted(tmp_path, capsys):
    read(tmp_path, CASE_B)
    deck = str(tmp_path / "riser.deck")
    assert main(["chart", deck, "--quick", "-o", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "L1: speed against accuracy, 1 step, 2 settings" in out
    assert (tmp_path / "riser_L1_chart.png").read_bytes().startswith(b"\x89PNG")
    in_motion = "*MOTION\n1 2\nZ 2.5 12 90\n*DYNAMIC\n0 60\n*EXEC"
    read(tmp_path, CASE_B.replace("*EXEC", in_motion))  # the chart is of its statics
    assert main(["chart", deck, "--quick", "--csv", "--line", "L1"]) == 0
    assert len([x for x in capsys.readouterr().out.splitlines() if x[:1] != "#"]) == 1 + 2 + 1


@pytest.mark.usefixtures("short_plans")
def test_a_deck_of_both_has_two_charts(tmp_path, capsys):
    _, line = read(tmp_path, both())
    deck = str(tmp_path / "riser.deck")
    assert main(["chart", deck, "--quick", "-o", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "\nF1: speed" in out
    assert f"\nL{line.id}: speed" in out
    assert len(list(tmp_path.glob("*.png"))) == 2
    assert main(["chart", deck, "--quick", "--foundation", "F1"]) == 0
    assert f"L{line.id}: speed" not in capsys.readouterr().out
    assert main(["chart", deck, "--quick", "--csv"]) == 2
    told = capsys.readouterr().err
    assert f"give --foundation F1 or --line L{line.id}" in told


def test_faults_of_usage(tmp_path, capsys):
    read(tmp_path, CASE_B)
    deck = str(tmp_path / "riser.deck")
    for options, words in (
        ([deck, "--line", "L7"], "no line L7; the deck has L1"),
        ([deck, "--foundation", "F1"], "lines alone (L1): this is of foundations"),
        ([str(DECKS / "base.deck"), "--line", "L1"], "the deck has no line; lines are those of"),
        (["--stability", "--line", "L1"], "--stability is of no deck"),
    ):
        assert main(["chart", *options]) == 2
        assert words in capsys.readouterr().err
    read(tmp_path, CASE_B.replace("*EXEC", "*MOTION\n1 1\nRY 5\n*QUASISTATIC\n1 L1E1 1\n*EXEC"))
    assert main(["chart", deck]) == 2
    assert "turn" in capsys.readouterr().err
