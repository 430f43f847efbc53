"""The tangent with the load factor as one more unknown, and one more equation that says how far.

    K dq - p dl = r        p: what the loads grow by for each unit of the load factor l
    n dq + c dl = g

K is singular at a peak and on a flat residual branch, this matrix is not. It is solved from the
band of K with one stiff spring added, which takes the singularity away, by two right-hand sides
more than the residual's: that of p, and that of the spring, which is taken out again.
"""

import numpy as np
from scipy.linalg import lapack

from ..arrays import Array
from ..beam.band import general_band
from ..model.system import System


class Bordered:
    """Factors of the matrix at the last `internal` of a system; `sign` is that of its determinant.

    pull: p, with what the held unknowns move by in their places, shape (n,). row, corner: n and c.
    sign is 0 where the matrix is singular; then `solve` has no answer.
    """

    def __init__(self, system: System, pull: Array, row: Array, corner: float) -> None:
        self.row = row
        self.at = int(np.argmax(np.abs(row)))
        self.spring = float(system.diagonal[self.at])
        lower = system.tangent()
        below = lower.shape[0] - 1
        lower[0, self.at] += self.spring
        self.below = below
        self.factors, self.pivots, info = lapack.dgbtrf(general_band(lower), below, below)
        self.sign = 0.0
        if info != 0 or not np.isfinite(pull).all():
            return
        unit = np.zeros(len(row))
        unit[self.at] = 1.0
        self.moves = self._band_solve(np.column_stack([pull, unit]))
        along = self.row @ self.moves
        self.small = np.array(
            [
                [corner + along[0], along[1]],
                [self.moves[self.at, 0], self.moves[self.at, 1] - 1.0 / self.spring],
            ]
        )
        small = self.small[0, 0] * self.small[1, 1] - self.small[0, 1] * self.small[1, 0]
        swapped = np.count_nonzero(self.pivots != np.arange(len(row)))
        negative = np.count_nonzero(self.factors[2 * below] < 0.0)
        if np.isfinite(small):
            self.sign = -float(np.sign(small)) * (-1.0) ** (swapped + negative)

    def solve(self, residual: Array, gap: float) -> tuple[Array, float]:
        """The step of unknowns and load factor that removes a residual and a gap."""
        own = self._band_solve(residual[:, None])[:, 0]
        right = np.array([gap - self.row @ own, -own[self.at]])
        factor, spring = np.linalg.solve(self.small, right)
        return own + self.moves @ np.array([factor, spring]), float(factor)

    def _band_solve(self, right: Array) -> Array:
        x, _ = lapack.dgbtrs(self.factors, self.below, self.below, right, self.pivots)
        return np.asarray(x)
