"""A displacement field over the elements of tubes: degrees of freedom, interpolation, energy.

The same class is the deflection of a beam (continuity 1, stiffness EI) and its stretch
(continuity 0, stiffness EA). Its coordinate x is the depth below the mudline, positive down and
negative above it. Slope degrees of freedom are multiplied by `slope_length`, so that every
generalised force is in newtons and the equations are evenly scaled.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from ..arrays import Array, Index
from .rows import Rows
from .shapes import (
    functions_at_gauss_points,
    gauss_points,
    legendre_integrals,
    nodal_functions,
    shape_functions,
)
from .strings import Strings, chain

Motion = Literal["value", "slope", "rotation"]


@dataclass(frozen=True)
class Field:
    """One scalar displacement of each tube, piecewise polynomial.

    edges: element boundaries, shape (intervals + 1,), rising, m. stiffness: EI (N m2) or EA (N) of
    each element. woven: how the elements of several tubes meet; None is one tube. `dofs` numbers
    the unknowns from the top down.

    shear_stiffness: GAs (N) of each element; None is a tube rigid in shear. With it the second
    unknown of a node is the rotation psi of the section, not the slope. Moment and shear force
    are in balance, GAs (w' - psi) = -EI psi'', so that the deflection's polynomial fixes psi:

        psi = w' + c psi'' = w' + c w^(3) + c^2 w^(5) + ...,   c = EI / GAs

    There is neither locking nor another unknown.
    """

    edges: Array
    stiffness: Array
    degree: int
    continuity: int
    slope_length: float = 1.0
    shear_stiffness: Array | None = None
    woven: Strings | None = None

    @cached_property
    def strings(self) -> Strings:
        return self.woven or chain(len(self.edges) - 1)

    @cached_property
    def tops(self) -> Array:
        """Depth of the top of each element, m."""
        return self.edges[self.strings.interval]

    @cached_property
    def lengths(self) -> Array:
        """Length of each element, m."""
        return np.diff(self.edges)[self.strings.interval]

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
        return self.strings.number(self.nodal, self.local - 2 * self.nodal)

    @cached_property
    def size(self) -> int:
        return int(self.dofs.max()) + 1

    def node(self, x: float, tube: int = 0) -> int:
        """First unknown (the value) of the node of a tube nearest to x; slopes follow it."""
        joint = self.strings.joint(int(np.argmin(np.abs(self.edges - x))), tube)
        element, end = np.argwhere(self.strings.joints == joint)[0]
        return int(self.dofs[element, -self.nodal if end else 0])

    @cached_property
    def scale(self) -> Array:
        """Factor from an unknown to its function on the reference element, (elements, local)."""
        scale = np.ones((len(self.lengths), self.local))
        if self.continuity == 1:
            slope = (0.5 / self.slope_length) * self.lengths
            scale[:, 1] = slope
            scale[:, -1] = slope
        return scale

    def elements(self, x: Array, tube: Index | int = 0) -> Index:
        """Element of a tube that holds each x; a shared edge belongs to the element above it."""
        inner = self.edges[1:-1].searchsorted(x, side="left")
        return self.strings.element(inner, tube)

    @cached_property
    def softness(self) -> Array:
        """c over the square of half an element's length, shape (elements,); 0 if rigid in shear."""
        if self.shear_stiffness is None:
            return np.zeros(len(self.lengths))
        return np.asarray(self.stiffness / self.shear_stiffness / (0.5 * self.lengths) ** 2)

    def _turned(self, xi: Array, element: Index, derivative: int) -> Array:
        """Rotation of unmixed functions, psi times half the element's length, or d/dxi of it.

        xi, element: shape (n,), a point in each element given. Returns shape (n, local).
        """
        softness = self.softness[element][:, None]
        share = np.ones_like(softness)
        total = shape_functions(xi, 1, self.degree, 1 + derivative)
        if self.shear_stiffness is not None:
            for order in range(3 + derivative, self.degree + 1, 2):
                share = share * softness
                total = total + share * shape_functions(xi, 1, self.degree, order)
        return total

    def rotated(self, xi: Array) -> Array:
        """Rotation psi of the functions in use at xi in every element, unscaled, in half elements.

        xi: shape (n,). Returns shape (elements * n, local).
        """
        every, places = self._everywhere(xi)
        return self.mixed(self._turned(places, every, 0), every)

    def _everywhere(self, xi: Array) -> tuple[Index, Array]:
        """Each element with each of some places in it, (elements * n,) both."""
        count = len(self.lengths)
        return np.repeat(np.arange(count), len(xi)), np.tile(xi, count)

    @cached_property
    def mixture(self) -> Array | None:
        """How functions mix for end rotations of 1 and 0 in place of slopes; None if rigid.

        Shape (elements, local, local): a column for each mixed function. Only the functions of
        the nodes' slopes are added to others, which they leave as they are at the ends.
        """
        if self.shear_stiffness is None:
            return None
        every = np.arange(len(self.lengths))
        ends = np.stack(
            [self._turned(np.full(len(every), xi), every, 0) for xi in (-1.0, 1.0)], axis=1
        )
        turning = [1, self.local - 1]
        inverse = np.linalg.inv(ends[:, :, turning])
        mixture = np.tile(np.eye(self.local), (len(every), 1, 1))
        mixture[:, turning] = -inverse @ ends
        mixture[:, :, turning] = 0.0
        for i, row in enumerate(turning):
            mixture[:, row, turning] = inverse[:, i]
        return mixture

    def mixed(self, values: Array, element: Index) -> Array:
        """Values of unmixed functions, shape (n, local), as those of the functions in use."""
        if self.mixture is None:
            return values
        return np.asarray((values[:, None, :] @ self.mixture[element])[:, 0])

    def interpolation(self, x: Array, derivative: int = 0, tube: Index | int = 0) -> Rows:
        """Matrix (len(x), size) from unknowns to the field, or a derivative d/dx of it, at x.

        tube: its number, one or for each x.
        """
        element, xi = self._inside(x, tube)
        values = shape_functions(xi, self.continuity, self.degree, derivative)
        return self._rows(values, element, derivative)

    def rotation(self, x: Array, tube: Index | int = 0) -> Rows:
        """Matrix (len(x), size) from unknowns to the rotation psi of the section at x."""
        element, xi = self._inside(x, tube)
        return self._rows(self._turned(xi, element, 0), element, 1)

    def motion(self, x: Array, motion: Motion, tube: Index | int = 0) -> Rows:
        """Matrix (len(x), size) from unknowns to a motion at x."""
        if motion == "rotation":
            return self.rotation(x, tube)
        return self.interpolation(x, int(motion == "slope"), tube)

    def _inside(self, x: Array, tube: Index | int) -> tuple[Index, Array]:
        """Element that holds each x, and the place in it from -1 to 1."""
        element = self.elements(x, tube)
        return element, (x - self.tops[element]) / (0.5 * self.lengths[element]) - 1.0

    def _rows(self, values: Array, element: Index, derivative: int) -> Rows:
        """From values of unmixed functions in d/dxi^derivative, (n, local), to all unknowns."""
        scale = self.scale / (0.5 * self.lengths[:, None]) ** derivative
        return Rows(self.dofs[element], self.mixed(values, element) * scale[element], self.size)

    def top_functions(self, points: int, motion: Motion) -> Array:
        """Functions of each element's top node at so many Gauss points, unscaled.

        motion: the field itself, its slope d/dxi, or the rotation of the section, which is the
        slope of a tube rigid in shear; the last two in half elements. Shape (elements, points,
        nodal), or (1, points, nodal) where all elements are alike.
        """
        derivative = int(motion != "value")
        if self.mixture is None:
            same = functions_at_gauss_points(self.continuity, self.degree, derivative, points)
            return same[None, :, : self.nodal]
        count, xi = len(self.lengths), gauss_points(points)[0]
        element, xi = np.repeat(np.arange(count), points), np.tile(xi, count)
        if motion == "rotation":
            values = self._turned(xi, element, 0)
        else:
            values = shape_functions(xi, self.continuity, self.degree, derivative)
        return self.mixed(values, element).reshape(count, points, self.local)[..., : self.nodal]

    @cached_property
    def _strains(self) -> list[Array]:
        """Strains of the functions in use at degree + 1 Gauss points, by kind, unscaled.

        Each has shape (elements, points, local), or (1, points, local) where all elements are
        alike: w' of a stretch; of a deflection psi' and, of a tube soft in shear, psi'', whose
        energy comes with `softness`. Lengths count in half elements.
        """
        points, order = self.degree + 1, self.continuity + 1
        if self.shear_stiffness is None:
            return [functions_at_gauss_points(self.continuity, self.degree, order, points)[None]]
        count = len(self.lengths)
        element, places = self._everywhere(gauss_points(points)[0])
        values = [self._turned(places, element, order) for order in (1, 2)]
        return [self.mixed(v, element).reshape(count, points, self.local) for v in values]

    @cached_property
    def strain_blocks(self) -> list[tuple[Array, Array]]:
        """For each kind of strain its Legendre coefficients by unknown, (elements, n, local), and
        the stiffness of each, (elements, n), N m or N."""
        order = self.continuity + 1
        half = 0.5 * self.lengths
        blocks = []
        for kind, strain in enumerate(self._strains):
            count = self.local - order - kind
            if count < 1:
                continue
            share = np.arange(count) + 0.5
            modes = legendre_integrals(self.degree + 1, count) @ strain * share[:, None]
            modes[np.abs(modes) < 1e-13] = 0.0
            values = modes * self.scale[:, None, :] / half[:, None, None] ** order
            factor = self.stiffness * half * (self.softness if kind else 1.0)
            blocks.append((values, factor[:, None] / share))
        return blocks

    @cached_property
    def strain_modes(self) -> tuple[Rows, Array]:
        """Matrix to the Legendre coefficients of strains, and the stiffness of each (N m or N).

        Internal forces through them are in exact balance in every element, however short it is:
        rounding of the unknowns makes couples, not forces.
        """
        shares = [values.reshape(-1, self.local) for values, _ in self.strain_blocks]
        dofs = [self.dofs.repeat(values.shape[1], axis=0) for values, _ in self.strain_blocks]
        stiffness = np.concatenate([amounts.ravel() for _, amounts in self.strain_blocks])
        return Rows(np.concatenate(dofs), np.concatenate(shares), self.size), stiffness

    def mass(self, amount: Array, rotary: Array | None = None) -> Array:
        """Consistent mass matrices of the elements, (elements, local, local), kg.

        amount: mass per length of each element, kg/m. rotary: what resists the rotation of the
        section, per length of each element, kg m; None is nothing. Exact for the field's
        polynomials, in its scaling.
        """
        xi, weight = gauss_points(self.degree + 1)
        count, half = len(self.lengths), 0.5 * self.lengths
        every, places = self._everywhere(xi)
        values = self.mixed(shape_functions(places, self.continuity, self.degree), every)
        parts = [(amount * half, values)]
        if rotary is not None:
            parts.append((rotary / half, self.rotated(xi)))
        total = np.zeros((count, self.local, self.local))
        for factor, motion in parts:
            one = motion.reshape(count, len(xi), self.local)
            total += factor[:, None, None] * (np.swapaxes(one * weight[:, None], 1, 2) @ one)
        return np.asarray(total * self.scale[:, :, None] * self.scale[:, None, :])

    def top_forces(self, q: Array) -> Array:
        """Forces at the unknowns of each element's top node, (..., elements, nodal).

        q: shape (..., n). By way of the strains, as the equations have them.
        """
        total = np.zeros((*q.shape[:-1], len(self.lengths), self.nodal))
        for values, stiffness in self.strain_blocks:
            strain = np.einsum("enj,...ej->...en", values, q[..., self.dofs])
            top = values[:, :, : self.nodal]
            total += np.einsum("...en,eni->...ei", strain * stiffness, top)
        return total

    @cached_property
    def element_stiffness(self) -> Array:
        """Matrices of the strain energy, shape (elements, local, local), N/m."""
        order = self.continuity + 1
        weight = gauss_points(self.degree + 1)[1]
        factor = self.stiffness / (0.5 * self.lengths) ** (2 * order - 1)
        matrices = np.zeros((len(self.lengths), self.local, self.local))
        for kind, strain in enumerate(self._strains):
            energy = np.swapaxes(strain * weight[:, None], 1, 2) @ strain
            matrices += (factor * (self.softness if kind else 1.0))[:, None, None] * energy
        scale = self.scale
        matrices *= scale[:, :, None] * scale[:, None, :]
        return matrices
