"""What a discrete model bears, without pushing it: rigid mechanisms of it, and its own peak."""

from dataclasses import replace

import numpy as np

from podeep.arrays import Array
from podeep.model.assemble import Model
from podeep.solve.analysis import run
from podeep.solve.newton import Limits

_MOVES = 60  # of the head on the way to the largest move, and again about the peak
_LARGEST = 1.5  # m


def translation(model: Model) -> float:
    """Load on a rigid tube that cannot turn: all points at their capacity."""
    points = model.lateral.system.points
    return sum(float(p.weight @ p.reaction.capacity) for p in points if p.motion == "value")


def mechanism(model: Model, arm: float) -> float:
    """Load at `arm` (m) above the mudline that turns a rigid tube about one of its Gauss points.

    All others are at their capacity. The pivot, at depth z, keeps what is left to balance, a share
    s of its own between -1 and 1; a couple that follows its |p| has the share |s|. With f
    capacities times weights,

        H (z + arm) = sum f_j |z - z_j| + couples        H = sum f_j sign(z - z_j) + s f
    """
    points = model.lateral.system.points
    held = [p for p in points if p.motion == "value"]
    z = np.concatenate([p.x for p in held])
    f = np.concatenate([p.weight * p.reaction.capacity for p in held])
    couple, following = 0.0, np.zeros(len(z))
    for p in points:
        if p.motion == "rotation" and p.follows is None:
            couple += float(p.weight @ p.reaction.capacity)
        elif p.motion == "rotation":
            assert p.follows == 0
            leader = points[0].reaction.capacity
            following[: len(p.x)] = p.weight * p.reaction.capacity * leader
    found = []
    for at, capacity, own in zip(z, f, following, strict=True):
        work = float(f @ np.abs(at - z)) + couple + float(following.sum() - own)
        balance = float(f @ np.sign(at - z))
        for side in (1.0, -1.0):
            matrix = np.array([[at + arm, -side * own], [1.0, -capacity]])
            load, share = np.linalg.solve(matrix, [work, balance])
            if 0.0 <= side * share <= 1.0:
                found.append(float(load))
    return min(found)


def peak(model: Model, limits: Limits, *, lateral: bool) -> float:
    """Largest force on a head that is moved (1 m times the factor) instead of pushed, N.

    First by moves that grow evenly in their ratio, then by even ones about the largest force; what
    a tip still gains when a shaft has lost may make that the last one.
    """
    moves = np.geomspace(1e-4, _LARGEST, _MOVES)
    at = int(_forces(model, moves, limits, lateral=lateral).argmax())
    assert at > 0
    fine = np.linspace(moves[at - 1], moves[min(at + 1, _MOVES - 1)], _MOVES)
    return float(_forces(model, fine, limits, lateral=lateral).max())


def _forces(model: Model, moves: Array, limits: Limits, *, lateral: bool) -> Array:
    """Force on the head after each move, N."""
    states, failure, _ = run(model, moves[:, None], replace(limits, residual=1e-9))
    assert failure is None
    problem = model.lateral if lateral else model.axial
    head = int(np.flatnonzero(problem.imposed[0])[0])
    unknowns = [s.lateral if lateral else s.axial for s in states[1:]]
    return np.array([abs(problem.system.internal(q)[head]) for q in unknowns])
