"""Where reactions act on a field."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field, Motion
from ..beam.rows import Rows
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

    def rows(self, field: Field) -> Rows:
        """Matrix (points, unknowns) from the unknowns to the motion at each point."""
        own = field.motion(self.x, self.motion, self.tube)
        if self.against is None:
            return own
        other = field.motion(self.x, self.motion, self.against)
        dofs = np.concatenate([own.dofs, other.dofs], axis=1)
        return Rows(dofs, np.concatenate([own.shares, -other.shares], axis=1), field.size)
