"""What a database holds of a foundation."""

from dataclasses import replace

from ..subject import FOUNDATION
from .variable import LOADS, PROGRESS, Variable, axes, extremes

_LATERAL = (
    "in a planar scene signed along lateral_axis, the direction in degrees from x that its group "
    "states; in a spatial scene the magnitude of the components _x and _y"
)
_RESISTING = "reaction of the soil on the outermost tube, positive against a positive displacement"
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


def _tube(name: str, units: str, long_name: str, comment: str, *, later: bool = False) -> Variable:
    dims = ("axis", "elevation")
    return Variable(name, dims, units, long_name, comment, "tubes", later=later)


FOUNDATION_VARIABLES: tuple[Variable, ...] = (
    *axes(FOUNDATION),
    Variable(
        "depth",
        ("depth",),
        "m",
        "depth below the mudline",
        "a jump of soil or tube is two depths 1e-6 m apart; nothing is interpolated across it",
        number="coordinate",
        positive="down",
    ),
    *LOADS,
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
    *extremes(_PROFILE, FOUNDATION),
    *PROGRESS,
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
