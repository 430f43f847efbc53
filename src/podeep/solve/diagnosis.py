"""Why a step has no equilibrium, in words: how far it came, what the soil had left, what to do."""

import numpy as np

from ..arrays import Array
from ..soil.spudcan_yield import moment_limit
from .analysis import Solved
from .newton import Ending
from .statics import Failure

_MOBILISED = 0.995  # share of its capacity from which a reaction counts as mobilised
_LITTLE = 0.5  # of the capacity: below it the soil is not the reason


def explain(solved: Solved, failure: Failure, names: tuple[str, ...]) -> str:
    """The failure as the user reads it; `names` are the loads that the factors belong to."""
    foundation, path = solved.model.foundation.name, solved.path
    further: list[str] = []
    if path is not None and path.states:
        peak, last = path.states[path.peak], path.states[-1]
        share = failure.reached + path.added(peak)
        lines = [
            f"{foundation}: {path.which} peak at {share:.3%} of step {failure.step}",
            f"load factors at the peak, step {peak.step} of the database: "
            f"{named(names, peak.factors)}",
        ]
        further = [
            f"beyond the peak followed to step {last.step}, {named(names, last.factors)}: "
            f"{path.end.value}"
        ]
    else:
        lines = [
            f"{foundation}: no {failure.which} equilibrium beyond {failure.reached:.3%} of step "
            f"{failure.step}",
            f"load factors reached: {named(names, failure.factors)}",
            failure.ending.value,
        ]
        further = [] if path is None else [f"it could not be followed beyond: {path.end.value}"]
    return "\n  ".join([*lines, *advice(solved, failure), *further])


def named(names: tuple[str, ...], factors: Array) -> str:
    """Load factors with the names of the loads."""
    return ", ".join(f"{n} {f:.4g}" for n, f in zip(names, factors, strict=True))


def advice(solved: Solved, failure: Failure) -> list[str]:
    """What is mobilised at the last equilibrium that was found, and the likely remedy."""
    if failure.ending is Ending.YIELDED:
        return spudcan_loads(solved, failure)
    system = getattr(solved.model, failure.which).system
    u = system.displacement(getattr(failure, failure.which))
    distance = u[:, 0] if system.components == 1 else np.hypot(u[:, 0], u[:, 1])
    force, _ = system.react(distance)
    along = len(system.points[0].x)
    capacity = system.points[0].reaction.capacity
    known = np.isfinite(capacity) & (capacity > 0.0)
    share = np.divide(np.abs(force[:along]), capacity, out=np.zeros(along), where=known)
    lines = [f"there {mobilised(system.points[0].x, share, failure.which)}"]
    if failure.which == "axial":
        lines.append(axial_capacity(solved, bool(u[-1, 0] < 0.0)))
    if share.max(initial=0.0) < _LITTLE and failure.ending is Ending.EXHAUSTED:
        remedy = "more iterations (*NEWTONSTAT) or smaller steps (*QUASISTATIC)"
    elif failure.which == "axial":
        remedy = "a longer or wider tube, a smaller axial load, or *SUPPORT ... Z"
    else:
        remedy = "a longer or wider tube, a smaller lateral load, or a lateral *SUPPORT"
    return [*lines, f"remedy: {remedy}"]


def spudcan_loads(solved: Solved, failure: Failure) -> list[str]:
    """Loads on the spudcan at the last equilibrium, and what it can carry of each alone."""
    model, kept = solved.model, failure.softening
    under = model.footing
    assert under is not None
    assert under.surface is not None
    V = under.vertical(model.axial.system, failure.axial)
    H, M = under.across(model.lateral.system.softened(kept), failure.lateral)
    surface = under.surface
    return [
        f"there it carries V {V:.4g} N, H {H:.4g} N, M {M:.4g} N m",
        f"of QV {surface.vertical_capacity:.4g} N, QH {surface.horizontal_capacity:.4g} N, "
        f"QM {surface.moment_capacity:.4g} N m; with that V and H, M up to "
        f"{moment_limit(surface, V, H):.4g} N m",
        "remedy: a larger spudcan or preload, or smaller loads",
    ]


def axial_capacity(solved: Solved, tension: bool) -> str:
    """Peak friction over the shaft, and in compression the bearing of the tip."""
    points = solved.model.axial.system.points
    shaft = points[0].weight @ points[0].reaction.capacity
    tip = sum(p.weight @ p.reaction.capacity for p in points if not p.spread)
    if tension:
        return f"capacity in tension: shaft {shaft:.4g} N"
    return f"capacity in compression: shaft {shaft:.4g} N, tip {tip:.4g} N"


def mobilised(x: Array, share: Array, which: str) -> str:
    """The depths over which the soil gives all it has."""
    name = "shaft friction" if which == "axial" else "lateral resistance"
    full = share >= _MOBILISED
    if not full.any():
        return f"no {name} is fully mobilised; the most used point is at {share.max(initial=0):.0%}"
    starts = np.flatnonzero(full & ~np.concatenate([[False], full[:-1]]))
    ends = np.flatnonzero(full & ~np.concatenate([full[1:], [False]]))
    runs = ", ".join(f"{x[a]:.3g} to {x[b]:.3g} m" for a, b in zip(starts, ends, strict=True))
    return f"the {name} is fully mobilised at depths {runs}"
