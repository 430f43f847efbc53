"""Every layout of *PYCURVE and *TZCURVE, and what it becomes."""

from math import radians
from pathlib import Path

import pytest

from podeep.deck.read import read_deck
from podeep.errors import UserError
from podeep.scene import Curve

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")

CLAY = {
    "undrained_shear_strength": 20e3,
    "effective_unit_weight": 8e3,
    "j": 0.5,
    "strain_50": 0.01,
    "multiplier": 1.0,
}
SAND = {
    "effective_unit_weight": 1e4,
    "friction_angle": radians(35.0),
    "subgrade_modulus": 22e6,
    "multiplier": 1.0,
}


def curve(folder: Path, keyword: str, text: str) -> Curve:
    """The curve 9 that a paragraph makes."""
    path = folder / "a.deck"
    path.write_text(BASE.replace("*GROUNDPROP", f"*{keyword}{text}\n*GROUNDPROP"), encoding="utf-8")
    ground = read_deck(path).scene.ground
    return (ground.lateral_curves if keyword == "PYCURVE" else ground.axial_curves)[9]


def fault(folder: Path, keyword: str, text: str) -> str:
    """The only fault of a paragraph, without its place."""
    with pytest.raises(UserError) as caught:
        curve(folder, keyword, text)
    (found,) = caught.value.faults
    assert found.place is not None
    return f"{found.message}; {found.remedy}"


@pytest.mark.parametrize(
    "text",
    [
        "\n9\n1 20e3 8e3 0.5 0.01",
        "\n9 1 20e3 8e3 0.5 0.01",
        " 9\n1 20e3 8e3 J=0.5 EPSC=0.01",
        " 9 1 20.D3 8d3 .5 1E-2",
        "\n9 &\n1 20e3 & ignored\nC comment\n 8e3 0.5 0.01",
        "\n9 1 EPSC=0.01 J = 0.5 GAMMA=8e3 cu=20e3",
        "\n9 J=0.5\n1 20e3 8e3 EPSC=0.01",
    ],
)
def test_soft_clay(tmp_path: Path, text: str) -> None:
    found = curve(tmp_path, "PYCURVE", text)
    assert (found.law, dict(found.parameters)) == ("soft_clay", CLAY)
    assert dict(found.options) == {"cyclic": False, "shape": "2GEO"}
    assert found.rows == ()


@pytest.mark.parametrize(
    "text",
    [
        ", CYCLIC, SHAPE=power, PMULT=0.5\n9\n1 20e3 8e3 0.5 0.01",
        ",cyclic\n9 SHAPE=POWER\n1 20e3 8e3 0.5 0.01 PMULT=0.5",
        ", SHAPE = POWER , CYCLIC 9 1 20e3 8e3 0.5 0.01 PMULT=.5",
    ],
)
def test_options_go_after_a_comma_or_by_name(tmp_path: Path, text: str) -> None:
    found = curve(tmp_path, "PYCURVE", text)
    assert dict(found.options) == {"cyclic": True, "shape": "POWER"}
    assert dict(found.parameters) == CLAY | {"multiplier": 0.5}


@pytest.mark.parametrize("text", [",CYCLIC\n9\n2 1e4 35 22e6", ", CYCLIC\n9 2 1e4 35 K=22e6"])
def test_sand(tmp_path: Path, text: str) -> None:
    found = curve(tmp_path, "PYCURVE", text)
    assert (found.law, dict(found.parameters)) == ("sand", SAND)
    assert dict(found.options) == {"cyclic": True}


@pytest.mark.parametrize(
    ("text", "law", "parameters", "options"),
    [
        (
            "3 90e3 9e3 0.007 135e6",
            "stiff_clay_free_water",
            {
                "undrained_shear_strength": 90e3,
                "effective_unit_weight": 9e3,
                "strain_50": 0.007,
                "subgrade_modulus": 135e6,
            },
            {"cyclic": False},
        ),
        (
            "4 90e3 18e3 0.007 CYCLES=1000",
            "stiff_clay",
            {
                "undrained_shear_strength": 90e3,
                "effective_unit_weight": 18e3,
                "strain_50": 0.007,
                "j": 0.5,
                "cycles": 1000.0,
            },
            {"cyclic": False},
        ),
        (
            "5 3e6 1.2e9 60 5e-4",
            "weak_rock",
            {
                "compressive_strength": 3e6,
                "rock_mass_modulus": 1.2e9,
                "rock_quality_designation": 0.6,
                "strain_rm": 5e-4,
            },
            {},
        ),
        (
            "6 20e3 8e3 4 IP=LOW ALPHA=0.6 TE=0.9",
            "iso_clay",
            {
                "undrained_shear_strength": 20e3,
                "effective_unit_weight": 8e3,
                "overconsolidation_ratio": 4.0,
                "adhesion": 0.6,
                "strength_ratio": 0.9,
            },
            {"plasticity": "LOW", "no_gap": False},
        ),
        (
            "7 80e3 40e6 SITE=BOTHKENNAR",
            "pisa_clay",
            {"undrained_shear_strength": 80e3, "initial_shear_modulus": 40e6},
            {"site": "BOTHKENNAR"},
        ),
        (
            "8 10e3 75 60e6",
            "pisa_sand",
            {
                "effective_unit_weight": 10e3,
                "relative_density": 0.75,
                "initial_shear_modulus": 60e6,
            },
            {},
        ),
        (
            "9 10e3 35 0",
            "reese_sand",
            {"effective_unit_weight": 10e3, "friction_angle": radians(35.0)},
            {"cyclic": False},
        ),
    ],
)
def test_further_types(
    tmp_path: Path,
    text: str,
    law: str,
    parameters: dict[str, float],
    options: dict[str, str | bool],
) -> None:
    found = curve(tmp_path, "PYCURVE", f"\n9\n{text}")
    assert (found.law, dict(found.options)) == (law, options)
    assert dict(found.parameters) == pytest.approx(parameters | {"multiplier": 1.0}, rel=1e-15)


def test_a_group_is_a_factor_on_the_curve(tmp_path: Path) -> None:
    found = curve(tmp_path, "PYCURVE", "\n9\n2 1e4 35 0 SPACING=4 ROW=2 PMULT=0.5")
    assert found.parameters["multiplier"] == pytest.approx(0.5 * 0.625, rel=1e-15)
    found = curve(tmp_path, "PYCURVE", ", SPACING=3, ROW=MEAN3\n9 0 0\n1 1")
    assert found.parameters["multiplier"] == pytest.approx((0.8 + 0.4 + 0.3) / 3.0, rel=1e-15)


def test_user_curve(tmp_path: Path) -> None:
    found = curve(tmp_path, "PYCURVE", "\n9 0 1 GAMMA=8e3\n60e3 0.01\n90e3 0.03")
    assert (found.law, dict(found.options)) == ("user", {})
    assert dict(found.parameters) == {"multiplier": 1.0, "effective_unit_weight": 8e3}
    assert found.rows == ((60e3, 0.01), (90e3, 0.03))
    assert found.rows_in_diameters


def test_user_curve_with_dynamic_columns(tmp_path: Path) -> None:
    found = curve(tmp_path, "PYCURVE", "\n9 1 0\n0 0 0 0\n6 1 5 1\n6 2 5 1")
    assert found.rows == ((0, 0, 0, 0), (6, 1, 5, 1), (6, 2, 5, 1))
    assert not found.rows_in_diameters


def test_user_curve_may_be_one_sided(tmp_path: Path) -> None:
    assert curve(tmp_path, "PYCURVE", "\n9 0 0\n-2 -1\n0 0\n3 1").rows[0] == (-2.0, -1.0)


@pytest.mark.parametrize("text", ["\n9 0\n0 50e3 0 2e7", "\n9 0 50e3 0 2e7", " 9 0 50e3 F3=2e7"])
def test_direct(tmp_path: Path, text: str) -> None:
    found = curve(tmp_path, "TZCURVE", text)
    given = {"unit_friction": 50e3, "tip_pressure": 0.0, "initial_stiffness": 2e7}
    assert (found.law, dict(found.parameters)) == ("direct", given)
    assert dict(found.options) == {"shape": "EP", "plug": "AUTO"}


def test_cohesive(tmp_path: Path) -> None:
    found = curve(tmp_path, "TZCURVE", ", SHAPE=API, RESIDUAL=0.8\n9 0\n1 20e3 8e3 0")
    given = {"undrained_shear_strength": 20e3, "effective_unit_weight": 8e3, "residual": 0.8}
    assert (found.law, dict(found.parameters)) == ("cohesive", given)
    assert dict(found.options) == {"shape": "API", "method": "ALPHA", "plug": "AUTO"}


def test_friction_may_be_given_and_the_plug_chosen(tmp_path: Path) -> None:
    found = curve(tmp_path, "TZCURVE", ", METHOD=direct\n9 0 PLUG=UNPLUGGED\n1 20e3 8e3")
    assert dict(found.options) == {"shape": "EP", "method": "DIRECT", "plug": "UNPLUGGED"}
    found = curve(tmp_path, "TZCURVE", "\n9 0\n2 0.4 1e4 0 20 METHOD=DIRECT")
    assert found.options["method"] == "DIRECT"


@pytest.mark.parametrize(
    ("limits", "kept"),
    [
        ("", {}),
        ("0 -1", {}),
        ("96e3", {"friction_limit": 96e3}),
        ("96e3 1e7", {"friction_limit": 96e3, "end_bearing_limit": 1e7}),
        ("F6=1e7", {"end_bearing_limit": 1e7}),
    ],
)
def test_cohesionless(tmp_path: Path, limits: str, kept: dict[str, float]) -> None:
    found = curve(tmp_path, "TZCURVE", f"\n9 1\n2 0.8 1e4 30 40 {limits}")
    given = {
        "earth_pressure_coefficient": 0.8,
        "effective_unit_weight": 1e4,
        "interface_friction_angle": radians(30.0),
        "bearing_factor": 40.0,
    }
    assert (found.law, dict(found.parameters)) == ("cohesionless", given | kept)


@pytest.mark.parametrize("text", ["\n9 1 GAMMA=9e3\n0 50e3", "\n9 0 50e3 GAMMA=9e3 IOD=1"])
def test_axial_rows(tmp_path: Path, text: str) -> None:
    found = curve(tmp_path, "TZCURVE", text + "\n25e3 0.002 0 0\n50e3 0.01 1e5 0.1")
    assert found.rows == ((25e3, 0.002, 0, 0), (50e3, 0.01, 1e5, 0.1))
    assert found.rows_in_diameters
    assert found.parameters["effective_unit_weight"] == 9e3


@pytest.mark.parametrize(
    ("keyword", "text", "message"),
    [
        ("PYCURVE", "\n9 0 0\n1 0.2\n2 0.1", "Y is 0.1 after 0.2, but must rise"),
        ("PYCURVE", "\n9 0 0\n1 0.2\n2 0.2", "Y is 0.2 after 0.2, but must rise"),
        ("PYCURVE", "\n9 0 0\n-1 0.2", "P is -1 at Y = 0.2"),
        ("PYCURVE", "\n9 0 0\n5 0", "P is 5 at Y = 0"),
        ("PYCURVE", "\n9 0 0", "a user curve has no rows"),
        ("PYCURVE", "\n9 1 0\n1 1", "*PYCURVE lacks Pd, Yd"),
        ("PYCURVE", "\n9 0\n1 1", "the first line of *PYCURVE has 2 values"),
        ("PYCURVE", "\n9\n1 20e3 8e3 0.5 0.01\n1 2", "*PYCURVE takes no more lines here"),
        ("PYCURVE", ", SHAPE=WSD\n9\n2 1e4 35 22e6", "SHAPE has no effect here (ITYP 2"),
        ("PYCURVE", ", CYCLIC\n9 0 0\n1 1", "CYCLIC has no effect here (user curve"),
        ("PYCURVE", "\n9\n10 20e3 8e3 0.5 0.01", "ITYP is 10; types are 1: soft clay"),
        ("PYCURVE", "\n9\n6 20e3 8e3 4 IP=LOW NOGAP", "write it after a comma: *PYCURVE, NOGAP"),
        ("PYCURVE", "\n9\n2 1e4 35 22e6 cyclic", "CYCLIC is an option, but stands among"),
        ("PYCURVE", "\n9\n1 20e3 8e3 0.5 0.01 ROW=1", "ROW has no effect without SPACING"),
        ("PYCURVE", "\n9\n2 1e4 35 SPACING=4", "SPACING has no effect without ROW"),
        ("PYCURVE", "\n9\n2 1e4 35 SPACING=2 ROW=1", "SPACING is 2, but must be at least 3"),
        ("TZCURVE", "\n9 0\n1 20e3 8e3 METHOD=BETA", "METHOD 'BETA' is unknown"),
        ("TZCURVE", ", METHOD=DIRECT\n9 0\n0 1\n1 1 0 0", "METHOD has no effect on a curve with"),
        ("PYCURVE", "\n9\n0 20e3 8e3", "ITYP is 0; types are 1: soft clay"),
        ("PYCURVE", "\n9\n1 20e3 8e3 J=0.5 0.01", "'0.01' follows a value by name"),
        ("PYCURVE", "\n9\n1 20e3 8e3 0.5 0.01 J=0.4", "J is given twice"),
        ("TZCURVE", "\n9 0", "*TZCURVE lacks the line of ITYP"),
        ("TZCURVE", "\n9 2\n0 1", "IOD is 2, but must be one of 0, 1"),
        ("TZCURVE", ", PLUG=HALF\n9 0\n0 1", "PLUG 'HALF' is unknown"),
        ("TZCURVE", ", RESIDUAL=0.5\n9 0\n0 1", "RESIDUAL is 0.5, but must be 0.7 to 1"),
        ("TZCURVE", ", RESIDUAL=0.8\n9 0\n0 1", "RESIDUAL has no effect with SHAPE=EP in ITYP 0"),
        (
            "TZCURVE",
            ", SHAPE=API, RESIDUAL=0.8\n9 0\n2 0.8 1e4 30 40",
            "RESIDUAL has no effect with SHAPE=API in ITYP 2",
        ),
        ("TZCURVE", ", SHAPE=WSD\n9 0\n0 1", "SHAPE 'WSD' is unknown; known are EP, API, 2GEO"),
        ("TZCURVE", ", SHAPE=API\n9 0\n0 1\n1 1 0 0", "SHAPE has no effect on a curve with rows"),
        ("TZCURVE", "\n9 0\n0 1\n1 0.1 2 0.1\n1 0.2 3 0.1", "yq is 0.1 after 0.1, but must rise"),
        ("TZCURVE", "\n9 0\n0 1\n1 0.1 2 -0.1", "yq is -0.1, but must be at least 0"),
    ],
)
def test_faults(tmp_path: Path, keyword: str, text: str, message: str) -> None:
    assert message in fault(tmp_path, keyword, text)
