"""What came of a run and which curves were in force, in words."""

from collections.abc import Iterator, Sequence
from math import isfinite
from textwrap import wrap
from typing import Any

import numpy as np

from .arrays import Array
from .model.effects import left_out
from .soil.curves import CurveTable
from .soil.reaction import Term
from .solve.analysis import Solved
from .units import DERIVED_UNITS, parameter, short

_WIDTH = 80


def summary(solved: Solved) -> dict[str, Any]:
    """The result of one foundation as numbers: heads, largest values, errors, work."""
    results, model = solved.results, solved.model
    x = np.sort(np.concatenate([model.edges, model.lateral.system.points[0].x]))
    head = x[:1]
    bent = [
        (float(m[i := int(np.argmax(m))]), float(at[i]), igr)
        for tube, igr in enumerate(model.foundation.tubes)
        for at in [results.along(tube, x)]
        for m in [largest(results.shear_and_moment(at, tube)[1][-1])]
    ]
    moment, place, igr = max(bent)
    last = [(e.displacement[-1], e.reaction[-1], e.moment[-1]) for e in solved.estimates]
    displacements, reactions, moments = np.array(last).T.tolist()
    return {
        "foundation": model.foundation.name,
        "decisions": [
            str(d) for d in (*model.needs.decisions, *left_out(results, solved.accuracy))
        ],
        "elements": model.elements,
        "degree": model.lateral.system.field.degree,
        "steps": solved.states[-1].step,
        "iterations": sum(s.iterations for s in solved.states),
        "head_lateral_displacement_m": float(largest(results.deflection(head)[-1])[0]),
        "head_axial_displacement_m": float(results.settlement(head)[-1, 0]),
        "largest_moment_Nm": moment,
        "largest_moment_depth_m": place,
        "largest_moment_tube": igr,
        "tubes": len(model.foundation.tubes),
        "estimated_error_displacement": max(displacements),
        "estimated_error_reaction": max(reactions),
        "estimated_error_moment": max(moments),
        "largest_estimated_error": solved.error,
        "spudcan": spudcan(solved),
        "contacts": contacts(solved),
        "path": beyond_peak(solved),
    }


def beyond_peak(solved: Solved) -> dict[str, Any] | None:
    """The peak of a path that was followed, the state there, and how the path ended."""
    path = solved.path
    if path is None or not path.states:
        return None
    peak, last = path.states[path.peak], path.states[-1]
    place = solved.steps + path.peak
    head = solved.model.edges[:1]
    return {
        "problem": path.which,
        "peak_step": peak.step,
        "peak_factors": peak.factors.tolist(),
        "peak_head_lateral_displacement_m": float(
            largest(solved.results.deflection(head)[place])[0]
        ),
        "peak_head_axial_displacement_m": float(solved.results.settlement(head)[place, 0]),
        "last_step": last.step,
        "last_factors": last.factors.tolist(),
        "end": path.end.value,
    }


def contacts(solved: Solved) -> list[dict[str, Any]]:
    """Where tubes press against each other in the last step: their ids, depths, largest force.

    first, last: depths of the topmost and the lowest contact, None where there is none.
    """
    model, found = solved.model, []
    pairs = zip(model.lateral.system.points, solved.results.point_forces, strict=True)
    pressing: dict[tuple[int, int], list[tuple[Array, Array]]] = {}
    for points, forces in pairs:
        if points.against is not None and isinstance(points.tube, int):
            pair = model.foundation.tubes[points.against], model.foundation.tubes[points.tube]
            pressing.setdefault(pair, []).append((points.x, largest(forces[-1])))
    for (outer, inner), parts in pressing.items():
        x, force = (np.concatenate(each) for each in zip(*parts, strict=True))
        closed = x[force > 0.0]
        found.append(
            {
                "outer": outer,
                "inner": inner,
                "first_m": float(closed.min()) if closed.size else None,
                "last_m": float(closed.max()) if closed.size else None,
                "largest_N_per_m": float(force.max()),
            }
        )
    return found


def spudcan(solved: Solved) -> dict[str, float | None] | None:
    """Loads on the spudcan in the last step and how near they are to its yield surface.

    failure_ratio: rf, None without a preload. softening: share of its rotational stiffness left.
    """
    under, state = solved.model.footing, solved.states[-1]
    if under is None:
        return None
    V = under.vertical(solved.model.axial.system, state.axial)
    H, M = under.across(solved.model.lateral.system.softened(state.softening), state.lateral)
    ratio = None if under.surface is None else float(under.surface.utilisation(V, H, M))
    if ratio is not None and not isfinite(ratio):
        ratio = None  # no vertical load: there is nothing to compare with
    return {
        "vertical_N": V,
        "horizontal_N": H,
        "moment_Nm": M,
        "failure_ratio": ratio,
        "softening": state.softening,
    }


def largest(components: Array) -> Array:
    """Magnitude of a lateral vector given by component, shape (components, n)."""
    return np.asarray(np.linalg.norm(components, axis=0))


def run_report(numbers: dict[str, Any]) -> str:
    """The summary of a foundation in words."""
    n = numbers
    under = n["spudcan"]
    which = f" in tube {n['largest_moment_tube']}" if n["tubes"] > 1 else ""
    carried = []
    if under is not None:
        carried = [
            f"    spudcan: V {short(under['vertical_N'])} N, H {short(under['horizontal_N'])} N, "
            f"M {short(under['moment_Nm'])} N m"
        ]
    if under is not None and under["failure_ratio"] is not None:
        carried[0] += (
            f", rf {under['failure_ratio']:.3f}, "
            f"{under['softening']:.1%} of the rotational stiffness left"
        )
    return "\n".join(
        [
            *folded(f"{n['foundation']}  {'; '.join(n['decisions'])}"),
            f"    {n['elements']} elements of degree {n['degree']}, {n['steps']} steps, "
            f"{n['iterations']} iterations",
            *(line for text in _path_lines(n["path"]) for line in folded(text)),
            f"    last step: head displaced {short(n['head_lateral_displacement_m'])} m, "
            f"settled {short(n['head_axial_displacement_m'])} m",
            f"    largest moment {short(n['largest_moment_Nm'])} N m{which} at "
            f"{n['largest_moment_depth_m']:.2f} m below the mudline",
            f"    estimated errors: displacement {n['estimated_error_displacement']:.1e}, "
            f"reaction {n['estimated_error_reaction']:.1e}, "
            f"moment {n['estimated_error_moment']:.1e}",
            f"    largest in any step {n['largest_estimated_error']:.1e}",
            *(line for text in (*carried, *touching(n["contacts"])) for line in folded(text)),
        ]
    )


def touching(contacts: Sequence[dict[str, Any]]) -> Iterator[str]:
    """A line for each two tubes that may touch."""
    for one in contacts:
        where = "do not touch"
        if one["first_m"] is not None:
            where = (
                f"touch between {one['first_m']:.2f} and {one['last_m']:.2f} m below the mudline, "
                f"up to {short(one['largest_N_per_m'])} N/m"
            )
        yield f"    tubes {one['outer']} and {one['inner']} {where}"


def _path_lines(path: dict[str, Any] | None) -> Iterator[str]:
    """The peak and what came beyond it."""
    if path is None:
        return
    factors = [", ".join(f"{f:.4g}" for f in path[f"{n}_factors"]) for n in ("peak", "last")]
    yield (
        f"    {path['problem']} peak in step {path['peak_step']}: load factors {factors[0]}, head "
        f"displaced {short(path['peak_head_lateral_displacement_m'])} m, settled "
        f"{short(path['peak_head_axial_displacement_m'])} m"
    )
    yield (
        f"    followed beyond it to step {path['last_step']}, load factors {factors[1]}: "
        f"{path['end']}"
    )


def step_table(solved: Solved) -> str:
    """A line for each step: factors, work and what was reached."""
    lines = [
        f"    {'step':>5} {'iterations':>10} {'residual':>9} {'smallest part':>13} {'error':>8}"
    ]
    worst = np.maximum(*(e.worst for e in solved.estimates))
    for state, error in zip(solved.states, worst, strict=True):
        lines.append(
            f"    {state.step:>5} {state.iterations:>10} {state.residual:>9.1e} "
            f"{state.step_size:>13.4g} {error:>8.1e}"
        )
    return "\n".join(lines)


def curves_report(tables: Sequence[CurveTable], depth: float) -> str:
    """Curves at a depth as a table, each with its laws and the parameters in force."""
    lines = [f"depth {short(depth)} m below the mudline"]
    for table in tables:
        kind = table.kind
        at_most = f"capacity {short(table.capacity)} {kind.unit}"
        lines += ["", *folded(f"{table.name}, {kind.title}: {at_most}")]
        for term in table.source.laws:
            lines += term_lines(term, table)
        heads = (f"{kind.displacement} ({kind.displacement_unit})", f"reaction ({kind.unit})")
        lines.append("".join(f"  {head:>26}" for head in heads))
        for pair in zip(table.displacement, table.reaction, strict=True):
            lines.append("".join(f"  {value + 0.0:>26.6g}" for value in pair))
    if not tables:
        lines.append("no reaction at this depth")
    return "\n".join(lines)


def term_lines(term: Term, table: CurveTable) -> Iterator[str]:
    """A law in force at one point: its name, its curves, its source, parameters and the rest."""
    ids = " and ".join(str(i) for i in term.curves)
    share = "" if term.weight is None else f", share {float(term.weight[0]):.4g}"
    yield from folded(f"  {term.name.replace('_', ' ')} of curve {ids}{share}")
    yield from folded(f"    source: {term.law.source}")
    follows = term.law.follows_lateral
    if follows:
        yield from folded(
            "    its moment comes for each unit of |p|, the lateral resistance at that instant; "
            f"shown for |p| at the capacity of py, {short(table.lateral)} N/m"
        )
    given = [
        f"{len(value)} points" if name == "points" else parameter(name, value)
        for name, value in term.parameters.items()
        if value is not None
    ]
    yield from _listed("    with ", given)
    own = {"ultimate_reaction": "m" if follows else table.kind.unit}
    units = {**DERIVED_UNITS, **own}
    derived = [parameter(n, v, units.get(n, "")) for n, v in term.law.derived.items()]
    yield from _listed("    derived ", derived)


def folded(text: str) -> list[str]:
    """A text as lines, with its own indent and two more where it goes on."""
    indent = " " * (len(text) - len(text.lstrip()) + 2)
    return wrap(text, _WIDTH, subsequent_indent=indent, break_long_words=True)


def _listed(start: str, items: Sequence[str]) -> list[str]:
    """Items after a start, as lines that break between items alone."""
    whole = ", ".join(item.replace(" ", "\0") for item in items)
    return [line.replace("\0", " ") for line in folded(start + whole)] if items else []
