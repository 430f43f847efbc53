"""The console of a terminal: completion, history, a hint line, refused answers stay editable."""

import os
from typing import TextIO, TypeVar

from prompt_toolkit import PromptSession
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.document import Document
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.output import ColorDepth, Output, create_output
from prompt_toolkit.output.vt100 import Vt100_Output
from prompt_toolkit.validation import ValidationError, Validator

from .console import Record, accept, no_record
from .question import Leave, Question, Refused, Up, Way, numbers

T = TypeVar("T")


class TerminalConsole:
    """Asks at a terminal; Ctrl-C goes up one menu, Ctrl-D leaves.

    Of several numbers on a line the first answers the question, and the rest wait for the next.
    """

    def __init__(self, dialogue: TextIO, results: TextIO, record: Record = no_record) -> None:
        self._dialogue = dialogue
        self._results = results
        self._record = record
        self._output = _output(dialogue)
        self._sessions: dict[str, PromptSession[str]] = {}  # by question: each has its history
        self._waiting: list[str] = []

    def ask(self, question: Question[T]) -> T:
        """Ask until an answer is accepted."""
        if question.above:
            self.say(question.above)
        draft = ""
        if self._waiting and question.one_number:
            draft = self._waiting.pop(0)
            self.say(f"{question.prompt}{draft}")
            try:
                return accept(question, draft, self._record)
            except Refused as refusal:
                self.say(str(refusal))
                self._waiting.clear()
        elif self._waiting:
            self.say(f"Not asked for: {' '.join(self._waiting)}")
            self._waiting.clear()
        return accept(question, self._read(question, draft), self._record)

    def say(self, text: str) -> None:
        self._dialogue.write(f"{text}\n")
        self._dialogue.flush()

    def show(self, text: str) -> None:
        self._results.write(text)
        self._results.flush()

    def _read(self, question: Question[object], draft: str) -> str:
        """An answer that the question accepts."""
        session = self._sessions.setdefault(
            question.text, PromptSession(output=self._output, key_bindings=_keys())
        )
        try:
            text = session.prompt(
                question.prompt,
                default=draft,
                placeholder=question.proposal,
                completer=WordCompleter(
                    list(question.completions), meta_dict=dict(question.completions)
                ),
                complete_while_typing=False,
                reserve_space_for_menu=len(question.completions),
                validator=_Check(question),
                validate_while_typing=False,
                bottom_toolbar=_hint(question),
            )
        except KeyboardInterrupt:
            self._go(question, Up)
            raise Up from None
        except EOFError:
            self._go(question, Leave)
            raise Leave from None
        answer, self._waiting = _split(question, text)
        return answer

    def _go(self, question: Question[object], way: Way) -> None:
        """Record a way out by key as the answers that lead there."""
        if sign := question.sign_of(way):
            self._record(question, sign)
        elif way is Leave and (sign := question.sign_of(Up)):
            self._record(question, sign)
            self._record(question, "q")


class _Vt100(Vt100_Output):
    """A terminal that is not asked where its cursor is.

    Without the question the hint line stands right under the answer, and a terminal that leaves
    the question unanswered costs no second's wait for each prompt.
    """

    def get_rows_below_cursor_position(self) -> int:
        return 0


def _output(stream: TextIO) -> Output:
    if os.name == "posix" and stream.isatty():
        return _Vt100.from_pty(
            stream, term=os.environ.get("TERM"), default_color_depth=ColorDepth.from_env()
        )
    return create_output(stdout=stream)


class _Check(Validator):
    def __init__(self, question: Question[object]) -> None:
        self._question = question

    def validate(self, document: Document) -> None:
        answer, _ = _split(self._question, document.text)
        if self._question.way_out(answer):
            return
        try:
            self._question.parse(answer)
        except Refused as refusal:
            raise ValidationError(len(document.text), str(refusal)) from None


def _split(question: Question[object], text: str) -> tuple[str, list[str]]:
    """The answer in a line, its numbers beyond the first; an empty line is the proposal."""
    line = text.strip() or question.proposal
    if not question.one_number:
        return line, []
    first, *rest = numbers(line) or [line]
    return first, rest


def _hint(question: Question[object]) -> str:
    proposal = f"; Enter takes {question.proposal}" if question.proposal else ""
    return f"{question.hint}{proposal}  |  Ctrl-C goes up, Ctrl-D leaves"


def _keys() -> KeyBindings:
    keys = KeyBindings()

    @keys.add("c-d")
    def _(event: KeyPressEvent) -> None:
        """Leave even with text on the line, where the default deletes a character."""
        event.app.exit(exception=EOFError)

    return keys
