"""Symmetric matrices in LAPACK's lower band storage, and products that land straight in it."""

from collections.abc import Callable
from functools import cache, partial
from typing import TypeAlias

import numpy as np
from scipy import sparse
from scipy.linalg import blas

from ..arrays import Array, Index

_DENSE = 120  # unknowns up to which a whole matrix is faster than its band (overhead of a call)

Times: TypeAlias = Callable[[Array], Array]

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


def element_band(dofs: Index, matrices: Array, width: int, shape: tuple[int, int]) -> Array:
    """Symmetric matrices of elements, summed to one as flat band storage of a given width.

    dofs: shape (elements, local). matrices: (elements, local, local). shape: how many unknowns
    there are, and how many components they interleave: each has the same matrices.
    """
    unknowns, components = shape
    i, j, rows, columns = pairs(dofs)
    entries, size = matrices[:, i, j], width * unknowns * components
    total = np.zeros(size)
    for c in range(components):
        place = band_place(rows * components + c, columns * components + c, width)
        total += scatter(place, entries, size)
    return total


def band_times(band: Array, x: Array) -> Array:
    """Product of a symmetric matrix and a vector; band: its lower one, shape (width, n)."""
    return np.asarray(blas.dsbmv(band.shape[0] - 1, 1.0, band, x, lower=1))


def dense(band: Array) -> Array:
    """The whole of a symmetric matrix, (n, n), from its lower band, (width, n)."""
    width, n = band.shape
    whole = np.zeros((n, n))
    for d in range(min(width, n)):
        at = np.arange(n - d)
        whole[at + d, at] = whole[at, at + d] = band[d, : n - d]
    return whole


def times(band: Array) -> Times:
    """Products of a symmetric matrix, lower band (width, n), with vectors, as fast as they go."""
    if not band.any():
        return np.zeros_like
    if band.shape[1] <= _DENSE:
        return dense(band).dot
    return partial(band_times, band)


def without(band: Array, dofs: Index) -> Array:
    """A symmetric matrix whose rows and columns of some unknowns are zero, (width, n)."""
    width, n = band.shape
    left = np.ones(n + width - 1)
    left[dofs] = 0.0
    rows = np.arange(width)[:, None] + np.arange(n)
    return np.asfortranarray(band * left[rows] * left[:n])


def general_band(lower: Array, transposed: Array | None = None) -> Array:
    """A matrix as LAPACK's general band storage, with the room that pivots need.

    lower: its lower band, shape (width, n); transposed: that of its transpose, None where it is
    symmetric. Returns shape (3 width - 2, n), Fortran order.
    """
    width, n = lower.shape
    upper = lower if transposed is None else transposed
    whole = np.zeros((3 * width - 2, n), order="F")
    middle = 2 * (width - 1)
    whole[middle:] = lower
    for d in range(1, width):
        whole[middle - d, d:] = upper[d, : n - d]
    return whole


def add_product(matrix: sparse.csc_array, x: Array, total: Array) -> None:
    """Add matrix @ x to a total, in place."""
    if _csc_matvec is None:
        total += matrix @ x
    else:
        rows, columns = matrix.shape
        _csc_matvec(rows, columns, matrix.indptr, matrix.indices, matrix.data, x, total)
