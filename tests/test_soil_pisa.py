"""The reactions of PISA: the check table, the conic's limits, and fits outside their range."""

import csv
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.soil import pisa

(TABLE,) = (Path(__file__).parent / "data" / "soil").glob("11_*.csv")
KILO = 1e3
EPS = np.finfo(float).eps

CLAY = {
    "p": pisa.PisaClay,
    "m": pisa.PisaClayMoment,
    "HB": pisa.PisaClayBaseShear,
    "MB": pisa.PisaClayBaseMoment,
}
SAND = {
    "p": pisa.PisaSand,
    "m": pisa.PisaSandMoment,
    "HB": pisa.PisaSandBaseShear,
    "MB": pisa.PisaSandBaseMoment,
}
COMPONENTS = tuple(CLAY)
KINDS = [
    *((kind, {"site": site}) for kind in CLAY.values() for site in ("COWDEN", "BOTHKENNAR")),
    *((kind, {}) for kind in SAND.values()),
]
every_kind = pytest.mark.parametrize(
    ("kind", "options"), KINDS, ids=[f"{k.__name__}{''.join(o.values())}" for k, o in KINDS]
)


def table(model, component):
    """Columns of the check table (kN, kPa, m, rad) for one curve."""
    with TABLE.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [row for row in rows if row["model"] == model and row["comp"] == component]
    assert rows
    names = [name for name in rows[0] if name not in ("model", "comp", "val_openpile")]
    return {n: np.array([float(row[n] or "nan") for row in rows]) for n in names}


def make(kind, **values):
    """A law of what it takes among the values."""
    taken = {field.name for field in fields(kind)}
    return kind(**{name: value for name, value in values.items() if name in taken})


def soil(**changes):
    """A pile of 8 m and 32 m in either soil at 10 m, with what a test changes."""
    given = {
        "depth": 10.0,
        "diameter": 8.0,
        "embedded_length": 32.0,
        "initial_shear_modulus": 60e6,
        "undrained_shear_strength": 80e3,
        "effective_overburden": 100e3,
        "relative_density": 0.75,
    }
    return {**given, **changes}


def check(law, t, lateral=None):
    """k, n, Xu and Yu against the table, then the reaction, where the law asks times |p|."""
    columns = {"k": "k", "n": "n", "x_ultimate": "xu", "y_ultimate": "yu"}
    for name, column in columns.items():
        # the table prints eight digits
        np.testing.assert_allclose(law.derived[name], t[column], rtol=1e-6, atol=1e-12)
    reaction = law.force(t["x"]) * (1.0 if lateral is None else lateral)
    np.testing.assert_allclose(reaction, t["val_ref"] * KILO, rtol=1e-6)


@pytest.mark.parametrize("component", COMPONENTS)
def test_clay_check_table(component):
    t = table("clay_Cowden", component)
    law = make(
        CLAY[component],
        depth=t["z"],
        diameter=t["D"],
        embedded_length=t["L"],
        undrained_shear_strength=t["s"] * KILO,
        initial_shear_modulus=t["G0"] * KILO,
        site="COWDEN",
    )
    check(law, t)


@pytest.mark.parametrize("component", COMPONENTS)
def test_sand_check_table(component):
    t = table("sand_Dunkirk_GDSM", component)
    given = {
        "depth": t["z"],
        "diameter": t["D"],
        "embedded_length": t["L"],
        "effective_overburden": t["s"] * KILO,
        "initial_shear_modulus": t["G0"] * KILO,
        "relative_density": t["Dr"] / 100.0,
    }
    law = make(SAND[component], **given)
    # the table's moment is that of |p| = 0.6 pu
    lateral = 0.6 * make(pisa.PisaSand, **given).capacity if component == "m" else None
    check(law, t, lateral)


@pytest.mark.parametrize(
    ("component", "k", "n", "Xu", "Yu"),
    [
        # at z/D = 1.25 and L/D = 4, from the published coefficients
        ("p", 10.11625, 0.71705125, 173.8, 6.37212537),
        ("m", 1.501, 0.0, 0.27666556, 0.415275),
        ("HB", 1.9276, 0.48182, 291.5, 0.80246),
        ("MB", 0.2611, 0.237, 187.0, 0.5078),
    ],
)
def test_soft_clay_of_bothkennar(component, k, n, Xu, Yu):
    """No table has a row of it."""
    law = make(CLAY[component], **soil(site="BOTHKENNAR"))
    ours = [float(v[0]) for v in law.derived.values()][:4]
    np.testing.assert_allclose(ours, (k, n, Xu, Yu), rtol=1e-7)


@every_kind
def test_the_conic_solves_its_equation(kind, options):
    """The implicit equation, its slope k at rest, and the ultimate at Xu and beyond."""
    law = make(kind, **soil(**options))
    k, n, Xu, Yu, ultimate = (float(v[0]) for v in law.derived.values())
    reach = Xu * law.stiffness(np.zeros(1))[0] ** -1 * k * ultimate / Yu
    u = np.linspace(0.0, 1.0, 41) * reach
    x, y = u / reach, law.force(u[:, None])[:, 0] / ultimate
    rest = -n * (y - x) ** 2 + (1.0 - n) * (y - x * Xu * k / Yu) * (y - 1.0)
    np.testing.assert_allclose(rest, 0.0, atol=1e-12 * Xu * k / Yu)
    assert (law.force(reach * np.array([1.0 + 1e-12, 2.0, 1e6])[:, None]) == ultimate).all()
    assert (law.stiffness(reach * np.array([1.0 + 1e-12, 2.0])[:, None]) == 0.0).all()


def test_units_of_the_stiffness_at_rest():
    """k G0, D^2 and D^3 of it where the rotation counts, and D/s'v of it in the sand's moment."""
    given, rest = soil(), np.zeros(1)
    G0, D, s = 60e6, 8.0, 100e3
    factors = {"p": G0, "m": G0 * D**2, "HB": G0 * D, "MB": G0 * D**3}
    for component, factor in factors.items():
        clay, sand = make(CLAY[component], **given), make(SAND[component], **given)
        of_sand = G0 * D / s if component == "m" else factor
        np.testing.assert_allclose(clay.stiffness(rest), clay.derived["k"] * factor, rtol=1e-12)
        np.testing.assert_allclose(sand.stiffness(rest), sand.derived["k"] * of_sand, rtol=1e-12)


@pytest.mark.parametrize("kind", [pisa.PisaClayMoment, pisa.PisaSandMoment])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_moment_is_elastic_then_plastic_without_rounding_of_its_corner(kind, sign):
    law = make(kind, **soil(initial_shear_modulus=64e6, effective_overburden=128e3))
    first = law.stiffness(np.zeros(1))
    corner = law.capacity / first
    for share in (1e-9, 0.3, 1.0 - 1e-9):
        force, stiffness = law.evaluate(sign * share * corner)
        np.testing.assert_allclose(force, sign * share * law.capacity, rtol=1e-14)
        np.testing.assert_allclose(stiffness, first, rtol=1e-7)
    for share in (1.0 + 1e-9, 1.0 + 1e-3, 1e9):
        assert law.stiffness(sign * share * corner) == 0.0
        assert law.force(sign * share * corner) == sign * law.capacity


def test_the_corner_of_a_conic_of_n_0_takes_the_plastic_side():
    """The bases in soft clay reach n = 0 at L/D above 6.05, with Xu far beyond the corner."""
    law = pisa.PisaClayBaseMoment(
        diameter=4.0,
        embedded_length=28.0,
        initial_shear_modulus=2.0**26,
        undrained_shear_strength=2.0**16,
        site="BOTHKENNAR",
    )
    assert law.derived["n"] == 0.0
    assert law.derived["x_ultimate"] > 100.0 * law.derived["y_ultimate"]
    corner = law.capacity / law.stiffness(np.zeros(1))
    for side, share in ((1.0, 1.0 - 1e-9), (0.0, 1.0 + 1e-9), (0.0, 2.0), (0.0, 100.0)):
        slope = law.stiffness(share * corner) / law.stiffness(np.zeros(1))
        np.testing.assert_allclose(slope, side, atol=1e-6)
    near = corner * (1.0 + np.arange(-40, 41) * EPS)
    slopes = law.stiffness(near[:, None]) / law.stiffness(np.zeros(1))
    assert np.isin(slopes.round(12), (0.0, 1.0)).all()


def test_a_conic_of_n_1_is_the_secant():
    law = pisa.PisaClayBaseMoment(
        diameter=8.0,
        embedded_length=4.0,
        initial_shear_modulus=60e6,
        undrained_shear_strength=80e3,
        site="COWDEN",
    )
    assert law.derived["n"] == 1.0
    reach = law.derived["x_ultimate"] * 80e3 / 60e6
    for share in (0.0, 1e-12, 0.5, 1.0 - 1e-9):
        force, stiffness = law.evaluate(share * reach)
        np.testing.assert_allclose(force, share * law.capacity, rtol=1e-12)
        np.testing.assert_allclose(stiffness, law.capacity / reach, rtol=1e-12)
    assert law.stiffness(1.000001 * reach) == 0.0


@pytest.mark.parametrize("density", [0.45, 0.6, 0.75, 0.9])
@pytest.mark.parametrize("kind", [*CLAY.values(), *SAND.values()])
@pytest.mark.parametrize("site", ["COWDEN", "BOTHKENNAR"])
def test_within_their_range_the_fits_are_used_as_they_stand(kind, density, site):
    """2 <= L/D <= 6, whole shaft: nothing is held, and k is above the secant."""
    slenderness, share = (a.ravel() for a in np.meshgrid(np.linspace(2, 6, 21), (0, 0.1, 0.5, 1)))
    L = 8.0 * slenderness
    law = make(
        kind, **soil(depth=share * L, embedded_length=L, relative_density=density, site=site)
    )
    k, n, Xu, Yu = law.parameters
    raw = [fit.at(law._z / (L if fit.z_over == "L" else 8.0), density) for fit in law._fits]
    np.testing.assert_array_equal(k, np.broadcast_to(raw[0], k.shape))
    np.testing.assert_array_equal(n, np.broadcast_to(raw[1], n.shape))
    np.testing.assert_array_equal(Yu, np.broadcast_to(raw[3], Yu.shape))
    assert (Xu == np.maximum(raw[2], np.where(raw[2] == 0.0, Yu / k, 0.0))).all()
    assert (k * Xu >= Yu * (1.0 - EPS)).all()


@pytest.mark.parametrize("kind", [pisa.PisaClay, pisa.PisaClayBaseShear])
def test_where_the_fit_of_k_is_negative_the_initial_line_runs_up_to_the_ultimate(kind):
    law = make(kind, **soil(depth=96.0, embedded_length=96.0))
    k, _, Xu, Yu = (float(v[0]) for v in law.parameters)
    assert k == 1e-3
    assert Xu == Yu / k
    u = Xu * 80e3 * 8.0 / 60e6 * np.array([0.1, 0.5, 0.999])
    np.testing.assert_allclose(law.force(u), law.capacity * (0.1, 0.5, 0.999), rtol=1e-12)


@every_kind
def test_soil_without_strength_has_no_reaction(kind, options):
    weak = make(kind, **soil(undrained_shear_strength=0.0, effective_overburden=0.0, **options))
    u = np.array([0.0, 1e-300, 1e-9, 1.0, 1e3])[:, None]
    assert (np.array(weak.evaluate(u)) == 0.0).all()
    faint = make(kind, **soil(undrained_shear_strength=1e-300, effective_overburden=1e-300))
    assert np.isfinite(faint.evaluate(u)).all()
    hollow = make(kind, **soil(initial_shear_modulus=0.0, **options))
    assert (np.array(hollow.evaluate(u)) == 0.0).all()


def test_only_the_moment_in_sand_follows_the_lateral_reaction():
    assert issubclass(pisa.PisaSandMoment, pisa.MomentLaw)
    assert issubclass(pisa.PisaClayMoment, pisa.MomentLaw)
    assert pisa.PisaSandMoment.follows_lateral
    assert not pisa.PisaClayMoment.follows_lateral


@pytest.mark.parametrize("kind", [pisa.PisaClay, pisa.PisaSand])
def test_the_multiplier_acts_on_p_at_the_same_displacement(kind):
    u = np.array([1e-5, 0.02, 0.5, 50.0])[:, None]
    full, half = (make(kind, **soil(multiplier=m)).evaluate(u) for m in (1.0, 0.5))
    np.testing.assert_allclose(half, 0.5 * np.array(full), rtol=1e-14)


@pytest.mark.parametrize("kind", CLAY.values())
def test_an_unknown_site_is_refused(kind):
    with pytest.raises(InvalidData):
        make(kind, **soil(site="DUNKIRK"))
