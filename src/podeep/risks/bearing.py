"""Axial loads against what the pile bears, before anything is solved."""

from collections.abc import Iterator
from math import ceil, floor

from ..capacity import Check, as_it_stands
from ..errors import InvalidData, UserError
from ..scene import Foundation, Scene
from ..soil.axial_capacity import PileCapacity
from ..units import short
from .risk import Risk, rounded
from .site import EDGE, Site

_OPERATING, _EXTREME = 2.0, 1.5
_SAFETY = "the safety factor is 2.0 in operating, 1.5 in extreme conditions (API RP 2A-WSD 6.3.4)"
_LONGEST = 3.0  # embedded lengths up to which one that bears the loads is looked for
_AMPLE = 1000.0  # factor of a load that is next to none, or that buoyancy carries
_WAYS = {True: "plugged", False: "unplugged"}


def strength(site: Site) -> Iterator[Risk]:
    """Loads that t-z and Q-z cannot carry, or only just."""
    found, _ = site.bearing
    if found is None or not site.axial or site.held:
        return
    for way, check in _ways(found, site):
        if check.factor >= _EXTREME * (1.0 - EDGE):
            continue
        shaft, tip, own = parts(found, way, check.factor_plugged)
        capacity, weight = shaft + tip + own, check.pile_weight + check.plug_weight
        made = f"tip {rounded(tip, 'N')}" if way == "compression" else f"weight {rounded(own, 'N')}"
        numbers = (
            f"{_demand(way, check, site)}, the pile bears {rounded(capacity, 'N')} "
            f"({_WAYS[check.factor_plugged]}: shaft {rounded(shaft, 'N')}, {made})"
        )
        if check.factor < 1.0:
            share = max(capacity - weight, 0.0) / check.load
            rule = f"it can carry {_least(share)} of that load and no more (API RP 2GEO 8.1)"
            yield Risk(site.name, way, numbers, rule, _longer(site, 1.0))
        else:
            rule = f"that is a factor of {_least(check.factor)}, where {_SAFETY}"
            yield Risk(site.name, way, numbers, rule, _longer(site, _EXTREME))


def full_tip(site: Site) -> Iterator[Risk]:
    """A pile that cores before it plugs, while Q-z acts on the full area of its tip."""
    found, _ = site.bearing
    if found is None or not site.axial or site.spudcan or not site.load.compression:
        return
    ways = (found.compression_plugged, found.compression_unplugged)
    plugged, unplugged = (float(way[0]) for way in ways)
    needed = _OPERATING * (site.load.compression + float(found.pile_weight[0]))
    if found.plug == "PLUGGED" or unplugged >= min(plugged, needed):
        return
    shaft, _, _ = parts(found, "compression", plugged=True)
    area = float(found.wall_area[0] + found.plug_area[0])
    numbers = f"the pile bears {rounded(unplugged, 'N')} unplugged, {rounded(plugged, 'N')} plugged"
    rule = (
        "the solver puts Q-z on the full area of the tip, too much by "
        f"{rounded(plugged - unplugged, 'N')} if the pile cores (API RP 2GEO 8.1)"
    )
    remedy = (
        f"lower the end bearing of the curve at the tip from "
        f"{rounded(float(found.unit_bearing[0]), 'Pa')} to "
        f"{rounded((unplugged - shaft) / area, 'Pa')}, with which it bears as if unplugged"
    )
    yield Risk(site.name, "full_tip", numbers, rule, remedy)


def support(site: Site) -> Iterator[Risk]:
    """A support along z that takes more than the soil could, or what no one knows."""
    if site.axial and site.propped and site.load.compression + site.load.tension:
        numbers = "a support along z stands beside t-z curves that act"
        rule = "both carry the axial load, in the ratio of their stiffness"
        remedy = "take the support out, or let it carry alone with *MODEL TZ=OFF"
        yield Risk(site.name, "support", numbers, rule, remedy)
    if not site.supported:
        return
    found, why = site.bearing
    if found is not None:
        for way, check in _ways(found, site):
            if check.factor < _OPERATING * (1.0 - EDGE):
                numbers = _carried(way, check, site)
                yield Risk(site.name, f"support {way}", numbers, _SAFETY, _longer(site, _OPERATING))
    elif largest := max(site.load.compression, site.load.tension):
        numbers = f"the support along z carries {rounded(largest, 'N')}"
        rule = f"whether the soil could is unknown: {why}"
        remedy = "give t-z curves, with *MODEL TZ=OFF to have the support checked against them"
        yield Risk(site.name, "support", numbers, rule, remedy)


def tip_support_check(scene: Scene, foundation: Foundation) -> str:
    """The load on a pile's support along z against its capacity, in one line; else empty.

    That of concept stages: p-y curves and a support at the tip, whose reaction is held against
    the capacity of t-z curves that do not act (*MODEL TZ=OFF).
    """
    site = Site(scene, foundation)
    if site.length <= 0.0 or not site.supported:
        return ""
    found, why = site.bearing
    if found is None:
        largest = rounded(max(site.load.compression, site.load.tension), "N")
        return f"{site.name}: the support along z carries {largest}, the capacity is unknown: {why}"
    acting = _ways(found, site)
    if not acting:
        pressed, pulled = (rounded(c.capacity, "N") for c in as_it_stands(found, site.load))
        bears = f"{pressed} of compression, {pulled} of tension"
        return f"{site.name}: the support along z carries nothing, the t-z curves bear {bears}"
    told = " and ".join(_carried(way, check, site) for way, check in acting)
    if min(check.factor for _, check in acting) >= _OPERATING * (1.0 - EDGE):
        return f"{site.name}: {told}"
    return (
        f"{site.name}: {told}, less than 2.0 of operating conditions; {_longer(site, _OPERATING)}"
    )


def parts(found: PileCapacity, way: str, plugged: bool) -> tuple[float, float, float]:
    """Shaft, tip and own weight (in tension) that make the capacity of one way, N."""
    shaft = float(found.outer_friction[0] + (0.0 if plugged else found.inner_friction[0]))
    if way == "compression":
        return shaft, float(found.wall_bearing[0] + plugged * found.plug_bearing[0]), 0.0
    weight = found.pile_weight[0] + plugged * found.plug_weight[0]
    return found.tension_factor * shaft, 0.0, float(weight)


def _ways(found: PileCapacity, site: Site) -> list[tuple[str, Check]]:
    """Compression and tension, each where any step has it."""
    both = zip(("compression", "tension"), as_it_stands(found, site.load), strict=True)
    return [(way, check) for way, check in both if check.load]


def _demand(way: str, check: Check, site: Site) -> str:
    step = site.load.compression_step if way == "compression" else site.load.tension_step
    weight = check.pile_weight + check.plug_weight
    beside = f" and {rounded(weight, 'N')} of own weight" if weight > 0.0 else ""
    return f"{way} of {rounded(check.load, 'N')} (step {step}){beside}"


def _carried(way: str, check: Check, site: Site) -> str:
    return (
        f"the support along z carries {_demand(way, check, site)}, the t-z curves bear "
        f"{rounded(check.capacity, 'N')} ({_WAYS[check.plugged]}), a factor of "
        f"{_least(check.factor)}"
    )


def _least(factor: float) -> str:
    """A factor to three decimals, none of which promises more than there is."""
    if factor > _AMPLE:
        return f"more than {_AMPLE:g}"
    return short(floor(1e3 * factor + 1e-6) / 1e3)


def _longer(site: Site, safety: float) -> str:
    """The remedy of a pile that is too short for a safety factor."""
    longest = _LONGEST * site.length
    try:
        length = site.pile.required(site.load, safety, longest).length
    except (UserError, InvalidData):  # the ground is not known down to there
        return "lower the load or widen the pile"
    aim = "to bear it" if safety == 1.0 else f"for a factor of {safety:g}"
    if length is None:
        return (
            f"lower the load or widen the pile: no length up to {short(longest)} m is enough {aim}"
        )
    up = ceil(100.0 * length) / 100.0
    return f"embed {short(up)} m {aim}, not {short(site.length)} m, or lower the load"


CHECKS = (strength, full_tip, support)
