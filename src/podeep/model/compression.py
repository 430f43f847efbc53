"""The normal force of a tube as a reaction on its slope: what bends a compressed tube further.

Virtual work of a normal force N (compression positive) on a slope w' is -N w' per length: a moment
against the slope of -N w'.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.law import Law
from ..soil.reaction import Reaction, Term


@dataclass(frozen=True, eq=False)
class Compression(Law):
    """Moment per length -N w', N m/m, against the slope w'; normal_force N at n points."""

    source: ClassVar[str] = "statics: second-order theory of the beam-column (P-delta)"

    normal_force: Array

    @property
    def capacity(self) -> Array:
        return np.full(len(self.normal_force), np.inf)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        modulus = np.broadcast_to(-self.normal_force, u.shape)
        return modulus * u, modulus


def compression(force: Array) -> Reaction:
    """The reaction of a normal force (N) at n points."""
    n = len(force)
    return Reaction(n, (Term(np.arange(n), None, Compression(force), "compression", ()),))
