"""A short pile shaken at its head, every step recorded, and what two databases differ in."""

from pathlib import Path

import h5py
import numpy as np

STEP = 0.01  # s
DECK = """\
*TITLE
A short pile shaken at its head
*DEPTH
-10
*GROUNDEPTH
0 -20
*PYCURVE, SHAPE=POWER
1
1 30e3 8e3 0.5 0.01
*TZCURVE, SHAPE=2GEO
1 0
1 30e3 8e3
*GROUNDPROP
1 1 1 1
*CASING
1 PILE
-9 -30 0.762 0.0254 210e9 7850
*FONDATION
1 1
*LOAD
SWAY 1 -9 90e3 {across} {heave} 0 0 0
*HARMONIC
SWAY 1.3 0 0.5
*DAMPING
0.01 0.1 2.0
*DYNAMIC{method}
0 {end}{step}
*DYNIMP
{dynimp}
*DTREC
{record}
*ACCURACY
{accuracy}
{more}*EXEC
"""
#: soil that remembers, and another load that leads the head round
ROUND = """\
*MODEL HYSTERESIS=MASING
*LOAD
ACROSS 1 -9 0 70e3 0 0 0 0
*HARMONIC
ACROSS 0.9 0 0.5
"""


def deck(
    folder: Path,
    *,
    end: float = 3.0,
    method: str = "",
    heave: float = 0.0,
    across: float = 0.0,
    step: float | None = STEP,
    record: float = STEP,
    accuracy: float = 1e-2,
    adaptive: bool = False,
    more: str = "",
) -> Path:
    """The deck, in a folder. method: of *DYNAMIC, else the program's own. more: keywords."""
    folder.mkdir(exist_ok=True)
    path = folder / "shaken.deck"
    text = DECK.format(
        end=end,
        method=f", METHOD={method}" if method else "",
        heave=heave,
        across=across,
        step="" if step is None else f" {step}",
        record=record,
        dynimp="30 0.5 0.25 1" if adaptive else "30",
        accuracy=accuracy,
        more=more,
    )
    path.write_text(text, encoding="utf-8")
    return path


def differences(one: Path, other: Path) -> list[str]:
    """Names of what is not the same to the last bit, the history apart."""
    with h5py.File(one) as a, h5py.File(other) as b:
        names: list[list[str]] = [["/"], ["/"]]
        a.visit(names[0].append)
        b.visit(names[1].append)
        if names[0] != names[1]:
            return ["the names"]
        found: list[str] = []
        for name in names[0]:
            first, second = a[name], b[name]
            found += [
                f"{name}@{key}"
                for key in (first.attrs.keys() | second.attrs.keys()) - REFERENCES
                if not np.array_equal(first.attrs.get(key), second.attrs.get(key))
            ]
            if isinstance(first, h5py.Dataset):
                same = first.dtype == second.dtype and first.shape == second.shape
                if not same or not np.array_equal(first[()], second[()]):
                    found.append(name)
        return found


REFERENCES = {"history", "DIMENSION_LIST", "REFERENCE_LIST"}  # places in the file, not values
