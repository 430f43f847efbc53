"""Statics of a line of the scene: laid down, then taken through the steps, to the accuracy asked.

Errors are told by the same analysis on elements half as long. Friction and suction depend on the
way, so that each mesh goes it from the start.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..errors import Fault, UserError
from ..scene import Line, Scene, SeabedContact
from ..solve.newton import Ending, Limits
from .assemble import LineModel, assemble, mesh
from .results import LineResults
from .statics import LineState, Stage, follow, laid

_MESHES = 4  # halvings of all elements, at most
_PLACES = 400  # distances at which two meshes are compared
_ITERATIONS = 200  # to lay a line: its first shape may be far from where it lies


@dataclass(frozen=True, eq=False)
class Followed:
    """States of a line on a mesh: laid (step 0), then at the end of each step that was reached.

    failure: why steps are missing; empty if none are.
    """

    model: LineModel
    states: tuple[LineState, ...]
    failure: str

    @property
    def line(self) -> Line:
        return self.model.line

    @property
    def results(self) -> LineResults:
        """Of the states that are equilibria."""
        return LineResults.of(self.model.system, self.states)


@dataclass(frozen=True, eq=False)
class SolvedLine(Followed):
    """A line on the mesh that was taken.

    errors: of position, reaction, tension and moment over their largest, by comparison with
    elements half as long, (4,); the reaction's is that of its largest value.
    """

    errors: Array
    accuracy: float

    @property
    def accurate(self) -> bool:
        return bool((self.errors <= self.accuracy).all())


Way = Callable[[Scene, LineModel], Followed]


def solve_line(scene: Scene, line: Line) -> SolvedLine:
    """Lay a line and take it through the steps, on meshes that are halved until errors are small.

    The finer of the last two meshes is what is returned. Raises UserError for a line that cannot be
    laid.
    """
    for found in refinements(scene, line):
        if found.accurate or found.failure:
            break
    return found


def refinements(scene: Scene, line: Line, way: Way | None = None) -> Iterator[SolvedLine]:
    """A line on finer and finer meshes, each with its errors; one where NEL gives all elements.

    way: what follows the line on a mesh, `follow_line` where there is none. Raises as `solve_line`.
    """
    contact = scene.seabed_under(line)
    check_slack(line, contact)
    way, accuracy = way or follow_line, scene.numerics.accuracy
    given = all(section.elements is not None for section in line.sections)
    rough = way(scene, assemble(scene, line, mesh(scene, line, contact, 0)))
    for refined in range(1, 2 if given else _MESHES + 1):
        fine = way(scene, assemble(scene, line, mesh(scene, line, contact, refined)))
        yield SolvedLine(fine.model, fine.states, fine.failure, _apart(rough, fine), accuracy)
        rough = fine


def check_slack(line: Line, contact: SeabedContact | None) -> None:
    """Raises UserError for a line so long that it would lie on the seabed in bends."""
    if contact is None:
        return
    one, other = (np.array(end.position) for end in line.ends)
    heights = [max(end[2] - contact.mudline, 0.0) for end in (one, other)]
    most = float(np.hypot(*(other - one)[:2])) + sum(heights)
    if line.length > most:
        raise UserError(
            Fault(
                f"L{line.id}: {line.length:g} m of line between ends that {most:g} m would join, "
                "straight down and along the seabed: it would lie there in bends",
                "give a shorter line, or ends further apart",
            )
        )


def follow_line(scene: Scene, model: LineModel) -> Followed:
    """Lay the line of a model and take it through the steps."""
    limits = Limits(min(1e-3 * scene.numerics.accuracy, 1e-7), iterations=_ITERATIONS)
    first = laid(model.system, model.start, limits)
    if first.ending is not Ending.CONVERGED:
        return Followed(model, (), f"the line could not be laid: {first.ending.value}")
    states, failure = [first], ""
    for step, state in enumerate(follow(model.system, first, stages(scene, model), limits), 1):
        if state.ending is not Ending.CONVERGED:
            reached = f"step {step} stops at {state.reached:.4g} of it"
            failure = f"{reached}: {state.ending.value}"
            break
        states.append(state)
    return Followed(model, tuple(states), failure)


def stages(scene: Scene, model: LineModel) -> Iterator[Stage]:
    """Where the held ends are at the end of each step."""
    line, plane, system = model.line, model.plane, model.system
    field, m = system.field, system.components
    begin = model.start[system.held]
    motions = [one for one in scene.line_motions if one.line == line.id]
    for factors in scene.steps.factors:
        by_name = dict(zip(scene.steps.names, factors, strict=True))
        whole = np.zeros(system.size)
        for one in motions:
            value = one.target * by_name.get(one.name, 0.0)
            node = field.node(0.0 if one.end == 1 else float(field.edges[-1])) * m
            if one.dof in ("X", "Y", "Z"):
                move = np.array([one.dof == axis for axis in "XYZ"], dtype=float) * value
                whole[node : node + m] += plane.turned(move)
        yield Stage(begin + whole[system.held])


def _apart(rough: Followed, fine: Followed) -> Array:
    """Errors of position, reaction, tension and moment of the rougher mesh, (4,)."""
    n = min(len(rough.states), len(fine.states))
    if not n:
        return np.ones(4)
    one, other = (LineResults.of(each.model.system, each.states[:n]) for each in (rough, fine))
    s = np.linspace(0.0, fine.model.system.unstretched_length, _PLACES + 1)
    place, held, pulled, bent = (
        (value(one, s), value(other, s))
        for value in (
            LineResults.position,
            LineResults.reaction,
            LineResults.tension,
            LineResults.moment,
        )
    )
    most = [float(np.abs(each).max()) for each in held]
    return np.array(
        [
            _share(place, float(np.ptp(place[1].reshape(-1, place[1].shape[-1]), axis=0).max())),
            abs(most[0] - most[1]) / most[1] if most[1] > 0.0 else 0.0,
            _share(pulled, float(np.abs(pulled[1]).max())),
            _share(bent, float(np.abs(bent[1]).max())),
        ]
    )


def _share(pair: tuple[Array, Array], size: float) -> float:
    """Largest distance of two values over a size."""
    return float(np.abs(pair[0] - pair[1]).max()) / size if size > 0.0 else 0.0
