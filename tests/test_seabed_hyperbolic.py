"""The hyperbolic seabed: its table, its slopes, its bounds, and what it gives back too much."""

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.seabed.hyperbolic import Hyperbolic, HyperbolicSoil
from podeep.soil.energy import energy
from seabeds import SOIL, D, cycle

TABLE = cycle("R1")


def at(*values: float) -> np.ndarray:
    return np.array(values)


def pushed(*path: float, **more) -> Hyperbolic:
    law = Hyperbolic(SOIL, 1, **more)
    for z in path:
        law.commit(at(z))
    return law


def test_table_10_on_every_branch() -> None:
    law, seen = Hyperbolic(SOIL, 1), set()
    for branch, z, force in TABLE:
        found, _ = law.evaluate(at(z))
        assert found[0] == pytest.approx(force, rel=1e-11, abs=1e-9), (branch, z)
        law.commit(at(z))
        seen.add(branch)
    assert seen == {"ip", "up", "re", "none"}
    assert len(TABLE) == 32


def test_ultimate_resistance_and_its_derivative() -> None:
    z = np.array([0.01, 0.029, 0.031, 0.15])
    most, slope = SOIL.ultimate(z)
    factor = np.where(z < 0.1 * D, 6.0 * 0.1**0.25 * np.sqrt(10.0 * z / D), 6.0 * (z / D) ** 0.25)
    np.testing.assert_allclose(most, factor * (1500.0 + 1500.0 * z) * D, rtol=1e-14)
    change = (SOIL.ultimate(z + 1e-8)[0] - SOIL.ultimate(z - 1e-8)[0]) / 2e-8
    np.testing.assert_allclose(slope, change, rtol=1e-6)


@pytest.mark.parametrize("path", [(0.09,), (0.09, 0.06), (0.09, -0.01, 0.05), (0.09, 0.06, 0.07)])
def test_any_reversal_starts_with_the_largest_stiffness(path) -> None:
    """K_max Pu(z0)/D, z0 being where this uplift begins, or where the one before began."""
    law = pushed(*path)
    down = law.down[0]
    here = SOIL.ultimate(at(path[-1] if down else 0.09))[0]
    step = -1e-12 if down else 1e-12
    _, slope = law.evaluate(law.z + step)
    assert slope[0] == pytest.approx(200.0 / D * here, rel=1e-6)


def test_bounds_and_limits() -> None:
    law = pushed(0.09)
    suction = -0.6 * SOIL.ultimate(at(0.08))[0]
    assert law.evaluate(at(0.08))[0] >= suction
    far = law.evaluate(at(0.01))[0]
    decay = np.exp(-0.08 / (0.6 * 0.09))
    assert far == pytest.approx(-0.6 * decay * SOIL.ultimate(at(0.01))[0])
    assert law.evaluate(at(0.0)) == (0.0, 0.0)
    again = pushed(0.09, -0.01)
    assert again.evaluate(at(1e-9))[0] == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("rejoins", [False, True])
def test_the_derivative_on_every_branch(rejoins: bool) -> None:
    law = Hyperbolic(SOIL, 1, rejoins=rejoins)
    for _, z, _ in TABLE:
        if z > 0.0 and z != law.z[0]:
            step = 1e-7 * abs(z - law.z[0])
            ahead, here, behind = (law.evaluate(at(z + s))[0][0] for s in (step, 0.0, -step))
            sides = np.sort([(ahead - here) / step, (here - behind) / step])  # differ at corners
            slope = law.evaluate(at(z))[1][0]
            slack = 1.0 + 1e-4 * np.abs(sides).max()
            assert sides[0] - slack <= slope <= sides[1] + slack
        law.commit(at(z))


def test_two_readings_of_the_deepest_penetration() -> None:
    """As the table has it re-penetration stays at exp(-0.3) of the first curve; the other reading
    joins it at 1.3 times the deepest penetration before."""
    first = SOIL.evaluate(at(0.2))[0]
    assert pushed(0.09, 0.0).evaluate(at(0.2))[0] == pytest.approx(np.exp(-0.3) * first)
    joins = pushed(0.09, 0.0, rejoins=True)
    bound = np.exp(0.1 / 0.09 - 1.3) * SOIL.evaluate(at(0.1))[0]
    assert joins.evaluate(at(0.1))[0] == pytest.approx(bound)
    joins.commit(at(0.11))
    for z in (0.118, 0.2):  # its own hyperbola is just below the first curve
        assert joins.evaluate(at(z))[0] == pytest.approx(SOIL.evaluate(at(z))[0], rel=5e-3)


def test_a_small_cycle_under_load_does_not_drop_to_the_bound() -> None:
    """The bound at once would take a quarter of the force, and the cycle would give energy."""
    law = pushed(0.09)
    down = law.evaluate(at(0.0899))[0]
    law.commit(at(0.0899))
    assert law.evaluate(at(0.0899 + 1e-9))[0] == pytest.approx(down, rel=1e-3)
    assert law.evaluate(at(0.09))[0] > 0.97 * SOIL.evaluate(at(0.09))[0]
    assert law.evaluate(at(0.09))[0] > np.exp(-0.3) * SOIL.evaluate(at(0.09))[0]


def test_a_shallow_touch_gives_more_than_it_took() -> None:
    """A property of the curves: 4 mJ/m at most in this soil, below 2 mm."""
    depths = np.linspace(2e-4, 6e-3, 30)
    law = Hyperbolic(SOIL, 30)
    for share in np.linspace(0.0, 1.0, 800)[1:]:
        law.commit(share * depths)
    np.testing.assert_allclose(law.worked, energy(SOIL, depths), rtol=1e-3)
    assert law.dissipated.min() == pytest.approx(-3.8e-3, abs=4e-4)
    assert (law.dissipated[depths > 2e-3] > 0.0).all()


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"diameter": 0.0}, "diameter, m, of 0; give more than 0"),
        ({"undrained_shear_strength": np.inf}, "undrained shear strength, Pa, of inf"),
        ({"undrained_shear_strength": -1.0}, "undrained shear strength, Pa, of -1"),
        ({"strength_gradient": np.nan}, "gradient of the undrained shear strength, Pa/m, of nan"),
        ({"normalised_stiffness": 0.0}, "normalised stiffness of 0"),
        ({"suction_ratio": -0.1}, "suction ratio of -0.1; give 0 or more"),
    ],
)
def test_what_makes_no_seabed(more, words: str) -> None:
    with pytest.raises(InvalidData, match=words):
        HyperbolicSoil(**{"diameter": D, "undrained_shear_strength": 1500.0, **more})
