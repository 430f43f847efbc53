"""The reaction of the soil at many points: laws, each at its points, added up."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import accumulate, groupby
from typing import Any

import numpy as np

from ..arrays import Array, Index
from .law import Law
from .polyline import Polyline
from .way import NOWHERE

_MOST_NODES = 64  # of straight lines that are evaluated together
_Evaluate = Callable[[Array], tuple[Array, Array]]


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
    """The soil's reaction at n points: a weighted sum of laws; none is no reaction.

    often: it is evaluated so often that straight lines side by side are first made one.
    """

    size: int
    laws: tuple[Term, ...]
    often: bool = False

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
    def corners(self) -> Array:
        """As `Law.corners`, of all laws at each point; `NOWHERE` where a point has fewer."""
        found, count = [term.law.corners for term in self.laws], np.zeros(self.size, dtype=np.intp)
        total = np.full((sum(map(len, found)), self.size), NOWHERE)
        for term, corners in zip(self.laws, found, strict=True):
            for one in corners:
                total[count[term.at], term.at] = one
                count[term.at] += 1
        return total[: int(count.max(initial=0))]

    @classmethod
    def joined(cls, parts: "Sequence[Reaction]") -> "Reaction":
        """Reactions at one part's points after the other's, to be evaluated often."""
        starts = list(accumulate((part.size for part in parts), initial=0))
        moved = [
            replace(term, at=term.at + start)
            for part, start in zip(parts, starts, strict=False)
            for term in part.laws
        ]
        return cls(starts[-1], tuple(moved), often=True)

    @cached_property
    def _pieces(self) -> list[tuple[_Evaluate, slice]]:
        """What is evaluated at which packed points."""
        found = _side_by_side(self.laws) if self.often else [_alone(term) for term in self.laws]
        ends = accumulate(count for _, count in found)
        return [(of, slice(end - n, end)) for (of, n), end in zip(found, ends, strict=True)]

    @cached_property
    def _plan(self) -> tuple[Index | None, Array | None, list[Index]]:
        """How points are packed so that each law has its own stretch, and how they come back.

        The points in packed order, None where that is their own; their weights; and the places in
        the packed order that add up to each point, one after the other (the last place holds 0).
        """
        packed = np.concatenate([np.zeros(0, dtype=np.intp), *(term.at for term in self.laws)])
        weight = None
        if any(t.weight is not None for t in self.laws):
            shares = [np.ones(len(t.at)) if t.weight is None else t.weight for t in self.laws]
            weight = np.concatenate(shares)
        if np.array_equal(packed, np.arange(self.size)):
            return None, weight, []
        seen = np.zeros(self.size, dtype=np.intp)
        places = np.full((max(len(self.laws), 1), self.size), len(packed))
        first = 0
        for term in self.laws:
            places[seen[term.at], term.at] = np.arange(first, first + len(term.at))
            seen[term.at] += 1
            first += len(term.at)
        depth = max(int(seen.max(initial=0)), 1)
        return packed, weight, list(places[:depth])

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at displacements u of shape (..., n): N/m, or N at a tip."""
        packed, weight, places = self._plan
        v = u if packed is None else u.take(packed, axis=-1)
        pieces = self._pieces
        if len(pieces) == 1:
            force, stiffness = pieces[0][0](v)
        else:
            force, stiffness = np.empty(v.shape), np.empty(v.shape)
            for evaluate, stretch in pieces:
                at = stretch if v.ndim == 1 else (..., stretch)
                force[at], stiffness[at] = evaluate(v[at])
        if weight is not None:
            force, stiffness = force * weight, stiffness * weight
        if packed is None:
            return force, stiffness
        return _unpacked(force, places), _unpacked(stiffness, places)


def _alone(term: Term) -> tuple[_Evaluate, int]:
    return term.law.evaluate, len(term.at)


def _side_by_side(laws: Sequence[Term]) -> list[tuple[_Evaluate, int]]:
    """What is evaluated and at how many points, straight lines side by side as one."""
    found: list[tuple[_Evaluate, int]] = []
    for lines, group in groupby(laws, lambda term: plain_lines(term.law) is not None):
        terms = list(group)
        curves = [curve for term in terms if (curve := plain_lines(term.law))]
        if lines and sum(len(curve.nodes) for curve in curves) <= _MOST_NODES:
            found.append((Polyline.joined(curves).evaluate, sum(len(t.at) for t in terms)))
        else:
            found += map(_alone, terms)
    return found


def plain_lines(law: Law) -> Polyline | None:
    """The straight lines that a law is; None where it is more, or their nodes differ by point."""
    return lines if type(lines := law.polyline) is Polyline else None


def _unpacked(packed: Array, places: list[Index]) -> Array:
    """Sum what belongs to each point; the place after the last holds 0."""
    padded = np.concatenate([packed, np.zeros((*packed.shape[:-1], 1))], axis=-1)
    total = padded.take(places[0], axis=-1)
    for more in places[1:]:
        total += padded.take(more, axis=-1)
    return total
