"""Scenes that are hard on a solver, each against a closed form or an integration of its own.

Every one has a budget of iterations, all steps of both problems together.
"""

from collections.abc import Sequence
from math import cosh, pi, sin, sqrt, tan, tanh
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_bvp, solve_ivp
from scipy.optimize import brentq, minimize_scalar

from decks import linear_curve
from podeep.deck.read import read_deck
from podeep.solve.analysis import Solved, solve
from podeep.solve.newton import Ending


def solved(folder: Path, soil: str, casing: str, actions: str, steps: int = 1) -> Solved:
    """A deck with its mudline at 0, a tube 1 and a foundation of it."""
    path = folder / "hard.deck"
    path.write_text(
        f"*TITLE\nhard\n*DEPTH\n0\n{soil}*CASING\n1 PILE\n{casing}\n*FONDATION\n1 1\n"
        f"{actions}*QUASISTATIC\n{steps}\n*EXEC\n"
    )
    scene = read_deck(path).scene
    return solve(scene, scene.foundations[0])


def iterations(found: Solved) -> int:
    return sum(s.iterations for s in found.states)


def deflection(found: Solved, *depths: float) -> np.ndarray:
    """In the last step, at rising depths, m."""
    return np.asarray(found.results.deflection(np.array(depths))[-1, 0])


def moments(found: Solved, depths: np.ndarray) -> np.ndarray:
    return np.asarray(found.results.shear_and_moment(depths)[1][-1, 0])


@pytest.mark.parametrize(
    ("curve", "root", "share", "accuracy", "most"),
    [
        ("*PYCURVE, SHAPE=POWER\n1 1 50e3 0 0.5 0.01\n", 3, 1e-1, 1e-4, 24),
        ("*PYCURVE, SHAPE=POWER\n1 1 50e3 0 0.5 0.01\n", 3, 1e-2, 1e-4, 18),
        ("*PYCURVE, SHAPE=POWER\n1 1 50e3 0 0.5 0.01\n", 3, 1e-3, 5e-4, 14),
        ("*PYCURVE\n1 4 50e3 0 0.01\n", 4, 1e-1, 1e-4, 24),
        ("*PYCURVE\n1 4 50e3 0 0.01\n", 4, 1e-2, 5e-4, 18),
    ],
)
def test_root_clay_scales_with_the_load(tmp_path, curve, root, share, accuracy, most):
    """Similarity of EI y'''' + A y^(1/n) = 0 on a long pile in clay of one strength.

    Lengths grow with l, displacements with l^(4 n/(n - 1)), loads with that over l^3: with n = 3
    the displacement goes with the square of the load and the moment with its power 4/3.
    """
    exponent = 4.0 * root / (root - 1.0)
    length = 1.0 / (exponent - 3.0)  # power of the load
    found = []
    for load in (3e5, share * 3e5):
        one = solved(
            tmp_path,
            f"*GROUNDEPTH\n0\n{curve}*GROUNDPROP\n1 0\n",
            "-12.5 -52.5 1 0.03 210e9 7850",
            f"*SUPPORT\n1 -52.5 Z\n*LOAD\nP 1 -12.5 {load!r} 0 0\n*ACCURACY\n1e-4\n",
        )
        assert one.failure is None
        largest = np.abs(moments(one, np.linspace(12.5, 52.5, 8001))).max()
        found.append((deflection(one, 12.5)[0], largest))
    (y, moment), (small, little) = found
    assert small / y == pytest.approx(share ** (exponent * length), rel=accuracy)
    assert little / moment == pytest.approx(share ** (1.0 + length), rel=accuracy)
    assert iterations(one) <= most


def sand_pile(load: float, head: float, end: float) -> float:
    """Head displacement in API's sand, by collocation on EI y'''' + A pu tanh(k z y/(A pu)) = 0.

    35 degrees, 10 kN/m3, k 22 MN/m3, a tube of 1 m whose A is 0.9 from 2.625 m on.
    """
    D, k, weight, EI = 1.0, 22e6, 10e3, 210e9 * pi / 64 * (1.0 - 0.94**4)
    phi = np.radians(35.0)
    a, b, K0, Ka = phi / 2, pi / 4 + phi / 2, 0.4, np.tan(pi / 4 - phi / 2) ** 2
    C1 = (
        np.tan(b) ** 2 * np.tan(a) / np.tan(b - phi)
        + K0 * (np.tan(phi) * np.sin(b) / (np.cos(a) * np.tan(b - phi)))
        + K0 * np.tan(b) * (np.tan(phi) * np.sin(b) - np.tan(a))
    )
    C2 = np.tan(b) / np.tan(b - phi) - Ka
    C3 = Ka * (np.tan(b) ** 8 - 1.0) + K0 * np.tan(phi) * np.tan(b) ** 4

    def slopes(z: np.ndarray, y: np.ndarray) -> np.ndarray:
        peak = np.minimum(C1 * z + C2 * D, C3 * D) * weight * np.maximum(z, 1e-12)
        peak *= np.maximum(3.0 - 0.8 * z / D, 0.9)
        p = peak * np.tanh(k * np.maximum(z, 1e-12) * y[0] * head / peak)
        return np.array((y[1], y[2], y[3], -p / EI / head))

    def ends(top: np.ndarray, tip: np.ndarray) -> np.ndarray:
        return np.array((top[2], top[3] - load / EI / head, tip[2], tip[3]))

    z = np.linspace(0.0, end, 400)
    guess = np.array((np.exp(-z), -np.exp(-z), np.exp(-z), -np.exp(-z)))
    exact = solve_bvp(slopes, ends, z, guess, tol=1e-6, max_nodes=100_000)
    assert exact.success
    return float(exact.y[0, 0] * head)


@pytest.mark.parametrize(("load", "head", "most"), [(1e0, 1e-7, 4), (8e5, 0.05, 12)])
def test_sand_has_no_strength_at_the_mudline(tmp_path, load, head, most):
    """Neither stiffness nor strength: at a newton, and where the top metre yields."""
    found = solved(
        tmp_path,
        "*GROUNDEPTH\n0\n*PYCURVE\n1 2 10e3 35 22e6\n*GROUNDPROP\n1 0\n",
        "0 -25 1 0.03 210e9 7850",
        f"*SUPPORT\n1 -25 Z\n*LOAD\nP 1 0 {load!r} 0 0\n*ACCURACY\n1e-5\n",
    )
    assert found.failure is None
    assert deflection(found, 0.0)[0] == pytest.approx(sand_pile(load, head, 25.0), rel=2e-5)
    assert iterations(found) <= most


def test_a_layer_a_thousand_times_as_strong_below_a_soft_one(tmp_path):
    """3 m of soil of 1 kPa, all mobilised, on soil of 1 MPa, all elastic.

    Above a cantilever under a constant load, below Hetenyi's beam of half-infinite length.
    """
    load, soft, depth, EI, k = 2e5, 1e3, 3.0, 1e9, 1e7
    found = solved(
        tmp_path,
        "*GROUNDEPTH\n0 -3 -3\n*PYCURVE\n1 0 0\n1e3 1e-6\n*PYCURVE\n2 0 0\n1e6 0.1\n"
        "*GROUNDPROP\n1 0 1 0 2 0\n",
        f"0 -73 1 0.05 210e9 7850 EI={EI!r} EA=1e9",
        f"*SUPPORT\n1 -73 Z\n*LOAD\nP 1 0 {load!r} 0 0\n*ACCURACY\n1e-6\n",
    )
    assert found.failure is None
    shear, moment = load - soft * depth, load * depth - 0.5 * soft * depth**2
    b = (k / (4.0 * EI)) ** 0.25
    y = 2.0 * b * (shear + b * moment) / k
    turn = 2.0 * b**2 * (shear + 2.0 * b * moment) / k
    head = y + turn * depth + load * depth**3 / (3.0 * EI) - soft * depth**4 / (8.0 * EI)
    np.testing.assert_allclose(deflection(found, 0.0, depth), (head, y), rtol=1e-6)
    assert moments(found, np.array([depth]))[0] == pytest.approx(moment, rel=1e-6)
    assert iterations(found) <= 6


LINEAR_SHAFT = "*TZCURVE\n1 0\n0 1e12 0 {}\n"


def test_a_pile_of_100_m_by_half_a_metre(tmp_path):
    """Hetenyi's half-infinite beam across, a sheared rod along, by closed forms."""
    k, friction, EI, EA, H, P = 2e7, 2e6, 2e8, 4e9, 1e5, 2e6
    shaft = LINEAR_SHAFT.format(friction / (pi * 0.5))
    found = solved(
        tmp_path,
        f"*GROUNDEPTH\n0\n{linear_curve(1, k, 0.5)}{shaft}*GROUNDPROP\n1 1\n",
        f"0 -100 0.5 0.02 210e9 7850 EI={EI!r} EA={EA!r}",
        f"*LOAD\nP 1 0 {H!r} 0 {-P!r}\n*ACCURACY\n1e-6\n*MODEL, SMALL\n",
    )
    assert found.failure is None
    b, m = (k / (4.0 * EI)) ** 0.25, sqrt(friction / EA)
    assert deflection(found, 0.0)[0] == pytest.approx(2.0 * H * b / k, rel=1e-6)
    largest = np.abs(moments(found, np.linspace(0.0, 20.0, 4001))).max()
    assert largest == pytest.approx(H / b * np.exp(-pi / 4) * sin(pi / 4), rel=1e-5)
    settled = found.results.settlement(np.array([0.0, 100.0]))[-1]
    exact = P / (EA * m) / tanh(100.0 * m)
    np.testing.assert_allclose(settled, (exact, exact / cosh(100.0 * m)), rtol=1e-6)
    assert iterations(found) <= 2


def stub(folder: Path, force: float, stiffness: str, steps: int = 1) -> Solved:
    """3 m long and 8 m across, in soil that is elastic up to 100 kPa at 10 mm, then plastic."""
    return solved(
        folder,
        "*GROUNDEPTH\n0\n*PYCURVE\n1 0 0\n100e3 0.01\n*GROUNDPROP\n1 0\n",
        f"0 -3 8 0.08 210e9 7850 {stiffness}",
        f"*SUPPORT\n1 -3 Z\n*LOAD\nP 1 0 {force!r} 0 0\n*MODEL, ELEMENTS=30\n",
        steps,
    )


def test_a_stub_of_3_m_by_8_m_is_rigid(tmp_path):
    """y = 4 H/(k L) at the head and -2 H/(k L) at the tip; elements of 0.1 m are mere rounding."""
    found = stub(tmp_path, 2e5, "EI=1e16 EA=1e12")
    k, length = 8.0 * 100e3 / 0.01, 3.0
    exact = np.array((4.0, -2.0)) * 2e5 / (k * length)
    np.testing.assert_allclose(deflection(found, 0.0, 3.0), exact, rtol=1e-6)
    assert iterations(found) <= 5


@pytest.mark.parametrize("steps", [1, 7])
def test_a_stub_bears_what_turns_it(tmp_path, steps):
    """A rigid body pushed at the mudline turns about L/sqrt(2): H = (sqrt(2) - 1) p L."""
    capacity = (sqrt(2.0) - 1.0) * 8.0 * 100e3 * 3.0
    found = stub(tmp_path, 1.3 * capacity, "", steps)
    assert found.failure is not None
    assert 1.3 * found.failure.factors[0] == pytest.approx(1.0, rel=1e-3)
    assert iterations(found) <= 12


@pytest.mark.parametrize("share", [0.5, 0.98, 1.02])
def test_a_column_near_its_critical_force(tmp_path, share):
    """A cantilever of 20 m under P and H at its head: y = H/P (tan(k L)/k - L), k^2 = P/EI.

    At 0.98 of the critical force what an element misses is magnified by 50: the estimate sees it.
    """
    EI, length, side = 1e8, 20.0, 1e3
    force = share * pi**2 * EI / (4.0 * length**2)
    found = solved(
        tmp_path,
        f"*GROUNDEPTH\n0\n{linear_curve(1, 1e7)}*GROUNDPROP\n1 0\n",
        f"20 -10 1 0.02 210e9 7850 EI={EI!r} EA=1e12",
        f"*SUPPORT\n1 0 X RY\n1 -10 Z\n*LOAD\nP 1 20 {side!r} 0 {-force!r}\n*MODEL, PDELTA\n"
        "*ACCURACY\n1e-6\n",
    )
    if share > 1.0:
        assert found.failure is not None
        assert found.failure.ending is Ending.BUCKLED
        assert share * found.failure.factors[0] == pytest.approx(1.0, rel=1e-3)
        return
    assert found.failure is None
    k = sqrt(force / EI)
    exact = side / force * (tan(k * length) / k - length)
    head = deflection(found, -20.0)[0]
    assert head == pytest.approx(exact, rel=1e-4)
    assert abs(head / exact - 1.0) <= 1.1 * found.error + 1e-9
    assert moments(found, np.array([0.0]))[0] == pytest.approx(side * length + force * head)
    assert iterations(found) <= 4


SOFTENING = ((0.0, 0.0), (0.003, 60e3), (0.02, 24e3))  # m, Pa


def shot(tip: float, EA: float) -> tuple[float, float]:
    """Settlement and force of the head of a floating pile whose tip has moved, by integration."""
    w, t = np.array(SOFTENING).T

    def slopes(_: float, state: Sequence[float]) -> tuple[float, float]:
        return state[1] / EA, pi * float(np.interp(state[0], w, t))

    up = solve_ivp(slopes, (0.0, 50.0), (tip, 0.0), rtol=1e-10, atol=1e-9, max_step=0.5)
    return float(up.y[0, -1]), float(up.y[1, -1])


@pytest.mark.parametrize("steps", [1, 8])
def test_a_shaft_that_softens_has_a_limit_point(tmp_path, steps):
    """Progressive failure: the peak of a shooting method, at 0.8 of the sum of peak frictions."""
    EA = 8e9
    top = minimize_scalar(
        lambda tip: -shot(tip, EA)[1],
        bounds=(1e-5, 0.02),
        method="bounded",
        options={"xatol": 1e-9},
    )
    peak = -float(top.fun)
    assert 0.6 < peak / (pi * 60e3 * 50.0) < 0.95
    rows = "".join(f"{t!r} {w!r} 0 0\n" for w, t in SOFTENING[1:])

    def loaded(force: float) -> Solved:
        return solved(
            tmp_path,
            f"*GROUNDEPTH\n0\n*TZCURVE\n1 0\n0 60e3\n{rows}*GROUNDPROP\n0 1\n",
            f"0 -50 1 0.02 210e9 7850 EA={EA!r}",
            f"*LOAD\nP 1 0 0 0 {-force!r}\n",
            steps,
        )

    found = loaded(1.2 * peak)
    assert found.failure is not None
    assert 1.2 * found.failure.factors[0] == pytest.approx(1.0, rel=5e-4)
    found = loaded(0.95 * peak)
    assert found.failure is None
    tip = brentq(lambda w: shot(w, EA)[1] - 0.95 * peak, 1e-7, top.x)
    settled = found.results.settlement(np.array([0.0]))[-1, 0]
    assert settled == pytest.approx(shot(tip, EA)[0], rel=1e-3)
    assert iterations(found) <= 5 * steps + 5


def two_beams(stiffness: tuple[float, float], k: float, joint: float, end: float, H: float):
    """Head displacement and slope of a beam on springs of two stiffnesses, by exact functions."""

    def state(EI: float, x: float, length: float) -> np.ndarray:
        """Rows y, y', EI y'', EI y''' of four solutions, each at most 1 within its part."""
        b = (k / (4.0 * EI)) ** 0.25
        rows = []
        for derivative in range(4):
            row = []
            for r, at in ((complex(-b, b), x), (complex(b, b), x - length)):
                value = r**derivative * np.exp(r * at)
                row += [value.real, value.imag]
            rows.append(np.array(row) * (EI if derivative > 1 else 1.0))
        return np.array(rows)

    (upper, lower), rest = stiffness, end - joint
    matrix, right = np.zeros((8, 8)), np.zeros(8)
    matrix[:2, :4], right[1] = state(upper, 0.0, joint)[2:], H
    matrix[2:6, :4], matrix[2:6, 4:] = state(upper, joint, joint), -state(lower, 0.0, rest)
    matrix[6:, 4:] = state(lower, rest, rest)[2:]
    size = np.abs(matrix).max(axis=1)
    c = np.linalg.solve(matrix / size[:, None], right / size)
    return state(upper, 0.0, joint)[:2] @ c[:4], state(lower, 0.0, rest)[2] @ c[4:]


@pytest.mark.parametrize("stiffness", [(1e12, 1e6), (1e6, 1e12)])
def test_sections_whose_stiffness_differs_by_a_million(tmp_path, stiffness):
    k, joint, end, H = 1e7, 6.0, 20.0, 1e5
    upper, lower = stiffness
    found = solved(
        tmp_path,
        f"*GROUNDEPTH\n0\n{linear_curve(1, k)}*GROUNDPROP\n1 0\n",
        f"0 -6 1 0.05 210e9 7850 EI={upper!r} EA=1e10\n"
        f"-6 -20 1 0.05 210e9 7850 EI={lower!r} EA=1e10",
        f"*SUPPORT\n1 -20 Z\n*LOAD\nP 1 0 {H!r} 0 0\n*ACCURACY\n1e-6\n",
    )
    assert found.failure is None
    (y, slope), moment = two_beams(stiffness, k, joint, end, H)
    head = deflection(found, 0.0, 1e-3)
    assert head[0] == pytest.approx(y, rel=1e-6)
    assert (head[1] - head[0]) / 1e-3 == pytest.approx(slope, rel=1e-3)
    largest = np.abs(moments(found, np.linspace(0.0, 20.0, 2001))).max()
    assert abs(moments(found, np.array([joint]))[0] - moment) <= 1e-6 * largest
    assert iterations(found) <= 3


@pytest.mark.parametrize("spring", [1e0, 1e6, 1e8, 1e10, 1e18])
def test_a_head_on_a_moment_spring(tmp_path, spring):
    """Hetenyi's half-infinite beam, head free to fixed: turn (k + 4 b^3 K) = 2 b^2 H."""
    EI, k, H = 5e7, 2e6, 1e4
    found = solved(
        tmp_path,
        f"*GROUNDEPTH\n0\n{linear_curve(1, k)}*GROUNDPROP\n1 0\n",
        f"0 -60 1 0.1 210e9 7850 EI={EI!r} EA=1e9",
        f"*SUPPORT\n1 -60 Z\n*SPRING\n1 0 RY {spring!r}\n*LOAD\nP 1 0 {H!r} 0 0\n*ACCURACY\n1e-6\n",
    )
    assert found.failure is None
    b = (k / (4.0 * EI)) ** 0.25
    turn = 2.0 * b**2 * H / (k + 4.0 * b**3 * spring)
    y = 2.0 * b * (H - b * spring * turn) / k
    assert deflection(found, 0.0)[0] == pytest.approx(y, rel=1e-6)
    free = H / b * np.exp(-pi / 4) * sin(pi / 4)
    assert abs(moments(found, np.array([0.0]))[0] + spring * turn) <= 1e-6 * free
    assert iterations(found) <= 2
