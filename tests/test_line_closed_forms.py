"""Closed forms of pipes on the seabed against tables 06, 07 and 08, their limits, and a line.

The tables (tests/data/seabed) have 13 digits; every column of them is met within 1e-9.
"""

from math import inf, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lines_on_seabed import LIMITS, SHARP, straight, system_of, table
from podeep.errors import InvalidData
from podeep.line.free_span import LET_GO, free_span
from podeep.line.peel import peeled
from podeep.line.pulled import pulled, released
from podeep.line.statics import Stage, follow, laid
from podeep.seabed.normal import Winkler

EA, F, KT = 4.93e9, 580.0, 1e5  # a pipe of table 06, with friction in place of weight
EI, W = 55.3e6, 1450.0  # one of tables 07 and 08


def values(row, *names):
    return [float(row[name]) for name in names]


def matches(found, row, names, size=0.0):
    """Each number is that of the row, within 1e-9 of it, or of a size where that is given."""
    told = values(row, *names)
    assert list(found) == pytest.approx(told, rel=1e-9, abs=1e-9 * size)


# --- 06: pulled along the seabed ------------------------------------------------------------------


@pytest.mark.parametrize("row", table("06"), ids=lambda row: " ".join([*row.values()][:6]))
def test_06_pulled(row):
    pull, axial, f, kt, length = values(row, "P_N", "EA_N", "fr_N_per_m", "kt_Pa", "L_m")
    found = pulled(pull, axial, f, 1.0, stiffness=kt, length=length)
    matches((found.displacement, found.slipping), row, ("u0_m", "slip_m"))
    matches([found.anchor], row, ["anchor_N"], pull)
    if row["N_r_N"]:
        assert f * sqrt(axial / kt) == pytest.approx(float(row["N_r_N"]), rel=1e-9)
        assert f / kt == pytest.approx(float(row["u_r_m"]), rel=1e-9, abs=0.0)
    if row["loop_J"]:
        back = released(pull, axial, f, 1.0)
        matches((back.displacement, back.loop), row, ("residual_u_m", "loop_J"))
        assert back.slipping == pytest.approx(pull / (2.0 * f), rel=1e-12)


@pytest.mark.parametrize("length", [inf, 1000.0, 300.0])
def test_elastic_slip_goes_to_friction_that_is_rigid(length):
    """What is too far is (N_r/P)^2 of it where nothing reaches the far end."""
    rigid = pulled(2e5, EA, F, 1.0, length=length)
    far = [pulled(2e5, EA, F, 1.0, stiffness=k, length=length) for k in 10.0 ** np.arange(4, 11, 2)]
    excess = np.array([one.displacement / rigid.displacement - 1.0 for one in far])
    assert (np.diff(excess) < 0.0).all()
    assert 0.0 < excess[-1] < 1e-5
    assert far[-1].slipping == pytest.approx(rigid.slipping, rel=3e-3)
    assert far[-1].anchor == pytest.approx(rigid.anchor, abs=1e-2 * 2e5)
    if length == inf:
        resisted = F * sqrt(EA / 1e8)
        assert excess[2] == pytest.approx((resisted / 2e5) ** 2, rel=1e-9)


def test_a_pull_that_nothing_resists_far_away():
    assert pulled(0.0, EA, F, 1.0) == pulled(0.0, EA, F, 1.0, length=5.0)
    far = pulled(8e5, EA, F, 1.0, stiffness=KT, length=1e7)
    assert far == pulled(8e5, EA, F, 1.0, stiffness=KT)
    whole = pulled(1e9, EA, F, 1.0, stiffness=KT, length=100.0)  # nearly all of it slips
    assert 0.0 < whole.anchor - (1e9 - 100.0 * F) < F * (100.0 - whole.slipping) < 20.0


@settings(max_examples=100, deadline=None)
@given(
    pull=st.floats(1.0, 1e7),
    stiffness=st.floats(1e2, 1e9) | st.just(inf),
    length=st.floats(1.0, 1e5) | st.just(inf),
)
def test_a_pulled_pipe_is_in_balance(pull, stiffness, length):
    """The pull is what slips, the elastic force behind it, and no more than friction can be."""
    found = pulled(pull, EA, F, 1.0, stiffness=stiffness, length=length)
    assert 0.0 <= found.slipping <= length
    assert found.anchor <= pull
    more = pulled(1.01 * pull, EA, F, 1.0, stiffness=stiffness, length=length)
    assert more.displacement >= found.displacement * (1.01 - 1e-9)
    assert more.slipping >= found.slipping
    if stiffness < inf:
        reach, held = sqrt(EA / stiffness), pull - F * found.slipping
        assert held <= F * reach / np.tanh((length - found.slipping) / reach) * (1.0 + 1e-6)


@pytest.mark.parametrize("stiffness", [inf, KT])
def test_what_a_loop_takes_is_the_area_in_it(stiffness):
    back = released(5e5, EA, F, 1.0, stiffness=stiffness)

    def u(pull):
        return pulled(pull, EA, F, 1.0, stiffness=stiffness).displacement

    pull = np.linspace(0.0, 5e5, 4001)
    down = np.array([u(5e5) - 2.0 * u(0.5 * (5e5 - p)) for p in pull])
    up = np.array([back.displacement + 2.0 * u(0.5 * p) for p in pull])
    assert up[-1] == pytest.approx(down[-1], rel=1e-12)
    assert np.trapezoid(down - up, pull) == pytest.approx(back.loop, rel=1e-6)
    small = released(1.9 * F * sqrt(EA / KT), EA, F, 1.0, stiffness=KT)  # elastic on its way back
    assert (small.slipping, small.loop) == (0.0, 0.0)
    assert small.displacement > 0.0


def test_a_line_that_is_pulled_let_go_and_pulled_again():
    """Elements of 50 m, the end moved to where the closed forms have it: forces and the loop."""
    pull, weight = 5e5, 1450.0
    there = pulled(pull, EA, weight, F / weight, stiffness=KT)
    back = released(pull, EA, weight, F / weight, stiffness=KT)
    length = there.slipping + 10.0 * sqrt(EA / KT)
    system = system_of(
        np.linspace(0.0, length, int(length / 50.0) + 1),
        3,
        (EA, 1e6, weight),
        Winkler(1e6, SHARP),
        held={0.0: "x"},
        friction=F / weight,
        threshold=F / KT,
    )
    start = laid(system, straight(system), LIMITS)
    ways = [(0.0, there.displacement), (there.displacement, back.displacement)]
    ways += [ways[1][::-1]]
    states = [start]
    for one, other in ways:
        goals = np.linspace(one, other, 11)[1:]
        stages = [Stage(np.array([start.q[system.held][0] - u])) for u in goals]
        states += list(follow(system, states[-1], stages, LIMITS))
    forces = [-states[at].forces[0] for at in (10, 20, 30)]
    assert forces == pytest.approx([pull, 0.0, pull], abs=2e-3 * pull)
    assert states[30].energy - states[10].energy == pytest.approx(back.loop, rel=1e-2)


# --- 07: peeled off -------------------------------------------------------------------------------

PEELED = ("a_m", "l_m", "P_N", "R_N", "Mmax_Nm", "curv_at_a_1_per_m")


@pytest.mark.parametrize("row", table("07"), ids=lambda row: row["case"])
def test_07_peeled(row):
    of = values(row, "h_m", "EI_Nm2", "w_N_per_m", "q_N_per_m", "Delta_m")
    found = peeled(*of)
    told = (found.held, found.length, found.lift, found.reaction, found.largest_moment)
    matches((*told, found.curvature), row, PEELED)
    film = sqrt(2.0 * of[3] * of[4] / of[1])
    assert film == pytest.approx(float(row["sqrt_2G_over_EI"]), rel=1e-9)


def test_suction_of_no_reach_is_that_of_a_film():
    """The curvature where it ends goes to sqrt(2 q D/EI)."""
    apart = []
    for reach in (1e-1, 1e-3, 1e-5):
        found = peeled(1.0, EI, W, 400.0 / reach, reach)
        apart.append(abs(found.curvature / sqrt(2.0 * 400.0 / EI) - 1.0))
    assert apart[0] > apart[1] > apart[2]
    assert apart[2] < 3e-3


def test_a_pipe_that_is_held_all_along_goes_on_as_its_end_breaks_out():
    """Where it does, the largest moment is still in what is held."""
    before, after = (peeled(h, EI, W, 1500.0, 0.1) for h in (0.1, 0.1 * (1.0 + 1e-9)))
    for name in ("held", "length", "lift", "reaction", "largest_moment"):
        assert getattr(after, name) == pytest.approx(getattr(before, name), rel=1e-4), name
    assert 0.0 < after.curvature < 1e-4 * before.largest_moment / EI


def test_little_suction_is_none():
    none = peeled(1.0, EI, W)
    assert peeled(1.0, EI, W, 1500.0, 0.0) == peeled(1.0, EI, W, 0.0, 0.1) == none
    assert none.length == pytest.approx((24.0 * EI / W) ** 0.25)
    for little in (peeled(1.0, EI, W, 1e-6, 0.1), peeled(1.0, EI, W, 1.0, 1e-9)):
        assert little.length == pytest.approx(none.length, rel=1e-6)
        assert little.largest_moment == pytest.approx(none.largest_moment, rel=1e-6)


@settings(max_examples=100, deadline=None)
@given(height=st.floats(0.01, 10.0), suction=st.floats(10.0, 1e5), reach=st.floats(1e-3, 1.0))
def test_suction_shortens_what_is_off_the_seabed_and_bends_it_more(height, suction, reach):
    """Forces and moments are in balance, and what suction holds ends where it should."""
    found, none = peeled(height, EI, W, suction, reach), peeled(height, EI, W)
    assert found.held <= found.length < none.length
    assert found.largest_moment > none.largest_moment
    assert found.lift > none.lift
    weight, held = W * found.length, suction * found.held
    assert found.lift + found.reaction == pytest.approx(weight + held, rel=1e-9)
    about = found.reaction * found.length - 0.5 * weight * found.length
    arm = found.length - 0.5 * found.held
    assert about == pytest.approx(held * arm, rel=1e-6, abs=1e-9 * weight * found.length)
    higher = peeled(1.01 * height, EI, W, suction, reach)
    assert higher.length > found.length
    past = found.held < found.length
    assert past == (height > reach)


# --- 08: free spans -------------------------------------------------------------------------------

EDGE = ("y_edge_m", "slope_edge", "M_edge_Nm", "V_edge_N", "y_mid_m", "M_mid_Nm")


@pytest.mark.parametrize("row", table("08"), ids=lambda row: " ".join([*row.values()][:5]))
def test_08_spans(row):
    of = values(row, "Ls_m", "EI_Nm2", "w_N_per_m", "k_Pa")
    found = free_span(*of, bilateral=row["type"] == "lin")
    told = (found.edge_deflection, found.edge_slope, found.edge_moment, found.edge_shear)
    matches((*told, found.middle_deflection, found.middle_moment), row, EDGE)
    sinks = found.middle_deflection - found.edge_deflection
    matches([sinks], row, ["y_mid_minus_edge_m"])
    if row["max_uplift_m"]:
        matches([found.highest], row, ["max_uplift_m"])
    assert bool(row["x_lift1_m"]) == (found.lifted is not None)
    if found.lifted is not None:
        matches(found.lifted, row, ("x_lift1_m", "x_lift2_m"))


def span_of(half, **more):
    """A span of beta Ls/2 in units of 1/beta, w/k and w/beta^2."""
    return free_span(2.0 * half, 1.0, 4.0, 4.0, **more)


def test_a_seabed_lets_go_where_it_would_have_to_pull():
    """One side of the threshold is the bilateral solution, the other goes on from it."""
    for half in (0.1, 1.0, LET_GO):
        assert span_of(half) == span_of(half, bilateral=True)
    assert abs(span_of(LET_GO).highest) < 1e-9
    beyond = span_of(LET_GO * (1.0 + 1e-12))
    assert beyond.lifted is not None
    assert beyond.edge_moment == pytest.approx(span_of(LET_GO).edge_moment, rel=1e-9)
    assert span_of(LET_GO * 1.001, bilateral=True).highest > 0.0


def test_a_long_span_is_clamped_where_the_seabed_pulls():
    found = free_span(1e4, EI, W, 1e6, bilateral=True)
    assert found.edge_moment == pytest.approx(-W * 1e8 / 12.0, rel=3e-3)


@settings(max_examples=60, deadline=None)
@given(half=st.floats(LET_GO * 1.0001, 100.0))
def test_a_part_of_the_shoulder_is_off_the_seabed(half):
    found, held = span_of(half), span_of(half, bilateral=True)
    assert found.lifted is not None
    first, last = found.lifted
    assert 0.0 < first < 2.0 < last
    assert found.highest > held.highest
    assert held.edge_moment < found.edge_moment < 0.0
    assert found.edge_deflection < held.edge_deflection
    assert found.middle_moment - found.edge_moment == pytest.approx(2.0 * half**2, rel=1e-9)
    longer = span_of(1.0001 * half) if half < 99.0 else None
    if longer is not None and longer.lifted is not None:
        assert longer.lifted[0] < first
        assert longer.highest > found.highest


def test_the_shoulder_is_a_beam_on_the_seabed():
    """Forces of the whole shoulder, by integration of what its seabed and weight come to.

    What comes onto it from the span is borne by the seabed, from the edge and from beyond the
    part that is let go; moments about the edge are in balance, too.
    """
    half = 5.0
    found = span_of(half)
    assert found.lifted is not None
    first, last = found.lifted
    x = np.linspace(0.0, first, 2001)
    y = starts(found, x)
    assert y[-1] == pytest.approx(0.0, abs=1e-6)
    assert (y[:-1] < 0.0).all()
    t = last - first
    B = (1.0 - t**2 / 3.0 - t**3 / 6.0) / (1.0 + t + t**2 / 3.0)
    beyond = np.linspace(0.0, 40.0, 40001)
    z = -1.0 + np.exp(-beyond) * (np.cos(beyond) + B * np.sin(beyond))
    assert (z[1:] < 0.0).all()
    pushes = -4.0 * y, -4.0 * z
    net = np.trapezoid(pushes[0] - 4.0, x) + np.trapezoid(pushes[1] - 4.0, beyond) - 4.0 * t
    assert net == pytest.approx(found.edge_shear, rel=1e-5)
    about = np.trapezoid((pushes[0] - 4.0) * x, x)
    about += np.trapezoid((pushes[1] - 4.0) * (last + beyond), beyond)
    about -= 4.0 * t * (first + 0.5 * t)
    assert about == pytest.approx(found.edge_moment, rel=1e-5)


def starts(found, x):
    """y from the edge on, by the power series of y'''' = -4 (1 + y)."""
    terms = [1.0 + found.edge_deflection, found.edge_slope, found.edge_moment, -found.edge_shear]
    terms = [value / factor for value, factor in zip(terms, (1.0, 1.0, 2.0, 6.0), strict=True)]
    for n in range(4, 30):
        terms.append(-4.0 * terms[n - 4] / (n * (n - 1) * (n - 2) * (n - 3)))
    return np.polynomial.Polynomial(terms)(x) - 1.0


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: pulled(-1.0, EA, F, 1.0), "a pull of -1; give 0 or more"),
        (lambda: pulled(1.0, EA, F, 0.0), "a friction of 0; give more than 0"),
        (lambda: pulled(1.0, EA, F, 1.0, length=float("nan")), "a length of nan"),
        (lambda: peeled(0.0, EI, W), "a height of 0; give more than 0"),
        (lambda: peeled(1.0, EI, W, -1.0, 0.1), "a suction of -1; give 0 or more"),
        (lambda: free_span(10.0, 0.0, W, 1e5), "a bending stiffness of 0; give more"),
        (lambda: free_span(2e4, EI, W, 1e5), "give 1371.6 m at most, or bilateral"),
    ],
)
def test_what_is_no_pipe(call, words):
    with pytest.raises(InvalidData, match=words):
        call()
