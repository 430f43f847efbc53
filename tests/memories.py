"""What tests of soil with memory share: walks, tables, soils of each law, and an Iwan model."""

import csv
from pathlib import Path

import numpy as np
from hypothesis import strategies as st

from podeep.soil.axial import CohesiveShaft, CohesiveTip
from podeep.soil.memory import Memory
from podeep.soil.reaction import Reaction, Term
from podeep.soil.sand import Sand
from podeep.soil.soft_clay import SoftClay
from podeep.soil.stiff_clay import StiffClayFreeWater

DATA = Path(__file__).parent / "data"
DEPTH = np.array([1.0, 4.0, 9.0])
CLAY = {
    "depth": DEPTH,
    "diameter": 1.0,
    "effective_overburden": 8e3 * DEPTH,
    "undrained_shear_strength": 20e3 + 1e3 * DEPTH,
    "effective_unit_weight": 8e3,
    "j": 0.5,
    "strain_50": 0.01,
}
SHAFT = {
    "diameter": 1.0,
    "initial_stiffness": 1e8,
    "shape": "2GEO",
    "effective_overburden": 8e3 * DEPTH,
    "undrained_shear_strength": 20e3 + 1e3 * DEPTH,
}
LAWS = {
    "soft clay": SoftClay(**CLAY),
    "cyclic soft clay": SoftClay(**CLAY, cyclic=True),
    "soft clay, cube root": SoftClay(**CLAY, shape="POWER"),
    "sand": Sand(depth=DEPTH, diameter=1.0, effective_overburden=8e3 * DEPTH, friction_angle=0.6),
    "stiff clay": StiffClayFreeWater(
        depth=DEPTH,
        diameter=1.0,
        effective_overburden=8e3 * DEPTH,
        undrained_shear_strength=np.full(3, 1e5),
        mean_undrained_shear_strength=np.full(3, 1e5),
        strain_50=0.007,
        subgrade_modulus=135e6,
    ),
    "shaft": CohesiveShaft(**SHAFT),
}
TIP = CohesiveTip(
    diameter=1.0, initial_stiffness=1e8, shape="2GEO", undrained_shear_strength=DEPTH * 1e4
)


def reaction(law) -> Reaction:
    """One law at its three points."""
    return Reaction(3, (Term(np.arange(3), None, law, "soil", ()),))


def rows(name):
    """Rows of a check table, numbers where they can be."""
    (path,) = DATA.glob(name)
    with path.open() as file:
        lines = (line for line in file if not line.startswith("#"))
        return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def walk(memory: Memory, path, steps: int = 1):
    """Commit a path, points together or each its own, straight legs in so many steps; the forces.

    The work done by the force comes with them, by the trapezoidal rule.
    """
    u = np.zeros(np.shape(path)[1:] or 1)
    last, work, forces = memory.evaluate(u)[0], 0.0, []
    for goal in path:
        start = u
        for share in np.arange(1, steps + 1) / steps:
            new = start + share * (np.atleast_1d(goal) - start) if share < 1 else np.array(goal)
            new = np.broadcast_to(new, last.shape).astype(float)
            force = memory.evaluate(new)[0]
            work = work + 0.5 * (force + last) * (new - u)
            memory.commit(new)
            u, last = new, force
        forces.append(last)
    return np.array(forces), work


def paths(size: int, reach: float, most: int = 25):
    """Paths of a few points, each its own, with returns to where they were."""
    step = st.lists(st.sampled_from(np.linspace(-1, 1, 9) * reach), min_size=size, max_size=size)
    free = st.lists(st.floats(-reach, reach), min_size=size, max_size=size)
    return st.lists(step | free, min_size=1, max_size=most).map(np.array)


class Iwan:
    """Elastic-plastic elements side by side, followed one by one: stiffness each, yield at each."""

    def __init__(self, stiffness, yields):
        self.stiffness, self.yields = np.asarray(stiffness), np.asarray(yields)
        self.elastic, self.u, self.dissipated = np.zeros(len(self.yields)), 0.0, 0.0

    def commit(self, u):
        tried = self.elastic + (u - self.u)
        self.elastic = np.clip(tried, -self.yields, self.yields)
        slip = np.abs(tried - self.elastic)
        self.dissipated += float(self.stiffness @ (self.yields * slip))
        self.u = u

    @property
    def force(self):
        return float(self.stiffness @ self.elastic)

    @property
    def points(self):
        """The backbone, straight lines."""
        return (
            (0.0, 0.0),
            *((s, float(self.stiffness @ np.minimum(self.yields, s))) for s in self.yields),
        )
