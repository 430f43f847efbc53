"""The keywords of lines (pipes, risers): their sections, their ends, and how these move."""

from .column import IDS, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

_IGR = Column("IGR", "line", bounds=IDS, key="line", kind="integer")
_END = Column("END", "end of it", key="end", kind="integer", choices=("1", "2"))
_WIDTH, _DENSITY, _PLACE = Bounds(1e-5, 1e3), Bounds(0.0, 1e6), Bounds(-1e7, 1e7)
_MOVED = Bounds(-1e6, 1e6)
_DOFS = ("X", "Y", "Z", "RX", "RY", "RZ")
_DOF = Column("DOF", "degree of freedom", key="dof", kind="word", choices=_DOFS)
_PHASE = Column("PHASE", "phase at t = 0", "deg", key="phase", default=0.0)


def _override(name: str, meaning: str, unit: str, key: str, otherwise: str) -> Column:
    return Column(
        name, meaning, unit, Bounds(1e-9, 1e25), key, named=True, otherwise=f"from {otherwise}"
    )


def _direction(axis: str) -> Column:
    return Column(
        f"D{axis}",
        f"{axis.lower()} of the held direction in which the line leaves the end",
        "-",
        _PLACE,
        named=True,
        otherwise="horizontal, towards the other end",
    )


LINE = Keyword(
    "LINE",
    "a pipe or riser, section by section",
    (
        Row(
            "first line",
            (
                Column("IGR", "id of the line, none of a tube", bounds=IDS, kind="integer"),
                Column("NAME", "name of the line", kind="word", otherwise="none"),
            ),
        ),
        Row(
            "sections from end 1 to end 2",
            (
                Column("LENGTH", "unstretched length", "m", Bounds(1e-3, 1e8), "length"),
                Column("OD", "outer diameter", "m", _WIDTH, "outer_diameter"),
                Column("WT", "wall thickness, OD/2 for a solid bar", "m", _WIDTH, "wall_thickness"),
                Column("E", "Young's modulus", "Pa", Bounds(1.0, 1e15), "youngs_modulus"),
                Column("RHO", "density", "kg/m3", _DENSITY, "density"),
                Column(
                    "NEL",
                    "number of elements, 0 for what *ACCURACY asks for",
                    bounds=Bounds(0, 100000),
                    key="elements",
                    kind="integer",
                    otherwise="0",
                    none_at_zero=True,
                ),
                _override(
                    *("EI", "bending stiffness", "N m2", "bending_stiffness_override"), "OD, WT, E"
                ),
                _override(*("EA", "axial stiffness", "N", "axial_stiffness_override"), "OD, WT, E"),
                _override(
                    *("MASS", "mass per length, without contents", "kg/m", "mass_override"),
                    "OD, WT, RHO",
                ),
                Column(
                    "CA",
                    "added-mass coefficient",
                    "-",
                    Bounds(0.0, 1e6),
                    "added_mass_coefficient",
                    named=True,
                    default=1.0,
                ),
                Column(
                    "CD",
                    "drag coefficient across the line, in water at rest",
                    "-",
                    Bounds(0.0, 1e6),
                    "drag_coefficient",
                    named=True,
                    default=0.0,
                ),
                Column(
                    "FILL",
                    "density of the contents",
                    "kg/m3",
                    _DENSITY,
                    "fill_density",
                    named=True,
                    default=0.0,
                ),
            ),
        ),
    ),
    "*LINE\n11 RISER\n1400 0.3 0.02 207e9 7850 100\n 235 0.3 0.03 207e9 7850 FILL=900 EI=80e6",
    "Its weight in water is that of wall and contents less the buoyancy of OD in the water of "
    "*SEA. *END places its ends, *TYPCONTACT lays it on the seabed. Tubes and lines share their "
    "numbers. A deck of lines alone needs *DEPTH and nothing of foundations.",
)

END = Keyword(
    "END",
    "where a line's ends are, and what holds them",
    (
        Row(
            "ends",
            (
                _IGR,
                Column(
                    "END",
                    "1: the first section begins here; 2: the last one ends here",
                    key="number",
                    kind="integer",
                    choices=("1", "2"),
                ),
                *(Column(a, f"{a.lower()} of the line's axis", "m", _PLACE) for a in "XY"),
                Column("Z", "elevation of the line's axis, from sea level", "m", _PLACE),
                *(_direction(a) for a in "XYZ"),
            ),
            (
                Column(
                    "DOF",
                    "degree of freedom held there; FREE alone: none is",
                    key="dof",
                    kind="word",
                    choices=(*_DOFS, "FREE"),
                ),
            ),
        ),
    ),
    "*END\n11 1 0 0 -60 X Y Z RX RY RZ\n11 2 1600 0 0 X Y Z",
    "A line for each end. RX RY RZ, all three or none, hold the direction of the line: horizontal "
    "towards the other end, or that of DX=, DY=, DZ=, of any length; 0 are those left out. A free "
    "end is where the line begins its statics.",
)

MOTION = Keyword(
    "MOTION",
    "how an end of a line is moved",
    (
        Row(
            "the end, for rows of the next two kinds",
            (
                _IGR,
                _END,
                Column(
                    "NAME",
                    "name of its VALUEs, by which *QUASISTATIC and histories call them",
                    kind="word",
                    named=True,
                    otherwise="L and E with their numbers, such as L11E2",
                ),
            ),
        ),
        Row(
            "a displacement of the steps",
            (
                _DOF,
                Column("VALUE", "displacement or rotation from *END", "m or degrees", _MOVED),
            ),
        ),
        Row(
            "a wave, in motion",
            (
                _DOF,
                Column("AMPLITUDE", "amplitude", "m or degrees", _MOVED),
                Column("PERIOD", "period", "s", POSITIVE, "period"),
                _PHASE,
                Column(
                    "RAMP",
                    "time over which it grows, as of *HARMONIC",
                    "s",
                    NOT_NEGATIVE,
                    "ramp",
                    default=0.0,
                ),
            ),
        ),
        Row(
            "or the end, what a record moves there, and the file with its rows",
            (
                _IGR,
                _END,
                Column(
                    "FILE",
                    "text file, relative to the file that names it",
                    kind="word",
                    named=True,
                    otherwise="rows follow here",
                ),
            ),
            (_DOF,),
        ),
        Row(
            "rows of a record, in the file or below",
            (Column("T", "time, rising from row to row", "s"),),
            (Column("VALUE", "displacement or rotation, of each DOF in turn", "m or degrees"),),
        ),
    ),
    "*MOTION\n"
    "11 2            ! end 2 of line 11\n"
    "X 5             ! 5 m in the steps: L11E2 is their name in *QUASISTATIC\n"
    "Z 2.5 12 90     ! a wave in motion: amplitude 2.5 m, period 12 s, phase 90 deg\n"
    "*MOTION\n"
    "11 1 X Y        ! or 11 1 X Y, file=quay.txt and the rows there\n"
    "0  0   0\n"
    "60 1.2 0.4",
    "One end a keyword. Two values are a displacement of the steps, DOF VALUE, which takes the "
    "factor of its name like those of *DISPLACE; three to five are a wave, AMPLITUDE sin(2 pi t / "
    "PERIOD + PHASE); several of one degree of freedom add up. A record is joined by straight "
    "lines, and held before and after. All count from the place in *END, and what moves is held "
    "there. Rotations turn the held direction. Waves and records act with *DYNAMIC alone.",
)
