"""The lateral laws (p-y) by the name that a curve gives."""

from collections.abc import Mapping
from types import MappingProxyType

from .law import Law
from .sand import Sand
from .soft_clay import SoftClay

#: One line a law.
LAWS: Mapping[str, type[Law]] = MappingProxyType({"soft_clay": SoftClay, "sand": Sand})
