"""What both commands share: errors become messages and exit codes, here and nowhere else."""

import argparse
import os
import sys
import traceback
from collections.abc import Callable

from ..errors import ExitCode, PodeepError


def guarded(program: str, body: Callable[[], int]) -> int:
    """Run a command; return its exit code, or that of the error it ended in."""
    try:
        code = body()
        sys.stdout.flush()
    except PodeepError as error:
        return told(program, str(error), error.exit_code)
    except KeyboardInterrupt:
        return told(program, "interrupted", ExitCode.INTERRUPTED)
    except BrokenPipeError:  # the reader of our output left: nobody to tell, and no fault of ours
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return ExitCode.DONE
    except OSError as error:
        where = f" {error.filename}" if error.filename else ""
        return told(program, f"the system refused{where}: {error.strerror}", ExitCode.USAGE)
    except Exception:  # noqa: BLE001 - the last door: a bug is told, never thrown at the user
        report = traceback.format_exc()
        message = "this is a bug in podeep; please report it with the input and these lines:"
        return told(program, f"{message}\n{report}", ExitCode.BUG)
    return code


def told(program: str, message: str, code: ExitCode) -> ExitCode:
    """Print an error on standard error and hand on its exit code."""
    print(f"{program}: {message}", file=sys.stderr)
    return code


def number(text: str) -> float:
    """A number; the bounds are told with what they depend on."""
    try:
        return float(text)
    except ValueError:
        message = f"'{text}' is no number: write it as 2.0 or 75"
        raise argparse.ArgumentTypeError(message) from None
