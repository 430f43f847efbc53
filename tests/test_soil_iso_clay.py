"""Clay of ISO 19901-4's third edition: the check table, its limits and its interpolation in OCR."""

import csv
from pathlib import Path

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.soil.iso_clay import IsoClay

(TABLE,) = (Path(__file__).parent / "data" / "soil").glob("04_*.csv")
KILO = 1e3


def table(**equal):
    """Columns of the check table (kN, kPa, m) where the given columns hold the given text."""
    with TABLE.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [row for row in rows if all(row[name] == text for name, text in equal.items())]
    assert rows
    texts = ("Ip_class", "gap")
    return {n: np.array([float(r[n]) for r in rows]) for n in rows[0] if n not in texts}


def clay(**changes):
    """Soft clay of 5 kPa + 1.5 kPa/m at 4 m, a pile of 2 m, with what a test changes."""
    given = {
        "depth": 4.0,
        "diameter": 2.0,
        "effective_overburden": 24e3,
        "undrained_shear_strength": 11e3,
        "mudline_strength": 5e3,
        "strength_gradient": 1.5e3,
        "adhesion": 0.8,
        "overconsolidation_ratio": 2.0,
    }
    return IsoClay(**{**given, **changes})


@pytest.mark.parametrize("gap", ["gap", "nogap"])
@pytest.mark.parametrize("plasticity", ["gt30", "le30"])
def test_check_table(gap, plasticity):
    t = table(gap=gap, Ip_class=plasticity)
    law = IsoClay(
        depth=t["z"],
        diameter=t["D"],
        effective_overburden=t["gam"] * t["z"] * KILO,
        undrained_shear_strength=(t["su0"] + t["su1"] * t["z"]) * KILO,
        mudline_strength=t["su0"] * KILO,
        strength_gradient=t["su1"] * KILO,
        adhesion=t["alpha"],
        overconsolidation_ratio=t["OCR"],
        no_gap=gap == "nogap",
        plasticity={"gt30": "HIGH", "le30": "LOW"}[plasticity],
    )
    ours = (
        law.derived["Np0"],
        law.derived["Np"],
        law.ultimate_resistance / KILO,
        law.force(t["y_over_D"] * t["D"]) / KILO,
    )
    reference = [t[name] for name in ("Np0", "Np", "pu", "p")]
    np.testing.assert_allclose(ours, reference, rtol=1e-6, atol=0.0)


@pytest.mark.parametrize("plasticity", ["HIGH", "LOW"])
@pytest.mark.parametrize(("ocr", "column"), [(1.0, 0), (2.0, 0), (4.0, 1), (10.0, 2), (25.0, 2)])
def test_the_curve_passes_through_its_column_and_is_held_outside(plasticity, ocr, column):
    """Rows of the standard's table that no check row reaches: p/pu = 0.2 to 1 at y/D."""
    columns = {
        "HIGH": [(0.003, 0.014, 0.05, 0.25), (0.004, 0.024, 0.084, 0.3), (0.005, 0.034, 0.12, 0.4)],
        "LOW": [
            (0.001, 0.0048, 0.017, 0.083),
            (0.002, 0.012, 0.042, 0.15),
            (0.0033, 0.023, 0.08, 0.27),
        ],
    }
    nodes = columns[plasticity][column]
    law = clay(overconsolidation_ratio=ocr, plasticity=plasticity)
    share = [law.force(np.array([2.0 * x]))[0] / law.capacity[0] for x in nodes]
    np.testing.assert_allclose(share, (0.2, 0.5, 0.8, 1.0), rtol=1e-12)


@pytest.mark.parametrize(("ocr", "node"), [(3.0, 0.019), (7.0, 0.029)])
def test_displacements_are_linear_in_ocr(ocr, node):
    law = clay(overconsolidation_ratio=ocr)
    assert law.force(np.array([2.0 * node]))[0] == pytest.approx(0.5 * law.capacity[0], rel=1e-12)


def test_points_of_different_ocr_do_not_mix():
    ocr, u = np.array([1.0, 3.0, 30.0]), np.array([0.02, 0.02, 0.02])
    alone = [clay(overconsolidation_ratio=float(o)).evaluate(u[:1]) for o in ocr]
    together = clay(overconsolidation_ratio=ocr)
    assert together.capacity.shape == (3,)
    np.testing.assert_array_equal(together.evaluate(u), np.array(alone)[:, :, 0].T)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_derivative_at_a_corner_is_the_one_away_from_zero(sign):
    law, D = clay(diameter=1.0), 1.0
    u = sign * np.array([0.0003, 0.25]) * D
    first = 0.15 / (0.003 - 0.0003) / D
    np.testing.assert_allclose(law.stiffness(u), law.capacity * [first, 0.0], rtol=1e-12)


@pytest.mark.parametrize(
    ("su0", "su1"), [(0.0, 1.5e3), (0.0, 0.0), (5e3, 0.0), (5e3, -1e3), (30e3, 1.5e3)]
)
def test_d_takes_its_lower_bound_where_the_logarithm_has_no_value(su0, su1):
    assert clay(mudline_strength=su0, strength_gradient=su1).derived["d"] == pytest.approx(14.5)


def test_d_falls_with_the_strength_at_the_mudline():
    d = clay(mudline_strength=np.array([0.3e3, 3e3, 30e3, 300e3])).derived["d"]
    np.testing.assert_allclose(d, (19.1, 16.8, 14.5, 14.5), rtol=1e-14)


def test_clay_in_extension_takes_the_factor_of_the_uncorrected_bearing_factor():
    """By hand at the mudline, where cw = r, half way to Npd, and at depth, where cw = 1."""
    weak, even = clay(depth=0.0, effective_overburden=0.0, strength_ratio=0.9), 2.22 + 0.8
    np.testing.assert_allclose(weak.derived["Np"], 0.9 * even, rtol=1e-14)
    full = clay()
    Np0, Npd, N = (full.derived[name][0] for name in ("Np0", "Npd", "Np"))
    cw = 1.0 - 0.1 * (Npd - N) / (Npd - even)
    assert 0.9 < cw < 0.99
    corrected = clay(strength_ratio=0.9).derived["Np"]
    np.testing.assert_allclose(corrected, cw * Np0 + 24.0 / 11.0, rtol=1e-14)
    deep = {"depth": 60.0, "effective_overburden": 360e3}
    for ratio in (0.9, 1.0, 2.0):
        assert clay(**deep, strength_ratio=ratio).derived["Np"] == Npd


def test_the_multiplier_acts_on_p_at_the_same_displacement():
    u = np.array([1e-5, 0.02, 0.5, 50.0])[:, None]
    full, half = clay(), clay(multiplier=0.5)
    np.testing.assert_allclose(half.evaluate(u), 0.5 * np.array(full.evaluate(u)), rtol=1e-14)
    assert half.capacity == 0.5 * full.capacity
    assert half.derived["Np"] == full.derived["Np"]


@pytest.mark.parametrize("gap", [True, False])
def test_clay_without_strength_or_overburden(gap):
    u = np.array([0.0, 1e-9, 0.1, 1e3])
    soil = {"effective_overburden": np.array([24e3, 24e3, 0.0, 0.0]), "no_gap": not gap}
    weak = clay(undrained_shear_strength=0.0, mudline_strength=0.0, **soil)
    assert (np.array(weak.evaluate(u)) == 0.0).all()
    assert (weak.derived["Np"] == weak.derived["Npd"]).all()
    firm = clay(depth=np.array([0.0, 30.0, 0.0, 1e3]), **soil)
    assert np.isfinite(firm.evaluate(u)).all()
    at_mudline = (2.22 + 0.8) * (1.0 if gap else 2.0) * 11e3 * 2.0
    assert firm.capacity[2] == pytest.approx(at_mudline, rel=1e-14)


@pytest.mark.parametrize(
    "option", [{"plasticity": "MEDIUM"}, {"no_gap": True, "strength_ratio": 0.9}]
)
def test_options_that_mean_nothing_are_refused(option):
    with pytest.raises(InvalidData):
        clay(**option)
