"""The dynamic part of a run: foundations set in motion, followed, and written as they go."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import Array
from .database.read import open_database
from .database.write import Writer
from .deck.read import Deck
from .errors import Fault, Interrupted, UserError
from .line.analysis import SolvedLine
from .line.motion import line_ready
from .line_motion_record import line_book
from .model.needs import needs
from .model.remember import check_plane
from .motion_log import Log, Progress, part_of
from .motion_record import Book, ledger
from .resume import Options
from .scene import Scene
from .solve.pace import finer, pace_for, paced
from .solve.ready import Ready, begun

RESTARTS = 3

_BY_DEFAULT = Options()


@dataclass(frozen=True)
class MotionRun:
    """What a dynamic run did: its database, and how it went.

    time: s, that was reached. error: of the displacements, as it is estimated. dissipated: what
    soil that remembers has lost, J. touchdowns: of each line on the seabed, by its name in the
    database, from where to where its touchdown point moved, m from end 1. keeps: the default has
    become the method that keeps energy, as tubes can knock against each other. failure: why the
    rest of the time is missing; empty if nothing is.
    """

    database: Path
    time: float
    step: float
    shortest_step: float
    steps: int
    records: int
    iterations: int
    error: float
    accuracy: float
    dissipated: float
    touchdowns: Mapping[str, tuple[float, float]]
    keeps: bool
    failure: str

    @property
    def text(self) -> str:
        """The report in words."""
        mean = self.iterations / max(self.steps, 1)
        lost = f"    the soil has dissipated {self.dissipated:.4g} J\n" if self.dissipated else ""
        touched = "".join(
            f"    the touchdown point of {name} moves between {low:.2f} and {high:.2f} m "
            "(times written)\n"
            for name, (low, high) in self.touchdowns.items()
        )
        method = "    followed by METHOD=CONSERVE: tubes have room to knock\n" if self.keeps else ""
        length = f"{self.step:.4g} s"
        if self.shortest_step < self.step:
            length = f"{self.shortest_step:.3g} to {self.step:.3g} s"
        return (
            f"Motion to {self.time:g} s: {self.steps} steps of {length}, "
            f"{mean:.1f} iterations a step\n"
            f"    estimated error of displacements {self.error:.1e}, asked {self.accuracy:.0e}\n"
            f"{lost}{touched}{method}"
            f"written: {self.database}, {self.records} times"
        )

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user must know of results that are there."""
        if self.error <= self.accuracy:
            return ()
        return (
            f"the accuracy asked, {self.accuracy:g}, was not reached in motion: the estimated "
            f"error of the displacements is {self.error:.1e} with steps of {self.step:g} s",
        )

    def as_json(self) -> dict[str, Any]:
        """The report as plain data."""
        return {**asdict(self), "database": str(self.database), "failure": self.failure or None}


def check_motion(scene: Scene) -> None:
    """Raises UserError for what a scene asks of its motion and cannot have."""
    dynamics, moved = scene.dynamics, {d.name for d in scene.displacements}
    for foundation in scene.foundations:
        planes = needs(scene, foundation).components
        check_plane(planes, scene.numerics.hysteresis, foundation.name)
    names = [h.name for h in scene.harmonics] + [h.name for h in scene.series]
    driven = [f"{name} is a displacement with a history" for name in names if name in moved]
    driven += [
        f"end {m.end} of line {m.line} is moved"
        for m in scene.line_motions
        if m.moves_in_time or m.name in names
    ]
    if dynamics is not None and dynamics.method == "ROS2" and driven:
        raise UserError(
            Fault(
                f"METHOD=ROS2 takes no imposed motion, but {driven[0]}",
                "choose another method, or leave it to the program",
            )
        )


def touchdowns(path: Path, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    """From where to where the touchdown points of lines moved, at the times of a database.

    Times at which a line touches nowhere (0 in a database) have none.
    """
    with open_database(path) as database:
        found = {name: database.line(name).read("touchdown_distance") for name in names}
    touching = {name: at[at > 0.0] for name, at in found.items()}
    return {name: (float(at.min()), float(at.max())) for name, at in touching.items() if len(at)}


def run_motion(
    deck: Deck,
    scene: Scene,
    target: Path,
    *,
    laid: Sequence[SolvedLine],
    force: bool,
    history: str,
    tell: Progress,
    options: Options = _BY_DEFAULT,
    state: Mapping[str, Array] | None = None,
    again: str = "",
) -> MotionRun:
    """Follow a scene's motion and write it as it goes.

    laid: lines, solved to the end of statics. tell: takes a line of progress. options, state:
    those of a run that was interrupted, to go on from there. again: the command that would go on.
    A step that the accuracy has chosen starts anew at half its size where its error turns out too
    large. Raises AnalysisFailed where statics has no equilibrium, Interrupted where the user ends
    it: the partial then holds what there is.
    """
    dynamics = scene.dynamics
    assert dynamics is not None
    tell("statics, and the step in time")
    piles = [begun(scene, foundation) for foundation in scene.foundations]
    lines = [line_ready(scene, solved) for solved in laid]
    start: list[Ready] = [*piles, *lines]
    if state is None:
        pace, first = pace_for(scene, dynamics, start), 0.0
    else:
        pace, first = map(float, part_of(state, "pace", 2))
    whole = dynamics.end - dynamics.start
    for restarts in range(int(first), RESTARTS + 1):
        one = paced(scene, dynamics, start, pace, whole)
        given = dynamics.step is not None and not dynamics.adaptive
        patient = given or restarts == RESTARTS
        books: list[Book] = [ledger(scene, pile, pile.body(scene)) for pile in piles]
        books += [line_book(scene, line) for line in lines]
        chosen = {"pace": np.array([pace, restarts]), **options.state}
        log = Log(one, dynamics, books, chosen, tell)
        if state is not None:
            log.resume(state)
        writer = Writer(
            target,
            kind="dynamic",
            title=scene.title,
            deck_text=deck.text,
            grids=[book.grid for book in books],
            loads=(),
            history=history,
            force=force,
            dtype=np.float64 if options.double else np.float32,
            compress=options.compress,
            room=one.records,
            state=state or log.state,
            resumes=state is not None,
        )
        state = None
        try:
            with writer:
                if not log.follow(writer, None if patient else scene.numerics.accuracy):
                    pace = finer(dynamics, pace, one.order)
                    continue
                failure = log.failure()
                writer.finish("stopped" if failure else "complete", failure)
        except KeyboardInterrupt:
            if not writer.path.exists():
                raise
            reached = f"interrupted at {one.time:.4g} of {dynamics.end:g} s"
            raise Interrupted(f"{reached}; go on from {writer.path} with: {again}") from None
        counted = (
            one.time,
            one.longest,
            one.shortest,
            one.done,
            log.records,
            log.iterations,
            one.error,
        )
        lost = sum(motion.dissipated() for motion in one.motions)
        touched = touchdowns(target, [book.name for book in books[len(piles) :]])
        keeps = dynamics.method is None and scene.default_method == "CONSERVE"
        return MotionRun(target, *counted, scene.numerics.accuracy, lost, touched, keeps, failure)
    raise RuntimeError("unreachable")
