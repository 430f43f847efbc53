"""The keywords of what holds and drives the tubes, and of the steps in which it does."""

from .column import IDS, POSITIVE, Bounds, Column, Keyword, Row

_NAME = Column("NAME", "name of the load, by which steps call it", kind="word")
_IGR = Column("IGR", "tube", bounds=IDS, key="tube", kind="integer")
_Z = Column("Z", "elevation on the tube, from sea level", "m", key="elevation")
_DOFS = ("X", "Y", "Z", "RX", "RY", "RZ")
_DOF = Column("DOF", "degree of freedom", key="dof", kind="word", choices=_DOFS)


def _component(name: str, meaning: str, unit: str) -> Column:
    moment = 0.0 if name.startswith("M") else None
    return Column(name, meaning, unit, default=moment)


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
