"""The table of keywords: what the reader reads, the manual prints, and the original has more."""

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from textwrap import fill
from types import MappingProxyType

from ..errors import Fault, UserError
from .action_keywords import (
    DISPLACE,
    INITIAL,
    LOAD,
    MASS,
    QUASISTATIC,
    SPRING,
    SPUDCAN,
    STIFFNESS,
    SUPPORT,
)
from .analysis_keywords import (
    ACCURACY,
    DEPTH,
    EXEC,
    INCLUDE,
    MODEL,
    NEWTONSTAT,
    SEA,
    STOP,
    TITLE,
)
from .column import Column, Keyword, Row
from .ground_keywords import GROUNDEPTH, GROUNDPROP, RADIATION
from .line_keywords import END, LINE, MOTION
from .motion_keywords import (
    DAMPING,
    DTREC,
    DYNAMIC,
    DYNIMP,
    HARMONIC,
    NEWTONDYN,
    TIMESERIES,
)
from .py_keyword import PYCURVE
from .seabed_keyword import SOILSTIFF, SUCTION
from .structure_keywords import CASING, CONTACT, FONDATION, SLAVE, TYPCONTACT
from .tz_keyword import TZCURVE

_WIDTH = 80

#: The keywords that are read, in the order of the manual.
KEYWORDS: Mapping[str, Keyword] = MappingProxyType(
    {
        k.name: k
        for k in (
            *(TITLE, DEPTH, GROUNDEPTH, PYCURVE, TZCURVE, GROUNDPROP, RADIATION),
            *(CASING, FONDATION, SLAVE, LINE, END, MOTION),
            *(TYPCONTACT, CONTACT, SOILSTIFF, SUCTION),
            *(SUPPORT, SPRING, STIFFNESS, SPUDCAN, MASS, LOAD, DISPLACE, QUASISTATIC),
            *(INITIAL, HARMONIC, TIMESERIES, DAMPING, DYNAMIC, DYNIMP, NEWTONDYN, DTREC),
            *(NEWTONSTAT, ACCURACY, MODEL, SEA),
            *(INCLUDE, EXEC, STOP),
        )
    }
)

ALIASES: Mapping[str, str] = MappingProxyType(
    {alias: k.name for k in KEYWORDS.values() for alias in k.aliases}
)

#: Keywords of the original, or planned, that this version does not read.
PLANNED: tuple[str, ...] = tuple(
    """GROUP RISER MOORLINE RIGIBODY RIGIDSTRUC CDDEPTH WAVE FLUID-EX SPRINGPRO TRENCH
    STIFFAMP""".split()
)

#: Of these, the ones that define what others refer to, and the keywords read that they stand for.
DEFINES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    dict.fromkeys(("GROUP", "RISER", "MOORLINE"), ("CASING", "LINE"))
)

#: What belongs to foundations: a deck of lines alone needs none of it.
OF_FOUNDATIONS = ("CASING", "FONDATION", "GROUNDEPTH", "GROUNDPROP", "PYCURVE", "TZCURVE")


def canonical(word: str) -> str:
    """The keyword that a word in upper case stands for: itself, or what it is a spelling of."""
    return ALIASES.get(word, word)


def guessed_keyword(word: str) -> str | None:
    """The keyword that an unknown word in upper case may have been meant as."""
    close = get_close_matches(word, (*KEYWORDS, *ALIASES, *PLANNED), n=1, cutoff=0.6)
    return canonical(close[0]) if close else None


def keyword_remedy(word: str) -> str:
    """What to do about an unknown keyword."""
    guess = guessed_keyword(word)
    return f"did you mean *{guess}?" if guess else "podeep-solve keywords lists those that are read"


def describe(name: str | None) -> str:
    """The text of `podeep-solve keywords [NAME]`: all keywords, or all about one.

    Raises UserError for a name that is no keyword of this version.
    """
    if name is None:
        return "\n".join(_list())
    word = canonical(name.lstrip("*").upper())
    if word in KEYWORDS:
        return "\n".join(_page(KEYWORDS[word]))
    if word in PLANNED:
        raise UserError(Fault(f"*{word} is not read by this version", "see podeep-solve keywords"))
    raise UserError(Fault(f"there is no keyword *{word}", keyword_remedy(word)))


def _list() -> Iterator[str]:
    for keyword in KEYWORDS.values():
        mark = "required" if keyword.required else ""
        yield f"*{keyword.name:<12} {mark:<8}  {keyword.purpose}"
    yield ""
    yield "A deck ends with *EXEC or *STOP. Known, but not read by this version:"
    yield fill(" ".join(f"*{name}" for name in PLANNED), _WIDTH, break_on_hyphens=False)
    yield ""
    yield "podeep-solve keywords NAME tells all about one"
    yield "A deck with *LINE and without foundations requires *DEPTH alone."


def _page(keyword: Keyword) -> Iterator[str]:
    yield f"*{keyword.name}: {keyword.purpose}"
    facts = [f"also spelled *{alias}" for alias in keyword.aliases]
    facts += ["required"] if keyword.required else []
    facts += ["stands once"] if keyword.once else []
    if facts:
        yield f"({'; '.join(facts)})"
    if keyword.notes:
        yield from ("", fill(keyword.notes, _WIDTH))
    for row in keyword.rows:
        yield ""
        yield from _row(row)
    if any(c.named for row in keyword.rows for c in row.columns):
        own = f", or on the keyword's line: *{keyword.name}, NAME=VALUE" if keyword.optioned else ""
        flags = any(c.kind == "flag" for row in keyword.rows for c in row.columns)
        bare = f" A bare word goes there alone: *{keyword.name}, WORD." if flags else ""
        yield from ("", fill(f"NAME=VALUE goes at the end of a line{own}.{bare}", _WIDTH))
    if keyword.planned:
        yield ""
        yield fill(f"Not read by this version: {', '.join(keyword.planned)}.", _WIDTH)
    yield from ("", "Example", *(f"  {line}" for line in keyword.example.splitlines()))


def _row(row: Row) -> Iterator[str]:
    yield fill(f"{row.title}: {row.layout}".rstrip(": "), _WIDTH, subsequent_indent=" " * 4)
    for column in (*row.positional, *row.repeated, *(c for c in row.columns if c.named)):
        name = f"{column.name}=" if column.named and column.kind != "flag" else column.name
        yield fill(
            _what(column),
            _WIDTH,
            initial_indent=f"  {name:<9} ",
            subsequent_indent=" " * 12,
            break_on_hyphens=False,
        )


def _what(column: Column) -> str:
    """Meaning, unit, bounds and default in a line."""
    unit = f" [{column.unit}]" if column.unit not in ("", "-") else ""
    parts = [column.meaning + unit]
    if column.kind == "integer" and not column.choices:
        parts.append("whole number")
    if column.rule:
        listed = column.choices or column.kind == "switch"
        parts.append(column.rule.replace(", ", " | ") if listed else column.rule)
    if column.default is not None:
        default = f"{column.default:g}" if isinstance(column.default, float) else column.default
        if column.kind == "switch":
            default = "ON" if column.default else "OFF"
        parts.append(f"default {default}")
    elif column.otherwise:
        parts.append(f"default: {column.otherwise}")
    return "; ".join(parts)
