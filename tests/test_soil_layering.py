"""Equivalent depths of layered ground against table 09, closed forms and a recursion by hand."""

from itertools import pairwise
from math import inf, radians, sqrt

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.soil.layering import Layer, depth_shifts, equivalent_depth, integral
from podeep.soil.sand import Sand, sand_coefficients
from podeep.soil.soft_clay import SoftClay
from test_soil_tables import KILO, close, table


class Clay:
    """Uniform soft clay from the mudline: pu by depth, and its integral in closed form."""

    def __init__(self, su=18e3, weight=8e3, j=0.5, diameter=1.0):
        self.su, self.weight, self.j, self.D = su, weight, j, diameter

    def __call__(self, h, su=None, overburden=None):
        return SoftClay(
            depth=h,
            diameter=self.D,
            effective_overburden=self.weight * h if overburden is None else overburden,
            undrained_shear_strength=self.su if su is None else su,
            effective_unit_weight=self.weight,
            j=self.j,
            strain_50=0.01,
        ).ultimate_resistance

    @property
    def kink(self):
        """Natural transition depth: without the floor of 2.5 D that XR has."""
        return 6.0 * self.su * self.D / (self.weight * self.D + self.j * self.su)

    def closed(self, h):
        wedge, deep = min(h, self.kink), max(h - self.kink, 0.0)
        slope = self.weight * self.D + self.j * self.su
        return 3 * self.su * self.D * wedge + slope * wedge**2 / 2 + 9 * self.su * self.D * deep


class ApiSand:
    """Uniform sand of API from the mudline: pu by depth, and its integral in closed form."""

    def __init__(self, phi=33.0, weight=9.5e3, diameter=1.0):
        self.phi, self.weight, self.D = radians(phi), weight, diameter

    def __call__(self, h, overburden=None):
        own = self.weight * h if overburden is None else overburden
        return Sand(h, self.D, own, self.phi).ultimate_resistance

    @property
    def kink(self):
        C1, C2, C3 = sand_coefficients(self.phi)
        return (C3 - C2) * self.D / C1

    def closed(self, h):
        C1, C2, C3 = sand_coefficients(self.phi)
        wedge, deep = min(h, self.kink), max(h, self.kink)
        below = C3 * self.D * (deep**2 - self.kink**2) / 2
        return self.weight * (C1 * wedge**3 / 3 + C2 * self.D * wedge**2 / 2 + below)


def stack(*parts):
    """Layers from pairs (thickness, pu)."""
    tops = np.cumsum([0.0, *(thickness for thickness, _ in parts)]).tolist()
    return [
        Layer(top=top, bottom=bottom, ultimate=pu)
        for (top, bottom), (_, pu) in zip(pairwise(tops), parts, strict=True)
    ]


SOILS = [
    *(Clay(su, w, j, D) for su, w, j, D in ((4e3, 5e3, 0.25, 2.1), (60e3, 9e3, 0.5, 0.6))),
    Clay(5e3, 11e3, 0.25, 3.0),  # kink at 2.6 m: above the floor of 2.5 D
    *(ApiSand(phi, w, D) for phi, w, D in ((33.0, 9.5e3, 1.0), (25.0, 8e3, 2.0), (40.0, 1e4, 0.3))),
]
every_soil = pytest.mark.parametrize("soil", SOILS, ids=lambda s: f"{type(s).__name__}-{s.D}")


class TestTable:
    t = table("09")
    clay, sand = Clay(), ApiSand()

    @pytest.fixture
    def shift(self):
        first, second = depth_shifts(stack((4.0, self.clay), (inf, self.sand)))
        assert first == 0.0
        return second

    def test_force_of_the_first_layer(self):
        force = integral(self.clay, 0.0, 4.0)
        close(force, self.t["F1"] * KILO)
        assert force == pytest.approx(self.clay.closed(4.0), rel=1e-14)

    def test_equivalent_depths(self, shift):
        close(4.0 + shift, self.t["h2"])
        close(self.t["z"] + shift, self.t["z_eq"])

    def test_resistance_at_the_equivalent_depth(self, shift):
        h, actual = self.t["z"] + shift, 4.0 * 8e3 + (self.t["z"] - 4.0) * 9.5e3
        close(self.sand(h), self.t["pu_eq"] * KILO)
        close(self.sand(h, actual), self.t["pu_eq_sig"] * KILO)
        close(self.sand(self.t["z"], actual), self.t["pu_naive"] * KILO)


class TestIntegral:
    @every_soil
    def test_closed_forms(self, soil):
        """To 1e-12, also where the kink lies within the range or very near its end."""
        kink = float(soil.kink)
        for h in (1e-6, 0.3, 0.99 * kink, kink, (1 + 1e-9) * kink, 1.7 * kink, 30.0, 900.0):
            assert integral(soil, 0.0, h) == pytest.approx(float(soil.closed(h)), rel=1e-12)

    def test_the_kink_of_clay_has_no_floor(self):
        """The pu that is integrated turns where its branches cross, not at XR >= 2.5 D."""
        soil = Clay(5e3, 11e3, 0.25, 3.0)
        assert soil.kink < 2.5 * soil.D
        h = soil.kink * np.array([0.999, 1.0, 1.5])
        assert soil(h)[0] < 9 * soil.su * soil.D
        np.testing.assert_allclose(soil(h)[1:], 9 * soil.su * soil.D, rtol=1e-15)

    def test_polynomials_take_two_calls(self):
        calls = []

        def cubic(h):
            calls.append(h.size)
            return h**3

        assert integral(cubic, 1.0, 3.0) == pytest.approx(20.0, rel=1e-15)
        assert len(calls) == 2

    def test_a_kink_or_a_jump_stands_nowhere_unseen(self):
        """Also just inside the ends of panels, where Gauss's rule misses it by 1e-9.

        And where a panel's sum and that of its halves agree on a wrong value, by 7e-5.
        """
        near = np.logspace(-13, -1, 25)
        anywhere = np.random.default_rng(1).random(50)
        for at in (
            0.4131526204628905,
            *anywhere,
            *(1.0 - near),
            *(0.5 - near / 2),
            *(0.5 + near / 2),
        ):
            bent = integral(lambda h, at=at: np.minimum(h, at), 0.0, 1.0)
            assert bent == pytest.approx(at - at**2 / 2, rel=1e-12)
            stepped = integral(lambda h, at=at: 1.0 + (h > at), 0.0, 1.0)
            assert stepped == pytest.approx(2.0 - at, rel=1e-12)

    def test_nothing(self):
        assert integral(np.zeros_like, 0.0, 9.0) == 0.0
        assert integral(np.ones_like, 2.0, 2.0) == 0.0


class TestEquivalentDepth:
    @every_soil
    def test_it_inverts_the_closed_form(self, soil):
        """To 1e-10, from a micrometre to a kilometre, on both sides of the kink and on it."""
        kink = float(soil.kink)
        for h in (1e-6, 1e-3, 0.4, 1.0, 0.9 * kink, kink, 1.1 * kink, 25.0, 1000.0):
            ours = equivalent_depth(soil, float(soil.closed(h)))
            assert ours == pytest.approx(h, rel=1e-10, abs=1e-14)

    def test_no_force_is_the_mudline(self):
        assert equivalent_depth(Clay(), 0.0) == 0.0
        assert equivalent_depth(np.zeros_like, 0.0) == 0.0

    def test_soil_that_resists_from_a_depth_on(self):
        assert equivalent_depth(lambda h: 1e3 * (h > 7.3), 2e3) == pytest.approx(9.3, rel=1e-10)

    def test_never(self):
        """exp(-h) gathers 1 in all."""
        assert equivalent_depth(lambda h: np.exp(-h), 0.999) == pytest.approx(
            -np.log(0.001), rel=1e-10
        )
        assert equivalent_depth(lambda h: np.exp(-h), 1.001) == inf
        assert equivalent_depth(np.zeros_like, 1.0) == inf
        assert equivalent_depth(lambda h: np.full_like(h, np.nan), 1.0) == inf


class TestLayers:
    @every_soil
    def test_identical_layers_are_one(self, soil):
        shifts = depth_shifts(stack(*((t, soil) for t in (0.7, 3.0, 0.01, 5.0, 40.0, 9.0))))
        np.testing.assert_allclose(shifts, 0.0, atol=1e-9)

    def test_three_layers_by_hand(self):
        """Clay of 18 kPa to 4 m, of 30 kPa to 8 m, of 10 kPa below (J 0.5, g' 8 kN/m3, D 1 m).

        F = 352 kN (table 09). The second has 90 h + 11.5 h^2 to 180/23 = 7.8 m, so h2 = 2.9 m, and
        adds as much from there to h2 + 4. The third has 30 h + 6.5 h^2 to 60/13 m and then 90 a
        metre.
        """
        h2 = (sqrt(8100 + 46 * 352) - 90) / 23
        force = 352 + 360 + 11.5 * ((h2 + 4) ** 2 - h2**2)
        kink = 60 / 13
        h3 = kink + (force - 30 * kink - 6.5 * kink**2) / 90
        shifts = depth_shifts(stack((4.0, Clay()), (4.0, Clay(30e3)), (inf, Clay(10e3))))
        np.testing.assert_allclose(shifts, (0.0, h2 - 4.0, h3 - 8.0), rtol=1e-10)
        assert h2 + 4 < 180 / 23
        assert h3 > kink

    @pytest.mark.parametrize("order", [(3, 0, 4, 1), (1, 4, 0, 5), (5, 3, 2, 4)])
    def test_any_order_of_soils_against_the_closed_forms(self, order):
        """Each layer's closed form, at its top's equivalent depth, is what those above gather."""
        soils, thickness = [SOILS[i] for i in order], 3.7
        shifts = depth_shifts(stack(*((thickness, soil) for soil in soils)))
        force = 0.0
        for i, (soil, shift) in enumerate(zip(soils, shifts, strict=True)):
            h = i * thickness + shift
            assert float(soil.closed(h)) == pytest.approx(force, rel=1e-10)
            force += float(soil.closed(h + thickness) - soil.closed(h))

    def test_a_weaker_layer_above_makes_it_shallower_and_a_stronger_one_deeper(self):
        stronger, same, weaker = (
            depth_shifts(stack((4.0, Clay(su)), (9.0, Clay(18e3))))[1] for su in (40e3, 18e3, 5e3)
        )
        assert weaker < -1e-3
        assert same == pytest.approx(0.0, abs=1e-12)
        assert stronger > 1e-3

    def test_splitting_a_layer_changes_nothing(self):
        whole = depth_shifts(stack((4.0, Clay()), (6.0, ApiSand()), (9.0, Clay(40e3))))
        split = depth_shifts(
            stack((4.0, Clay()), (2.5, ApiSand()), (3.5, ApiSand()), (9.0, Clay(40e3)))
        )
        np.testing.assert_allclose(split, whole[[0, 1, 1, 2]], rtol=1e-10)

    def test_thin_layers_of_rising_strength_converge_with_the_second_order(self):
        """A soil cut into uniform layers of its mid-depth strength, seen from the layer below."""

        def below(count):
            size = 6.0 / count
            cut = ((size, Clay(8e3 + 4e3 * (i + 0.5) * size)) for i in range(count))
            return depth_shifts(stack(*cut, (9.0, Clay(30e3))))[-1]

        shifts = np.array([below(count) for count in (3, 6, 12, 24, 48)])
        ratios = np.diff(shifts)[:-1] / np.diff(shifts)[1:]
        np.testing.assert_allclose(ratios[-2:], 4.0, rtol=0.05)

    def test_soil_that_varies_within_its_layer(self):
        """su from 20 kPa at 4 m by 2 kPa/m: the top's soil sets h, the actual one gathers.

        Above its kink pu = (3 su + g' h) D + J su h; with d = z - 4 and h = h2 + d
        int from 0 to d of it = 3 (su0 d + c d^2/2) + g' (h2 d + d^2/2)
        + J (su0 h2 d + (su0 + c h2) d^2/2 + c d^3/3), D = 1 m.
        """
        top, below = Clay(20e3), Clay(200e3)
        layers = [
            Layer(top=0.0, bottom=4.0, ultimate=Clay(5e3)),
            Layer(
                top=4.0,
                bottom=8.0,
                ultimate=top,
                inside=lambda h, z: top(h, su=20e3 + 2e3 * (z - 4.0)),
            ),
            Layer(top=8.0, bottom=inf, ultimate=below),
        ]
        _, second, third = depth_shifts(layers)
        h2, c, d, su = 4.0 + second, 2.0, 4.0, 20.0
        first = Clay(5e3).closed(4.0)
        assert top.closed(h2) == pytest.approx(first, rel=1e-10)
        assert h2 + d < Clay(20e3).kink
        gathered = 3 * (su * d + c * d**2 / 2) + 8 * (h2 * d + d**2 / 2)
        gathered += 0.5 * (su * h2 * d + (su + c * h2) * d**2 / 2 + c * d**3 / 3)
        assert below.closed(8.0 + third) == pytest.approx(first + KILO * gathered, rel=1e-10)

    def test_layers_without_strength_on_top_are_as_if_they_were_not(self):
        weak = depth_shifts(stack((2.0, Clay(0.0, 0.0)), (3.0, Clay()), (9.0, ApiSand())))
        none = depth_shifts(stack((2.0, None), (3.0, Clay()), (9.0, ApiSand())))
        alone = depth_shifts(stack((3.0, Clay()), (9.0, ApiSand())))
        np.testing.assert_allclose(weak[1:], alone - 2.0, rtol=1e-12)
        np.testing.assert_allclose(none[1:], alone - 2.0, rtol=1e-12)
        assert weak[0] == none[0] == 0.0

    def test_a_layer_without_reaction_hands_the_force_on(self):
        shifts = depth_shifts(stack((4.0, Clay()), (3.0, None), (9.0, ApiSand())))
        assert shifts[1] == 0.0
        close(7.0 + shifts[2], 3.0217099)

    def test_a_layer_that_has_no_equivalent_depth_resists_at_its_actual_one(self):
        """100 kN/m by metre of depth from 2 to 5 m gather 1050 kN."""
        rows = Layer(top=2.0, bottom=5.0, ultimate=None, inside=lambda h, z: 5e4 * (h + z))
        first, below = stack((2.0, Clay()), (3.0, None), (inf, ApiSand()))[::2]
        shifts = depth_shifts([first, rows, below])
        assert shifts[1] == 0.0
        force = Clay().closed(2.0) + 1050e3
        assert ApiSand().closed(5.0 + shifts[2]) == pytest.approx(force, rel=1e-10)

    @pytest.mark.parametrize("pu", [np.zeros_like, lambda h: np.exp(-h), Clay(0.0)])
    def test_a_layer_that_never_gathers_the_force_is_told_with_numbers(self, pu):
        with pytest.raises(InvalidData, match=r"4 m below .* with 352000 N, .* 131072 m") as fault:
            depth_shifts(stack((4.0, Clay()), (9.0, pu)))
        assert f"own soil with {integral(pu, 0.0, 2.0**17):g} N" in fault.value.message
        assert "no p-y curve" in fault.value.remedy
        assert fault.value.field == "LAYERING"

    @pytest.mark.parametrize(
        "edges", [((0, 4), (5, 9)), ((0, 4), (3, 9)), ((0, inf), (inf, inf)), ((4, 0),), ((-1, 2),)]
    )
    def test_layers_out_of_order_are_refused(self, edges):
        with pytest.raises(ValueError, match="without gap or overlap"):
            depth_shifts([Layer(top=a, bottom=b, ultimate=Clay()) for a, b in edges])

    def test_no_layers_and_repeated_calls(self):
        assert depth_shifts([]).shape == (0,)
        layers = stack((4.0, Clay()), (5.0, ApiSand()), (inf, Clay(10e3)))
        assert depth_shifts(layers).tobytes() == depth_shifts(layers).tobytes()
