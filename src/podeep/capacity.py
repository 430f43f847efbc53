"""What a foundation of a scene can bear, against what the steps of the scene ask of it.

The soil alone is taken to carry the loads on the outermost tube: what supports, springs and
spudcans would carry is no part of it, nor what imposed displacements add.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import floor, inf, isfinite, log10
from typing import Any, cast

import numpy as np

from .arrays import Array
from .errors import Fault, UserError
from .scene import Foundation, Scene, Tube
from .soil.axial_capacity import Flags, PileCapacity, Plug, axial_capacity
from .soil.lateral_capacity import RigidMechanism, rigid_mechanism
from .soil.profile import Profile, profile_of
from .soil.required_length import RequiredLength, required_length

_ROWS, _FINE_ROWS = 40, 400  # of equal spacing in a table and a picture, at most; half at least
_BEYOND = 1.5  # embedded lengths that a table goes down to
_DEEPEST = 1000.0  # m
_SAME = 1e-9  # ratio of what counts as no jump
_CLOSE = 1e-6  # depths of one row, m; ratio of a moment that counts as none
_DEVELOPED = 3.0  # diameters of penetration at which end bearing has surely developed


@dataclass(frozen=True, slots=True)
class Demand:
    """The largest loads of any step about the mudline, N and N m, and the steps, from 1.

    compression, tension: magnitudes. lateral: the largest horizontal resultant; moment: of the
    same step, in its plane, positive where it acts as `lateral` above the mudline would; across:
    the moment out of that plane. A step of 0: there is no such load in any.
    """

    compression: float
    tension: float
    lateral: float
    moment: float
    across: float
    compression_step: int
    tension_step: int
    lateral_step: int


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
class Pile:
    """The outermost tube of a foundation in its ground."""

    scene: Scene
    foundation: Foundation

    @cached_property
    def tube(self) -> Tube:
        return self.scene.tubes[self.foundation.tubes[0]]

    @cached_property
    def length(self) -> float:
        """Embedded, m."""
        return self.foundation.mudline - self.tube.tip

    @cached_property
    def profile(self) -> Profile:
        return profile_of(self.scene, self.foundation, axial=True)

    @cached_property
    def changes(self) -> Array:
        """Depths at which one section of the tube follows another, m."""
        return np.array([self.foundation.mudline - s.bottom for s in self.tube.sections[:-1]])

    def diameter(self, depth: Array) -> Array:
        widths = np.array([s.outer_diameter for s in self.tube.sections])
        return np.asarray(widths[self.changes.searchsorted(depth)])

    @cached_property
    def plug(self) -> Plug:
        """The option PLUG of the t-z curve at the tip, of the one with the greater share."""
        tip = np.array([self.length])
        terms = self.profile.shaft(tip, self.diameter(tip)).laws
        if not terms:
            return "AUTO"
        weights = [1.0 if t.weight is None else float(t.weight[0]) for t in terms]
        curve = self.scene.ground.axial_curves[terms[int(np.argmax(weights))].curves[0]]
        return cast(Plug, curve.options.get("plug", "AUTO"))

    @cached_property
    def _water(self) -> tuple[float, float]:
        """What weights in water rest on: density (kg/m3) and gravity (m/s2)."""
        return self.scene.sea.density, self.scene.sea.gravity

    def capacity(self, depths: Array) -> PileCapacity:
        """With the tip at depths, m."""
        density, gravity = self._water
        return axial_capacity(
            self.profile,
            self.tube.sections,
            depths,
            plug=self.plug,
            water_density=density,
            gravity=gravity,
            mudline=self.foundation.mudline,
        )

    def required(self, load: Demand, safety: float, longest: float) -> RequiredLength:
        density, gravity = self._water
        return required_length(
            self.profile,
            self.tube.sections,
            longest,
            compression=load.compression,
            tension=load.tension,
            compression_safety=safety,
            tension_safety=safety,
            plug=self.plug,
            water_density=density,
            gravity=gravity,
            mudline=self.foundation.mudline,
        )

    def table(self, end: float, most: int = _ROWS) -> PileCapacity:
        """At round depths down to an end, at the tip, and on both sides of every jump."""
        changes = np.union1d(self.profile.boundaries, self.changes)
        changes = changes[(changes > 0.0) & (changes < end)]
        if not len(changes):
            return self.capacity(rows(end, self.length, changes, most))
        above, below = (
            np.array([c.unit_friction, c.unit_bearing, c.wall_bearing])
            for c in (self.capacity(changes), self.capacity(np.nextafter(changes, inf)))
        )
        jumps = changes[(np.abs(above - below) > _SAME * np.abs(above)).any(axis=0)]
        return self.capacity(rows(end, self.length, jumps, most))

    def young_bearing(self, tip: float) -> float | None:
        """How far a tip stands in a layer whose end bearing has not developed, m; None: it has."""
        top = max((z for z in self.profile.boundaries if z < tip), default=0.0)
        if tip - top >= _DEVELOPED * float(self.diameter(np.array([tip]))[0]):
            return None
        above, below = self.capacity(np.array([top, np.nextafter(top, inf)])).unit_bearing
        return tip - top if below > (1.0 + _SAME) * (above if top else 0.0) else None


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


def foundation_of(scene: Scene, name: str | None) -> Foundation:
    """The foundation of this name, or the first one. Raises UserError if there is none."""
    found = {f.name: f for f in scene.foundations}
    wanted = next(iter(found)) if name is None else name
    if wanted not in found:
        raise UserError(Fault(f"no foundation {wanted}", f"the deck has {', '.join(found)}"))
    return found[wanted]


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


def demand(scene: Scene, foundation: Foundation) -> Demand:
    """What the steps of a scene ask of a foundation: its point loads, summed about the mudline."""
    names = scene.steps.names
    factors = np.array(scene.steps.factors).reshape(len(scene.steps.factors), len(names))
    force = np.zeros((1 + len(factors), 3))  # step 0 is no load
    turning = np.zeros((1 + len(factors), 2))  # in x and y, as a lateral load above the mudline
    for load in scene.loads:
        if load.tube in foundation.tubes:
            factor = factors[:, names.index(load.name)]
            height = load.elevation - foundation.mudline
            x, y = load.moment[1] + height * load.force[0], height * load.force[1] - load.moment[0]
            force[1:] += np.multiply.outer(factor, load.force)
            turning[1:] += np.multiply.outer(factor, (x, y))
    down, up = int(np.argmin(force[:, 2])), int(np.argmax(force[:, 2]))
    sideways, moments = (np.hypot(*v.T) for v in (force[:, :2], turning))
    step = int(np.argmax(sideways if sideways.any() else moments))
    lateral, moment, across = float(sideways[step]), float(moments[step]), 0.0
    if lateral:
        x, y = (force[step, :2] / lateral).tolist()
        moment, across = (float(turning[step] @ axis) for axis in ((x, y), (-y, x)))
    return Demand(
        compression=0.0 - float(force[down, 2]),
        tension=float(force[up, 2]),
        lateral=lateral,
        moment=moment,
        across=abs(across),
        compression_step=down,
        tension_step=up,
        lateral_step=step,
    )


def rows(end: float, tip: float, jumps: Array, most: int = _ROWS) -> Array:
    """Depths of a table: round ones, `most` at most, its end, the tip, both sides of jumps."""
    decade = 10.0 ** floor(log10(end / most))
    spacings = [s * decade for s in (1.0, 2.0, 2.5, 5.0, 10.0)]
    spacing = next((s for s in spacings if end <= most * s * (1.0 + _SAME)), 20.0 * decade)
    regular = spacing * np.arange(floor(end / spacing + _SAME) + 1)
    special = np.concatenate(([tip, end], jumps, np.nextafter(jumps, inf)))
    apart = np.abs(regular[:, None] - special).min(axis=1) > _CLOSE
    return np.union1d(np.round(regular[apart], 9), special)


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
