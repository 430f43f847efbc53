"""The faults of a deck, gathered so that all are told at once."""

from bisect import bisect_left
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import TypeVar

from ..errors import Fault, InvalidData, Place, UserError

T = TypeVar("T")

_MOST = 20  # faults told at once


@dataclass(slots=True)
class Faults:
    """Faults as they are found; `files` are the deck's files in the order of reading.

    complete: no file of the deck is lost; otherwise nothing else can be called missing.
    """

    found: list[Fault] = field(default_factory=list)
    files: list[str] = field(default_factory=list)
    complete: bool = True

    def enter(self, file: str) -> None:
        """A file is being read."""
        if file not in self.files:
            self.files.append(file)

    def add(self, place: Place, message: str, remedy: str = "") -> None:
        self.found.append(Fault(message, remedy, place))

    def lost_file(self, place: Place, message: str, remedy: str) -> None:
        """An included file cannot be had."""
        self.complete = False
        self.add(place, message, remedy)

    def guarded(
        self, make: Callable[[], T], places: Mapping[str, Place], otherwise: Place
    ) -> T | None:
        """What `make` returns; or None, and its InvalidData as a fault at the field's place."""
        try:
            return make()
        except InvalidData as error:
            self.add(places.get(error.field, otherwise), error.message, error.remedy)
            return None

    def check(self) -> None:
        """Raise UserError with all faults in the order of the deck, if there are any."""
        if not self.found:
            return

        def order(fault: Fault) -> tuple[int, int, int]:
            place = fault.place
            return (self.files.index(place.file), place.line, place.column) if place else (0, 0, 0)

        faults = sorted(dict.fromkeys(self.found), key=order)
        more = [f"and {len(faults) - _MOST} more"] if len(faults) > _MOST else []
        raise UserError(*faults[:_MOST], *more)


def nearest(word: str, known: Iterable[str]) -> str:
    """The likeliest of the known words as a question, or the list of them."""
    names = list(known)
    close = get_close_matches(word.upper(), {n.upper(): n for n in names}, n=1, cutoff=0.6)
    if close:
        return f"did you mean {next(n for n in names if n.upper() == close[0])}?"
    return f"known are {', '.join(names)}" if names else "none is known here"


def first_bad(make: Callable[[int], object], count: int) -> tuple[int, InvalidData] | None:
    """Index of the first of `count` things that those before it cannot be joined by, and why.

    make: joins the first n things; it raises InvalidData for them only if it does for more.
    """

    def problem(n: int) -> InvalidData | None:
        try:
            make(n)
        except InvalidData as error:
            return error
        return None

    index = bisect_left(range(1, count + 1), True, key=lambda n: problem(n) is not None)
    found = problem(index + 1) if index < count else None
    return None if found is None else (index, found)
