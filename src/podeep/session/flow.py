"""Podeep's questions: menus and numbers, from a database to a request for a result.

The texts of the menus are the original's, to the letter; both flows are entries of one table.
The flow knows neither terminal nor database: a console asks, and `answer` makes the result.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass

from ..arrays import Array
from ..query import DatabaseKind, Kind
from ..units import QUANTITIES
from .console import Console
from .points import Extent, ask_all, ask_depths, ask_step, ask_times
from .question import Choice, Leave, Question, Refused, Up, Way, menu

_MOST = 10  # curves of a step evolution
_EXIT: Choice[Way] = Choice("Exit", "q", Leave)
_OTHER_ANALYSIS: Choice[Way] = Choice("Other analysis", "o", Up)


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
                foundation = _foundation(console, tuple(source.extents))
                _analyses(console, source, foundation, answer)


def _analyses(
    console: Console, source: Source, foundation: str, answer: Callable[[Request], None]
) -> None:
    flow = _FLOWS[source.kind]
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
                    depths = ask_depths(console, extent, analysis.most, flow.counting)
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
            exits={"q": Up},
        )
    )


def _types(other: str, signs: str) -> Question[str]:
    """The menu of results; `signs` are its own, and it takes the other flow's too."""
    choices = [
        Choice(quantity.title, own, quantity.key, (letter, digit))
        for quantity, letter, digit, own in zip(
            QUANTITIES.values(), "lfar", "1234", signs, strict=True
        )
    ]
    ways: list[Choice[Way]] = [Choice("Other", other, Up, ("o", "5")), _EXIT]
    return menu(choices, ways, head="Type of results:")


_STEP_EVOLUTION = Choice("Step evolution", "t", _Analysis("step_evolution", _MOST, ask_all))
_SNAPSHOT = Choice("Snapshot", "f", _Analysis("snapshot", None, ask_step), ("x",))
_SNAPSHOTS = Choice("Snapshot", "f", _Analysis("snapshot", None, ask_times), ("x",))
_ENVELOPE = Choice("Envelop", "e", _Analysis("envelope", None, ask_all))

_FLOWS = {
    "static": _Flow(
        label="Static soil results",
        sign="g",
        analyses=menu(
            [_STEP_EVOLUTION, _SNAPSHOT],
            [_OTHER_ANALYSIS, _EXIT],
            in_line="Step evolution <t>, Snapshot <f>, Other analysis <o>, exit<q>",
        ),
        types=_types("o", "lfar"),
        counting="Number of calculation points",
        least=3,
        too_few="No step evolution: only one static step is defined",
    ),
    "dynamic": _Flow(
        label="Dynamic soil results",
        sign="h",
        analyses=menu(
            [_STEP_EVOLUTION, _SNAPSHOTS, _ENVELOPE],
            [_OTHER_ANALYSIS, _EXIT],
            in_line="Step evolution <t>, Snapshot <f>, Envelop <e>, Other analysis <o>, exit<q>",
        ),
        types=_types("5", "1234"),
        counting="Number of divisions",
        least=2,
        too_few="No step evolution: only one time is stored",
    ),
}
