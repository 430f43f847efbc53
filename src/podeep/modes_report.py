"""Natural frequencies and mode shapes in words, as tables and as data."""

import csv
from collections.abc import Iterator
from io import StringIO
from math import isfinite
from typing import Any

from .report import folded
from .scene import Scene
from .solve.modes import Mode, Modes
from .units import coordinates, short

_WIDTH = 80
_HEADS = ("mode", "kind", "f (Hz)", "period (s)", "taking part (kg)", "share", "error")
_SHAPE_WIDTH = 10  # of the column of a mode

#: columns of the CSV of modes
_COLUMNS = (
    *("mode", "kind", "frequency_Hz", "period_s", "participating_mass_kg"),
    *("participating_share", "modal_mass_kg", "estimated_error"),
)


def modes_report(found: Modes, scene: Scene, *, shapes: bool = False) -> str:
    """Modes as a table of 80 columns, with what has to be known of them."""
    where = "at rest" if found.step == 0 else f"about the state of step {found.step}"
    count = len(found.modes)
    lines = [scene.title] if scene.title else []
    lines += folded(
        f"{found.foundation.name}, {where}: {count} mode{'s' * (count != 1)}, "
        f"{found.elements} elements, accuracy {found.accuracy:g}"
    )
    lines += ["", *_table(found), ""]
    lines += folded(
        f"mass: {short(found.lateral_mass)} kg sideways, {short(found.axial_mass)} kg along"
    )
    for note in found.notes:
        lines += folded(note)
    if shapes:
        for tube in range(len(found.depths)):
            lines += ["", *_shape_table(found, tube)]
    return "\n".join(lines)


def _table(found: Modes) -> Iterator[str]:
    cells = [
        (
            str(number),
            mode.kind,
            f"{mode.frequency:.6g}",
            f"{mode.period:.6g}" if isfinite(mode.period) else "none",
            f"{mode.participating:.6g}",
            f"{100.0 * share(found, mode):.1f} %",
            f"{mode.error:.0e}",
        )
        for number, mode in enumerate(found.modes, start=1)
    ]
    widths = [max(len(row[i]) for row in (_HEADS, *cells)) for i in range(len(_HEADS))]
    for row in (_HEADS, tuple("-" * w for w in widths), *cells):
        aligned = [c.rjust(w) for c, w in zip(row, widths, strict=True)]
        aligned[1] = row[1].ljust(widths[1])
        yield "  ".join(aligned).rstrip()


def share(found: Modes, mode: Mode) -> float:
    """Share of all mass that takes part in a mode."""
    whole = found.axial_mass if mode.kind == "axial" else found.lateral_mass
    return mode.participating / whole


def _shape_table(found: Modes, tube: int) -> Iterator[str]:
    depth = coordinates(found.depths[tube])
    first = max(len("depth (m)"), *map(len, depth))
    each = (_WIDTH - first) // _SHAPE_WIDTH
    yield f"displacement of tube {found.foundation.tubes[tube]}, largest of all tubes 1"
    for start in range(0, len(found.modes), each):
        block = found.modes[start : start + each]
        if start:
            yield ""
        heads = (f"mode {start + i + 1}".rjust(_SHAPE_WIDTH) for i in range(len(block)))
        yield "depth (m)".rjust(first) + "".join(heads)
        for i, x in enumerate(depth):
            values = (f"{m.shape[tube][i]:z.5f}".rjust(_SHAPE_WIDTH) for m in block)
            yield x.rjust(first) + "".join(values)


def modes_csv(found: Modes, *, shapes: bool = False) -> str:
    """Modes, or their shapes, as CSV in SI units with all digits."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    if shapes:
        writer.writerow(("tube", "depth_m", *(f"mode_{i + 1}" for i in range(len(found.modes)))))
        for tube, (name, depths) in enumerate(
            zip(found.foundation.tubes, found.depths, strict=True)
        ):
            for i, x in enumerate(depths.tolist()):
                moved = (repr(float(m.shape[tube][i])) for m in found.modes)
                writer.writerow((name, repr(x), *moved))
        return out.getvalue()
    writer.writerow(_COLUMNS)
    for number, mode in enumerate(found.modes, start=1):
        values = _numbers(found, mode)
        writer.writerow((number, mode.kind, *(repr(value) for value in values)))
    return out.getvalue()


def _numbers(found: Modes, mode: Mode) -> tuple[float, ...]:
    return (
        *(mode.frequency, mode.period, mode.participating),
        *(share(found, mode), mode.mass, mode.error),
    )


def modes_data(found: Modes, *, shapes: bool = False) -> dict[str, Any]:
    """Modes as plain data; the period of a tube that nothing holds is None."""
    rows = []
    for number, mode in enumerate(found.modes, start=1):
        values = [v if isfinite(v) else None for v in _numbers(found, mode)]
        row: dict[str, Any] = dict(zip(_COLUMNS, (number, mode.kind, *values), strict=True))
        if shapes:
            row["shape"] = [shape.tolist() for shape in mode.shape]
        rows.append(row)
    data: dict[str, Any] = {
        "foundation": found.foundation.name,
        "step": found.step,
        "elements": found.elements,
        "accuracy": found.accuracy,
        "lateral_mass_kg": found.lateral_mass,
        "axial_mass_kg": found.axial_mass,
        "modes": rows,
        "notes": list(found.notes),
    }
    if shapes:
        data["tubes"] = list(found.foundation.tubes)
        data["depths_m"] = [depths.tolist() for depths in found.depths]
    return data
