"""Stiff clay: check tables 06 and 07, and what they do not reach."""

from dataclasses import replace

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.soil.stiff_clay import StiffClay, StiffClayFreeWater, default_subgrade_modulus
from test_soil_tables import KILO, close, table

both = pytest.mark.parametrize("cyclic", [False, True], ids=["static", "cyclic"])


def free_water(**changed):
    """pc = 2.31 MN/m, y50 = 5 mm, As = 0.552, with c = ca = 150 kPa at 4 m unless changed."""
    given = {
        "depth": 4.0,
        "diameter": 1.8,
        "effective_overburden": 40e3,
        "undrained_shear_strength": 150e3,
        "mean_undrained_shear_strength": 150e3,
        "strain_50": 0.005 / 1.8,
        "subgrade_modulus": 270e6,
    }
    return StiffClayFreeWater(**given | changed)


def of_table(kind):
    t = table("06", kind=kind)
    return t, StiffClayFreeWater(
        depth=t["z"],
        diameter=t["D"],
        effective_overburden=t["gam"] * t["z"] * KILO,
        undrained_shear_strength=t["c"] * KILO,
        mean_undrained_shear_strength=t["ca"] * KILO,
        strain_50=t["eps50"],
        subgrade_modulus=t["k"] * KILO,
        cyclic=kind == "cyclic",
    )


@pytest.mark.parametrize(("kind", "A", "jumps"), [("static", "As", (6, 18)), ("cyclic", "Ac", ())])
def test_free_water(kind, A, jumps):
    t, law = of_table(kind)
    close(law.ultimate_resistance, t["pc"] * KILO)
    close(law.derived["A"], t[A])
    y50 = t["eps50"] * t["D"]
    at = [n * t["As"] * y50 for n in jumps] or [0.6 * 4.1 * t["Ac"] * y50]
    jump = np.any([np.isclose(t["y"], y, rtol=1e-6) for y in at], axis=0)
    assert jump.sum() == 3 * len(at)
    close(law.force(t["y"])[~jump], t["p_ref"][~jump] * KILO)
    sides = np.array([law.force(t["y"] * (1.0 + side)) for side in (-2e-8, 2e-8)])
    nearest = np.abs(sides / KILO - t["p_ref"]).argmin(axis=0)
    close(np.take_along_axis(sides, nearest[None], axis=0)[0][jump], t["p_ref"][jump] * KILO)


def test_the_wedge_has_the_mean_strength_and_the_flow_around_the_local_one():
    wedge = 2 * 100e3 * 1.8 + 40e3 * 1.8 + 2.83 * 100e3 * 4.0
    close(free_water(mean_undrained_shear_strength=100e3).ultimate_resistance, wedge)
    deep = free_water(mean_undrained_shear_strength=100e3, undrained_shear_strength=60e3)
    close(deep.ultimate_resistance, 11 * 60e3 * 1.8)


def test_breakpoints_belong_to_the_branch_beyond_them_and_the_law_jumps_up_there():
    static, cyclic = (free_water(cyclic=cyclic) for cyclic in (False, True))
    As, Ac = static.derived["A"], cyclic.derived["A"]
    for law, y, jump in (
        (static, 6 * As * 0.005, 0.055 * 5**1.25 - 0.411),
        (static, 18 * As * 0.005, (1.225 - 0.5 * 6**0.5) * As**0.5),
        (cyclic, 0.6 * 4.1 * Ac * 0.005, Ac * (0.936 - 1 + 3**-2.5)),
        (cyclic, 1.8 * 4.1 * Ac * 0.005, 0.0),
    ):
        below, beyond = law.force(y * (1 - 1e-9)), law.force(y * (1 + 1e-9))
        np.testing.assert_allclose(beyond - below, jump * law.ultimate_resistance, atol=0.1)
    mudline = free_water(depth=0.0, diameter=1.0, strain_50=0.005, subgrade_modulus=1e12)
    force, stiffness = mudline.evaluate(np.array([0.006]))  # 6 As y50
    pc = mudline.ultimate_resistance
    close(force, pc * (0.5 * 1.2**0.5 - 0.411))
    close(stiffness, -0.0625 * pc / 0.005)


def test_the_static_residual_is_never_negative():
    ratio = np.linspace(0.0, 0.2, 201)
    law = free_water(depth=ratio * 1.8)
    As, residual = law.derived["A"], law.derived["residual_resistance"]
    close(residual > 0.0, As > ((1.225 - (1.225**2 - 3 * 0.411) ** 0.5) / 1.5) ** 2)
    assert 0 < (residual == 0.0).sum() < len(ratio)
    for r in np.linspace(0.0, 20.0, 401):
        assert (law.force(np.full(201, r * 0.005)) >= 0.0).all()
    mudline = free_water(depth=0.0, subgrade_modulus=1e12)
    end = (6 * 0.2 + (0.5 * 1.2**0.5 - 0.411) / 0.0625) * 0.005  # before 18 As y50 = 18 mm
    before, after = mudline.evaluate(np.array([end * (1 - 1e-9), end * (1 + 1e-9)]))
    assert 0.0 < before[0] < 1.0
    assert before[1] == 0.0
    close(after[0], -0.0625 * mudline.ultimate_resistance / 0.005)
    assert after[1] == 0.0


def test_the_cyclic_residual_is_about_a_sixth_of_pc_at_depth():
    law = free_water(cyclic=True)
    np.testing.assert_allclose(law.derived["A"], 0.2997, rtol=1e-3)
    close(law.force(np.array([1.0])), 0.5178 * law.derived["A"] * law.ultimate_resistance)


@both
def test_small_displacements_of_the_cyclic_law_keep_their_digits(cyclic):
    """A steep line leaves the law's own start: its slope, or its square root."""
    law, y = free_water(cyclic=cyclic, subgrade_modulus=1e18), np.array([1e-13])
    pc, A = law.ultimate_resistance, law.derived["A"]
    start = 2.5 * pc / (0.45 * 4.1 * 0.005) * y if cyclic else 0.5 * pc * np.sqrt(y / 0.005)
    np.testing.assert_allclose(law.force(y), start, rtol=1e-9)
    assert A.shape == (1,)


def printed(law, y):
    """The printed law of one point below its line, at one displacement."""
    pc, A, y50 = (law.derived[n][0] for n in ("ultimate_resistance", "A", "y50"))
    r, yp = y / y50, 4.1 * A * y50
    if law.cyclic and y < 0.6 * yp:
        p = A * pc * (1 - abs((y - 0.45 * yp) / (0.45 * yp)) ** 2.5)
    elif law.cyclic:
        p = 0.936 * A * pc - 0.085 * pc / y50 * (min(y, 1.8 * yp) - 0.6 * yp)
    elif r < 6 * A:
        p = 0.5 * pc * r**0.5 - 0.055 * pc * (max(r - A, 0.0) / A) ** 1.25
    elif r < 18 * A:
        p = 0.5 * pc * (6 * A) ** 0.5 - 0.411 * pc - 0.0625 * pc * (r - 6 * A)
    else:
        p = pc * (1.225 * A**0.5 - 0.75 * A - 0.411)
    return max(min(p, law.initial_stiffness[0] * y), 0.0)


@both
@pytest.mark.parametrize("k", [2e6, 6e6, 9e6, 1.4e7, 5e7, 270e6, 1e9])
@pytest.mark.parametrize("depth", [0.0, 0.1, 1.0, 4.0, 30.0])
def test_free_water_is_the_printed_law_and_the_smaller_of_it_and_the_line(cyclic, k, depth):
    law = free_water(depth=depth, subgrade_modulus=k, cyclic=cyclic)
    y = np.concatenate((np.geomspace(1e-8, 1e-3, 20), np.arange(0.0013, 0.08, 0.0009)))
    expected = np.array([printed(law, float(x)) for x in y])
    np.testing.assert_allclose(law.force(y), expected, atol=1e-13 * law.ultimate_resistance[0])


@both
def test_capacity_is_the_largest_reaction_of_law_and_line_together(cyclic):
    """Also where a soft line meets the law past its peak, in the fall, or on the residual."""
    k = np.array([5e4, 2e6, 4e6, 6e6, 9e6, 1.4e7, 2e7, 5e7, 270e6, 1e9])
    law = free_water(subgrade_modulus=k, cyclic=cyclic)
    y = np.concatenate((np.linspace(0.0, 0.1, 20001), np.geomspace(0.1, 100.0, 4001)))
    largest = law.force(y[:, None] + np.zeros(len(k))).max(axis=0)
    assert (largest <= law.capacity).all()
    np.testing.assert_allclose(largest, law.capacity, rtol=1e-3)
    meeting = law.capacity / law.initial_stiffness
    on_line = law.force(meeting * (1 - 1e-9)) / law.capacity > 1 - 1e-8
    assert on_line[:6].all()
    assert not on_line[-1]
    assert law.capacity[0] < 0.6 * law.capacity[-1]


def test_the_initial_line_has_a_least_depth_of_a_tenth_of_a_diameter():
    z = np.array([0.0, 0.1, 0.18, 0.36])
    law = free_water(depth=z)
    close(law.initial_stiffness, 270e6 * np.array([0.18, 0.18, 0.18, 0.36]))
    y = np.full(4, 1e-6)
    close(law.force(y), law.initial_stiffness * 1e-6)
    close(law.stiffness(np.zeros(4)), law.initial_stiffness)


def test_the_default_modulus_goes_in_steps():
    c = np.array([10.0, 50.0, 100.0, 100.1, 200.0, 200.1, 400.0, 900.0]) * KILO
    static, cyclic = np.array([135e6, 270e6, 540e6]), np.array([55e6, 110e6, 217e6])
    steps = [0, 0, 0, 1, 1, 2, 2, 2]
    assert (default_subgrade_modulus(c) == static[steps]).all()
    assert (default_subgrade_modulus(c, cyclic=True) == cyclic[steps]).all()
    assert default_subgrade_modulus(150e3) == 270e6
    for kind, k in ((False, static), (True, cyclic)):
        law = free_water(subgrade_modulus=None, undrained_shear_strength=c, cyclic=kind)
        close(law.initial_stiffness, 4.0 * k[steps])


@both
def test_the_multiplier_acts_on_the_reaction_alone(cyclic):
    y = np.array([1e-6, 1e-3, 0.02, 1.0])
    for law in (free_water(cyclic=cyclic), dry(cyclic=cyclic)):
        half = replace(law, multiplier=0.5)
        np.testing.assert_allclose(half.evaluate(y), 0.5 * np.array(law.evaluate(y)), rtol=1e-14)
        close(half.capacity, 0.5 * law.capacity)


def dry(t=None, **changed):
    given = {
        "depth": 3.0,
        "diameter": 0.9,
        "effective_overburden": 57e3,
        "undrained_shear_strength": 120e3,
        "mean_undrained_shear_strength": 120e3,
        "strain_50": 0.006,
    }
    if t is not None:
        given |= {"depth": t["z"], "effective_overburden": t["gam"] * t["z"] * KILO}
    return StiffClay(**given | changed)


def test_without_free_water():
    t = table("07")
    static, cyclic = dry(t), dry(t, cyclic=True)
    close(static.ultimate_resistance, t["pu"] * KILO)
    close(static.force(t["y"]), t["p_ref"] * KILO)
    close(cyclic.force(t["y_cyc_N100_ref"]), t["p_ref"] * KILO)
    close(dry(t, cycles=1.0, cyclic=True).force(t["y"]), t["p_ref"] * KILO)
    close(dry(t, cycles=7.0).force(t["y"]), t["p_ref"] * KILO)  # static counts no cycles


def test_after_n_cycles_the_same_resistance_takes_the_published_displacement():
    y, y50, N = np.geomspace(0.01, 16.0, 20) * 0.0135, 0.0135, 3000.0
    p = dry().force(y)
    ratio = p / dry().ultimate_resistance
    later = y + y50 * 9.6 * ratio**4 * np.log10(N)
    close(dry(cyclic=True, cycles=N).force(later), p)


def test_resistance_without_free_water_has_the_mean_strength_in_its_wedge():
    pu = (3 * 80e3 + 57e3) * 0.9 + 0.25 * 80e3 * 3.0
    close(dry(mean_undrained_shear_strength=80e3, j=0.25).ultimate_resistance, pu)
    close(dry(undrained_shear_strength=30e3).ultimate_resistance, 9 * 30e3 * 0.9)


@both
def test_the_rounded_root_is_as_near_as_its_page_says_and_below_its_plateau(cyclic):
    law = dry(cyclic=cyclic)
    s = np.array([1e-6, 0.01, 1.0, 15.9])
    root = 0.5 * law.ultimate_resistance * s**0.25
    error = 1.0 - law.force(s * law.y50) / root
    assert (error < np.array([3.8e-9, 1e-14, 1e-14, 1e-14])).all()
    assert error[0] > 3.7e-9
    pu = law.ultimate_resistance
    edge = 16.0 * law.y50 * np.array([1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1e6])
    force, stiffness = law.evaluate(edge)
    assert (force <= pu).all()
    np.testing.assert_allclose(force, pu.repeat(4), rtol=4e-13)
    assert stiffness[0] > 0.0
    assert (stiffness[1:] == 0.0).all()


@pytest.mark.parametrize("cycles", [0.0, 0.5, float("nan")])
def test_less_than_one_cycle_is_refused(cycles):
    with pytest.raises(InvalidData) as error:
        dry(cyclic=True, cycles=cycles)
    assert error.value.field == "CYCLES"
