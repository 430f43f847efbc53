"""The keyword of axial reaction curves."""

from .column import NOT_NEGATIVE, Bounds, Column, Keyword, Row
from .curve_columns import IOD, LENGTH, NCUR, OWN_WEIGHT, RISING, curve_type, shape


def _slope(name: str) -> Column:
    meaning = "initial slope of friction against displacement (SHAPE=EP)"
    return Column(
        name,
        meaning,
        "Pa/m",
        NOT_NEGATIVE,
        "initial_stiffness",
        otherwise="IKTSO",
        none_at_zero=True,
    )


def _limit(name: str, meaning: str, key: str) -> Column:
    return Column(name, meaning, "Pa", key=key, otherwise="no limit", none_at_zero=True)


_AXIAL = (
    shape(("EP", "API", "2GEO"), "elastic-plastic, or points of API RP 2A-WSD or 2GEO"),
    Column(
        "RESIDUAL",
        "share of the peak left at large displacement",
        "-",
        Bounds(0.7, 1.0),
        "residual",
        named=True,
        otherwise="that of the law",
    ),
    Column(
        "PLUG",
        "whether the soil inside moves with the tube, for its capacity: AUTO is the weaker way",
        key="plug",
        kind="word",
        choices=("AUTO", "PLUGGED", "UNPLUGGED"),
        named=True,
        default="AUTO",
    ),
    Column("IOD", IOD.meaning, kind="integer", choices=("0", "1"), named=True, default=0),
)


def _method(*choices: str) -> Column:
    return Column(
        "METHOD",
        f"how unit friction is found: {choices[0]} from the values, or F1 itself",
        key="method",
        kind="word",
        choices=choices,
        named=True,
        default=choices[0],
    )


TZCURVE = Keyword(
    "TZCURVE",
    "an axial reaction curve (t-z), with that of a tip (Q-z)",
    (
        Row(
            "ITYP 0: direct",
            (
                NCUR,
                curve_type(0),
                Column("F1", "unit friction", "Pa", NOT_NEGATIVE, "unit_friction"),
                Column("F2", "tip pressure", "Pa", NOT_NEGATIVE, "tip_pressure", default=0.0),
                _slope("F3"),
                Column(
                    "METHOD",
                    "how unit friction is found: F1 itself",
                    kind="word",
                    choices=("DIRECT",),
                    named=True,
                    default="DIRECT",
                ),
                OWN_WEIGHT,
                *_AXIAL,
            ),
            law="direct",
        ),
        Row(
            "ITYP 1: cohesive",
            (
                NCUR,
                curve_type(1),
                Column(
                    "F1", "undrained shear strength", "Pa", NOT_NEGATIVE, "undrained_shear_strength"
                ),
                Column(
                    "F2", "effective unit weight", "N/m3", NOT_NEGATIVE, "effective_unit_weight"
                ),
                _slope("F3"),
                _method("ALPHA", "DIRECT"),
                *_AXIAL,
            ),
            law="cohesive",
        ),
        Row(
            "ITYP 2: cohesionless",
            (
                NCUR,
                curve_type(2),
                Column(
                    "F1",
                    "coefficient of lateral earth pressure",
                    "-",
                    NOT_NEGATIVE,
                    "earth_pressure_coefficient",
                ),
                Column(
                    "F2", "effective unit weight", "N/m3", NOT_NEGATIVE, "effective_unit_weight"
                ),
                Column(
                    "F3",
                    "friction angle of soil on pile",
                    "deg",
                    Bounds(0.0, 50.0),
                    "interface_friction_angle",
                ),
                Column("F4", "bearing factor Nq", "-", NOT_NEGATIVE, "bearing_factor"),
                _limit("F5", "limit of unit friction, where above 0", "friction_limit"),
                _limit("F6", "limit of unit end bearing, where above 0", "end_bearing_limit"),
                _method("BETA", "DIRECT"),
                *_AXIAL,
            ),
            law="cohesionless",
        ),
        Row(
            "rows after ITYP and its values, in place of what these give",
            (
                Column("Tz", "friction of the shaft", "Pa"),
                Column("yt", f"displacement of the shaft, {RISING}", LENGTH),
                Column("Qz", "pressure under the tip", "Pa", NOT_NEGATIVE),
                Column("yq", f"displacement of the tip, {RISING}", LENGTH, NOT_NEGATIVE),
            ),
        ),
    ),
    "*TZCURVE, SHAPE=2GEO, RESIDUAL=0.8\n"
    "1 0                        ! NCUR IOD\n"
    "1 20e3 8e3                 ! ITYP F1 F2\n"
    "*TZCURVE\n"
    "2 2 0.8 10e3 30 40 96e3 10e6\n"
    "*TZCURVE\n"
    "3 1\n"
    "0 50e3\n"
    "25e3 0.002 0     0         ! Tz yt Qz yq\n"
    "50e3 0.01  100e3 0.1",
    "The first line is NCUR IOD, and ITYP F1 ... stand on the next one; or NCUR ITYP F1 ... stand "
    "on one line. Tz acts on the circumference of the outermost tube, Qz on the full area of the "
    "lowest tip, in compression alone. Rows start at an implied 0 0 0 0.",
    optioned=True,
)
