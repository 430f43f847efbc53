"""What is legal but risky, in one line: whose and what, the numbers, the rule and the remedy."""

from collections.abc import Iterator, Sequence
from math import floor, log10
from typing import NamedTuple

from ..tubes import Wall
from ..units import short
from .ranges import TUBE_SLIPS, Slip

_PREFIXES = (("G", 1e9), ("M", 1e6), ("k", 1e3))
_MOST = 4  # ids that are listed


class Risk(NamedTuple):
    """A warning of a subject; of several about the same thing of it the first is told."""

    subject: str
    about: str
    numbers: str
    rule: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.subject}: {self.numbers}: {self.rule}; {self.remedy}"


class Value(NamedTuple):
    """A value in the unit of the deck, under its name there."""

    name: str
    amount: float
    unit: str

    def __str__(self) -> str:
        return f"{self.name} = {readable(self.amount, self.unit)}"


def readable(amount: float, unit: str) -> str:
    """An amount to six digits; its unit with a prefix where it is one of force.

    >>> readable(40e3, "Pa"), readable(2.134, "m"), readable(0.02, "-")
    ('40 kPa', '2.134 m', '0.02')
    """
    if unit[:1] in ("P", "N"):  # Pa, N and what they make
        for prefix, size in _PREFIXES:
            if abs(amount) >= size * (1.0 - 1e-9):
                return f"{short(amount / size)} {prefix}{unit}"
    return f"{short(amount)} {unit.replace('-', '')}".rstrip()


def rounded(amount: float, unit: str) -> str:
    """A computed amount to four digits, forces in kN.

    >>> rounded(41661700.0, "N"), rounded(62.34561, "m")
    ('41660 kN', '62.35 m')
    """
    if unit == "N":
        return f"{_four(1e-3 * amount)} kN"
    return readable(float(f"{amount:.4g}"), unit)


def _four(amount: float) -> str:
    return short(float(f"{amount:.4g}"))


def written(amount: float) -> str:
    """A number as a deck has it, to four digits.

    >>> written(210e9), written(40e3), written(7850.0), written(0.02)
    ('210e9', '40e3', '7850', '0.02')
    """
    power = 3 * floor(log10(amount) / 3.0 + 1e-12) if amount >= 1e4 else 0
    return f"{_four(amount / 10.0**power)}{f'e{power}' if power else ''}"


def listed(ids: Sequence[int]) -> str:
    """Ids of curves in words, the first ones where they are many.

    >>> listed([1, 2]), listed(range(1, 38))
    ('1, 2', '1, 2, 3, 4 and 33 more')
    """
    named = ", ".join(str(i) for i in ids[:_MOST])
    return f"{named} and {len(ids) - _MOST} more" if len(ids) > _MOST else named


def slips(
    subject: str, about: str, value: Value, slip: Slip, taker: str = "the deck"
) -> Iterator[Risk]:
    """A value that nothing has, with what may have been meant; `taker` is what it was given to."""
    if value.amount == 0.0 or slip.low <= value.amount <= slip.high:
        return
    low = value.amount < slip.low
    bound = f"{'below' if low else 'above'} {readable(slip.low if low else slip.high, value.unit)}"
    remedy = "check it and its unit"
    for unit, factor in slip.meant.items():
        if slip.fit[0] <= value.amount * factor <= slip.fit[1]:
            remedy = (
                f"write {written(value.amount * factor)} if {short(value.amount)} {unit} is meant"
            )
            break
    taken = "a ratio" if value.unit == "-" else value.unit
    rule = f"{bound} it is as a rule a slip of units ({taker} takes {taken})"
    yield Risk(subject, about, str(value), rule, remedy)


def wall_slips(subject: str, section: Wall) -> Iterator[Risk]:
    """Slips of units in a section of a tube or line."""
    replaced = section.bending_stiffness_override and section.axial_stiffness_override
    for attribute, name, unit, slip in TUBE_SLIPS:
        if not (replaced and attribute == "youngs_modulus"):
            value = Value(name, getattr(section, attribute), unit)
            yield from slips(subject, attribute, value, slip)
