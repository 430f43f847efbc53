"""Models of the soil under any pipe: inverses, derivatives, limits, ranges, refusals, laying."""

from itertools import pairwise
from math import inf, pi, radians, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.errors import InvalidData
from podeep.seabed import bearing
from podeep.seabed.dnv14 import Dnv14
from podeep.seabed.lay import laid
from podeep.seabed.models import MODELS, NOT_FOUND
from podeep.seabed.parameters import PARAMETERS, PIPE
from podeep.seabed.stiffness import pipe_stiffness

EXACT = 1e-9  # relative


def exactly(value):
    return pytest.approx(value, rel=EXACT, abs=0.0)


# --- any parameters ---------------------------------------------------------------------------


def numbers(key):
    """Values of a parameter over all its bounds, in SI; over decades where it has many."""
    one = PARAMETERS[key]
    low, high = (one.taken(v) for v in (one.low, one.high * (1.0 - 1e-12)))
    if low > 0.0 and high / low > 100.0:
        return st.floats(np.log(low), np.log(high)).map(lambda x: float(np.exp(x)))
    return st.floats(low, high)


@st.composite
def pipes(draw, name):
    """A law of a model with anything that it takes, and a weight."""
    model = MODELS[name]
    values = {p.key: draw(numbers(p.key)) for p in model.parameters}
    return model.at(draw(numbers("diameter")), values), draw(numbers("weight"))


@pytest.mark.parametrize("name", MODELS)
def test_any_pipe(name):
    """Finite, positive, the inverse is one, the force rises: over all bounds."""

    @given(pipes(name))
    @settings(max_examples=60, deadline=None, derandomize=True)
    def check(pipe):
        law, weight = pipe
        found = pipe_stiffness(law, weight)
        numbers = (found.penetration, found.contact_width, found.static, found.tangent)
        more = [k for k in (found.dynamic, found.lateral) if k is not None]
        assert all(0.0 < n < inf for n in (*numbers, *more))
        assert float(law.force(np.array(found.penetration))) == exactly(weight)
        z = found.penetration * np.array([-1.0, -0.0, 0.0, 0.5, 1.0, 1.0 + 1e-6, 2.0, 1e3])
        force, slope = law.evaluate(z)
        assert not force[:3].any()
        assert (np.diff(force[2:]) > 0.0).all()
        assert slope[0] == 0.0
        assert (slope[3:] > 0.0).all()
        assert np.isfinite(slope[3:]).all()
        assert slope[1] == slope[2] >= 0.0

    check()


@pytest.mark.parametrize("name", MODELS)
def test_the_derivative_is_that_of_the_force(name):
    @given(pipes(name), st.floats(-6.0, 1.0))
    @settings(max_examples=60, deadline=None, derandomize=True)
    def check(pipe, decade):
        law, _ = pipe
        z = float(law.diameter) * 10.0**decade
        if abs(z / law.diameter - 0.0969) < 1e-3 or abs(z / law.diameter - 0.5) < 1e-3:
            z *= 1.1  # kinks: in the minimum of F114, in the curvature of the contact width
        h = 1e-4 * z
        low, high = law.force(np.array([z - h, z + h]))
        assert (high - low) / (2.0 * h) == pytest.approx(float(law.stiffness(z)), rel=1e-6)

    check()


#: A pipe of 0.5 m; slope at z = 0 as the formulas give it.
TYPICAL = {
    "undrained_shear_strength": 5e3,
    "effective_unit_weight": 6e3,
    "friction_angle": radians(32.0),
    "verley_lund_unit_weight": 18e3,
    "given_static_stiffness": 2e5,
    "given_dynamic_stiffness": 9e5,
}
STARTS = {
    "DNV14CLAY": inf,
    "DNV14SAND": 2.0 * 6e3 * float(bearing.sand_factors(radians(32.0))[1]) * 0.5,
    "DUNLAP": inf,
    "VERLEYLUND": 0.0,
    "VERLEYLUNDLINEAR": 5e3 / (0.09 * (5e3 / (0.5 * 18e3)) ** 0.3),
    "VERLEYSOTBERG": 0.0,
    "F114": inf,
    "NGIDRAINED": 0.0,
    "AUDIBERTCLAY": 5.14 * 5e3 * 0.5 / (0.07 * 0.1 * 0.5),
    "AUDIBERTSAND": 0.25 * 6e3 * float(bearing.sand_factors(radians(32.0))[1]) / 0.007,
    "DIRECT": 2e5,
}


def typical(name, diameter=0.5, **other):
    return MODELS[name].at(diameter, TYPICAL | other)


@pytest.mark.parametrize("name", MODELS)
def test_the_slope_that_a_model_starts_with(name):
    law = typical(name)
    assert float(law.stiffness(np.array(0.0))) == pytest.approx(STARTS[name], rel=1e-12)
    near = float(law.stiffness(np.array(1e-13)))
    if STARTS[name] == inf:
        assert 1e7 < near < inf
    elif STARTS[name]:
        assert near == pytest.approx(STARTS[name], rel=1e-5)
    else:
        assert 0.0 < near < 1e-1 * float(law.stiffness(np.array(0.05)))


def test_shallow_limits_and_kinks():
    D, z = 0.5, 1e-12
    clay, sand = (typical(name).force(np.array(z)) for name in ("DNV14CLAY", "DNV14SAND"))
    assert float(clay) == pytest.approx(2 * 5.14 * 5e3 * sqrt(z * D), rel=1e-5)
    assert float(sand) == pytest.approx(STARTS["DNV14SAND"] * z, rel=1e-5)
    f114, at = typical("F114"), D * (6.0 / (3.4 * sqrt(10.0))) ** 4
    before, after = f114.stiffness(at * np.array([1.0 - 1e-9, 1.0 + 1e-9]))
    soil = 1.5 * 6e3 * float(bearing.contact_width(at, D))
    assert (before - soil) / (after - soil) == pytest.approx(2.0, rel=1e-6)
    # past its half the pipe has a box above it, as wide as itself
    widths = bearing.contact_width(np.array([-1.0, 0.0, 0.1, 0.25, 3.0]), D)
    np.testing.assert_allclose(widths, [0.0, 0.0, 0.4, 0.5, 0.5])
    areas = bearing.embedded_area(np.array([-1.0, 0.0, 0.25, 0.5]), D)
    np.testing.assert_allclose(areas, [0.0, 0.0, pi * D**2 / 8, pi * D**2 / 8 + D * D / 2])
    (arc,) = np.arcsin(bearing.contact_width(np.array([0.1]), D) / D)
    segment = arc * D**2 / 4 - 0.4 * D / 4 * np.cos(arc)  # as it is printed
    assert float(bearing.embedded_area(0.1, D)) == pytest.approx(segment, rel=1e-14)


@pytest.mark.parametrize("name", MODELS)
def test_many_pipes_at_once(name):
    """Parameters by point, as a line with several sections has them; any shape before that."""
    diameters, strengths = np.array([0.2, 0.5, 0.9]), np.array([2e3, 5e3, 40e3])
    law = typical(name, diameters, undrained_shear_strength=strengths)
    alone = [
        typical(name, d, undrained_shear_strength=su)
        for d, su in zip(diameters.tolist(), strengths.tolist(), strict=True)
    ]
    weights = np.array([300.0, 900.0, 4e3])
    z = law.penetration(weights)
    ones = [float(a.penetration(w)) for a, w in zip(alone, weights.tolist(), strict=True)]
    np.testing.assert_allclose(z, ones, rtol=1e-13)
    np.testing.assert_allclose(law.force(z), weights, rtol=EXACT)
    together = np.array([z, 0.1 * z, 0.0 * z, -z])
    force, slope = law.evaluate(together)
    assert force.shape == slope.shape == together.shape
    for i, a in enumerate(alone):
        np.testing.assert_allclose(force[:, i], a.force(together[:, i]), rtol=1e-14)
        np.testing.assert_allclose(slope[:, i], a.stiffness(together[:, i]), rtol=1e-14)
    assert law.capacity.shape == (3,)
    assert law.evaluate(np.zeros((0, 3)))[0].shape == (0, 3)
    dynamic = law.dynamic_stiffness(z)
    assert dynamic is None or dynamic.shape == (3,)


@pytest.mark.parametrize("name", ["AUDIBERTCLAY", "AUDIBERTSAND"])
def test_the_hyperbola(name):
    """At zu it carries the bearing capacity; Kd is its first slope; Ks its secant."""
    law = typical(name, ultimate_penetration=0.12)
    su, (Nq, Ngamma, Nc) = law._strength
    zu, D, g = 0.12 * 0.5, 0.5, 6e3
    capacity = Nc * su * D + Nq * g * zu * D + Ngamma * g * D**2 / 2
    assert float(law.force(np.array(zu))) == pytest.approx(capacity, rel=1e-14)
    found = pipe_stiffness(law, float(capacity))
    assert found.penetration == pytest.approx(zu, rel=1e-13)
    assert found.dynamic == pytest.approx(capacity / (0.07 * zu), rel=1e-13)
    assert found.warnings == ()
    (beyond,) = pipe_stiffness(law, 1.01 * float(capacity)).warnings
    assert beyond.startswith("z/zu = 1.")


def test_ranges():
    soft = typical("VERLEYLUND", undrained_shear_strength=300.0)
    assert [w.partition(" is")[0] for w in pipe_stiffness(soft, 1500.0).warnings] == [
        "z/D = 0.582",
        "S G^0.3 = 3.6",
    ]
    assert [w.partition(" is")[0] for w in pipe_stiffness(soft, 1300.0).warnings] == [
        "S G^0.3 = 3.12"
    ]
    assert pipe_stiffness(typical("DUNLAP"), 15e3).warnings == ()  # z/D = 0.75
    assert pipe_stiffness(typical("DUNLAP"), 20e3).warnings[0].startswith("z/D = 1.15 is above 1:")
    loose = typical("DNV14SAND", void_ratio=2.5, poisson_ratio=0.3)
    assert pipe_stiffness(loose, 500.0).warnings[0].startswith("e = 2.5 is above 2:")
    assert pipe_stiffness(typical("DIRECT", given_dynamic_stiffness=1e5), 500.0).warnings


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "key", "value", "told"),
    [
        ("DNV14CLAY", "void_ratio", 2.97, "the void ratio is 2.97; it has to be 0.01 to below"),
        ("DNV14CLAY", "poisson_ratio", 0.5, "ratio of the soil is 0.5; it has to be 0 to below"),
        ("DNV14SAND", "friction_angle", radians(60.0), "angle is 60; it has to be 10 to 50 deg"),
        ("DUNLAP", "undrained_shear_strength", -1.0, "shear strength is -1; it has to be 1 to"),
        ("F114", "effective_unit_weight", np.nan, "effective unit weight is nan"),
        ("F114", "diameter", 0.0, "the outer diameter in contact is 0; it has to be 0.01 to 20 m"),
        ("VERLEYLUND", "verley_lund_unit_weight", inf, r"unit weight in G .* is inf"),
        ("DIRECT", "given_static_stiffness", 0.0, "static stiffness is 0"),
        ("DUNLAP", "undrained_shear_strength", np.array([5e3, 0.0]), "shear strength is 0"),
    ],
)
def test_parameters_out_of_bounds(name, key, value, told):
    diameter = value if key == "diameter" else 0.5
    with pytest.raises(InvalidData, match=told) as caught:
        MODELS[name].at(diameter, TYPICAL | {key: value})
    assert caught.value.field == PARAMETERS[key].symbol


def test_bounds_belong_to_what_is_allowed():
    for edge in (radians(10.0), radians(50.0)):
        typical("DNV14SAND", friction_angle=edge)
    typical("DNV14CLAY", void_ratio=2.9699, poisson_ratio=0.0)


@pytest.mark.parametrize("weight", [0.0, -800.0, np.nan, inf])
@pytest.mark.parametrize("name", ["DUNLAP", "DNV14CLAY"])
def test_weights_that_do_not_press(name, weight):
    with pytest.raises(InvalidData, match="the submerged weight of the pipe is"):
        typical(name).penetration(weight)


def test_soil_is_clay_or_sand():
    for strengths in ({}, {"undrained_shear_strength": 5e3, "friction_angle": 0.5}):
        with pytest.raises(InvalidData, match=r"either clay.* or sand"):
            Dnv14(diameter=0.5, effective_unit_weight=6e3, **strengths)


# --- laying -----------------------------------------------------------------------------------

#: EI k / T0^2, the factor by formula, and the exact boundary layer's largest penetration.
LAY = (
    (1.0, 1.000, 1.022),
    (5.0, 1.198, 1.165),
    (10.0, 1.311, 1.271),
    (20.0, 1.446, 1.406),
    (50.0, 1.664, 1.635),
    (100.0, 1.865, 1.853),
    (500.0, 2.491, 2.547),
    (1000.0, 2.849, 2.949),
)


@pytest.mark.parametrize(("relative", "factor", "exact"), LAY)
def test_lay_factor_on_linear_soil(relative, factor, exact):
    tension, weight = 60e3, 900.0
    found = laid(typical("DIRECT"), weight, relative * tension**2 / 2e5, tension)
    assert found.factor == pytest.approx(factor, abs=5e-4)
    assert found.penetration == pytest.approx(found.factor * weight / 2e5, rel=1e-12)
    assert found.factor == pytest.approx(exact, rel=0.035)


@pytest.mark.parametrize("name", MODELS)
def test_lay_factor_on_any_soil(name):
    """The secant is that of the penetration found, and more stiffness lays deeper."""
    law, weight, tension, last = typical(name), 900.0, 60e3, 0.0
    for EI in (1.0, 1e6, 1e8, 1e10):
        found = laid(law, weight, EI, tension)
        force = float(law.force(np.array(found.penetration)))
        relative = EI * force / found.penetration / tension**2
        assert found.factor == pytest.approx(max(1.0, 0.6 + 0.4 * relative**0.25), rel=1e-9)
        assert force == pytest.approx(found.factor * weight, rel=1e-9)
        assert found.factor >= last
        last = found.factor
    assert laid(law, weight, 1.0, tension).factor == 1.0
    least = (3.0 * sqrt(1e10) * weight) ** (2.0 / 3.0)
    assert found.least_tension == pytest.approx(least)


@pytest.mark.parametrize(("EI", "tension"), [(0.0, 1e4), (1e7, -1.0), (np.nan, 1e4), (1e7, inf)])
def test_what_cannot_be_laid(EI, tension):
    with pytest.raises(InvalidData, match="it has to be 1 to"):
        laid(typical("F114"), 900.0, EI, tension)


# --- the table of models ----------------------------------------------------------------------


def test_every_model_knows_its_parameters():
    for model in MODELS.values():
        for key in model.needed:
            others = {p.key for p in model.parameters} - {key}
            assert [p.key for p in model.lacks(others)] == [key]
        for key in model.optional:
            default = model.default(key)
            assert default is None or default in PARAMETERS[key]
            assert (default is None) == bool(PARAMETERS[key].otherwise)
        assert model.law.source
    symbols = [p.symbol for p in PARAMETERS.values()]
    assert len(set(symbols)) == len(symbols)
    used = {p.key for m in MODELS.values() for p in m.parameters}
    assert set(PARAMETERS) == used | {*PIPE, "bending_stiffness", "lay_tension"}


def test_what_was_not_found_has_no_number():
    """The rows of the original whose formula is not public give none, or say that they guess."""
    for name in ("DUNLAP", "VERLEYLUND", "VERLEYLUNDLINEAR"):
        law = typical(name)
        assert law.dynamic_stiffness(0.01) is None
        assert "no public formula" in law.no_dynamic
    assert all(
        m.static == "reconstructed" and "not the formula of DeepLines" in m.remark
        for m in MODELS.values()
        if "AUDIBERT" in m.name
    )
    assert [text.partition(" ")[0] for text in NOT_FOUND] == ["Audibert", "Dunlap", "Verley"]


def test_models_rise_with_weight_and_fall_with_strength():
    for name, model in MODELS.items():
        depths = [float(typical(name).penetration(w)) for w in (10.0, 100.0, 1e3, 1e4)]
        assert all(a < b for a, b in pairwise(depths))
        if model.soil == "CLAY":
            soft, hard = (
                float(typical(name, undrained_shear_strength=su).penetration(1e3))
                for su in (2e3, 2e4)
            )
            assert hard < soft
