"""How motion is followed: *DYNAMIC with *DYNIMP, *NEWTONDYN and *DTREC; and *DAMPING."""

from collections.abc import Iterator, Mapping
from math import pi
from typing import Any

from ..scene import Damping, Dynamics
from .cells import Values, read_lines
from .faults import Faults
from .keywords import KEYWORDS
from .paragraphs import Sorted
from .scan import Paragraph

#: What each value of IOPDYN stands for; None: what the original damps by a formula of its own.
_METHODS = {0: None, 1: "NEWMARK", 2: "NEWMARK", 3: "NEWMARK", 4: "NEWMARK"}
_PREDICTED = (2, 3, 4)
_LIMITS = ("PMAXD1", "PMAXD2", "PMAXD3", "PMAXD4")
#: Values that the original's loops need.
_IDLE = {"DYNIMP": ("ITMIN",), "NEWTONDYN": ("IKRIG", "IKDIV")}
_NEEDING = ("INITIAL", "HARMONIC", "TIMESERIES", "DAMPING", "DYNIMP", "NEWTONDYN", "DTREC")


def read_dynamics(given: Sorted, notes: list[str], faults: Faults) -> Dynamics | None:
    """The run in time; None without *DYNAMIC, or where something is at fault."""
    names = ("DYNAMIC", "DYNIMP", "NEWTONDYN", "DTREC")
    read = {name: values for name in names if (values := given.line(name)) is not None}
    if not given.of["DYNAMIC"]:
        if given.complete("DYNAMIC"):
            idle = [name for name in _NEEDING if given.of[name]]
            notes += [f"*{name} has no effect without *DYNAMIC" for name in idle]
        return None
    if "DYNAMIC" not in read:
        return None
    arguments: dict[str, Any] = {}
    for name in names:
        if name in read:
            arguments |= read[name].arguments(KEYWORDS[name].rows[0].columns)
    run = read["DYNAMIC"]
    arguments.setdefault("method", _METHODS[run.cells["IOPDYN"]])
    arguments["adaptive"] = arguments.get("adaptive") == 1
    if "NEWTONDYN" in read:
        arguments["tolerance"] = min(read["NEWTONDYN"].cells[limit] for limit in _LIMITS)
    dynamics = faults.guarded(lambda: Dynamics(**arguments), run.places, run.place)
    if dynamics is not None:
        notes += _notes(read, dynamics)
    return dynamics


def _notes(read: Mapping[str, Values], dynamics: Dynamics) -> Iterator[str]:
    """Of what was given, what has no effect, and what is not as in the original."""
    run, step = read["DYNAMIC"], read.get("DYNIMP")
    option = run.cells["IOPDYN"]
    if "METHOD" in run.places and option:
        yield f"METHOD={dynamics.method} holds in place of IOPDYN {option}"
    elif option in _PREDICTED:
        yield f"IOPDYN {option} is plain Newmark here: where a step starts to iterate is our choice"
    if step is not None and dynamics.method != "NEWMARK":
        name: str = dynamics.method or "the default method"
        for column in ("DELTA", "ALPHA"):
            if column in step.places:
                yield f"{column} of *DYNIMP is for Newmark, and has no effect on {name}"
    elif 2.0 * dynamics.beta < dynamics.gamma:
        yield (
            f"Newmark with DELTA {dynamics.gamma:g} and ALPHA {dynamics.beta:g} is stable for "
            "short steps alone; 2 ALPHA >= DELTA is for any"
        )
    for name, columns in _IDLE.items():
        for column in columns:
            if name in read and column in read[name].places:
                yield f"{column} of *{name} has no effect here"
    if step is not None and "ITEMAX" in step.places and "NEWTONDYN" in read:
        yield "ITEMAX of *NEWTONDYN holds in place of that of *DYNIMP"


def read_damping(paragraph: Paragraph | None, faults: Faults) -> Damping | None:
    """Rayleigh's factors, as given or from a ratio at two frequencies."""
    if paragraph is None:
        return None
    keyword = KEYWORDS["DAMPING"]
    ratio, factors = keyword.rows
    fields = [*paragraph.options, *(f for line in paragraph.lines for f in line)]
    by_name = bool(fields) and all(f.name and ratio.column(f.name) is None for f in fields)
    for values in read_lines(paragraph, keyword, faults, keyword.rows.index(factors) * by_name):
        if not values.sound:
            continue
        if by_name:
            return Damping(**values.arguments(factors.columns))
        share, *frequencies = (values.cells[c.name] for c in ratio.columns)
        first, last = (2.0 * pi * f for f in frequencies)
        twice = 2.0 * share / (first + last)
        return Damping(twice * first * last, twice)
    return None
