"""The keywords of what holds and drives the tubes, of the steps, and of where motion starts."""

from .column import IDS, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

_NAME = Column("NAME", "name of the load, by which steps call it", kind="word")
_IGR = Column("IGR", "tube", bounds=IDS, key="tube", kind="integer")
_Z = Column("Z", "elevation on the tube, from sea level", "m", key="elevation")
_DOFS = ("X", "Y", "Z", "RX", "RY", "RZ")
_DOF = Column("DOF", "degree of freedom", key="dof", kind="word", choices=_DOFS)


def _component(name: str, meaning: str, unit: str) -> Column:
    moment = 0.0 if name.startswith("M") else None
    return Column(name, meaning, unit, default=moment)


def _soil(
    name: str, meaning: str, unit: str, key: str, default: float | str | None = None
) -> Column:
    """What is known of a spudcan's soil: with a number as default, or in words what stands in."""
    special = {"AS": Bounds(0.0), "OCR": Bounds(1.0), "DR": Bounds(0.0, 100.0, open=True)}
    bounds = special.get(name, POSITIVE)
    if isinstance(default, float):
        return Column(name, meaning, unit, bounds, key, named=True, default=default)
    return Column(name, meaning, unit, bounds, key, named=True, otherwise=default or "unknown")


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

SPUDCAN = Keyword(
    "SPUDCAN",
    "a spudcan under a tube, in place of end bearing",
    (
        Row(
            "spudcans",
            (
                _IGR,
                Column("B", "diameter of the area in contact", "m", POSITIVE, "diameter"),
                Column(
                    "EMBED",
                    "depth of the largest bearing area below the mudline",
                    "m",
                    NOT_NEGATIVE,
                    "embedment",
                ),
                Column("G", "shear modulus of the soil", "Pa", POSITIVE, "shear_modulus"),
                Column("NU", "Poisson's ratio of the soil", "-", Bounds(0.0, 0.5), "poisson_ratio"),
                Column(
                    "V_PRELOAD",
                    "vertical preload; with it the yield surface holds",
                    "N",
                    POSITIVE,
                    "preload",
                    otherwise="elastic",
                ),
                Column(
                    "SOIL",
                    "soil of the yield surface and the bearing",
                    key="soil",
                    kind="word",
                    choices=("CLAY", "SAND"),
                    named=True,
                    otherwise="none",
                ),
                _soil("SU", "undrained strength at EMBED", "Pa", "undrained_shear_strength"),
                _soil("SUTIP", "undrained strength at the tip", "Pa", "tip_shear_strength", "SU"),
                _soil("AS", "embedded area, projected sideways", "m2", "lateral_area", 0.0),
                _soil("OCR", "overconsolidation ratio", "-", "overconsolidation_ratio", 1.0),
                _soil("PHI", "friction angle", "deg", "friction_angle"),
                _soil("GAMMA", "effective unit weight", "N/m3", "effective_unit_weight"),
                _soil("DR", "relative density", "%", "relative_density"),
                _soil("KD1", "factor on the vertical stiffness", "-", "vertical_factor", 1.0),
                _soil("KD2", "factor on the horizontal stiffness", "-", "horizontal_factor", 1.0),
                _soil("KD3", "factor on the rotational stiffness", "-", "rotational_factor", 1.0),
            ),
        ),
    ),
    "*SPUDCAN\n1 14 3 40e6 0.5 60e6 SOIL=CLAY SU=60e3 AS=30",
    "By ISO 19905-1. Springs hold the tip: vertical, horizontal, rotational. The standard's "
    "factors KD for embedment are not public: 1 is their lower bound. Under a preload the "
    "rotational spring softens as the loads near the yield surface.",
)

MASS = Keyword(
    "MASS",
    "a lumped mass",
    (
        Row(
            "masses",
            (
                _IGR,
                Column("Z", "elevation, on the tube or above it", "m", key="elevation"),
                Column("M", "mass", "kg", NOT_NEGATIVE, "mass"),
                *(
                    Column(
                        f"J{a}{a}",
                        f"moment of inertia about {a.lower()}, through the mass",
                        "kg m2",
                        NOT_NEGATIVE,
                        default=0.0,
                    )
                    for a in "XYZ"
                ),
            ),
        ),
    ),
    "*MASS\n1 -50 350e3 0 4e6 0",
    "A mass above the top of its tube stands on a rigid arm. It takes part in motion, and in "
    "statics by its weight with *MODEL WEIGHT=ON.",
)

STIFFNESS = Keyword(
    "STIFFNESS",
    "a spring to ground of deflection and slope together",
    (
        Row(
            "springs",
            (
                _IGR,
                _Z,
                Column("KXX", "force for a deflection", "N/m", NOT_NEGATIVE, "lateral"),
                Column(
                    "KXR", "force for a slope, moment for a deflection", "N/rad", key="coupling"
                ),
                Column("KRR", "moment for a slope", "N m/rad", NOT_NEGATIVE, "rotational"),
            ),
        ),
    ),
    "*STIFFNESS\n1 -60 2.6e9 2.3e10 3.5e11",
    "H = KXX y + KXR y' and M = KXR y + KRR y', in every vertical plane alike. The slope y' is "
    "over depth, positive down: for what stands for a pile below, KXR is positive, the opposite of "
    "one that goes with rotations about y. KXX KRR is at least the square of KXR.",
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
    "is one step with all loads at factor 1. Before a *DYNAMIC, loads that *HARMONIC or "
    "*TIMESERIES names have the factor 0 in these steps unless a line names them.",
    once=True,
)

INITIAL = Keyword(
    "INITIAL",
    "where a degree of freedom starts in motion",
    (
        Row(
            "starts",
            (
                _IGR,
                _Z,
                _DOF,
                Column("VALUE", "displacement or rotation", "m or degrees"),
                Column("VELOCITY", "how fast it moves", "m/s or degrees/s"),
            ),
        ),
    ),
    "*INITIAL\n1 -58 X 0.05 0",
)
