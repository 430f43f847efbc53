"""podeep-solve: check a deck, solve it, show its curves and the keywords."""

import argparse
import csv
import json
import sys
from importlib import resources
from pathlib import Path

import numpy as np

from .. import __version__
from ..errors import AnalysisFailed, ExitCode, Fault, UserError
from ..files import make_folder
from ..units import short
from .chart import chart, progress
from .common import guarded, number
from .modes import add_modes
from .stiffness import add_stiffness


def main(arguments: list[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    options = parser().parse_args(arguments)
    return guarded("podeep-solve", lambda: int(options.command(options)))


def parser() -> argparse.ArgumentParser:
    """The command line, one subcommand each."""
    top = argparse.ArgumentParser(prog="podeep-solve", description=__doc__)
    top.add_argument("--version", action="version", version=f"podeep-solve {__version__}")
    commands = top.add_subparsers(required=True, metavar="COMMAND")

    run_ = commands.add_parser("run", help="check, solve, write the database")
    run_.add_argument("deck", type=Path)
    run_.add_argument("-o", dest="directory", type=Path, default=Path(), help="where to write")
    run_.add_argument("--force", action="store_true", help="replace an existing database")
    run_.add_argument("--accuracy", type=accuracy, help="relative accuracy, beats *ACCURACY")
    run_.add_argument("--resume", action="store_true", help="go on with an interrupted motion")
    run_.add_argument("--float64", action="store_true", help="a .dst in float64, not float32")
    run_.add_argument("--compress", action="store_true", help="smaller databases, slower to read")
    run_.add_argument("--json", action="store_true", help="the report as JSON")
    loud = run_.add_mutually_exclusive_group()
    loud.add_argument("-q", dest="quiet", action="store_true", help="no report")
    loud.add_argument("-v", dest="verbose", action="store_true", help="a line for each step")
    run_.set_defaults(command=run)

    check_ = commands.add_parser("check", help="what the deck says, in SI and in words")
    check_.add_argument("deck", type=Path)
    check_.set_defaults(command=check)

    curves_ = commands.add_parser("curves", help="the reaction curves in force at a depth")
    curves_.add_argument("deck", type=Path)
    curves_.add_argument("--depth", type=float, required=True, help="m below the mudline")
    curves_.add_argument(
        "--at",
        type=numbers,
        help="displacements, m (rotations, rad), by commas; --at=-0.1,0 if the first is negative",
    )
    curves_.add_argument("--foundation", help="F1, F2, ...; the first one by default")
    curves_.add_argument("--csv", action="store_true", help="full precision, for other programs")
    curves_.add_argument("-o", dest="directory", type=Path, help="where to write a picture")
    curves_.set_defaults(command=curves)

    capacity_ = commands.add_parser("capacity", help="what a pile bears, and the length it needs")
    capacity_.add_argument("deck", type=Path)
    capacity_.add_argument("--foundation", help="F1, F2, ...; the first one by default")
    capacity_.add_argument(
        "--safety-factor", type=number, default=2.0, help="of the required length, 2.0 by default"
    )
    capacity_.add_argument(
        "--to", type=number, help="end of the table, m below the mudline; 1.5 lengths by default"
    )
    capacity_.add_argument("--csv", action="store_true", help="full precision, SI units")
    capacity_.add_argument("-o", dest="directory", type=Path, help="where to write a picture")
    capacity_.set_defaults(command=capacity)

    chart_ = commands.add_parser("chart", help="speed against accuracy for this very scene")
    chart_.add_argument("deck", type=Path, nargs="?")
    chart_.add_argument(
        "--stability", action="store_true", help="methods of time integration against the step"
    )
    chart_.add_argument("--foundation", help="F1, F2, ...; the first one by default")
    chart_.add_argument("--line", help="L1, L2, ...; the first one by default")
    chart_.add_argument("--quick", action="store_true", help="fewer meshes and fewer runs")
    chart_.add_argument("--statics", action="store_true", help="of statics, also with *DYNAMIC")
    chart_.add_argument("--csv", action="store_true", help="every setting, full precision")
    chart_.add_argument("-o", dest="directory", type=Path, help="where to write a picture")
    chart_.set_defaults(command=chart)

    add_modes(commands)

    add_stiffness(commands)

    keywords_ = commands.add_parser("keywords", help="the keyword table, or one keyword")
    keywords_.add_argument("name", nargs="?")
    keywords_.set_defaults(command=keywords)

    example_ = commands.add_parser("example", help="write sample decks, their databases, answers")
    example_.add_argument("directory", type=Path)
    example_.add_argument("--force", action="store_true", help="replace existing files")
    example_.set_defaults(command=example)
    return top


def accuracy(text: str) -> float:
    """A relative accuracy in the bounds of *ACCURACY."""
    value = float(text)
    if not 1e-9 <= value <= 0.1:
        raise argparse.ArgumentTypeError(f"{text} is outside 1e-9 to 0.1")
    return value


def numbers(text: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Numbers separated by commas or blanks."""
    values = np.array([float(part) for part in text.replace(",", " ").split()])
    if not values.size or not np.isfinite(values).all():
        raise argparse.ArgumentTypeError(f"'{text}' holds no finite numbers")
    return values


def run(options: argparse.Namespace) -> ExitCode:
    """Solve a deck and write its databases."""
    from ..resume import Options
    from ..run import run_deck

    asked = Options(options.accuracy, options.float64, options.compress)
    if options.resume and asked != Options():
        raise UserError(
            Fault(
                "--resume goes on by the options of the run that was interrupted",
                "leave out --accuracy, --float64 and --compress",
            )
        )
    try:
        done = run_deck(
            options.deck,
            options.directory,
            force=options.force,
            options=asked,
            resume=options.resume,
            tell=warn,
            progress=(lambda text: None) if options.quiet else progress,
        )
    finally:
        if not options.quiet:
            progress("")
    for warning in done.warnings():
        warn(warning)
    if options.json:
        print(json.dumps(done.as_json(), indent=2))
    elif not options.quiet:
        print(done.text(verbose=options.verbose))
    if done.failure:
        where = f"what was computed is in {done.motion.database if done.motion else done.database}"
        raise AnalysisFailed(f"{done.failure}\n  {where}" if done.database else done.failure)
    return ExitCode.DONE


def warn(warning: str) -> None:
    """Tell what the user must know, apart from the report."""
    print(f"podeep-solve: warning: {warning}", file=sys.stderr)


def check(options: argparse.Namespace) -> ExitCode:
    """Tell what a deck says."""
    from ..checks import warnings
    from ..deck.read import read_deck
    from ..describe import risk_report, scene_report
    from ..solve.analysis import first_model

    deck = read_deck(options.deck)
    for foundation in deck.scene.foundations:
        first_model(deck.scene, foundation)  # curves that cannot be evaluated are faults too
    print(scene_report(deck.scene, deck.notes))
    if risky := risk_report(warnings(deck.scene)):
        print(risky)
    return ExitCode.DONE


def curves(options: argparse.Namespace) -> ExitCode:
    """Show the curves in force at a depth."""
    from ..deck.read import read_deck
    from ..named import foundation_of
    from ..report import curves_report
    from ..run import curves_at

    scene = read_deck(options.deck).scene
    foundation = foundation_of(scene, options.foundation)
    tables = curves_at(scene, foundation, options.depth, options.at)
    if options.csv:
        writer = csv.writer(sys.stdout, lineterminator="\n")
        writer.writerow(("curve", "displacement", "reaction"))
        for table in tables:
            for pair in zip(table.displacement, table.reaction, strict=True):
                writer.writerow((table.name, *(repr(float(value)) for value in pair)))
    else:
        print(curves_report(tables, options.depth))
    if options.directory is not None and not tables:
        print("podeep-solve: no picture: no curve reacts at this depth", file=sys.stderr)
    elif options.directory is not None:
        from ..soil_figure import save_curves

        case, depth = f"{options.deck.stem}_{foundation.name}", short(options.depth)
        title = f"{options.deck.stem}, {foundation.name}: reaction curves at {depth} m"
        folder, stem = make_folder(options.directory), f"{case}_curves_{depth}m"
        picture = save_curves(tables, title, folder, stem, whole=options.at is not None)
        tell(picture, options)
    return ExitCode.DONE


def capacity(options: argparse.Namespace) -> ExitCode:
    """Show what a foundation bears with its tip at each depth, and the length that it needs."""
    from ..capacity import capacity as capacity_of
    from ..capacity_report import capacity_csv, capacity_report
    from ..deck.read import read_deck
    from ..named import foundation_of

    scene = read_deck(options.deck).scene
    foundation = foundation_of(scene, options.foundation)
    found = capacity_of(scene, foundation, options.safety_factor, options.to)
    for warning in found.warnings:
        warn(warning)
    sys.stdout.write(capacity_csv(found) if options.csv else capacity_report(found) + "\n")
    if options.directory is not None and found.axial is None:
        print("podeep-solve: no picture: there is no axial capacity to draw", file=sys.stderr)
    elif options.directory is not None:
        from ..soil_figure import save_capacity

        tell(save_capacity(found, make_folder(options.directory), options.deck.stem), options)
    return ExitCode.DONE


def tell(picture: Path, options: argparse.Namespace) -> None:
    """Name a picture that was written, apart from data that another program reads."""
    print(f"written: {picture}", file=sys.stderr if options.csv else sys.stdout)


def keywords(options: argparse.Namespace) -> ExitCode:
    """Show the keyword table."""
    from ..deck.keywords import describe

    print(describe(options.name))
    return ExitCode.DONE


def example(options: argparse.Namespace) -> ExitCode:
    """Write the sample decks and answers, then the databases that the decks make."""
    from ..run import run_deck

    directory: Path = options.directory
    sources = [f for f in resources.files("podeep").joinpath("example").iterdir() if f.is_file()]
    names = sorted(f.name for f in sources)
    taken = [name for name in names if (directory / name).exists()]
    if taken and not options.force:
        raise UserError(f"{directory / taken[0]} exists; --force replaces it")
    make_folder(directory)
    try:
        for source in sources:
            (directory / source.name).write_bytes(source.read_bytes())
    except OSError as error:
        raise UserError(f"cannot write to {directory}: {error.strerror}") from error
    decks = [directory / name for name in names if name.endswith(".deck")]
    written = [directory / name for name in names]
    for deck in decks:
        done = run_deck(deck, directory, force=options.force)
        made = (done.database, done.motion.database if done.motion else None)
        written += [path for path in made if path]
    print("\n".join(str(path) for path in written))
    for deck in decks:
        print(f"next: podeep {deck.with_suffix('')} --answers {deck.with_suffix('.answers')}")
    return ExitCode.DONE
