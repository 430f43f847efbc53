"""Spudcans: tables 17 to 19, and what must hold where no table reaches."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.errors import InvalidData
from podeep.soil import spudcan, spudcan_bearing
from podeep.soil.spudcan_yield import YieldSurface, moment_limit, target_factor
from test_soil_tables import KILO, close, table

few = settings(max_examples=100, deadline=None, derandomize=True)
SURFACE = YieldSurface.for_sand(2e8, 14.0)
ELLIPSOID = YieldSurface(2e8, 2e7, 2.8e8, 1.0)

shares = st.one_of(
    st.sampled_from((0.0, 1.0, -0.1, 1.1, 1e-200, 5e-324, 1.0 - 2.0**-53)), st.floats(-0.5, 1.5)
)
loads = st.one_of(st.sampled_from((0.0, 1.0, 1e-170)), st.floats(-1.5, 1.5))
embedments = st.one_of(st.just(0.0), st.just(1.0), st.floats(0.0, 1.0))
strengths, depths = st.floats(0.0, 4e5), st.floats(0.0, 60.0)
ratios = st.floats(0.0, 3.0)


def clay(su=4e4, diameter=14.0, depth=5.0, overburden=3e4):
    return spudcan_bearing.clay_bearing_capacity(su, diameter, depth, overburden)


def sand(phi=32.0, diameter=10.0, depth=5.0, weight=1e4, overburden=5e4):
    return spudcan_bearing.sand_bearing_capacity(
        np.radians(phi), diameter, depth, weight, overburden
    )


# --- tables -----------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", ["", "_arya"])
def test_stiffness(suffix):
    t = table("17")
    factors = spudcan.arya_factors(t["nu"], t["R"], t["h"]) if suffix else (1.0, 1.0, 1.0)
    K = spudcan.elastic_stiffness(t["G"] * KILO, t["nu"], t["R"], factors)
    close(K.vertical, t[f"K1{suffix}"] * KILO)
    close(K.horizontal, t[f"K2{suffix}"] * KILO)
    close(K.rotational, t[f"K3{suffix}"] * KILO)
    close(K.torsional, t["K4"] * KILO)


def test_bearing_in_clay():
    t = table("18", soil="clay")
    ours = clay(t["su"] * KILO, t["B"], t["Dep"], t["gam"] * t["Dep"] * KILO)
    close(ours.factors["NcScDc"], t["N1(NcScDc|Nq)"])
    close(ours.unit_capacity, t["q"] * KILO)
    close(ours.capacity, t["Qv"] * KILO)


def test_bearing_in_sand():
    t = table("18", soil="sand")
    ours = sand(t["phi"], t["B"], t["Dep"], t["gam"] * KILO, t["gam"] * t["Dep"] * KILO)
    for name in ("Nq", "Ng"):
        close(ours.factors[name], t["N1(NcScDc|Nq)" if name == "Nq" else name])
        close(ours.factors[name], t[f"{name}_groundhog"])
    close(ours.unit_capacity, t["q"] * KILO)
    close(ours.capacity, t["Qv"] * KILO)


@pytest.mark.parametrize("soil", ["sand", "clay"])
def test_yield_surface(soil):
    t = table("19", soil=soil)
    loads = np.array([t["V"], t["H"], t["M"]]) * KILO
    for i, a in enumerate(t["a"]):
        QV, QH, QM = (t[name][i] * KILO for name in ("QV", "QH", "QM"))
        surface = YieldSurface(QV, QH, QM, a)
        close(surface.value(*loads[:, i]), t["F"][i])
        if a == 0.0:
            rf = surface.utilisation(*loads[:, i])
            close(rf, t["rf"][i])
            close(surface.reduction(rf), t["fr"][i])
            close(target_factor(surface, *loads[:, i]), t["fr"][i])
        B = t["B"][i]
        if soil == "sand":
            built = YieldSurface.for_sand(QV, B)
        else:  # of the table's QH, which is only a number: su0 A with su0 = QH/A
            built = YieldSurface.for_clay(QV, B, QH, 0.0, 0.0, 2.5 * B * a, 1.0)
        close(built.value(*loads[:, i]), t["F"][i])


# --- elastic stiffness ------------------------------------------------------------------------


def test_each_motion_takes_its_own_modulus():
    motions = spudcan.elastic_stiffness(spudcan.Moduli(1e6, 2e6, 3e6), 0.3, 7.0)
    one = spudcan.elastic_stiffness(1e6, 0.3, 7.0)
    np.testing.assert_allclose(np.divide(motions, one), (1.0, 2.0, 3.0, 2.0), rtol=1e-15)


def test_shear_moduli():
    iso, sname = spudcan.MODELS["ISO 19905-1"], spudcan.MODELS["SNAME 5-5A"]
    close(iso[0](4e4, np.array([1.0, 16.0])), [24e6, 12e6])
    assert sname[0](1e4, np.array([3.99, 4.0, 10.0, 10.01])).tolist() == [2e6, 1e6, 1e6, 5e5]
    # pressure pa: g pa; at four times the pressure twice that
    close(iso[1](0.5, np.array([101.3e3, 405.2e3]), 1.0), 230.0 * 101.3e3 * np.array([1.0, 2.0]))
    close(iso[1](1.0, 101.3e3, 1.0), 230.0 * 1.1 * 101.3e3)
    close(sname[1](0.5, 2e8, 200.0), [61.5e6, 6.7e6, 15.6e6])
    for vertical_load in (-1e6, 0.0):
        assert iso[1](0.5, vertical_load, 200.0) == 0.0
        assert sname[1](0.5, vertical_load, 200.0) == (36.6e6, 1.1e6, 4.1e6)
    for models in (iso, sname):
        assert spudcan.elastic_stiffness(models[0](4e4, 2.0), 0.5, 7.0).vertical > 0.0
        assert spudcan.elastic_stiffness(models[1](0.5, 1e8, 154.0), 0.2, 7.0).rotational > 0.0


def test_points_are_their_elements():
    nu, R, h = np.array([0.2, 0.5]), np.array([4.0, 8.0]), np.array([0.0, 12.0])
    many = spudcan.elastic_stiffness(2e7, nu, R, spudcan.arya_factors(nu, R, h))
    bearing = spudcan_bearing.sand_over_clay_bearing_capacity(
        0.6, np.array([2e4, 8e4]), 2.0 * R, h, 9e3, 9e3 * h, R
    )
    for i in range(2):
        factors = spudcan.arya_factors(float(nu[i]), float(R[i]), float(h[i]))
        one = spudcan.elastic_stiffness(2e7, float(nu[i]), float(R[i]), factors)
        np.testing.assert_allclose([k[i] for k in many], one, rtol=1e-13)
        alone = spudcan_bearing.sand_over_clay_bearing_capacity(
            0.6, (2e4, 8e4)[i], 2.0 * float(R[i]), float(h[i]), 9e3, 9e3 * float(h[i]), float(R[i])
        )
        np.testing.assert_allclose(bearing.capacity[i], alone.capacity, rtol=1e-13)


# --- bearing capacity -------------------------------------------------------------------------


def test_depth_factor_of_clay():
    factors = clay(diameter=10.0, depth=np.array([0.0, 1.0, 7.5, 25.0, 60.0])).factors["NcScDc"]
    np.testing.assert_allclose(factors, (6.0, 6.3, 7.35, 9.0, 9.0), rtol=1e-15)


@few
@given(su=strengths, more=st.floats(0.0, 1e5), depth=depths, deeper=depths, s=strengths)
def test_clay_carries_more_when_stronger_or_deeper(su, more, depth, deeper, s):
    least = clay(su, 14.0, depth, s).capacity
    assert least >= 0.0
    assert clay(su + more, 14.0, depth, s).capacity >= least
    assert clay(su, 14.0, depth + deeper, s).capacity >= least
    assert clay(su, 14.0, depth, s + more).capacity >= least


@few
@given(phi=st.floats(0.0, 44.0), more=st.floats(0.0, 1.0), depth=depths, deeper=depths, s=strengths)
def test_sand_carries_more_when_stronger_or_deeper(phi, more, depth, deeper, s):
    """Also where dq falls with phi, above 21 degrees; across Dp = B see below."""
    least = sand(phi, 10.0, depth, 1e4, s)
    below = sand(phi, 10.0, depth + deeper, 1e4, s)
    assert least.capacity >= 0.0
    assert sand(phi + more, 10.0, depth, 1e4, s).capacity >= least.capacity * (1.0 - 1e-14)
    if (depth <= 10.0) == (depth + deeper <= 10.0):
        assert below.capacity >= least.capacity * (1.0 - 1e-14)


def test_sand_loses_at_the_depth_of_a_diameter_what_the_printed_factor_loses():
    at, below = (sand(30.0, depth=z, overburden=1e5) for z in (10.0, np.nextafter(10.0, 11.0)))
    tan, slope = np.tan(np.pi / 6.0), 2.0 * np.tan(np.pi / 6.0) * 0.25
    close(at.factors["dq"], 1.0 + slope)
    close(below.factors["dq"], 1.0 + slope * np.pi / 4.0)
    lost = 1e5 * at.factors["Nq"] * (1.0 + tan) * slope * (1.0 - np.pi / 4.0)
    close(at.unit_capacity - below.unit_capacity, lost)


@few
@given(
    su=strengths,
    depth=depths,
    s=strengths,
    thickness=st.one_of(st.just(0.0), st.floats(0.0, 20.0)),
    hard=st.floats(0.0, 2e7),
)
def test_squeezing_never_lowers_and_stays_below_the_hard_layer(su, depth, s, thickness, hard):
    plain = clay(su, 14.0, depth, s)
    squeezed = spudcan_bearing.squeezing_bearing_capacity(su, 14.0, depth, s, thickness, hard)
    assert squeezed.capacity >= plain.capacity
    assert squeezed.unit_capacity <= max(plain.unit_capacity, hard)
    if thickness == 0.0 and su > 100.0:
        assert squeezed.unit_capacity == max(plain.unit_capacity, hard)


@pytest.mark.parametrize(("depth", "deep"), [(0.0, 0.0), (14.0, 1.0), (35.0, 2.5), (60.0, 2.5)])
def test_squeezing_sets_in_below_a_thickness(depth, deep):
    onset = 14.0 / (3.45 * (1.0 + 1.025 * deep))
    plain = clay(depth=depth)

    def squeezed(thickness, hard=1e9):
        return spudcan_bearing.squeezing_bearing_capacity(4e4, 14.0, depth, 3e4, thickness, hard)

    assert squeezed(onset * 1.000001).unit_capacity == plain.unit_capacity
    thin = 0.999999 * onset
    factor = 5.0 + 0.33 * 14.0 / thin + 1.2 * deep
    close(squeezed(thin).unit_capacity, factor * 4e4 + 3e4)
    assert squeezed(thin).capacity > 1.02 * plain.capacity - 0.02 * 3e4 * 154.0
    assert squeezed(1e-3, hard=2e6).unit_capacity == 2e6
    assert squeezed(1e-3, hard=1e5).unit_capacity == plain.unit_capacity


@few
@given(su=strengths, softer=ratios, H=depths, further=depths, depth=depths, s=strengths)
def test_two_clays(su, softer, H, further, depth, s):
    def both(distance):
        return spudcan_bearing.two_clays_bearing_capacity(su, softer * su, 14.0, depth, s, distance)

    firm, soft = clay(su, 14.0, depth, s), clay(softer * su, 14.0, depth, s)
    assert both(0.0).capacity == min(firm.capacity, soft.capacity)
    assert min(firm.capacity, soft.capacity) * (1.0 - 1e-14) <= both(H).capacity <= firm.capacity
    assert both(H + further).capacity >= both(H).capacity * (1.0 - 1e-14)
    if H > 42.0:  # 9 su H/B/3 and more: the soft clay is out of reach
        assert both(H).capacity == firm.capacity


def test_two_clays_by_hand():
    ours = spudcan_bearing.two_clays_bearing_capacity(6e4, 2e4, 10.0, 5.0, 4e4, 5.0)
    close(ours.unit_capacity, 3.0 * 0.5 * 6e4 + 7.7 * 2e4 + 4e4)
    close(ours.factors["top_layer"], 7.0 * 6e4 + 4e4)


@pytest.mark.parametrize(("H", "n", "governs"), [(4.0, 3.0, "projected"), (24.0, 5.0, "spread")])
def test_sand_over_clay_is_the_printed_formulas(H, n, governs):
    B, g, s, su, D = 12.0, 1e4, 5e4, 3e4, 5.0

    def footing(width):
        return spudcan_bearing.clay_bearing_capacity(su, width, 0.0, s + g * H).capacity

    ours = spudcan_bearing.sand_over_clay_bearing_capacity(np.radians(35.0), su, B, D, g, s, H, n)
    area, wide = np.pi * B**2 / 4.0, B + 2.0 * H / n
    Ks_tan = 3.0 * su / (B * g)
    sides = 2.0 * (H / B) * (H * g + 2.0 * s) * Ks_tan * area
    spread = footing(wide) - np.pi * wide**2 / 4.0 * H * g
    projected = footing(B) - area * H * g + sides
    close(ours.factors["load_spread"] * area, spread)
    close(ours.factors["projected_area"] * area, projected)
    close(ours.factors["top_layer"], sand(35.0, B, D, g, s).unit_capacity)
    close(ours.capacity, spread if governs == "spread" else projected)


@few
@given(su=strengths, H=depths, further=depths, s=strengths, phi=st.floats(20.0, 44.0))
def test_sand_over_clay(su, H, further, s, phi):
    def both(distance, spread=5.0):
        return spudcan_bearing.sand_over_clay_bearing_capacity(
            np.radians(phi), su, 12.0, 5.0, 1e4, s, distance, spread
        )

    alone = sand(phi, 12.0, 5.0, 1e4, s)
    assert 0.0 <= both(H).capacity <= alone.capacity
    assert both(0.0).unit_capacity == min(6.0 * su + s, alone.unit_capacity)
    assert both(H + further).capacity >= both(H).capacity
    assert both(H, 3.0).capacity >= both(H).capacity


# --- yield surface ----------------------------------------------------------------------------


def test_constructors():
    clays = [YieldSurface.for_clay(2e8, 14.0, 4e4, 6e4, 30.0, depth) for depth in (0.0, 7.0, 99.0)]
    close(clays[0].horizontal_capacity, 4e4 * np.pi * 49.0 + (4e4 + 6e4) * 30.0)
    close(clays[0].moment_capacity, 0.1 * 14.0 * 2e8)
    np.testing.assert_allclose([c.embedment for c in clays], (0.0, 0.2, 1.0), rtol=1e-15)
    close(YieldSurface.for_clay(2e8, 14.0, 4e4, 6e4, 30.0, 0.0, 50.0).horizontal_capacity, 5e6)
    assert SURFACE.embedment == 0.0


@few
@given(shear=loads, moment=loads, v=st.floats(0.0, 1.0))
def test_the_deep_surface_is_an_ellipsoid(shear, moment, v):
    Q = ELLIPSOID
    F = Q.value(v * 2e8, shear * Q.horizontal_capacity, moment * Q.moment_capacity)
    np.testing.assert_allclose(F, shear**2 + moment**2 + (2.0 * v - 1.0) ** 2 - 1.0, atol=1e-14)


@few
@given(v=shares, shear=loads, moment=loads, a=embedments)
def test_inside_is_inside_by_both_measures(v, shear, moment, a):
    surface = YieldSurface(2e8, 2e7, 2.8e8, a)
    at = (v * 2e8, shear * 2e7, moment * 2.8e8)
    F, rf = surface.value(*at), surface.utilisation(*at)
    assert np.isfinite(F)
    assert (F < 0.0) == (rf < 1.0)
    assert rf >= 0.0
    assert rf == surface.utilisation(at[0], -at[1], -at[2])
    if not 0.0 < at[0] < 2e8:
        assert rf == np.inf
        assert F >= 0.0
        assert target_factor(surface, *at) == 0.0


def test_nothing_is_carried_without_vertical_load_or_at_the_preload():
    V = np.array([-1e12, -1.0, 0.0, 2e8, 2.1e8, 1e12])
    for surface in (SURFACE, ELLIPSOID):
        assert (surface.utilisation(V, 0.0, 0.0) == np.inf).all()
        assert (surface.value(V, 0.0, 0.0) >= 0.0).all()
        assert [moment_limit(surface, v, 0.0) for v in V] == [0.0] * 6
        assert surface.utilisation(1e8, 0.0, 0.0) == 0.0
        assert target_factor(surface, 1e8, 0.0, 0.0) == 1.0


@few
@given(v=shares, shear=loads, a=embedments)
def test_moment_limit_lies_on_the_surface(v, shear, a):
    surface = YieldSurface(2e8, 2e7, 2.8e8, a)
    limit = moment_limit(surface, v * 2e8, shear * 2e7)
    alone = surface.value(v * 2e8, shear * 2e7, 0.0)
    if alone >= 0.0:
        assert limit == 0.0
    else:
        assert 0.0 < limit <= 2.8e8 * (1.0 + 1e-15)
        assert abs(surface.value(v * 2e8, shear * 2e7, limit)) < 1e-12
        assert target_factor(surface, v * 2e8, shear * 2e7, 0.999 * limit) >= 0.1
    if alone < -1e-9:
        assert target_factor(surface, v * 2e8, shear * 2e7, 1.001 * limit) == 0.0


def test_reduction_falls_all_the_way():
    rf = np.unique(np.concatenate((np.linspace(0.0, 1.0, 100001), 1.0 - np.logspace(-15, 0, 3001))))
    fr = YieldSurface.reduction(rf)
    assert (np.diff(fr) < 0.0).all()
    assert (fr[0], fr[-1]) == (1.0, 0.1)
    assert (YieldSurface.reduction(np.array([np.nextafter(1.0, 2.0), 3.0, np.inf])) == 0.0).all()
    # the two slopes come closest at rf = 0.995
    x = 1.0 - rf[:-1]
    outweighs = 0.5 / np.sqrt(x) / (10.0 * np.exp(-100.0 * x))
    assert abs(rf[outweighs.argmin()] - 0.995) < 1e-4
    close(outweighs.min(), np.sqrt(np.e / 2.0))


def settle(surface, V, H, moment):
    """kappa by halving its bracket on kappa - target."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle < target_factor(surface, V, H, moment(middle)):
            low = middle
        else:
            high = middle
    return low


@pytest.mark.parametrize(("attracted", "on_surface"), [(0.9, False), (1.2, False), (3.0, True)])
def test_a_bracket_finds_the_secant_factor_where_insertion_does_not(attracted, on_surface):
    V, H = 8e7, 5e6
    limit = moment_limit(SURFACE, V, H)

    def moment(kappa):  # of a leg whose own rotational flexibility is 20 times the soil's
        return attracted * limit * kappa / (kappa + 0.05)

    kappa = settle(SURFACE, V, H, moment)
    if on_surface:
        assert abs(SURFACE.value(V, H, moment(kappa))) < 1e-12
        close(kappa, 0.025)
    else:
        close(kappa, target_factor(SURFACE, V, H, moment(kappa)))
        assert SURFACE.value(V, H, moment(kappa)) < 0.0
    inserted = 1.0
    for _ in range(100):
        inserted = target_factor(SURFACE, V, H, moment(inserted))
    assert (abs(inserted - kappa) < 1e-9) == (attracted == 0.9)


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("call", "field"),
    [
        (lambda: YieldSurface(0.0, 1.0, 1.0), "V_PRELOAD"),
        (lambda: YieldSurface(np.nan, 1.0, 1.0), "V_PRELOAD"),
        (lambda: YieldSurface(1.0, 0.0, 1.0), "QH"),
        (lambda: YieldSurface(1.0, 1.0, -1.0), "QM"),
        (lambda: YieldSurface(1.0, 1.0, 1.0, 1.1), "EMBED"),
        (lambda: YieldSurface(1.0, 1.0, 1.0, np.nan), "EMBED"),
        (lambda: YieldSurface.for_clay(2e8, 14.0, 0.0, 0.0, 30.0, 5.0), "QH"),
        (lambda: YieldSurface.for_clay(2e8, 0.0, 1e4, 1e4, 30.0, 5.0), "B"),
        (lambda: spudcan.elastic_stiffness(1e7, 0.51, 7.0), "NU"),
        (lambda: spudcan.elastic_stiffness(1e7, np.array([0.2, np.nan]), 7.0), "NU"),
        (lambda: spudcan.elastic_stiffness(1e7, 0.3, np.array([7.0, 0.0])), "B"),
        (lambda: spudcan.arya_factors(0.3, 0.0, 1.0), "B"),
        (lambda: spudcan.clay_shear_modulus(1e4, 0.0), "OCR"),
        (lambda: clay(diameter=0.0), "B"),
        (lambda: sand(diameter=-1.0), "B"),
        (
            lambda: spudcan_bearing.sand_over_clay_bearing_capacity(
                0.6, 1e4, 9.0, 1.0, 0.0, 1e4, 3.0
            ),
            "GAMMA",
        ),
    ],
)
def test_refusals_name_the_column(call, field):
    with pytest.raises(InvalidData) as refused:
        call()
    assert refused.value.field == field
    assert refused.value.remedy
