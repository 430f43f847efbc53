"""TzSimple1: an elastic spring in series with a slip that approaches the ultimate friction."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from .approach import ROUNDING, reached, recoverable, root, work
from .memory import Memory


class _Type(NamedTuple):
    elastic: float  # ke z50/tult
    way: float  # c
    power: float  # n


TYPES: Mapping[int, _Type] = MappingProxyType(
    {1: _Type(0.708, 0.5, 1.5), 2: _Type(2.05, 0.6, 0.85)}
)


class TzSimple(Memory):
    """Friction of a shaft with memory, z = ze + zp.

        elastic   t = ke ze
        slip      t = +-tult -+ (tult -+ t0) [c z50 / (c z50 + |zp - zp0|)]^n

    (zp0, t0): where the slip turned last. Type 1 (clay, Reese and O'Neill 1987): ke = 0.708
    tult/z50, c = 0.5, n = 1.5. Type 2 (sand, Mosher 1984): 2.05, 0.6, 0.85. Loops are not closed:
    the slip starts anew at each reversal.

    ultimate tult (N/m), z50 (m, displacement at half of it): (n,), positive.
    Source: Boulanger et al. (1999), TzSimple1 of OpenSees.
    """

    kept: ClassVar[tuple[str, ...]] = (
        "u", "force", "slip", "start", "start_force", "sense", "worked",
    )  # fmt: skip

    def __init__(self, ultimate: Array, z50: Array, kind: int) -> None:
        of = TYPES[kind]
        self.ultimate, self.power = ultimate, of.power
        self.elastic, self.way = of.elastic * ultimate / z50, of.way * z50
        zero = np.zeros(len(ultimate))
        self.u, self.force, self.slip, self.start = (zero.copy() for _ in range(4))
        self.start_force, self.worked, self.sense = zero.copy(), zero.copy(), np.ones(len(zero))

    def _ahead(self, u: Array) -> tuple[Array, Array, Array]:
        """Sense of the motion, and in it the way slipped on its branch and the branch's force."""
        sense = np.where(u == self.u, self.sense, np.sign(u - self.u))
        on = sense == self.sense
        before = np.where(on, sense * (self.slip - self.start), 0.0)
        return sense, before, sense * np.where(on, self.start_force, self.force)

    def _slip(self, u: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Sense, the branch's way before and after, its force at start, and what u asks for."""
        sense, before, base = self._ahead(u)
        asked = sense * (u - self.slip)

        def excess(x: Array) -> tuple[Array, Array]:
            t, k = reached(self.ultimate, base, before + x, self.way, self.power)
            return t / self.elastic + x - asked, k / self.elastic + 1.0

        most = np.abs(u - self.u)
        noise = ROUNDING * (np.abs(u) + np.abs(self.slip))
        x = root(excess, np.zeros(len(u)), most, np.zeros(len(u)), noise)
        return sense, before, before + x, base, x

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        sense, _, after, base, _ = self._slip(u)
        t, k = reached(self.ultimate, base, after, self.way, self.power)
        return sense * t, self.elastic * k / (self.elastic + k)

    def commit(self, u: Array) -> None:
        sense, before, after, base, x = self._slip(u)
        t, _ = reached(self.ultimate, base, after, self.way, self.power)
        done = work(self.ultimate, base, after, self.way, self.power)
        self.worked = self.worked + (done - work(self.ultimate, base, before, self.way, self.power))
        turned = sense != self.sense
        self.start = np.where(turned, self.slip, self.start)
        self.start_force = np.where(turned, self.force, self.start_force)
        self.slip, self.force = self.slip + sense * x, sense * t
        self.u, self.sense = np.array(u), sense

    @property
    def dissipated(self) -> Array:
        start = np.where(self.force * self.sense < 0.0, self.start_force, self.force)
        back = recoverable(self.ultimate, self.force, start, self.way, self.power)
        return self.worked - back
