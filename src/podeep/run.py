"""The solver's commands as functions: from a deck's path to a database and a report."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from shlex import join
from textwrap import wrap
from typing import Any

from .arrays import Array
from .checks import warnings as risks_in
from .database.target import check_target
from .database.write import Writer
from .deck.read import Deck, read_deck
from .errors import AnalysisFailed, Fault, Interrupted, UserError
from .files import make_folder
from .line.analysis import SolvedLine, solve_line
from .line_record import line_sheet
from .line_report import line_report, line_summary
from .record import Sheet, sheet
from .report import run_report, step_table, summary
from .resume import Options, is_of, state_in
from .risks.bearing import tip_support_check
from .run_motion import MotionRun, check_motion, run_motion
from .scene import TRANSLATIONS, Foundation, Scene, Steps
from .soil.curves import CurveTable
from .soil.curves import curves as soil_curves
from .soil.profile import profile_of
from .solve.analysis import Solved, solve
from .solve.diagnosis import explain

_NEAR = 1e-6  # of the tip, m: elevations have less than all digits
_BY_DEFAULT = Options()
_BLOCK = 256  # steps that are committed to the database at once


@dataclass(frozen=True)
class Run:
    """What a run did: the database it wrote (None for a deck that ends in *STOP) and its report.

    failure: why the last steps are missing; empty if none are. risks: what was told of the deck
    before it was solved. supports: the load on supports along z against the soil's capacity.
    motion: what came of the dynamic part, if there is one. note: why nothing had to be done. lines:
    on the seabed.
    """

    deck: Path
    title: str
    solved: tuple[Solved, ...]
    database: Path | None
    failure: str
    risks: tuple[str, ...] = ()
    supports: tuple[str, ...] = ()
    motion: MotionRun | None = None
    note: str = ""
    lines: tuple[SolvedLine, ...] = ()

    def warnings(self) -> tuple[str, ...]:
        """What the user must know of results that are there."""
        rough = tuple(
            f"{s.model.foundation.name}: the accuracy asked, {s.accuracy:g}, was not reached: the "
            f"largest estimated error is {s.error:.1e} with {s.model.elements} elements"
            for s in self.solved
            if not s.accurate
        )
        unknown = tuple(
            f"{s.model.foundation.name}: the errors of {s.unestimated} steps beyond the peak could "
            "not be estimated; they stand as 100 %"
            for s in self.solved
            if s.unestimated
        )
        moved = () if self.motion is None else self.motion.warnings
        coarse = tuple(
            f"L{s.line.id}: the accuracy asked, {s.accuracy:g}, was not reached: the largest "
            f"estimated error is {s.errors.max():.1e} with {s.model.elements} elements"
            for s in self.lines
            if not s.accurate
        )
        return rough + unknown + coarse + moved

    def text(self, verbose: bool = False) -> str:
        """The report in words."""
        if self.note:
            return self.note
        parts = [self.title] if self.title else []
        for one in self.solved:
            parts.append(run_report(summary(one)))
            if verbose:
                parts.append(step_table(one))
        parts += [line_report(line_summary(one)) for one in self.lines]
        parts += ["\n".join(wrap(line, 80, subsequent_indent="    ")) for line in self.supports]
        ending = f"written: {self.database}" if self.database else "checked, *STOP: nothing solved"
        return "\n".join([*parts, ending, *([self.motion.text] if self.motion else [])])

    def as_json(self) -> dict[str, Any]:
        """The report as plain data."""
        return {
            "deck": str(self.deck),
            "title": self.title,
            "foundations": [summary(one) for one in self.solved],
            "lines": [line_summary(one) for one in self.lines],
            "database": str(self.database) if self.database else None,
            "motion": self.motion.as_json() if self.motion else None,
            "supports": list(self.supports),
            "warnings": [*self.risks, *self.warnings()],
            "failure": self.failure or None,
            "note": self.note or None,
        }


def run_deck(
    path: Path,
    directory: Path,
    *,
    force: bool,
    options: Options = _BY_DEFAULT,
    resume: bool = False,
    tell: Callable[[str], None] = lambda risk: None,
    progress: Callable[[str], None] = lambda text: None,
) -> Run:
    """Check a deck, solve it, and write NAME.dss and, of a deck with motion, NAME.dst.

    resume: go on with a motion that was interrupted, by its own options; statics take moments and
    are solved again, and written where NAME.dss is not there. tell: takes what is risky in the
    deck, one by one, before anything is solved. progress: takes how far a motion is.

    Raises UserError before anything is solved where the deck is at fault or the database could
    not be written. A step without equilibrium is no error here: the steps before it are written.
    """
    deck = read_deck(path)
    scene, state = deck.scene, None
    if deck.solve:
        check_lines(scene)
    target, moved = (directory / path.with_suffix(ending).name for ending in (".dss", ".dst"))
    if resume:
        check_resumes(deck)
        state = state_in(moved, deck.text)
        if state is None:
            note = f"{moved} is complete: there is nothing to resume"
            return Run(path, scene.title, (), moved, "", note=note)
        options = Options.of(state)
    if options.accuracy is not None:
        scene = replace(scene, numerics=replace(scene.numerics, accuracy=options.accuracy))
    there = resume and is_of(target, deck.text)
    if deck.solve:
        make_folder(directory)
        if not there:
            check_target(target, force=force)
        if scene.dynamics is not None:
            check_target(moved, force=force)
            check_motion(scene)
    risks = tuple(risks_in(scene))
    for risk in risks:
        tell(risk)
    if not deck.solve:
        return Run(path, scene.title, (), None, "", risks)
    solved = on_one_path(scene, tuple(until_interrupted(scene)))
    lines = tuple(solve_line(scene, line) for line in scene.lines.values())
    names = scene.steps.names
    for one in solved:
        if one.failure and not one.states:
            raise AnalysisFailed(explain(one, one.failure, names))
    for line in lines:
        if not line.states:
            raise AnalysisFailed(f"L{line.line.id}: {line.failure}")
    failures = [explain(s, s.failure, names) for s in solved if s.failure]
    failures += [f"L{line.line.id}: {line.failure}" for line in lines if line.failure]
    failure = "\n".join(failures)
    sheets = [sheet(scene, s) for s in solved] + [line_sheet(scene, line) for line in lines]
    interrupted = bool(solved) and solved[-1].interrupted
    if not there or interrupted:
        write(
            *(target, deck, scene, sheets, failure),
            interrupted=interrupted,
            force=force,
            compress=options.compress,
        )
    supports = tuple(filter(None, (tip_support_check(scene, f) for f in scene.foundations)))
    motion = None
    if scene.dynamics is not None and not failure:
        command = f"podeep-solve run {path.stem}"
        again = ["podeep-solve", "run", str(path), "-o", str(directory), "--resume"]
        motion = run_motion(
            deck,
            scene,
            moved,
            laid=lines,
            force=force,
            history=f"{command}\n{command} --resume" if resume else command,
            tell=progress,
            options=options,
            state=state,
            again=join([*again, "--force"] if force else again),
        )
        failure = motion.failure
    return Run(path, scene.title, solved, target, failure, risks, supports, motion, lines=lines)


def check_lines(scene: Scene) -> None:
    """Raises UserError for what is not solved of lines yet: ends that turn."""
    for one in scene.line_motions:
        if one.dof not in TRANSLATIONS and (one.target or one.moves_in_time):
            raise UserError(
                Fault(
                    f"line {one.line}: *MOTION turns end {one.end} about {one.dof[1:]}; this "
                    "version moves ends, and does not turn them",
                    f"leave {one.dof} out, or give the direction in *END (DX=, DY=, DZ=)",
                )
            )


def check_resumes(deck: Deck) -> None:
    """Raises UserError for a deck without motion: statics are not resumed."""
    if not deck.solve or deck.scene.dynamics is None:
        raise UserError(
            Fault(
                "there is nothing to resume: the deck has no motion (*DYNAMIC) that is solved",
                "run it without --resume",
            )
        )


def until_interrupted(scene: Scene) -> Iterator[Solved]:
    """Solve the foundations one after the other; an interrupted one is the last."""
    for foundation in scene.foundations:
        one = solve(scene, foundation)
        yield one
        if one.interrupted:
            return


def on_one_path(scene: Scene, solved: tuple[Solved, ...]) -> tuple[Solved, ...]:
    """All foundations under the load factors of the path that starts first, if there is one."""
    paths = [(s.failure.step, s.failure.reached, s) for s in solved if s.path and s.failure]
    if not paths or len(solved) == 1 or solved[-1].interrupted:
        return solved
    leader = min(paths, key=lambda item: item[:2])[2]
    factors = tuple(tuple(s.factors.tolist()) for s in leader.states[1:])
    numerics = replace(scene.numerics, follow_path=False)
    same = replace(scene, steps=Steps(scene.steps.names, factors), numerics=numerics)
    return tuple(s if s is leader else solve(same, s.model.foundation) for s in solved)


def write(
    target: Path,
    deck: Deck,
    scene: Scene,
    sheets: list[Sheet],
    failure: str,
    *,
    interrupted: bool,
    force: bool,
    compress: bool = False,
) -> None:
    """Write the steps that all foundations have; those of an interrupted run stay a partial."""
    steps = min((s.steps for s in sheets), key=len)
    with Writer(
        target,
        kind="static",
        title=scene.title,
        deck_text=deck.text,
        grids=[s.grid for s in sheets],
        loads=scene.steps.names,
        history=f"podeep-solve run {target.stem}",
        force=force,
        compress=compress,
        block=min(len(steps), _BLOCK),
    ) as writer:
        for first in range(0, len(steps), _BLOCK):
            rows = slice(first, min(first + _BLOCK, len(steps)))
            values = {name: v[rows] for s in sheets for name, v in s.values.items()}
            writer.append(steps[rows], values)
        if interrupted:
            last = f"{len(steps) - 1} of {len(scene.steps.factors)} steps"
            raise Interrupted(f"interrupted; {last} are kept in {writer.path}")
        writer.finish("stopped" if failure else "complete", failure)


def curves_at(
    scene: Scene, foundation: Foundation, depth: float, displacement: Array | None
) -> tuple[CurveTable, ...]:
    """The curves of a foundation's outermost tube at a depth (m below the mudline).

    Raises UserError for a depth that the tube does not reach.
    """
    mudline = foundation.mudline
    length = mudline - scene.tip(foundation)
    if not 0.0 <= depth <= length + _NEAR:
        raise UserError(
            Fault(
                f"depth {depth:g} m is outside 0 to {length:g} m, the tip",
                "give --depth below the mudline, positive down, on the tube",
            )
        )
    depth = min(depth, length)
    elevation = mudline - depth
    sections = (s for igr in foundation.tubes for s in scene.tubes[igr].sections)
    section = next(s for s in sections if s.top + _NEAR >= elevation >= s.bottom - 1e-9)
    profile = profile_of(scene, foundation)
    return soil_curves(profile, depth, section.outer_diameter, displacement)
