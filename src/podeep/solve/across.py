"""Equilibria on a finer mesh near the states of a path beyond a peak."""

from collections.abc import Mapping

import numpy as np

from ..arrays import Array, Flags
from ..model.assemble import Model, Problem
from .continuation import Control, Metric, Way
from .loaded import loaded_at
from .newton import Limits, Scale, largest
from .path import Path
from .prolong import prolong
from .statics import Which


def across(
    model: Model, richer: Model, path: Path, states: Mapping[Which, Array], limits: Limits
) -> tuple[Array, Array, Flags]:
    """Equilibria of the problem that failed on a finer mesh, near each state of a path.

    They lie in the plane across the path through the state, where the load may differ: at the same
    load there may be none, or one on another branch. states: those of the path by problem, in the
    elements of the finer mesh. Returns the unknowns, the factors there, shape (states, names), and
    where one was found.
    """
    coarse: Problem = getattr(model, path.which)
    problem: Problem = getattr(richer, path.which)
    fields = coarse.system.field, problem.system.field
    unknowns, factors, known = [], [], []
    for i, (state, (move, change)) in enumerate(zip(path.states, path.ahead, strict=True)):
        q = states[path.which][i]
        line = state.factors, path.growth
        loaded = loaded_at(richer, path.which, line, states["axial"][i], limits)
        scale = Scale(largest(problem.system.internal(q)), largest(q))
        control = Control(Metric.at(q, path.share, scale), limits, scale)
        ahead = Way(prolong(move[None], *fields, problem.system.components)[0], change)
        found = control.corrected(loaded, q, 0.0, ahead)
        known.append(found is not None)
        unknowns.append(q if found is None else found[0].q)
        factors.append(loaded.factors(0.0 if found is None else found[0].factor))
    return np.array(unknowns), np.array(factors), np.array(known)
