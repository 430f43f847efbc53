"""The lowest natural frequencies of two symmetric matrices in band storage.

    K phi = lambda M phi

is solved as M phi = mu (K + s M) phi, whose largest mu = 1 / (lambda + s) are wanted. A shift s > 0
takes tubes that nothing holds, and no rounding of the highest frequencies reaches the lowest. Small
matrices are solved whole, large ones by Lanczos' method (Ericsson & Ruhe, Math. Comp. 35 (1980)).
"""

import numpy as np
from scipy import sparse
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded, eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from ..arrays import Array
from ..beam.band import dense

_WHOLE = 500  # unknowns up to which matrices are solved whole
_TRIES = 8  # shifts, each a hundred times the one before
_MASSLESS = 1e-12  # of the largest mu: below it a motion has no mass


def lowest(stiffness: Array, mass: Array, count: int, shift: float) -> tuple[Array, Array]:
    """The `count` lowest eigenvalues, (n,), and their vectors as rows, (n, size).

    stiffness, mass: lower bands, shape (width, size), the mass without held unknowns. shift: of
    the size of the lowest eigenvalue that is not zero, 1/s2. There are fewer than `count` where
    fewer motions have mass. Raises LinAlgError where the stiffness is not bounded below.
    """
    shift, factor = shifted(stiffness, mass, shift)
    size = stiffness.shape[1]
    count = min(count, size)
    if size <= _WHOLE or count > size // 4:
        pencil = dense(mass), dense(stiffness + shift * mass)
        mu, vectors = eigh(*pencil, subset_by_index=(size - count, size - 1))
        vectors = vectors.T
    else:
        solve = LinearOperator((size, size), lambda b: cho_solve_banded((factor, True), b))
        heavy = sparse.csr_array(whole_sparse(mass))
        values, vectors = eigsh(
            *(heavy, count, heavy, -shift), OPinv=solve, v0=np.linspace(1.0, 2.0, size)
        )
        mu, vectors = 1.0 / (values + shift), vectors.T
    order = np.argsort(-mu)
    order = order[mu[order] > _MASSLESS * mu.max()]
    return 1.0 / mu[order] - shift, vectors[order]


def shifted(stiffness: Array, mass: Array, shift: float) -> tuple[float, Array]:
    """The first of rising shifts with which the matrix is positive definite, and its factor."""
    for _ in range(_TRIES):
        try:
            return shift, cholesky_banded(stiffness + shift * mass, lower=True)
        except LinAlgError:
            shift *= 100.0
    raise LinAlgError("the stiffness has no bound below")


def whole_sparse(lower: Array) -> sparse.dia_array:
    """A symmetric matrix from its lower band."""
    width, size = lower.shape
    below = sparse.dia_array((lower, -np.arange(width)), shape=(size, size))
    above = sparse.dia_array((lower[1:], -np.arange(1, width)), shape=(size, size)).T
    return sparse.dia_array(below + above)
