"""Unloading through the origin: soil that softens for good and loses nothing in equal cycles."""

from typing import ClassVar

import numpy as np

from ..arrays import Array
from .energy import energy
from .memory import Backbone, Memory


class Secant(Memory):
    """The backbone f where |u| is the largest so far, a; a straight line to the origin below it.

        p = f(u) ,  |u| >= a        p = u f(a) / a ,  |u| < a

    backbone: odd. It may fall. Lost: the work of f up to a, less a f(a)/2.
    Source: the cyclic unloading of FEDEM's springs, read off its regression test.
    """

    kept: ClassVar[tuple[str, ...]] = ("largest", "slope")

    def __init__(self, backbone: Backbone, size: int) -> None:
        self.backbone = backbone
        self.largest, self.slope = np.zeros(size), np.zeros(size)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, stiffness = self.backbone.evaluate(u)
        within = np.abs(u) < self.largest
        return np.where(within, self.slope * u, force), np.where(within, self.slope, stiffness)

    def commit(self, u: Array) -> None:
        further = np.abs(u) > self.largest
        force, _ = self.backbone.evaluate(u)
        self.slope = np.divide(force, u, out=self.slope.copy(), where=further)
        self.largest = np.maximum(self.largest, np.abs(u))

    @property
    def dissipated(self) -> Array:
        return energy(self.backbone, self.largest) - 0.5 * self.slope * np.square(self.largest)
