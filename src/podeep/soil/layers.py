"""The layers between the depths of a ground, and quantities that vary linearly within each."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array, Index


class Layers:
    """Intervals between depths below the mudline (m, from 0, not falling), the last one endless.

    A depth given twice is a jump: its second entry heads the layer below, its first ends the one
    above. A boundary belongs to the layer above it. `ends` holds, for each layer, the entries of
    the depths at its top and its bottom; the last layer has its own top's entry for both.
    """

    def __init__(self, depths: Sequence[float]) -> None:
        self.top = np.unique(np.array(depths, dtype=float))
        self.thickness = np.append(np.diff(self.top), np.inf)
        self.boundaries: tuple[float, ...] = tuple(self.top[1:].tolist())
        first = np.searchsorted(depths, self.top, side="left")
        last = np.searchsorted(depths, self.top, side="right") - 1
        self.ends: list[tuple[int, int]] = list(
            zip(last.tolist(), [*first[1:].tolist(), int(last[-1])], strict=True)
        )

    def index(self, depth: Array) -> Index:
        """Index of the layer of each depth, from 0."""
        return self.top[1:].searchsorted(depth, side="left")

    def share(self, depth: Array) -> Array:
        """How far down in its layer each depth lies, 0 to 1; 0 in the endless one."""
        layer = self.index(depth)
        return np.asarray((depth - self.top[layer]) / self.thickness[layer])

    def spread(self, values: Sequence[float]) -> "Spread":
        """A quantity given at every depth of the ground; NaN where it is unknown."""
        return Spread(self, np.asarray(np.array(values, dtype=float)[np.array(self.ends).T]))


@dataclass(frozen=True, eq=False)
class Spread:
    """A quantity linear in each layer: `ends`, its values at tops and bottoms, (2, layers)."""

    layers: Layers
    ends: Array

    @cached_property
    def whole(self) -> "Spread":
        """The same with 0 in every layer that does not know it at both ends."""
        return Spread(self.layers, np.where(np.isnan(self.ends).any(axis=0), 0.0, self.ends))

    @cached_property
    def presence(self) -> "Spread":
        """1 in the layers that know the quantity, 0 in the others."""
        known = ~np.isnan(self.ends).any(axis=0)
        return Spread(self.layers, np.stack([known, known]).astype(float))

    def at(self, depth: Array) -> Array:
        """Values at depths, shape (n,)."""
        layer = self.layers.index(depth)
        top, bottom = self.ends[:, layer]
        return np.asarray(top + self.layers.share(depth) * (bottom - top))

    @cached_property
    def _sums(self) -> tuple[Array, Array]:
        """Half the rise with depth in each layer, and the integral down to its top, (layers,)."""
        thickness = self.layers.thickness
        rise = (self.ends[1] - self.ends[0]) / thickness
        whole = self.ends.mean(axis=0)[:-1] * thickness[:-1]
        return 0.5 * rise, np.concatenate(([0.0], np.cumsum(whole)))

    def integral(self, depth: Array) -> Array:
        """Integrals from the mudline to depths, shape (n,)."""
        depth = np.asarray(depth, dtype=float)
        half_rise, above = self._sums
        layer = self.layers.index(depth)
        inside = depth - self.layers.top[layer]
        mean = self.ends[0, layer] + half_rise[layer] * inside
        partial = np.multiply(inside, mean, out=np.zeros(depth.shape), where=inside > 0.0)
        return np.asarray(above[layer] + partial)
