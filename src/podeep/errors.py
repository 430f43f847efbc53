"""What can go wrong, where it stands in the user's input, and the exit code it ends with."""

from dataclasses import dataclass
from enum import IntEnum


class ExitCode(IntEnum):
    """Exit codes of both commands."""

    DONE = 0
    FAILED = 1  # the analysis failed; what was computed is kept and named
    USAGE = 2  # usage, deck or database error
    ANSWER = 3  # a scripted answer was refused or is missing
    BUG = 70
    INTERRUPTED = 130


@dataclass(frozen=True, slots=True)
class Place:
    """Where a piece of input stands: file, line and column (both from 1), and the line itself."""

    file: str
    line: int
    column: int
    text: str = ""
    width: int = 1

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"

    def at(self, column: int, width: int) -> "Place":
        """Another stretch of the same line."""
        return Place(self.file, self.line, column, self.text, width)

    def picture(self) -> str:
        """The line with carets under the value meant; tabs keep their width."""
        indent = "".join("\t" if c == "\t" else " " for c in self.text[: self.column - 1])
        return f"  {self.text}\n  {indent}{'^' * max(self.width, 1)}"


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing wrong with the input: what it is, the remedy, and where it stands."""

    message: str
    remedy: str = ""
    place: Place | None = None

    def __str__(self) -> str:
        text = self.message if not self.remedy else f"{self.message}; {self.remedy}"
        return text if self.place is None else f"{self.place}: {text}\n{self.place.picture()}"


class PodeepError(Exception):
    """Base of every error that is told to the user in words; it carries its exit code."""

    exit_code = ExitCode.USAGE


class UserError(PodeepError):
    """Bad usage, deck or database: all the faults found, in the order of the input."""

    def __init__(self, *faults: Fault | str) -> None:
        self.faults = tuple(Fault(f) if isinstance(f, str) else f for f in faults)
        super().__init__("\n".join(str(f) for f in self.faults))


class InvalidData(ValueError):
    """Data that no scene can hold; `field` names the column of the deck that is to blame."""

    def __init__(self, message: str, remedy: str = "", field: str = "") -> None:
        self.message, self.remedy, self.field = message, remedy, field
        super().__init__(f"{message}; {remedy}" if remedy else message)


class AnalysisFailed(PodeepError):
    """The analysis could not go on; the message says how far it came and what to do."""

    exit_code = ExitCode.FAILED


class Interrupted(PodeepError):
    """The user ended the run; the message says what was kept."""

    exit_code = ExitCode.INTERRUPTED


class AnswerRefused(PodeepError):
    """A scripted answer was refused or is missing."""

    exit_code = ExitCode.ANSWER
