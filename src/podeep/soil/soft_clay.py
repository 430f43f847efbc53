"""Lateral reaction (p-y) of soft clay."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar

import numpy as np
from scipy.linalg import blas

from ..arrays import Array
from ..errors import InvalidData
from .law import LayeredLaw
from .polyline import Points, Polyline, Values

_TOE = 1e-10  # y/y50 that rounds off the cube root's infinite slope
_CORNER, _END = 3.0, 15.0  # y/y50 between which cyclic resistance falls

#: (y/y50, p/pu) of the published tables up to their peak, by shape
_TABLES: Mapping[str, Points] = MappingProxyType(
    {
        "2GEO": ((0, 0), (0.1, 0.23), (0.3, 0.33), (1, 0.5), (_CORNER, 0.72), (8, 1)),
        "WSD": ((0, 0), (1, 0.5), (_CORNER, 0.72), (8, 1)),
    }
)


@dataclass(frozen=True, eq=False)
class _CubeRoot:
    """level / reach^(1/3) times the rounded cube root of s = y/y50, constant from |s| = reach."""

    half: Array
    level: Array
    y50: Array
    reach: float

    @cached_property
    def _factors(self) -> tuple[Array, Array, Array]:
        """Of the secant modulus; of the square that rounds the root off; 2/3 of this square."""
        toe = np.square(_TOE * self.y50)
        return self.half / np.cbrt(self.y50), toe, toe * (2.0 / 3.0)

    @cached_property
    def _plateau(self) -> tuple[Array, float]:
        """Squares from which the level is kept, and the least of them."""
        squares = np.square(self.reach * self.y50) + self._factors[1]
        return squares, float(squares.min(initial=np.inf))

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        factor, toe, two_thirds = self._factors
        square = u * u
        square += toe
        secant = np.cbrt(square)
        np.divide(factor, secant, out=secant)
        stiffness = two_thirds / square
        stiffness += 1.0 / 3.0
        stiffness *= secant
        secant *= u
        squares, first = self._plateau
        if square.size and square.flat[blas.idamax(square.ravel())] >= first:
            beyond = square >= squares
            np.copysign(self.level, u, out=secant, where=beyond)
            stiffness[beyond] = 0.0
        return secant, stiffness


@dataclass(frozen=True, eq=False)
class SoftClay(LayeredLaw):
    """Soft clay of Matlock and API.

        pu = min( (3 su + s'v) D + J su X , 9 su D )
        y50 = 2.5 eps50 D
        XR = 6 D / (g' D / su + J) >= 2.5 D

    Static, s = y/y50, straight lines between the points of a table, or the cube root:

        2GEO    (0, 0) (0.1, 0.23) (0.3, 0.33) (1, 0.50) (3, 0.72) (8, 1), then p = pu
        WSD     (0, 0) (1, 0.50) (3, 0.72) (8, 1), then p = pu
        POWER   p = 0.5 pu s^(1/3) up to s = 8, then p = pu

    Cyclic: static up to s = 3, where p = p3 = 0.72 pu (tables) or 0.5 3^(1/3) pu (POWER). At
    X >= XR, p3 from there on; above XR, a straight line to p3 X/XR at s = 15, then constant.

    The cube root has an infinite slope at rest. It is rounded to s / (s^2 + d^2)^(1/3) with
    d = 1e-10, which takes 3e-9 of p at s = 1e-6 and nothing at s = 0.01; p never exceeds its
    plateau.

    depth X (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above),
    undrained_shear_strength su (Pa), effective_unit_weight g' (N/m3; local, for XR alone),
    j J (-), strain_50 eps50 (-, strain at half the deviator stress), multiplier (-, on p at the
    same y, group effects). p in N/m.

    Range: su up to about 100 kPa, J 0.25 to 0.5, slender piles.
    Source: API RP 2GEO 8.5.2-8.5.3 and ISO 19901-4:2016 (2GEO); API RP 2A-WSD 6.8.2-6.8.3 (WSD);
    Matlock, OTC 1204 (1970) (POWER).
    """

    source: ClassVar[str] = (
        "API RP 2GEO 8.5.2-8.5.3, ISO 19901-4:2016; API RP 2A-WSD 6.8.2-6.8.3; Matlock 1970"
    )

    depth: Values
    diameter: Values
    effective_overburden: Values
    undrained_shear_strength: Values
    effective_unit_weight: Values
    j: Values
    strain_50: Values
    multiplier: Values = 1.0
    cyclic: bool = False
    shape: str = "2GEO"

    def __post_init__(self) -> None:
        shapes = (*_TABLES, "POWER")
        if self.shape not in shapes:
            raise InvalidData(
                f"there is no shape {self.shape} of soft clay",
                f"give one of {', '.join(shapes)}",
                "SHAPE",
            )

    @cached_property
    def ultimate_resistance(self) -> Array:
        """Static pu with its multiplier, N/m, shape (n,)."""
        su, D = self.undrained_shear_strength, self.diameter
        wedge = (3.0 * su + self.effective_overburden) * D + self.j * su * self.depth
        return np.atleast_1d(self.multiplier * np.minimum(wedge, 9.0 * su * D))

    @cached_property
    def transition_depth(self) -> Array:
        """XR, m, shape (n,)."""
        su, D = np.atleast_1d(self.undrained_shear_strength), self.diameter
        below = self.effective_unit_weight * D + self.j * su
        natural = np.divide(6.0 * D * su, below, out=np.full_like(below, np.inf), where=below > 0.0)
        return np.maximum(natural, 2.5 * np.asarray(D))

    @cached_property
    def y50(self) -> Array:
        """Displacement at half the static resistance, m, shape (n,)."""
        return np.atleast_1d(2.5 * np.multiply(self.strain_50, self.diameter))

    @cached_property
    def _fall(self) -> Array:
        """Share of p3 that cyclic loading takes at large displacement, shape (n,)."""
        return 1.0 - np.minimum(self.depth / self.transition_depth, 1.0)

    @cached_property
    def _table(self) -> Polyline:
        points, pu = _TABLES[self.shape], self.ultimate_resistance
        if not self.cyclic:
            return Polyline.through(points, pu, self.y50)
        *rise, _ = points
        nodes, ratios = np.array((*rise, (_END, rise[-1][1]))).T
        left = np.ones((len(nodes), len(self._fall)))
        left[-1] -= self._fall
        return Polyline(nodes, ratios[:, None] * left * pu, self.y50).mirrored()

    @cached_property
    def _power(self) -> tuple[_CubeRoot, Polyline | None]:
        """The capped cube root, and what cyclic loading takes from it above XR."""
        pu, y50 = self.ultimate_resistance, self.y50
        if not self.cyclic:
            return _CubeRoot(0.5 * pu, pu, y50, 8.0), None
        level = pu * (0.5 * _CORNER / np.cbrt(_CORNER**2 + _TOE**2))
        root = _CubeRoot(0.5 * pu, level, y50, _CORNER)
        loss = -level * self._fall
        if not loss.any():
            return root, None
        return root, Polyline.through(((0, 0), (_CORNER, 0), (_END, 1)), loss, y50)

    @property
    def polyline(self) -> Polyline | None:
        return None if self.shape == "POWER" else self._table

    @property
    def derived(self) -> Mapping[str, Array]:
        return {
            "ultimate_resistance": self.ultimate_resistance,
            "y50": self.y50,
            "transition_depth": self.transition_depth,
        }

    @property
    def capacity(self) -> Array:
        if self.shape == "POWER":
            return self._power[0].level
        return self._table.capacity

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        if self.shape != "POWER":
            return self._table.evaluate(u)
        root, loss = self._power
        force, stiffness = root.evaluate(u)
        if loss is not None:
            more, slope = loss.evaluate(u)
            force += more
            stiffness += slope
        return force, stiffness
