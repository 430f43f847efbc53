"""Lines in motion, followed step by step from the end of statics."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import inf

import numpy as np

from ..arrays import Array
from ..scene import Damping, Dynamics, Line, LineMotion, Scene
from ..solve.drive import Change, change_of, drive
from ..solve.dynamics import in_parts, integrator
from ..solve.equations import State
from ..solve.integrators import Integrator, initial
from ..solve.mover import Pair, Standing, alike, rows_of, state_from
from ..solve.newton import largest
from ..solve.stage import Effort, NoBalance, Patience
from .analysis import SolvedLine
from .assemble import LineModel, assemble, section_at
from .moving import Given, LineInertia, LineMoving

_ROUNDING = 1e-12  # of the length: a move that rounding may leave
_LEAST = 1e-3  # of the diameter: displacement of a line at rest


def line_integrator(dynamics: Dynamics) -> Integrator:
    """The method that a scene asks for; by default the one that keeps the energy of contact."""
    return integrator(dynamics, "CONSERVE")


@dataclass(slots=True)
class MovingLine:
    """A line on its way, a `Mover`.

    reach: largest displacement so far or expected, m. least: one that counts as any, m. begin:
    unknowns at the start. already: what the seabed had lost there, J. left: largest force out of
    balance in the last step, N; force: the largest that acted so far.
    """

    equations: LineMoving
    method: Integrator
    now: State
    reach: float
    effort: Effort = field(default_factory=Effort)
    least: float = 0.0
    part: float = np.inf
    work: float = 0.0
    force: float = 0.0
    left: float = 0.0
    begin: Array = field(init=False)
    already: float = field(init=False)

    def __post_init__(self) -> None:
        self.begin, self.already = self.now.q, 0.0
        self.already = self.dissipated()

    @property
    def time(self) -> float:
        return self.now.time

    def step(self, h: float, end: float, share: float, iterations: int) -> None:
        self.reach = max(self.reach, self.sizes()[0])
        rounding = _ROUNDING * self.equations.system.unstretched_length
        patience = Patience(max(share * self.reach, rounding), iterations)
        self.part = in_parts(lambda part: self._go(part, patience), h)
        self.now = replace(self.now, time=end)  # sums of steps would drift

    def _go(self, h: float, patience: Patience) -> None:
        equations, before = self.equations, self.now
        with np.errstate(over="ignore", invalid="ignore"):  # a step that is too long may run away
            after = self.method.step(equations, before, h, patience, self.effort)
        move = np.abs(after.q - before.q)
        driven = move[equations.held].max(initial=0.0)
        if not move.max() <= driven + equations.system.length:  # or it is no number
            raise NoBalance
        self._weigh_up(before, after, h)
        equations.commit(after.q, h)
        self.now = after

    def _weigh_up(self, before: State, after: State, h: float) -> None:
        """What is out of balance in a step, and the work of what drives it.

        Work is that of forces of the step where the equations have their mean on it; otherwise of
        the mean of those at both ends.
        """
        mean, held, move = self.equations.mean, self.equations.held, after.q - before.q
        if mean:
            acceleration = (after.velocity - before.velocity) / h
            forces = self._forces(after.time, after.q, move / h, acceleration)
            out = forces.sum(axis=0)
            # energy of motion follows the mean velocity, which is not the way's where driven
            slip = 0.5 * h * (before.velocity + after.velocity) - move
            self.work += float(forces[0] @ move - out[held] @ move[held] - forces[1] @ slip)
        else:
            first, forces = (
                self._forces(at.time, at.q, at.velocity, at.acceleration) for at in (before, after)
            )
            out, driven = forces.sum(axis=0), 0.5 * (first + forces).sum(axis=0)[held]
            self.work += float(forces[0] @ move - driven @ move[held])
        out[held], forces[:, held] = 0.0, 0.0
        self.left, self.force = largest(out), max(self.force, float(np.abs(forces).max()))

    def _forces(self, time: float, q: Array, velocity: Array, acceleration: Array) -> Array:
        """P, -M a, -C v and -F, (4, size), N: their sum is out of balance, or holds."""
        equations = self.equations
        return np.array(
            [
                equations.load(time),
                -equations.mass_times(acceleration),
                -equations.damping_times(velocity),
                -equations.internal(q, velocity if equations.feels_velocity else None),
            ]
        )

    def standing(self) -> Standing:
        return Standing(self.now, None, self.work, self.force, (self.equations.state(),))

    def stand(self, at: Standing) -> None:
        self.now, self.work, self.force = at.lateral, at.work, at.force
        self.equations.restore(at.memories[0], self.now.q)

    def imbalance(self) -> float:
        return self.left / self.force if self.force else 0.0

    def sizes(self, other: "MovingLine | None" = None) -> tuple[float, float]:
        if other is not None:
            return largest(self.now.q - other.now.q), 0.0
        return max(largest(self.now.q - self.begin), self.least), 0.0

    def lost(self) -> bool:
        return False

    def dissipated(self) -> float:
        bed = self.equations.system.bed
        return 0.0 if bed is None else bed.dissipated - self.already

    def pair(self) -> Pair:
        bed = self.equations.system.bed
        return (self.now, None if bed is None else bed.standing()), None

    def settled(self, pair: Pair) -> Pair:
        return pair

    def state(self) -> dict[str, Array]:
        sums = (self.time, self.work, self.force, self.reach, self.left)
        memory = {f"memory/{part}": value for part, value in self.equations.state().items()}
        rows = dict(rows_of("line", self.now))
        return {"sums": np.array(sums, dtype=np.float64), "begin": self.begin, **rows, **memory}

    def restore(self, found: Mapping[str, Array]) -> None:
        time, self.work, self.force, self.reach, self.left = map(float, found["sums"])
        self.now = state_from("line", found, time, len(self.begin))
        self.begin = found["begin"]
        memory = alike("memory", found, self.equations.state())
        self.equations.restore(memory, self.now.q)


@dataclass(frozen=True, eq=False)
class LineReady:
    """A line at the end of statics, `Ready` to move.

    bed: what its seabed remembers there.
    """

    solved: SolvedLine
    bed: Mapping[str, Array]
    sizes: Array

    def model(self, scene: Scene) -> LineModel:
        """The model of it, where statics has left it."""
        system = self.solved.model.system
        model = assemble(scene, self.solved.line, system.field.edges)
        if model.system.bed is not None:
            model.system.bed.restore(self.bed, self.solved.states[-1].q)
        return model

    def set_off(self, scene: Scene, dynamics: Dynamics) -> MovingLine:
        """As `Ready.set_off`."""
        model, q = self.model(scene), self.solved.states[-1].q
        line, edges = model.line, model.system.field.edges
        sections = section_at(line, 0.5 * (edges[1:] + edges[:-1]))
        method = line_integrator(dynamics)
        equations = LineMoving(
            model.system,
            LineInertia.of(sections, scene.sea),
            driven(scene, dynamics, model, q),
            scene.damping or Damping(),
            q,
            mean=method.mean,
        )
        effort = Effort()
        now = initial(equations, dynamics.start, q, np.zeros_like(q), effort)
        return MovingLine(equations, method, now, float(self.sizes[0]), effort, least_move(line))

    def period(self, scene: Scene) -> float:
        """As `Ready.period`: what moves its ends alone is what steps are to see."""
        return inf

    def limit(self, scene: Scene, dynamics: Dynamics) -> float:
        """As `Ready.limit`."""
        return line_integrator(dynamics).limit(self.set_off(scene, dynamics).equations)


def line_ready(scene: Scene, solved: SolvedLine) -> LineReady:
    """A solved line, ready to move from the state of its last step."""
    bed = solved.model.system.bed
    motions = [one for one in scene.line_motions if one.line == solved.line.id]
    most = max([largest_move(one) for one in motions], default=0.0)
    memory = {} if bed is None else bed.state()
    return LineReady(solved, memory, np.array([max(most, least_move(solved.line)), 0.0]))


def least_move(line: Line) -> float:
    """Displacement below which a line is at rest, m: errors are a share of no less."""
    return _LEAST * max(section.outer_diameter for section in line.sections)


def largest_move(motion: LineMotion) -> float:
    """How far an end may be moved, m."""
    waves = sum(wave.amplitude for wave in motion.waves)
    recorded = max(map(abs, motion.values), default=0.0)
    return float(abs(motion.target) + waves + recorded)


def driven(scene: Scene, dynamics: Dynamics, model: LineModel, q: Array) -> Given:
    """Where the held unknowns of a line are in motion; at rest they stand where q has them."""
    system, plane, m = model.system, model.plane, model.system.components
    factors = drive(scene, dynamics.start)
    names = scene.steps.names
    moves: list[tuple[Callable[[float], Change], Array]] = []
    for one in scene.line_motions:
        if one.line != model.line.id:
            continue
        node = system.field.node(0.0 if one.end == 1 else float(system.field.edges[-1])) * m
        whole = np.zeros(system.size)
        whole[node : node + m] = plane.turned(
            np.array([one.dof == axis for axis in "XYZ"], dtype=float)
        )
        moves.append((change_of(one, factors, names, dynamics.start), whole[system.held]))
    still = q[system.held]

    def given(time: float) -> tuple[Array, Array, Array]:
        found = np.zeros((3, len(still)))
        found[0] = still
        for change, where in moves:
            found += np.outer(change(time), where)
        return found[0], found[1], found[2]

    return given
