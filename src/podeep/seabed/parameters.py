"""What models of the seabed take, and where each value has to lie: the one table of them."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees, radians
from types import MappingProxyType

import numpy as np

from ..errors import InvalidData
from ..soil.polyline import Values
from ..units import short

PIPE = ("diameter", "weight")  # of the pipe; what is of its laying or of the soil is not here
_EDGE = 1e-9  # share of a bound that rounding may pass it by


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a model, in the unit of decks and commands; the model takes SI.

    key: its name in the code. symbol: that of its column in a deck. low, high: bounds; `below`:
    high itself is out. otherwise: in words, what it is to leave it out.
    """

    key: str
    symbol: str
    option: str
    meaning: str
    unit: str
    low: float
    high: float
    below: bool = False
    otherwise: str = ""

    def __contains__(self, value: float) -> bool:
        if self.below and value >= self.high:
            return False
        return self.low * (1.0 - _EDGE) <= value <= self.high * (1.0 + _EDGE)

    @property
    def name(self) -> str:
        """Its meaning without what follows a colon or a comma."""
        return re.split("[:,]", self.meaning)[0]

    def words(self, value: float) -> str:
        """A value of the model, with symbol and unit."""
        unit = "" if self.unit == "-" else f" {self.unit}"
        return f"{self.symbol} {short(self.shown(value))}{unit}"

    @property
    def rule(self) -> str:
        """Where it lies, in words."""
        unit = "" if self.unit == "-" else f" {self.unit}"
        return f"{self.low:g} to {'below ' if self.below else ''}{self.high:g}{unit}"

    def shown(self, value: float) -> float:
        """A value of the model in the unit of decks and commands."""
        return degrees(value) if self.unit == "deg" else value

    def taken(self, value: float) -> float:
        """The reverse of `shown`."""
        return radians(value) if self.unit == "deg" else value


#: By key, in the order in which they are listed.
PARAMETERS: Mapping[str, Parameter] = MappingProxyType(
    {
        p.key: p
        for p in (
            Parameter("diameter", "D", "--diameter", "outer diameter in contact", "m", 0.01, 20.0),
            Parameter("weight", "W", "--weight", "submerged weight of the pipe", "N/m", 1e-2, 1e7),
            Parameter(
                "undrained_shear_strength",
                "CU",
                "--su",
                "undrained shear strength",
                "Pa",
                1.0,
                1e8,
            ),
            Parameter(
                "effective_unit_weight",
                "GAMMA",
                "--gamma",
                "effective unit weight",
                "N/m3",
                100.0,
                1e5,
            ),
            Parameter("friction_angle", "PHI", "--phi", "friction angle", "deg", 10.0, 50.0),
            Parameter(
                "void_ratio",
                "E",
                "--void-ratio",
                "void ratio",
                "-",
                0.01,
                2.97,
                below=True,
                otherwise="no dynamic stiffness",
            ),
            Parameter(
                "poisson_ratio",
                "NU",
                "--nu",
                "Poisson's ratio of the soil",
                "-",
                0.0,
                0.5,
                below=True,
                otherwise="no dynamic stiffness",
            ),
            Parameter(
                "self_weight_factor",
                "NG",
                "--n-gamma",
                "factor n in N_gamma = n (N_q - 1) tan phi: 1.8, or 1.5 of API and DNV",
                "-",
                1.5,
                1.8,
            ),
            Parameter(
                "verley_lund_unit_weight",
                "GAMMAVL",
                "--gamma-vl",
                "unit weight in G = CU / (D GAMMAVL): bulk in DNV-RP-F109, effective in Bai 2001",
                "N/m3",
                100.0,
                1e5,
            ),
            Parameter(
                "ultimate_penetration",
                "ZU",
                "--z-ultimate",
                "penetration at the bearing capacity, over the diameter",
                "-",
                0.1,
                0.15,
            ),
            Parameter(
                "bending_stiffness",
                "EI",
                "--bending-stiffness",
                "bending stiffness of the pipe, for its laying",
                "N m2",
                1.0,
                1e12,
            ),
            Parameter(
                "lay_tension",
                "T0",
                "--lay-tension",
                "horizontal tension as the pipe is laid",
                "N",
                1.0,
                1e9,
            ),
            Parameter("given_static_stiffness", "KS", "", "static stiffness", "Pa", 1.0, 1e12),
            Parameter("given_dynamic_stiffness", "KD", "", "dynamic stiffness", "Pa", 1.0, 1e12),
        )
    }
)


def require(**values: Values | None) -> None:
    """Raise InvalidData for the first parameter, in SI, that is out of its bounds; None is none.

    Arrays are refused for any of their values. The data's field is the parameter's symbol.
    """
    for key, given in values.items():
        one = PARAMETERS[key]
        for value in () if given is None else {float(np.min(given)), float(np.max(given))}:
            if (shown := one.shown(value)) not in one:
                raise InvalidData(
                    f"the {one.name} is {short(shown)}",
                    f"it has to be {one.rule}",
                    one.symbol,
                )
