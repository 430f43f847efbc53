"""The embedded length that axial loads require."""

from math import pi

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from piles import clay, direct, pile, profile, sand, uniform
from podeep.errors import InvalidData
from podeep.soil.axial_capacity import axial_capacity
from podeep.soil.required_length import required_length

F = 40e3
TUBE = pile((1.0, 0.03, 10.0))
WALL, INSIDE = 0.25 * pi * (1.0 - 0.94**2), 0.25 * pi * 0.94**2
GROSS = WALL + INSIDE
#: strong over weak over strong: end bearing of 4, 0.2 and 4 MPa, and friction F throughout
STRONG, WEAK = direct(1, F, 4e6), direct(2, F, 0.2e6)
SANDWICH = profile((20.0, STRONG, STRONG), (30.0, WEAK, WEAK), (60.0, STRONG, STRONG))
PLUGGED = {"plug": "PLUGGED", "weigh_pile": False}


@pytest.mark.parametrize("load", ["compression", "tension"])
@pytest.mark.parametrize("safety", [1.5, 2.0])
def test_of_friction_alone(load, safety):
    """L = FS P / (pi f D)."""
    options = {load: 2e6, f"{load}_safety": safety, "water_density": 7850.0}
    r = required_length(uniform(direct(1, F)), TUBE, 60.0, plug="PLUGGED", **options)
    np.testing.assert_allclose(r.length, safety * 2e6 / (pi * F), rtol=1e-9)
    assert (r.governing, r.failing_again, r.scanned) == (load, (), (0.0, 60.0))
    assert r.capacity.depth.tolist() == [r.length]


def test_where_a_weaker_layer_begins():
    r = required_length(SANDWICH, TUBE, 60.0, compression=2.5e6, **PLUGGED)
    strong, weak = ((5e6 - q * GROSS) / (pi * F) for q in (4e6, 0.2e6))
    assert strong < 20.0 < 30.0 < weak
    np.testing.assert_allclose(r.length, strong, rtol=1e-9)
    # it holds again as soon as the tip meets the third layer, before friction alone would do
    np.testing.assert_allclose(r.failing_again, [(20.0, 30.0)], rtol=1e-12)
    assert r.failing_again[0][1] == np.nextafter(30.0, 31.0)


def test_where_friction_makes_up_for_it():
    r = required_length(SANDWICH, TUBE, 60.0, compression=1.8e6, **PLUGGED)
    weak = (3.6e6 - 0.2e6 * GROSS) / (pi * F)
    np.testing.assert_allclose(r.failing_again, [(20.0, weak)], rtol=1e-9)
    cut = required_length(SANDWICH, TUBE, 25.0, compression=1.8e6, **PLUGGED)
    assert cut.failing_again == ((20.0, 25.0),)
    later = required_length(SANDWICH, TUBE, 60.0, compression=1.8e6, shortest=22.0, **PLUGGED)
    np.testing.assert_allclose(later.length, weak, rtol=1e-9)
    assert later.failing_again == ()


def test_at_once():
    """A load that the shortest pile bears."""
    r = required_length(SANDWICH, TUBE, 60.0, compression=1.7e6, shortest=19.0, **PLUGGED)
    assert r.length == 19.0
    assert len(r.failing_again) == 1
    assert required_length(SANDWICH, TUBE, 60.0).length == 0.0


def test_where_a_stronger_layer_begins():
    r = required_length(SANDWICH, TUBE, 60.0, compression=3.2e6, **PLUGGED)
    assert r.length == np.nextafter(30.0, 31.0)
    assert r.failing_again == ()


def test_beyond_the_range():
    r = required_length(SANDWICH, TUBE, 25.0, tension=6e6, compression=1e6, plug="PLUGGED")
    assert (r.length, r.failing_again, r.governing) == (None, (), "tension")
    end = axial_capacity(SANDWICH, TUBE, 25.0, plug="PLUGGED")
    np.testing.assert_allclose(r.capacity.tension, end.tension, rtol=1e-12)
    assert r.capacity.depth.tolist() == [25.0]


def test_a_change_of_tube_is_seen_from_both_sides():
    sections = pile((1.0, 0.03, 15.05), (0.6, 0.03, 10.0))
    r = required_length(uniform(STRONG), sections, 45.0, compression=2.4e6, **PLUGGED)
    again = 15.05 + (4.8e6 - 4e6 * 0.09 * pi - pi * F * 15.05) / (0.6 * pi * F)
    np.testing.assert_allclose(r.failing_again, [(15.05, again)], rtol=1e-9)


def test_a_short_narrow_tube_is_not_overlooked():
    sections = pile((1.0, 0.03, 15.03), (0.6, 0.03, 0.04), (1.0, 0.03, 10.0))
    r = required_length(uniform(STRONG), sections, 45.0, compression=2.4e6, **PLUGGED)
    np.testing.assert_allclose(r.failing_again, [(15.03, 15.07)], rtol=1e-12)


def test_a_bearing_that_peaks_within_a_layer():
    """q = 60 (1 - z / 40) 9e3 z has its peak of 5.4e6 at 20 m, 1e-4 more than at 20 -+ 0.2 m."""
    soil = profile((40.0, sand(1, 1e-15, 60.0, 9e3), sand(2, 1e-15, 0.0, 9e3)))
    load = 5.4e6 * (1.0 - 1e-4) * GROSS / 2.0
    r = required_length(soil, TUBE, 35.0, compression=load, **PLUGGED)
    np.testing.assert_allclose((r.length, *r.failing_again[0]), (19.8, 20.2, 35.0), rtol=1e-8)


@pytest.mark.parametrize("plug", ["PLUGGED", "UNPLUGGED"])
def test_own_weight_is_a_load_in_compression(plug):
    """L = P / (pi f D / FS - w), w the weight in water per metre, with the plug's if plugged."""
    soil = uniform(direct(1, F, effective_unit_weight=8e3))
    r = required_length(soil, TUBE, 90.0, compression=1e6, plug=plug)
    steel, inside = (7850.0 - 1025.0) * 9.80665 * WALL, 8e3 * INSIDE
    rate = pi * F / 2.0 - steel - inside if plug == "PLUGGED" else 0.97 * pi * F - steel
    np.testing.assert_allclose(r.length, 1e6 / rate, rtol=1e-9)
    weightless = required_length(soil, TUBE, 90.0, compression=1e6, plug=plug, weigh_pile=False)
    rate = pi * F / 2.0 if plug == "PLUGGED" else 0.97 * pi * F
    np.testing.assert_allclose(weightless.length, 1e6 / rate, rtol=1e-9)


@settings(max_examples=8, deadline=None, derandomize=True)
@given(
    st.lists(st.floats(5e3, 1.5e5), min_size=4, max_size=4),
    st.floats(3.0, 15.0),
    st.floats(0.0, 6e6),
    st.floats(1e3, 3e6),
    st.booleans(),
)
def test_minimal(su, middle, pressed, pulled, weigh):
    """All below the length found fails, and above it what is named, nothing else."""
    soil = profile(
        (middle, clay(1, su[0], 7e3), clay(2, su[1], 7e3)),
        (middle + 3.0, sand(3, 0.37, 20.0, 9e3), sand(4, 0.46, 40.0, 9e3)),
        (50.0, clay(5, su[2], 8e3), clay(6, su[3], 8e3)),
    )
    loads = {"compression": pressed, "tension": pulled, "weigh_pile": weigh}
    r = required_length(soil, TUBE, 40.0, **loads)
    own = float(weigh)

    def margin(length):
        c = axial_capacity(soil, TUBE, length)
        coring = c.compression_unplugged / 2.0 - pressed - own * c.pile_weight
        plugged = c.compression_plugged / 2.0 - pressed - own * (c.pile_weight + c.plug_weight)
        return np.minimum.reduce([coring, plugged, c.tension / 2.0 - pulled])

    assume(r.length != 0.0)
    end = 40.0 if r.length is None else r.length
    below = np.append(np.linspace(0.0, end * (1.0 - 1e-6), 30), middle)
    assert (margin(below[below < end]) < 0.0).all()
    if r.length is None:
        return
    assert margin(r.length)[0] > -1.0
    above = np.linspace(r.length + 1e-6, 40.0, 30)
    fails = np.zeros(30, dtype=bool)
    for first, last in r.failing_again:
        fails |= (above > first) & (above < last)
    assert ((margin(above) < 0.0) == fails).all()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"compression": -1e6}, "load of -1e"),
        ({"tension": -1e6}, "load of -1e"),
        ({"tension_safety": 0.0}, "safety factor of 0 "),
        ({"shortest": 60.0}, "no length between 60 and 60"),
        ({"shortest": -1.0}, "no length between -1 and 60"),
    ],
)
def test_impossible(options, words):
    with pytest.raises(InvalidData, match=words):
        required_length(SANDWICH, TUBE, 60.0, **options)


def test_own_weight_alone_asks_for_no_length():
    """A solid bar in clay that could not bear its weight twice, pulled: the pull decides."""
    bar = pile((2.0, 1.0, 10.0))
    r = required_length(uniform(clay(1, 500.0, 9e3)), bar, 45.0, tension=1e5)
    assert r.governing == "tension"
    assert r.length is not None
    found = axial_capacity(uniform(clay(1, 500.0, 9e3)), bar, np.array([r.length]))
    np.testing.assert_allclose(found.tension, 2e5, rtol=1e-8)
