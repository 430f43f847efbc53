"""Masing's rules on a curve that falls after a peak: what is lost does not come back."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .energy import energy, held
from .masing import Masing
from .memory import Memory, nested, unnested
from .reaction import Reaction


class Degrading(Memory):
    """Masing's rules on the envelope h that keeps the peak of f, times what is left of it.

        p = m(u) f(a)/h(a) ,   a = largest |u| so far, m of Masing's rules on h

    The first loading is f itself. Once a point has slipped past the peak all its loops are smaller
    in the same ratio, down to the residual.

    reaction: its odd laws fall after one peak, or not at all.

    Source: Masing's rules as `Masing`. That strength falls with the largest displacement and for
    good is how a published t-z curve with a residual is read here; no standard gives a rule for
    unloading. Loss by the sum of slip of many small cycles (Randolph 2003) is not in it.
    """

    kept: ClassVar[tuple[str, ...]] = ("ratio",)

    def __init__(self, reaction: Reaction) -> None:
        self.reaction = reaction
        self.masing = Masing(held(reaction), reaction.size)
        self.ratio = np.ones(reaction.size)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, stiffness = self.masing.evaluate(u)
        force, stiffness = self.ratio * force, self.ratio * stiffness
        further = np.abs(u) > self.masing.largest
        if further.any():
            new, slope = self.reaction.evaluate(u)
            return np.where(further, new, force), np.where(further, slope, stiffness)
        return force, stiffness

    def commit(self, u: Array) -> None:
        further = np.abs(u) > self.masing.largest
        self.masing.commit(u, self.ratio)
        if further.any():
            peak, left = self.masing.force, self.reaction.evaluate(u)[0]
            self.ratio = np.divide(left, peak, out=self.ratio.copy(), where=further & (peak != 0.0))

    @property
    def dissipated(self) -> Array:
        a = self.masing.largest
        envelope = self.masing.backbone
        stored = a * envelope.evaluate(a)[0] - energy(envelope, a)
        along = energy(self.reaction, a) - self.ratio * stored
        return self.masing.closed_loops + along + self.ratio * self.masing.open_loops

    def state(self) -> dict[str, Array]:
        return super().state() | nested("masing", self.masing)

    def restore(self, state: Mapping[str, Array]) -> None:
        super().restore(state)
        self.masing.restore(unnested("masing", state))
