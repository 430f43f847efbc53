"""Where reactions act on a field."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..soil.reaction import Reaction
from .contact import Friction


@dataclass(frozen=True)
class Points:
    """Where a reaction acts on a field: depths x (m), weights (m; 1 for a tip), and the law.

    motion: what the reaction resists: the field by a force, its slope or the rotation of the
    section by a moment. follows: place of the points, as many, whose current |reaction| scales
    this one; None: nothing does. spread: the reaction acts along the field, not at one end of it.
    compressed: the reaction is that of the normal force, which every step gives anew. tube: number
    of the tube that it acts on, one or for each point. against: the tube whose motion is taken off
    and on which the opposite acts; None is the ground.
    """

    x: Array
    weight: Array
    reaction: Reaction
    motion: Motion = "value"
    follows: int | None = None
    spread: bool = True
    compressed: bool = False
    tube: Index | int = 0
    against: int | None = None

    @property
    def friction(self) -> Friction | None:
        """The friction of tubes against each other, if that is what acts."""
        law = self.reaction.laws[0].law if self.reaction.laws else None
        return law if isinstance(law, Friction) else None

    def matrix(self, field: Field) -> sparse.csr_array:
        """From the unknowns to the motion at each point, (points, unknowns)."""
        return stacked([self.rows(field)], field.size)

    def rows(self, field: Field) -> tuple[Index, Array]:
        """Unknowns that the motion at each point consists of, and their shares, (points, n)."""
        matrices = [field.motion(self.x, self.motion, self.tube)]
        if self.against is not None:
            matrices.append(-field.motion(self.x, self.motion, self.against))
        shape = len(self.x), field.local
        split = [(m.indices.reshape(shape), m.data.reshape(shape)) for m in matrices]
        dofs, shares = (np.concatenate(parts, axis=1) for parts in zip(*split, strict=True))
        return dofs.astype(np.intp), shares


def stacked(rows: Sequence[tuple[Index, Array]], size: int) -> sparse.csr_array:
    """Matrix from the unknowns to the motions at all points."""
    matrices = [
        sparse.csr_array((v.ravel(), d.ravel(), np.arange(len(d) + 1) * d.shape[1]), (len(d), size))
        for d, v in rows
    ]
    return sparse.csr_array(sparse.vstack([sparse.csr_array((0, size)), *matrices]))
