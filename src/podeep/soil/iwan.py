"""Masing's rules in two planes: springs side by side that give way, each within a circle."""

from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array, Flags
from .energy import held, softens
from .memory import Memory
from .reaction import Reaction
from .sliders import sliders

_NOTHING = 1e-200  # m: a way that is none, and has the direction of the last one
_TOUCHING = 1e-12  # of the yield: so near to it a spring gives way
_PARTS = 8  # of a way on which a curve falls, whose loss is added up part by part


class Dragged(NamedTuple):
    """Springs of yield 1 at the end of a straight way: see `dragged`.

    along, across: parts of the spring; gives: whether its foot slides; turn: change of the spring
    across itself with its end; rest: of the way, on which the foot slides; first, last: tan(a/2)
    where that begins and ends.
    """

    along: Array
    across: Array
    gives: Flags
    turn: Array
    rest: Array
    first: Array
    last: Array

    @property
    def slip(self) -> Array:
        """Way of the foot."""
        first, last = np.square(self.first), np.square(self.last)
        return np.maximum(self.rest + np.log1p((last - first) / (1.0 + first)), 0.0)


def dragged(along: Array, across: Array, way: Array) -> Dragged:
    """Take springs of yield 1, given by their parts along a straight way and across it, that far.

    A spring keeps its foot until it is as long as its yield; then the foot follows as what is
    dragged by a string. On the rest s of the way the angle a between way and spring falls,

        tan(a/2) = tan(a0/2) exp(-s)

    and the foot goes the integral of cos a: a way in parts is the whole way.
    """
    reach = np.sqrt(np.maximum(1.0 - across * across, 0.0))
    free = reach - along  # of the way, before the foot slides
    np.copyto(free, 0.0, where=free < _TOUCHING)
    gives = (way > free) | (free == 0.0)
    rest = np.where(gives, way - free, 0.0)
    first = across / (1.0 + reach)
    gone = np.expm1(-rest)
    last = first * (1.0 + gone)
    share = 1.0 / (1.0 + last * last)
    cosine, sine = 2.0 * share - 1.0, 2.0 * last * share
    # what the spring turns by with the way's direction: before the foot slides, and then
    before = np.divide(free, reach, out=np.zeros(free.shape), where=reach > 0.0)
    turned = before * (1.0 - across * sine) - (1.0 - before) * gone * (1.0 - first * last) * share
    turned = np.divide(turned, way, out=cosine.copy(), where=way > 0.0)
    turn = np.where(gives, sine * sine + cosine * turned, 1.0)
    cosine, sine = np.where(gives, cosine, along + way), np.where(gives, sine, across)
    return Dragged(cosine, sine, gives, turn, rest, first, last)


class Iwan(Memory):
    """Springs k_i at each point whose feet y_i slide, each spring within a circle.

        p = r sum k_i (y - y_i) ,   |y - y_i| <= Y_i

    y and p are vectors across the tube. `dragged` tells what a straight way does to a spring: in
    how many steps it is gone does not matter. To and fro along any line these are Masing's rules
    (`masing.Masing`) on the curve that all springs make together, `sliders`. r is f/h at the
    largest |y| so far, for a curve f that falls and its envelope h, as in `degrading.Degrading`;
    1 where it does not fall. Energy lost: r k_i Y_i times the way of a foot, and what springs hold
    as r falls.

    Displacements u (m) and forces have shape (n, 2); derivatives are xx, yy and xy of symmetric
    matrices without negative part, (3, n). A spring that gives way has it across itself alone:
    that is exact on a line, and nearly so on ways short of its yield. The fall of r is left out.

    reaction: odd, of a slope that does not rise before it falls. Raises InvalidData otherwise.

    Source: Iwan, J. Appl. Mech. 34 (1967), elements side by side with yield surfaces; the straight
    way on a circle as Krieg and Krieg, J. Press. Vessel Technol. 99 (1977). Both from memory.
    """

    kept: ClassVar[tuple[str, ...]] = ("u", "heading", "elastic", "largest", "ratio", "lost")

    def __init__(self, reaction: Reaction) -> None:
        n = reaction.size
        self.reaction, self.envelope = reaction, held(reaction)
        self.stiffness, self.yields = sliders(self.envelope)
        self.limit = self.stiffness * self.yields
        self.work = self.limit * self.yields  # of a limit over a yield, J/m
        self.falls = softens(reaction)
        self.u, self.heading = np.zeros((n, 2)), np.repeat(((1.0,), (0.0,)), n, axis=1)
        #: the springs over their yields, x and y, (2, m, n)
        self.elastic = np.zeros((2, *self.yields.shape))
        self.largest, self.ratio, self.lost = np.zeros(n), np.ones(n), np.zeros(n)

    def _moved(self, u: Array) -> tuple[Array, Array, Dragged]:
        """Direction of the way to u, (2, n), and the springs at its end, their x and y first."""
        way = u - self.u
        size = np.hypot(way[:, 0], way[:, 1])
        moves = size > _NOTHING
        heading = np.divide(way.T, size, out=self.heading.copy(), where=moves)
        size[~moves] = 0.0
        (x, y), (ex, ey) = heading, self.elastic
        there = dragged(x * ex + y * ey, x * ey - y * ex, size / self.yields)
        elastic = np.empty(self.elastic.shape)
        np.subtract(x * there.along, y * there.across, out=elastic[0])
        np.add(y * there.along, x * there.across, out=elastic[1])
        return heading, elastic, there

    def _left(self, u: Array) -> Array:
        """What a curve that falls has left at u, over its envelope."""
        size = np.hypot(u[:, 0], u[:, 1])
        further = size > self.largest
        if not self.falls or not further.any():
            return self.ratio
        whole, left = self.envelope.evaluate(size)[0], self.reaction.evaluate(size)[0]
        return np.divide(left, whole, out=self.ratio.copy(), where=further & (whole != 0.0))

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        _, elastic, there = self._moved(u)
        ratio, (x, y) = self._left(u), elastic
        force = ratio * (self.limit * elastic).sum(axis=1)
        turn, gives = self.stiffness * there.turn, there.gives
        moduli = np.empty((3, len(u)))
        (turn * np.where(gives, y * y, 1.0)).sum(axis=0, out=moduli[0])
        (turn * np.where(gives, x * x, 1.0)).sum(axis=0, out=moduli[1])
        (turn * np.where(gives, -x * y, 0.0)).sum(axis=0, out=moduli[2])
        return force.T, ratio * moduli

    def commit(self, u: Array) -> None:
        begin = self.u
        if (self._left(u) != self.ratio).any():
            for part in range(1, _PARTS):
                self._go(begin + (part / _PARTS) * (u - begin))
        self._go(u)

    def _go(self, u: Array) -> None:
        before, ratio = self.stored if self.falls else 0.0, self._left(u)
        self.heading, self.elastic, there = self._moved(u)
        lost = 0.5 * (self.ratio + ratio) * (self.work * there.slip).sum(axis=0)
        if self.falls:
            lost += 0.5 * (self.ratio - ratio) * (before + self.stored)
        self.lost, self.ratio, self.u = self.lost + lost, ratio, np.array(u)
        self.largest = np.maximum(self.largest, np.hypot(u[:, 0], u[:, 1]))

    @property
    def stored(self) -> Array:
        """Energy in the springs, before what a curve that falls has left of it, J/m."""
        return np.asarray(0.5 * (self.work * np.square(self.elastic).sum(axis=0)).sum(axis=0))

    @property
    def dissipated(self) -> Array:
        return self.lost
