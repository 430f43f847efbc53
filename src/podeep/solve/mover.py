"""What a simulation takes through time: foundations and lines alike."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol, Self, TypeAlias

import numpy as np

from ..arrays import Array
from .equations import State
from .integrators import Integrator
from .stage import Effort

#: A state of a problem, and what resists at its points where that depends on the way.
Row: TypeAlias = tuple[State, Array | None]
Pair: TypeAlias = tuple[Row, Row | None]

_ROWS = ("q", "velocity", "acceleration", "resisting")


@dataclass(frozen=True, slots=True)
class Standing:
    """Where a motion was, to go back to: its states, the work of its loads, J, and the largest
    force, N, so far, and what its soil remembers of each of its problems."""

    lateral: State
    axial: State | None
    work: float
    force: float
    memories: tuple[Mapping[str, Array], ...]


class Mover(Protocol):
    """A motion of one problem or two, deflection and stretch; a line has one alone.

    part: the smallest part that the last step was taken in, s. work: of what drives it since the
    start, J.
    """

    @property
    def method(self) -> Integrator:
        """How it is followed."""

    @property
    def effort(self) -> Effort: ...

    @property
    def part(self) -> float: ...

    @property
    def work(self) -> float: ...

    @property
    def time(self) -> float:
        """Where it is, s."""

    def step(self, h: float, end: float, share: float, iterations: int) -> None:
        """Go h seconds on, to the time `end`, in halves where there is no equilibrium otherwise.

        share: of the reach, what an iteration may leave. Raises NoBalance, at a state before.
        """

    def standing(self) -> Standing:
        """Where it is, for it or another one of the same to `stand` at."""

    def stand(self, at: Standing) -> None:
        """Go where it, or another one of the same, was."""

    def imbalance(self) -> float:
        """Largest force out of balance over the largest force so far."""

    def sizes(self, other: Self | None = None) -> tuple[float, float]:
        """Largest displacements of both problems, or of their distance from another's, m."""

    def lost(self) -> bool:
        """Whether it will never be held again."""

    def dissipated(self) -> float:
        """Energy that the soil has lost since the start, J."""

    def pair(self) -> Pair:
        """Where it is, as rows of its problems."""

    def settled(self, pair: Pair) -> Pair:
        """Rows where it was, with accelerations that balance there: its method may know means."""

    def state(self) -> dict[str, Array]:
        """Everything that its next step depends on, and what it adds up."""

    def restore(self, found: Mapping[str, Array]) -> None:
        """Be where a `state` was; its arrays may be flat.

        Raises KeyError and ValueError where that is not one of its own.
        """


def rows_of(name: str, state: State) -> Iterator[tuple[str, Array]]:
    """A state of a problem as arrays by name."""
    for row in _ROWS:
        value = getattr(state, row)
        yield f"{name}/{row}", np.empty(0) if value is None else value


def state_from(name: str, found: Mapping[str, Array], time: float, size: int) -> State:
    """What `rows_of` made, back as a state of so many unknowns."""
    q, velocity, acceleration, resisting = (found[f"{name}/{row}"] for row in _ROWS)
    if not len(q) == len(velocity) == len(acceleration) == size:
        raise ValueError(f"{name}: {len(q)} unknowns instead of {size}")
    return State(time, q, velocity, acceleration, resisting if resisting.size else None)


def alike(name: str, found: Mapping[str, Array], kept: Mapping[str, Array]) -> dict[str, Array]:
    """Arrays of a memory whose names begin so, in the shapes and types of what it keeps now."""
    return {part: _as(found[f"{name}/{part}"], like) for part, like in kept.items()}


def _as(values: Array, like: Array) -> Array:
    """Flat values in the shape and type of an array, whose first dimension may have grown."""
    like = np.asarray(like)
    shape = (-1, *like.shape[1:]) if like.ndim else ()
    return values.reshape(shape).astype(like.dtype)
