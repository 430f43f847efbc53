"""Symmetric matrices in LAPACK's lower band storage, and products that land straight in it."""

from functools import cache

import numpy as np
from scipy import sparse

from ..arrays import Array, Index

try:  # a private name of SciPy, which spares a call what its public product spends on checks
    from scipy.sparse._sparsetools import csc_matvec as _csc_matvec
except ImportError:
    _csc_matvec = None  # type: ignore[assignment]  # the public product is used


def band_place(rows: Index, columns: Index, width: int) -> Index:
    """Position of the entry (row, column), row >= column, in Fortran-order band storage.

    `width` is the number of stored diagonals; the storage has shape (width, n).
    """
    return (rows - columns) + columns * width


@cache
def _lower(size: int) -> tuple[Index, Index]:
    """Row and column of each entry of a lower triangle."""
    return np.tril_indices(size)


def pairs(dofs: Index) -> tuple[Index, Index, Index, Index]:
    """Lower-triangle pairs of the unknowns of each element.

    dofs: shape (elements, local). Returns the local indices i, j of each pair and the global rows
    and columns, shape (elements, pairs), row >= column.
    """
    i, j = _lower(dofs.shape[1])
    first, second = dofs[:, i], dofs[:, j]
    return i, j, np.maximum(first, second), np.minimum(first, second)


def bandwidth(dofs: Index) -> int:
    """Stored diagonals of the matrix that these elements fill."""
    return int((dofs.max(axis=1) - dofs.min(axis=1)).max()) + 1


def scatter(place: Index, values: Array, size: int) -> Array:
    """Sum values at their places in a flat storage of the given size."""
    return np.bincount(place.ravel(), values.ravel(), size).astype(np.float64, copy=False)


def general_band(lower: Array) -> Array:
    """A symmetric matrix as LAPACK's general band storage, with the room that pivots need.

    lower: lower band, shape (width, n). Returns shape (3 width - 2, n), Fortran order.
    """
    width, n = lower.shape
    whole = np.zeros((3 * width - 2, n), order="F")
    middle = 2 * (width - 1)
    whole[middle:] = lower
    for d in range(1, width):
        whole[middle - d, d:] = lower[d, : n - d]
    return whole


def add_product(matrix: sparse.csc_array, x: Array, total: Array) -> None:
    """Add matrix @ x to a total, in place."""
    if _csc_matvec is None:
        total += matrix @ x
    else:
        rows, columns = matrix.shape
        _csc_matvec(rows, columns, matrix.indptr, matrix.indices, matrix.data, x, total)
