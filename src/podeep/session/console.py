"""Who asks the questions: the reader of scripted answers, and what all consoles share.

A script holds one answer a line, or several numbers a line as at a terminal; blank lines and
`#` comments are skipped. Its transcript looks as a session at a terminal does.
"""

from collections.abc import Callable, Iterable
from typing import Protocol, TextIO, TypeVar

from ..errors import AnswerRefused
from .question import Leave, Question, Refused, numbers

T = TypeVar("T")
Record = Callable[[Question[object], str], None]


class Console(Protocol):
    """What the flow needs of whoever asks.

    `ask` returns the value of an accepted answer, or raises `Up` or `Leave`. `say` is a remark
    of the dialogue, `show` a result.
    """

    def ask(self, question: Question[T]) -> T: ...

    def say(self, text: str) -> None: ...

    def show(self, text: str) -> None: ...


def no_record(question: Question[object], answer: str) -> None:
    """The record of a session that is not recorded."""


def accept(question: Question[T], answer: str, record: Record) -> T:
    """The value of an answer, or its way out raised; raises `Refused`. Recorded if accepted."""
    if way := question.way_out(answer):
        record(question, answer)
        raise way
    value = question.parse(answer)
    record(question, answer)
    return value


class Recorder:
    """Writes accepted answers as a script, the questions as comments."""

    def __init__(self, out: TextIO) -> None:
        self._out = out

    def __call__(self, question: Question[object], answer: str) -> None:
        self._out.write(f"# {question.asked}\n{answer}\n")
        self._out.flush()


class ScriptConsole:
    """Reads the answers from lines of text; the first refused or missing one ends the session.

    `name` is the script's name in messages. The dialogue is flushed before an answer is awaited,
    so that a program at the other end of a pipe can read what is asked.
    """

    def __init__(
        self,
        lines: Iterable[str],
        name: str,
        dialogue: TextIO,
        results: TextIO,
        record: Record = no_record,
    ) -> None:
        self._lines = iter(lines)
        self._name = name
        self._dialogue = dialogue
        self._results = results
        self._record = record
        self._line = 0
        self._waiting: list[str] = []  # numbers of the present line that are not yet asked for
        self._shown = False

    def ask(self, question: Question[T]) -> T:
        """Ask, raising `AnswerRefused` for an answer that is refused or missing."""
        if question.above:
            self.say(question.above)
        self._dialogue.write(question.prompt)
        self._dialogue.flush()
        try:
            answer = self._answer(question)
            self._dialogue.write(answer)
            return accept(question, answer, self._record)
        except Refused as refusal:
            raise AnswerRefused(
                f"{self._name}:{self._line}: {refusal}\n  asked: {question.asked}"
            ) from None
        finally:
            self.say("")

    def say(self, text: str) -> None:
        self._dialogue.write(f"{text}\n")
        self._dialogue.flush()

    def show(self, text: str) -> None:
        self._shown = True
        self._results.write(text)
        self._results.flush()

    def _answer(self, question: Question[T]) -> str:
        if self._waiting and not question.one_number:
            raise Refused(f"'{' '.join(self._waiting)}' is more than the questions asked for")
        if self._waiting:
            return self._waiting.pop(0)
        line = self._next_line()
        if line is None:
            leave = question.sign_of(Leave)
            if self._shown and leave:
                return leave
            self._line += 1
            raise Refused("the answer is missing, the script ends here")
        if question.one_number:
            first, *self._waiting = numbers(line) or [line]
            return first
        return line

    def _next_line(self) -> str | None:
        for line in self._lines:
            self._line += 1
            text = line.lstrip("\ufeff").partition("#")[0].strip()
            if text:
                return text
        return None
