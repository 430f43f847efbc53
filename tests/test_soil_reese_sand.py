"""Sand of Reese, Cox and Koop: no check table exists; its charts, its segments, its limits."""

import numpy as np
import pytest

from podeep.soil.reese_sand import ReeseSand
from podeep.soil.sand import default_subgrade_modulus, sand_coefficients
from test_soil_tables import close

PHI = np.radians(34.0)
NODES = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0])
CHARTS = {
    False: (
        [2.85, 2.43, 2.06, 1.74, 1.44, 1.21, 1.03, 0.90, 0.88],
        [2.20, 1.85, 1.56, 1.26, 1.05, 0.88, 0.70, 0.54, 0.50],
    ),
    True: (
        [0.75, 0.91, 1.06, 1.08, 1.01, 0.97, 0.93, 0.88, 0.88],
        [0.50, 0.71, 0.84, 0.86, 0.82, 0.78, 0.69, 0.56, 0.55],
    ),
}
both = pytest.mark.parametrize("cyclic", [False, True], ids=["static", "cyclic"])


def sand(ps=1e6, depth=5.0, diameter=1.0, line=60e6, **changed):
    """A sand of theoretical resistance ps (N/m) whose initial line has the slope `line` (N/m2)."""
    C1, C2, C3 = sand_coefficients(PHI)
    bearing = np.minimum(C1 * depth + C2 * diameter, C3 * diameter)
    given = {
        "depth": depth,
        "diameter": diameter,
        "effective_overburden": ps / bearing,
        "friction_angle": PHI,
        "subgrade_modulus": line / np.maximum(depth, 1e-3),
    }
    return ReeseSand(**given | changed)


@both
def test_the_charts_at_their_nodes_between_and_beyond(cyclic):
    for D in (0.5, 2.0):
        law = sand(depth=NODES * D, diameter=D, cyclic=cyclic, subgrade_modulus=2e7)
        assert law.derived["A"].tolist() == CHARTS[cyclic][0]
        assert law.derived["B"].tolist() == CHARTS[cyclic][1]
    between_and_beyond = sand(depth=np.array([0.25, 3.5, 50.0]), cyclic=cyclic)
    for name, chart in zip("AB", np.array(CHARTS[cyclic]), strict=True):
        middle = [0.5 * (chart[0] + chart[1]), 0.5 * (chart[6] + chart[7]), chart[-1]]
        close(between_and_beyond.derived[name], middle)


@both
def test_every_chart_value_gives_a_concave_curve(cyclic):
    """n > 1, so that the parabola is one; A > B, so that the second line rises."""
    A, B = np.array(CHARTS[cyclic])
    n = B / (A - B) / (60.0 * (3.0 / 80.0 - 1.0 / 60.0)) ** -1
    assert (n >= 1.64).all()
    assert (A > B).all()


def test_resistance_is_the_smaller_of_wedge_and_flow_around():
    law = ReeseSand(
        depth=np.array([2.0, 80.0]),
        diameter=1.0,
        effective_overburden=np.array([20e3, 800e3]),
        friction_angle=np.radians(30.0),
    )
    # coefficients at 30 degrees as printed: 1.912, 2.667 and 28.75
    expected = [(1.912 * 2.0 + 2.667) * 20e3, 28.75 * 800e3]
    np.testing.assert_allclose(law.theoretical_resistance, expected, rtol=3e-4)
    close(law.ultimate_resistance, law.theoretical_resistance * [1.44, 0.88])
    close(law.capacity, law.ultimate_resistance)


@both
def test_values_by_hand(cyclic):
    """X/D = 5, ps = 1 MN/m, D = 1 m: pm 500 or 550 kN/m at 1/60 m, pu 880 kN/m at 3/80 m."""
    law = sand(cyclic=cyclic)
    pm, n, yk, at_10 = (
        (550e3, 2.083333333, 0.00527893397, 430403.000)
        if cyclic
        else (500e3, 1.644736842, 0.00284390502, 366510.115)
    )
    m = (880e3 - pm) * 48.0
    close(n, pm / (m / 60.0))
    np.testing.assert_allclose(law.derived["y_k"], yk, rtol=1e-8)
    y = np.array([0.5 * yk, 0.01, 1.0 / 60.0, 0.03, 3.0 / 80.0, 1.0])
    p = [30e6 * yk, at_10, pm, pm + m * (0.03 - 1.0 / 60.0), 880e3, 880e3]
    np.testing.assert_allclose(law.force(y), p, rtol=1e-8)


@both
@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0, 2.7, 4.5, 9.0])
def test_continuity_at_the_breakpoints(cyclic, ratio):
    depth = max(ratio, 1e-3) * 1.5
    law = sand(depth=depth, diameter=1.5, line=4e8, cyclic=cyclic)
    yk, ym, yu = law.derived["y_k"][0], 1.5 / 60.0, 1.5 * 3.0 / 80.0
    assert yk < ym
    points = np.array([yk, ym, yu])
    (below, steeper), (above, flatter) = (law.evaluate(points * (1.0 + s)) for s in (-1e-9, 1e-9))
    np.testing.assert_allclose(above, below, rtol=1e-8)
    assert steeper[0] == 4e8
    assert flatter[0] < 0.7 * 4e8  # a kink: 1/n of the line's slope
    np.testing.assert_allclose(flatter[1], steeper[1], rtol=1e-6)  # tangent
    assert steeper[2] > 0.0
    assert flatter[2] == 0.0
    A, B = law.derived["A"][0], law.derived["B"][0]
    close(law.force(points[1:]), [B * 1e6, A * 1e6])


def test_the_plateau_starts_at_its_own_displacement():
    law = sand(diameter=60.0 / 64.0)
    assert law.stiffness(np.array([2.25 / 64.0, -2.25 / 64.0])).tolist() == [0.0, 0.0]


def test_a_soft_line_is_followed_to_where_it_meets_the_curve():
    """At X/D = 5 the curve is at 30 MN/m2 in pm, at 23.5 in pu, both as a secant."""
    lines = np.array([40e6, 30e6, 26e6, 23e6, 5e6])
    law = sand(ps=np.full(5, 1e6), line=lines)
    yk, m = law.derived["y_k"], 380e3 * 48.0
    assert yk[0] < 1.0 / 60.0
    close(yk[1:], [1.0 / 60.0, (500e3 - m / 60.0) / (26e6 - m), 880e3 / 23e6, 880e3 / 5e6])
    for share in (0.2, 0.9, 1.0 - 1e-9):
        force, stiffness = law.evaluate(share * yk)
        close(force, lines * share * yk)
        assert (stiffness == lines).all()
    past = law.stiffness(yk * (1.0 + 1e-9))
    assert (past < lines).all()
    close(past[2:], [m, 0.0, 0.0])
    close(law.force(np.full(5, 10.0)), 880e3)
    close(law.capacity, 880e3)


def test_at_the_mudline_and_without_overburden_there_is_no_reaction():
    law = ReeseSand(
        depth=np.array([0.0, 2.0, 0.0]),
        diameter=np.full(3, 1.0),
        effective_overburden=np.array([30e3, 0.0, 0.0]),
        friction_angle=np.full(3, PHI),
    )
    for y in (0.0, 1e-9, 1e3):
        force, stiffness = law.evaluate(np.full(3, y))
        assert (force == 0.0).all()
        assert (stiffness == 0.0).all()
    assert (law.capacity == 0.0).all()
    assert law.derived["y_k"].tolist() == [np.inf, 0.0, np.inf]


def test_the_default_modulus_is_that_of_sand():
    phi = np.radians([28.0, 33.0, 39.0])
    law = sand(friction_angle=phi, subgrade_modulus=None, multiplier=0.5)
    close(law.initial_stiffness, 0.5 * 5.0 * default_subgrade_modulus(phi))
    assert (law.stiffness(np.zeros(3)) == law.initial_stiffness).all()
