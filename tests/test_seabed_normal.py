"""The one-sided reaction of the seabed, its energy, and its mean force over a step."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.errors import InvalidData
from podeep.seabed.normal import OneSided, Winkler, mean_force, rounded
from podeep.soil.energy import energy
from seabeds import Power

K, E = 2e5, 1e-3
BED = Winkler(K, E)
PENETRATIONS = np.array([-0.1, -1e-9, 0.0, 1e-5, 0.5 * E, E, 1.5 * E, 0.02])


def test_the_three_lines_of_the_law() -> None:
    force, _ = BED.evaluate(PENETRATIONS)
    z = PENETRATIONS[3:]
    expected = np.where(z <= E, K * z**2 / (2.0 * E), K * (z - 0.5 * E))
    np.testing.assert_array_equal(force[:3], 0.0)
    np.testing.assert_allclose(force[3:], expected, rtol=1e-14)


@pytest.mark.parametrize("bed", [BED, OneSided(Power(), E)], ids=["linear", "power"])
def test_force_and_derivative_are_continuous_at_both_corners(bed) -> None:
    """The printed sign of the last line would make the force jump by K e, as it does here."""
    for corner in (0.0, E):
        low, high = (bed.evaluate(np.array([corner + s * 1e-12])) for s in (-1.0, 1.0))
        assert high[0] - low[0] == pytest.approx(0.0, abs=1e-6 * K * E)
        assert high[1] - low[1] == pytest.approx(0.0, abs=1e-2 * K)
    jump = K * (E + 0.5 * E) - BED.evaluate(np.array([E]))[0]
    assert jump == pytest.approx(K * E)


def test_pipe_at_rest_by_the_inverse() -> None:
    """Penetration F/K + e/2, or sqrt(2 e F/K) of a light pipe, bears the weight F."""
    for weight in (0.01 * K * E, 0.5 * K * E, 30.0 * K * E):
        z = weight / K + 0.5 * E if weight > 0.5 * K * E else np.sqrt(2.0 * E * weight / K)
        assert BED.evaluate(np.array([z]))[0] == pytest.approx(weight, rel=1e-13)


@pytest.mark.parametrize("bed", [BED, OneSided(Power(), E)], ids=["linear", "power"])
def test_the_derivative_is_that_of_the_force(bed) -> None:
    z = np.array([1e-5, 0.4 * E, 0.9 * E, 1.2 * E, 0.02])
    step = 1e-6 * z
    slope = (bed.evaluate(z + step)[0] - bed.evaluate(z - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(bed.evaluate(z)[1], slope, rtol=1e-6)


def test_a_backbone_behind_a_rounded_corner() -> None:
    bed, far = OneSided(Power(), E), np.array([0.05])
    assert bed.evaluate(far)[0] == Power().evaluate(far - 0.5 * E)[0]
    assert not bed.evaluate(np.array([-1.0, 0.0, 1e-200]))[0].any()
    linear = OneSided(Power(K * 0.3, 1.0), E)
    np.testing.assert_allclose(
        linear.evaluate(PENETRATIONS), BED.evaluate(PENETRATIONS), rtol=1e-14
    )


def test_the_energy_is_the_integral_of_the_force() -> None:
    """K d^3/(6 e) up to the tolerance, K (d^2/2 - e d/2 + e^2/6) beyond."""
    z = np.array([0.3 * E, E, 5.0 * E])
    exact = np.where(z <= E, K * z**3 / (6.0 * E), K * (z**2 / 2 - E * z / 2 + E**2 / 6))
    np.testing.assert_allclose(BED.energy(z), exact, rtol=1e-13)
    np.testing.assert_allclose(energy(BED, z), exact, rtol=1e-5)
    np.testing.assert_array_equal(BED.energy(-z), 0.0)
    assert OneSided(Power(K * 0.3, 1.0), E).energy(z) == pytest.approx(exact, rel=1e-5)


def test_many_points_and_states_at_once() -> None:
    bed = Winkler(np.array([1e5, 2e5, 3e5]), np.array([1e-3, 2e-3, 1e-4]))
    z = np.linspace(-0.01, 0.01, 12).reshape(4, 3)
    for i in range(3):
        alone = Winkler(float(bed.stiffness[i]), float(bed.tolerance[i]))
        np.testing.assert_array_equal(bed.evaluate(z)[0][:, i], alone.evaluate(z[:, i])[0])


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (lambda: Winkler(1e5, 0.0), "tolerance on penetration, m, of 0; give more than 0"),
        (lambda: Winkler(np.array([1.0, -1.0]), E), "contact stiffness of -1"),
        (lambda: Winkler(np.inf, E), "contact stiffness of inf"),
        (lambda: Winkler(np.nan, E), "contact stiffness of nan"),
        (lambda: OneSided(Power(), -1e-3), "tolerance on penetration, m, of -0.001"),
    ],
)
def test_what_makes_no_seabed(made, words: str) -> None:
    with pytest.raises(InvalidData, match=words):
        made()


# --- the mean force of a step ---------------------------

places = st.floats(-5.0 * E, 20.0 * E) | st.sampled_from([-E, 0.0, 0.5 * E, E, 3.0 * E])


@settings(deadline=None, max_examples=200)
@given(places, places)
def test_the_mean_force_does_the_work_that_is_stored(start: float, end: float) -> None:
    a, b = np.array([start]), np.array([end])
    force, _ = mean_force(BED, a, b)
    stored = BED.energy(b) - BED.energy(a)
    scale = BED.energy(np.maximum(np.abs(a), np.abs(b)))
    assert force * (b - a) == pytest.approx(stored, abs=1e-14 * scale[0] + 1e-300)
    ends = np.sort([BED.evaluate(a)[0], BED.evaluate(b)[0]], axis=0)
    assert ends[0] - 1e-12 <= force <= ends[1] + 1e-12


@settings(deadline=None, max_examples=100)
@given(places, places)
def test_the_derivative_of_the_mean_force(start: float, end: float) -> None:
    a, b, step = np.array([start]), np.array([end]), 1e-7
    slope = (mean_force(BED, a, b + step)[0] - mean_force(BED, a, b - step)[0]) / (2.0 * step)
    assert mean_force(BED, a, b)[1] == pytest.approx(slope, abs=2e-4 * K)


def test_a_mean_force_without_a_way_is_the_force() -> None:
    for end in (PENETRATIONS, PENETRATIONS + 1e-18, np.nextafter(PENETRATIONS, 1.0)):
        force, slope = mean_force(BED, PENETRATIONS, end)
        np.testing.assert_allclose(force, BED.evaluate(PENETRATIONS)[0], atol=1e-9)
        np.testing.assert_allclose(slope, 0.5 * BED.evaluate(PENETRATIONS)[1], atol=1e-9)


def test_the_mean_force_of_a_backbone() -> None:
    bed = OneSided(Power(), E)
    a, b = np.array([-0.01, 0.5 * E, 0.01, 0.03]), np.array([0.01, 2.0 * E, 0.012, 0.02])
    fine = a + np.linspace(0.0, 1.0, 200_001)[:, None] * (b - a)
    mean = np.trapezoid(bed.evaluate(fine)[0], np.linspace(0.0, 1.0, 200_001), axis=0)
    np.testing.assert_allclose(mean_force(bed, a, b)[0], mean, rtol=1e-6)


def test_rounding_of_a_number() -> None:
    assert [float(x) for x in rounded(2.0, 1.0)] == [1.5, 1.0]
