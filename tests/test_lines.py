"""Lines as plain data: what no scene can hold."""

import pytest

from podeep.errors import InvalidData
from podeep.lines import (
    Line,
    LineEnd,
    LineMotion,
    LineSection,
    SeabedContact,
    Suction,
    Wave,
    towards,
)

HERE, THERE = (0.0, 0.0, -100.0), (30.0, -40.0, 0.0)
STEEL = {"youngs_modulus": 2e11, "density": 7850.0}
SECTION = LineSection(100.0, 0.3, 0.02, **STEEL)
ENDS = (LineEnd(1, HERE), LineEnd(2, THERE))

# what makes impossible data, the column to blame, the message
IMPOSSIBLE = [
    (lambda: LineSection(100.0, 0.3, 0.16, **STEEL), "WT", "a wall of 0.16 m does not fit"),
    (lambda: LineSection(100.0, 0.3, 0.0, **STEEL), "WT", "a wall of 0 m does not fit"),
    (lambda: LineSection(0.0, 0.3, 0.02, **STEEL), "LENGTH", "a section is 0 m long"),
    (lambda: LineSection(1.0, 0.3, 0.02, 2e11, 7850.0, 0), "NEL", "0 elements in a section"),
    (lambda: LineEnd(1, HERE, direction=(0.0, 0.0, 0.0)), "DX", "a direction of length 0"),
    (lambda: towards(HERE, (0.0, 0.0, 9.0)), "DOF", "the ends stand above each other"),
    (lambda: Line(1, "", (), ENDS), "IGR", "line 1 has no section"),
    (lambda: Line(1, "", (SECTION,), ENDS[::-1]), "END", "line 1 lacks an end"),
    (lambda: SeabedContact(1, 0.0), "KN", "the seabed under line 1 has no stiffness"),
    (lambda: SeabedContact(1, 0.0, 1e4, 2), "KN", "the seabed under line 1 has both a stiffness"),
    (lambda: SeabedContact(1, 0.0, 0.0), "KN", "a seabed of 0 N/m2"),
    (lambda: SeabedContact(1, 0.0, 1e4, axial_threshold=0.0), "XSEUIL2", "a threshold of 0 m"),
    (lambda: SeabedContact(1, 0.0, 1e4, lateral_threshold=-1.0), "XSEUIL3", "a threshold of -1 m"),
    (lambda: SeabedContact(1, 0.0, 1e4, tolerance=0.0), "DISCON", "a tolerance of 0 m"),
    (lambda: SeabedContact(1, 0.0, 1e4, axial_friction=-1.0), "MU2", "a friction coefficient of"),
    (lambda: SeabedContact(1, 0.0, 1e4, lateral_friction=-1.0), "MU3", "a friction coefficient of"),
    (lambda: Suction(1), "ALPHAF", "suction 1 has no ALPHAF and no CU"),
    (lambda: Suction(1, 9.0, undrained_shear_strength=5e3), "CU", "suction 1 has both"),
    (lambda: Suction(1, 9.0, remaining=0.5), "REMAIN", "suction 1 has one of the two"),
    (lambda: Suction(1, 9.0, travel_95=3.0), "TRAVEL", "suction 1 has one of the two"),
    (lambda: Wave(1.0, 0.0), "PERIOD", "a period of 0 s"),
    (lambda: LineMotion(1, 2, "X", times=(0.0, 1.0), values=(0.0,)), "T", "2 times and 1 values"),
    (lambda: LineMotion(1, 2, "X", times=(0.0, 0.0), values=(0.0, 1.0)), "file", "time 0 s does"),
]


def _told(value: object) -> str:
    """A name that is the same in every process."""
    return value if isinstance(value, str) else ""


@pytest.mark.parametrize(("make", "field", "message"), IMPOSSIBLE, ids=_told)
def test_impossible_data(make, field: str, message: str) -> None:
    with pytest.raises(InvalidData) as caught:
        make()
    assert caught.value.field == field
    assert caught.value.message.startswith(message)
    assert caught.value.remedy


@pytest.mark.parametrize("name", ["axial_threshold", "tolerance", "axial_friction"])
def test_what_is_no_number_is_impossible(name: str) -> None:
    with pytest.raises(InvalidData):
        SeabedContact(1, 0.0, 1e4, **{name: float("nan")})


def test_towards() -> None:
    assert towards(HERE, THERE) == pytest.approx((0.6, -0.8, 0.0), rel=1e-15)


def test_a_bar_without_water_weighs_what_it_is() -> None:
    bar = LineSection(1.0, 0.2, 0.1, 2e11, 8000.0)
    assert bar.inner_diameter == 0.0
    assert bar.submerged_weight(0.0, 10.0) == pytest.approx(10.0 * bar.mass, rel=1e-15)
    assert bar.submerged_weight(8000.0, 10.0) == pytest.approx(0.0, abs=1e-12 * bar.mass)
