"""Piles and the ground they meet: a warning just outside each bound, silence just inside."""

import re
from dataclasses import replace

import numpy as np
import pytest

from podeep.checks import warnings
from podeep.scene import Load, Spudcan
from risky import CLAY, LINE, OFF, SAND, SAND_SHAFT, SHAFT, TIP, curve, scene


def test_a_sound_pile_is_quiet():
    assert warnings(scene(CLAY, SHAFT)) == []
    assert warnings(scene(SAND, SAND_SHAFT)) == []


@pytest.mark.parametrize(
    ("lateral", "quiet", "loud", "words"),
    [
        (CLAY, (2.5, 30.0), (2.5001, 30.0), "D = 2.5 m: the curves of p-y 1 are for long slender"),
        (CLAY, (2.0, 20.0), (2.0, 19.99), "L/D = 9.99: the curves of p-y 1"),
        (SAND, (2.0, 20.0), (2.5, 10.0), "L/D = 4: the curves of p-y 2"),
        (SAND, (2.0, 20.0), (6.0, 24.0), "D = 6 m and L/D = 4: the curves of p-y 2"),
        (curve("p-y", "pisa_clay"), (5.0, 10.0), (4.999, 10.0), "D = 4.999 m: the curves of p-y 1"),
        (curve("p-y", "pisa_clay"), (10.0, 60.0), (10.001, 60.0), "D = 10 m"),
        (curve("p-y", "pisa_sand"), (8.0, 16.0), (8.0, 15.9), "L/D = 1.988"),
        (curve("p-y", "pisa_sand"), (8.0, 48.0), (4.0, 48.0), "D = 4 m and L/D = 12"),
    ],
)
def test_laws_are_for_piles_of_their_size(lateral, quiet, loud, words):
    for (diameter, length), expected in ((quiet, False), (loud, True)):
        pile = scene(lateral, SHAFT, diameter, length, force=(1e6, 0.0, 0.0), wall=diameter / 40)
        lines = warnings(pile)
        assert [words in line for line in lines] == [True] * expected
        assert all(LINE.fullmatch(line) for line in lines)


def test_rock_and_user_curves_are_for_any_size():
    user = curve("p-y", "user", rows=((9e3, 0.1),))
    for lateral in (user, curve("p-y", "weak_rock")):
        assert warnings(scene(lateral, SHAFT, 6.0, 24.0, wall=0.1)) == []


def test_depths_without_a_curve_are_told():
    """A last depth that starts a layer has no end that the tip could pass."""
    bare = scene((CLAY, CLAY, None, None, CLAY), SHAFT, depths=(0.0, 5.0, 5.0, 9.0, 9.0))
    (line,) = warnings(bare)
    assert line.startswith("F1: no p-y curve from 5 to 9 m below the mudline: ")
    assert warnings(replace(bare, loads=(Load("A", 1, 5.0, (0.0, 0.0, -1e6), (0.0,) * 3),))) == []
    ends = scene((None, None, CLAY, CLAY, None), SHAFT, depths=(0.0, 2.0, 2.0, 30.0, 30.0))
    assert "no p-y curve from 0 to 2 m and from 30 to 40 m below" in warnings(ends)[0]
    joined = scene((None, None, None, CLAY, CLAY), SHAFT, depths=(0.0, 2.0, 5.0, 5.0, 60.0))
    assert "no p-y curve from 0 to 5 m below" in warnings(joined)[0]
    fading = scene((CLAY, None, CLAY), SHAFT, depths=(0.0, 20.0, 40.0))
    assert warnings(fading) == []


def test_a_tip_below_the_last_soil_is_told():
    for last, loud in ((38.0, False), (37.9, True)):
        lines = warnings(scene(CLAY, SHAFT, depths=(0.0, last)))
        assert [line.startswith("F1: the tip is at 40 m, the soil") for line in lines] == [
            True
        ] * loud


def test_iso_clay_without_strength_at_the_mudline():
    top = curve("p-y", "iso_clay", 1, undrained_shear_strength=0.0)
    low = curve("p-y", "iso_clay", 2, undrained_shear_strength=60e3)
    derived = {"mudline_strength": None, "strength_gradient": None}
    own = [
        replace(c, parameters={k: v for k, v in c.parameters.items() if k not in derived})
        for c in (top, low)
    ]
    depths = (0.0, 40.0)
    (line,) = warnings(scene(tuple(own), SHAFT, depths=depths))
    assert line.startswith("F1: p-y 1, 2 with su0 = 0 and su1 = 1.5 kPa/m: ")
    assert warnings(scene((top, low), SHAFT, depths=depths)) == []  # SU0 is given
    uniform = curve("p-y", "iso_clay", mudline_strength=0.0, strength_gradient=0.0)
    assert warnings(scene(uniform, SHAFT)) == []


def test_erratic_strength_wants_layering():
    strong = curve("p-y", "soft_clay", 1, undrained_shear_strength=60e3)
    half = curve("p-y", "soft_clay", 2, undrained_shear_strength=30e3)
    weak = curve("p-y", "soft_clay", 3, undrained_shear_strength=29e3)
    depths = (0.0, 9.0, 9.0, 45.0)
    assert warnings(scene((strong, strong, half, half), SHAFT, depths=depths)) == []
    erratic = scene((strong, strong, weak, weak), SHAFT, depths=depths)
    (line,) = warnings(erratic)
    assert line.startswith("F1: CU falls from 60 kPa (p-y 1) to 29 kPa (p-y 3) at 9 m: ")
    layered = replace(erratic, ground=replace(erratic.ground, layering="GEORGIADIS"))
    assert warnings(layered) == []


def test_a_large_part_of_friction_from_above_psi_3_is_told():
    """su = 3 s'v at 5 m; with 5 of 6 m above it most of the friction is doubtful."""
    shaft = curve("t-z", "cohesive", undrained_shear_strength=120e3)
    long, short = (scene(CLAY, shaft, 0.5, length, wall=0.02) for length in (40.0, 6.0))
    assert not [w for w in warnings(long) if "su/s'v" in w]
    (line,) = [w for w in warnings(short) if "su/s'v" in w]
    share = int(re.search(r"where (\d+) %", line)[1]) / 100
    z = np.linspace(0.0, 6.0, 100001)[1:]
    sv = 8e3 * z
    friction = np.where(sv < 120e3, 0.5 * 120e3**0.75 * sv**0.25, 0.5 * np.sqrt(120e3 * sv))
    assert share == pytest.approx(friction[sv < 40e3].sum() / friction.sum(), abs=0.02)
    assert "above 3 down to 4.95 m" in line
    adhesion = replace(shaft, options={"shape": "2GEO", "method": "DIRECT"})
    assert not [w for w in warnings(scene(CLAY, adhesion, 0.5, 6.0, wall=0.02)) if "su/s'v" in w]


@pytest.mark.parametrize(
    ("slope", "words"),
    [
        (50e3 / 0.002 * 1.01, "reach 50 kPa at 1.98 mm, 0.00099 D"),
        (50e3 / 0.002 * 0.99, None),
        (50e3 / 0.1 * 1.01, None),
        (50e3 / 0.1 * 0.99, "reach 50 kPa at 101 mm, 0.051 D"),
        (None, "t-z 1 (SHAPE=EP) reach 50 kPa at 0.5 mm, 0.00025 D"),
    ],
)
def test_elastic_plastic_friction_peaks_at_a_hundredth_of_the_diameter(slope, words):
    shaft = curve("t-z", "direct", initial_stiffness=slope, options={"shape": "EP"})
    lines = warnings(scene(CLAY, shaft))
    assert [words in line for line in lines] == [True] * (words is not None)
    if words:
        assert "a slope (IKTSO, F3) of 2.5e6 Pa/m for 0.01 D" in lines[0]
        assert warnings(scene(CLAY, shaft, numerics=OFF, supports=TIP)) == []


@pytest.mark.parametrize(
    ("edge", "upper", "lower", "words"),
    [
        (34.0, 1e5, 2e6, None),
        (34.1, 1e5, 2e6, "rises from 100 kPa to 2 MPa at 34.1 m, 5.9 m above the tip"),
        (34.1, 1.01e6, 2e6, None),
        (46.0, 2e6, 1e5, None),
        (45.9, 2e6, 1e5, "falls from 2 MPa to 100 kPa at 45.9 m, 5.9 m below the tip"),
        (40.0, 2e6, 1e5, "0 m below the tip"),
        (45.9, 1e5, 2e6, None),
        (34.1, 2e6, 1e5, None),
    ],
)
def test_end_bearing_near_a_weaker_layer(edge, upper, lower, words):
    above, below = (curve("t-z", "direct", i, tip_pressure=q) for i, q in ((1, upper), (2, lower)))
    ground = scene((CLAY,) * 4, (above, above, below, below), depths=(0.0, edge, edge, 60.0))
    lines = warnings(ground)
    assert [words in line for line in lines] == [True] * (words is not None)
    can = Spudcan(1, 10.0, 0.0, 40e6, 0.5)
    assert not [w for w in warnings(replace(ground, spudcans=(can,))) if "end bearing" in w]
