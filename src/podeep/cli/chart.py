"""podeep-solve chart: speed against accuracy for a deck, or the map of the time integrators."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from ..errors import ExitCode, Fault, UserError
from ..files import make_folder
from ..scene import Foundation, Line, Scene

if TYPE_CHECKING:
    from ..study.chart import Chart, S
    from ..study.motion_chart import MotionChart
    from ..study.stability import StabilityMap

T = TypeVar("T")


def chart(options: argparse.Namespace) -> ExitCode:
    """Show which settings solve a deck how fast and how exactly, or --stability."""
    if options.stability:
        return stability(options)
    if options.deck is None:
        raise UserError(Fault("there is no deck to chart", "give one, or --stability"))
    from ..deck.read import read_deck
    from ..named import foundation_of, line_of

    scene = read_deck(options.deck).scene
    anything = options.foundation is None and options.line is None
    foundation = line = None
    if options.foundation is not None or (anything and (scene.foundations or not scene.lines)):
        foundation = foundation_of(scene, options.foundation)
    if options.line is not None or (anything and scene.lines):
        line = line_of(scene, options.line)
    if options.csv and foundation and line:
        names = f"--foundation {foundation.name} or --line L{line.id}"
        raise UserError(Fault("--csv is of one foundation or one line", f"give {names}"))
    if foundation:
        moves = scene.dynamics is not None and not options.statics
        (_motion if moves else _foundation)(scene, foundation, options)
    if foundation and line:
        print()
    if line:
        _line(scene, line, options)
    return ExitCode.DONE


def _foundation(scene: Scene, foundation: Foundation, options: argparse.Namespace) -> ExitCode:
    """The statics of a foundation."""
    from ..study.measure import chart as chart_of

    return _statics(
        lambda: chart_of(scene, foundation, quick=options.quick, tell=progress), options
    )


def _line(scene: Scene, line: Line, options: argparse.Namespace) -> ExitCode:
    """The statics of a line."""
    from ..study.line_measure import line_chart

    return _statics(lambda: line_chart(scene, line, quick=options.quick, tell=progress), options)


def _statics(make: "Callable[[], Chart[S]]", options: argparse.Namespace) -> ExitCode:
    from ..study.chart_report import chart_csv, chart_report

    def save(found: "Chart[S]", folder: Path) -> Path:
        from ..study.chart_figure import save_chart

        return save_chart(found, folder, options.deck.stem)

    return _shown(options, make, chart_csv, chart_report, save)


def stability(options: argparse.Namespace) -> ExitCode:
    """Show which method of time integration follows which motion with which step."""
    from ..study.stability import stability_map
    from ..study.stability_report import stability_csv, stability_report

    if any(one is not None for one in (options.deck, options.foundation, options.line)):
        raise UserError(Fault("--stability is of no deck", "give it alone"))

    def save(found: "StabilityMap", folder: Path) -> Path:
        from ..study.stability_figure import save_stability

        return save_stability(found, folder)

    def make() -> "StabilityMap":
        return stability_map(progress, quick=options.quick)

    return _shown(options, make, stability_csv, stability_report, save)


def _motion(scene: Scene, foundation: Foundation, options: argparse.Namespace) -> ExitCode:
    """The same of a motion."""
    from ..study.motion_measure import motion_chart
    from ..study.motion_report import motion_csv, motion_report

    def save(found: "MotionChart", folder: Path) -> Path:
        from ..study.motion_figure import save_motion_chart

        return save_motion_chart(found, folder, options.deck.stem)

    def make() -> "MotionChart":
        return motion_chart(scene, foundation, quick=options.quick, tell=progress)

    return _shown(options, make, motion_csv, motion_report, save)


def _shown(
    options: argparse.Namespace,
    make: Callable[[], T],
    as_csv: Callable[[T], str],
    as_text: Callable[[T], str],
    save: Callable[[T, Path], Path],
) -> ExitCode:
    """Make something, show it as a table or CSV, and draw it where a folder is given."""
    folder = None if options.directory is None else make_folder(options.directory)
    try:
        found = make()
    finally:
        progress("")
    sys.stdout.write(as_csv(found) if options.csv else as_text(found) + "\n")
    if folder is not None:
        picture = save(found, folder)
        print(f"written: {picture}", file=sys.stderr if options.csv else sys.stdout)
    return ExitCode.DONE


def progress(text: str) -> None:
    """Show how far the work is, on a terminal alone; each text takes the place of the last."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()
