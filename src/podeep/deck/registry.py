"""What a deck defines by an id or a name, and who refers to it."""

import re
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from ..errors import Place
from .faults import Faults

T = TypeVar("T")

_BROKEN = re.compile(r"(\d+)[.,](\d*)", re.ASCII)  # a whole number that is written as another


@dataclass(slots=True)
class Registry(Generic[T]):
    """Things by id, as a keyword defines them.

    items: None for a thing that is at fault, so that a reference to it is no second fault.
    complete: every id could be read; otherwise no reference is called missing.
    meant: ids that things whose id is at fault may have been meant to have. elsewhere: what other
    things are, in words by their id.
    """

    noun: str
    keyword: str
    faults: Faults
    items: dict[int, T | None] = field(default_factory=dict)
    places: dict[int, Place] = field(default_factory=dict)
    complete: bool = True
    meant: set[int] = field(default_factory=set)
    last: int = 0
    elsewhere: dict[int, str] = field(default_factory=dict)

    def add(self, id_: int | None, place: Place, item: T | None) -> None:
        """Take a thing in; None as id is one that is at fault, and is guessed from its place."""
        if id_ is None:
            self._guess(place, item)
        elif id_ in self.places:
            self.faults.add(
                place,
                f"{self.noun} {id_} is defined twice, first at {self.places[id_]}",
                "give each its own id",
            )
            self.meant |= {self.last + 1, id_ - 1}
        else:
            self.items[id_], self.places[id_] = item, place
            self.last = id_

    def _guess(self, place: Place, item: T | None) -> None:
        begin = place.column - 1
        broken = _BROKEN.fullmatch(place.text[begin : begin + place.width])
        if broken is None:
            self.complete = False
            return
        whole, rest = broken.groups()
        self.meant.add(int(whole + rest))
        self.items.setdefault(int(whole), item)
        self.places.setdefault(int(whole), place)

    def get(self, id_: int, place: Place) -> T | None:
        """The thing that is meant at `place`; None if it is at fault or missing, which is told."""
        known_to_all = self.places.keys() | self.meant
        if id_ not in known_to_all and self.complete and self.faults.complete:
            known = ", ".join(str(i) for i in sorted(self.places))
            self.faults.add(
                place,
                f"there is no {self.noun} {id_}",
                self.elsewhere.get(id_)
                or (
                    f"*{self.keyword} defines {known}"
                    if known
                    else f"no *{self.keyword} defines one"
                ),
            )
        return self.items.get(id_)

    @property
    def sound(self) -> dict[int, T]:
        """The things without fault."""
        return {id_: item for id_, item in self.items.items() if item is not None}
