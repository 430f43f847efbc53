"""A foundation set in motion: from its state at the end of statics to equations of motion."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..arrays import Array, Index
from ..beam.band import element_band
from ..beam.rows import Rows
from ..errors import Fault, UserError
from ..model.assemble import Model, Problem, assemble
from ..model.compression import compression
from ..model.coupling import pressing, rubs
from ..model.inertia import mass_band
from ..model.points import Points
from ..model.remember import remembered
from ..model.system import System
from ..scene import Scene
from ..soil.profile import Profile, profile_of
from .drive import Drive, drive
from .moving import Moving
from .statics import State

Which = Literal["lateral", "axial"]
_FROM_STATICS = (0, 1)  # rules of the ground by which the soil's motion counts from statics' end


@dataclass(frozen=True, eq=False)
class Squeeze:
    """The normal force of a stretch on the slope of the deflection, while both move.

    slopes: a system of the points where it acts. still: N there at the end of statics, (points,).
    rest: the stretch's unknowns then. strains: of each tube, at those of the points where it is a
    part of what deflects: their places, its EA there (N), and from unknowns to its strain.
    """

    slopes: System
    still: Array
    rest: Array
    strains: tuple[tuple[Index, Array, Rows], ...]

    def band(self, axial: Array) -> Array:
        """What the normal force takes from the stiffness, lower band (width, size)."""
        force, moved = self.still.copy(), axial - self.rest
        for there, stiffness, strain in self.strains:
            force[there] -= stiffness * (strain @ moved)
        return self.slopes.spread(force)


@dataclass(frozen=True, eq=False)
class Body:
    """A foundation in motion.

    static: its model at the end of statics, and `rest` the state there. model: the same with the
    curves of motion. sways: something moves across the tubes. axial: None where nothing moves along
    them. squeeze: None where the normal force does not count.
    """

    static: Model
    rest: State
    model: Model
    lateral: Moving
    axial: Moving | None
    squeeze: Squeeze | None
    sways: bool

    @property
    def moving(self) -> list[Moving]:
        """Problems in which something moves."""
        return [m for m in (self.lateral if self.sways else None, self.axial) if m is not None]


def body(scene: Scene, static: Model, rest: State) -> Body:
    """Set a foundation in motion from a static state.

    Raises UserError for what is solved in statics alone.
    """
    check_moves(scene, static)
    dynamics, foundation = scene.dynamics, static.foundation
    assert dynamics is not None
    plain, model = (
        first_order(scene, static, profile_of(scene, foundation, dynamic=moving))
        for moving in (False, True)
    )
    pushes = drive(scene, dynamics.start)

    def moving(which: Which) -> Moving:
        problem, system = softened(getattr(model, which), rest)
        q = getattr(rest, which)
        origin, base = np.zeros_like(q), np.zeros_like(q)
        if scene.ground.dynamic_rule in _FROM_STATICS:
            at_rest = getattr(plain, which).system
            origin, base = q, at_rest.softened(system.softening).internal(q)
        mass = mass_band(scene, model, which)
        lossy = damping(scene, model, problem, mass, which)
        memory = remembered(system, scene.numerics.hysteresis, foundation.name)
        made = Moving(problem, mass, lossy, pushes, origin, base, memory)
        made.commit(q)
        return made

    lateral = moving("lateral")
    axial = moving("axial") if moves(scene, model, pushes, "axial") else None
    squeeze = squeezed(model, static, rest) if static.needs.second_order else None
    if squeeze is not None:
        lateral.press(squeeze.band(rest.axial))
    bent = squeeze is not None and axial is not None and bool(rest.lateral.any())
    sways = bent or moves(scene, model, pushes, "lateral")
    return Body(static, rest, model, lateral, axial, squeeze, sways)


def check_moves(scene: Scene, static: Model) -> None:
    """Raises UserError for tubes that rub against each other: that is solved in statics alone."""
    if rubs(static.axial.system):
        raise UserError(
            Fault(
                f"{static.foundation.name}: tubes in it rub against each other, which is solved in "
                "statics alone",
                "leave out the friction of *TYPCONTACT, or *DYNAMIC",
            )
        )


def first_order(scene: Scene, like: Model, profile: Profile) -> Model:
    """A model on the same mesh without the normal force on slopes, in a ground of its own."""
    needs = replace(like.needs, second_order=False)
    degree = like.lateral.system.field.degree
    return assemble(scene, like.foundation, needs, profile, like.pieces, like.edges, degree)


def softened(problem: Problem, rest: State) -> tuple[Problem, System]:
    """A problem with the springs of a spudcan as soft as statics left them."""
    system = problem.system.softened(rest.softening)
    return replace(problem, system=system), system


def moves(scene: Scene, model: Model, pushes: Drive, which: Which) -> bool:
    """Whether a load with a history acts on a problem, or it starts out of place."""
    places, problem = [place for place, _ in pushes.moving], getattr(model, which)
    tubes = model.foundation.tubes
    starts = any((s.dof == "Z") == (which == "axial") for s in scene.starts if s.tube in tubes)
    return starts or bool(problem.forces[places].any() or problem.imposed[places].any())


def damping(scene: Scene, model: Model, problem: Problem, mass: Array, which: Which) -> Array:
    """Rayleigh's damping and the soil's radiation, lower band (width, size), N s/m.

    The stiffness part is the tubes' own: that of the soil at rest may be infinite.
    """
    system, field = problem.system, problem.system.field
    total = np.zeros_like(mass)
    if scene.damping is not None:
        shape = (field.size, system.components)
        stiffness = element_band(field.dofs, field.element_stiffness, system.width, shape)
        total += scene.damping.mass_factor * mass
        total += scene.damping.stiffness_factor * stiffness.reshape(mass.shape, order="F")
    if which == "lateral" and scene.ground.dashpots:
        soil = model.lateral.system.points[0]
        interval = np.searchsorted(field.edges[1:-1], soil.x)
        amount = model.profile.dashpot(soil.x, model.parts.width[interval])
        total += alone(system, soil).spread(amount)
    return np.asfortranarray(total)


def alone(system: System, points: Points) -> System:
    """A system of some points alone, in which no unknown is held."""
    nothing_held = np.zeros(0, dtype=np.intp)
    return System(system.field, system.components, [points], [], nothing_held)


def squeezed(model: Model, static: Model, rest: State) -> Squeeze:
    """The normal force of a static state on the slopes of a model, and how it changes."""
    points = next(p for p in static.lateral.system.points if p.compressed)
    lateral, axial = model.lateral.system, model.axial.system.field
    still = pressing(static, rest.axial, rest.lateral, static.lateral.system)
    element = lateral.field.elements(points.x, points.tube)
    interval = lateral.field.strings.interval[element]
    strains = []
    for tube, carrier in enumerate(lateral.field.strings.carrier):
        there = np.flatnonzero(carrier[interval] == element)
        stiffness = model.parts.stretching[interval[there], tube]
        strains.append((there, stiffness, axial.interpolation(points.x[there], 1, tube)))
    free = replace(points, reaction=compression(still), compressed=False)
    return Squeeze(alone(lateral, free), still, rest.axial, tuple(strains))
