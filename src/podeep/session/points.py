"""Which points, steps and times: the questions for numbers, and the rules they keep."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ..arrays import Array
from ..query import spread
from ..subject import FOUNDATION, Subject
from ..units import short
from .console import Console
from .question import Question, Refused, Up, Way, numbers, real, whole

_PROPOSAL = 10
_CHOSEN_TIMES = 10  # at most so many times chosen by the program, and fewer of the user's own
_UP: Mapping[str, Way] = {"q": Up}


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """What is stored of a foundation or line: range of its points, m; steps or times, rising."""

    limits: tuple[float, float]
    rows: Array
    subject: Subject = FOUNDATION


def ask_points(console: Console, extent: Extent, most: int | None, counting: str) -> Array:
    """Two depths or distances in either order and the number of points from one to the other."""
    subject, (least, largest) = extent.subject, extent.limits
    limits = f"{short(least)} to {short(largest)} m"
    inside = real(least, largest, "m")
    ends = f"{subject.coordinate}s"
    first = console.ask(
        Question(
            f"First {subject.where} (m)",
            inside,
            above=f"{ends.capitalize()} from {limits}",
            hint=f"{limits}, {subject.positive}",
            exits=_UP,
            one_number=True,
        )
    )
    second = console.ask(
        Question(
            f"Second {subject.where} (m)",
            inside,
            hint=f"{limits}, {subject.positive}, {subject.order}",
            exits=_UP,
            one_number=True,
        )
    )
    return spread(first, second, _ask_count(console, counting, most, first == second, ends))


def ask_all(console: Console, extent: Extent) -> tuple[float, ...]:
    """A step evolution and an envelope take all steps or times: nothing is asked."""
    return ()


def ask_step(console: Console, extent: Extent) -> tuple[float, ...]:
    """The number of a static step."""
    last = int(extent.rows[-1])
    step = console.ask(
        Question(
            "Number of the quasi-static step",
            whole(0, last),
            above=f"Steps from 0 to {last}",
            hint=f"0 to {last}; 0 is {extent.subject.start}",
            exits=_UP,
            one_number=True,
        )
    )
    return (float(step),)


def ask_times(console: Console, extent: Extent) -> tuple[float, ...]:
    """Times evenly spread over a period, or the user's own."""
    way = console.ask(_WHO_CHOOSES)
    return way(console, float(extent.rows[0]), float(extent.rows[-1]))


def _chosen_times(console: Console, first: float, last: float) -> tuple[float, ...]:
    def moment(text: str, earliest: float, above: str = "") -> Question[float]:
        return Question(
            text,
            real(earliest, last, "s"),
            above=above,
            hint=f"{short(earliest)} to {short(last)} s",
            exits=_UP,
            one_number=True,
        )

    limits = f"Times from {short(first)} to {short(last)} s"
    start = console.ask(moment("Start, end and number of times", first, limits))
    end = console.ask(moment("End and number of times", start))
    count = _ask_count(console, "Number of times", _CHOSEN_TIMES, start == end, "times")
    return tuple(spread(start, end, count).tolist())


def _own_times(console: Console, first: float, last: float) -> tuple[float, ...]:
    inside = real(first, last, "s")

    def parse(line: str) -> tuple[float, ...]:
        tokens = numbers(line)
        if not 0 < len(tokens) < _CHOSEN_TIMES:
            raise Refused(f"{len(tokens)} times are given; give 1 to {_CHOSEN_TIMES - 1}")
        return tuple(inside(token) for token in tokens)

    limits = f"{short(first)} to {short(last)} s"
    return console.ask(
        Question(
            "Times (s)",
            parse,
            above=f"Times from {limits}",
            hint=f"1 to {_CHOSEN_TIMES - 1} times on one line, {limits}",
            exits=_UP,
        )
    )


def _who_chooses(answer: str) -> Callable[[Console, float, float], tuple[float, ...]]:
    match answer.lower():
        case "a":
            return _chosen_times
        case "b":
            return _own_times
    raise Refused(f"'{answer}' is not one of a, b")


_WHO_CHOOSES = Question(
    "Times: chosen by the program <a>, your own <b>",
    _who_chooses,
    hint="One of a, b",
    completions={"a": "chosen by the program", "b": "your own"},
    exits=_UP,
)


def _ask_count(console: Console, text: str, most: int | None, single: bool, ends: str) -> int:
    """How many points, both ends included: 1 where the ends agree, else 2 or more."""
    several = whole(2, most)

    def one(token: str) -> int:
        if whole(1)(token) != 1:
            raise Refused(f"{token} is not 1, and the two {ends} are equal")
        return 1

    limits = "2 or more" if most is None else f"2 to {most}"
    return console.ask(
        Question(
            text,
            one if single else several,
            hint=f"1, as the two {ends} are equal" if single else f"{limits}, both ends included",
            proposal="1" if single else "" if most else str(_PROPOSAL),
            exits=_UP,
            one_number=True,
        )
    )
