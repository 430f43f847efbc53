"""`podeep`: the post-processor."""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

from .. import __version__
from ..database.read import Database, open_database
from ..errors import ExitCode, Fault, UserError
from ..files import make_folder
from ..query import DatabaseKind
from ..session.cases import find_databases
from ..session.console import Console, Record, Recorder, ScriptConsole, no_record
from ..session.flow import converse
from ..session.result import Results, sources
from ..units import plain
from .common import guarded

_EPILOG = """\
Answers come from the terminal, from --answers FILE, or from standard input where that is a pipe or
a file: one answer a line, or several numbers a line; blank lines and # comments are skipped.
Exit codes: 0 done, 2 usage or database error, 3 scripted answer refused or missing,
130 interrupted, 70 a bug.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    options = _parser().parse_args(arguments)
    return guarded("podeep", lambda: _session(options))


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "podeep",
        description="Soil results of static (.dss) and dynamic (.dst) databases, as tables and "
        "pictures, by Podeep's questions.",
        epilog=_EPILOG,
        allow_abbrev=False,
    )
    parser.add_argument(
        "databases",
        nargs="*",
        metavar="CASE | FILE.dss | FILE.dst",
        help="`run` takes run.dss and run.dst, whichever exist; the only case here if left out",
    )
    parser.add_argument("--answers", metavar="FILE", help="read the answers from FILE")
    parser.add_argument(
        "--record", metavar="FILE", type=Path, help="write the answers to FILE, as such a script"
    )
    parser.add_argument(
        "-o", dest="folder", metavar="DIR", type=Path, default=Path(), help="where pictures go"
    )
    parser.add_argument(
        "--csv",
        action="store_true",
        help="tables as CSV in SI units and full precision; the dialogue goes to standard error",
    )
    parser.add_argument("--no-plot", action="store_true", help="make no pictures")
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    return parser


def _session(options: Namespace) -> ExitCode:
    with ExitStack() as stack:
        databases = _open(find_databases(options.databases, Path()), stack)
        pictures = None if options.no_plot else make_folder(options.folder)
        console = _console(options, stack)
        results = Results(databases, console, options.csv, pictures)
        converse(console, sources(databases), results)
    return ExitCode.DONE


def _open(paths: Iterable[Path], stack: ExitStack) -> dict[DatabaseKind, Database]:
    """The databases by kind, static first."""
    databases: dict[DatabaseKind, Database] = {}
    for path in paths:
        database = stack.enter_context(open_database(path))
        if other := databases.get(database.kind):
            raise UserError(
                Fault(
                    f"{other.path} and {path} are both {database.kind}",
                    "give one static and one dynamic database at most",
                )
            )
        databases[database.kind] = database
        if database.status != "complete":
            reason = f": {plain(database.stop_reason)}" if database.stop_reason else ""
            sys.stderr.write(f"podeep: {path}: the run's status is {database.status}{reason}\n")
    return {kind: databases[kind] for kind in ("static", "dynamic") if kind in databases}


def _console(options: Namespace, stack: ExitStack) -> Console:
    """A terminal's console where answers are typed, else the reader of a script."""
    record = _record(options.record, stack)
    if options.answers is None and sys.stdin and sys.stdin.isatty():
        from ..session.terminal import TerminalConsole

        # Only a terminal can hold the dialogue; results may go to a file meanwhile.
        dialogue = sys.stdout if sys.stdout.isatty() and not options.csv else sys.stderr
        return TerminalConsole(dialogue, sys.stdout, record)
    dialogue = sys.stderr if options.csv else sys.stdout
    lines, name = _script(options.answers, stack)
    return ScriptConsole(lines, name, dialogue, sys.stdout, record)


def _script(name: str | None, stack: ExitStack) -> tuple[Iterable[str], str]:
    """Lines of the script and its name; bytes that are no text are refused as answers."""
    if name is None:
        if isinstance(sys.stdin, TextIOWrapper):
            sys.stdin.reconfigure(encoding="utf-8", errors="replace")
        return sys.stdin or (), "<stdin>"
    path = Path(name)
    try:
        lines = stack.enter_context(path.open(encoding="utf-8", errors="replace"))
    except OSError as error:
        raise UserError(
            Fault(f"{name} cannot be read: {error.strerror}", "give --answers a file of answers")
        ) from error
    return lines, name


def _record(path: Path | None, stack: ExitStack) -> Record:
    if path is None:
        return no_record
    try:
        out: TextIO = stack.enter_context(path.open("x", encoding="utf-8"))
    except FileExistsError:
        raise UserError(
            Fault(f"{path} exists and is not overwritten", "give --record a new name")
        ) from None
    except OSError as error:
        raise UserError(
            Fault(f"{path} cannot be written: {error.strerror}", "give --record another name")
        ) from error
    return Recorder(out)
