"""The reaction of the soil at many points: laws, each at its points, added up."""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from ..arrays import Array, Index
from .law import Law


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """One law in force at some points of a reaction.

    at: the points, rising. weight: share of the law at each of them; None is 1. name: the law as
    curves name it. curves: ids of the curves that its parameters come from.
    """

    at: Index
    weight: Array | None
    law: Law
    name: str
    curves: tuple[int, ...]

    @property
    def parameters(self) -> dict[str, Any]:
        """What the law was given, by its own names: floats, arrays over the points, options."""
        return {f.name: getattr(self.law, f.name) for f in fields(self.law)}  # type: ignore[arg-type]  # every law is a dataclass


@dataclass(frozen=True, eq=False)
class Reaction:
    """The soil's reaction at n points: a weighted sum of laws; none is no reaction."""

    size: int
    laws: tuple[Term, ...]

    def part(self, wanted: Callable[[Law], bool]) -> "Reaction":
        """The same with the laws that are wanted alone."""
        return Reaction(self.size, tuple(term for term in self.laws if wanted(term.law)))

    @cached_property
    def odd(self) -> bool:
        """Whether force(-u) == -force(u) at every point."""
        return all(term.law.odd for term in self.laws)

    @cached_property
    def capacity(self) -> Array:
        """Bound of |force| at each point, shape (n,)."""
        total = np.zeros(self.size)
        for term in self.laws:
            share = 1.0 if term.weight is None else term.weight
            total[term.at] += share * term.law.capacity
        return total

    @cached_property
    def _only(self) -> Law | None:
        """The law of all points where there is just one."""
        if len(self.laws) == 1 and self.laws[0].weight is None:
            return self.laws[0].law if len(self.laws[0].at) == self.size else None
        return None

    @cached_property
    def _plan(self) -> tuple[Index | None, list[slice], Array | None, list[Index]]:
        """How points are packed so that each law has its own stretch, and how they come back.

        The points in packed order, None where that is their own; each law's stretch; its weights;
        and the places in the packed order that add up to each point, one after the other (the last
        place holds 0).
        """
        packed = np.concatenate([np.zeros(0, dtype=np.intp), *(term.at for term in self.laws)])
        ends = np.cumsum([0, *(len(term.at) for term in self.laws)])
        stretches = [slice(a, b) for a, b in pairwise(ends.tolist())]
        shares = [np.ones(len(t.at)) if t.weight is None else t.weight for t in self.laws]
        weight = np.concatenate(shares) if any(t.weight is not None for t in self.laws) else None
        if np.array_equal(packed, np.arange(self.size)):
            return None, stretches, weight, []
        seen = np.zeros(self.size, dtype=np.intp)
        places = np.full((max(len(self.laws), 1), self.size), len(packed))
        for term, stretch in zip(self.laws, stretches, strict=True):
            places[seen[term.at], term.at] = np.arange(stretch.start, stretch.stop)
            seen[term.at] += 1
        depth = max(int(seen.max(initial=0)), 1)
        return packed, stretches, weight, list(places[:depth])

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at displacements u of shape (..., n): N/m, or N at a tip."""
        if self._only is not None:
            return self._only.evaluate(u)
        packed, stretches, weight, places = self._plan
        v = u if packed is None else u.take(packed, axis=-1)
        force, stiffness = np.empty(v.shape), np.empty(v.shape)
        for term, stretch in zip(self.laws, stretches, strict=True):
            force[..., stretch], stiffness[..., stretch] = term.law.evaluate(v[..., stretch])
        if weight is not None:
            force *= weight
            stiffness *= weight
        if packed is None:
            return force, stiffness
        return _unpacked(force, places), _unpacked(stiffness, places)


def _unpacked(packed: Array, places: list[Index]) -> Array:
    """Sum what belongs to each point; the place after the last holds 0."""
    padded = np.concatenate([packed, np.zeros((*packed.shape[:-1], 1))], axis=-1)
    total = padded.take(places[0], axis=-1)
    for more in places[1:]:
        total += padded.take(more, axis=-1)
    return total
