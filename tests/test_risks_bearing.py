"""Axial loads against the capacity of a pile, by closed forms, before anything is solved."""

import re
from dataclasses import replace
from math import pi

import pytest

from podeep.checks import warnings
from podeep.risks.bearing import tip_support_check
from podeep.scene import Displacement, Load, Spring, Spudcan, Support
from risky import CLAY, OFF, TIP, curve, kilo, scene

FRICTION = pi * 2.0 * 40.0 * 50e3  # of the pile of `scene`, N
DIRECT = curve("t-z", "direct", tip_pressure=0.0)


def weight_in_water(length=40.0):
    area = pi / 4.0 * (2.0**2 - 1.9**2)
    return 9.80665 * area * length * (7850.0 - 1025.0)


def solid(force, **more):
    """Plugged, with no end bearing: friction outside alone, and the weights of pile and plug."""
    axial = replace(DIRECT, options={"shape": "2GEO", "plug": "PLUGGED"})
    return scene(CLAY, axial, force=(1e6, 0.0, force), **more)


def plug_weight():
    return pi / 4.0 * 1.9**2 * 40.0 * 9e3


def test_loads_beyond_the_capacity_are_told_before_anything_is_solved():
    own = weight_in_water() + plug_weight()
    most = FRICTION - own
    assert warnings(solid(-FRICTION / 1.5 + own + 1e3)) == []
    (line,) = warnings(solid(-FRICTION / 1.5 + own - 1e3))
    assert "that is a factor of 1.499, where the safety factor is 2.0 in operating, 1.5" in line
    assert "for a factor of 1.5, not 40 m" in line
    (line,) = warnings(solid(-0.999 * most))
    assert "that is a factor of 1, " in line
    (line,) = warnings(solid(-1.25 * most))
    assert line.startswith(f"F1: compression of {kilo(1.25 * most)} (step 2) and ")
    assert f"bears {kilo(FRICTION)} (plugged: shaft {kilo(FRICTION)}, tip 0 kN" in line
    assert "it can carry 0.8 of that load and no more (API RP 2GEO 8.1)" in line


def test_the_length_of_the_remedy_bears_the_load():
    deep = scene(CLAY, DIRECT, force=(1e6, 0.0, -16e6))
    (line,) = [w for w in warnings(deep) if "compression of" in w]
    length = float(re.search(r"embed ([0-9.]+) m to bear it, not 40 m", line)[1])
    longer = scene(CLAY, DIRECT, length=length, force=(1e6, 0.0, -16e6))
    assert "factor of 1, where" in next(w for w in warnings(longer) if "compression of" in w)
    shorter = scene(CLAY, DIRECT, length=length - 0.02, force=(1e6, 0.0, -16e6))
    assert "carry 0.999 of that load and no more" in next(
        w for w in warnings(shorter) if "compr" in w
    )


def test_tension_counts_the_weights_and_no_tip():
    own = weight_in_water() + plug_weight()
    assert warnings(solid((FRICTION + own) / 1.5 - 1e3)) == []
    (line,) = warnings(solid((FRICTION + own) * 2.0))
    assert line.startswith("F1: tension of ")
    assert f"(plugged: shaft {kilo(FRICTION)}, weight {kilo(own)})" in line
    assert "it can carry 0.5 of that load" in line


@pytest.mark.parametrize(
    "holding",
    [
        {"supports": (Support(1, -40.0, ("Z",)),)},
        {"springs": (Spring(1, -40.0, "Z", 1e9),)},
        {"displacements": (Displacement("A", 1, 5.0, "Z", 0.01),)},
        {"spudcans": (Spudcan(1, 10.0, 0.0, 40e6, 0.5),)},
    ],
)
def test_a_pile_that_something_else_holds_is_not_held_against_its_capacity(holding):
    told = warnings(solid(-2.0 * FRICTION, **holding))
    assert not [line for line in told if "bears" in line]
    assert [line for line in told if "both carry the axial load" in line] == (
        told if "supports" in holding else []
    )
    assert warnings(solid(-2.0 * FRICTION, supports=(Support(1, -40.0, ("X",)),))) != []


def test_no_length_that_is_looked_at_is_enough():
    (line,) = warnings(solid(-4.0 * FRICTION))
    assert "lower the load or widen the pile: no length up to 120 m is enough to bear it" in line


def test_a_pile_that_cores_while_the_solver_takes_the_full_tip():
    """Qi + q Aw = 12.9 MN against q A = 15.7 MN: only once the capacity is used by half."""
    at = curve("t-z", "direct", tip_pressure=5e6)
    inside, area = pi * 1.9 * 40.0 * 50e3, pi / 4.0 * 2.0**2
    wall = area - pi / 4.0 * 1.9**2
    cores = FRICTION + inside + 5e6 * wall
    less = FRICTION + 5e6 * area - cores
    assert less > 0.0
    limit = 0.5 * cores - weight_in_water()
    assert warnings(scene(CLAY, at, force=(1e6, 0.0, -limit + 1e3))) == []
    (line,) = warnings(scene(CLAY, at, force=(1e6, 0.0, -limit - 1e3)))
    assert f"too much by {kilo(less)} if the pile cores" in line
    lower = re.search(r"from 5 MPa to ([0-9.]+) MPa, with which", line)[1]
    assert float(lower) * 1e6 * area == pytest.approx(inside + 5e6 * wall, rel=2e-4)
    can = {"spudcans": (Spudcan(1, 10.0, 0.0, 40e6, 0.5),)}  # in place of Q-z
    assert warnings(scene(CLAY, at, force=(1e6, 0.0, -limit - 1e3), **can)) == []
    plugged = replace(at, options={"shape": "2GEO", "plug": "PLUGGED"})
    assert warnings(scene(CLAY, plugged, force=(1e6, 0.0, -limit - 1e3))) == []


def test_a_support_at_the_tip_is_held_against_the_capacity():
    own = weight_in_water() + plug_weight()
    limit = 0.5 * FRICTION - own
    for load, loud in ((limit - 1e3, False), (limit + 1e3, True)):
        concept = solid(-load, supports=TIP, numerics=OFF)
        line = tip_support_check(concept, concept.foundations[0])
        assert line.startswith(f"F1: the support along z carries compression of {kilo(load)}")
        factor = "1.999" if loud else "2"
        assert f"the t-z curves bear {kilo(FRICTION)} (plugged), a factor of {factor}" in line
        assert ("less than 2.0 of operating conditions; embed" in line) is loud
        assert len(warnings(concept)) == loud
    assert "; embed 40.01 m for a factor of 2, not 40 m" in warnings(concept)[0]


def test_a_support_is_checked_only_where_it_stands_in_for_t_z():
    for quiet in (
        solid(-1e6),
        solid(-1e6, supports=TIP),
        solid(-1e6, supports=(Support(1, -40.0, ("X",)),), numerics=OFF),
        solid(-1e6, spudcans=(Spudcan(1, 10.0, 0.0, 40e6, 0.5),), supports=TIP, numerics=OFF),
    ):
        assert tip_support_check(quiet, quiet.foundations[0]) == ""


def test_a_load_that_buoyancy_carries_has_an_ample_factor():
    light = solid(-1e3, supports=TIP, numerics=OFF, density=0.0)
    axial = {1: replace(DIRECT, parameters=DIRECT.parameters | {"effective_unit_weight": 0.0})}
    light = replace(light, ground=replace(light.ground, axial_curves=axial))
    line = tip_support_check(light, light.foundations[0])
    assert line.endswith("a factor of more than 1000")
    assert warnings(light) == []


def test_a_support_without_t_z_curves_has_an_unknown_capacity():
    bare = scene(CLAY, None, supports=TIP)
    line = tip_support_check(bare, bare.foundations[0])
    assert line.endswith("carries 1000 kN, the capacity is unknown: no t-z curve reacts")
    (line,) = warnings(bare)
    assert "carries 1000 kN: whether the soil could is unknown: no t-z curve reacts; give" in line
    sideways = replace(bare, loads=(Load("A", 1, 5.0, (1e6, 0.0, 0.0), (0.0,) * 3),))
    assert warnings(sideways) == []
    known = solid(0.0, supports=TIP, numerics=OFF)
    assert "carries nothing, the t-z curves bear" in tip_support_check(known, known.foundations[0])
