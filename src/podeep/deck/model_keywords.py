"""The keywords of tubes, of what holds and drives them, and of the analysis."""

from .column import IDS, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

_NAME = Column("NAME", "name of the load, by which steps call it", kind="word")
_IGR = Column("IGR", "tube", bounds=IDS, key="tube", kind="integer")
_Z = Column("Z", "elevation on the tube, from sea level", "m", key="elevation")
_DOFS = ("X", "Y", "Z", "RX", "RY", "RZ")
_DOF = Column("DOF", "degree of freedom", key="dof", kind="word", choices=_DOFS)
_RATIO = Bounds(0.0, 1.0, open=True)


def _only(name: str, purpose: str, title: str, *columns: Column, required: bool = False) -> Keyword:
    """A keyword of one row that stands once."""
    values = {"DEPTH": "-60", "NEWTONSTAT": "200 0.01 0.01 0.01 0.01", "ACCURACY": "1e-4"}
    example = f"*{name}\n{values[name]}"
    return Keyword(name, purpose, (Row(title, columns),), example, once=True, required=required)


def _override(name: str, meaning: str, unit: str, key: str) -> Column:
    return Column(
        name,
        meaning,
        unit,
        POSITIVE,
        key,
        named=True,
        otherwise="from OD, WT, E" if name != "MASS" else "from OD, WT, RHO",
    )


def _component(name: str, meaning: str, unit: str) -> Column:
    moment = 0.0 if name.startswith("M") else None
    return Column(name, meaning, unit, default=moment)


def _limit(number: int, meaning: str, key: str) -> Column:
    return Column(
        f"PMAXI{number}", f"largest {meaning}, as a ratio", "-", _RATIO, key, default=0.01
    )


TITLE = Keyword(
    "TITLE",
    "the title of the analysis",
    (),
    "*TITLE\nJacket pile, storm",
    "The line after *TITLE is taken as it is; or the text stands on the keyword's line.",
    once=True,
)

DEPTH = _only(
    "DEPTH",
    "the elevation of the mudline",
    "the mudline",
    Column("Z", "elevation of the mudline, from sea level", "m", Bounds(high=0.0)),
    required=True,
)

CASING = Keyword(
    "CASING",
    "a tube, section by section",
    (
        Row(
            "first line",
            (
                Column("IGR", "id of the tube", bounds=IDS, kind="integer"),
                Column("NAME", "name of the tube", kind="word", otherwise="none"),
            ),
        ),
        Row(
            "sections from top to bottom",
            (
                Column("ZTOP", "elevation of the top, from sea level", "m", key="top"),
                Column("ZBOT", "elevation of the bottom", "m", key="bottom"),
                Column(
                    "OD", "outer diameter, the width in the soil", "m", POSITIVE, "outer_diameter"
                ),
                Column(
                    "WT", "wall thickness, OD/2 for a solid bar", "m", POSITIVE, "wall_thickness"
                ),
                Column("E", "Young's modulus", "Pa", POSITIVE, "youngs_modulus"),
                Column("RHO", "density", "kg/m3", NOT_NEGATIVE, "density"),
                Column(
                    "NU", "Poisson's ratio", "-", Bounds(0.0, 0.5), "poisson_ratio", default=0.3
                ),
                _override("EI", "bending stiffness", "N m2", "bending_stiffness_override"),
                _override("EA", "axial stiffness", "N", "axial_stiffness_override"),
                _override("GAS", "shear stiffness", "N", "shear_stiffness_override"),
                _override("MASS", "mass per length", "kg/m", "mass_override"),
                Column(
                    "CA",
                    "added-mass coefficient",
                    "-",
                    NOT_NEGATIVE,
                    "added_mass_coefficient",
                    named=True,
                    default=0.0,
                ),
                Column(
                    "FILL",
                    "density of what stands inside",
                    "kg/m3",
                    NOT_NEGATIVE,
                    "fill_density",
                    named=True,
                    default=0.0,
                ),
            ),
        ),
    ),
    "*CASING\n1 PILE\n-58 -75  2.134 0.070 210e9 7850\n-75 -110 2.134 0.045 210e9 7850 EI=50e9",
    "A tube may stand above the mudline. RHO, NU, GAS, MASS, CA, FILL are kept for weight, shear "
    "and dynamics; the statics of this version use none of them.",
    required=True,
)

FONDATION = Keyword(
    "FONDATION",
    "tubes that stand in the soil",
    (
        Row(
            "foundations",
            (
                Column("ID", "id of the foundation", bounds=IDS, kind="integer"),
                Column(
                    "Z",
                    "elevation of its mudline; a negative last value is it, too",
                    "m",
                    Bounds(high=0.0),
                    named=True,
                    otherwise="that of *DEPTH",
                ),
            ),
            (Column("IGR", "tube, the outermost first", bounds=IDS, kind="integer"),),
        ),
    ),
    "*FONDATION\n1 1 -60",
    "This version reads foundations of one tube.",
    aliases=("FOUNDATION",),
    required=True,
)

SUPPORT = Keyword(
    "SUPPORT",
    "degrees of freedom held at an elevation of a tube",
    (Row("supports", (_IGR, _Z), (_DOF,)),),
    "*SUPPORT\n1 -110 Z",
)

SPRING = Keyword(
    "SPRING",
    "a linear spring to ground",
    (
        Row(
            "springs",
            (_IGR, _Z, _DOF, Column("K", "stiffness", "N/m or N m/rad", POSITIVE, "stiffness")),
        ),
    ),
    "*SPRING\n1 -58 RY 20e6",
)

LOAD = Keyword(
    "LOAD",
    "a named point load, in global axes, z up",
    (
        Row(
            "loads",
            (
                _NAME,
                _IGR,
                _Z,
                *(_component(f"F{a}", f"force along {a.lower()}", "N") for a in "XYZ"),
                *(_component(f"M{a}", f"moment about {a.lower()}", "N m") for a in "XYZ"),
            ),
        ),
    ),
    "*LOAD\nSTORM 1 -58 2.2e6 0 0 0 -4.5e6 0\nWEIGHT 1 -58 0 0 -12e6",
    "Loads and displacements of one name share its factor.",
)

DISPLACE = Keyword(
    "DISPLACE",
    "a named imposed displacement or rotation",
    (
        Row(
            "displacements",
            (
                _NAME,
                _IGR,
                _Z,
                _DOF,
                Column("VALUE", "displacement or rotation", "m or degrees", key="value"),
            ),
        ),
    ),
    "*DISPLACE\nPUSH 1 -58 Y 0.1",
    "Loads and displacements of one name share its factor. Rows that move the same degree of "
    "freedom add up.",
)

QUASISTATIC = Keyword(
    "QUASISTATIC",
    "the steps of loading",
    (
        Row(
            "one value alone: all loads in equal steps",
            (Column("NSTEPS", "number of steps", bounds=Bounds(1, 100000), kind="integer"),),
        ),
        Row(
            "or a line for each step",
            (Column("STEP", "number of the step, from 1 on", bounds=IDS, kind="integer"),),
            (
                Column("NAME", "name of a load or displacement", kind="word"),
                Column("FACTOR", "factor that it reaches in this step", "-"),
            ),
        ),
    ),
    "*QUASISTATIC\n1 WEIGHT 1\n2 STORM 0.5 PUSH 1\n3 STORM 1",
    "A name that a step leaves out keeps its last factor, 0 at first. Without *QUASISTATIC there "
    "is one step with all loads at factor 1.",
    once=True,
)

NEWTONSTAT = _only(
    "NEWTONSTAT",
    "limits of the iteration in statics",
    "limits",
    Column(
        "ITERAM", "largest number of iterations", "-", Bounds(1, 100000), "iterations", "integer"
    ),
    _limit(1, "out-of-balance force", "force"),
    _limit(2, "out-of-balance moment", "moment"),
    _limit(3, "increment of translation", "translation"),
    _limit(4, "increment of rotation", "rotation"),
)

ACCURACY = _only(
    "ACCURACY",
    "the relative accuracy of the results",
    "accuracy",
    Column("A", "relative accuracy", "-", Bounds(1e-9, 0.1), "accuracy"),
)

MODEL = Keyword(
    "MODEL",
    "what to force where the solver would choose",
    (
        Row(
            "options, by name",
            (
                Column(
                    "ELEMENTS",
                    "number of elements of a tube",
                    bounds=Bounds(1, 100000),
                    key="elements",
                    kind="integer",
                    named=True,
                    otherwise="by accuracy",
                ),
                Column(
                    "ORDER",
                    "polynomial degree of the deflection in an element",
                    key="degree",
                    kind="integer",
                    choices=("3", "5", "7"),
                    named=True,
                    otherwise="by the solver",
                ),
            ),
        ),
    ),
    "*MODEL ELEMENTS=40 ORDER=5",
    once=True,
    optioned=True,
    planned=(
        *("PLANAR", "SPATIAL", "SMALL", "PDELTA", "LARGE", "SHEAR", "TZ", "LENGTH", "WEIGHT"),
        *("PATH", "HYSTERESIS"),
    ),
)

INCLUDE = Keyword(
    "INCLUDE",
    "read another file here",
    (),
    "*INCLUDE, file=curves.inc",
    "The name is relative to the including file. The file holds whole keywords.",
)

EXEC = Keyword("EXEC", "end of the deck: check, then solve", (), "*EXEC", once=True)
STOP = Keyword("STOP", "end of the deck: check alone", (), "*STOP", once=True)

MODEL_KEYWORDS = (
    *(TITLE, DEPTH, CASING, FONDATION, SUPPORT, SPRING, LOAD, DISPLACE, QUASISTATIC),
    *(NEWTONSTAT, ACCURACY, MODEL, INCLUDE, EXEC, STOP),
)
