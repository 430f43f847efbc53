"""Columns that curves of several types share."""

from .column import IDS, NOT_NEGATIVE, POSITIVE, Bounds, Column

LENGTH = "m or diameters"
RISING = "rising from row to row"

NCUR = Column("NCUR", "id of the curve", bounds=IDS, kind="integer")
STRENGTH = Column("CU", "undrained shear strength", "Pa", NOT_NEGATIVE, "undrained_shear_strength")
WEIGHT = Column("GAMMA", "effective unit weight", "N/m3", NOT_NEGATIVE, "effective_unit_weight")
OWN_WEIGHT = Column(
    "GAMMA",
    "effective unit weight, for the overburden of deeper layers",
    "N/m3",
    NOT_NEGATIVE,
    "effective_unit_weight",
    named=True,
    otherwise="unknown",
)
PMULT = Column(
    "PMULT",
    "factor on the reaction, for groups",
    "-",
    POSITIVE,
    "multiplier",
    named=True,
    default=1.0,
)
#: of a group: they become a factor on the reaction that multiplies PMULT
GROUP = (
    PMULT,
    Column(
        "SPACING",
        "spacing of the piles of a group, for a factor by AASHTO",
        "diameters",
        Bounds(3.0),
        named=True,
        otherwise="no group",
    ),
    Column(
        "ROW",
        "row of the pile, 1 leads; MEAN3 is the mean of three rows, for waves",
        kind="word",
        choices=("1", "2", "3", "MEAN2", "MEAN3", "MEAN4", "MEAN5"),
        named=True,
        otherwise="no group",
    ),
)
CYCLIC = Column("CYCLIC", "cyclic instead of static curve", key="cyclic", kind="flag", named=True)
IOD = Column(
    "IOD", "unit of the rows' displacements: 0 m, 1 diameters", kind="integer", choices=("0", "1")
)


def curve_type(number: int) -> Column:
    return Column("ITYP", "type of the curve", kind="integer", choices=(str(number),))


def shape(choices: tuple[str, ...], meaning: str) -> Column:
    return Column(
        "SHAPE", meaning, key="shape", kind="word", choices=choices, named=True, default=choices[0]
    )
