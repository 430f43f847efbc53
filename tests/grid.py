"""The robustness grid: tubes in every soil, pushed to any share of what they bear.

A stub, so stiff that its soil is mobilised all along; for shafts a slender tube as well, whose
head moves far before its tip does. `grid_oracles` finds what they bear by other means.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any, Literal

import numpy as np
from scipy.linalg import lapack

from grid_oracles import mechanism, peak, translation
from grid_soils import ASIDE, DOWN, RESIDUAL, SOFTENING
from podeep.model.assemble import Model
from podeep.scene import (
    Curve,
    Displacement,
    Foundation,
    Ground,
    Load,
    Numerics,
    Scene,
    Section,
    Steps,
    Support,
    Tube,
)
from podeep.solve.accuracy import unestimated
from podeep.solve.analysis import Solved, first_model, limits, run
from podeep.solve.diagnosis import explain

Way = Literal["free", "fixed", "down", "up", "slender down", "slender up"]
LATERAL_WAYS: tuple[Way, ...] = ("free", "fixed")
AXIAL_WAYS: tuple[Way, ...] = ("down", "up", "slender down", "slender up")
ARM = 1.0  # of the load above the mudline, m
STUB = Section(ARM, -12.0, 1.5, 0.05, 210e9, 7850.0)
SLENDER = Section(ARM, -60.0, 0.6, 0.02, 210e9, 7850.0)
BESIDE = Curve(1, "user", {"effective_unit_weight": 9e3}, {}, ((1e5, 0.02, 0.0, 0.0),))
MESHES, STEPS = (4, 6, 8, 12, 24, 48), (1, 3, 10, 50)
SHARES = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.985, 1.01, 1.02, 1.1, 1.5)
SURE = 0.99  # of the capacity: no run up to here may fail


@dataclass(frozen=True)
class Case:
    """A soil, how the tube is held and pushed, and the number of elements."""

    soil: str
    way: Way
    elements: int

    @property
    def lateral(self) -> bool:
        return self.way in LATERAL_WAYS

    @property
    def scene(self) -> Scene:
        """The tube pushed at its head by 1 N."""
        aside = ASIDE[self.soil] if self.lateral else BESIDE
        down = BESIDE if self.lateral else DOWN[self.soil]
        section = SLENDER if self.way.startswith("slender") else STUB
        vertical = 0.0 if self.lateral else -1.0 if self.way.endswith("down") else 1.0
        force = (1.0 if self.lateral else 0.0, 0.0, vertical)
        tip = (Support(1, section.bottom, ("Z",)),) if self.lateral else ()
        head = (Support(1, ARM, ("RY",)),) if self.way == "fixed" else ()
        return Scene(
            "robustness",
            {1: Tube(1, "TUBE", (section,))},
            (Foundation(1, (1,), 0.0),),
            Ground((0.0,), (1,), (1,), {1: aside}, {1: down}),
            supports=tip + head,
            loads=(Load("PUSH", 1, ARM, force, (0.0, 0.0, 0.0)),),
            steps=Steps(("PUSH",), ((1.0,),)),
            numerics=Numerics(elements=self.elements),
        )

    @cached_property
    def model(self) -> Model:
        """The tube pushed by its capacity: load factors are shares of it."""
        return _scaled(_model(self.scene), self.capacity)

    @cached_property
    def capacity(self) -> float:
        """Largest load on this very model, N."""
        if self.soil in SOFTENING or self.soil in RESIDUAL:
            sense = -1.0 if self.way.endswith("down") else 1.0
            move = Displacement("MOVE", 1, ARM, "X" if self.lateral else "Z", sense)
            steps = Steps(("MOVE",), ((1.0,),))
            moved = replace(self.scene, loads=(), displacements=(move,), steps=steps)
            return peak(_model(moved), limits(moved), lateral=self.lateral)
        model = _model(self.scene)
        if self.lateral:
            return translation(model) if self.way == "fixed" else mechanism(model, ARM)
        points = model.axial.system.points
        parts = [float(p.weight @ p.reaction.capacity) for p in points]
        return sum(parts) if self.way.endswith("down") else parts[0]


def _model(scene: Scene) -> Model:
    return first_model(scene, scene.foundations[0])


def _scaled(model: Model, times: float) -> Model:
    lateral, axial = (replace(p, forces=p.forces * times) for p in (model.lateral, model.axial))
    return replace(model, lateral=lateral, axial=axial)


@dataclass(frozen=True)
class Run:
    """What came of a case under a share of its capacity in so many steps.

    reached: share of the capacity; told: why it ended, empty if it did not. iterations: of all
    steps and the most of one. halved: a step was cut on the way.
    """

    case: Case
    share: float
    steps: int
    reached: float
    told: str
    iterations: int
    most: int
    factorisations: int
    halved: bool

    @property
    def wrong(self) -> bool:
        """It failed where it should not, or its peak is not the capacity."""
        if self.share <= SURE:
            return bool(self.told)
        named = f"PUSH {self.reached:.4g}" in self.told
        return not named or abs(self.reached - 1.0) > 1e-3


def pushed(case: Case, share: float, steps: int) -> Run:
    """Push a case to a share of its capacity."""
    factors = share * np.arange(1, steps + 1)[:, None] / steps
    model, limit = case.model, limits(case.scene)
    with counted() as count:
        states, failure, _ = run(model, factors, limit)
    told = ""
    if failure:
        none = unestimated(len(states))
        told = explain(
            Solved(model, tuple(states), (none, none), failure, 1e-3), failure, ("PUSH",)
        )
    each = [state.iterations for state in states]
    return Run(
        case,
        share,
        steps,
        float(failure.factors[0]) if failure else share,
        told,
        sum(each),
        max(each),
        count[0],
        any(state.step_size < 1.0 for state in states),
    )


@contextmanager
def counted() -> Iterator[list[int]]:
    """Count what LAPACK factors meanwhile, in a list of one."""
    count, kept = [0], {name: getattr(lapack, name) for name in ("dpbsv", "dpbtrf")}

    def counting(solve: Any) -> Any:
        def one_more(*given: Any, **named: Any) -> Any:
            count[0] += 1
            return solve(*given, **named)

        return one_more

    for name, solve in kept.items():
        setattr(lapack, name, counting(solve))
    try:
        yield count
    finally:
        for name, solve in kept.items():
            setattr(lapack, name, solve)


Setting = tuple[int, float, int]  # elements, share, steps


def ways(soil: str) -> tuple[Way, ...]:
    return LATERAL_WAYS if soil in ASIDE else AXIAL_WAYS


def whole() -> list[Setting]:
    return list(product(MESHES, SHARES, STEPS))


def part(seed: str) -> list[Setting]:
    """The corners of the grid, and some of the rest by lot."""
    corners = [
        *product((4, 48), (0.1, 0.5, 0.9, 0.985), (1, 10)),
        *product((4, 48), (1.02, 1.5), (1,)),
    ]
    rest = [setting for setting in whole() if setting not in corners]
    lot = np.random.default_rng(list(seed.encode())).choice(len(rest), 4, replace=False)
    return corners + [rest[i] for i in sorted(lot)]


def runs(soil: str, way: Way, settings: Sequence[Setting]) -> list[Run]:
    cases = {n: Case(soil, way, n) for n in {elements for elements, *_ in settings}}
    return [pushed(cases[n], share, steps) for n, share, steps in settings]
