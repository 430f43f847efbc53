"""The models of the soil under a pipe by name: what decks, commands and the manual read."""

from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, fields
from types import MappingProxyType
from typing import Literal

from ..soil.polyline import Values
from .audibert import Audibert
from .dnv14 import Dnv14
from .f114 import F114Undrained
from .law import SeabedLaw
from .parameters import PARAMETERS, Parameter
from .powers import Direct, Dunlap, NgiDrained, VerleyLundLinear, VerleySotberg
from .verley_lund import VerleyLund

Soil = Literal["CLAY", "SAND"]

#: Where the force comes from: read in public text, guessed, or of the user. What is from memory
#: stands beside it in words.
Mark = Literal["printed", "reconstructed", "given"]


@dataclass(frozen=True, slots=True)
class Model:
    """A model: its law, the parameters that it needs and may have by key, and what is known of it.

    soil: what it is for; None for any. static: where the force comes from. remark: what has to be
    known of it besides, of its dynamic stiffness above all.
    """

    name: str
    title: str
    law: type[SeabedLaw]
    soil: Soil | None
    needed: tuple[str, ...]
    optional: tuple[str, ...] = ()
    static: Mark = "printed"
    remark: str = ""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All of them, those that are needed first."""
        return tuple(PARAMETERS[key] for key in (*self.needed, *self.optional))

    def default(self, key: str) -> float | None:
        """What stands in for an optional parameter; None for nothing."""
        found = next(f.default for f in fields(self.law) if f.name == key)
        return None if found is MISSING else found

    def lacks(self, given: Iterable[str]) -> tuple[Parameter, ...]:
        """The parameters that it needs and that are not among those given."""
        known = set(given)
        return tuple(PARAMETERS[key] for key in self.needed if key not in known)

    def at(self, diameter: Values, parameters: Mapping[str, Values | None]) -> SeabedLaw:
        """The law of a pipe in soil of these parameters (SI), of which it takes those it knows.

        Raises InvalidData for values out of bounds.
        """
        known = {k: v for k, v in parameters.items() if k in (*self.needed, *self.optional)}
        return self.law(diameter=diameter, **known)


_ELASTIC = ("void_ratio", "poisson_ratio")
_HARDIN = (
    "the formula of Kd is printed; that G and its stress are in kPa is from memory, and that the "
    "stress goes with the contact width is reconstructed"
)

_GUESS = (
    "a guess after the ASCE's guideline of 1984 for buried pipes, not the formula of DeepLines; Kd "
    "is the slope that its hyperbola starts with"
)

#: One line a model, in the order in which they are shown.
MODELS: Mapping[str, Model] = MappingProxyType(
    {
        m.name: m
        for m in (
            Model(
                "DNV14CLAY",
                "DNV Guideline 14, clay",
                Dnv14,
                "CLAY",
                ("undrained_shear_strength", "effective_unit_weight"),
                _ELASTIC,
                remark=_HARDIN,
            ),
            Model(
                "DNV14SAND",
                "DNV Guideline 14, sand",
                Dnv14,
                "SAND",
                ("effective_unit_weight", "friction_angle"),
                (*_ELASTIC, "self_weight_factor"),
                remark=_HARDIN,
            ),
            Model(
                "DUNLAP",
                "Dunlap et al. 1990, clay",
                Dunlap,
                "CLAY",
                ("undrained_shear_strength",),
            ),
            Model(
                "VERLEYLUND",
                "Verley and Lund 1995, clay",
                VerleyLund,
                "CLAY",
                ("undrained_shear_strength", "verley_lund_unit_weight"),
            ),
            Model(
                "VERLEYLUNDLINEAR",
                "Verley and Lund 1995, linear, clay",
                VerleyLundLinear,
                "CLAY",
                ("undrained_shear_strength", "verley_lund_unit_weight"),
            ),
            Model(
                "VERLEYSOTBERG",
                "Verley and Sotberg 1994, sand",
                VerleySotberg,
                "SAND",
                ("effective_unit_weight",),
            ),
            Model(
                "F114",
                "DNV-RP-F114, model 2, undrained clay",
                F114Undrained,
                "CLAY",
                ("undrained_shear_strength", "effective_unit_weight"),
            ),
            Model(
                "NGIDRAINED", "NGI, drained sand", NgiDrained, "SAND", ("effective_unit_weight",)
            ),
            Model(
                "AUDIBERTCLAY",
                "reconstructed, not DeepLines' Audibert, clay",
                Audibert,
                "CLAY",
                ("undrained_shear_strength", "effective_unit_weight"),
                ("ultimate_penetration",),
                "reconstructed",
                _GUESS,
            ),
            Model(
                "AUDIBERTSAND",
                "reconstructed, not DeepLines' Audibert, sand",
                Audibert,
                "SAND",
                ("effective_unit_weight", "friction_angle"),
                ("ultimate_penetration", "self_weight_factor"),
                "reconstructed",
                _GUESS,
            ),
            Model(
                "DIRECT",
                "stiffness as given",
                Direct,
                None,
                ("given_static_stiffness", "given_dynamic_stiffness"),
                static="given",
            ),
        )
    }
)

#: What DeepLines offers and no public text tells the formula of.
NOT_FOUND = (
    "Audibert 1984: static and dynamic stiffness",
    "Dunlap 1990: dynamic stiffness",
    "Verley and Lund 1995: dynamic stiffness",
)
