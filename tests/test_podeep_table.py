"""Tables: what they say, that they line up, and that CSV loses nothing."""

import csv
from dataclasses import replace
from io import StringIO

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fields import Foundation
from podeep.query import Origin, envelope, snapshot, step_evolution
from podeep.table import csv_table, heading, text_table
from podeep.units import coordinates, number_format

ORIGIN = Origin("run.dss", "static", "A pile", "F1", -30.0, "x")
DYNAMIC = replace(ORIGIN, database="run.dst", database_kind="dynamic")
DEPTH = np.linspace(0.0, 30.0, 31)


def data(axis=None):
    fields = {
        "lateral_force": lambda a, z: 1000.0 * a * (10.0 - z),
        "axial_displacement": lambda a, z: 1e-3 * a / (1.0 + z),
        "axial_strain": lambda a, z: -1e-3 * a / (1.0 + z) ** 2,
    }
    return Foundation(fields, DEPTH, np.arange(4) if axis is None else axis)


def test_a_step_evolution_reads_like_this():
    curves = step_evolution(data(), "lateral_force", np.array([0.0, 2.5, 20.0]))
    assert text_table(curves, ORIGIN).splitlines() == [
        "Database    run.dss (static)",
        "Title       A pile",
        "Foundation  F1, mudline at -30 m",
        "Analysis    Step evolution",
        "Result      Lateral force (kN/m), positive against displacement along x",
        "Depths      0 to 20 m below the mudline, 3 points",
        "Steps       0 to 3, 4 steps",
        "",
        "      depth (m)",
        "step      0.0      2.5      20.0",
        "----  -------  -------  --------",
        "   0   0.0000   0.0000    0.0000",
        "   1  10.0000   7.5000  -10.0000",
        "   2  20.0000  15.0000  -20.0000",
        "   3  30.0000  22.5000  -30.0000",
    ]


def test_a_snapshot_has_a_row_for_each_depth_and_a_column_for_each_time():
    curves = snapshot(data(np.array([0.0, 4.0])), "lateral_force", np.array([0.0, 20.0]), [1, 2.5])
    assert text_table(curves, DYNAMIC).splitlines()[6:] == [
        "Times       1 to 2.5 s, 2 times",
        "",
        "           time (s)",
        "depth (m)       1.0       2.5",
        "---------  --------  --------",
        "        0   10.0000   25.0000",
        "       20  -10.0000  -25.0000",
    ]


def test_an_envelope_tells_when_each_extreme_was():
    curves = envelope(data(np.array([0.0, 0.5])), "lateral_force", np.array([0.0, 20.0]))
    assert text_table(curves, DYNAMIC).splitlines()[6:] == [
        "",
        "depth (m)   minimum  at time (s)  maximum  at time (s)",
        "---------  --------  -----------  -------  -----------",
        "        0   0.00000          0.0  5.00000          0.5",
        "       20  -5.00000          0.5  0.00000          0.0",
    ]


@given(st.integers(2, 10), st.integers(2, 30), st.floats(1e-12, 1e12))
def test_no_table_is_wider_than_80_characters_and_all_columns_line_up(points, steps, size):
    fields = {"axial_force": lambda a, z: size * np.sin(1.0 + a * z)}
    many = Foundation(fields, DEPTH, np.arange(steps))
    curves = step_evolution(many, "axial_force", np.linspace(0.0, 29.7, points))
    table = text_table(curves, replace(ORIGIN, title="word " * 40))
    assert max(map(len, table.splitlines())) <= 80
    shown = 0
    for block in table.split("\n\n")[1:]:
        _, header, rule, *rows = block.splitlines()
        assert {len(line) for line in (header, rule, *rows)} == {len(header)}
        assert len(rows) == steps
        shown += len(rule.split()) - 1
    assert shown == points


@given(st.floats(-1e150, 1e150))
def test_csv_loses_no_bit(size):
    fields = {"axial_force": lambda a, z: size * np.cos(a * z)}
    foundation = Foundation(fields, DEPTH, np.arange(3))
    curves = step_evolution(foundation, "axial_force", np.linspace(0.0, 30.0, 7))
    lines = [x for x in StringIO(csv_table(curves, ORIGIN)) if not x.startswith("#")]
    header, *rows = csv.reader(lines)
    assert header[0] == "step"
    depths = [float(h.removeprefix("axial_force [N/m] at depth ")[:-2]) for h in header[1:]]
    assert depths == curves.points.tolist()
    assert [[float(x) for x in row[1:]] for row in rows] == curves.values.tolist()


def test_csv_names_columns_and_si_units():
    static, dynamic = data(), data(np.array([0.0, 0.5]))
    z = np.array([0.0, 20.0])
    lines = csv_table(snapshot(static, "lateral_force", z, [3]), ORIGIN).splitlines()
    assert lines == [
        "# Database: run.dss (static)",
        "# Title: A pile",
        "# Foundation: F1, mudline at -30 m",
        "# Analysis: Snapshot",
        "# Result: Lateral force (N/m), positive against displacement along x",
        "# Depths: 0 to 20 m below the mudline, 2 points",
        "# Step: 3",
        "depth [m],lateral_force [N/m] at step 3",
        "0.0,30000.0",
        "20.0,-30000.0",
    ]
    assert csv_table(envelope(dynamic, "lateral_force", z), DYNAMIC).splitlines()[-3:] == [
        "depth [m],minimum lateral_force [N/m],time [s] of minimum,"
        "maximum lateral_force [N/m],time [s] of maximum",
        "0.0,0.0,0.0,5000.0,0.5",
        "20.0,-5000.0,0.5,-0.0,0.0",
    ]


@pytest.mark.parametrize(
    ("direction", "quantity", "words"),
    [
        ("x", "axial_displacement", "positive down"),
        (None, "lateral_force", "magnitude"),
        ("30 degrees from x", "lateral_force", "against displacement along 30 degrees from x"),
    ],
)
def test_the_header_says_which_way_is_positive(direction, quantity, words):
    curves = snapshot(data(), quantity, np.array([1.0]), [1])
    assert dict(heading(curves, replace(ORIGIN, direction=direction)))["Result"].endswith(words)


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ([[0.0, -0.0]], ["0.0", "0.0"]),
        ([[1.0, -123.4567891]], ["1.000", "-123.457"]),
        ([[0.05123456, -1e-9]], ["0.0512346", "0.0000000"]),
        ([[0.5, 0.25], [1e-5, 0.0]], ["5.00000e-01", "2.50000e-01"]),
        ([[0.5, 0.25], [1e-17, 0.0]], ["0.500000", "0.250000"]),
        ([[1.5e-7, 1e-7]], ["1.50000e-07", "1.00000e-07"]),
        ([[1.5e9, 1.0]], ["1.50000e+09", "1.00000e+00"]),
        ([[123456789.0, 1.0]], ["123456789", "1"]),
    ],
)
def test_one_notation_for_all_values_of_a_table(values, shown):
    show = number_format(np.array(values))
    assert [show(x) for x in values[0]] == shown


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ([0.0, 10.0, 30.0], ["0", "10", "30"]),
        ([0.0, 2.5], ["0.0", "2.5"]),
        ([0.0, 10.0 / 3.0], ["0.00000", "3.33333"]),
        ([1200.004], ["1200"]),
        ([0.1 + 0.2, 55.400000000000006], ["0.3", "55.4"]),
        ([0.0], ["0"]),
    ],
)
def test_coordinates_have_no_more_decimals_than_they_need(values, shown):
    assert coordinates(values) == shown
