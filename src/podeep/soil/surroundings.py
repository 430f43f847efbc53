"""What a law needs to know of the ground around its point, beyond its curve's own parameters."""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Literal

import numpy as np

from ..arrays import Array
from ..errors import Fault, InvalidData, UserError
from ..scene import Curve, Ground
from .axial import alpha_friction
from .layers import Layers, Spread

Family = Literal["p-y", "t-z"]

WEIGHT = "effective_unit_weight"
STRENGTH = "undrained_shear_strength"
_ROCK = "weak_rock"
_WEDGE = 20.0  # diameters over which ISO 19901-4 takes adhesion and gradient of strength
_SAMPLES = 1000  # of the adhesion in each layer of that depth


class Surroundings:
    """Quantities of the ground at depths below the mudline (m) along a tube of given diameters.

    `values` names them as the laws' fields do. embedded_length: of the tube, m, where it is known.
    """

    def __init__(
        self,
        ground: Ground,
        layers: Layers,
        curves: Mapping[Family, Sequence[Curve | None]],
        embedded_length: float | None,
    ) -> None:
        self._ground, self._layers, self._curves = ground, layers, curves
        self._embedded_length = embedded_length
        self._weights: Mapping[Family, Spread] = MappingProxyType(
            {
                "p-y": layers.spread(_given(WEIGHT, curves["p-y"], curves["t-z"])),
                "t-z": layers.spread(_given(WEIGHT, curves["t-z"], curves["p-y"])),
            }
        )
        self._strength = layers.spread(_given(STRENGTH, curves["p-y"]))
        self._rock_top = self._tops_of_rock()

    def values(
        self, name: str, family: Family, depth: Array, diameter: Array
    ) -> Array | float | None:
        """The quantity of this name, shape (n,) or one for all; None if there is none.

        Raises UserError where the curves do not say enough.
        """
        given = _GIVEN.get(name)
        return None if given is None else given(self, family, depth, diameter)

    def effective_overburden(self, depth: Array, family: Family) -> Array:
        """s'v (Pa) at each depth: the integral of the unit weights that the curves give.

        The weights are those of the family's own curves, or where they give none of the other's;
        they vary linearly within a layer.
        """
        overburden = self._weights[family].integral(depth)
        if np.isnan(overburden).any():
            raise self._unknown_weight(family, float(np.min(depth[np.isnan(overburden)])))
        return overburden

    def _unknown_weight(self, family: Family, depth: float) -> UserError:
        """The error of an overburden that needs a unit weight which no curve gives."""
        layer, side = np.argwhere(np.isnan(self._weights[family].ends.T))[0].tolist()
        node = self._layers.ends[layer][side]
        ids = {"p-y": self._ground.lateral[node], "t-z": self._ground.axial[node]}
        return UserError(
            Fault(
                f"the effective overburden at {depth:g} m below the mudline, which a {family} law "
                f"needs, is unknown: at {self._ground.depths[node]:g} m neither p-y curve "
                f"{ids['p-y']} nor t-z curve {ids['t-z']} gives an effective unit weight",
                "give GAMMA= by name on the first line of one of them (where both are 0, of a user "
                "curve without reaction)",
            )
        )

    @property
    def weight(self) -> Spread:
        """Unit weight that the p-y laws feel, N/m3."""
        return self._weights["p-y"]

    @property
    def strength(self) -> Spread:
        """Undrained shear strength, Pa; NaN where there is no clay."""
        return self._strength

    def mean_strength(self, depth: Array) -> Array:
        """Mean undrained shear strength from the mudline to each depth, over the clay in it, Pa."""
        known, clay = self._strength.whole, self._strength.presence.integral(depth)
        mean = known.at(depth).copy()
        np.divide(known.integral(depth), clay, out=mean, where=clay > 0.0)
        return mean

    def strength_line(self, diameter: Array) -> tuple[Array, Array]:
        """Undrained shear strength at the mudline (Pa) and its rise with depth (Pa/m), (n,) each.

        The straight line through the strengths at the top of the clay and 20 diameters below it,
        or at the end of the clay if that comes first.
        """
        presence, strength = self._strength.presence, self._strength.whole
        clay = np.flatnonzero(presence.ends[0])
        if not len(clay):
            return np.zeros(len(diameter)), np.zeros(len(diameter))
        tops, bottoms = self._layers.top, np.append(self._layers.top[1:], np.inf)
        top, end = float(tops[clay[0]]), float(bottoms[clay[-1]])
        low = np.minimum(top + _WEDGE * diameter, end)
        first = strength.ends[0, clay[0]]
        rise = (strength.at(low) - first) / (low - top)
        return np.maximum(first - rise * top, 0.0), rise

    def adhesion(self, diameter: Array) -> Array:
        """alpha of API RP 2GEO averaged over the clay in the top 20 diameters, shape (n,)."""
        widths, back = np.unique(diameter, return_inverse=True)
        mean = []
        for width in widths.tolist():
            z, share = self._depths_to(_WEDGE * width)
            su = self._strength.whole.at(z)
            ratio = np.ones(len(z))
            friction = alpha_friction(su, self.effective_overburden(z, "p-y"))
            np.divide(friction, su, out=ratio, where=su > 0.0)
            clay = self._strength.presence.at(z) * share
            mean.append(float(ratio @ clay / clay.sum()) if clay.any() else 1.0)
        return np.array(mean)[back]

    def _depths_to(self, reach: float) -> tuple[Array, Array]:
        """Depths from the mudline to `reach`, many in each layer, and the length of each, m."""
        edges = np.append(self._layers.top[self._layers.top < reach], reach)
        # friction starts as the fourth root of depth: points crowd at the top of each layer
        t, thickness = (np.arange(_SAMPLES) + 0.5) / _SAMPLES, np.diff(edges)[:, None]
        z = edges[:-1, None] + thickness * t**4
        return z.ravel(), (thickness * 4.0 * t**3 / _SAMPLES).ravel()

    def depth_in_rock(self, depth: Array) -> Array:
        """Depth below the surface of the rock that a point lies in, 0 above it, m."""
        top = self._rock_top[self._layers.index(depth)]
        return np.where(np.isfinite(top), np.maximum(depth - top, 0.0), 0.0)

    def _tops_of_rock(self) -> Array:
        """Depth at which the rock of each layer starts; inf where it is none, (layers,)."""
        tops = np.full(len(self._layers.top), np.inf)
        for layer, (upper, lower) in enumerate(self._layers.ends):
            both = (self._curves["p-y"][upper], self._curves["p-y"][lower])
            if all(curve is not None and curve.law == _ROCK for curve in both):
                above = tops[layer - 1] if layer else np.inf
                tops[layer] = min(float(above), float(self._layers.top[layer]))
        return tops

    def embedded_length(self) -> float:
        """Length of the tube below the mudline, m."""
        if self._embedded_length is None:
            raise InvalidData("the law needs the embedded length of the tube, which is unknown")
        return self._embedded_length


_Given = Callable[[Surroundings, Family, Array, Array], Array | float]

#: Every quantity by the name of the laws' fields that take it.
_GIVEN: Mapping[str, _Given] = MappingProxyType(
    {
        "effective_overburden": lambda s, family, z, _: s.effective_overburden(z, family),
        "mean_undrained_shear_strength": lambda s, _f, z, _d: s.mean_strength(z),
        "mudline_strength": lambda s, _f, _z, d: s.strength_line(d)[0],
        "strength_gradient": lambda s, _f, _z, d: s.strength_line(d)[1],
        "adhesion": lambda s, _f, _z, d: s.adhesion(d),
        "depth_in_rock": lambda s, _f, z, _d: s.depth_in_rock(z),
        "embedded_length": lambda s, _f, _z, _d: s.embedded_length(),
    }
)


def _given(name: str, *families: Sequence[Curve | None]) -> list[float]:
    """A parameter at every depth from the first of the families whose curve has it; else NaN."""
    return [
        next((c.parameters[name] for c in curves if c and name in c.parameters), np.nan)
        for curves in zip(*families, strict=True)
    ]
