"""Quantities that each consist of a few unknowns of a field: the rows of a sparse matrix."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Array, Index

_DENSE = 40_000  # entries below which a dense product beats a sparse one (call overhead)


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """A matrix (n, size) by its rows: unknowns and the share of each, both of shape (n, k).

    Shares of an unknown that stands twice in a row add up.
    """

    dofs: Index
    shares: Array
    size: int

    def __matmul__(self, unknowns: Array) -> Array:
        """The product with unknowns of shape (size,) or (size, columns)."""
        if len(self.dofs) * self.size <= _DENSE:
            return np.asarray(self.toarray() @ unknowns)
        return np.asarray(np.einsum("nk,nk...->n...", self.shares, unknowns[self.dofs]))

    def toarray(self) -> Array:
        """The whole matrix."""
        count = len(self.dofs)
        place = self.dofs + (np.arange(count) * self.size)[:, None]
        whole = np.bincount(place.ravel(), self.shares.ravel(), count * self.size)
        return whole.astype(np.float64, copy=False).reshape(count, self.size)


def stacked(parts: Sequence[Rows], size: int) -> sparse.csr_array | Array:
    """The rows of all parts as one matrix of the kind that multiplies fastest."""
    count = sum(len(part.dofs) for part in parts)
    if count * size <= _DENSE:
        return np.concatenate([np.zeros((0, size)), *(part.toarray() for part in parts)])
    widths = np.concatenate([np.full(len(part.dofs), part.dofs.shape[1]) for part in parts])
    dofs = np.concatenate([part.dofs.ravel() for part in parts])
    shares = np.concatenate([part.shares.ravel() for part in parts])
    return sparse.csr_array((shares, dofs, np.append(0, np.cumsum(widths))), (count, size))
