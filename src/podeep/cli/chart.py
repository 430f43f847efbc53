"""podeep-solve chart: speed against accuracy for a deck, or the map of the time integrators."""

import argparse
import sys

from ..errors import ExitCode, Fault, UserError
from ..files import make_folder
from ..scene import Foundation, Scene


def chart(options: argparse.Namespace) -> ExitCode:
    """Show which settings solve a deck how fast and how exactly, or --stability."""
    if options.stability:
        return stability(options)
    if options.deck is None:
        raise UserError(Fault("there is no deck to chart", "give one, or --stability"))
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


def stability(options: argparse.Namespace) -> ExitCode:
    """Show which method of time integration follows which motion with which step."""
    from ..study.stability import stability_map
    from ..study.stability_report import stability_csv, stability_report

    if options.deck is not None or options.foundation is not None:
        raise UserError(Fault("--stability is of no deck", "give it alone"))
    folder = None if options.directory is None else make_folder(options.directory)
    try:
        found = stability_map(progress, quick=options.quick)
    finally:
        progress("")
    sys.stdout.write(stability_csv(found) if options.csv else stability_report(found) + "\n")
    if folder is not None:
        from ..study.stability_figure import save_stability

        picture = save_stability(found, folder)
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
