"""What the soil at all points of a system remembers of its motion."""

from collections.abc import Mapping, Sequence
from itertools import accumulate, pairwise

import numpy as np

from ..arrays import Array
from ..errors import Fault, InvalidData, UserError
from ..scene import Hysteresis
from ..soil.memory import Memory
from ..soil.memory_of import memory_in_space, memory_of
from .system import System


class Together(Memory):
    """Memories side by side, each at points of its own."""

    def __init__(self, parts: Sequence[tuple[Memory, int]]) -> None:
        ends = accumulate((count for _, count in parts), initial=0)
        self.parts = [
            (memory, slice(*ends_of))
            for (memory, _), ends_of in zip(parts, pairwise(ends), strict=True)
        ]

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, stiffness = np.empty_like(u), np.empty((3, len(u)) if u.ndim == 2 else len(u))
        for memory, at in self.parts:
            force[at], stiffness[..., at] = memory.evaluate(u[at])
        return force, stiffness

    def commit(self, u: Array) -> None:
        for memory, at in self.parts:
            memory.commit(u[at])

    @property
    def dissipated(self) -> Array:
        return np.concatenate([np.zeros(0), *(memory.dissipated for memory, _ in self.parts)])

    def state(self) -> dict[str, Array]:
        return {
            f"{number}/{name}": value
            for number, (memory, _) in enumerate(self.parts)
            for name, value in memory.state().items()
        }

    def restore(self, state: Mapping[str, Array]) -> None:
        for number, (memory, _) in enumerate(self.parts):
            begin = f"{number}/"
            memory.restore(
                {k.removeprefix(begin): v for k, v in state.items() if k.startswith(begin)}
            )


def remembered(system: System, hysteresis: Hysteresis, name: str) -> Memory | None:
    """The memory of all points of a system; None where there is none.

    name: of the foundation. Raises UserError where a reaction cannot remember so.
    """
    if hysteresis == "ELASTIC":
        return None
    check_plane(system.components, hysteresis, name)
    spatial = system.components == 2
    try:
        parts = [
            (
                memory_in_space(p.reaction) if spatial else memory_of(p.reaction, hysteresis),
                len(p.x),
            )
            for p in system.points
        ]
    except InvalidData as error:
        raise UserError(Fault(f"{name}: {error.message}", error.remedy)) from error
    return Together(parts) if len(parts) != 1 else parts[0][0]


def check_plane(components: int, hysteresis: Hysteresis, name: str) -> None:
    """Raises UserError for soil that would have to remember a gap in two planes."""
    if components == 2 and hysteresis == "GAP":
        raise UserError(
            Fault(
                f"{name}: HYSTERESIS=GAP follows motion in one plane, as its source does, but the "
                "model is spatial: loads or supports share no plane, or SPATIAL asks for it",
                "choose *MODEL HYSTERESIS=MASING, which follows two planes; or give all loads one "
                "plane, and leave SPATIAL out",
            )
        )
