"""Which depth, overburden and mean strength a p-y law takes in a ground layered by Georgiadis.

A layer's soil is taken to reach to the mudline, where its top lies at the equivalent depth h_i of
`layering`. A point at depth z in it has the equivalent depth z_eq = z + h_i - H_i, H_i being the
depth of the layer's top. In the law

    depth              z_eq: in pu, in the transition depth and in factors of depth over diameter
    stiffness_depth    z: in the initial stiffness k z, which soil above does not change
    s'v                OWN: of the layer's own weight above its top, g'_top h_i + int g' from H_i
                       to z (Georgiadis' reading); ACTUAL: the true one
    mean su            su_top h_i + int su from H_i to z, over z_eq

Rock, ISO's clay, PISA and user curves have no equivalent depth: they stay, and count for the layers
below with what they resist at most.

Source: Georgiadis, Development of p-y curves for layered soils, ASCE (1983); that k z takes the
true depth is the practice of programs, not of that paper.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ..arrays import Array, Index
from ..errors import Fault, UserError
from ..scene import Curve, Ground
from .law import LayeredLaw
from .layering import Layer, depth_shifts
from .layers import Layers
from .surroundings import STRENGTH, Surroundings

#: A law of a curve from what it is given by name.
Make = Callable[[Curve, dict[str, Any]], LayeredLaw | None]
#: Largest |p| at depths along a tube of given diameters.
Capacity = Callable[[Array, Array], Array]


class EquivalentDepths:
    """Equivalent depths of a ground's layers; shifts depend on the diameter, and are kept.

    curves: p-y curve at each depth of the ground. make: the law of a curve, None where it has no
    equivalent depth. capacity: what such curves resist with.
    """

    def __init__(
        self,
        ground: Ground,
        layers: Layers,
        curves: Sequence[Curve | None],
        make: Make,
        capacity: Capacity,
        around: Surroundings,
    ) -> None:
        self._actual = ground.layering_overburden == "ACTUAL"
        self._layers, self._make, self._capacity = layers, make, capacity
        self._around = around
        self._weight, self._strength = around.weight.whole, around.strength.whole
        self._ends = [(curves[a], curves[b]) for a, b in layers.ends]
        self._shifts: dict[float, Array] = {}
        for layer, (upper, lower) in enumerate(self._ends):
            if _kind(upper) != _kind(lower):
                top, bottom = layers.top[layer], layers.top[layer] + layers.thickness[layer]
                raise UserError(
                    Fault(
                        f"LAYERING=GEORGIADIS needs one law in each layer, but from {top:g} to "
                        f"{bottom:g} m below the mudline p-y curves of two laws are blended",
                        "give that depth twice in *GROUNDEPTH, for a jump between the curves",
                    )
                )

    def given(
        self, layer: Index, depth: Array, diameter: Array, parameters: Mapping[str, Array]
    ) -> dict[str, Array]:
        """What a law at points of layers takes in place of depth, overburden and mean strength.

        layer, depth, diameter: shape (n,). parameters: of the curve there.
        """
        widths, back = np.unique(diameter, return_inverse=True)
        shift = np.array([self.shifts(width) for width in widths.tolist()])[back, layer]
        found = self._found(layer, depth, depth + shift, STRENGTH in parameters)
        if self._actual:
            found["effective_overburden"] = self._around.effective_overburden(depth, "p-y")
        return found

    def shifts(self, diameter: float) -> Array:
        """Equivalent less actual depth of each layer for a diameter, m, shape (layers,)."""
        if diameter not in self._shifts:
            column = [self._layer(i, diameter) for i in range(len(self._ends))]
            self._shifts[diameter] = depth_shifts(column)
        return self._shifts[diameter]

    def _found(self, layer: Index, z: Array, equivalent: Array, clay: bool) -> dict[str, Array]:
        """Depths, own overburden and mean strength of points at actual and equivalent depths."""
        top = self._layers.top[layer]
        above = equivalent - (z - top)
        weight, strength = self._weight, self._strength
        own = weight.ends[0, layer] * above + weight.integral(z) - weight.integral(top)
        found = {"depth": equivalent, "stiffness_depth": z, "effective_overburden": own}
        if clay:
            first = strength.ends[0, layer]
            whole = first * above + strength.integral(z) - strength.integral(top)
            mean = np.array(np.broadcast_to(first, whole.shape), dtype=float)
            np.divide(whole, equivalent, out=mean, where=equivalent > 0.0)
            found["mean_undrained_shear_strength"] = mean
        return found

    def _layer(self, layer: int, diameter: float) -> Layer:
        """A layer as the layering sees it, for a tube of a diameter."""
        upper, lower = self._ends[layer]
        top = float(self._layers.top[layer])
        bottom = float(np.append(self._layers.top, np.inf)[layer + 1])
        if upper is None or lower is None:
            return Layer(top=top, bottom=bottom, ultimate=None)

        def width(z: Array) -> Array:
            return np.full(len(z), diameter)

        def resistance(z: Array, equivalent: Array) -> Array:
            share = (z - top) / self._layers.thickness[layer]
            parameters = {
                name: value + share * (lower.parameters.get(name, value) - value)
                for name, value in upper.parameters.items()
            }
            index = np.full(len(z), layer)
            found = self._found(index, z, equivalent, STRENGTH in parameters)
            whole = {"diameter": width(z), **parameters, "multiplier": 1.0, **upper.options}
            law = self._make(upper, {**whole, **found})
            assert law is not None
            return np.broadcast_to(law.layering_resistance, z.shape)

        def on_top(equivalent: Array) -> Array:
            """Of the soil at the layer's top, as if it reached from the mudline."""
            return resistance(np.full(len(equivalent), top), equivalent)

        trial = {"diameter": width(np.ones(1)), **upper.parameters, **upper.options}
        here = self._found(np.array([layer]), np.array([top]), np.ones(1), True)
        if self._make(upper, {**trial, **here}) is None:
            return Layer(
                top=top,
                bottom=bottom,
                ultimate=None,
                inside=lambda _, z: self._capacity(np.nextafter(z, np.inf), width(z)),
            )
        return Layer(top=top, bottom=bottom, ultimate=on_top, inside=lambda h, z: resistance(z, h))


def _kind(curve: Curve | None) -> object:
    """What must agree at both ends of a layer."""
    if curve is None:
        return None
    return ("user", curve.id) if curve.rows else curve.law
