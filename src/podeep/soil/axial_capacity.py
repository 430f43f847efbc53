"""Axial capacity of a pile against the depth of its tip, and the length that given loads need.

    Qo = pi int D f dz                 friction outside, from the mudline to the tip
    Qi = pi int Di f dz                friction inside, of the same f
    compression, plugged               Qo + q (Aw + Ap)
    compression, unplugged             Qo + Qi + q Aw
    tension, plugged                   r Qo + W + Wp
    tension, unplugged                 r (Qo + Qi) + W
    capacity                           the lesser of plugged and unplugged, or the one chosen

f unit friction and q unit end bearing (Pa): what the t-z curves of the solver can bear at most, in
whatever law. D and Di outer and inner diameter (m); Aw and Ap areas of the wall and of the inside
at the tip (m2); W and Wp weights of pile and plug in water (N) below the mudline, W less than 0
where a pile is lighter than the water it displaces; r factor on friction in tension (-).

The pile is cut, or its lowest section extended, at each depth: areas and diameter of the tip are
those of the section there. No soil enters through a solid section, nor stays above one: such a
tip is a closed end. A change of diameter bears nothing. At a boundary the tip rests in the layer
above it; q acts in full from there on, with no allowance for the 2 to 3 D it takes to develop.

Range: driven piles; f that does not depend on the length of the pile, the same both ways but for r.
Source: API RP 2GEO 8.1-8.2, API RP 2A-WSD 6.4-6.5.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..errors import InvalidData, UserError
from ..scene import Section
from .profile import Profile

Plug = Literal["AUTO", "PLUGGED", "UNPLUGGED"]
Flags: TypeAlias = npt.NDArray[np.bool_]

#: Kronrod's rule of 7 points on [-1, 1] and, of every second one, the weights of Gauss's rule
_NODES = np.array([0.4342437493468025, 0.7745966692414834, 0.9604912687080203])
_NODES = np.concatenate((-_NODES[::-1], [0.0], _NODES))
_KRONROD = np.array([0.4013974147759622, 0.26848808986833345, 0.10465622602646727])
_KRONROD = np.concatenate((_KRONROD[::-1], [0.4509165386584741], _KRONROD))
_GAUSS = np.array([5.0, 8.0, 5.0]) / 9.0
_PANEL = 1.0  # longest panel that the integral of friction starts from, m
_PARTS = 8  # of a panel that is not exact enough
_PASSES = 8
_EXACT = 1e-12  # share of the whole that one panel may be wrong by


@dataclass(frozen=True, eq=False, kw_only=True)
class PileCapacity:
    """What a pile bears at each depth of its tip, arrays (n,); formulas as the module's page.

    notes: what the capacity leaves out for want of data, in words.
    """

    depth: Array
    outer_friction: Array  # Qo, N
    inner_friction: Array  # Qi, N
    unit_friction: Array  # f, Pa
    unit_bearing: Array  # q, Pa
    wall_area: Array  # Aw, m2
    plug_area: Array  # Ap, m2
    pile_weight: Array  # W, N
    plug_weight: Array  # Wp, N
    plug: Plug = "AUTO"
    tension_factor: float = 1.0
    notes: tuple[str, ...] = ()

    @property
    def wall_bearing(self) -> Array:
        return self.unit_bearing * self.wall_area

    @property
    def plug_bearing(self) -> Array:
        return self.unit_bearing * self.plug_area

    @cached_property
    def compression_plugged(self) -> Array:
        return self.outer_friction + self.wall_bearing + self.plug_bearing

    @cached_property
    def compression_unplugged(self) -> Array:
        return self.outer_friction + self.inner_friction + self.wall_bearing

    @cached_property
    def tension_plugged(self) -> Array:
        return self.tension_factor * self.outer_friction + self.pile_weight + self.plug_weight

    @cached_property
    def tension_unplugged(self) -> Array:
        friction = self.outer_friction + self.inner_friction
        return self.tension_factor * friction + self.pile_weight

    @property
    def compression(self) -> Array:
        return self.governing(self.compression_plugged, self.compression_unplugged)

    @property
    def tension(self) -> Array:
        return self.governing(self.tension_plugged, self.tension_unplugged)

    @property
    def plugged_in_compression(self) -> Flags:
        """Where the plugged pile governs; also where both are the same, as of a closed end."""
        return np.equal(self.compression, self.compression_plugged)

    @property
    def plugged_in_tension(self) -> Flags:
        return np.equal(self.tension, self.tension_plugged)

    def governing(self, plugged: Array, unplugged: Array) -> Array:
        """The lesser of both, or the one that the option `plug` chooses."""
        if self.plug == "AUTO":
            return np.minimum(plugged, unplugged)
        return plugged if self.plug == "PLUGGED" else unplugged


def axial_capacity(
    profile: Profile,
    sections: Sequence[Section],
    depths: Array,
    plug: Plug = "AUTO",
    tension_factor: float = 1.0,
    water_density: float = 1025.0,
    gravity: float = 9.80665,
    mudline: float = 0.0,
) -> PileCapacity:
    """Capacity of a pile with its tip at each of `depths` (m below the mudline, in any order).

    sections: from top to tip, by elevations, as of a tube; mudline: its elevation, m. The plug's
    weight is the overburden's increase over the inside, 0 where no unit weight is known.

    Raises UserError where a curve cannot be evaluated, InvalidData for an impossible option.
    """
    if plug not in get_args(Plug):
        raise InvalidData(
            f"there is no plug option {plug}", f"give one of {', '.join(get_args(Plug))}", "PLUG"
        )
    if not tension_factor >= 0.0:
        raise InvalidData(
            f"the factor {tension_factor:g} on friction in tension is negative",
            "it lies between 0 and 1 as a rule",
        )
    depth = np.atleast_1d(np.asarray(depths, dtype=float))
    tubes, bottom = _embedded(sections, mudline)
    outer = np.array([s.outer_diameter for s in tubes])
    inner = np.array([s.inner_diameter for s in tubes])
    wall = np.array([s.area for s in tubes])
    heaviness = gravity * (np.array([s.mass for s in tubes]) - water_density * wall)

    def friction(z: Array) -> Array:
        width = outer[bottom.searchsorted(z)]
        found = profile.shaft(z, width).capacity / (pi * width)
        if not np.isfinite(found).all():
            raise UserError("a t-z curve has no limit of friction, hence the pile no capacity")
        return np.asarray(found)

    # what each section has of the pile above each tip, and of that what stands full of soil
    start = np.minimum(depth[:, None], np.concatenate(([0.0], bottom[:-1])))
    end = np.minimum(depth[:, None], bottom)
    closed = np.where((inner == 0.0) & (end > start), end, 0.0).max(axis=1)[:, None]
    entry, exit_ = np.maximum(start, closed), np.maximum(end, closed)

    unit = friction(depth)
    edges = np.unique(np.concatenate([start, end], axis=None))
    cuts = [*profile.boundaries, *np.arange(_PANEL, edges[-1], _PANEL)]
    edges = np.union1d(np.append(edges, 0.0), [z for z in cuts if z < edges[-1]])
    integral = _integral(friction, edges)

    def between(a: Array, b: Array) -> Array:
        return np.asarray(integral[edges.searchsorted(b)] - integral[edges.searchsorted(a)])

    notes: tuple[str, ...] = ()
    plug_weight = np.zeros(len(depth))
    try:
        overburden = [profile.effective_overburden(z, "t-z") for z in (entry, exit_)]
        plug_weight = (overburden[1] - overburden[0]) @ (0.25 * pi * inner**2)
    except UserError as error:
        if inner.any():
            notes = (f"the plug is taken as weightless: {error}",)
    tip = bottom.searchsorted(depth)
    return PileCapacity(
        depth=depth,
        outer_friction=between(start, end) @ (pi * outer),
        inner_friction=between(entry, exit_) @ (pi * inner),
        unit_friction=unit,
        unit_bearing=profile.tip(depth, outer[tip]).capacity / (0.25 * pi * outer[tip] ** 2),
        wall_area=wall[tip],
        plug_area=0.25 * pi * inner[tip] ** 2,
        pile_weight=(end - start) @ heaviness,
        plug_weight=plug_weight,
        plug=plug,
        tension_factor=tension_factor,
        notes=notes,
    )


def _embedded(sections: Sequence[Section], mudline: float) -> tuple[list[Section], Array]:
    """Sections below the mudline and the depth at which each ends, the last one at none."""
    if not sections:
        raise InvalidData("the pile has no section", "give at least one")
    *others, last = sections
    tubes = [s for s in others if s.bottom < mudline]
    return [*tubes, last], np.array([*(mudline - s.bottom for s in tubes), np.inf])


def _integral(function: Callable[[Array], Array], edges: Array) -> Array:
    """Integral of a function of depth z from edges[0] to each of the rising `edges`.

    It runs over t = z^(1/4), in which friction in clay is smooth down to the mudline. Panels are
    divided where the rules of Gauss and Kronrod differ, which is where the function has a kink.
    """
    t = edges**0.25
    a, b, owner = t[:-1], t[1:], np.arange(len(t) - 1)
    total, allowed = np.zeros(len(owner)), 0.0
    for left in reversed(range(_PASSES)):
        half = 0.5 * (b - a)
        x = (a + half)[:, None] + half[:, None] * _NODES
        values = function((x**4).ravel()).reshape(x.shape) * 4.0 * x**3
        found = half * (values @ _KRONROD)
        allowed = allowed or _EXACT * float(found.sum())
        rough = np.abs(found - half * (values[:, 1::2] @ _GAUSS)) > allowed
        rough &= left > 0
        total += np.bincount(owner[~rough], found[~rough], len(total))
        if not rough.any():
            break
        grid = np.linspace(a[rough], b[rough], _PARTS + 1)
        a, b = grid[:-1].ravel(), grid[1:].ravel()
        owner = np.tile(owner[rough], _PARTS)
    return np.concatenate(([0.0], np.cumsum(total)))
