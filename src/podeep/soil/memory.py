"""Reactions that depend on their path, and the one that does not."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import ClassVar, Protocol

import numpy as np

from ..arrays import Array


class Backbone(Protocol):
    """What a law, a reaction or any other path independent curve gives."""

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at displacements u of shape (..., n)."""


class Kept:
    """What has a state that can be kept and gone back to."""

    #: names of the attributes that are its state, arrays all
    kept: ClassVar[tuple[str, ...]] = ()

    def state(self) -> dict[str, Array]:
        """All that the path has left, as copies."""
        return {name: np.array(getattr(self, name)) for name in self.kept}

    def restore(self, state: Mapping[str, Array]) -> None:
        """Go back to a `state`, to the same bits."""
        for name in self.kept:
            setattr(self, name, np.array(state[name]))


class Memory(Kept, ABC):
    """A reaction at n points that depends on its path; the state is that of the last `commit`.

    Displacements u (m) have shape (n,); forces come in N/m along a tube, N at a tip, positive
    against a positive displacement. Across a tube that moves in two planes both have shape (n, 2),
    and derivatives are the entries xx, yy and xy of symmetric matrices, (3, n).
    """

    @abstractmethod
    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at the end of a straight path from the last commit to u.

        The state stays as it is. At the committed displacement the derivative is that of going on.
        """

    @abstractmethod
    def commit(self, u: Array) -> None:
        """The points have come to u, each straight from where it was."""

    @property
    @abstractmethod
    def dissipated(self) -> Array:
        """Energy lost since the start, J/m (J at a tip), (n,): work done less what can come back.

        Work is that of the force along the committed path.
        """


class Elastic(Memory):
    """No memory: the backbone up and down, and nothing lost."""

    def __init__(self, backbone: Backbone, size: int) -> None:
        self.backbone, self.size = backbone, size

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self.backbone.evaluate(u)

    def commit(self, u: Array) -> None:
        pass

    @property
    def dissipated(self) -> Array:
        return np.zeros(self.size)


def nested(outer: str, inner: Kept) -> dict[str, Array]:
    """The state of what is part of another one, under its name."""
    return {f"{outer}.{name}": value for name, value in inner.state().items()}


def unnested(outer: str, state: Mapping[str, Array]) -> dict[str, Array]:
    """What `nested` made, back under its own names."""
    start = f"{outer}."
    return {n.removeprefix(start): value for n, value in state.items() if n.startswith(start)}
