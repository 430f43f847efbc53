"""What holds for every soil law, whatever its parameters."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from podeep.soil import (
    axial,
    iso_clay,
    lateral,
    pisa,
    reese_sand,
    sand,
    soft_clay,
    stiff_clay,
    weak_rock,
)
from podeep.soil.backbone import SignedUserCurve, UserCurve

POINTS = 3
EPS = np.finfo(float).eps

#: ranges of parameters, by the names of the laws' fields
RANGES = {
    "depth": (0.0, 60.0),
    "diameter": (0.1, 6.0),
    "effective_overburden": (0.0, 6e5),
    "undrained_shear_strength": (0.0, 4e5),
    "effective_unit_weight": (0.0, 12e3),
    "j": (0.25, 0.5),
    "strain_50": (0.002, 0.03),
    "friction_angle": (np.radians(20.0), np.radians(42.0)),
    "subgrade_modulus": (1e6, 8e7),
    "multiplier": (0.1, 1.0),
    "initial_stiffness": (1e5, 1e9),
    "earth_pressure_coefficient": (0.3, 1.2),
    "interface_friction_angle": (np.radians(10.0), np.radians(40.0)),
    "friction_limit": (1e3, 2e5),
    "bearing_factor": (5.0, 60.0),
    "end_bearing_limit": (1e5, 2e7),
    "unit_friction": (0.0, 2e5),
    "tip_pressure": (0.0, 2e7),
    "force_scale": (0.1, 20.0),
    "displacement_scale": (0.1, 6.0),
    "mean_undrained_shear_strength": (0.0, 4e5),
    "cycles": (1.0, 1e6),
    "depth_in_rock": (0.0, 60.0),
    "compressive_strength": (0.0, 2e7),
    "rock_mass_modulus": (1e7, 2e10),
    "rock_quality_designation": (0.0, 1.0),
    "strain_rm": (5e-5, 5e-4),
    "mudline_strength": (0.0, 1e5),
    "strength_gradient": (0.0, 5e3),
    "adhesion": (0.0, 1.0),
    "overconsolidation_ratio": (1.0, 20.0),
    "embedded_length": (3.0, 90.0),
    "initial_shear_modulus": (1e6, 5e8),
    "relative_density": (0.2, 1.0),
}
SOFTENING = ((1e4, 0.002), (3e4, 0.01), (2e4, 0.3))
SIGNED = ((-2e4, -0.1), (-3e4, -0.02), (1e4, 0.005), (3e4, 0.01))

#: fields that a case gives, or that have a default
OPTIONS = set("cyclic shape residual method stiffness_depth plasticity no_gap site".split())
OPTIONS.add("strength_ratio")
SHAPES = ("EP", "API", "2GEO")
CASES = [
    *((soft_clay.SoftClay, {"shape": s, "cyclic": False}) for s in ("2GEO", "WSD", "POWER")),
    *((soft_clay.SoftClay, {"shape": s, "cyclic": True}) for s in ("2GEO", "WSD", "POWER")),
    *((sand.Sand, {"cyclic": c}) for c in (False, True)),
    *((stiff_clay.StiffClayFreeWater, {"cyclic": c}) for c in (False, True)),
    *((stiff_clay.StiffClay, {"cyclic": c}) for c in (False, True)),
    (stiff_clay.StiffClayFreeWater, {"cyclic": True, "subgrade_modulus": None}),
    (reese_sand.ReeseSand, {"cyclic": True, "subgrade_modulus": None}),
    (sand.Sand, {"subgrade_modulus": None}),
    (weak_rock.WeakRock, {}),
    *((reese_sand.ReeseSand, {"cyclic": c}) for c in (False, True)),
    *((iso_clay.IsoClay, {"plasticity": p, "no_gap": n}) for p in ("HIGH", "LOW") for n in (0, 1)),
    (iso_clay.IsoClay, {"strength_ratio": 0.9}),
    *((law, {"site": s}) for law in lateral.LAWS["pisa_clay"] for s in ("COWDEN", "BOTHKENNAR")),
    *((law, {}) for law in lateral.LAWS["pisa_sand"]),
    *((shaft, {"shape": s}) for shaft, _ in axial.LAWS.values() for s in SHAPES),
    *((tip, {"shape": s}) for _, tip in axial.LAWS.values() for s in SHAPES),
    (axial.CohesiveShaft, {"shape": "2GEO", "residual": 0.7}),
    (axial.CohesiveShaft, {"method": "DIRECT"}),
    (axial.CohesionlessShaft, {"method": "DIRECT", "shape": "API"}),
    (UserCurve, {"points": SOFTENING}),
    (SignedUserCurve, {"points": SOFTENING}),
    (SignedUserCurve, {"points": SIGNED}),
]

every_law = pytest.mark.parametrize(
    ("kind", "options"),
    CASES,
    ids=[f"{kind.__name__}-{'-'.join(map(str, o.values()))[:20]}" for kind, o in CASES],
)
few = settings(max_examples=20, deadline=None, derandomize=True)

magnitudes = st.one_of(
    st.just(0.0), st.floats(np.log(1e-12), np.log(1e3)).map(lambda x: float(np.exp(x)))
)
displacements = st.lists(
    st.tuples(magnitudes, st.sampled_from((-1.0, 1.0))).map(lambda pair: pair[0] * pair[1]),
    min_size=POINTS,
    max_size=POINTS,
).map(np.array)


def between(low, high):
    """A parameter at n points: a bound, or at least a billionth of the larger one."""
    value = st.one_of(st.just(low), st.floats(max(low, 1e-9 * high), high))
    return st.lists(value, min_size=POINTS, max_size=POINTS).map(np.array)


def draw_law(data, kind, options):
    drawn = {f.name for f in fields(kind)} - options.keys()
    ranges = {name: RANGES[name] for name in RANGES if name in drawn}
    values = {name: data.draw(between(*bounds), name) for name, bounds in ranges.items()}
    return kind(**values, **options)


def one_point(law, i):
    """The same law with the parameters of one point as plain floats."""
    arrays = {f.name: getattr(law, f.name) for f in fields(law) if f.name in RANGES}
    given = {name: values for name, values in arrays.items() if np.size(values) == POINTS}
    return replace(law, **{name: float(values[i]) for name, values in given.items()})


def test_every_registered_law_is_tried():
    sides = (*lateral.LAWS.values(), *axial.LAWS.values())
    registered = {law for side in sides for law in side if law}
    assert {f.name for law in registered for f in fields(law)} <= {*RANGES, *OPTIONS}
    assert registered <= {kind for kind, _ in CASES}


@every_law
@few
@given(data=st.data())
def test_rest_bounds_and_oddness(kind, options, data):
    law, u = draw_law(data, kind, options), data.draw(displacements, "u")
    force, stiffness = law.evaluate(u)
    assert (law.force(np.zeros(POINTS)) == 0.0).all()
    assert law.capacity.shape == (POINTS,)
    assert (np.abs(force) <= law.capacity * (1.0 + 4.0 * EPS)).all()
    assert (force * u >= -4.0 * EPS * law.capacity * np.abs(u)).all()
    assert np.isfinite(force).all()
    assert np.isfinite(stiffness).all()
    opposite, same = law.evaluate(-u)
    if law.odd:
        assert (opposite == -force).all()
        assert (same == stiffness).all()
    elif isinstance(law, axial.Tip) or options["points"] == SOFTENING:
        assert (np.where(u < 0.0, force, 0.0) == 0.0).all()
        assert (np.where(u < 0.0, stiffness, 0.0) == 0.0).all()


@every_law
@few
@given(data=st.data())
def test_stiffness_is_the_derivative_of_the_force(kind, options, data):
    """The central difference lies between the derivatives at its ends: also across a kink."""
    law, u = draw_law(data, kind, options), data.draw(displacements, "u")
    u = np.where(u == 0.0, 1e-9, u)
    step = 1e-6 * np.abs(u)
    (before, slope_before), (after, slope_after) = law.evaluate(u - step), law.evaluate(u + step)
    # the step as the machine takes it
    difference = (after - before) / ((u + step) - (u - step))
    rounding = 1e-9 * law.capacity / np.abs(u) + 1e-6 * (np.abs(slope_before) + np.abs(slope_after))
    assert (difference >= np.minimum(slope_before, slope_after) - rounding).all()
    assert (difference <= np.maximum(slope_before, slope_after) + rounding).all()


@every_law
@few
@given(data=st.data())
def test_the_reaction_rises_up_to_its_peak_and_keeps_its_sign(kind, options, data):
    law = draw_law(data, kind, options)
    u = np.concatenate(([0.0], np.geomspace(1e-9, 1e3, 241)))[:, None] * np.ones(POINTS)
    force, tiny = law.force(u), 1e-12 * law.capacity
    assert (force >= -tiny).all()
    peak = np.where(np.arange(len(u))[:, None] <= force.argmax(axis=0), force, np.inf)
    assert (np.diff(np.minimum(peak, force.max(axis=0)), axis=0) >= -tiny).all()


@every_law
@few
@given(data=st.data())
def test_shapes_agree(kind, options, data):
    """Stacked displacements are their rows, one point is its element, and calls repeat."""
    law = draw_law(data, kind, options)
    stacked = np.stack([data.draw(displacements, "u"), data.draw(displacements, "v")])
    given_stack = stacked.copy()
    results = law.evaluate(stacked)
    assert (stacked == given_stack).all()
    again = law.evaluate(stacked)
    assert results[0].tobytes() == again[0].tobytes()
    assert results[1].tobytes() == again[1].tobytes()
    assert replace(law).evaluate(stacked)[0].tobytes() == results[0].tobytes()
    tiny = 1e-14 * law.capacity
    for row, u in enumerate(stacked):
        for result, alone in zip(results, law.evaluate(u), strict=True):
            np.testing.assert_allclose(result[row], alone, rtol=1e-13)
        for i in range(POINTS):
            force, stiffness = one_point(law, i).evaluate(u[i : i + 1])
            np.testing.assert_allclose(results[0][row, i], force[0], rtol=1e-13, atol=tiny[i])
            np.testing.assert_allclose(results[1][row, i], stiffness[0], rtol=1e-12)


@every_law
def test_forces_scale_with_the_multiplier_at_the_same_displacement(kind, options):
    middle = {
        f.name: np.full(POINTS, np.mean(RANGES[f.name]))
        for f in fields(kind)
        if f.name in RANGES and f.name not in options
    }
    if "multiplier" not in middle:
        assert issubclass(kind, axial.Shaft | axial.Tip | pisa.Conic)
        return
    u = np.array([1e-4, 0.03, 2.0])
    full, half = (kind(**{**middle, "multiplier": m}, **options).evaluate(u) for m in (1.0, 0.5))
    np.testing.assert_allclose(half, 0.5 * np.array(full), rtol=1e-14)
