"""Tubes beside each other: which of them move as one element, and where elements meet.

All tubes of a foundation are cut at the same depths, into intervals. In an interval every group of
tubes that move together is one element; at an edge the tubes that are joined there share a joint.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array, Index


@dataclass(frozen=True)
class Strings:
    """The elements of all tubes, from the top down, those of one interval side by side.

    interval: of each element, shape (elements,). joints: at the top and the bottom of each
    element, shape (elements, 2). edge: of each joint, rising, shape (joints,). carrier: the
    element that a tube is part of in each interval, -1 where there is none, (tubes, intervals).
    """

    interval: Index
    joints: Index
    edge: Index
    carrier: Index

    @cached_property
    def reach(self) -> tuple[Index, Index]:
        """First and last interval of each tube, shape (tubes,) each."""
        there = self.carrier >= 0
        return there.argmax(axis=1), there.shape[1] - 1 - there[:, ::-1].argmax(axis=1)

    @cached_property
    def leader(self) -> Index:
        """The outermost tube of each element, shape (elements,)."""
        found = np.zeros(len(self.interval), dtype=np.intp)
        for tube in reversed(range(len(self.carrier))):
            there = self.carrier[tube] >= 0
            found[self.carrier[tube][there]] = tube
        return found

    def element(self, interval: Index, tube: Index | int) -> Index:
        """The element of a tube in each interval; beyond its ends the nearest it has."""
        first, last = self.reach
        inside = np.minimum(np.maximum(interval, first[tube]), last[tube])
        return np.asarray(self.carrier[tube, inside])

    def joint(self, edge: int, tube: int) -> int:
        """The joint of a tube at an edge, or at its end that is nearest."""
        first, last = (int(r[tube]) for r in self.reach)
        if edge > last:
            return int(self.joints[self.carrier[tube, last], 1])
        return int(self.joints[self.carrier[tube, max(edge, first)], 0])

    def number(self, nodal: int, internal: int) -> Index:
        """Unknowns of each element, (elements, 2 nodal + internal), those of its top joint first.

        They are numbered from the top down, the joints of an edge before what lies inside the
        elements below it, which keeps the band as narrow as it can be.
        """
        joints, elements = len(self.edge), len(self.interval)
        place = np.concatenate([2 * self.edge, 2 * self.interval + 1])
        amount = np.concatenate([np.full(joints, nodal), np.full(elements, internal)])
        order = np.argsort(place, kind="stable")
        start = np.empty(joints + elements, dtype=np.intp)
        start[order] = np.cumsum(amount[order]) - amount[order]
        ends = start[self.joints][..., None] + np.arange(nodal)
        inner = start[joints:, None] + np.arange(internal)
        return np.concatenate([ends[:, 0], inner, ends[:, 1]], axis=1)


def chain(intervals: int) -> Strings:
    """One tube alone."""
    every = np.arange(intervals)
    joints = np.stack([every, every + 1], axis=1)
    return Strings(every, joints, np.arange(intervals + 1), every[None])


def woven(groups: Index, joined: Index) -> Strings:
    """Tubes of which some are joined.

    groups: for each interval and tube the outermost of the tubes that it moves with, itself if it
    moves alone, -1 where it is not, shape (intervals, tubes). joined: the same for every edge,
    shape (intervals + 1, tubes).
    """
    own = np.arange(groups.shape[1])
    leads, meets = groups == own, joined == own
    numbers = np.cumsum(leads).reshape(groups.shape) - 1
    places = np.cumsum(meets).reshape(joined.shape) - 1
    interval, leader = np.nonzero(leads)
    rows = np.arange(len(groups))[:, None]
    carrier = np.where(groups >= 0, numbers[rows, groups], -1)
    joints = np.stack([places[e, joined[e, leader]] for e in (interval, interval + 1)], axis=1)
    return Strings(interval, joints, np.nonzero(meets)[0], carrier.T)


def summed(strings: Strings, amounts: Array) -> Array:
    """Sum of an amount over the tubes of each element; amounts: shape (intervals, tubes)."""
    there = strings.carrier.T >= 0
    size = len(strings.interval)
    return np.bincount(strings.carrier.T[there], amounts[there], size).astype(np.float64)
