"""A question as data: what it says, what it accepts, what helps to answer it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from types import MappingProxyType
from typing import Generic, TypeVar

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class Refused(ValueError):
    """An answer that a question does not accept; the message says why, in words."""


class Leave(Exception):
    """The user leaves the session."""


class Up(Exception):
    """The user goes up one menu."""


Way = type[Leave] | type[Up]


@dataclass(frozen=True, slots=True)
class Question(Generic[T_co]):
    """What a console asks.

    `parse` turns an answer into its value or raises `Refused`. `exits` are answers, in small
    letters, that lead out instead. `above` is shown over the question, `hint` and `completions`
    (with what they mean) help on a terminal, where an empty answer stands for `proposal`. A
    question with `one_number` takes one number of a
    line that may hold the answers to the next questions too.
    """

    text: str
    parse: Callable[[str], T_co]
    above: str = ""
    hint: str = ""
    proposal: str = ""
    completions: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    exits: Mapping[str, Way] = field(default_factory=lambda: MappingProxyType({}))
    one_number: bool = False
    is_menu: bool = False

    @property
    def prompt(self) -> str:
        return "> " if self.is_menu else f"{self.text}: "

    @property
    def asked(self) -> str:
        return f"{self.text}:"

    def way_out(self, answer: str) -> Way | None:
        return self.exits.get(answer.lower())

    def sign_of(self, way: Way) -> str | None:
        """The answer that leads this way out, None if there is none."""
        return next((sign for sign, its in self.exits.items() if its is way), None)


@dataclass(frozen=True, slots=True)
class Choice(Generic[T]):
    """A line of a menu: its sign, what it stands for, and other signs that it also answers to."""

    label: str
    sign: str
    value: T
    others: tuple[str, ...] = ()

    def signs(self) -> dict[str, T]:
        return dict.fromkeys((self.sign, *self.others), self.value)


def menu(
    choices: Sequence[Choice[T]],
    ways: Sequence[Choice[Way]],
    *,
    head: str = "",
    in_line: str = "",
) -> Question[T]:
    """A menu of choices and ways out: a line each under `head`, or the one line `in_line`."""
    entries = [(c.label, c.sign) for c in choices] + [(w.label, w.sign) for w in ways]
    lines = [f"{label:.<33}<{sign}>" for label, sign in entries]
    named = ", ".join(f"{label} <{sign}>" for label, sign in entries)
    offered = ", ".join(sign for _, sign in entries)
    values = {sign: value for choice in choices for sign, value in choice.signs().items()}

    def parse(answer: str) -> T:
        if (sign := answer.lower()) not in values:
            raise Refused(f"'{answer}' is not one of {offered}")
        return values[sign]

    return Question(
        text=in_line or f"{head} {named}".strip(),
        parse=parse,
        above=in_line or "\n".join([head, *lines] if head else lines),
        hint=f"One of {offered}",
        completions={sign: label for label, sign in entries},
        exits={sign: way for choice in ways for sign, way in choice.signs().items()},
        is_menu=True,
    )


def number(token: str) -> float:
    """A finite number; raises `Refused`."""
    try:
        value = float(token)
    except ValueError:
        value = float("nan")
    if not isfinite(value) or "_" in token:
        raise Refused(f"'{token}' is not a number")
    return value


def numbers(line: str) -> list[str]:
    """The numbers of a line, with blanks or commas between them, as they are written."""
    return line.replace(",", " ").split()


def real(first: float, last: float, unit: str) -> Callable[[str], float]:
    """Parser of a number from `first` to `last`, forgiving what display rounds off."""
    slack = 1e-6 * max(abs(first), abs(last), 1.0)

    def parse(token: str) -> float:
        value = number(token)
        if not first - slack <= value <= last + slack:
            raise Refused(f"{token} {unit} is outside {first:.9g} to {last:.9g} {unit}")
        return min(max(value, first), last)

    return parse


def whole(first: int, last: int | None = None) -> Callable[[str], int]:
    """Parser of a whole number from `first` to `last`, or from `first` on."""

    def parse(token: str) -> int:
        number(token)
        try:
            value = int(token)
        except ValueError:
            raise Refused(f"'{token}' is not a whole number") from None
        if last is not None and not first <= value <= last:
            raise Refused(f"{token} is outside {first} to {last}")
        if value < first:
            raise Refused(f"{token} is less than {first}")
        return value

    return parse
