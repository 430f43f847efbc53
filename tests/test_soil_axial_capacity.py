"""Axial capacity of piles against table 16, a plain integration and closed forms."""

from dataclasses import replace
from itertools import pairwise
from math import pi
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from piles import STEEL, WATER, G, clay, direct, pile, profile, sand, uniform
from podeep.errors import InvalidData, UserError
from podeep.scene import Curve, Section
from podeep.soil import axial_capacity as module
from podeep.soil.axial_capacity import axial_capacity
from podeep.soil.profile import Profile
from test_soil_tables import CLASSES, KILO, close, table


def from_table(layers, limits):
    """The profile that a row of table 16 describes."""
    found = []
    for i, text in enumerate(layers.split("|")):
        span, soil, *numbers, weight = text.split(":")
        bottom, weight = float(span.split("-")[1]), float(weight) * KILO
        if soil == "CLAY":
            strengths = [float(n) * KILO for n in numbers]
            ends = [clay(2 * i + 1 + k, su, weight) for k, su in enumerate(strengths)]
        else:
            beta, f, factor, q = CLASSES["Sand", numbers[0]]
            bound = {"friction_limit": f * KILO, "end_bearing_limit": q * KILO} if limits else {}
            ends = [sand(2 * i + 1, beta, factor, weight, **bound)] * 2
        found.append((bottom, *ends))
    return profile(*found)


WEIGHTS = {"pile_weight": "W", "plug_weight": "Wplug"}
COLUMNS = {
    "Qo": "outer_friction",
    "Qi": "inner_friction",
    "qb": "unit_bearing",
    "Qw": "wall_bearing",
    "Qp": "plug_bearing",
    "plugged": "compression_plugged",
    "unplugged": "compression_unplugged",
    "comp": "compression",
    "tens_plugged": "tension_plugged",
    "tens_unplugged": "tension_unplugged",
    "tens": "tension",
}


@pytest.mark.parametrize("row", [0, 1])
def test_table(row):
    t = {name: values[row] for name, values in table("16").items()}
    tube = pile((t["D"], t["t"], t["L"]))
    c = axial_capacity(from_table(t["layers"], limits=True), tube, t["L"])
    # the table gives weights that are not those of its tube and soil
    c = replace(c, **{ours: np.array([t[name] * KILO]) for ours, name in WEIGHTS.items()})
    for name, ours in COLUMNS.items():
        close(getattr(c, ours), t[name] * KILO)
    free = axial_capacity(from_table(t["layers"], limits=False), tube, t["L"])
    for name in ("plugged", "unplugged", "comp"):
        close(getattr(free, COLUMNS[name]), t[f"{name}_nolim"] * KILO)


#: clay through psi = 1, sand up to its limit, clay; two walls and a shoe
LIMIT = {"friction_limit": 45e3}
LAYERED = profile(
    (12.3, clay(1, 5e3, 6e3), clay(2, 40e3, 6e3)),
    (25.1, sand(3, 0.46, 40.0, 9e3, **LIMIT), sand(4, 0.3, 12.0, 9e3, **LIMIT)),
    (40.0, clay(5, 30e3, 7e3), clay(6, 60e3, 7e3)),
)
STEPPED = pile((1.5, 0.05, 8.0), (1.5, 0.03, 19.3), (1.6, 0.07, 2.0))


def midpoint_friction(soil, diameter, top, bottom, count=400_000):
    """int f dz by a plain rule, with panels that grow from the mudline as z^4."""
    edges = np.linspace(top**0.25, bottom**0.25, count + 1) ** 4
    z = 0.5 * (edges[1:] + edges[:-1])
    width = np.full(count, diameter)
    return float(soil.shaft(z, width).capacity @ np.diff(edges)) / (pi * diameter)


class TestIntegral:
    def test_against_a_plain_rule(self):
        """Cut by hand where soil or tube change."""
        cuts, found = (0.0, 8.0, 12.3, 25.1, 27.3, 33.0), np.zeros(2)
        tubes = ((1.5, 1.4), (1.5, 1.44), (1.5, 1.44), (1.5, 1.44), (1.6, 1.46))
        for (D, Di), span in zip(tubes, pairwise(cuts), strict=True):
            found += np.array([pi * D, pi * Di]) * midpoint_friction(LAYERED, D, *span)
        c = axial_capacity(LAYERED, STEPPED, 33.0)
        np.testing.assert_allclose((c.outer_friction[0], c.inner_friction[0]), found, rtol=1e-8)

    def test_converged(self):
        depth = np.linspace(0.0, 35.0, 15)
        coarse = axial_capacity(LAYERED, STEPPED, depth)
        with patch.multiple(module, _PANEL=0.05, _EXACT=1e-15):
            fine = axial_capacity(LAYERED, STEPPED, depth)
        for name in ("outer_friction", "inner_friction"):
            np.testing.assert_allclose(getattr(coarse, name), getattr(fine, name), rtol=1e-10)

    def test_few_calls(self):
        """The cost of a whole pile is a handful of vectorised calls for the shaft."""
        with patch.object(Profile, "shaft", autospec=True, side_effect=Profile.shaft) as shaft:
            axial_capacity(LAYERED, STEPPED, np.linspace(0.0, 35.0, 200))
        assert shaft.call_count <= 10
        assert sum(len(call.args[1]) for call in shaft.call_args_list) < 6000


def test_uniform_friction():
    depth = np.array([17.3, 0.0, 40.0, 0.01])
    c = axial_capacity(uniform(direct(1, 25e3, 1e6)), pile((2.0, 0.05, 20.0)), depth)
    for ours, perimeter in ((c.outer_friction, 2.0 * pi), (c.inner_friction, 1.9 * pi)):
        np.testing.assert_allclose(ours, 25e3 * perimeter * depth, rtol=1e-12)
    np.testing.assert_allclose(c.wall_bearing + c.plug_bearing, np.full(4, pi * 1e6), rtol=1e-12)
    assert c.plugged_in_compression.tolist() == [False, False, True, False]


def test_rows_of_the_user():
    curve = Curve(1, "user", {}, {}, ((9e3, 0.01, 1e5, 0.1), (6e3, 0.1, 2e5, 0.3)))
    c = axial_capacity(uniform(curve), pile((1.0, 0.5, 20.0)), 20.0)
    np.testing.assert_allclose(c.compression, pi * 20.0 * 9e3 + 0.25 * pi * 2e5, rtol=1e-12)


class TestWeights:
    def test_tube_and_plug(self):
        c = axial_capacity(LAYERED, STEPPED, 20.0)
        steel = pi * (1.45 * 0.05 * 8.0 + 1.47 * 0.03 * 12.0)
        np.testing.assert_allclose(c.pile_weight, (STEEL - WATER) * G * steel, rtol=1e-12)
        soil = 0.25 * pi * (1.4**2 * 8.0 * 6e3 + 1.44**2 * (4.3 * 6e3 + 7.7 * 9e3))
        np.testing.assert_allclose(c.plug_weight, soil, rtol=1e-12)
        np.testing.assert_allclose(c.wall_area, pi * 1.47 * 0.03, rtol=1e-12)
        assert c.notes == ()

    def test_of_a_pile_that_floats(self):
        (tube,) = pile((1.0, 0.1, 9.0))
        light = replace(tube, mass_override=100.0)
        c = axial_capacity(LAYERED, (light,), 9.0)
        expected = (100.0 - WATER * tube.area) * G * 9.0
        assert expected < 0.0
        np.testing.assert_allclose(c.pile_weight, expected, rtol=1e-12)

    def test_of_a_plug_in_soil_of_unknown_weight(self):
        unknown = uniform(direct(1, 25e3))
        c = axial_capacity(unknown, STEPPED, [5.0, 9.0])
        assert c.plug_weight.tolist() == [0.0, 0.0]
        assert "weightless" in c.notes[0]
        assert "GAMMA" in c.notes[0]
        assert axial_capacity(unknown, pile((1.0, 0.5, 9.0)), 9.0).notes == ()


class TestClosedEnd:
    def test_bar(self):
        c = axial_capacity(LAYERED, pile((1.0, 0.5, 20.0)), [0.0, 7.0, 20.0])
        for nothing in (c.inner_friction, c.plug_weight, c.plug_area):
            assert not nothing.any()
        assert (c.compression_plugged == c.compression_unplugged).all()
        assert (c.tension_plugged == c.tension_unplugged).all()
        assert c.plugged_in_compression.all()
        np.testing.assert_allclose(c.wall_bearing, 0.25 * pi * c.unit_bearing)

    def test_below_a_tube(self):
        """No soil stands above a solid section, wherever it is."""
        sections = pile((1.0, 0.04, 10.0), (1.0, 0.5, 0.5), (1.0, 0.04, 4.5))
        soil = uniform(direct(1, 25e3, effective_unit_weight=8e3))
        c = axial_capacity(soil, sections, [10.0, 10.2, 12.5])
        inside = np.array([10.0, 0.0, 2.0])
        np.testing.assert_allclose(c.inner_friction, pi * 0.92 * 25e3 * inside, rtol=1e-12)
        np.testing.assert_allclose(c.plug_weight, 0.25 * pi * 0.92**2 * 8e3 * inside, rtol=1e-12)


class TestOptions:
    depth = np.linspace(0.0, 35.0, 8)

    def test_plug(self):
        plugged = axial_capacity(LAYERED, STEPPED, self.depth, plug="PLUGGED")
        coring = axial_capacity(LAYERED, STEPPED, self.depth, plug="UNPLUGGED")
        auto = axial_capacity(LAYERED, STEPPED, self.depth)
        assert plugged.compression.tolist() == auto.compression_plugged.tolist()
        assert coring.tension.tolist() == auto.tension_unplugged.tolist()
        assert set(auto.plugged_in_compression.tolist()) == {True, False}

    def test_tension_factor(self):
        full, part = (
            axial_capacity(LAYERED, STEPPED, self.depth, tension_factor=r) for r in (1.0, 0.75)
        )
        for name in ("tension_plugged", "tension_unplugged"):
            given = getattr(full, name)
            friction = full.outer_friction + full.inner_friction * (name == "tension_unplugged")
            np.testing.assert_allclose(getattr(part, name), given - 0.25 * friction, rtol=1e-12)
        assert part.compression.tolist() == full.compression.tolist()

    def test_mudline(self):
        """Elevations shift, capacity does not; what stands above the mudline has no part in it."""
        moved = tuple(replace(s, top=s.top - 80.0, bottom=s.bottom - 80.0) for s in STEPPED)
        free = Section(-60.0, -80.0, 3.0, 0.1, 210e9, STEEL)
        there = axial_capacity(LAYERED, (free, *moved), self.depth, mudline=-80.0)
        here = axial_capacity(LAYERED, STEPPED, self.depth)
        for name in ("compression", "tension", "pile_weight", "wall_area"):
            np.testing.assert_allclose(getattr(there, name), getattr(here, name), rtol=1e-9)

    def test_impossible(self):
        with pytest.raises(InvalidData, match="no plug option HALF"):
            axial_capacity(LAYERED, STEPPED, 9.0, plug="HALF")
        with pytest.raises(InvalidData, match="negative"):
            axial_capacity(LAYERED, STEPPED, 9.0, tension_factor=-1.0)
        with pytest.raises(InvalidData, match="no section"):
            axial_capacity(LAYERED, (), 9.0)
        with pytest.raises(UserError, match="no limit"):
            axial_capacity(uniform(direct(1, np.inf)), STEPPED, 9.0)
        with pytest.raises(ValueError, match="above the mudline"):
            axial_capacity(LAYERED, STEPPED, -1.0)


strengths = st.floats(0.0, 2e5)
layers = st.lists(
    st.tuples(st.floats(0.2, 15.0), st.booleans(), strengths, strengths, st.floats(1e3, 11e3)),
    min_size=1,
    max_size=3,
)


def drawn(stack):
    found, bottom = [], 0.0
    for i, (thickness, is_clay, a, b, weight) in enumerate(stack):
        bottom += thickness
        make = [clay(2 * i + 1, a, weight), clay(2 * i + 2, b, weight)]
        if not is_clay:
            limits = {"friction_limit": 1.0 + a, "end_bearing_limit": 1.0 + 50.0 * b}
            make = [sand(2 * i + 1, 0.37, 20.0, weight, **limits)] * 2
        found.append((bottom, *make))
    return profile(*found)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(layers, st.floats(0.2, 4.0), st.floats(0.01, 0.5))
def test_properties(stack, diameter, wall):
    depth = np.linspace(0.0, 40.0, 9)
    c = axial_capacity(drawn(stack), pile((diameter, wall * diameter, 20.0)), depth)
    for friction in (c.outer_friction, c.inner_friction):
        assert (np.diff(friction) >= 0.0).all()
    assert (np.diff(c.plug_weight) >= 0.0).all()
    assert (np.minimum(c.compression, c.tension) >= 0.0).all()
    coring = c.inner_friction < c.plug_bearing
    expected = np.where(coring, c.compression_unplugged, c.compression_plugged)
    np.testing.assert_allclose(c.compression, expected, rtol=1e-12)
    assert (c.tension == np.minimum(c.tension_plugged, c.tension_unplugged)).all()
