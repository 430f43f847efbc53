"""What a foundation can bear, as a table over depth and in words."""

import csv
from collections.abc import Iterable, Iterator
from io import StringIO
from math import isfinite

import numpy as np

from .arrays import Array
from .capacity import Capacity, Check
from .report import folded
from .soil.axial_capacity import PileCapacity
from .units import coordinates, short

_KILO = 1e-3
_WIDEST = 1e7  # number that still has room in the table of capacity
_APART = 1e-9  # depths on both sides of a jump are closer, m
_WAYS = {True: "plugged", False: "unplugged"}

#: columns of the CSV of capacity with their units: fields of PileCapacity
_COLUMNS = {
    "depth": "m",
    "unit_friction": "Pa",
    "outer_friction": "N",
    "inner_friction": "N",
    "unit_bearing": "Pa",
    **dict.fromkeys(("wall_bearing", "plug_bearing", "pile_weight", "plug_weight"), "N"),
    **dict.fromkeys(("compression_plugged", "compression_unplugged", "compression"), "N"),
    **dict.fromkeys(("tension_plugged", "tension_unplugged", "tension"), "N"),
}


def capacity_report(found: Capacity) -> str:
    """The capacity of a foundation as a table over depth, and in words."""
    tube, load, title = found.pile.tube, found.demand, found.pile.scene.title
    name = f"{found.pile.foundation.name}, tube {tube.id} {tube.name}".rstrip()
    lines = [title] if title else []
    lines += folded(f"{name}: {short(found.pile.length)} m embedded")
    steps = (load.compression_step, load.tension_step, load.lateral_step)
    pressed, pulled, sideways = (f" (step {s})" if s else "" for s in steps)
    lines += folded(
        f"largest loads at the mudline: compression {_kilo(load.compression)} kN{pressed}, "
        f"tension {_kilo(load.tension)} kN{pulled}, lateral {_kilo(load.lateral)} kN with a moment "
        f"of {_kilo(load.moment)} kN m{sideways}"
    )
    lines += ["", *_axial_lines(found), "", *_lateral_lines(found)]
    return "\n".join(lines)


def _axial_lines(found: Capacity) -> Iterator[str]:
    if found.axial is None:
        yield "axial: no t-z curve reacts, there is no axial capacity to compute"
        return
    yield "axial capacity with the tip at each depth"
    yield from _table(found.axial.table, found.pile.length)
    way = {"AUTO": "the lesser way", "PLUGGED": "as chosen", "UNPLUGGED": "as chosen"}
    plug = found.axial.table.plug
    text = (
        "f unit friction, q unit end bearing, Qo and Qi friction outside and inside from the "
        f"mudline to the tip; * governs (PLUG={plug}: {way[plug]}); > the tip as it stands."
    )
    if (np.diff(found.axial.table.depth) < _APART).any():
        text += " A depth twice: just above and just below a jump."
    yield from folded(text)
    known = found.pile.scene.ground.depths[-1]
    if 0.0 < known < found.axial.table.depth[-1]:
        yield from folded(
            f"The soil is given down to {short(known)} m; below that its last curve goes on."
        )
    yield ""
    yield f"with the tip where it stands, at {short(found.pile.length)} m"
    yield from _check_lines("compression", found.axial.compression)
    yield from _check_lines("tension", found.axial.tension)
    yield from folded(f"  {_required(found)}")


def _check_lines(name: str, check: Check) -> Iterator[str]:
    text = f"  {name}: {_kilo(check.capacity)} kN, {_WAYS[check.plugged]} governs"
    if not check.load:
        yield f"{text}; no step has such a load"
        return
    text += f"; load {_kilo(check.load)} kN"
    if name == "compression":
        parts = "pile and plug" if check.plug_weight else "the pile"
        text += f" and {_kilo(check.pile_weight + check.plug_weight)} kN of {parts} in water"
    text += f": factor {check.factor:.4g}"
    if check.factor_plugged != check.plugged:
        text += f", that of the {_WAYS[check.factor_plugged]} way, with its own weight to carry"
    yield from folded(text)


def _required(found: Capacity) -> str:
    """The length that the loads require, in words."""
    assert found.axial is not None
    required = found.axial.required
    if required is None:
        return "required length: no step has an axial load"
    decides = found.axial.decided_by
    aim = f"required length for a safety factor of {short(found.safety)}"
    first, last = (short(z) for z in required.scanned)
    at = required.capacity
    if required.length is None:
        return (
            f"{aim}: not reached from {first} to {last} m ({decides} lacks most); at "
            f"{last} m the capacity is {_kilo(at.compression[0])} kN in compression and "
            f"{_kilo(at.tension[0])} kN in tension"
        )
    text = f"{aim}: {short(required.length)} m embedded, {decides} decides"
    for top, bottom in required.failing_again:
        end = f"to {short(bottom)} m" if bottom < required.scanned[1] else f"down to {last} m"
        text += f"; it fails again from {short(top)} {end}"
    return text if required.length <= found.pile.length else f"{text}; more than the pile has"


def _lateral_lines(found: Capacity) -> Iterator[str]:
    if found.lateral is None:
        yield "lateral: no p-y curve reacts, there is no lateral capacity to compute"
        return
    yield "lateral capacity of a rigid pile"
    ultimate, load = found.lateral, found.demand
    if not isfinite(ultimate.lateral_load):
        yield "  the p-y curves have no bound, hence the pile no ultimate load"
        return
    driven = load.lateral or load.moment
    where = f"in the ratio of step {load.lateral_step}" if driven else "no lateral load in any step"
    motion = (
        "shifting without turning"
        if ultimate.pivot is None
        else f"turning about {short(ultimate.pivot)} m"
    )
    force = f"{_kilo(ultimate.lateral_load)} kN with "
    if driven and not load.lateral:
        force = ""  # a moment alone
    text = f"  free head: {force}{_kilo(ultimate.moment)} kN m at the mudline ({where}), {motion}"
    yield from folded(f"{text}: factor {found.lateral_factor:.4g}" if driven else text)
    text = f"  head that cannot turn: {_kilo(ultimate.translation)} kN, shifting"
    if load.lateral:
        text += f": factor {ultimate.translation / load.lateral:.4g}"
    yield from folded(text)
    yield from folded(
        "  Plastic hinges of the pile are not looked at: they may fail it at a smaller load."
    )


def _table(at: PileCapacity, tip: float) -> Iterator[str]:
    """The table over depth, no wider than a line."""
    ways = (
        *(at.compression_plugged, at.compression_unplugged),
        *(at.tension_plugged, at.tension_unplugged),
    )
    forces = [_kilos(v) for v in (at.outer_friction, at.inner_friction, *ways)]
    pressures = [_kilos(v) for v in (at.unit_friction, at.unit_bearing)]
    pressed, pulled = at.plugged_in_compression, at.plugged_in_tension
    for cells, governs in zip(forces[2:], (pressed, ~pressed, pulled, ~pulled), strict=True):
        cells[:] = [f"{c}{'*' if g else ' '}" for c, g in zip(cells, governs, strict=True)]
    columns = [
        ("depth", "m", coordinates(at.depth)),
        ("f", "kPa", pressures[0]),
        *((name, "kN", cells) for name, cells in zip(("Qo", "Qi"), forces, strict=False)),
        ("q", "kPa", pressures[1]),
        *((f"{'un' * (i % 2)}plugged", "kN ", cells) for i, cells in enumerate(forces[2:])),
    ]
    widths = [max(len(name), *map(len, cells)) for name, _, cells in columns]

    def line(mark: str, texts: Iterable[str]) -> str:
        aligned = (f"{text:>{width}}" for text, width in zip(texts, widths, strict=True))
        return (mark + " ".join(aligned)).rstrip()

    left, middle = sum(widths[:5]) + 6, sum(widths[5:7]) + 1
    yield f"{'':{left}}{'compression':^{middle}} {'tension':^{sum(widths[7:]) + 1}}".rstrip()
    yield line(" ", (name for name, _, _ in columns))
    yield line(" ", (unit for _, unit, _ in columns))
    for depth, texts in zip(at.depth, zip(*(c for _, _, c in columns), strict=True), strict=True):
        yield line(">" if depth == tip else " ", texts)


def _kilos(values: Array) -> list[str]:
    """A column in kN or kPa: six digits of the largest, two decimals at most."""
    shown = _KILO * values
    largest = float(np.abs(shown).max())
    decimals = int(np.clip(6 - len(f"{largest:.0f}"), 0, 2))
    form = f"z.{decimals}f" if largest < _WIDEST else "z.1e"
    return [format(value, form) for value in shown.tolist()]


def _kilo(newtons: float) -> str:
    return short(_KILO * newtons)


def capacity_csv(found: Capacity) -> str:
    """The capacity as CSV in SI at full precision: `#` lines, column names, then the table."""
    out = StringIO()
    for name, value in _facts(found):
        out.write(f"# {name}: {value if isinstance(value, str) else repr(float(value))}\n")
    writer = csv.writer(out, lineterminator="\n")
    names = [f"{name} [{unit}]" for name, unit in _COLUMNS.items()]
    writer.writerow([*names, "compression_governed_by", "tension_governed_by"])
    if found.axial is not None:
        at = found.axial.table
        numbers = (map(repr, getattr(at, name).tolist()) for name in _COLUMNS)
        ways = (at.plugged_in_compression, at.plugged_in_tension)
        words = ([_WAYS[p] for p in plugged.tolist()] for plugged in ways)
        writer.writerows(zip(*numbers, *words, strict=True))
    return out.getvalue()


def _facts(found: Capacity) -> Iterator[tuple[str, str | float]]:
    """What is not of one depth, as pairs of a name with its unit and a number or a text."""
    load, axial, lateral = found.demand, found.axial, found.lateral
    if found.pile.scene.title:
        yield "Title", found.pile.scene.title
    yield "Foundation", found.pile.foundation.name
    yield "Embedded length [m]", found.pile.length
    yield "Compression load [N]", load.compression
    yield "Tension load [N]", load.tension
    yield "Lateral load [N]", load.lateral
    yield "Moment of the lateral load [N m]", load.moment
    yield "Safety factor", found.safety
    if axial is not None:
        yield "Plug", axial.table.plug
        for name, check in (("Compression", axial.compression), ("Tension", axial.tension)):
            yield f"{name} capacity at the tip [N]", check.capacity
            yield f"{name} factor", check.factor if check.load else "no load"
        if (required := axial.required) is not None:
            first, last = required.scanned
            length = required.length
            yield "Required length [m]", "not reached" if length is None else length
            yield "Length decided by", axial.decided_by
            yield "Lengths scanned [m]", f"{first!r} to {last!r}"
            for top, bottom in required.failing_again:
                yield "Failing again [m]", f"{top!r} to {bottom!r}"
    if lateral is not None:
        yield "Lateral capacity, free head [N]", lateral.lateral_load
        yield "Its moment [N m]", lateral.moment
        yield "Its pivot [m]", "none" if lateral.pivot is None else lateral.pivot
        yield "Lateral capacity, head that cannot turn [N]", lateral.translation
        yield "Lateral factor, free head", found.lateral_factor
