"""Piles that are legal but risky: their size against the laws', the ground that they meet."""

from collections.abc import Iterator
from itertools import pairwise
from math import pi

import numpy as np

from ..model.needs import lateral_vectors
from ..soil.axial import CohesiveShaft, Shaft
from ..soil.iso_clay import IsoClay
from ..soil.surroundings import STRENGTH
from ..units import short
from .risk import Risk, listed, readable, rounded, written
from .site import EDGE, Site

_SLENDER = ("soft_clay", "sand", "stiff_clay_free_water", "stiff_clay", "iso_clay", "reese_sand")
_PISA = ("pisa_clay", "pisa_sand")
_WIDEST, _STOUTEST = 2.5, 10.0  # D (m) up to which, and L/D from which, a pile is slender
_PISA_RANGE = (("D", "m", 5.0, 10.0), ("L/D", "", 2.0, 6.0))
_ERRATIC = 0.5  # share of the strength above, below which a profile is erratic
_CARE, _SHARE = 3.0, 0.2  # su/s'v, and the share of friction from above it that is told
_STIFF, _SOFT = 0.001, 0.05  # w/D of peak friction that are far from 0.01
_NEAR, _WEAKER = 3.0, 0.5  # diameters to a layer that bears less than this share


def slender(site: Site) -> Iterator[Risk]:
    """Curves of slender piles on a stout or a wide one."""
    ids = [id_ for id_, curve in site.acting("p-y").items() if curve.law in _SLENDER]
    ratio, numbers = site.length / site.width, []
    if site.width > _WIDEST * (1.0 + EDGE):
        numbers.append(f"D = {rounded(site.width, 'm')}")
    if ratio < _STOUTEST * (1.0 - EDGE):
        numbers.append(f"L/D = {ratio:.3g}")
    if ids and numbers:
        rule = (
            f"the curves of p-y {listed(ids)} are for long slender piles, of up to about 2 m and "
            "with L/D above about 10 (API RP 2GEO 8.5)"
        )
        remedy = "compare with PISA (ITYP 7, 8: D 5 to 10 m, L/D 2 to 6) or with finite elements"
        yield Risk(site.name, "slender", " and ".join(numbers), rule, remedy)


def pisa(site: Site) -> Iterator[Risk]:
    """Curves of PISA outside what they were fitted for."""
    ids = [id_ for id_, curve in site.acting("p-y").items() if curve.law in _PISA]
    sizes = (site.width, site.length / site.width)
    numbers = [
        f"{name} = {rounded(size, unit)}"
        for size, (name, unit, low, high) in zip(sizes, _PISA_RANGE, strict=True)
        if not low * (1.0 - EDGE) <= size <= high * (1.0 + EDGE)
    ]
    if ids and numbers:
        rule = (
            f"the curves of p-y {listed(ids)}, PISA, were fitted for D of 5 to 10 m and L/D of 2 "
            "to 6 (Byrne et al., Burd et al., Geotechnique 70, 2020)"
        )
        remedy = "compare with ITYP 1 to 6 and 9 for slender piles, or with finite elements"
        yield Risk(site.name, "pisa", " and ".join(numbers), rule, remedy)


def bare(site: Site) -> Iterator[Risk]:
    """Depths at which no soil resists sideways, though the pile is driven that way."""
    ids = site.ground.lateral
    spans: list[list[float]] = []
    for top, end, (upper, lower) in site.reached():
        if ids[upper] or ids[lower]:
            continue
        if spans and spans[-1][1] == top:
            spans[-1][1] = end
        else:
            spans.append([top, end])
    if spans and lateral_vectors(site.scene, site.foundation):
        where = " and ".join(f"from {short(a)} to {short(b)} m" for a, b in spans)
        rule = "without a curve the soil resists nothing sideways"
        remedy = "give p-y curves at these depths in *GROUNDPROP, unless scour is meant"
        yield Risk(site.name, "bare", f"no p-y curve {where} below the mudline", rule, remedy)


def beyond(site: Site) -> Iterator[Risk]:
    """A tip well below the end of the last layer; a last depth that starts one has no end."""
    last = site.ground.depths[-1]
    ends = last > 0.0 and site.ground.depths.count(last) == 1
    if ends and last < site.length - site.width * (1.0 + EDGE):
        numbers = f"the tip is at {short(site.length)} m, the soil is given down to {short(last)} m"
        rule = "below its last depth its last curves go on unchanged"
        remedy = "give *GROUNDEPTH and its curves down to some diameters below the tip"
        yield Risk(site.name, "beyond", numbers, rule, remedy)


def no_mudline_strength(site: Site) -> Iterator[Risk]:
    """ISO's clay whose strength starts from nothing."""
    ids, curves = site.ground.lateral, site.ground.lateral_curves
    found: dict[int, float] = {}
    for top, end, ends in site.reached():
        if not any(ids[e] and curves[ids[e]].law == "iso_clay" for e in ends):
            continue
        middle = np.array([0.5 * (top + end)])
        for term in site.pile.profile.lateral(middle, site.pile.diameter(middle)).laws:
            law = term.law
            if isinstance(law, IsoClay) and np.max(law.mudline_strength) <= 0.0:
                found |= dict.fromkeys(term.curves, float(np.max(law.strength_gradient)))
    rise = max(found.values(), default=0.0)
    if rise > 0.0:
        numbers = f"p-y {listed(sorted(found))} with su0 = 0 and su1 = {rounded(rise, 'Pa/m')}"
        rule = (
            "there d is held at 14.5, its least, though it grows as su0 falls, so that pu errs to "
            "the unsafe side (ISO 19901-4, third edition)"
        )
        remedy = "give SU0 and SU1 of a line with some strength at the mudline"
        yield Risk(site.name, "no_mudline_strength", numbers, rule, remedy)


def erratic(site: Site) -> Iterator[Risk]:
    """Soft clay below one that is much stronger, without layering."""
    ground = site.ground
    places = [place for _, _, ends in site.reached() for place in ends if ground.lateral[place]]
    found = [
        (ground.depths[place], ground.lateral_curves[ground.lateral[place]]) for place in places
    ]
    clay = [(z, c.id, c.parameters[STRENGTH]) for z, c in found if c.law == "soft_clay"]
    for (_, above, strong), (depth, below, weak) in pairwise(clay):
        if weak < _ERRATIC * (1.0 - EDGE) * strong and ground.layering == "NONE":
            numbers = (
                f"CU falls from {readable(strong, 'Pa')} (p-y {above}) to {readable(weak, 'Pa')} "
                f"(p-y {below}) at {short(depth)} m"
            )
            rule = "pu and XR of local CU are for strengths that rise steadily (API RP 2GEO 8.5.2)"
            remedy = "compare with *GROUNDEPTH, LAYERING=GEORGIADIS"
            yield Risk(site.name, "erratic", numbers, rule, remedy)
            return


def overconsolidated(site: Site) -> Iterator[Risk]:
    """Clay so strong under its overburden that alpha is doubtful."""
    depth, terms = site.shaft
    total, doubtful, deepest = 0.0, 0.0, 0.0
    ids: set[int] = set()
    for term in terms:
        law = term.law
        share = 1.0 if term.weight is None else term.weight
        friction = np.broadcast_to(share * law.capacity, term.at.shape)
        total += float(friction.sum())
        if isinstance(law, CohesiveShaft) and law.method == "ALPHA":
            limit = _CARE * np.asarray(law.effective_overburden)
            above = (law.undrained_shear_strength > limit) & (friction > 0.0)
            doubtful += float(friction[above].sum())
            deepest = max(deepest, float(depth[term.at[above]].max(initial=0.0)))
            ids.update(term.curves if above.any() else ())
    if doubtful > _SHARE * total:
        numbers = (
            f"su/s'v of t-z {listed(sorted(ids))} is above 3 down to {rounded(deepest, 'm')}, from "
            f"where {100.0 * doubtful / total:.0f} % of the friction comes"
        )
        rule = "above 3 alpha = 0.5 (su/s'v)^-0.25 is to be used with care (API RP 2GEO eq. 17-19)"
        remedy = "back the friction by tests, or give a lower one with METHOD=DIRECT"
        yield Risk(site.name, "overconsolidated", numbers, rule, remedy)


def peak_displacement(site: Site) -> Iterator[Risk]:
    """Elastic-plastic friction that is far stiffer or softer than friction is."""
    found: list[tuple[float, float]] = []
    ids: set[int] = set()
    for term in site.shaft[1] if site.axial else ():
        law = term.law
        if isinstance(law, Shaft) and law.shape == "EP":
            peak = np.broadcast_to(law.peak_friction, term.at.shape)
            ratio = float((peak / law.initial_stiffness / law.diameter).max())
            if ratio > 0.0 and not _STIFF <= ratio <= _SOFT:
                found.append((ratio, float(peak.max())))
                ids.update(term.curves)
    if found:
        ratio, peak_there = max(found)
        numbers = (
            f"t-z {listed(sorted(ids))} (SHAPE=EP) reach {rounded(peak_there, 'Pa')} at "
            f"{rounded(1e3 * ratio * site.width, 'mm')}, {ratio:.2g} D"
        )
        rule = "friction peaks at about 0.01 D, between 0.0025 and 0.02 D (API RP 2GEO 8.4.2)"
        slope = written(peak_there / (0.01 * site.width))
        remedy = f"give SHAPE=2GEO, or a slope (IKTSO, F3) of {slope} Pa/m for 0.01 D"
        yield Risk(site.name, "peak_displacement", numbers, rule, remedy)


def near_weaker_layer(site: Site) -> Iterator[Risk]:
    """A tip close to a layer that bears much less, while its own end bearing counts in full."""
    if site.spudcan:
        return
    tip, width = site.length, site.pile.tube.sections[-1].outer_diameter
    for edge in site.layers.boundaries:
        if abs(edge - tip) > _NEAR * width * (1.0 - EDGE):
            continue
        sides = np.array([edge, np.nextafter(edge, np.inf)])
        force = site.pile.profile.tip(sides, np.full(2, width)).capacity
        inner, outer = (force / (0.25 * pi * width**2))[:: -1 if edge < tip else 1].tolist()
        if outer < _WEAKER * (1.0 - EDGE) * inner:
            numbers = (
                f"end bearing {'rises' if edge < tip else 'falls'} from "
                f"{rounded(outer if edge < tip else inner, 'Pa')} to "
                f"{rounded(inner if edge < tip else outer, 'Pa')} at {short(edge)} m, "
                f"{rounded(abs(edge - tip), 'm')} {'above' if edge < tip else 'below'} the tip"
            )
            rule = (
                "it counts in full 2 to 3 D into a layer and 3 D above a weaker one, here "
                f"{rounded(_NEAR * width, 'm')} (API RP 2GEO 8.1)"
            )
            remedy = "move the tip, or give the curve there an end bearing between both"
            yield Risk(site.name, "near_weaker_layer", numbers, rule, remedy)


CHECKS = (
    *(slender, pisa, bare, beyond, no_mudline_strength, erratic),
    *(overconsolidated, peak_displacement, near_weaker_layer),
)
