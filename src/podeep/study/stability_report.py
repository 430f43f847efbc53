"""The map of the methods of time integration in words, and as CSV."""

import csv
from collections.abc import Iterator
from io import StringIO
from math import inf

from ..report import folded
from .limits import GAINED, KEPT, OFF, Limit
from .stability import METHODS, Cause, Cell, StabilityMap
from .trials import TRIALS, Trial

_NAME = 11  # width of the names of methods

_WORDS = (
    f".: stable; +: wrong, energy grew more than {GAINED - 1.0:.0%}; -: wrong, less than "
    f"{KEPT:.0%} of the energy was kept; e: wrong, the end is more than {OFF:.0%} away from the "
    "exact one; X: failed, it grew without bound; N: failed, no equilibrium in a stage. Phases are "
    "not judged. up to: the omega h up to which all are stable; closed form: of that, >= where it "
    "is but a bound from below. GAMMA=1: NEWMARK with GAMMA=1, BETA=0.5. Factors, "
    "causes and formulas: --csv."
)

_COLUMNS = ("kind", "trial", "method", "omega h", "verdict", "gain", "kept", "error", "cause")


def stability_report(found: StabilityMap) -> str:
    """For each trial, methods against steps, and where the stable ones end."""
    lines = ["Methods of time integration against the step, omega h", ""]
    lines += folded(_WORDS)
    for trial in TRIALS:
        lines += ["", *folded(f"{trial.name}: {trial.what}; {trial.rate}"), *_table(found, trial)]
    return "\n".join(lines)


def _table(found: StabilityMap, trial: Trial) -> Iterator[str]:
    """A row for each method: its marks, the step up to which all are stable, its closed form."""
    width = 2 * len(found.steps) + 2
    yield f"{'omega h':{_NAME}}{_scale(found.steps):{width}}{'up to':>6}  closed form"
    for method in METHODS:
        marks = " ".join(one.cause.value for one in found.row(trial.name, method))
        one = found.boundary(trial.name, method)
        closed = "" if one.limit is None else _known(one.limit)
        yield f"  {method:{_NAME - 2}}{marks:{width}}{_step(one.step):>6}  {closed}".rstrip()


def _scale(steps: tuple[float, ...]) -> str:
    """Powers of ten above their columns."""
    line = [" "] * (2 * len(steps) + 2)
    for number, step in enumerate(steps):
        if (text := f"{step:g}").strip("0.") == "1":
            line[2 * number : 2 * number + len(text)] = text
    return "".join(line)


def _step(step: float) -> str:
    """Three digits, or nothing of the map, or all of it."""
    return "none" if step == 0.0 else "all" if step == inf else f"{step:.3g}"


def _known(limit: Limit) -> str:
    return f"{'' if limit.exact else '>= '}{limit.step:.3g}"


def stability_csv(found: StabilityMap) -> str:
    """Every cell, boundary and closed form at full precision."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(_COLUMNS)
    for c in found.cells:
        values = (c.outcome.gain, c.outcome.kept, c.outcome.error) if c.outcome else ("", "", "")
        row = ("cell", c.trial, c.method, repr(c.step), c.verdict.value)
        writer.writerow((*row, *values, c.words))
    for b in found.boundaries:
        row = ("boundary", b.trial, b.method, repr(b.step), "")
        writer.writerow((*row, "", "", "", b.words))
        if b.limit:
            kind = "closed form" if b.limit.exact else "closed form, at least"
            same = (kind, b.trial, b.method, repr(b.limit.step), "")
            writer.writerow((*same, "", "", "", b.limit.words))
    return out.getvalue()


def mark(one: Cell) -> str:
    """What stands in a cell of the picture: how wrong it is."""
    if one.outcome is None:
        return "N"
    gain, lost, error = one.outcome.gain, 1.0 - one.outcome.kept, one.outcome.error
    match one.cause:
        case Cause.GAINED:
            return f"×{gain:.1f}" if gain < 99.5 else f"×{gain:.0e}".replace("e+0", "e")
        case Cause.LOST:
            return f"−{lost:.0%}"
        case Cause.OFF:
            return f"±{error:.0%}" if error < 9.995 else f"±{error:.0f}"
        case Cause.UNBOUNDED:
            return "✕"
    return ""
