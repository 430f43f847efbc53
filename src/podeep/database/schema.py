"""What stands in a soil database: one table for the writer, the reader and the docs.

A database holds a group for each foundation, named by its id. `VARIABLES` lists what such a group
holds; `variables` picks what one database needs. The dimension "axis" stands for the step of a
static database or the time of a dynamic one.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

Kind = Literal["static", "dynamic"]
Status = Literal["running", "complete", "stopped", "interrupted"]
Group = Literal["", "envelope", "estimate", "convergence", "tubes"]
Number = Literal["result", "coordinate", "integer", "text"]

SCHEMA = "podeep-soil"
MAJOR, MINOR = 1, 0
CONVENTIONS = "CF-1.11"
KINDS: tuple[Kind, ...] = ("static", "dynamic")
STATUSES: tuple[Status, ...] = ("running", "complete", "stopped", "interrupted")
ENDINGS = {".dss": "static", ".dst": "dynamic"}
AXES = {"static": "step", "dynamic": "time"}
PARTIAL = ".partial"  # added to the name of a database that is not finished
COMMITTED = "committed"  # rows that a running database vouches for; a finished one has none
DECK = "input/deck"

QUANTITIES = ("lateral_displacement", "lateral_force", "axial_displacement", "axial_force")
"""What the post-processor shows, and what has an envelope."""

EXTREMES = ("min", "max", "min_at", "max_at")


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a foundation's group, or of a group inside it.

    number: "result" has the precision of the database, "coordinate" is always float64, "integer"
    is int32, "text" a string without units. A variable named as its only dimension is the scale
    of that dimension. later: databases of earlier programs have it not.
    """

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    comment: str = ""
    group: Group = ""
    kinds: tuple[Kind, ...] = KINDS
    spatial_only: bool = False
    number: Number = "result"
    later: bool = False
    positive: Literal["", "up", "down"] = ""

    @property
    def is_scale(self) -> bool:
        return self.dims == (self.name,)


_LATERAL = (
    "in a planar scene signed along lateral_axis, the direction in degrees from x that its group "
    "states; in a spatial scene the magnitude of the components _x and _y"
)
_RESISTING = "reaction of the soil on the outermost tube, positive against a positive displacement"
_RELATIVE = "estimated error as a share of the largest value in the step"
_ABOVE = "what the part above exerts on the part below"
_RIGHT_HAND = "by the right hand about the global axis"

_PROFILE = (
    Variable("lateral_displacement", ("axis", "depth"), "m", "lateral displacement", _LATERAL),
    Variable(
        "lateral_slope",
        ("axis", "depth"),
        "1",
        "slope of the lateral displacement",
        "derivative of lateral_displacement by depth; in a spatial scene the magnitude of the "
        "components' derivatives",
    ),
    Variable(
        "lateral_force",
        ("axis", "depth"),
        "N m-1",
        "lateral soil reaction per length",
        f"{_RESISTING}; {_LATERAL}",
    ),
    Variable(
        "axial_displacement", ("axis", "depth"), "m", "axial displacement", "positive downward"
    ),
    Variable(
        "axial_strain",
        ("axis", "depth"),
        "1",
        "slope of the axial displacement",
        "derivative of axial_displacement by depth; compression makes it negative",
    ),
    Variable(
        "axial_force",
        ("axis", "depth"),
        "N m-1",
        "axial soil reaction per length",
        f"{_RESISTING}: positive upward on the tube",
    ),
)


def _component(variable: Variable, axis: str) -> Variable:
    comment = f"component along the global {axis} axis"
    if variable.name == "lateral_force":
        comment = f"{comment}; {_RESISTING}"
    elif variable.name == "lateral_slope":
        comment = f"derivative of lateral_displacement_{axis} by depth"
    return replace(
        variable,
        name=f"{variable.name}_{axis}",
        long_name=f"{variable.long_name} along {axis}",
        comment=comment,
        spatial_only=True,
    )


def _extreme(variable: Variable, which: str) -> Variable:
    bound = "smallest" if which.startswith("min") else "largest"
    name = f"{variable.name}_{which}"
    if which.endswith("_at"):
        what = f"step or time of the {bound} {variable.long_name}"
        comment = "the first, where several are equal"
        return Variable(name, ("depth",), "axis", what, comment, "envelope", number="coordinate")
    what, comment = f"{bound} {variable.long_name}", "over all computed steps"
    return Variable(name, ("depth",), variable.units, what, comment, "envelope")


def _tube(name: str, units: str, long_name: str, comment: str, *, later: bool = False) -> Variable:
    dims = ("axis", "elevation")
    return Variable(name, dims, units, long_name, comment, "tubes", later=later)


VARIABLES: tuple[Variable, ...] = (
    Variable(
        "step",
        ("axis",),
        "1",
        "quasi-static step",
        "0 is the state before loading",
        kinds=("static",),
        number="integer",
    ),
    Variable("time", ("axis",), "s", "time", kinds=("dynamic",), number="coordinate"),
    Variable(
        "depth",
        ("depth",),
        "m",
        "depth below the mudline",
        "a jump of soil or tube is two depths 1e-6 m apart; nothing is interpolated across it",
        number="coordinate",
        positive="down",
    ),
    Variable("load", ("load",), "", "name of the load", kinds=("static",), number="text"),
    Variable(
        "load_factor", ("axis", "load"), "1", "share of the load that acts", kinds=("static",)
    ),
    Variable("tube", ("depth",), "1", "id of the outermost tube", number="integer"),
    Variable(
        "layer", ("depth",), "1", "soil layer", "counted from 0 at the mudline", number="integer"
    ),
    *_PROFILE,
    *(_component(v, axis) for v in _PROFILE if v.name.startswith("lateral") for axis in "xy"),
    Variable(
        "tip_displacement", ("axis",), "m", "axial displacement of the tip", "positive downward"
    ),
    Variable("tip_force", ("axis",), "N", "soil reaction on the tip", "positive upward on the tip"),
    *(_extreme(v, which) for v in _PROFILE if v.name in QUANTITIES for which in EXTREMES),
    Variable(
        "displacement",
        ("axis",),
        "1",
        "error of the largest displacement",
        _RELATIVE,
        group="estimate",
    ),
    Variable(
        "reaction", ("axis",), "1", "error of the largest reaction", _RELATIVE, group="estimate"
    ),
    Variable("moment", ("axis",), "1", "error of the largest moment", _RELATIVE, group="estimate"),
    Variable("iterations", ("axis",), "1", "iterations", group="convergence", number="integer"),
    Variable(
        "residual",
        ("axis",),
        "1",
        "forces out of balance",
        "as a share of the forces that act",
        group="convergence",
    ),
    Variable(
        "step_size",
        ("axis",),
        "1",
        "size of the step taken at once",
        "static: smallest part of the load step; dynamic: share of the time step",
        group="convergence",
    ),
    Variable(
        "energy",
        ("axis",),
        "N m",
        "work of loads and supports",
        "since the first step",
        group="convergence",
    ),
    Variable(
        "elevation",
        ("elevation",),
        "m",
        "elevation above sea level",
        "from the top of the tube to its tip",
        "tubes",
        number="coordinate",
        positive="up",
    ),
    *(_tube(f"displacement_{a}", "m", f"displacement along {a}", "global axes") for a in "xy"),
    _tube("displacement_z", "m", "displacement along z", "global axes, z up"),
    *(_tube(f"rotation_{a}", "rad", f"rotation about {a}", _RIGHT_HAND) for a in "xy"),
    *(
        _tube(f"moment_{a}", "N m", f"bending moment about {a}", f"{_ABOVE}, {_RIGHT_HAND}")
        for a in "xy"
    ),
    *(_tube(f"shear_{a}", "N", f"shear force along {a}", f"{_ABOVE}, global axes") for a in "xy"),
    _tube("normal_force", "N", "normal force", f"{_ABOVE}, positive in compression"),
    _tube(
        "stress",
        "Pa",
        "largest normal stress of the section",
        "magnitude of that of normal force and bending together, at the outer diameter",
        later=True,
    ),
)


def variables(kind: Kind, *, spatial: bool, loads: bool) -> tuple[Variable, ...]:
    """The variables of a foundation in a database of this kind, with the axis by its name.

    spatial: the scene is not planar. loads: there are named loads.
    """
    axis = AXES[kind]
    units = next(v.units for v in VARIABLES if v.name == axis)

    def named(variable: Variable) -> Variable:
        dims = tuple(axis if d == "axis" else d for d in variable.dims)
        return replace(
            variable, dims=dims, units=units if variable.units == "axis" else variable.units
        )

    return tuple(
        named(v)
        for v in VARIABLES
        if kind in v.kinds and (spatial or not v.spatial_only) and (loads or "load" not in v.dims)
    )


def places(
    table: tuple[Variable, ...], tubes: Iterable[int]
) -> Iterator[tuple[str, Variable, int | None]]:
    """Path of each variable in its foundation's group, and the tube it belongs to, if to one.

    A dimension's scale comes before the variables that use it.
    """
    for variable in table:
        if variable.group != "tubes":
            yield "/".join(filter(None, (variable.group, variable.name))), variable, None
    for igr in tubes:
        for variable in table:
            if variable.group == "tubes":
                yield f"tubes/{igr}/{variable.name}", variable, igr
