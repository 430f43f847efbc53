"""The lateral laws (p-y) by the name that a curve gives."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from .iso_clay import IsoClay
from .law import Law
from .pisa import (
    PisaClay,
    PisaClayBaseMoment,
    PisaClayBaseShear,
    PisaClayMoment,
    PisaSand,
    PisaSandBaseMoment,
    PisaSandBaseShear,
    PisaSandMoment,
)
from .reese_sand import ReeseSand
from .sand import Sand
from .soft_clay import SoftClay
from .stiff_clay import StiffClay, StiffClayFreeWater
from .weak_rock import WeakRock


class LateralLaws(NamedTuple):
    """What one p-y curve describes: resistance along a tube, and for some laws more than that."""

    resistance: type[Law]
    moment: type[Law] | None = None
    base_shear: type[Law] | None = None
    base_moment: type[Law] | None = None


#: One line a law.
LAWS: Mapping[str, LateralLaws] = MappingProxyType(
    {
        "soft_clay": LateralLaws(SoftClay),
        "sand": LateralLaws(Sand),
        "stiff_clay_free_water": LateralLaws(StiffClayFreeWater),
        "stiff_clay": LateralLaws(StiffClay),
        "weak_rock": LateralLaws(WeakRock),
        "iso_clay": LateralLaws(IsoClay),
        "pisa_clay": LateralLaws(PisaClay, PisaClayMoment, PisaClayBaseShear, PisaClayBaseMoment),
        "pisa_sand": LateralLaws(PisaSand, PisaSandMoment, PisaSandBaseShear, PisaSandBaseMoment),
        "reese_sand": LateralLaws(ReeseSand),
    }
)
