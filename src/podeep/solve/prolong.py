"""States on one mesh as they are on a finer one."""

import numpy as np

from ..arrays import Array
from ..beam.field import Field
from ..model.results import product


def prolong(q: Array, coarse: Field, fine: Field, components: int) -> Array:
    """The same states in the elements of a finer field of at least the same degree.

    q: shape (states, unknowns of the coarse field). The fine field's edges hold those of the coarse
    one. Nodal values are taken over, internal ones fitted to what is left, which is exact.
    """
    given = np.moveaxis(q.reshape(len(q), -1, components), 2, 1)
    rows = np.zeros((len(q), components, fine.size))
    elements, count = fine.dofs.shape
    share = (np.arange(count) + 0.5) / count
    ends = np.concatenate([fine.tops, fine.tops + fine.lengths])
    inside = (fine.tops[:, None] + fine.lengths[:, None] * share).ravel()
    tube = fine.strings.leader
    both, of = np.tile(tube, 2), np.repeat(tube, count)
    nodes, inner = fine.dofs[:, [0, -fine.nodal]].T.ravel(), slice(fine.nodal, -fine.nodal)
    whole = coarse.interpolation(np.concatenate([ends, inside]), 0, np.concatenate([both, of]))
    rows[..., nodes], known = np.split(product(given, whole), [len(ends)], axis=-1)
    if fine.nodal == 2:
        turned = product(given, coarse.rotation(ends, both))
        rows[..., nodes + 1] = fine.slope_length * turned
    if fine.local > 2 * fine.nodal:
        matrix = fine.interpolation(inside, 0, of)
        left = known - product(rows, matrix)
        functions = matrix.shares.reshape(elements, count, count)[..., inner]
        fit = np.linalg.pinv(functions)
        rest = left.reshape(len(q), components, elements, count)
        rows[..., fine.dofs[:, inner]] = np.einsum("eig,sceg->scei", fit, rest)
    return np.moveaxis(rows, 1, 2).reshape(len(q), -1)
