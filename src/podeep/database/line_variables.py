"""What a database holds of a line: a pipe or riser on the seabed."""

from ..subject import LINE
from .variable import LOADS, PROGRESS, Group, Variable, axes, extremes

_ROWS = ("axis", "distance")
_LEFT = "to the left of the way to end 2"
_LAID = "since the end of laying (step 0)"
_FRICTION = "friction of the seabed, positive against displacement"


def _result(name: str, units: str, long_name: str, comment: str, group: Group = "") -> Variable:
    return Variable(name, _ROWS, units, long_name, comment, group)


_PROFILE = (
    _result(
        "lateral_displacement",
        "m",
        "lateral displacement",
        f"{_LAID}, horizontal across the line, positive {_LEFT}",
    ),
    _result("lateral_force", "N m-1", "lateral friction per length", f"{_FRICTION} {_LEFT}"),
    _result(
        "axial_displacement",
        "m",
        "axial displacement",
        f"{_LAID}, along the line, positive towards end 2",
    ),
    _result("axial_force", "N m-1", "axial friction per length", f"{_FRICTION} towards end 2"),
    _result("penetration", "m", "penetration", "positive into the seabed, negative above it"),
    _result(
        "normal_reaction",
        "N m-1",
        "normal reaction of the seabed per length",
        "positive as the seabed pushes the line up, negative in suction",
    ),
)

_INNER = (
    _result(
        "effective_tension",
        "N",
        "effective tension",
        "true wall tension with the pressures of what is inside and outside; negative: compression",
        group="line",
    ),
    _result(
        "bending_moment",
        "N m",
        "bending moment",
        "positive sagging in a planar scene, its size in a spatial one",
        group="line",
    ),
)

LINE_VARIABLES: tuple[Variable, ...] = (
    *axes(LINE),
    Variable(
        "distance",
        ("distance",),
        "m",
        LINE.where,
        "unstretched arc length from end 1; a jump is two distances 1e-6 m apart",
        number="coordinate",
    ),
    *LOADS,
    *_PROFILE,
    Variable(
        "touchdown_distance",
        ("axis",),
        "m",
        "distance along the line of the touchdown point",
        "the first point seen from end 2 that touches the seabed; end 1 (0) where none does",
    ),
    Variable(
        "touchdown_x", ("axis",), "m", "x of the touchdown point", "global axes, as the line lies"
    ),
    *extremes((*_PROFILE, *_INNER), LINE),
    *PROGRESS,
    *(
        _result(f"position_{a}", "m", f"position along {a}", "global axes", group="line")
        for a in "xy"
    ),
    _result("position_z", "m", "elevation above sea level", "global axes, z up", group="line"),
    *_INNER,
)
