"""Natural frequencies and mode shapes about a static state.

    K phi = omega^2 M phi

K is the tangent of soil, springs and, with P-delta, normal force at that state, M the mass of
tubes and of what stands on them. The mesh of the statics is halved until no frequency asked for
changes by more than the accuracy.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf, pi, sqrt

import numpy as np
from scipy.linalg import LinAlgError

from ..arrays import Array
from ..beam.band import band_times
from ..errors import AnalysisFailed, Fault, UserError
from ..model.assemble import Model
from ..model.needs import isotropic
from ..scene import Foundation, Scene
from .about_state import state_of, suited
from .analysis import rebuilt
from .families import Family, families

SECANT = 1e-3  # displacement whose secant takes the place of an infinite slope at rest, m
_PLACES = 41  # depths of each tube at which shapes are given
_ROUNDS = 8  # of refinement
_PATIENCE = 2  # rounds without a better mesh
_MOST_ELEMENTS = 1000
_SHORT = 2e-3  # of the length of all tubes: elements that are not halved
_LEAST = 1e-10  # error that rounding alone may make
_STRAIGHT = 0.01  # degrees between a direction and an axis that bears its name


@dataclass(frozen=True, eq=False)
class Mode:
    """One natural mode.

    kind: "lateral", with its direction where it has one, or "axial". frequency: Hz, 0 of a tube
    that moves as nothing holds it. error: estimated, relative. participating: effective mass in a
    shake of the ground along the mode, kg. mass: modal mass, kg, with the largest displacement
    taken as 1. shape: displacement of each tube at the depths of `Modes`, (depths,).
    """

    kind: str
    frequency: float
    error: float
    participating: float
    mass: float
    shape: tuple[Array, ...]

    @property
    def period(self) -> float:
        """s"""
        return 1.0 / self.frequency if self.frequency else inf


@dataclass(frozen=True, eq=False)
class Modes:
    """The lowest modes of a foundation, by rising frequency.

    depths: of each tube, m below the mudline. lateral_mass, axial_mass: all there is, kg.
    accuracy: relative, what was asked for. notes: what has to be known of them.
    """

    foundation: Foundation
    step: int
    modes: tuple[Mode, ...]
    depths: tuple[Array, ...]
    lateral_mass: float
    axial_mass: float
    elements: int
    accuracy: float
    notes: tuple[str, ...]

    @property
    def error(self) -> float:
        return max((m.error for m in self.modes), default=0.0)


def modes(
    scene: Scene, foundation: Foundation, count: int, step: int = 0, secant: float = SECANT
) -> Modes:
    """The `count` lowest modes about the state of a step; step 0 is at rest.

    secant: displacement (m) whose secant stands for a reaction with an infinite slope at rest.
    Raises UserError where there is no such step or no mass, AnalysisFailed where the step has no
    equilibrium or is not stable.
    """
    steps = len(scene.steps.factors)
    if not 0 <= step <= steps:
        raise UserError(Fault(f"there is no step {step}", f"the deck has steps 0 to {steps}"))
    model = suited(scene, foundation, step)
    while model.elements < 2 * count and scene.numerics.elements is None:
        model = rebuilt(scene, model, halved(model.edges), 0)
    coarse = found_on(scene, model, count, step, secant)
    best, stale = coarse, 0
    for _ in range(_ROUNDS):
        finer = rebuilt(scene, model, halved(model.edges), 0)
        fine = with_errors(found_on(scene, finer, count, step, secant), coarse)
        if scene.numerics.elements is not None:
            return with_errors(coarse, fine)
        known = best is not coarse
        best, stale = (best, stale + 1) if known and fine.error > best.error else (fine, 0)
        enough = best.error <= best.accuracy or stale == _PATIENCE
        if enough or 2 * finer.elements > _MOST_ELEMENTS:
            break
        model, coarse = finer, fine
    return best


def halved(edges: Array) -> Array:
    """Edges with one more in the middle of each element that is not so short as to be rounding."""
    middle = 0.5 * (edges[:-1] + edges[1:])
    return np.union1d(edges, middle[np.diff(edges) > _SHORT * np.ptp(edges)])


def with_errors(one: Modes, other: Modes) -> Modes:
    """Modes with their changes from those on another mesh as errors."""
    errors = []
    for mode, before in zip(one.modes, other.modes, strict=False):
        scale = max(mode.frequency, before.frequency)
        change = abs(mode.frequency - before.frequency)
        errors.append(max(change / scale, _LEAST) if scale else 0.0)
    errors += [1.0] * (len(one.modes) - len(errors))
    told = tuple(replace(m, error=e) for m, e in zip(one.modes, errors, strict=True))
    return replace(one, modes=told)


def found_on(scene: Scene, model: Model, count: int, step: int, secant: float) -> Modes:
    """The modes on the mesh of a model, without an estimate of their errors."""
    state = state_of(scene, model, step)
    every, steep = families(scene, model, state, secant)
    tubes = (scene.tubes[t] for t in model.foundation.tubes)
    mudline = model.foundation.mudline
    depths = tuple(np.linspace(mudline - t.top, mudline - t.tip, _PLACES) for t in tubes)
    found: list[tuple[float, float, Family, Array]] = []
    for family in every:
        try:
            squares, states, masses = family.solved(count)
        except LinAlgError:
            squares, states, masses = np.full(1, -inf), np.zeros((1, 0)), np.ones(1)
        if squares.min(initial=0.0) < 0.0:
            raise AnalysisFailed(
                f"{model.foundation.name}: step {step} is not stable: a motion from it grows "
                "instead of coming back, so it has no frequency"
            )
        for square, mass, q in zip(squares.tolist(), masses.tolist(), states, strict=True):
            found.append((square, mass, family, q))
    found.sort(key=lambda one: one[0])
    made = [mode_of(model, *one, depths) for one in found[:count]]
    told = list(notes(scene, model, pushed=bool(state.axial.any())))
    if steep:
        told.append(
            f"reaction curves with an infinite slope at rest act by their secants at {secant:g} m: "
            "frequencies depend on how far the tubes move (--secant)"
        )
    return Modes(
        *(model.foundation, step, tuple(made), depths, every[0].total, every[-1].total),
        *(model.elements, scene.numerics.accuracy, tuple(told)),
    )


def mode_of(
    model: Model,
    square: float,
    mass: float,
    family: Family,
    q: Array,
    depths: tuple[Array, ...],
) -> Mode:
    """A mode from its unknowns and their modal mass, normalised and named."""
    system, tubes = family.system, range(len(depths))
    unknowns = q.reshape(-1, system.components)
    element = system.field.edges
    fine = halved(halved(element))
    moved = np.concatenate([system.field.interpolation(fine, 0, t) @ unknowns for t in tubes])
    place = int(np.argmax(np.linalg.norm(moved, axis=1)))
    direction = np.linalg.svd(moved, full_matrices=False)[2][0]
    direction *= np.sign(direction[np.argmax(np.abs(direction))])
    scale = 1.0 / float(moved[place] @ direction)
    shared = float(q @ band_times(family.mass, family.translation(direction)))
    shape = tuple(
        scale * (system.field.interpolation(x, 0, t) @ unknowns @ direction)
        for t, x in zip(tubes, depths, strict=True)
    )
    kind = "axial" if family.lengthwise else f"lateral{named(model, direction)}"
    return Mode(kind, sqrt(square) / (2.0 * pi), 0.0, shared**2 / mass, mass * scale**2, shape)


def named(model: Model, direction: Array) -> str:
    """The direction of a lateral mode in words; nothing where all directions are alike."""
    if model.needs.components == 1:
        return ""
    angle = float(np.degrees(np.arctan2(direction[1], direction[0])))
    for name, axis in ((" x", 0.0), (" y", 90.0), (" x", 180.0), (" y", -90.0)):
        if abs(angle - axis) < _STRAIGHT:
            return name
    return f" {angle % 180.0:.0f} deg"


def notes(scene: Scene, model: Model, *, pushed: bool) -> Iterator[str]:
    """What has to be known of the modes; pushed: the state has a normal force."""
    if model.needs.components == 1:
        axis = model.needs.lateral_axis or 0.0
        if isotropic(scene, model.foundation):
            yield "each lateral mode is there in every vertical plane"
        else:
            yield f"lateral modes are those in the plane at {axis:g} degrees from x"
    if model.needs.second_order and pushed:
        yield "the normal force of the step works on the slope (P-delta)"
    if model.needs.shear:
        yield "tubes are soft in shear and have rotary inertia"
