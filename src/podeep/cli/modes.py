"""podeep-solve modes: the command that shows natural frequencies and mode shapes of a deck."""

import argparse
import json
import sys
from pathlib import Path

from ..errors import ExitCode
from ..files import make_folder


def add_modes(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command and its options."""
    modes_ = commands.add_parser("modes", help="natural frequencies and mode shapes")
    modes_.add_argument("deck", type=Path)
    modes_.add_argument(
        "-n", dest="count", type=whole, default=6, help="how many, the lowest first; 6 by default"
    )
    modes_.add_argument("--step", type=int, default=0, help="static step; 0, at rest, by default")
    modes_.add_argument(
        "--secant",
        type=length,
        default=1e-3,
        help="displacement, m, whose secant stands for an infinite slope at rest; 0.001 by default",
    )
    modes_.add_argument("--foundation", help="F1, F2, ...; the first one by default")
    modes_.add_argument("--shapes", action="store_true", help="displacement against depth too")
    form = modes_.add_mutually_exclusive_group()
    form.add_argument("--csv", action="store_true", help="full precision, SI units")
    form.add_argument("--json", action="store_true", help="the report as JSON")
    modes_.add_argument("-o", dest="directory", type=Path, help="where to write a picture")
    modes_.set_defaults(command=modes)


def whole(text: str) -> int:
    """A number of modes."""
    if not text.isdigit() or not 1 <= int(text) <= 100:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of modes from 1 to 100")
    return int(text)


def length(text: str) -> float:
    """A displacement of soil, m."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 1e-6 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"'{text}' is no displacement from 1e-6 to 1 m")
    return value


def modes(options: argparse.Namespace) -> ExitCode:
    """Show the lowest modes of a foundation about a static step."""
    from ..deck.read import read_deck
    from ..modes_report import modes_csv, modes_data, modes_report
    from ..named import foundation_of
    from ..solve.modes import modes as modes_of

    scene = read_deck(options.deck).scene
    foundation = foundation_of(scene, options.foundation)
    found = modes_of(scene, foundation, options.count, options.step, options.secant)
    if found.error > found.accuracy:
        told = (
            f"{foundation.name}: the accuracy asked, {found.accuracy:g}, was not reached: the "
            f"largest estimated error is {found.error:.1e} with {found.elements} elements"
        )
        print(f"podeep-solve: warning: {told}", file=sys.stderr)
    if options.json:
        print(json.dumps(modes_data(found, shapes=options.shapes), indent=2))
    elif options.csv:
        sys.stdout.write(modes_csv(found, shapes=options.shapes))
    else:
        print(modes_report(found, scene, shapes=options.shapes))
    if options.directory is not None:
        from ..modes_figure import save_modes

        case = f"{options.deck.stem}_{foundation.name}"
        where = "at rest" if found.step == 0 else f"step {found.step}"
        title = f"{options.deck.stem}, {foundation.name}: modes, {where}"
        stem = f"{case}_modes" + (f"_step{found.step}" if found.step else "")
        picture = save_modes(found, title, make_folder(options.directory), stem)
        data = options.csv or options.json
        print(f"written: {picture}", file=sys.stderr if data else sys.stdout)
    return ExitCode.DONE
