"""Paragraphs sorted by keyword: unknown ones told, once means once, and the deck has an end."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ..errors import Place
from .cells import Values, read_lines
from .faults import Faults
from .keywords import (
    DEFINES,
    KEYWORDS,
    OF_FOUNDATIONS,
    PLANNED,
    canonical,
    guessed_keyword,
    keyword_remedy,
)
from .scan import Paragraph, Scanned


@dataclass(frozen=True, slots=True)
class Sorted:
    """Paragraphs by keyword, in the order of the deck.

    doubtful: keywords of which there may be more, under a name that is misspelt or not read.
    """

    of: Mapping[str, list[Paragraph]]
    doubtful: frozenset[str]
    faults: Faults

    def complete(self, *keywords: str) -> bool:
        """Whether all paragraphs of these keywords are here."""
        return self.faults.complete and self.doubtful.isdisjoint(keywords)

    def one(self, keyword: str) -> Paragraph | None:
        """The paragraph of a keyword that stands once."""
        return next(iter(self.of[keyword]), None)

    @property
    def lines_alone(self) -> bool:
        """Whether the deck is of lines, as far as can be told, and has nothing of foundations."""
        has_lines = bool(self.of["LINE"]) or not self.complete("LINE")
        return has_lines and not any(self.of[name] for name in OF_FOUNDATIONS)

    def line(self, keyword: str) -> Values | None:
        """The values of a keyword of one line; None if it is missing or at fault."""
        paragraph = self.one(keyword)
        lines = read_lines(paragraph, KEYWORDS[keyword], self.faults) if paragraph else []
        return lines[0] if lines and lines[0].sound else None


def sort_paragraphs(scanned: Scanned, faults: Faults) -> Sorted:
    """Sort the paragraphs of a deck; what is unknown, twice, missing or after the end is told."""
    of: dict[str, list[Paragraph]] = {name: [] for name in KEYWORDS}
    doubtful: set[str] = set()
    if not scanned.paragraphs and faults.complete:
        remedy = "podeep-solve example DIR writes a deck to start from"
        faults.add(scanned.end, "the deck has no keyword", remedy)
        return Sorted(of, frozenset(KEYWORDS), faults)
    end = _check_end(scanned, faults)
    for index, paragraph in enumerate(scanned.paragraphs):
        word = canonical(paragraph.keyword)
        if word in PLANNED:
            doubtful.update(DEFINES.get(word, ()))
            message = f"*{word} is known, but not read by this version"
            faults.add(paragraph.place, message, "take it out")
        elif word not in KEYWORDS:
            doubtful.add(guessed_keyword(word) or "")
            message = f"there is no keyword *{paragraph.keyword}"
            faults.add(paragraph.place, message, keyword_remedy(word))
        elif index > end:  # told already; still defined, for those that refer to it
            if not (KEYWORDS[word].once and of[word]):
                of[word].append(replace(paragraph, keyword=word))
        elif KEYWORDS[word].once and of[word]:
            message = f"*{word} stands twice, first at {of[word][0].place}"
            faults.add(paragraph.place, message, "keep one of them")
        else:
            of[word].append(replace(paragraph, keyword=word))
    given = Sorted(of, frozenset(doubtful), faults)
    _check_required(given, scanned.end)
    return given


def _check_end(scanned: Scanned, faults: Faults) -> int:
    """Index of *EXEC or *STOP; the first thing behind it is told. Past the end without them."""
    words = [p.keyword for p in scanned.paragraphs]
    ends = [words.index(word) for word in ("EXEC", "STOP") if word in words]
    if not ends:
        return len(words)
    end, *behind = scanned.paragraphs[min(ends) :]
    data = [f.place for line in end.lines for f in line] + [o.place for o in end.options]
    places: list[Place] = data or [p.place for p in behind]
    if places:
        message = f"*{end.keyword} ends the deck, but more follows"
        faults.add(places[0], message, "move it above, or take it out")
    return min(ends)


def _check_required(given: Sorted, end: Place) -> None:
    """Tell of the keywords that every deck has and this one lacks."""
    if not given.of["EXEC"] and not given.of["STOP"] and given.complete("EXEC", "STOP"):
        given.faults.add(end, "the deck has no end", "end it with *EXEC or *STOP")
    where = next((p.place for word in ("EXEC", "STOP") for p in given.of[word]), end)
    spared = OF_FOUNDATIONS if given.lines_alone else ()
    for keyword in KEYWORDS.values():
        needed = keyword.required and keyword.name not in spared
        if needed and not given.of[keyword.name] and given.complete(keyword.name):
            given.faults.add(where, f"*{keyword.name} is missing", f"it gives {keyword.purpose}")
