"""What a chart of motion shows: the best of all, words, CSV, a picture, the command."""

import csv
import io
from dataclasses import replace
from pathlib import Path

import pytest

from podeep.cli.solve import main
from podeep.motion import Dynamics
from podeep.study import measure, motion_measure
from podeep.study.chart import Setting
from podeep.study.motion_chart import (
    MotionChart,
    MotionChoice,
    MotionErrors,
    MotionReference,
    MotionRow,
)
from podeep.study.motion_figure import draw_motion_chart, save_motion_chart
from podeep.study.motion_report import motion_csv, motion_report
from podeep.study.motion_settings import MotionPlan, MotionSeries, MotionSetting
from podeep.study.settings import Plan, Series

SAMPLES = Path(__file__).parents[1] / "sample_dbs"
DECK = SAMPLES / "swaying_pile.deck"


def row(method, accuracy: float, n: int, error: float, seconds: float) -> MotionRow:
    setting = MotionSetting(MotionSeries(method, accuracy), 4.0 / n)
    errors = MotionErrors(error, 0.5 * error)
    return MotionRow(setting, 17, 5, 2 * n, 5 * n, 6 * n, errors, seconds, 3)


def drawn_data(**more) -> MotionChart:
    """A chart without measuring: two methods, two accuracies, one failure, one cut."""
    rows = [
        row(method, accuracy, n, error / n**2, seconds * n)
        for method, error, seconds in (("NEWMARK", 40.0, 1e-3), ("BATHE", 10.0, 2.5e-3))
        for accuracy, rates in ((1e-2, (20, 40, 80)), (1e-3, (80, 160, 320)))
        for n in rates
    ]
    lost = MotionRow(MotionSetting(MotionSeries("ROS2", 1e-2), 0.4), 17, 5, 20, failure="no more")
    choices = [
        MotionChoice(a, row("HHT", a, n, 20.0 / n**2, 1e-3 * n), 0.3 * a, 0.9)
        for a, n in ((1e-2, 150), (1e-3, 480))
    ]
    choices.append(MotionChoice(1e-4, failure="left out, for time"))
    references = (
        MotionReference(1e-2, 17, 5, 3e-3, 2e-4, MotionErrors(2e-4, 1e-4)),
        MotionReference(1e-3, 17, 5, 1.5e-3, 4e-5),
        MotionReference(1e-4, 18, 5, 1.5e-3, 3e-5),
    )
    given = MotionChart(
        "a pile",
        "F1",
        Dynamics(0.0, 60.0),
        "HHT",
        8.0,
        4.0,
        "machine",
        references,
        8.3e-6,
        (MotionSeries("NEWMARK", 1e-4), MotionSeries("BATHE", 1e-4)),
        (*rows, lost),
        tuple(choices),
    )
    return replace(given, **more)


def test_the_fastest_is_on_the_mesh_of_its_accuracy_with_all_shorter_steps():
    found = drawn_data()
    fastest = found.fastest(1e-2)
    assert fastest
    assert (fastest.setting.series.method, found.rate(fastest)) == ("NEWMARK", 80)
    other = found.fastest(1e-2, "BATHE")
    assert other
    assert found.rate(other) == 40
    assert found.fastest(1e-4) is None
    astray = [row("HHT", 1e-2, n, e, 1e-3 * n) for n, e in ((10, 5e-3), (20, 2e-2), (40, 9e-3))]
    by_accident = drawn_data(rows=tuple(astray)).fastest(1e-2)
    assert by_accident
    assert by_accident.steps == 80  # 10 in a period is so by accident


def test_nothing_beats_a_row_of_the_front():
    found = drawn_data()
    for method in (None, "BATHE"):
        front = found.front(method)
        assert front
        rows = [r for r in found.rows if method in (None, r.setting.series.method) and r.errors]
        for one in front:
            for other in rows:
                assert one.errors
                assert other.errors
                beaten = other.errors.largest <= one.errors.largest
                assert not (beaten and (other.seconds or 0.0) < (one.seconds or 0.0))


def test_the_report_fits_a_terminal_and_names_all():
    text = motion_report(drawn_data())
    lines = text.splitlines()
    assert all(len(line) <= 80 for line in lines)
    assert "in motion, the first 8 s of 60 s, 13" in text
    assert "\nmedians of 3 runs\n" in text
    table = {line.split()[0]: line.split()[1:] for line in lines if line[:1].isupper()}
    assert table["NEWMARK"] == ["80", "(80)", "320", "(320)", "-"]
    assert table["BATHE"] == ["100", "(40)", "400", "(160)", "-"]
    assert table["ROS2"] == ["-", "-", "-"]
    assert "automatic          900 (150)       900 (480)          failed" in text
    assert "    *ACCURACY\n    0.01\n    *DYNAMIC, METHOD=NEWMARK\n    0 60 0.05\n" in text
    words = " ".join(text.split())
    assert "error 2.0e-04; the mesh adds 2.0e-04" in words
    assert "error 3.0e-05, more than 0.1 of 1e-04: errors near it are not sure" in words
    assert "CENTRAL is stable with steps up to 0.0083 ms alone: it is not measured" in words
    assert "failed\n  ROS2, steps of 400 ms: no more" in text
    assert "shorter steps left out, for time\n  1e-04: NEWMARK, BATHE" in text
    assert "1e-04: no method and step that were measured reach it\n  automatic choice: left" in text


def test_the_csv_holds_every_setting_and_choice():
    for found in (drawn_data(), drawn_data(title="", period=None)):
        lines = [x for x in motion_csv(found).splitlines() if not x.startswith("#")]
        cells = list(csv.DictReader(io.StringIO("\n".join(lines))))
        assert len(cells) == len(found.rows) + len(found.choices)
        for one, line in zip((*found.rows, *found.choices), cells, strict=True):
            assert None not in line.values()
            assert line["status"] == ("solved" if one.errors else "failed")
            assert line["reason"] == one.failure
            if one.errors:
                assert float(line["error"]) == one.errors.largest
        for one, line in zip(found.rows, cells, strict=False):
            assert line["method"] == one.setting.series.method
            assert float(line["step [s]"]) == one.setting.step
            rate = line["steps in the shortest period"]
            assert rate == ("" if found.period is None else str(found.rate(one)))
        assert sum(x["on the front"] == "yes" for x in cells) == len(found.front())


def test_what_stands_in_the_picture():
    found = drawn_data()
    figure = draw_motion_chart(found, "case")
    (axes,) = figure.axes
    assert axes.get_xscale() == axes.get_yscale() == "log"
    named = {line.get_label(): line for line in axes.lines}
    front = found.front("NEWMARK")
    x, y = named["NEWMARK"].get_data()
    assert list(x) == [r.errors.largest for r in front if r.errors]
    assert list(y) == pytest.approx([1e3 * (r.seconds or 0.0) for r in front])
    assert "ROS2 (1 failed)" in named
    vertical = {line.get_xdata()[0] for line in axes.lines if line.get_linestyle() == ":"}
    assert {1e-2, 1e-3, 1e-4} <= vertical
    stars = [line for line in axes.lines if line.get_marker() == "*"]
    assert [float(s.get_ydata()[0]) for s in stars] == pytest.approx([900.0, 150.0, 900.0, 480.0])
    assert "NEWMARK,\n80 steps a period" in {text.get_text() for text in axes.texts}
    figure.draw_without_rendering()
    box = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert box.min() >= 0.0
    assert box.max() <= 1.0


def test_the_picture_of_the_same_data_has_the_same_bytes(tmp_path):
    first, again = (save_motion_chart(drawn_data(), tmp_path, "case") for _ in range(2))
    assert (first.name, again.name) == ("case_F1_motion_chart.png", "case_F1_motion_chart_2.png")
    assert first.read_bytes() == again.read_bytes()


def test_a_chart_without_one_solved_setting_is_drawn():
    draw_motion_chart(
        drawn_data(rows=drawn_data().rows[-1:], choices=drawn_data().choices[2:]), "case"
    )


# --- the command ---------------------------


@pytest.fixture
def short_plan(monkeypatch):
    """Two settings in place of all."""
    few = MotionPlan(("NEWMARK",), 20, 40, 2.0, 320, 1, 1, accuracies=(1e-2,))
    for name in ("FULL", "QUICK"):
        monkeypatch.setattr(motion_measure, name, few)


@pytest.mark.usefixtures("short_plan")
def test_a_deck_with_motion_is_charted_in_motion(tmp_path, capsys):
    assert main(["chart", str(DECK), "-o", str(tmp_path / "new")]) == 0
    out, err = capsys.readouterr()
    picture = tmp_path / "new" / "swaying_pile_F1_motion_chart.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert out.endswith(f"written: {picture}\n")
    assert "the first 4 s of 60 s, 2 settings" in out
    assert err == ""  # progress is for terminals


@pytest.mark.usefixtures("short_plan")
def test_csv_is_alone_on_standard_output(tmp_path, capsys):
    assert main(["chart", str(DECK), "--quick", "--csv", "-o", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert err.startswith("written: ")
    assert len([x for x in out.splitlines() if not x.startswith("#")]) == 1 + 2 + 1


def test_statics_of_a_deck_with_motion_are_charted_when_asked_for(monkeypatch, capsys):
    few = Plan((Setting(Series(5), 12),), 1, 60.0)
    monkeypatch.setattr(measure, "plan", lambda model, *, quick: few)
    assert main(["chart", str(SAMPLES / "conductor_waves.deck"), "--statics"]) == 0
    out = capsys.readouterr().out
    assert "speed against accuracy, 1 step, 1 settings" in out
    assert "*DYNAMIC" not in out
