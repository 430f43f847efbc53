"""The paragraphs of the ground: *GROUNDEPTH and *GROUNDPROP with their curves, *RADIATION."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from ..errors import Place
from ..scene import Curve, Ground, Interpolation
from .cells import Values, after, no_data, option_fields, read_lines, read_row
from .faults import Faults, first_bad
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph

_DEPTHS, _CURVES = KEYWORDS["GROUNDEPTH"], KEYWORDS["GROUNDPROP"]


@dataclass(frozen=True, slots=True)
class Depths:
    """The depths of *GROUNDEPTH, m below the mudline, positive down, and what varies between."""

    values: tuple[float, ...]
    interpolation: Interpolation
    sound: bool
    layering: Mapping[str, Any] = field(default_factory=dict)


def read_depths(paragraph: Paragraph, faults: Faults) -> Depths:
    """The depths; those at fault are told, and still count for *GROUNDPROP."""
    before, row = len(faults.found), _DEPTHS.rows[0]
    options, flags = option_fields(paragraph, _DEPTHS, row, faults)
    fields = [f for line in paragraph.lines for f in line]
    if not fields:
        no_data(paragraph, row, faults)
        return Depths((), "PARAMETERS", False)
    read = read_row([*fields, *options], row, _DEPTHS, paragraph.place, faults)
    given = [cells.get("Z") for cells in read.group]
    depths = tuple(0.0 - (z or 0.0) for z in given)
    if len(faults.found) == before:
        bad = first_bad(lambda n: Ground(depths[:n], (0,) * n, (0,) * n, {}, {}), len(depths))
        if bad is not None:
            index, problem = bad
            faults.add(read.group_places[index]["Z"], problem.message, problem.remedy)
    interpolation: Interpolation = "LOADS" if "LOADS" in flags else "PARAMETERS"
    layering = read.arguments(row.columns)
    faults.guarded(
        lambda: Ground((0.0,), (0,), (0,), {}, {}, interpolation=interpolation, **layering),
        read.places,
        paragraph.place,
    )
    return Depths(depths, interpolation, len(faults.found) == before, layering)


def read_ground(
    paragraph: Paragraph,
    depths: Depths,
    lateral: Registry[Curve],
    axial: Registry[Curve],
    dashpots: Mapping[int, float],
    faults: Faults,
) -> Ground | None:
    """The ground; None if it or one of its curves is at fault."""
    before = len(faults.found)
    read = _curve_line(paragraph, len(depths.values), lateral, faults)
    if read is None:
        return None
    found: list[Curve | None] = []
    for cells, places in zip(read.group, read.group_places, strict=True):
        for name, registry in (("IY", lateral), ("IZ", axial)):
            if cells.get(name):
                found.append(registry.get(cells[name], places[name]))
    if len(faults.found) > before or not depths.sound or None in found:
        return None
    return faults.guarded(
        lambda: Ground(
            depths.values,
            tuple(cells["IY"] for cells in read.group),
            tuple(cells["IZ"] for cells in read.group),
            MappingProxyType(lateral.sound),
            MappingProxyType(axial.sound),
            read.cells["IKTSO"],
            read.cells["IDRE"],
            depths.interpolation,
            **depths.layering,
            dashpots=MappingProxyType(dashpots),
        ),
        read.places,
        paragraph.place,
    )


def read_dashpots(
    paragraphs: Sequence[Paragraph], lateral: Registry[Curve], faults: Faults
) -> dict[int, float]:
    """Dashpots of *RADIATION by their p-y curves, which exist and have one each."""
    dashpots: dict[int, float] = {}
    places: dict[int, Place] = {}
    for paragraph in paragraphs:
        for values in read_lines(paragraph, KEYWORDS["RADIATION"], faults):
            if not values.sound:
                continue
            id_, place = values.cells["NCUR"], values.places["NCUR"]
            lateral.get(id_, place)
            if places.setdefault(id_, place) is not place:
                message = f"p-y curve {id_} has a dashpot already, at {places[id_]}"
                faults.add(place, message, "give it one")
            dashpots[id_] = values.cells["C"]
    return dashpots


def _curve_line(
    paragraph: Paragraph, count: int, lateral: Registry[Curve], faults: Faults
) -> Values | None:
    """The values of *GROUNDPROP for `count` depths; None, which is told, for a wrong number."""
    row = _CURVES.rows[0]
    options, _ = option_fields(paragraph, _CURVES, row, faults)
    fields = [f for line in paragraph.lines for f in line]
    values = [f for f in fields if not f.name]
    if not values:
        no_data(paragraph, row, faults)
        return None
    if not count:
        return None
    extra = len(values) - 2 * count
    if extra not in (0, 1, 2):
        place = after(values[-1].place) if extra < 0 else values[2 * count].place
        faults.add(
            place,
            f"*GROUNDPROP has {len(values)} values for {count} depths",
            f"expected {2 * count} (IY IZ for each depth), {2 * count + 1} with IKTSO or "
            f"{2 * count + 2} with IKTSO and IDRE",
        )
        return None
    last = values[2 * count - 2]
    if extra == 0 and count > 1 and _is_slope(last, lateral):
        faults.add(
            last.place,
            f"{last.text} is no p-y curve, but looks like IKTSO: are there curves for "
            f"{count - 1} of {count} depths?",
            f"give {count} pairs IY IZ before IKTSO and IDRE",
        )
        return None
    ends = [
        Field(f.text, f.place, name)
        for f, name in zip(values[2 * count :], ("IKTSO", "IDRE"), strict=False)
    ]
    named = [f for f in fields if f.name]
    line = [*values[: 2 * count], *ends, *named, *options]
    return read_row(line, row, _CURVES, paragraph.place, faults)


def _is_slope(cell: Field, lateral: Registry[Curve]) -> bool:
    """Whether what stands for the last p-y curve was meant as IKTSO: no id, but a large number."""
    try:
        number = float(cell.text.lower().replace("d", "e"))
    except ValueError:
        return False
    return number >= 1e3 and number not in lateral.places


def unused_curves(ground: Ground) -> Iterator[str]:
    """Notes on curves that stand at no depth."""
    for kind, curves, used in (
        ("p-y", ground.lateral_curves, ground.lateral),
        ("t-z", ground.axial_curves, ground.axial),
    ):
        idle = [str(id_) for id_ in curves if id_ not in used]
        if idle:
            yield f"{kind} {'curve' if len(idle) == 1 else 'curves'} {', '.join(idle)} at no depth"


def reacts_axially(ground: Ground, length: float) -> bool:
    """Whether any t-z curve resists along a tube of this length below the mudline, or at its tip.

    In layers, a curve at either end of an interval acts within it.
    """
    depths, axial = ground.depths, ground.axial
    layers = list(zip(depths, (*depths[1:], float("inf")), strict=True))
    reached = [i for i, (top, bottom) in enumerate(layers) if top < length and bottom > top]
    ends = {axial[j] for i in reached for j in (i, min(i + 1, len(axial) - 1))}
    last = reached[-1]
    at_tip = {axial[last], axial[min(last + 1, len(axial) - 1)]}
    curves = ground.axial_curves
    return any(_shaft_reacts(curves[i]) for i in ends if i) or any(
        _tip_reacts(curves[i]) for i in at_tip if i
    )


#: What must not be 0 for a shaft to resist, and what for a tip, by law.
_SHAFT = MappingProxyType(
    {
        "direct": ("unit_friction",),
        "cohesive": ("undrained_shear_strength",),
        "cohesionless": ("earth_pressure_coefficient", "interface_friction_angle"),
    }
)
_TIP = MappingProxyType(
    {
        "direct": "tip_pressure",
        "cohesive": "undrained_shear_strength",
        "cohesionless": "bearing_factor",
    }
)


def _shaft_reacts(curve: Curve) -> bool:
    if curve.rows:
        return any(row[0] for row in curve.rows)
    return all(curve.parameters[name] for name in _SHAFT[curve.law])


def _tip_reacts(curve: Curve) -> bool:
    if curve.rows:
        return any(row[2] for row in curve.rows)
    return curve.parameters[_TIP[curve.law]] > 0.0
