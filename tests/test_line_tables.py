"""Lines on the seabed against check tables 03 to 08, computed to many digits by others.

The tables (tests/data/seabed) tell in their headers how they were made.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from lines_on_seabed import (
    LIMITS,
    SHARP,
    hung,
    numbers,
    riser,
    straight,
    system_of,
    table,
)
from podeep.arrays import Array
from podeep.line.boundary_layer import BoundaryLayer
from podeep.line.catenary import grounded
from podeep.line.results import LineResults
from podeep.line.statics import Stage, follow, laid
from podeep.seabed.normal import Winkler
from podeep.solve.newton import Ending

RISERS = [(row["case"], numbers(row)) for row in table("05", "1")]
PLAIN = [pytest.param(case, row, id=case) for case, row in RISERS if not row["mu"]]


# --- 03: cables with friction on a rigid seabed ---------------------------------------------------


@pytest.mark.parametrize("row", table("03"), ids=lambda row: row["case"])
def test_03_closed_catenaries(row):
    at = numbers(row)
    found = grounded(*(at[k] for k in ("XF_m", "ZF_m", "L_m", "EA_N", "W_N_per_m", "CB")))
    scale = at["HF_N"]
    assert found.horizontal == pytest.approx(at["HF_N"], rel=1e-9)
    assert found.vertical == pytest.approx(at["VF_N"], rel=1e-9)
    assert found.tension == pytest.approx(at["TF_N"], rel=1e-9)
    assert found.anchor == pytest.approx(at["HA_N"], abs=1e-9 * scale)
    assert found.anchor_vertical == pytest.approx(at["VA_N"], abs=1e-9 * scale)
    assert found.lying == pytest.approx(at["LB_m"], abs=1e-9 * at["L_m"])
    assert found.slack == pytest.approx(at["xB_zero_tension_m"], abs=1e-9 * at["L_m"])


@pytest.mark.parametrize("row", table("03"), ids=lambda row: row["case"])
def test_03_cables_pulled_over_a_stiff_seabed(row):
    """Laid slack, then pulled: all of it has slid towards the upper end, to 1e-6.

    The seabed has 10 MPa in place of being rigid, friction is reached in 0.1 mm. Where a part stays
    slack, some 0.2 kN are locked in it, where the table has none: to 1e-5 there.
    """
    at = numbers(row)
    length, lying, weight = at["L_m"], at["LB_m"], at["W_N_per_m"]
    below = max(int(60 * lying / length), 1) if lying else 0
    edges = np.concatenate(
        [np.linspace(0.0, lying, below + 1)[:-1] if below else [], np.linspace(lying, length, 51)]
    )
    system = system_of(
        edges,
        5,
        (at["EA_N"], 0.0, weight),
        Winkler(1e7, SHARP),
        held={0.0: "xz", length: "xz"},
        friction=at["CB"],
    )
    slack = at["CB"] > 0.0 and lying > 0.0
    span = slack_span(at) if slack else at["XF_m"]
    state = laid(system, hung(system, span, at["ZF_m"]), LIMITS)
    if slack:
        ends = np.array([0.0, 0.0, at["XF_m"], at["ZF_m"]])
        (state,) = follow(system, state, [Stage(ends)], LIMITS)
    assert state.ending is Ending.CONVERGED
    accuracy = 1e-5 if at["xB_zero_tension_m"] else 1e-6
    # both ends of an element are known to a rounding: with EA = 5e14 N that is worth some newtons
    rounding = 2.0 * at["EA_N"] * np.spacing(at["XF_m"]) / np.diff(edges)[-1]
    assert state.forces[2] == pytest.approx(at["HF_N"], abs=accuracy * at["HF_N"] + rounding)
    assert state.forces[3] == pytest.approx(at["VF_N"], abs=accuracy * at["VF_N"] + rounding)
    # what is elastic in friction is that over sqrt(EA threshold/(mu W)) at the anchor
    near = np.sqrt(at["EA_N"] * 1e-4 * at["CB"] * weight) if at["CB"] else 0.0
    assert -state.forces[0] == pytest.approx(at["HA_N"], abs=1e-6 * at["HF_N"] + near + rounding)


def slack_span(at: dict[str, float]) -> float:
    """The span of the same line with a small part of its tension."""
    h = at["HF_N"] / at["W_N_per_m"] * (1e-3 if at["xB_zero_tension_m"] else 0.3)
    hanging = np.sqrt(at["ZF_m"] ** 2 + 2.0 * at["ZF_m"] * h)
    return float(at["L_m"] - hanging + h * np.arcsinh(hanging / h))


# --- 04: the boundary layer of a touchdown --------------------------------------------------------


def layer_of(row: dict[str, float]) -> BoundaryLayer:
    return BoundaryLayer(row["EI_Nm2"], row["T_N"], row["w_N_per_m"], row["k_Pa"])


LAYERS = {row["case"]: layer_of(numbers(row)) for row in table("04", "1")}


@pytest.mark.parametrize("row", table("04", "1"), ids=lambda row: row["case"])
def test_04_constants_of_a_touchdown(row):
    at, layer = numbers(row), LAYERS[row["case"]]
    for name, value in {
        "lam_m": layer.length,
        "K": layer.relative_stiffness,
        "th0_rad": layer.slope,
        "kap0_1_per_m": layer.curvature,
        "M0_Nm": layer.moment,
        "Q0_N": layer.shear,
        "x_v_m": layer.vertex[0],
        "y_v_m": layer.vertex[1],
    }.items():
        assert value == pytest.approx(at[name], rel=1e-9), name
    if np.isfinite(at["x_pen_max_m"]):
        near = at["x_pen_max_m"]
        deepest = brentq(
            lambda x: float(layer.profile(np.array([x]), 1)[0]), 1.2 * near, 0.8 * near, xtol=1e-13
        )
        assert deepest == pytest.approx(near, rel=1e-9)
        assert -layer.profile(np.array([deepest]))[0] == pytest.approx(at["pen_max_m"], rel=1e-9)


@pytest.mark.parametrize("case", LAYERS)
def test_04_profiles_of_a_touchdown(case):
    layer, rows = LAYERS[case], [numbers(r) for r in table("04", "2") if r["case"] == case]
    x = np.array([row["x_m"] for row in rows])
    scales = [1.0, 1.0, layer.bending_stiffness, layer.bending_stiffness]
    for derivative, (name, scale) in enumerate(
        zip(("y_m", "slope_rad", "moment_Nm", "shear_N"), scales, strict=True)
    ):
        told = np.array([row[name] for row in rows])
        found = scale * layer.profile(x, derivative)
        np.testing.assert_allclose(found, told, rtol=1e-8, atol=1e-9 * np.abs(told).max(initial=0))


# --- 05: risers of large rotations ----------------------------------------------------------------


@pytest.mark.parametrize(("case", "row"), PLAIN)
def test_05_risers_on_elements_of_half_the_bending_length(case, row):
    """Tension to 1e-6, moments to 4e-4 of the largest (asked: 1e-4 and 1e-3)."""
    system, state = riser(row, 0.5)
    assert state.ending is Ending.CONVERGED
    results = LineResults.of(system, [state])
    horizontal, vertical = state.forces[-2:]
    assert np.hypot(horizontal, vertical) == pytest.approx(row["T_top_N"], rel=1e-6)
    assert vertical == pytest.approx(row["V_top_N"], rel=1e-6)
    assert horizontal == pytest.approx(row["H_anchor_end_N"], rel=2e-6)
    assert results.tension(np.array([row["L_m"]]))[0, 0] == pytest.approx(row["T_top_N"], rel=1e-5)
    (touchdown,) = results.touchdown()
    assert touchdown == pytest.approx(row["S_td_m"], abs=5e-3)
    places = [numbers(r) for r in table("05", "2") if r["case"] == case]
    s = touchdown + np.array([at["s_m"] for at in places])
    told = {name: np.array([at[name] for at in places]) for name in ("M_Nm", "z_m", "x_m")}
    assert results.moment(s)[0] == pytest.approx(told["M_Nm"], abs=4e-4 * row["M_max_Nm"])
    assert results.position(s)[0, :, 1] == pytest.approx(told["z_m"], abs=5e-3)
    assert results.position(s)[0, :, 0] == pytest.approx(told["x_m"], abs=5e-3)
    close = np.linspace(0.0, touchdown + 200.0, 20001)
    assert results.moment(close).max() == pytest.approx(row["M_max_Nm"], rel=1e-5)
    assert results.penetration(close).max() == pytest.approx(row["pen_max_m"], rel=1e-3)


def test_05_a_riser_whose_laid_part_has_slid():
    """Laid with little tension, then moved away: friction is mobilised towards the anchor."""
    row = dict(RISERS)["D_k50kPa_mu0.4"]
    system, state = riser(row, 1.0, degree=5, span=700.0, friction=row["mu"])
    assert state.forces[-2] < 0.3 * row["H_anchor_end_N"]
    goal = state.q[system.held].copy()
    goal[-2] = row["X_m"]
    (state,) = follow(system, state, [Stage(goal)], LIMITS)
    assert state.ending is Ending.CONVERGED
    assert np.hypot(*state.forces[-2:]) == pytest.approx(row["T_top_N"], rel=1e-5)
    assert -state.forces[0] == pytest.approx(row["H_anchor_end_N"], rel=0.02)  # elastic slip there
    results = LineResults.of(system, [state])
    assert results.touchdown()[0] == pytest.approx(row["S_td_m"], abs=0.02)
    s = np.linspace(0.0, 600.0, 6001)
    assert results.moment(s).max() == pytest.approx(row["M_max_Nm"], rel=1e-4)


@pytest.mark.parametrize("degree", [3, 5])
def test_05_the_moment_has_an_order_of_two_at_least(degree):
    """Error of the moments around the touchdown as elements are halved twice."""
    case, row = RISERS[1]
    places = [numbers(r) for r in table("05", "2") if r["case"] == case]
    told = np.array([at["M_Nm"] for at in places])
    errors = []
    for share in (2.0, 1.0, 0.5):
        system, state = riser(row, share, degree=degree)
        results = LineResults.of(system, [state])
        s = results.touchdown()[0] + np.array([at["s_m"] for at in places])
        errors.append(np.abs(results.moment(s)[0] - told).max())
    assert np.log2(errors[0] / errors[2]) / 2.0 > 2.0


# --- 06: pulled along the seabed ------------------------------------------------------------------


@pytest.mark.parametrize(
    "row",
    [r for r in table("06") if r["type"] in "BC" and r["kt_Pa"] != "inf"],
    ids=lambda r: f"{r['type']} {float(r['P_N']):g} {float(r['kt_Pa']):g}",
)
def test_06_a_pipe_pulled_at_its_end(row):
    """An end moved by the table's u0 takes the table's pull, on elements of 5 m."""
    at = numbers(row)
    weight, mu = 1450.0, at["fr_N_per_m"] / 1450.0
    fixed = row["type"] == "C"
    reach = np.sqrt(at["EA_N"] / at["kt_Pa"])
    length = at["L_m"] if fixed else at["slip_m"] + 25.0 * reach
    edges = np.linspace(0.0, length, int(length / 5.0) + 1)
    system = system_of(
        edges,
        3,
        (at["EA_N"], 1e6, weight),
        Winkler(1e6, SHARP),
        held={0.0: "x", length: "xZ"} if fixed else {0.0: "x"},
        friction=mu,
        threshold=at["fr_N_per_m"] / at["kt_Pa"],
    )
    state = laid(system, straight(system), LIMITS)
    goal = state.q[system.held].copy()
    goal[0] = -at["u0_m"]
    (state,) = follow(system, state, [Stage(goal)], LIMITS)
    assert state.ending is Ending.CONVERGED
    assert -state.forces[0] == pytest.approx(at["P_N"], rel=2e-5)
    if fixed:
        assert state.forces[1] == pytest.approx(at["anchor_N"], abs=2e-5 * at["P_N"])


# --- 08: free spans -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row",
    [r for r in table("08") if r["type"] == "uni"],
    ids=lambda r: f"{float(r['k_Pa']):g} Pa, {float(r['Ls_m']):g} m",
)
def test_08_a_pipe_over_a_free_span_lifts_off(row):
    """Small slopes: weight and results are scaled by 1e-4, as contact alone is not linear."""
    at, scale = numbers(row), 1e-4
    half, beta = 0.5 * at["Ls_m"], at["beta_1_per_m"]
    shoulder = 14.0 / beta
    inner, outer = int(np.ceil(half * beta * 2)), 28
    over = np.linspace(0.0, half, inner + 1)[:-1]
    edges = np.concatenate([over, half + shoulder * np.linspace(0.0, 1.0, outer + 1)])
    probe = system_of(edges, 7, (1e9, at["EI_Nm2"], 0.0), Winkler(1.0, SHARP), held={0.0: "xZ"})
    assert probe.bed is not None
    system = system_of(
        edges,
        7,
        (1e9, at["EI_Nm2"], scale * at["w_N_per_m"]),
        Winkler(at["k_Pa"], 1e-12),
        held={0.0: "xZ"},
        under=probe.bed.s > half,
    )
    state = laid(system, straight(system), LIMITS)
    assert state.ending is Ending.CONVERGED
    results = LineResults.of(system, [state])
    edge, middle = np.array([half]), np.array([0.0])
    assert results.position(edge)[0, 0, 1] / scale == pytest.approx(at["y_edge_m"], rel=1e-4)
    assert results.position(middle)[0, 0, 1] / scale == pytest.approx(at["y_mid_m"], rel=1e-4)
    largest = at["M_mid_Nm"]
    assert results.moment(edge)[0, 0] / scale == pytest.approx(at["M_edge_Nm"], abs=1e-4 * largest)
    assert results.moment(middle)[0, 0] / scale == pytest.approx(largest, rel=1e-4)
    if "max_uplift_m" in at and at["max_uplift_m"] > 0.0:
        s = half + np.linspace(0.0, 8.0 / beta, 20001)
        z = results.position(s)[0, :, 1] / scale
        assert z.max() == pytest.approx(at["max_uplift_m"], rel=1e-3)
        lifted = s[z > 0.0] - half
        assert lifted[0] == pytest.approx(at["x_lift1_m"], rel=1e-3)
        assert lifted[-1] == pytest.approx(at["x_lift2_m"], rel=1e-3)


# --- 07: peeled off -------------------------------------------------------------------------------


class Peel:
    """A stiff floor that holds a line back by q until it is D above it; corners are rounded."""

    floor = 1e8

    def __init__(self, q: float, reach: float) -> None:
        self.q, self.reach, self.soft = q, max(reach, 1e-30), 5e-4 * max(reach, 1e-30)

    def evaluate(self, z: Array) -> tuple[Array, Array]:
        up = np.maximum(-z, 0.0)
        rise, fall = (np.clip((up - at) / self.soft, 0.0, 1.0) for at in (0.0, self.reach))
        force = self.floor * np.maximum(z, 0.0) - self.q * (rise - fall)
        climbing, falling = ((share > 0.0) & (share < 1.0) for share in (rise, fall))
        slope = self.q / self.soft * (climbing * 1.0 - falling)
        return force, np.where(z > 0.0, self.floor, slope)


@pytest.mark.parametrize("row", table("07")[:5], ids=lambda row: row["case"])
def test_07_a_pipe_is_peeled_off(row):
    """Small slopes: loads, heights and reach are scaled by 1e-3."""
    at, scale = numbers(row), 1e-3
    length = 60.0
    edges = np.linspace(0.0, length, 241)
    system = system_of(
        edges,
        5,
        (1e9, at["EI_Nm2"], scale * at["w_N_per_m"]),
        Peel(scale * at["q_N_per_m"], scale * at["Delta_m"]),
        held={0.0: "xzZ", length: "z"},
    )
    state = laid(system, straight(system), LIMITS)
    goal = state.q[system.held].copy()
    goal[-1] = scale * at["h_m"]
    (state,) = follow(system, state, [Stage(goal)], LIMITS)
    assert state.ending is Ending.CONVERGED
    assert state.forces[-1] / scale == pytest.approx(at["P_N"], rel=1e-3)
    s = np.linspace(0.0, length, 24001)
    moment = LineResults.of(system, [state]).moment(s)[0] / scale
    assert np.abs(moment).max() == pytest.approx(at["Mmax_Nm"], rel=1e-3)
