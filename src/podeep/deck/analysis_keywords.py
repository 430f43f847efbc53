"""The keywords of the analysis, and those that frame a deck."""

from .column import Bounds, Column, Keyword, Row

_RATIO = Bounds(0.0, 1.0, open=True)


def _only(name: str, purpose: str, title: str, *columns: Column, required: bool = False) -> Keyword:
    """A keyword of one row that stands once."""
    values = {"DEPTH": "-60", "NEWTONSTAT": "200 0.01 0.01 0.01 0.01", "ACCURACY": "1e-4"}
    example = f"*{name}\n{values[name]}"
    return Keyword(name, purpose, (Row(title, columns),), example, once=True, required=required)


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
                Column(
                    "PLANAR",
                    "deflections in one plane",
                    key="planar",
                    kind="flag",
                    named=True,
                ),
                Column(
                    "SPATIAL",
                    "deflections in x and y",
                    key="spatial",
                    kind="flag",
                    named=True,
                ),
                Column(
                    "PDELTA",
                    "the normal force bends the tube further, whether it matters or not",
                    key="pdelta",
                    kind="flag",
                    named=True,
                ),
                Column(
                    "SMALL",
                    "small displacements: the normal force does not bend the tube",
                    key="small",
                    kind="flag",
                    named=True,
                ),
                Column(
                    "SHEAR",
                    "tubes are soft in shear",
                    key="shear",
                    kind="switch",
                    named=True,
                    default=False,
                ),
                Column(
                    "LENGTH",
                    "ACTIVE: below the active length, where a deflection has faded, elements are "
                    "as few as layers and accuracy allow",
                    key="length",
                    kind="word",
                    choices=("FULL", "ACTIVE"),
                    named=True,
                    default="FULL",
                ),
                Column(
                    "WEIGHT",
                    "tubes have their own weight, in water below sea level, from step 0 on",
                    key="weight",
                    kind="switch",
                    named=True,
                    default=False,
                ),
                Column(
                    "TZ",
                    "t-z and Q-z curves act; OFF: a vertical support at each tip carries the tube, "
                    "and its reaction is checked against their capacity",
                    key="axial_curves",
                    kind="switch",
                    named=True,
                    default=True,
                ),
                Column(
                    "HYSTERESIS",
                    "what the soil remembers: ELASTIC nothing, MASING unloading by twice the "
                    "curve, GAP what the pile has pushed away",
                    key="hysteresis",
                    kind="word",
                    choices=("ELASTIC", "MASING", "GAP"),
                    named=True,
                    default="ELASTIC",
                ),
                Column(
                    "PATH",
                    "go on beyond a peak, on the branch where the loads fall",
                    key="follow_path",
                    kind="switch",
                    named=True,
                    default=False,
                ),
            ),
        ),
    ),
    "*MODEL, PDELTA, SHEAR=ON, ELEMENTS=40, ORDER=5",
    once=True,
    optioned=True,
    planned=("LARGE",),
)

SEA = Keyword(
    "SEA",
    "the water around tubes and lines",
    (
        Row(
            "the water",
            (
                Column("RHO", "density", "kg/m3", Bounds(0.0, 1e6), "density"),
                Column(
                    "G",
                    "acceleration of gravity",
                    "m/s2",
                    Bounds(0.0, 1e4, open=True),
                    "gravity",
                    default=9.80665,
                ),
            ),
        ),
    ),
    "*SEA\n1025",
    "It gives the weight in water of lines, and of tubes and plugs for capacities. Without *SEA it "
    "is sea water of 1025 kg/m3.",
    once=True,
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
