"""What a run tells of a line, as plain data and in words."""

from typing import Any

import numpy as np

from .line.analysis import SolvedLine

_PLACES = 4000  # distances at which largest values are looked for


def line_summary(solved: SolvedLine) -> dict[str, Any]:
    """A solved line as plain data, SI; largest values of each state that was reached."""
    line, results = solved.line, solved.results
    s = np.linspace(0.0, line.length, _PLACES + 1)
    tension = results.tension(s)
    position, reaction, pulled, bent = solved.errors
    return {
        "line": f"L{line.id}",
        "name": line.name,
        "elements": solved.model.elements,
        "components": solved.model.plane.components,
        "steps": len(solved.states) - 1,
        "touchdown_distance": results.touchdown().tolist(),
        "least_tension": tension.min(axis=1).tolist(),
        "largest_tension": tension.max(axis=1).tolist(),
        "largest_moment": np.abs(results.moment(s)).max(axis=1).tolist(),
        "deepest_penetration": results.penetration(s).max(axis=1).tolist(),
        "estimated_errors": {
            "position": float(position),
            "reaction": float(reaction),
            "tension": float(pulled),
            "moment": float(bent),
        },
        "accuracy": solved.accuracy,
        "failure": solved.failure or None,
    }


def line_report(told: dict[str, Any]) -> str:
    """The same in words: as it was laid, and after the last step."""
    name = f"{told['line']} {told['name']}".rstrip()
    kind = "in a vertical plane" if told["components"] == 2 else "in space"
    last = told["steps"]
    count = f"{last} step" if last == 1 else f"{last} steps"
    lines = [f"{name}: {told['elements']} elements, {kind}, {count}"]
    for step, when in ((0, "laid"), (last, f"step {last}"))[: 2 if last else 1]:
        lines.append(
            f"    {when}: touchdown at {told['touchdown_distance'][step]:.5g} m, "
            f"tension {told['least_tension'][step] / 1e3:.4g} to "
            f"{told['largest_tension'][step] / 1e3:.5g} kN,"
        )
        words = f"        largest moment {told['largest_moment'][step] / 1e3:.4g} kN m"
        deep = told["deepest_penetration"][step]
        lines.append(f"{words}, {1e3 * deep:.4g} mm deep" if np.isfinite(deep) else words)
    errors = told["estimated_errors"]
    lines.append(
        "    estimated errors: "
        + ", ".join(f"{kind} {value:.1e}" for kind, value in errors.items())
    )
    return "\n".join(lines)
