"""What a soil reaction law is."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .polyline import Polyline


class Law(ABC):
    """Reaction against displacement at n points at once, path independent.

    A law is a frozen dataclass whose fields are its parameters, each a float or an array of
    shape (n,). Displacements `u` have shape (n,) or (..., n) in metres; forces come back in the
    same shape, N/m along a tube or N at a tip, positive against a positive displacement.
    The reaction is exact: no sampling, no smoothing but what the law's page states.
    """

    #: force(-u) == -force(u)
    odd: ClassVar[bool] = True
    #: the reaction comes for each unit of |p|, the lateral reaction at the same point
    follows_lateral: ClassVar[bool] = False
    #: the standard with its clause, or the paper
    source: ClassVar[str]

    @abstractmethod
    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its exact derivative at `u`; at a kink the derivative away from zero."""

    @property
    @abstractmethod
    def capacity(self) -> Array:
        """Bound of |force| at each point, shape (n,); inf where a law has none."""

    @property
    def polyline(self) -> Polyline | None:
        """The straight lines that the law is; None where it is more."""
        return None

    @property
    def corners(self) -> Array:
        """Displacements, either way, at which the slope jumps or has no bound, (corners, n), m."""
        lines = self.polyline
        return np.zeros((0, len(self.capacity))) if lines is None else lines.corners

    @property
    def derived(self) -> Mapping[str, Array]:
        """What the law makes of its parameters on the way to the reaction, by name, (n,) each."""
        return MappingProxyType({})

    def force(self, u: Array) -> Array:
        """Reaction at `u`."""
        return self.evaluate(u)[0]

    def stiffness(self, u: Array) -> Array:
        """Derivative of the reaction at `u`."""
        return self.evaluate(u)[1]


class LayeredLaw(Law):
    """A p-y law whose resistance grows with depth: soil above it counts by an equivalent depth."""

    @property
    @abstractmethod
    def ultimate_resistance(self) -> Array:
        """pu with its multiplier, N/m, shape (n,)."""

    @property
    def layering_resistance(self) -> Array:
        """What counts for the layers below: pu before factors that a chart gives, N/m, (n,)."""
        return self.ultimate_resistance
