"""What a foundation of a scene can bear, against what the steps of the scene ask of it.

The soil alone is taken to carry the loads on the outermost tube: what supports, springs and
spudcans would carry is no part of it, nor what imposed displacements add.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite
from typing import Any

import numpy as np

from .arrays import Array
from .demand import Demand, demand
from .embedded import Pile
from .errors import Fault, UserError
from .scene import Foundation, Scene
from .soil.axial_capacity import Flags, PileCapacity
from .soil.lateral_capacity import RigidMechanism, rigid_mechanism
from .soil.required_length import RequiredLength

_FINE_ROWS = 400  # of equal spacing in a picture, at most; half at least
_BEYOND = 1.5  # embedded lengths that a table goes down to
_DEEPEST = 1000.0  # m
_CLOSE = 1e-6  # ratio of a moment that counts as none


@dataclass(frozen=True, slots=True)
class Check:
    """The pile as it stands against a load at the mudline, N.

    plugged: whether the plugged pile has the capacity that governs. factor: capacity by load and
    own weight, of the way (plugged or not) in which it is least; inf where there is no load.
    factor_plugged: that way. pile_weight, plug_weight: those carried in it besides the load.
    """

    capacity: float
    plugged: bool
    load: float
    factor: float
    factor_plugged: bool
    pile_weight: float = 0.0
    plug_weight: float = 0.0


@dataclass(frozen=True)
class Axial:
    """Axial capacity with the tip at each depth, that of the pile as it stands, what it needs.

    required: None where no step has an axial load. decided_by: which load requires the length.
    """

    table: PileCapacity
    compression: Check
    tension: Check
    required: RequiredLength | None

    @property
    def decided_by(self) -> str:
        assert self.required is not None
        return self.required.governing if self.tension.load else "compression"


@dataclass(frozen=True)
class Capacity:
    """All that `podeep-solve capacity` tells of a foundation.

    end: of the table, m. axial, lateral: None where no curve of the kind reacts. warnings: what
    a reader must know of the numbers.
    """

    pile: Pile
    safety: float
    end: float
    demand: Demand
    axial: Axial | None
    lateral: RigidMechanism | None
    warnings: tuple[str, ...]

    @property
    def lateral_factor(self) -> float:
        """Ultimate load of the rigid pile by the load of the scene; inf where there is none."""
        assert self.lateral is not None
        load, moment = self.demand.lateral, self.demand.moment
        if load:
            return float(self.lateral.lateral_load) / load
        return float(self.lateral.moment) / moment if moment else inf

    @cached_property
    def fine(self) -> PileCapacity:
        """The table for a picture."""
        return self.pile.table(self.end, _FINE_ROWS)

    def needed_compression(self, at: PileCapacity) -> tuple[Array, Flags]:
        """What capacity must reach, N, and where that is of the plugged pile, which lacks more."""
        coring = self.safety * (self.demand.compression + at.pile_weight)
        plugged = coring + self.safety * at.plug_weight
        margins = at.compression_plugged - plugged, at.compression_unplugged - coring
        lacking = np.equal(at.governing(*margins), margins[0])
        return np.where(lacking, plugged, coring), lacking


def capacity(
    scene: Scene, foundation: Foundation, safety: float = 2.0, deepest: float | None = None
) -> Capacity:
    """Axial capacity down to a depth, required length and rigid mechanism of a foundation.

    safety: on the required length's loads. deepest: end of the table and of the search for the
    length, m; 1.5 embedded lengths by default. Raises UserError for values that make no sense,
    and where a curve cannot be evaluated.
    """
    pile, load = Pile(scene, foundation), demand(scene, foundation)
    if not (isfinite(safety) and safety >= 1.0):
        raise UserError(
            Fault(
                f"the safety factor {safety:g} is not a number of 1 or more",
                "give --safety-factor 2.0 for operating or 1.5 for extreme loads, as a rule",
            )
        )
    most = max(_DEEPEST, _BEYOND * pile.length)
    end = _BEYOND * pile.length if deepest is None else deepest
    if not 0.0 < end <= most:
        raise UserError(
            Fault(
                f"the depth {end:g} m of --to is not above 0 and at most {most:g} m",
                f"give metres below the mudline; the pile's tip is at {pile.length:g} m",
            )
        )
    axial = _axial(pile, load, safety, end)
    ratio = (load.lateral, load.moment) if load.lateral or load.moment else (1.0, 0.0)
    cuts = pile.changes.tolist()
    lateral = rigid_mechanism(pile.profile, pile.diameter, pile.length, ratio, cuts)
    warnings = tuple(_warnings(pile, load, axial))
    reacts = lateral if lateral.translation else None
    return Capacity(pile, safety, end, load, axial, reacts, warnings)


def _axial(pile: Pile, load: Demand, safety: float, end: float) -> Axial | None:
    table = pile.table(end)
    if not (table.outer_friction.any() or table.unit_bearing.any()):
        return None
    acts = load.compression or load.tension
    required = pile.required(load, safety, end) if acts else None
    return Axial(table, *as_it_stands(pile.capacity(np.array([pile.length])), load), required)


def as_it_stands(tip: PileCapacity, load: Demand) -> tuple[Check, Check]:
    """The pile as it stands in compression, with its own weight, and in tension."""
    pile, plug = float(tip.pile_weight[0]), float(tip.plug_weight[0])
    found = {True: float(tip.compression_plugged[0]), False: float(tip.compression_unplugged[0])}
    weight = {True: pile + plug, False: pile}
    ways = {"AUTO": (True, False), "PLUGGED": (True,), "UNPLUGGED": (False,)}[tip.plug]
    factors = {way: _ratio(found[way], load.compression + weight[way]) for way in ways}
    least = min(ways, key=lambda way: factors[way])
    pressed, pulled = float(tip.compression[0]), float(tip.tension[0])
    governs, pulls = bool(tip.plugged_in_compression[0]), bool(tip.plugged_in_tension[0])
    factor = factors[least] if load.compression else inf
    return (
        Check(pressed, governs, load.compression, factor, least, pile, plug if least else 0.0),
        Check(pulled, pulls, load.tension, _ratio(pulled, load.tension), pulls),
    )


def _ratio(found: float, wanted: float) -> float:
    return found / wanted if wanted > 0.0 else inf


def _warnings(pile: Pile, load: Demand, axial: Axial | None) -> Iterator[str]:
    scene, tubes = pile.scene, pile.foundation.tubes
    beside: dict[str, Sequence[Any]] = {
        "supports": scene.supports,
        "springs": scene.springs,
        "spudcans": scene.spudcans,
        "imposed displacements": scene.displacements,
    }
    acting = [kind for kind, items in beside.items() if any(i.tube in tubes for i in items)]
    if acting:
        yield f"{' and '.join(acting)} are left out: the soil is taken to carry the loads alone"
    if len(tubes) > 1:
        yield (
            f"the capacity is that of tube {tubes[0]}, the outermost, alone, under the loads on "
            "all tubes of the foundation"
        )
    if load.across > _CLOSE * max(abs(load.moment), load.lateral):
        yield (
            f"a moment of {load.across:.4g} N m acts across the plane of the lateral load of step "
            f"{load.lateral_step} and is left out"
        )
    if axial is None:
        return
    curves = scene.ground.axial_curves
    used = {str(curves[i].options.get("plug", "AUTO")) for i in scene.ground.axial if i}
    if len(used) > 1:
        yield (
            f"the t-z curves differ in PLUG ({', '.join(sorted(used))}): that of the curve at the "
            f"tip, {pile.plug}, is taken at every depth"
        )
    needed = axial.required.length if axial.required else None
    for what, length in (("the tip", pile.length), ("the required length", needed)):
        if length is not None and (inside := pile.young_bearing(length)) is not None:
            yield (
                f"{what} at {length:.6g} m is {inside:.2f} m inside its layer, whose larger end "
                "bearing counts in full, though it takes 2 to 3 diameters to develop"
            )
    yield from axial.table.notes
