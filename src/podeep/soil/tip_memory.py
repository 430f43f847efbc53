"""A tip under cycles: it settles under compression, and lifts off without tension."""

from typing import ClassVar

import numpy as np

from ..arrays import Array
from .energy import energy
from .memory import Backbone, Memory


class Settling(Memory):
    """A reaction to compression alone that unloads along its initial slope.

        q = f(w)                              at the largest w so far, a, and beyond
        q = max(0, f(a) - k (a - w))          below it, k = f'(0)

    What compressed it comes back along k, then the tip stands off; it bears again where it lifted
    off, and goes on along the backbone from a.

    backbone f: 0 for w < 0, of a tangent that never exceeds k.

    Source: the usual elastic-plastic reading of Q-z; API RP 2GEO 8.4.3 has no rule for unloading
    but that a tip takes no tension.
    """

    kept: ClassVar[tuple[str, ...]] = ("lowest", "peak")

    def __init__(self, backbone: Backbone, size: int) -> None:
        self.backbone = backbone
        self.lowest, self.peak = np.zeros(size), np.zeros(size)
        self.slope = np.array(np.broadcast_to(backbone.evaluate(np.zeros(size))[1], size))

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, stiffness = self.backbone.evaluate(np.maximum(u, self.lowest))
        back = self.peak - self.slope * (self.lowest - u)
        above = u < self.lowest
        force = np.where(above, np.maximum(back, 0.0), force)
        return force, np.where(above, np.where(back > 0.0, self.slope, 0.0), stiffness)

    def commit(self, u: Array) -> None:
        self.lowest = np.maximum(self.lowest, u)
        self.peak = self.backbone.evaluate(self.lowest)[0]

    @property
    def dissipated(self) -> Array:
        elastic = np.divide(
            0.5 * np.square(self.peak),
            self.slope,
            out=np.zeros(len(self.peak)),
            where=self.slope > 0.0,
        )
        return energy(self.backbone, self.lowest) - elastic
