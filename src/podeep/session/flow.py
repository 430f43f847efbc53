"""Podeep's questions: menus and numbers, from a database to a request for a result.

The texts of the menus are the original's, to the letter; both flows are entries of one table.
The flow knows neither terminal nor database: a console asks, and `answer` makes the result.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass

from ..arrays import Array
from ..query import DatabaseKind, Kind
from ..subject import SUBJECTS, Subject
from ..units import QUANTITIES
from .console import Console
from .points import Extent, ask_all, ask_points, ask_step, ask_times
from .question import Choice, Leave, Question, Refused, Up, Way, menu

_MOST = 10  # curves of a step evolution
_EXIT: Choice[Way] = Choice("Exit", "q", Leave)
_OTHER_ANALYSIS: Choice[Way] = Choice("Other analysis", "o", Up)

# Signs of results in static and dynamic menus; a sign means the same for foundations and lines.
_SIGNS = {
    "lateral_displacement": ("l", "1"),
    "lateral_force": ("f", "2"),
    "axial_displacement": ("a", "3"),
    "axial_force": ("r", "4"),
    "penetration": ("p", "6"),
    "normal_reaction": ("n", "7"),
    "effective_tension": ("e", "8"),
    "bending_moment": ("b", "9"),
}
_OTHER = ("o", "5")


@dataclass(frozen=True, slots=True)
class Source:
    """An open database, as the flow sees it: its kind, the extent of each foundation and line."""

    kind: DatabaseKind
    extents: Mapping[str, Extent]


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """The result that a dialogue led to; `at` holds the steps or times of a snapshot."""

    source: DatabaseKind
    name: str
    analysis: Kind
    quantity: str
    points: Array
    at: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class _Analysis:
    """A line of an analysis menu: most points, and what asks for steps or times."""

    kind: Kind
    most: int | None
    when: Callable[[Console, Extent], tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class _Flow:
    """Menus and wordings of one kind of database; fewer than `least` rows have no evolution.

    types: the menu of results by the name of the subject.
    """

    label: str
    sign: str
    analyses: Question[_Analysis]
    types: Mapping[str, Question[str]]
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
                name = _choose(console, source.extents)
                _analyses(console, source, name, answer)


def _analyses(
    console: Console, source: Source, name: str, answer: Callable[[Request], None]
) -> None:
    flow = _FLOWS[source.kind]
    extent = source.extents[name]
    types = flow.types[extent.subject.name]
    while True:
        analysis = console.ask(flow.analyses)
        if analysis.kind == "step_evolution" and len(extent.rows) < flow.least:
            console.say(flow.too_few)
            continue
        with suppress(Up):
            while True:
                quantity = console.ask(types)
                with suppress(Up):
                    points = ask_points(console, extent, analysis.most, flow.counting)
                    at = analysis.when(console, extent)
                    answer(Request(source.kind, name, analysis.kind, quantity, points, at))


def _choose(console: Console, extents: Mapping[str, Extent]) -> str:
    """One of the foundations and lines; not asked where there is only one."""
    names = tuple(extents)
    if len(names) == 1:
        return names[0]
    there = {extent.subject.name for extent in extents.values()}
    what = " or ".join(s.name for s in SUBJECTS if s.name in there).capitalize()
    by_sign = {name.lower(): name for name in names}
    offered = ", ".join(names)

    def parse(name: str) -> str:
        if name.lower() not in by_sign:
            raise Refused(f"'{name}' is not one of {offered}")
        return by_sign[name.lower()]

    return console.ask(
        Question(
            f"{what} ({offered})",
            parse,
            hint=f"One of {offered}",
            completions=dict.fromkeys(names, ""),
            exits={"q": Up},
        )
    )


def _types(kind: DatabaseKind, subject: Subject) -> Question[str]:
    """The menu of results; it takes the signs of the other kind of database too."""
    own = 0 if kind == "static" else 1
    choices = [
        Choice(QUANTITIES[key].title, _SIGNS[key][own], key, _SIGNS[key])
        for key in subject.quantities
    ]
    ways: list[Choice[Way]] = [Choice("Other", _OTHER[own], Up, _OTHER), _EXIT]
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
        types={s.name: _types("static", s) for s in SUBJECTS},
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
        types={s.name: _types("dynamic", s) for s in SUBJECTS},
        counting="Number of divisions",
        least=2,
        too_few="No step evolution: only one time is stored",
    ),
}
