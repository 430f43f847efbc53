"""A displacement field over the elements of one tube: degrees of freedom, interpolation, energy.

The same class is the deflection of a beam (continuity 1, stiffness EI) and its stretch
(continuity 0, stiffness EA). Its coordinate x is the depth below the mudline, positive down and
negative above it. Slope degrees of freedom are multiplied by `slope_length`, so that every
generalised force is in newtons and the equations are evenly scaled.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from ..arrays import Array, Index
from .shapes import gauss_points, nodal_functions, shape_functions


@dataclass(frozen=True)
class Field:
    """One scalar displacement, piecewise polynomial.

    edges: element boundaries, shape (elements + 1,), rising, m. stiffness: EI (N m2) or EA (N) of
    each element. `dofs` numbers the unknowns from the top down; internal unknowns of an element
    stand between those of its two nodes, which keeps the band as narrow as it can be.
    """

    edges: Array
    stiffness: Array
    degree: int
    continuity: int
    slope_length: float = 1.0

    @cached_property
    def lengths(self) -> Array:
        return np.diff(self.edges)

    @cached_property
    def nodal(self) -> int:
        """Unknowns of a node."""
        return nodal_functions(self.continuity)

    @cached_property
    def local(self) -> int:
        """Unknowns of an element, its two nodes included."""
        return self.degree + 1

    @cached_property
    def dofs(self) -> Index:
        """Unknowns of each element, shape (elements, local)."""
        first = np.arange(len(self.lengths)) * (self.local - self.nodal)
        return first[:, None] + np.arange(self.local)

    @cached_property
    def size(self) -> int:
        return int(self.dofs[-1, -1]) + 1

    def node(self, x: float) -> int:
        """First unknown (the value) of the node nearest to x; slopes follow it."""
        index = int(np.argmin(np.abs(self.edges - x)))
        return index * (self.local - self.nodal)

    @cached_property
    def scale(self) -> Array:
        """Factor from an unknown to its function on the reference element, (elements, local)."""
        scale = np.ones((len(self.lengths), self.local))
        if self.continuity == 1:
            slope = (0.5 / self.slope_length) * self.lengths
            scale[:, 1] = slope
            scale[:, -1] = slope
        return scale

    def elements(self, x: Array) -> Index:
        """Element that holds each x; a shared edge belongs to the element above it."""
        inner = np.searchsorted(self.edges[1:-1], x, side="left")
        return np.asarray(inner, dtype=np.intp)

    def interpolation(self, x: Array, derivative: int = 0) -> sparse.csr_array:
        """Matrix (len(x), size) from unknowns to the field, or a derivative d/dx of it, at x."""
        element = self.elements(x)
        half = 0.5 * self.lengths[element]
        xi = (x - self.edges[element]) / half - 1.0
        values = shape_functions(xi, self.continuity, self.degree, derivative)
        values *= self.scale[element] / half[:, None] ** derivative
        pointers = np.arange(len(x) + 1) * self.local
        return sparse.csr_array(
            (values.ravel(), self.dofs[element].ravel(), pointers), shape=(len(x), self.size)
        )

    @cached_property
    def strain_modes(self) -> tuple[sparse.csr_array, Array]:
        """Matrix to the Legendre coefficients of strain, and the stiffness of each (N m or N).

        Internal forces through them are in exact balance in every element, however short it is:
        rounding of the unknowns makes couples, not forces.
        """
        order = self.continuity + 1
        count = self.local - order
        xi, weight = gauss_points(self.degree + 1)
        strain = shape_functions(xi, self.continuity, self.degree, order)
        legendre = np.polynomial.legendre.legvander(xi, count - 1)
        share = np.arange(count) + 0.5
        modes = (legendre * weight[:, None]).T @ strain * share[:, None]
        modes[np.abs(modes) < 1e-13] = 0.0
        half = 0.5 * self.lengths
        values = modes * self.scale[:, None, :] / half[:, None, None] ** order
        rows = np.arange(len(half) * count).reshape(len(half), count)
        places = (
            np.broadcast_to(rows[:, :, None], values.shape).ravel(),
            np.broadcast_to(self.dofs[:, None, :], values.shape).ravel(),
        )
        matrix = sparse.coo_array((values.ravel(), places), shape=(rows.size, self.size))
        stiffness = (self.stiffness * half)[:, None] / share
        return sparse.csr_array(matrix), stiffness.ravel()

    @cached_property
    def element_stiffness(self) -> Array:
        """Matrices of the strain energy, shape (elements, local, local), N/m."""
        order = self.continuity + 1
        xi, weight = gauss_points(self.degree + 1)
        strain = shape_functions(xi, self.continuity, self.degree, order)
        reference = (strain * weight[:, None]).T @ strain
        factor = self.stiffness / (0.5 * self.lengths) ** (2 * order - 1)
        scale = self.scale
        matrices = factor[:, None, None] * reference
        matrices *= scale[:, :, None] * scale[:, None, :]
        return np.asarray(matrices, dtype=np.float64)
