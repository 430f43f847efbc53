"""Deck files become paragraphs: a keyword, its options, and lines of fields with their places.

Nothing here knows what a keyword means, but for those that change how text is read: *TITLE, whose
text is raw, *INCLUDE, which is replaced by the lines of another file, and *TIMESERIES and *MOTION,
whose lines may name a file that holds more of their data.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import Fault, Place, UserError
from .faults import Faults

_KEYWORD = re.compile(r"(\s*)\*([^\s,!&]*)")
_OPTION = re.compile(r"\s*,\s*(?:([A-Za-z_]\w*)\s*=\s*)?([^\s,!&]*)", re.ASCII)
_FIELD = re.compile(r"(?:([A-Za-z_][A-Za-z0-9_]*)\s*=\s*)?(\S+)")
_CUT = re.compile(r"[!&]")
_COMMENT = re.compile(r"[Cc](?!\w*=)")
_INCLUDE = re.compile(r"\*INCLUDE(?![^\s,!&])", re.IGNORECASE)
_FILE = re.compile(r"[\s,]+file\s*=\s*([^!]*[^!\s])\s*(?:!.*)?", re.IGNORECASE)
_DATA_FILE = re.compile(r"([^!]*?)(?:[\s,]+|^)file\s*=\s*([^!]*)", re.IGNORECASE)
_OWNERS = {"TIMESERIES": "NAME", "MOTION": "IGR END DOF ..."}  # of such files, and their lines
_TITLE = re.compile(r"\*TITLE(?![^\s,!&])[\s,]*", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Field:
    """A value as it was written; `name` is the upper-case name of NAME=value."""

    text: str
    place: Place
    name: str = ""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A keyword in upper case without its star, its options, its lines of data.

    comments: places of the comment lines under it.
    """

    keyword: str
    place: Place
    options: tuple[Field, ...] = ()
    lines: tuple[tuple[Field, ...], ...] = ()
    comments: tuple[Place, ...] = ()


@dataclass(frozen=True, slots=True)
class Scanned:
    """A deck as paragraphs, its text with the included files in it, and its last line."""

    paragraphs: tuple[Paragraph, ...]
    text: str
    end: Place


@dataclass(frozen=True, slots=True)
class _Line:
    """A line of a file.

    included: it is an *INCLUDE, which the lines of its file follow. end: where its data end, and
    the name of a file begins whose lines follow. data: it holds data alone, no keyword.
    """

    place: Place
    included: bool = False
    end: int | None = None
    data: bool = False

    @property
    def stored(self) -> str:
        """The line as it reads when the lines of the file that it names follow."""
        text = self.place.text
        if self.included:
            return f"! {text}"
        return text if self.end is None else f"{text[: self.end]} !{text[self.end :]}"


class _Unreadable(Exception):
    """A file that cannot be read as text, and why."""

    def __init__(self, reason: str, remedy: str) -> None:
        self.reason, self.remedy = reason, remedy
        super().__init__(reason)


def scan(path: Path, faults: Faults) -> Scanned:
    """Read a deck and the files it includes.

    Raises UserError where the deck itself cannot be read; every other fault goes to `faults`.
    """
    try:
        lines = list(_with_data(_lines(path, (), faults), faults))
    except _Unreadable as problem:
        message = f"cannot read the deck {path}: {problem.reason}"
        raise UserError(Fault(message, problem.remedy)) from problem
    text = "".join(f"{line.stored}\n" for line in lines)
    content = (field.place for line in reversed(lines) for field in _raw(line.place, 0))
    end = next(content, Place(str(path), 1, 1))
    return Scanned(tuple(_paragraphs(lines, faults)), text, end)


def _text(path: Path, what: str = "deck") -> str:
    """The text of a file, with \\n at the end of each line; `what` it should hold, in words."""
    try:
        if path.is_dir():
            raise _Unreadable("it is a directory", f"name the {what} in it")
        if path.exists() and not path.is_file():
            raise _Unreadable("it is no regular file", f"save the {what} to a file")
        data = path.read_bytes()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise _Unreadable(reason, "check its name and that it may be read") from error
    except ValueError as error:  # a name with a null character
        raise _Unreadable("no file can have this name", "check its name") from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = data[error.start]
        raise _Unreadable(
            f"line {line} holds the byte 0x{byte:02x}, which is not UTF-8", "save the file as UTF-8"
        ) from error
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise _Unreadable(f"line {line} holds a null character", "save the file as plain text")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _lines(path: Path, chain: tuple[Path, ...], faults: Faults) -> Iterator[_Line]:
    """The lines of a file, with those of the files it includes in their places."""
    text, chain = _text(path), (*chain, path)
    faults.enter(str(path))
    for number, line in enumerate(text.removesuffix("\n").split("\n"), start=1):
        place = Place(str(path), number, 1, line)
        included = _INCLUDE.match(line) is not None
        yield _Line(place, included)
        if included:
            yield from _included(replace(place, width=len("*INCLUDE")), chain, faults)


def _included(place: Place, chain: tuple[Path, ...], faults: Faults) -> Iterator[_Line]:
    """The lines of the file that the *INCLUDE at `place` names."""
    named = _FILE.fullmatch(place.text, len("*INCLUDE"))
    if named is None:
        faults.lost_file(place, "*INCLUDE names no file", "write *INCLUDE, file=NAME")
        return
    where = place.at(named.start(1) + 1, len(named[1]))
    path = chain[-1].parent / named[1]
    try:
        cycle = any(path.samefile(known) for known in chain)
    except (OSError, ValueError):
        cycle = False  # no such file: reading it tells so
    if cycle:
        names = " -> ".join(str(p) for p in (*chain, path))
        faults.lost_file(where, f"the file includes itself: {names}", "take one *INCLUDE out")
        return
    try:
        yield from _lines(path, chain, faults)
    except _Unreadable as problem:
        faults.lost_file(where, f"cannot read {str(path)!r}: {problem.reason}", problem.remedy)


def _with_data(lines: Iterable[_Line], faults: Faults) -> Iterator[_Line]:
    """The lines of a deck, with those of the files that hold more data after their names.

    They stand in the text of the deck as they would without the file, so that it can be read alone.
    """
    owns = ""
    for line in lines:
        text = line.place.text
        keyword = _KEYWORD.match(text)
        if keyword:
            owns = keyword[2].upper()
        named = _DATA_FILE.match(text) if owns in _OWNERS and not _COMMENT.match(text) else None
        owner = named[1][keyword.end() if keyword else 0 :].strip(" \t,") if named else ""
        if named is None or not owner:
            yield line
            continue
        yield replace(line, end=named.end(1))
        name = named[2].strip()
        where = line.place.at(named.start(2) + 1, max(len(name), 1))
        if name:
            yield from _data(Path(line.place.file).parent / name, where, faults)
        else:
            remedy = f"write *{owns} {_OWNERS[owns]}, file=F"
            faults.add(where, f"*{owns} names no file", remedy)


def _data(path: Path, where: Place, faults: Faults) -> Iterator[_Line]:
    """The lines of a file of data that is named at `where`."""
    try:
        text = _text(path, "data")
    except _Unreadable as problem:
        faults.add(where, f"cannot read {str(path)!r}: {problem.reason}", problem.remedy)
        return
    faults.enter(str(path))
    for number, line in enumerate(text.removesuffix("\n").split("\n"), start=1):
        yield _Line(Place(str(path), number, 1, line), data=True)


def _paragraphs(lines: Sequence[_Line], faults: Faults) -> Iterator[Paragraph]:
    """Group lines under their keywords."""
    now: Paragraph | None = None
    data: list[tuple[Field, ...]] = []
    comments: list[Place] = []
    homeless = False  # one fault is enough for many lines
    for line in _logical(lines, faults):
        if line.keyword is not None:
            if now is not None:
                yield replace(now, lines=tuple(data), comments=tuple(comments))
            now, data, comments, homeless = line.keyword, [], [], False
        if line.comment is not None:
            comments.append(line.comment)
        if line.fields and now is not None and now.keyword != "INCLUDE":
            data.append(line.fields)
        elif line.fields and not homeless:
            homeless = True
            message = "these data stand under no keyword"
            faults.add(line.fields[0].place, message, "a keyword starts with * in column 1")
    if now is not None:
        yield replace(now, lines=tuple(data), comments=tuple(comments))


@dataclass(frozen=True, slots=True)
class _Logical:
    """Lines that & joins: the keyword they start and their fields; or a comment."""

    keyword: Paragraph | None = None
    fields: tuple[Field, ...] = ()
    comment: Place | None = None


def _logical(lines: Sequence[_Line], faults: Faults) -> Iterator[_Logical]:
    """Join lines that end in &, set comments apart, keep the line after *TITLE as it is."""
    pending = _Logical()
    joins: Place | None = None  # the & that waits for a line
    title = False
    for line in lines:
        place, text = line.place, line.place.text
        keyword = None if line.data else _KEYWORD.match(text)
        if title and not (keyword and keyword[2][:1].isalpha()):
            yield _Logical(fields=_raw(place, 0))
            title = False
            continue
        title = False
        if _COMMENT.match(text):
            yield _Logical(comment=place)
            continue
        begin = 0
        if keyword:
            if joins is not None:
                faults.add(joins, "& joins the next line, but a keyword follows", "take & out")
                yield pending
                joins = None
            if named := _TITLE.match(text):
                title = text[named.end() : named.end() + 1] in ("", "!")
                opened = Paragraph("TITLE", replace(place, width=len("*TITLE")))
                yield _Logical(opened, () if title else _raw(place, named.end()))
                pending = _Logical()
                continue
            opened, begin = _opened(keyword, place, line.end, faults)
            begin = len(text) if line.included else begin
            pending = _Logical(opened)
        fields, joins = _fields(place, begin, line.end)
        pending = replace(pending, fields=(*pending.fields, *fields))
        if joins is None:
            yield pending
            pending = _Logical()
    if joins is not None:
        faults.add(joins, "& joins the next line, but none follows", "take & out")
        yield pending


def _opened(
    found: re.Match[str], place: Place, limit: int | None, faults: Faults
) -> tuple[Paragraph, int]:
    """The paragraph that a keyword's line starts, and where its data start."""
    begin, end = len(found[1]), found.end()
    where = place.at(begin + 1, end - begin)
    if begin:
        faults.add(where, f"*{found[2]} is indented", "a keyword starts in column 1")
        faults.complete &= found[2].upper() != "INCLUDE"
    options = []
    limit = len(place.text) if limit is None else limit
    while option := _OPTION.match(place.text, end, limit):
        end = option.end()
        start = option.start(1 if option[1] else 2)
        at = place.at(start + 1, max(end - start, 1))
        if option[2] or option[1]:
            options.append(Field(option[2], at, (option[1] or "").upper()))
        else:
            faults.add(at, "an option is missing", "write options as *KEYWORD, WORD, NAME=VALUE")
    return Paragraph(found[2].upper(), where, tuple(options)), end


def _fields(place: Place, begin: int, limit: int | None) -> tuple[tuple[Field, ...], Place | None]:
    """The fields of a line from `begin` to `limit`, and the place of the & that ends it."""
    limit = len(place.text) if limit is None else limit
    cut = _CUT.search(place.text, begin, limit)
    end = cut.start() if cut else limit
    fields = tuple(
        Field(
            found[2],
            place.at(found.start() + 1, found.end() - found.start()),
            (found[1] or "").upper(),
        )
        for found in _FIELD.finditer(place.text, begin, end)
    )
    if cut and cut[0] == "&":
        return fields, replace(place, column=end + 1)
    return fields, None


def _raw(place: Place, begin: int) -> tuple[Field, ...]:
    """The rest of a line as one field; none where it is blank."""
    text = place.text[begin:].strip()
    start = place.text.index(text, begin)
    return (Field(text, place.at(start + 1, len(text))),) if text else ()
