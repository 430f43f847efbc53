"""What podeep-solve chart shows: the best of all, words, CSV, a picture, progress, exit codes."""

import csv
import io
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from podeep.cli.solve import main
from podeep.scene import Numerics
from podeep.study.chart import Chart, Choice, Reference, Row, Setting
from podeep.study.chart_figure import draw_chart, save_chart
from podeep.study.chart_report import chart_csv, chart_report
from podeep.study.settings import (
    PRESETS,
    WORDS,
    Errors,
    Plan,
    Series,
    deck_lines,
)

JACKET = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"
LUMPED, SPATIAL = Series(3, "lumped"), Series(5, spatial=True)
PLAIN = Numerics()


def silent(_: str) -> None:
    """Hear nothing."""


def reference(error: float) -> Reference:
    return Reference(256, 7, Errors(error, 0.0, 0.0))


def drawn_data(numerics: Numerics = PLAIN, **more) -> Chart[Series]:
    """A chart without measuring: two series and one failure."""
    rows = [
        Row(
            Setting(series, n),
            5 * n,
            30,
            40,
            0.01,
            Errors(error / n**2, 0.5 * error / n**2, 0.0),
            seconds * n,
            3,
        )
        for series, error, seconds in ((Series(5), 1e-2, 1e-4), (LUMPED, 1.0, 5e-5))
        for n in (4, 8, 16, 32)
    ]
    rows.append(Row(Setting(Series(5, method="full steps"), 8), failure="step 2, lateral: no"))
    one = Errors(2e-4, 1e-4, 0.0)
    own = Setting(Series(5), 18)
    choices = [Choice(a, own, 3e-4, one, 0.05, 0.002, 3) for a in PRESETS[:3]]
    choices.append(Choice(PRESETS[3], failure="step 1, axial: no"))
    given = Chart(
        *("a pile", "F1", WORDS, partial(deck_lines, numerics), 6, "machine", reference(5e-8)),
        *(tuple(rows), tuple(choices)),
    )
    return replace(given, **more)


def test_the_fastest_is_within_the_error_on_all_finer_meshes():
    rows = [
        Row(Setting(Series(3), n), errors=Errors(error, 0.0, 0.0), seconds=n * 1e-3)
        for n, error in ((4, 5e-3), (8, 2e-2), (16, 9e-3), (32, 1e-3))
    ]
    found = drawn_data(rows=tuple(rows))
    fastest = found.fastest(1e-2, Series(3).__eq__)
    assert fastest
    assert fastest.setting.elements == 16  # 4 is so by accident
    assert found.fastest(1e-4, Series(3).__eq__) is None
    assert found.fastest(1e-2, Series(7).__eq__) is None


def test_nothing_beats_a_row_of_the_front():
    found = drawn_data()
    front = found.front()
    assert front
    for row in front:
        assert row.errors
        assert row.seconds
        for other in found.rows:
            if other.errors and other.seconds:
                beaten = other.errors.largest <= row.errors.largest and other.seconds < row.seconds
                assert not beaten


# --- what is shown ---------------------------


def test_the_report_fits_a_terminal_and_names_all():
    found = drawn_data(numerics=Numerics(second_order=True, shear=True, axial_curves=False))
    text = chart_report(found)
    assert all(len(line) <= 80 for line in text.splitlines())
    assert "\nmedians of 3 runs\n" in text
    table = [line for line in text.splitlines() if line.startswith(("degree", "lumped"))]
    assert len(table) == len(found.series()) == 3
    assert table[0].split() == ["degree", "5", *["0.4", "(4)"] * 2, "1.6", "(16)", "3.2", "(32)"]
    assert table[1].split() == ["lumped", "0.8", "(16)", "1.6", "(32)", "-", "-"]
    for preset in PRESETS:
        row = found.fastest(preset, lambda series: series.in_deck)
        assert row
        lines = found.deck_lines(preset, row.setting).splitlines()
        assert "\n".join(f"    {line}" for line in lines) in text


def test_the_report_of_failures_and_of_what_is_not_reached():
    text = chart_report(drawn_data(reference=reference(5e-6)))
    assert "more than 0.01 of 1e-05" in " ".join(text.split())
    assert "failed\n  degree 5, full steps, 8 elements: step 2, lateral: no" in text
    assert "automatic choice: failed, step 1, axial: no" in text
    assert "1e-05: 32 elements of degree 5" in text
    rows = drawn_data().rows[4:]
    none = chart_report(drawn_data(rows=rows))
    assert (
        "1e-03: no ELEMENTS and ORDER that were measured reach it\n    *ACCURACY\n    0.001\n"
        in none
    )
    assert "1e-04: no ELEMENTS and ORDER that were measured reach it\n  automatic" in none


def test_the_csv_holds_every_setting_and_choice():
    for found in (drawn_data(), drawn_data(title="")):
        lines = [x for x in chart_csv(found).splitlines() if not x.startswith("#")]
        rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
        assert len(rows) == len(found.rows) + len(found.choices)
        for row, cells in zip((*found.rows, *found.choices), rows, strict=True):
            assert None not in cells.values()
            assert cells["status"] == ("solved" if row.errors else "failed")
            assert cells["reason"] == row.failure
            if row.errors:
                assert float(cells["error"]) == row.errors.largest
                assert float(cells["CPU time [s]"]) == row.seconds
        front = [x for x in rows if x["on the front"] == "yes"]
        assert len(front) == len(found.front())


def test_what_stands_in_the_picture():
    found = drawn_data()
    figure = draw_chart(found, "case")
    (axes,) = figure.axes
    assert axes.get_xscale() == axes.get_yscale() == "log"
    named = {line.get_label(): line for line in axes.lines}
    x, y = named["degree 5"].get_data()
    assert list(x) == [r.errors.largest for r in found.rows[:4] if r.errors]
    assert list(y) == pytest.approx([1e3 * (r.seconds or 0.0) for r in found.rows[:4]])
    assert "degree 5, full steps (1 failed)" in named
    vertical = {line.get_xdata()[0] for line in axes.lines if line.get_linestyle() == ":"}
    assert set(PRESETS) <= vertical
    stars = [line for line in axes.lines if line.get_marker() == "*"]
    assert [float(s.get_ydata()[0]) for s in stars] == pytest.approx([50.0, 2.0])
    assert "1e-2, 1e-3, 1e-4" in {text.get_text() for text in axes.texts}
    figure.draw_without_rendering()
    box = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert box.min() >= 0.0
    assert box.max() <= 1.0


def test_the_picture_of_the_same_data_has_the_same_bytes(tmp_path):
    first, again = (save_chart(drawn_data(), tmp_path, "case") for _ in range(2))
    assert (first.name, again.name) == ("case_F1_chart.png", "case_F1_chart_2.png")
    assert first.read_bytes() == again.read_bytes()


def test_a_chart_without_one_solved_setting_is_drawn():
    rows = (Row(Setting(LUMPED, 8), failure="not offered"),)
    draw_chart(drawn_data(rows=rows, choices=drawn_data().choices[3:]), "case")


# --- the command ---------------------------


@pytest.fixture
def short_plan(monkeypatch):
    """A plan of two settings in place of the whole one."""
    import podeep.study.measure as measure

    few = Plan((Setting(Series(5), 6), Setting(LUMPED, 12)), 2, 60.0)
    monkeypatch.setattr(measure, "plan", lambda model, *, quick: few)


@pytest.mark.usefixtures("short_plan")
def test_the_command_writes_table_and_picture(tmp_path, capsys):
    assert main(["chart", str(JACKET), "-o", str(tmp_path / "new")]) == 0
    out, err = capsys.readouterr()
    picture = tmp_path / "new" / "jacket_pile_F1_chart.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert out.endswith(f"written: {picture}\n")
    assert "automatic choice: 18 elements of degree 5" in out
    assert err == ""  # progress is for terminals


@pytest.mark.usefixtures("short_plan")
def test_csv_for_other_programs_is_alone_on_standard_output(tmp_path, capsys):
    assert main(["chart", str(JACKET), "--quick", "--csv", "-o", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert err.startswith("written: ")
    assert len([x for x in out.splitlines() if not x.startswith("#")]) == 1 + 2 + 4


@pytest.mark.usefixtures("short_plan")
def test_progress_shows_on_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert main(["chart", str(JACKET)]) == 0
    err = capsys.readouterr().err
    assert "timing, run 2 of 2" in err
    assert err.endswith("\r\x1b[K")


def test_faults_of_usage(tmp_path, capsys):
    assert main(["chart", str(JACKET), "--foundation", "F7"]) == 2
    assert "no foundation F7; the deck has F1" in capsys.readouterr().err
    taken = tmp_path / "file"
    taken.write_text("")
    assert main(["chart", str(JACKET), "-o", str(taken)]) == 2
    assert "is no folder for results" in capsys.readouterr().err


def test_an_interruption_ends_the_chart(monkeypatch, capsys):
    import podeep.study.measure as measure

    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(measure, "converged", stop)
    assert main(["chart", str(JACKET)]) == 130
    assert "interrupted" in capsys.readouterr().err
