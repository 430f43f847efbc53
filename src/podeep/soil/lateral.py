"""The lateral laws (p-y) by the name that a curve gives."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from .law import Law
from .sand import Sand
from .soft_clay import SoftClay


class LateralLaws(NamedTuple):
    """What one p-y curve describes: resistance along a tube, and for some laws more than that."""

    resistance: type[Law]
    moment: type[Law] | None = None
    base_shear: type[Law] | None = None
    base_moment: type[Law] | None = None


#: One line a law.
LAWS: Mapping[str, LateralLaws] = MappingProxyType(
    {"soft_clay": LateralLaws(SoftClay), "sand": LateralLaws(Sand)}
)
