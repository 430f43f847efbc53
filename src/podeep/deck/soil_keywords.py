"""The keywords of the soil: depths, curves, and where they act."""

from .column import IDS, IDS_OR_NONE, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

_LENGTH = "m or diameters"
_RISING = "rising from row to row"

_NCUR = Column("NCUR", "id of the curve", bounds=IDS, kind="integer")
_WEIGHT = Column("GAMMA", "effective unit weight", "N/m3", NOT_NEGATIVE, "effective_unit_weight")
_OWN_WEIGHT = Column(
    "GAMMA",
    "effective unit weight, for the overburden of deeper layers",
    "N/m3",
    NOT_NEGATIVE,
    "effective_unit_weight",
    named=True,
    otherwise="unknown",
)
_PMULT = Column(
    "PMULT",
    "factor on the reaction, for groups",
    "-",
    POSITIVE,
    "multiplier",
    named=True,
    default=1.0,
)
_CYCLIC = Column("CYCLIC", "cyclic instead of static curve", key="cyclic", kind="flag", named=True)
_IOD = Column(
    "IOD", "unit of the rows' displacements: 0 m, 1 diameters", kind="integer", choices=("0", "1")
)


def _type(number: int) -> Column:
    return Column("ITYP", "type of the curve", kind="integer", choices=(str(number),))


def _shape(choices: tuple[str, ...], meaning: str) -> Column:
    return Column(
        "SHAPE", meaning, key="shape", kind="word", choices=choices, named=True, default=choices[0]
    )


GROUNDEPTH = Keyword(
    "GROUNDEPTH",
    "the soil depths at which curves are given",
    (
        Row(
            "depths, on one line or more",
            (
                Column(
                    "LOADS", "loads vary between depths, not parameters", kind="flag", named=True
                ),
            ),
            (
                Column(
                    "Z",
                    "soil depth: 0, then negative, never rising; given twice, a jump of layers",
                    "m from the mudline",
                    Bounds(high=0.0),
                ),
            ),
        ),
    ),
    "*GROUNDEPTH\n0 -9 -9 -24",
    "Between two depths whose curves are of one predefined type, parameters vary linearly and the "
    "law is evaluated at the true depth; otherwise, and with *GROUNDEPTH, LOADS, loads vary "
    "linearly.",
    aliases=("GROUNDDEPTH",),
    once=True,
    required=True,
    optioned=True,
    planned=("LAYERING",),
)

PYCURVE = Keyword(
    "PYCURVE",
    "a lateral reaction curve (p-y)",
    (
        Row(
            "ITYP 1: soft clay (API, Matlock)",
            (
                _NCUR,
                _type(1),
                Column(
                    "CU", "undrained shear strength", "Pa", NOT_NEGATIVE, "undrained_shear_strength"
                ),
                _WEIGHT,
                Column("J", "empirical factor of Matlock", "-", Bounds(0.25, 0.5), "j"),
                Column(
                    "EPSC",
                    "strain at half the failure stress",
                    "-",
                    Bounds(0.0, 0.2, open=True),
                    "strain_50",
                ),
                _shape(("2GEO", "WSD", "POWER"), "points of API RP 2GEO or 2A-WSD, or cube root"),
                _CYCLIC,
                _PMULT,
            ),
            law="soft_clay",
        ),
        Row(
            "ITYP 2: sand (API)",
            (
                _NCUR,
                _type(2),
                _WEIGHT,
                Column("PHI", "friction angle", "deg", Bounds(10.0, 50.0), "friction_angle"),
                Column("K", "initial subgrade modulus", "N/m3", POSITIVE, "subgrade_modulus"),
                _CYCLIC,
                _PMULT,
            ),
            law="sand",
        ),
        Row(
            "user curve, first line",
            (
                _NCUR,
                Column(
                    "IANA",
                    "layout of the rows: 0 P Y, 1 Ps Ys Pd Yd",
                    kind="integer",
                    choices=("0", "1"),
                ),
                _IOD,
                _OWN_WEIGHT,
                _PMULT,
            ),
            law="user",
        ),
        Row(
            "user curve, rows with IANA 0",
            (
                Column("P", "reaction; times the diameter it is N/m", "Pa"),
                Column("Y", f"displacement, {_RISING}", _LENGTH),
            ),
        ),
        Row(
            "user curve, rows with IANA 1",
            (
                Column("Ps", "static reaction", "Pa"),
                Column("Ys", f"static displacement, {_RISING}", _LENGTH),
                Column("Pd", "dynamic reaction", "Pa"),
                Column("Yd", f"dynamic displacement, {_RISING}", _LENGTH),
            ),
        ),
    ),
    "*PYCURVE, CYCLIC, SHAPE=WSD\n"
    "1                          ! NCUR\n"
    "1 20e3 8e3 0.5 0.01        ! ITYP CU GAMMA J EPSC\n"
    "*PYCURVE\n"
    "2 2 10e3 35 22e6           ! NCUR ITYP GAMMA PHI K on one line\n"
    "*PYCURVE\n"
    "3 0 1 GAMMA=8e3            ! NCUR IANA IOD of a user curve, then its rows P Y\n"
    "60e3 0.01\n"
    "90e3 0.03",
    "The first line is NCUR alone, and ITYP with its values stands on the next one; or all stand "
    "on one line; or it is NCUR IANA IOD of a user curve, and rows follow. Rows start at an "
    "implied 0 0, are joined by straight lines, hold for both signs unless a Y is negative, and "
    "keep the last P beyond the last row.",
    optioned=True,
    planned=tuple(f"ITYP {number}" for number in range(3, 10)),
)


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
    _shape(("EP", "API", "2GEO"), "elastic-plastic, or points of API RP 2A-WSD or 2GEO"),
    Column(
        "RESIDUAL",
        "share of the peak left at large displacement",
        "-",
        Bounds(0.7, 1.0),
        "residual",
        named=True,
        otherwise="that of the law",
    ),
    Column("IOD", _IOD.meaning, kind="integer", choices=("0", "1"), named=True, default=0),
)

TZCURVE = Keyword(
    "TZCURVE",
    "an axial reaction curve (t-z), with that of a tip (Q-z)",
    (
        Row(
            "ITYP 0: direct",
            (
                _NCUR,
                _type(0),
                Column("F1", "unit friction", "Pa", NOT_NEGATIVE, "unit_friction"),
                Column("F2", "tip pressure", "Pa", NOT_NEGATIVE, "tip_pressure", default=0.0),
                _slope("F3"),
                _OWN_WEIGHT,
                *_AXIAL,
            ),
            law="direct",
        ),
        Row(
            "ITYP 1: cohesive",
            (
                _NCUR,
                _type(1),
                Column(
                    "F1", "undrained shear strength", "Pa", NOT_NEGATIVE, "undrained_shear_strength"
                ),
                Column(
                    "F2", "effective unit weight", "N/m3", NOT_NEGATIVE, "effective_unit_weight"
                ),
                _slope("F3"),
                *_AXIAL,
            ),
            law="cohesive",
        ),
        Row(
            "ITYP 2: cohesionless",
            (
                _NCUR,
                _type(2),
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
                *_AXIAL,
            ),
            law="cohesionless",
        ),
        Row(
            "rows after ITYP, in place of its values",
            (
                Column("Tz", "friction of the shaft", "Pa"),
                Column("yt", f"displacement of the shaft, {_RISING}", _LENGTH),
                Column("Qz", "pressure under the tip", "Pa", NOT_NEGATIVE),
                Column("yq", f"displacement of the tip, {_RISING}", _LENGTH, NOT_NEGATIVE),
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
    planned=("METHOD", "PLUG"),
)

GROUNDPROP = Keyword(
    "GROUNDPROP",
    "the curves at each depth of *GROUNDEPTH",
    (
        Row(
            "a pair for each depth, then [IKTSO [IDRE]], on one line or more",
            (
                Column(
                    "IKTSO",
                    "slope of friction against displacement (SHAPE=EP)",
                    "Pa/m",
                    POSITIVE,
                    named=True,
                    default=1e8,
                ),
                Column(
                    "IDRE",
                    "soil force in dynamics: 0 static and dynamic, 1 dynamic alone, "
                    "2 total on the static curve, 3 total on the dynamic curve",
                    kind="integer",
                    choices=("0", "1", "2", "3"),
                    named=True,
                    default=0,
                ),
            ),
            (
                Column("IY", "p-y curve, 0 for none", bounds=IDS_OR_NONE, kind="integer"),
                Column("IZ", "t-z curve, 0 for none", bounds=IDS_OR_NONE, kind="integer"),
            ),
        ),
    ),
    "*GROUNDPROP\n1 1  3 1  2 2  2 2  1e8 0",
    "N depths take 2N values, 2N+1 with IKTSO or 2N+2 with IKTSO and IDRE, which may also go by "
    "name. Under the last depth its curves go on.",
    once=True,
    required=True,
    optioned=True,
)

SOIL_KEYWORDS = (GROUNDEPTH, PYCURVE, TZCURVE, GROUNDPROP)
