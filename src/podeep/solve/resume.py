"""What a simulation has come to, as arrays by name, and back: to the same bits."""

from collections.abc import Iterator, Mapping

import numpy as np

from ..arrays import Array
from .dynamics import End
from .mover import Mover
from .simulate import Simulation

_ENDS = tuple(End)


def state_of(one: Simulation) -> dict[str, Array]:
    """Everything that the next step depends on, and what is added up from step to step."""
    counts = (one.done, _ENDS.index(one.ending), *one.apart, *one.reach, *one.along)
    found = {"simulation": np.array(counts, dtype=np.float64)}
    for name, motion in _named(one):
        found |= {f"{name}/{part}": value for part, value in motion.state().items()}
    return found


def resume(one: Simulation, found: Mapping[str, Array]) -> None:
    """Bring a simulation at its start to a `state_of` one alike; the arrays may be flat.

    Raises KeyError and ValueError where the state is that of another simulation.
    """
    done, ending, *sizes = found["simulation"].tolist()
    one.done, one.ending = int(done), _ENDS[int(ending)]
    one.apart, one.reach = np.array(sizes[:2]), np.array(sizes[2:4])
    one.go_on(sizes[4:])
    for name, motion in _named(one):
        begin = f"{name}/"
        motion.restore({k.removeprefix(begin): v for k, v in found.items() if k.startswith(begin)})


def _named(one: Simulation) -> Iterator[tuple[str, Mover]]:
    for who, motions in (("motion", one.motions), ("twin", one.twins)):
        for place, motion in enumerate(motions, start=1):
            yield f"{who}{place}", motion
