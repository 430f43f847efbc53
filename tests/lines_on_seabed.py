"""Lines that several tests share, and the tables of the seabed by their rows."""

import csv
from functools import cache
from pathlib import Path

import numpy as np

from podeep.arrays import Array
from podeep.beam.field import Field
from podeep.line.bed import Bed, Form, contact_points
from podeep.line.catenary import shape
from podeep.line.equations import LineSystem, Sections
from podeep.line.statics import LineState, laid
from podeep.seabed.friction import Friction
from podeep.seabed.normal import Winkler
from podeep.soil.memory import Backbone
from podeep.solve.newton import Limits

DATA = Path(__file__).parent / "data" / "seabed"
LIMITS = Limits(residual=1e-10, iterations=200)
SHARP = 1e-9  # tolerance on penetration, m: none, for tables without


@cache
def table(number: str, part: str = "") -> list[dict[str, str]]:
    """Rows of a table, or of a part of it: each part has a header of its own."""
    (path,) = DATA.glob(f"{number}_*.csv")
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    if not part:
        return list(csv.DictReader(lines))
    heads = [i for i, line in enumerate(lines) if line.startswith("part,")]
    head = lines[heads[int(part) - 1]]
    return list(csv.DictReader([head, *(x for x in lines if x.startswith(f"{part},"))]))


def numbers(row: dict[str, str]) -> dict[str, float]:
    """What a row has in numbers, without the units in its names."""
    found = {}
    for name, text in row.items():
        try:
            found[name] = float(text)
        except ValueError:
            continue
    return found


def system_of(
    edges: Array,
    degree: int,
    sections: tuple[float, float, float],
    normal: Backbone | None,
    *,
    held: dict[float, str],
    components: int = 2,
    form: Form = "integrated",
    friction: float = 0.0,
    threshold: float = 1e-4,
    under: Array | None = None,
) -> LineSystem:
    """A line of one section (EA, EI, w) on a seabed.

    held: which of x, y, z are held at distances; capitals hold the direction's component. under:
    whether each point of contact meets soil.
    """
    axial, bending, weight = sections
    n = len(edges) - 1
    field = Field(edges, np.full(n, bending), degree, 1, float(np.mean(np.diff(edges))))
    names = "xz" if components == 2 else "xyz"
    places = [
        (field.node(at) + (dof.isupper())) * components + names.index(dof.lower())
        for at, dofs in held.items()
        for dof in dofs
    ]
    bed = None
    if normal is not None:
        points = contact_points(field, form)
        if under is not None:
            points = points[0], points[1] * under
        rubs = Friction(len(points[0]), friction, threshold=threshold) if friction else None
        bed = Bed(field, components, points, normal, rubs)
    every = (np.full(n, value) for value in (axial, bending, weight))
    return LineSystem(field, components, Sections(*every), np.array(sorted(places), dtype=int), bed)


def hung(system: LineSystem, span: float, height: float) -> Array:
    """Unknowns of a catenary over the seabed, from the origin to an end."""
    field, m = system.field, system.components
    places, tangents, _ = shape(field.edges, span, (0.0, height), system.unstretched_length)
    q = np.zeros((field.size, m))
    for s, place, tangent in zip(field.edges, places, tangents, strict=True):
        node = field.node(float(s))
        q[node, [0, -1]], q[node + 1, [0, -1]] = place, tangent * field.slope_length
    q[0, [0, -1]], q[field.node(system.unstretched_length), [0, -1]] = (0.0, 0.0), (span, height)
    return q.ravel()


def straight(system: LineSystem) -> Array:
    """Unknowns of the line at rest along x, at z = 0."""
    field, m = system.field, system.components
    q = np.zeros((field.size, m))
    for s in field.edges:
        node = field.node(float(s))
        q[node, 0], q[node + 1, 0] = s, field.slope_length
    return q.ravel()


def riser(
    row: dict[str, float], share: float, degree: int = 7, form: Form = "integrated", **more: float
) -> tuple[LineSystem, LineState]:
    """A riser of table 05, laid on elements of a share of sqrt(EI/T).

    more: span, m, in place of the row's; friction and its threshold.
    """
    n = int(np.ceil(row["L_m"] / (share * np.sqrt(row["EI_Nm2"] / 378_500.0))))
    system = system_of(
        np.linspace(0.0, row["L_m"], n + 1),
        degree,
        (row["EA_N"], row["EI_Nm2"], row["w_N_per_m"]),
        Winkler(row["k_Pa"], SHARP),
        held={0.0: "xzZ", row["L_m"]: "xz"},
        form=form,
        friction=more.get("friction", 0.0),
        threshold=more.get("threshold", 1e-4),
    )
    span = more.get("span", row["X_m"])
    start = hung(system, span, row["Z_m"])
    start[1], start[3] = -row["w_N_per_m"] / row["k_Pa"], 0.0  # deep in the laid part
    return system, laid(system, start, LIMITS)
