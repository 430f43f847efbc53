"""Linear springs to ground at single unknowns of a field, and between two of them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..arrays import Array, Index
from ..beam.band import band_place


@dataclass(frozen=True)
class Spring:
    """A linear spring to ground at one unknown, N/m in the field's scaling.

    softens: its stiffness is multiplied by the system's `softening`. other: an unknown whose
    motion makes this force at `dof`, as that of `dof` does there; None is `dof` alone.
    """

    dof: int
    stiffness: float
    softens: bool = False
    other: int | None = None


@dataclass(frozen=True, eq=False)
class Springs:
    """All springs of a system: their matrix is `diagonal` and, off it, the coupled terms.

    diagonal, soft: shape (size,), soft being the part that softens. rows, columns, amounts: of the
    terms below the diagonal.
    """

    diagonal: Array
    soft: Array
    rows: Index
    columns: Index
    amounts: Array

    @cached_property
    def any(self) -> bool:
        return bool(self.diagonal.any() or len(self.amounts))

    def forces(self, q: Array) -> Array:
        """Forces at all unknowns, shape (..., size), for states q of that shape."""
        total = np.asarray(self.diagonal * q)
        for row, column, amount in zip(self.rows, self.columns, self.amounts, strict=True):
            total[..., row] += amount * q[..., column]
            total[..., column] += amount * q[..., row]
        return total

    def add_to(self, band: Array, width: int) -> None:
        """Add them to a flat lower band of so many stored diagonals, in place."""
        band[::width] += self.diagonal
        np.add.at(band, band_place(self.rows, self.columns, width), self.amounts)

    def stiffer(self, change: Array) -> "Springs":
        """The same with other terms on the diagonal, N/m."""
        return replace(self, diagonal=self.diagonal + change)


def springs_of(springs: Sequence[Spring], size: int) -> Springs:
    """Springs gathered by the unknowns of a system of this size."""
    own = [s for s in springs if s.other is None]
    soft = [s for s in own if s.softens]
    coupled = [s for s in springs if s.other is not None]
    pairs = np.array([(s.dof, s.other) for s in coupled], dtype=np.intp).reshape(-1, 2)
    return Springs(
        _sums(own, size),
        _sums(soft, size),
        pairs.max(axis=1),
        pairs.min(axis=1),
        np.array([s.stiffness for s in coupled], dtype=np.float64),
    )


def _sums(springs: Sequence[Spring], size: int) -> Array:
    """Stiffness at each unknown, shape (size,)."""
    total = np.zeros(size)
    np.add.at(total, [s.dof for s in springs], [s.stiffness for s in springs])
    return total
