"""What a simulation has come to, as arrays by name, and back: to the same bits."""

from collections.abc import Iterator, Mapping

import numpy as np

from ..arrays import Array
from .dynamics import End, Motion
from .equations import State
from .moving import Moving
from .simulate import Simulation

_ENDS = tuple(End)
_ROWS = ("q", "velocity", "acceleration", "resisting")


def state_of(one: Simulation) -> dict[str, Array]:
    """Everything that the next step depends on, and what is added up from step to step."""
    counts = (one.done, _ENDS.index(one.ending), *one.apart, *one.reach, *one.along)
    found = {"simulation": np.array(counts, dtype=np.float64)}
    for name, motion in _named(one):
        sums = (motion.lateral.time, motion.work, motion.force, motion.reach)
        found[name] = np.array(sums, dtype=np.float64)
        for which, equations, state in _problems(motion):
            for row in _ROWS:
                value = getattr(state, row)
                found[f"{name}/{which}/{row}"] = np.empty(0) if value is None else value
            if equations.memory is not None:
                for part, value in equations.memory.state().items():
                    found[f"{name}/{which}/memory/{part}"] = value
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
        time, motion.work, motion.force, motion.reach = map(float, found[name])
        states = []
        for which, equations, state in _problems(motion):
            place = f"{name}/{which}"
            q, velocity, acceleration, resisting = (found[f"{place}/{row}"] for row in _ROWS)
            if not len(q) == len(velocity) == len(acceleration) == len(state.q):
                raise ValueError(f"{place}: {len(q)} unknowns instead of {len(state.q)}")
            resists = resisting if resisting.size else None
            states.append(State(time, q, velocity, acceleration, resists))
            if equations.memory is not None:
                kept = equations.memory.state()
                equations.memory.restore(
                    {p: _as(found[f"{place}/memory/{p}"], like) for p, like in kept.items()}
                )
        motion.lateral, motion.axial = states[0], states[1] if states[1:] else None


def _named(one: Simulation) -> Iterator[tuple[str, Motion]]:
    for who, motions in (("motion", one.motions), ("twin", one.twins)):
        for place, motion in enumerate(motions, start=1):
            yield f"{who}{place}", motion


def _problems(motion: Motion) -> Iterator[tuple[str, Moving, State]]:
    """What moves of a foundation: its equations and its state."""
    yield "lateral", motion.body.lateral, motion.lateral
    if motion.body.axial is not None and motion.axial is not None:
        yield "axial", motion.body.axial, motion.axial


def _as(values: Array, like: Array) -> Array:
    """Flat values in the shape and type of an array, whose first dimension may have grown."""
    like = np.asarray(like)
    shape = (-1, *like.shape[1:]) if like.ndim else ()
    return values.reshape(shape).astype(like.dtype)
