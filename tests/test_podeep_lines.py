"""Podeep over a line: its questions, its queries, its tables and its pictures."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import risers
from fields import Foundation
from podeep.database.read import open_database
from podeep.figure import draw
from podeep.query import Origin, envelope, snapshot, spread, step_evolution
from podeep.session.flow import Source
from podeep.session.points import Extent
from podeep.subject import LINE
from podeep.table import csv_table, heading, text_table
from test_podeep_figure import axes_of, levels
from test_podeep_questions import EXTENT, refusal, session

ORIGIN = Origin("run.dss", "static", "A riser", "L1", -80.0, None, LINE)
LINE_EXTENT = Extent((0.0, 160.0), np.arange(6), LINE)
RISER = Source("static", {"L1": LINE_EXTENT})
MOVING = Source("dynamic", {"L1": Extent((0.0, 160.0), np.linspace(0.0, 60.0, 601), LINE)})
BOTH = Source("static", {"F1": EXTENT, "L1": LINE_EXTENT})


def data(quantity, field):
    distances = np.linspace(0.0, 160.0, 81)
    return Foundation(
        {quantity: field}, distances, np.arange(4), layer_boundaries=np.empty(0), subject=LINE
    )


@pytest.mark.parametrize(
    ("signs", "quantity"),
    [
        ("l1L", "lateral_displacement"),
        ("f2F", "lateral_force"),
        ("a3A", "axial_displacement"),
        ("r4R", "axial_force"),
        ("p6P", "penetration"),
        ("n7N", "normal_reaction"),
        ("e8E", "effective_tension"),
        ("b9B", "bending_moment"),
    ],
)
def test_a_sign_means_the_same_of_lines_and_foundations_static_and_dynamic(signs, quantity):
    for sign in signs:
        for source, start, end in ((RISER, "g\nf", "0 9 2 0"), (MOVING, "h\nt", "0 9 2")):
            requests, _ = session(f"{start}\n{sign}\n{end}\n", source)
            assert [(r.name, r.quantity) for r in requests] == [("L1", quantity)]


@pytest.mark.parametrize("sign", ["5", "o"])
def test_other_keeps_its_signs(sign):
    for source, start in ((RISER, "g\nf"), (MOVING, "h\nf")):
        _, out = session(f"{start}\n{sign}\nq\n", source)
        assert out.count("Step evolution <t>") == 2


@pytest.mark.parametrize("sign", ["p", "n", "e", "b", "6", "7", "8", "9"])
def test_a_foundation_has_no_results_across_the_seabed(sign):
    assert f"'{sign}' is not one of l, f, a, r, o, q" in refusal(f"g\nF1\nf\n{sign}", BOTH)


def test_the_questions_speak_of_distances():
    requests, out = session("g\nf\np\n120 0 4 5\n", RISER)
    assert requests[0].points.tolist() == [0.0, 40.0, 80.0, 120.0]
    assert (
        "> p\nDistances from 0 to 160 m\nFirst distance along the line (m): 120\n"
        "Second distance along the line (m): 0\nNumber of calculation points: 4\n"
    ) in out
    assert "depth" not in out.lower()


@pytest.mark.parametrize(
    ("answers", "reason", "asked"),
    [
        ("161", "161 m is outside 0 to 160 m", "First distance along the line (m)"),
        ("0 -1", "-1 m is outside 0 to 160 m", "Second distance along the line (m)"),
        ("9 9 5", "5 is not 1, and the two distances are equal", "Number of calculation points"),
        ("0 9 11", "11 is outside 2 to 10", "Number of calculation points"),
    ],
)
def test_the_limits_are_those_of_depths(answers, reason, asked):
    assert refusal(f"g\nt\nn\n{answers}", RISER) == f"answers.txt:4: {reason}\n  asked: {asked}:"


@pytest.mark.parametrize(
    ("names", "what"),
    [
        (("F1", "F2"), "Foundation (F1, F2)"),
        (("L1", "L2"), "Line (L1, L2)"),
        (("L1", "F1"), "Foundation or line (L1, F1)"),
    ],
)
def test_one_question_chooses_between_foundations_and_lines(names, what):
    extents = {name: EXTENT if name[0] == "F" else LINE_EXTENT for name in names}
    requests, out = session(f"g\n{names[1].lower()}\nf\nl\n0 9 2 0\n", Source("static", extents))
    assert f"> g\n{what}: {names[1].lower()}\n" in out
    assert requests[0].name == names[1]


def test_a_result_along_a_line_is_straight_between_its_points():
    bent = data("axial_displacement", lambda a, s: a * s**2)
    s = np.array([0.0, 1.0, 2.0, 159.0])
    values = snapshot(bent, "axial_displacement", s, [3.0]).values[0]
    assert_allclose(values, 3.0 * np.interp(s, bent.points, bent.points**2), rtol=1e-14)


def test_a_riser_in_a_file_is_read_between_its_points_and_steps(tmp_path):
    path = risers.dynamic_database(tmp_path / "run.dst", times=np.array([0.0, 1.0, 3.0]))
    a = risers.amplitude("dynamic", np.array([1.0, 3.0]))
    written = risers.riser(np.array([70.0, 72.0]), a)["penetration"]
    with open_database(path) as database:
        curves = snapshot(database.line("L1"), "penetration", np.array([70.5]), [1.5])
    half = written @ [0.75, 0.25]
    assert_allclose(curves.values, [[0.75 * half[0] + 0.25 * half[1]]], rtol=1e-14)


def test_a_table_of_a_line_reads_like_this():
    hung = data("penetration", lambda a, s: 0.01 - a * np.maximum(s - 60.0, 0.0))
    curves = step_evolution(hung, "penetration", np.array([0.0, 60.0, 64.0]))
    assert text_table(curves, ORIGIN).splitlines() == [
        "Database    run.dss (static)",
        "Title       A riser",
        "Line        L1, mudline at -80 m",
        "Analysis    Step evolution",
        "Result      Normal displacement (m), penetration, positive into the seabed",
        "Distances   0 to 64 m from end 1, 3 points",
        "Steps       0 to 3, 4 steps",
        "",
        "      distance (m)",
        "step       0      60        64",
        "----  ------  ------  --------",
        "   0  0.0100  0.0100    0.0100",
        "   1  0.0100  0.0100   -3.9900",
        "   2  0.0100  0.0100   -7.9900",
        "   3  0.0100  0.0100  -11.9900",
    ]


def test_csv_of_a_line_has_its_distances():
    pushed = data("normal_reaction", lambda a, s: a * 100.0 + 0.0 * s)
    curves = snapshot(pushed, "normal_reaction", np.array([0.0, 1.5]), [2])
    assert csv_table(curves, ORIGIN).splitlines()[-3:] == [
        "distance [m],normal_reaction [N/m] at step 2",
        "0.0,200.0",
        "1.5,200.0",
    ]
    curves = step_evolution(pushed, "normal_reaction", np.array([1.5]))
    assert "step,normal_reaction [N/m] at distance 1.5 m" in csv_table(curves, ORIGIN)


@pytest.mark.parametrize("quantity", LINE.inner)
def test_tension_and_moment_of_a_riser_in_a_file(tmp_path, quantity):
    path = risers.static_database(tmp_path / "run.dss")
    s = np.array([60.0, 70.0, 100.0])
    with open_database(path) as database:
        curves = snapshot(database.line("L1"), quantity, s, [2.0])
    told = risers.riser(s, risers.amplitude("static", np.array([2])))[f"line/{quantity}"]
    assert_allclose(curves.values, told, rtol=1e-14)
    pair = dict(heading(curves, ORIGIN))
    assert pair["Result"].startswith(("Effective tension (kN), ", "Bending moment (kN m), "))
    assert axes_of(draw(curves, ORIGIN)).get_ylabel() in pair["Result"]


@pytest.mark.parametrize("quantity", LINE.quantities)
def test_every_result_of_a_line_says_which_way_it_counts(quantity):
    stored = LINE.stored(quantity)
    curves = snapshot(data(stored, lambda a, s: a + s), quantity, np.array([1.0]), [1])
    assert "positive" in dict(heading(curves, ORIGIN))["Result"]


def test_a_picture_of_a_line_lies_as_the_line_does():
    rubbed = data("lateral_force", lambda a, s: a * s)
    figure = draw(snapshot(rubbed, "lateral_force", spread(0, 80, 5), [2]), ORIGIN)
    axes = axes_of(figure)
    assert axes.get_xlabel() == "Distance along the line (m)"
    assert axes.get_ylabel() == "Lateral force (kN/m)"
    assert axes.get_title(loc="left") == "run.dss, L1: snapshot at step 2"
    assert axes.lines[0].get_xdata().tolist() == [0.0, 20.0, 40.0, 60.0, 80.0]
    assert not axes.yaxis_inverted()
    assert levels(axes.lines[1:], vertical=False) == [0.0]
    width, height = figure.get_size_inches()
    assert width > 1.5 * height


def test_penetration_runs_downward_and_the_mudline_is_its_zero():
    hung = data("penetration", lambda a, s: 0.01 - a * np.maximum(s - 60.0, 0.0))
    for curves in (
        snapshot(hung, "penetration", spread(0, 80, 5), [2]),
        step_evolution(hung, "penetration", spread(0, 80, 5)),
        envelope(hung, "penetration", spread(0, 80, 5)),
    ):
        figure = draw(curves, ORIGIN)
        axes = axes_of(figure)
        assert axes.yaxis_inverted()
        (mudline,) = [line for line in axes.lines if line.get_label() == "mudline"]
        assert list(mudline.get_ydata()) == [0.0, 0.0]
        assert "mudline" in [text.get_text() for text in figure.legends[0].get_texts()]


def test_an_evolution_of_a_line_names_its_distances():
    figure = draw(
        step_evolution(data("axial_force", lambda a, s: a * s), "axial_force", spread(0, 80, 5)),
        ORIGIN,
    )
    (legend,) = figure.legends
    assert legend.get_title().get_text() == "Distance"
    assert [text.get_text() for text in legend.get_texts()][:2] == ["0 m", "20 m"]


def test_an_envelope_of_a_line_is_a_band_over_its_distances():
    moved = data("axial_force", lambda a, s: a * s)
    axes = axes_of(draw(envelope(moved, "axial_force", spread(0, 80, 5)), ORIGIN))
    (band,) = axes.collections
    corners = {(s, q) for s, q in band.get_paths()[0].vertices.tolist()}
    assert {(0.0, 0.0), (80.0, 0.0), (80.0, 0.24)} <= corners
    assert [line.get_label() for line in axes.lines[:2]] == ["minimum", "maximum"]
