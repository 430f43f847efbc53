"""The keyword of lateral reaction curves."""

from .column import NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row
from .curve_columns import (
    CYCLIC,
    GROUP,
    IOD,
    LENGTH,
    NCUR,
    OWN_WEIGHT,
    RISING,
    STRENGTH,
    WEIGHT,
    curve_type,
    shape,
)

_STRAIN = Bounds(0.0, 0.2, open=True)
_J = Bounds(0.25, 0.5)
_ANGLE = Column("PHI", "friction angle", "deg", Bounds(10.0, 50.0), "friction_angle")
_MODULUS = Column(
    "K",
    "initial subgrade modulus, 0 for that of the standard",
    "N/m3",
    NOT_NEGATIVE,
    "subgrade_modulus",
    otherwise="that of the standard",
    none_at_zero=True,
)
_EPS50 = Column("EPS50", "strain at half the deviator stress", "-", _STRAIN, "strain_50")
_G0 = Column("G0", "shear modulus at small strain", "Pa", POSITIVE, "initial_shear_modulus")

_SOFT_CLAY = Row(
    "ITYP 1: soft clay (API, Matlock)",
    (
        NCUR,
        curve_type(1),
        STRENGTH,
        WEIGHT,
        Column("J", "empirical factor of Matlock", "-", _J, "j"),
        Column("EPSC", "strain at half the failure stress", "-", _STRAIN, "strain_50"),
        shape(("2GEO", "WSD", "POWER"), "points of API RP 2GEO or 2A-WSD, or cube root"),
        CYCLIC,
        *GROUP,
    ),
    law="soft_clay",
)

_SAND = Row(
    "ITYP 2: sand (API)",
    (NCUR, curve_type(2), WEIGHT, _ANGLE, _MODULUS, CYCLIC, *GROUP),
    law="sand",
)

_STIFF_FREE = Row(
    "ITYP 3: stiff clay with free water (Reese)",
    (NCUR, curve_type(3), STRENGTH, WEIGHT, _EPS50, _MODULUS, CYCLIC, *GROUP),
    law="stiff_clay_free_water",
)

_STIFF = Row(
    "ITYP 4: stiff clay without free water (Reese and Welch)",
    (
        NCUR,
        curve_type(4),
        STRENGTH,
        Column(
            "GAMMA",
            "unit weight: total above the water table, effective below",
            "N/m3",
            NOT_NEGATIVE,
            "effective_unit_weight",
        ),
        _EPS50,
        Column("J", "empirical factor of Matlock", "-", _J, "j", named=True, default=0.5),
        Column(
            "CYCLES",
            "number of cycles, with CYCLIC",
            "-",
            Bounds(1.0),
            "cycles",
            named=True,
            default=100.0,
        ),
        CYCLIC,
        *GROUP,
    ),
    law="stiff_clay",
)

_ROCK = Row(
    "ITYP 5: weak rock (Reese)",
    (
        NCUR,
        curve_type(5),
        Column("QU", "compressive strength", "Pa", NOT_NEGATIVE, "compressive_strength"),
        Column("EIR", "modulus of the rock mass", "Pa", POSITIVE, "rock_mass_modulus"),
        Column(
            "RQD",
            "rock quality designation",
            "%",
            Bounds(0.0, 100.0),
            "rock_quality_designation",
        ),
        Column("KRM", "strain factor, 5e-5 to 5e-4", "-", Bounds(1e-6, 1e-2), "strain_rm"),
        OWN_WEIGHT,
        *GROUP,
    ),
    law="weak_rock",
)

_ISO_CLAY = Row(
    "ITYP 6: clay of ISO 19901-4, third edition",
    (
        NCUR,
        curve_type(6),
        Column(
            "CU",
            "undrained shear strength in direct simple shear",
            "Pa",
            NOT_NEGATIVE,
            "undrained_shear_strength",
        ),
        WEIGHT,
        Column("OCR", "overconsolidation ratio", "-", Bounds(1.0), "overconsolidation_ratio"),
        Column(
            "IP",
            "plasticity index: HIGH above 30, LOW up to it",
            key="plasticity",
            kind="word",
            choices=("HIGH", "LOW"),
            named=True,
            default="HIGH",
        ),
        Column(
            "ALPHA",
            "adhesion over strength, mean of the top 20 diameters",
            "-",
            Bounds(0.0, 1.0),
            "adhesion",
            named=True,
            otherwise="API's, from CU and GAMMA",
        ),
        Column(
            "SU0",
            "strength at the mudline",
            "Pa",
            NOT_NEGATIVE,
            "mudline_strength",
            named=True,
            otherwise="from CU over depth",
        ),
        Column(
            "SU1",
            "rise of strength with depth",
            "Pa/m",
            NOT_NEGATIVE,
            "strength_gradient",
            named=True,
            otherwise="from CU over depth",
        ),
        Column(
            "TE",
            "strength in triaxial extension over that in simple shear",
            "-",
            Bounds(0.5, 1.0),
            "strength_ratio",
            named=True,
            default=1.0,
        ),
        Column("NOGAP", "no gap behind the pile", key="no_gap", kind="flag", named=True),
        *GROUP,
    ),
    law="iso_clay",
)

_PISA_CLAY = Row(
    "ITYP 7: clay of PISA, for monopiles",
    (
        NCUR,
        curve_type(7),
        STRENGTH,
        _G0,
        Column(
            "SITE",
            "calibration",
            key="site",
            kind="word",
            choices=("COWDEN", "BOTHKENNAR"),
            named=True,
            default="COWDEN",
        ),
        OWN_WEIGHT,
        *GROUP,
    ),
    law="pisa_clay",
)

_PISA_SAND = Row(
    "ITYP 8: sand of PISA, for monopiles",
    (
        NCUR,
        curve_type(8),
        WEIGHT,
        Column("DR", "relative density", "%", Bounds(0.0, 100.0), "relative_density"),
        _G0,
        *GROUP,
    ),
    law="pisa_sand",
)

_REESE_SAND = Row(
    "ITYP 9: sand (Reese, Cox and Koop)",
    (NCUR, curve_type(9), WEIGHT, _ANGLE, _MODULUS, CYCLIC, *GROUP),
    law="reese_sand",
)

PYCURVE = Keyword(
    "PYCURVE",
    "a lateral reaction curve (p-y)",
    (
        *(_SOFT_CLAY, _SAND, _STIFF_FREE, _STIFF, _ROCK, _ISO_CLAY),
        *(_PISA_CLAY, _PISA_SAND, _REESE_SAND),
        Row(
            "user curve, first line",
            (
                NCUR,
                Column(
                    "IANA",
                    "layout of the rows: 0 P Y, 1 Ps Ys Pd Yd",
                    kind="integer",
                    choices=("0", "1"),
                ),
                IOD,
                OWN_WEIGHT,
                *GROUP,
            ),
            law="user",
        ),
        Row(
            "user curve, rows with IANA 0",
            (
                Column("P", "reaction; times the diameter it is N/m", "Pa"),
                Column("Y", f"displacement, {RISING}", LENGTH),
            ),
        ),
        Row(
            "user curve, rows with IANA 1",
            (
                Column("Ps", "static reaction", "Pa"),
                Column("Ys", f"static displacement, {RISING}", LENGTH),
                Column("Pd", "dynamic reaction", "Pa"),
                Column("Yd", f"dynamic displacement, {RISING}", LENGTH),
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
)
