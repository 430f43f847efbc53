"""What came of a run and which curves were in force, in words."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .arrays import Array
from .describe import parameter
from .soil.curves import CurveTable
from .soil.reaction import Term
from .solve.analysis import Solved
from .units import short


def summary(solved: Solved) -> dict[str, Any]:
    """The result of one foundation as numbers: heads, largest values, errors, work."""
    results, model = solved.results, solved.model
    x = np.sort(np.concatenate([model.edges, model.lateral.system.points[0].x]))
    head = x[:1]
    moment = largest(results.shear_and_moment(x)[1][-1])
    place = int(np.argmax(moment))
    last = [(e.displacement[-1], e.reaction[-1], e.moment[-1]) for e in solved.estimates]
    displacements, reactions, moments = np.array(last).T.tolist()
    return {
        "foundation": model.foundation.name,
        "decisions": [str(d) for d in model.needs.decisions],
        "elements": model.elements,
        "degree": model.lateral.system.field.degree,
        "steps": solved.states[-1].step,
        "iterations": sum(s.iterations for s in solved.states),
        "head_lateral_displacement_m": float(largest(results.deflection(head)[-1])[0]),
        "head_axial_displacement_m": float(results.settlement(head)[-1, 0]),
        "largest_moment_Nm": float(moment[place]),
        "largest_moment_depth_m": float(x[place]),
        "estimated_error_displacement": max(displacements),
        "estimated_error_reaction": max(reactions),
        "estimated_error_moment": max(moments),
        "largest_estimated_error": solved.error,
    }


def largest(components: Array) -> Array:
    """Magnitude of a lateral vector given by component, shape (components, n)."""
    return np.asarray(np.linalg.norm(components, axis=0))


def run_report(numbers: dict[str, Any]) -> str:
    """The summary of a foundation in words."""
    n = numbers
    return "\n".join(
        [
            f"{n['foundation']}  {'; '.join(n['decisions'])}",
            f"    {n['elements']} elements of degree {n['degree']}, {n['steps']} steps, "
            f"{n['iterations']} iterations",
            f"    last step: head displaced {short(n['head_lateral_displacement_m'])} m, "
            f"settled {short(n['head_axial_displacement_m'])} m",
            f"    largest moment {short(n['largest_moment_Nm'])} N m at "
            f"{n['largest_moment_depth_m']:.2f} m below the mudline",
            f"    estimated errors: displacement {n['estimated_error_displacement']:.1e}, "
            f"reaction {n['estimated_error_reaction']:.1e}, "
            f"moment {n['estimated_error_moment']:.1e}",
            f"    largest in any step {n['largest_estimated_error']:.1e}",
        ]
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
        unit = "N" if table.name == "qz" else "N/m"
        lines += ["", f"{table.name}: capacity {short(float(table.source.capacity[0]))} {unit}"]
        lines += [f"  {line}" for term in table.source.laws for line in term_lines(term)]
        lines.append(f"{'displacement (m)':>18} {f'reaction ({unit})':>18}")
        for u, force in zip(table.displacement, table.reaction, strict=True):
            lines.append(f"{u:>18.6g} {force:>18.6g}")
    if not tables:
        lines.append("no reaction at this depth")
    return "\n".join(lines)


def term_lines(term: Term) -> Iterator[str]:
    """A law in force at one point: its name, the curves it comes from, its parameters."""
    ids = " and ".join(str(i) for i in term.curves)
    share = "" if term.weight is None else f", share {float(term.weight[0]):.4g}"
    yield f"{term.name.replace('_', ' ')} of curve {ids}{share}"
    for name, value in term.parameters.items():
        if value is not None and name != "points":
            yield f"  {parameter(name, value)}"
