"""p-multipliers of pile groups."""

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.soil.group import group_multiplier, mean_multiplier
from test_soil_tables import table

ROWS = {"lead": 1, "2nd": 2, "3rd": 3}
METHODS = ("AASHTO", "ROLLINS")
every_method = pytest.mark.parametrize("method", METHODS)


def test_table():
    t = table("10")
    ours = [group_multiplier(s, ROWS[row]) for s, row in zip(t["s_over_D"], t["row"], strict=True)]
    np.testing.assert_allclose(ours, t["pm_ref"], rtol=1e-14)


def test_the_ends_of_the_table_are_exact():
    assert [group_multiplier(3.0, row) for row in (1, 2, 3)] == [0.8, 0.4, 0.3]
    assert [group_multiplier(5.0, row) for row in (1, 2, 3)] == [1.0, 0.85, 0.7]


@pytest.mark.parametrize("spacing", [5.0 + 1e-12, 6.0, 50.0, np.inf])
def test_beyond_the_table_its_last_values_are_held(spacing):
    assert [group_multiplier(spacing, row) for row in (1, 2, 3)] == [1.0, 0.85, 0.7]


def test_rollins():
    """By hand: ln 3 = 1.0986123, ln 5 = 1.6094379."""
    ours = [group_multiplier(s, row, "ROLLINS") for s in (3.0, 5.0) for row in (1, 2, 3)]
    by_hand = [0.7856392, 0.5712784, 0.4091674, 0.9184539, 0.8369077, 0.7156627]
    np.testing.assert_allclose(ours, by_hand, atol=1e-7)
    assert group_multiplier(6.8, 1, "ROLLINS") < 1.0
    assert group_multiplier(6.9, 1, "ROLLINS") == group_multiplier(6.9, 2, "ROLLINS") == 1.0
    assert group_multiplier(8.0, 3, "ROLLINS") < 1.0
    assert group_multiplier(8.1, 3, "ROLLINS") == group_multiplier(np.inf, 3, "ROLLINS") == 1.0


@every_method
def test_multipliers_rise_with_spacing_and_fall_from_row_to_row(method):
    spacings = np.linspace(3.0, 9.0, 61)
    m = np.array([[group_multiplier(s, row, method) for s in spacings] for row in (1, 2, 3, 4, 9)])
    assert (m > 0.0).all()
    assert (m <= 1.0).all()
    assert (np.diff(m, axis=1) >= 0.0).all()
    assert (np.diff(m[:3], axis=0) <= 0.0).all()
    assert (m[2] == m[3]).all()
    assert (m[2] == m[4]).all()


@every_method
def test_the_mean_is_over_the_rows(method):
    lead, second, third = (group_multiplier(4.0, row, method) for row in (1, 2, 3))
    assert mean_multiplier(4.0, 1, method) == lead
    assert mean_multiplier(4.0, 2, method) == pytest.approx((lead + second) / 2, rel=1e-15)
    mean = (lead + second + 3 * third) / 5
    assert mean_multiplier(4.0, 5, method) == pytest.approx(mean, rel=1e-15)


def test_the_mean_of_three_rows_by_hand():
    assert mean_multiplier(3.0, 3) == pytest.approx(0.5, rel=1e-15)
    assert mean_multiplier(5.0, 3) == pytest.approx(0.85, rel=1e-15)


@every_method
@pytest.mark.parametrize("spacing", [2.9, 0.0, -4.0, np.nan])
def test_closer_piles_are_refused(method, spacing):
    for refused in (
        lambda: group_multiplier(spacing, 1, method),
        lambda: mean_multiplier(spacing, 3, method),
    ):
        with pytest.raises(InvalidData, match=f"{spacing:g} diameters .* 3 diameters") as fault:
            refused()
        assert "3 diameters or more" in fault.value.remedy
        assert fault.value.field == "SPACING"


@pytest.mark.parametrize("count", [0, -2])
def test_rows_count_from_one(count):
    with pytest.raises(InvalidData, match=f"no row {count}"):
        group_multiplier(4.0, count)
    with pytest.raises(InvalidData, match=f"no {count} rows"):
        mean_multiplier(4.0, count)


def test_an_unknown_method_is_refused_with_the_known_ones():
    with pytest.raises(InvalidData, match=r"no method REESE.*AASHTO, ROLLINS"):
        group_multiplier(4.0, 1, "REESE")
