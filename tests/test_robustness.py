"""Every law at loads from light ones to beyond what the tube bears, whatever mesh and steps.

A seeded part of the grid; `python tests/bench/robustness_grid.py` runs the whole and prints what
the budgets here were taken from.
"""

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from grid import ARM, MESHES, SHARES, STEPS, STUB, SURE, Case, Run, part, pushed, runs, ways
from grid_soils import ASIDE, DOWN, LATERAL, SOFTENING
from podeep.soil.lateral_capacity import rigid_mechanism
from podeep.soil.profile import profile_of

SOILS = (*ASIDE, *DOWN)
# Iterations that the worst step below the capacity takes, iterations a step there on the mean, and
# factorisations of a run above it on the mean, nearly all spent on halving the step at the peak.
BUDGETS = {
    "soft clay": (11, 2.2, 150),
    "soft clay, WSD": (10, 1.6, 140),
    "soft clay, cube root": (21, 5.0, 220),
    "sand": (11, 2.8, 130),
    "cyclic sand": (11, 2.6, 120),
    "Reese sand": (11, 2.4, 140),
    "cyclic Reese sand": (11, 2.4, 120),
    "stiff clay": (28, 6.5, 180),
    "cyclic stiff clay": (23, 7.0, 240),
    "weak rock": (16, 5.1, 270),
    "ISO clay": (11, 2.5, 140),
    "ISO clay, low plasticity": (12, 2.6, 160),
    "PISA clay": (14, 3.1, 150),
    "PISA clay, Bothkennar": (15, 3.1, 120),
    "PISA sand": (18, 5.1, 420),
    "user, elastic-plastic": (10, 0.8, 170),
    "user, gap": (13, 2.5, 170),
    "cyclic soft clay": (9, 1.6, 120),
    "cyclic soft clay, cube root": (20, 5.3, 140),
    "stiff clay in free water": (11, 3.2, 170),
    "cyclic stiff clay in free water": (13, 2.3, 130),
    "user, softening": (8, 0.7, 130),
    "clay shaft": (11, 1.6, 170),
    "sand shaft": (11, 2.5, 160),
    "sand shaft, API": (10, 1.5, 150),
    "sand shaft, 2GEO": (10, 1.8, 150),
    "direct shaft": (11, 1.3, 170),
    "direct shaft, 2GEO": (11, 1.7, 160),
    "user shaft": (7, 0.8, 150),
    "clay shaft, API": (9, 1.4, 140),
    "clay shaft, 2GEO, residual 0.7": (9, 1.6, 130),
    "direct shaft, 2GEO, residual 0.8": (9, 1.7, 150),
    "user shaft, residual": (8, 0.6, 140),
}
# A step is guessed from the tangent at its start: fewer iterations, one factorisation more.
RUNS, ITERATIONS, FACTORISATIONS, STOPS = 2112, 22_200, 30_000, 74_000


@cache
def of(soil: str) -> Sequence[Run]:
    return [r for way in ways(soil) for r in runs(soil, way, part(f"{soil}; {way}"))]


def below(found: Sequence[Run]) -> list[Run]:
    return [r for r in found if r.share <= SURE]


def above(found: Sequence[Run]) -> list[Run]:
    return [r for r in found if r.share > SURE]


def test_the_grid_spans_what_it_should() -> None:
    assert (min(MESHES), max(MESHES)) == (4, 48)
    assert (min(STEPS), max(STEPS)) == (1, 50)
    assert (min(SHARES), max(SHARES)) == (0.1, 1.5)
    assert BUDGETS.keys() == set(SOILS)


@pytest.mark.parametrize("soil", SOILS)
def test_no_load_below_the_capacity_fails(soil: str) -> None:
    found = below(of(soil))
    assert not [r for r in found if r.wrong]
    most, mean, _ = BUDGETS[soil]
    assert max(r.most for r in found) <= most
    assert sum(r.iterations for r in found) <= mean * sum(r.steps for r in found)


@pytest.mark.parametrize("soil", SOILS)
def test_loads_above_stop_at_the_capacity_and_name_it(soil: str) -> None:
    """Within 1e-3 of a rigid mechanism on the same Gauss points, or of the peak as it is moved."""
    found = above(of(soil))
    assert not [r for r in found if r.wrong]
    assert sum(r.factorisations for r in found) <= BUDGETS[soil][2] * len(found)


def test_the_whole_part_keeps_to_its_budget() -> None:
    found = [r for soil in SOILS for r in of(soil)]
    assert len(found) == RUNS
    sure, stopped = below(found), above(found)
    assert sum(r.iterations for r in sure) <= ITERATIONS
    assert sum(r.factorisations for r in sure) <= FACTORISATIONS
    assert sum(r.factorisations for r in stopped) <= STOPS


@pytest.mark.parametrize("soil", LATERAL)
def test_the_mechanism_of_many_elements_is_that_of_the_ground(soil: str) -> None:
    """Between the two stand only the points at which the ground is taken."""
    scene = Case(soil, "free", 48).scene
    profile = profile_of(scene, scene.foundations[0])
    width, length = STUB.outer_diameter, -STUB.bottom
    exact = rigid_mechanism(profile, lambda z: np.full(len(z), width), length, (1.0, ARM))
    assert Case(soil, "free", 48).capacity == pytest.approx(exact.lateral_load, rel=2e-3)
    assert Case(soil, "fixed", 48).capacity == pytest.approx(exact.translation, rel=2e-3)


@pytest.mark.parametrize("soil", SOFTENING)
@pytest.mark.parametrize("way", ["free", "fixed"])
def test_a_peak_does_not_depend_on_the_steps_that_lead_to_it(soil, way):
    case = Case(soil, way, 24)
    peaks = [pushed(case, 1.3, steps).reached for steps in (1, 3, 10)]
    assert max(peaks) - min(peaks) <= 2e-4 * max(peaks)
