"""What a model of the soil under a pipe is: its force against penetration, and stiffness of it."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from math import exp, log
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from ..arrays import Array
from ..soil.law import Law
from ..soil.polyline import Values
from .bearing import contact_width
from .parameters import require

NOT_FOUND = "no public formula of its dynamic stiffness was found"
NONE = "the model has no dynamic stiffness"
_ROUNDING = 4.0 * np.finfo(float).eps


class Range(NamedTuple):
    """Up to where a measure of a law (`SeabedLaw.measures`) lies in what it was made for."""

    measure: str
    high: float
    why: str


SHALLOW = Range("z/D", 0.5, "the model is for a pipe less than half in the soil")


@dataclass(frozen=True, eq=False, kw_only=True)
class SeabedLaw(Law):
    """Vertical force per metre of pipe, N/m, against the penetration z of its invert, m.

    The force rises with penetration and is 0 where z <= 0. The derivative at z = 0 is that away
    from zero: infinite where the force starts as a power of z below 1.

    diameter: outer diameter in contact D, m, a number or (n,) as all parameters.
    Raises InvalidData for parameters out of bounds (`parameters.PARAMETERS`).
    """

    odd: ClassVar[bool] = False
    #: why there is no dynamic stiffness, where there is none
    no_dynamic: ClassVar[str] = NOT_FOUND
    ranges: ClassVar[tuple[Range, ...]] = (SHALLOW,)

    diameter: Values

    def __post_init__(self) -> None:
        require(**self._given)

    @property
    def _given(self) -> dict[str, Any]:
        """The parameters by name, without those that were left out."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        return {name: value for name, value in values.items() if value is not None}

    @property
    def capacity(self) -> Array:
        shapes = (np.shape(np.atleast_1d(value)) for value in self._given.values())
        return np.full(np.broadcast_shapes(*shapes), np.inf)

    def penetration(self, weight: Values) -> Array:
        """Penetration at rest under a submerged weight W (N/m, above 0), m; force(z) = W."""
        require(weight=weight)
        return self._penetration(weight)

    @abstractmethod
    def _penetration(self, weight: Values) -> Array:
        """The inverse of the force."""

    def contact_width(self, penetration: Values) -> Array:
        """Width of the pipe in the plane of the seabed, m."""
        return contact_width(penetration, self.diameter)

    def dynamic_stiffness(self, penetration: Values) -> Array | None:
        """Vertical stiffness in small quick motions, N/m per metre; None: see `no_dynamic`."""
        return None

    def lateral_dynamic_stiffness(self, penetration: Values) -> Array | None:
        """The same sideways; None where the model has none."""
        return None

    def measures(self, penetration: Values) -> Mapping[str, Array]:
        """What `ranges` look at, by name."""
        return {"z/D": np.divide(penetration, self.diameter)}

    def bracketed(self, weight: Values) -> Array:
        """The inverse of the force by bracketing, point by point: for what is asked rarely."""
        given = self._given
        at = np.broadcast_arrays(weight, *given.values())
        found = [
            replace(self, **dict(zip(given, point, strict=True)))._root(w)
            for w, *point in zip(*(values.ravel().tolist() for values in at), strict=True)
        ]
        return np.array(found).reshape(at[0].shape)

    def _root(self: Self, weight: float) -> float:
        """Penetration of one pipe; by logarithms, in which the force is nearly a straight line."""
        from scipy.optimize import brentq  # slow to load, and rarely needed

        def excess(x: float) -> float:
            return log(float(self.force(np.array(exp(x)))) / weight)

        low = high = log(float(self.diameter))
        while excess(low) > 0.0:
            low -= 4.0
        while excess(high) < 0.0:
            high += 2.0
        return exp(brentq(excess, low, high, xtol=_ROUNDING, rtol=_ROUNDING))
