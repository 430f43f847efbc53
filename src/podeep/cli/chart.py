"""podeep-solve chart: the command that shows speed against accuracy for a deck."""

import argparse
import sys

from ..errors import ExitCode
from ..files import make_folder
from ..scene import Foundation, Scene


def chart(options: argparse.Namespace) -> ExitCode:
    """Show which settings solve a deck how fast and how exactly."""
    from ..deck.read import read_deck
    from ..demand import foundation_of
    from ..study.chart_report import chart_csv, chart_report
    from ..study.measure import chart as chart_of

    scene = read_deck(options.deck).scene
    foundation = foundation_of(scene, options.foundation)
    if scene.dynamics is not None and not options.statics:
        return _motion(scene, foundation, options)
    folder = None if options.directory is None else make_folder(options.directory)
    try:
        found = chart_of(scene, foundation, quick=options.quick, tell=progress)
    finally:
        progress("")
    sys.stdout.write(chart_csv(found) if options.csv else chart_report(found) + "\n")
    if folder is not None:
        from ..study.chart_figure import save_chart

        picture = save_chart(found, folder, options.deck.stem)
        print(f"written: {picture}", file=sys.stderr if options.csv else sys.stdout)
    return ExitCode.DONE


def _motion(scene: Scene, foundation: Foundation, options: argparse.Namespace) -> ExitCode:
    """The same of a motion."""
    from ..study.motion_measure import motion_chart
    from ..study.motion_report import motion_csv, motion_report

    folder = None if options.directory is None else make_folder(options.directory)
    try:
        found = motion_chart(scene, foundation, quick=options.quick, tell=progress)
    finally:
        progress("")
    sys.stdout.write(motion_csv(found) if options.csv else motion_report(found) + "\n")
    if folder is not None:
        from ..study.motion_figure import save_motion_chart

        picture = save_motion_chart(found, folder, options.deck.stem)
        print(f"written: {picture}", file=sys.stderr if options.csv else sys.stdout)
    return ExitCode.DONE


def progress(text: str) -> None:
    """Show how far the work is, on a terminal alone; each text takes the place of the last."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()
