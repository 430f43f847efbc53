"""Podeep's questions: menus and numbers, from a database to a request for a result.

The texts of the menus are the original's, to the letter; both flows are entries of one table.
The flow knows neither terminal nor database: a console asks, and `answer` makes the result.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..arrays import Array
from ..query import Kind, spread
from ..units import QUANTITIES, short
from .console import Console
from .question import Choice, Leave, Question, Refused, Up, Way, menu, numbers, real, whole

DatabaseKind = Literal["static", "dynamic"]

_MOST = 10  # curves of one step evolution, and times chosen by the program
_PROPOSAL = 10
_UP: Mapping[str, Way] = {"q": Up}
_EXIT: Choice[Way] = Choice("Exit", "q", Leave)
_TYPE_SIGNS = (("l", "1"), ("f", "2"), ("a", "3"), ("r", "4"))
_OTHER_SIGNS = ("o", "5")


@dataclass(frozen=True, slots=True)
class Extent:
    """What of a foundation is stored: range of depths, m, and steps or times, increasing."""

    depths: tuple[float, float]
    rows: Array


@dataclass(frozen=True, slots=True)
class Source:
    """An open database, as the flow sees it: its kind and the extent of each foundation."""

    kind: DatabaseKind
    extents: Mapping[str, Extent]


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """The result that a dialogue led to; `at` holds the steps or times of a snapshot."""

    source: DatabaseKind
    foundation: str
    analysis: Kind
    quantity: str
    depths: Array
    at: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class _Analysis:
    """A line of an analysis menu: most points over depth, and what asks for steps or times."""

    kind: Kind
    most: int | None
    when: Callable[[Console, Extent], tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class _Flow:
    """Menus and wordings of one kind of database; fewer than `least` rows have no evolution."""

    label: str
    sign: str
    analyses: Question[_Analysis]
    types: Question[str]
    counting: str
    least: int
    too_few: str


def converse(
    console: Console, sources: tuple[Source, ...], answer: Callable[[Request], None]
) -> None:
    """Ask until the user leaves; `answer` makes and shows each result.

    Raises KeyboardInterrupt where the user goes up from the topmost menu.
    """
    choices = [Choice(_FLOWS[s.kind].label, _FLOWS[s.kind].sign, s) for s in sources]
    databases = menu(choices, [_EXIT])
    with suppress(Leave):
        while True:
            try:
                source = console.ask(databases)
            except Up:
                raise KeyboardInterrupt from None
            with suppress(Up):
                _analyses(console, source, answer)


def _analyses(console: Console, source: Source, answer: Callable[[Request], None]) -> None:
    flow = _FLOWS[source.kind]
    foundation = _foundation(console, tuple(source.extents))
    extent = source.extents[foundation]
    while True:
        analysis = console.ask(flow.analyses)
        if analysis.kind == "step_evolution" and len(extent.rows) < flow.least:
            console.say(flow.too_few)
            continue
        with suppress(Up):
            while True:
                quantity = console.ask(flow.types)
                with suppress(Up):
                    depths = _depths(console, extent, analysis.most, flow.counting)
                    at = analysis.when(console, extent)
                    answer(Request(source.kind, foundation, analysis.kind, quantity, depths, at))


def _foundation(console: Console, names: tuple[str, ...]) -> str:
    if len(names) == 1:
        return names[0]
    by_sign = {name.lower(): name for name in names}
    offered = ", ".join(names)

    def parse(name: str) -> str:
        if name.lower() not in by_sign:
            raise Refused(f"'{name}' is not one of {offered}")
        return by_sign[name.lower()]

    return console.ask(
        Question(
            f"Foundation ({offered})",
            parse,
            hint=f"One of {offered}",
            completions=dict.fromkeys(names, ""),
            exits=_UP,
        )
    )
