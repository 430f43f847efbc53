"""Why a step has no equilibrium, in words: how far it came, what the soil had left, what to do."""

import numpy as np

from ..arrays import Array
from .analysis import Solved
from .newton import Ending
from .statics import Failure

_MOBILISED = 0.995  # share of its capacity from which a reaction counts as mobilised


def explain(solved: Solved, failure: Failure, names: tuple[str, ...]) -> str:
    """The failure as the user reads it; `names` are the loads that the factors belong to."""
    foundation = solved.model.foundation.name
    part = failure.step - 1 + failure.reached
    factors = ", ".join(f"{n} {f:.4g}" for n, f in zip(names, failure.factors, strict=True))
    which = "axial" if failure.axial else "lateral"
    head = (
        f"{foundation}: step {failure.step} has no {which} equilibrium beyond {part:.4g} steps "
        f"(load factors {factors}): {failure.ending.value}"
    )
    return "\n".join([head, *(f"  {line}" for line in advice(solved, failure))])


def advice(solved: Solved, failure: Failure) -> list[str]:
    """What is mobilised at the last step that was found, and the likely remedy."""
    problem = solved.model.axial if failure.axial else solved.model.lateral
    system, state = problem.system, solved.states[-1]
    q = state.axial if failure.axial else state.lateral
    u = system.displacement(q)
    distance = u[:, 0] if system.components == 1 else np.hypot(u[:, 0], u[:, 1])
    force, _ = system.react(distance)
    along = len(system.points[0].x)
    capacity = system.points[0].reaction.capacity
    share = np.divide(
        np.abs(force[:along]), capacity, out=np.zeros(along), where=np.isfinite(capacity)
    )
    share[capacity == 0.0] = 0.0
    lines = [f"at step {state.step} {mobilised(system.points[0].x, share, failure.axial)}"]
    if failure.axial:
        shaft = float(system.weight[:along] @ capacity)
        tip = float(system.points[1].reaction.capacity[0])
        lines.append(f"capacity in compression: shaft {shaft:.4g} N, tip {tip:.4g} N")
        lines.append("remedy: a longer or wider tube, a smaller axial load, or *SUPPORT ... Z")
    elif failure.ending is Ending.MECHANISM and not share.any():
        lines.append("remedy: give the tube p-y curves (*GROUNDPROP) or a lateral *SUPPORT")
    else:
        lines.append("remedy: a longer or wider tube, or a smaller lateral load")
    return lines


def mobilised(x: Array, share: Array, axial: bool) -> str:
    """The depths over which the soil gives all it has."""
    name = "shaft friction" if axial else "lateral resistance"
    full = share >= _MOBILISED
    if not full.any():
        return f"no {name} is fully mobilised; the most used point is at {share.max():.0%}"
    starts = np.flatnonzero(full & ~np.concatenate([[False], full[:-1]]))
    ends = np.flatnonzero(full & ~np.concatenate([full[1:], [False]]))
    runs = ", ".join(f"{x[a]:.3g} to {x[b]:.3g} m" for a, b in zip(starts, ends, strict=True))
    return f"the {name} is fully mobilised at depths {runs}"
