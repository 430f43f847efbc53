"""The reaction curves in force at a depth, through the same laws that the solver calls."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from .profile import Profile
from .reaction import Reaction

#: displacements shown where none are asked for, in diameters
_SHOWN = np.array(
    (
        *(0.0, 0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01),
        *(0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3),
    )
)


@dataclass(frozen=True)
class CurveTable:
    """One curve: `name` py (N/m), tz (N/m) or qz (N), at displacements (m), and its laws."""

    name: str
    displacement: Array
    reaction: Array
    source: Reaction


def curves(
    profile: Profile, depth: float, diameter: float, displacement: Array | None = None
) -> tuple[CurveTable, ...]:
    """The p-y and t-z curve of a tube at a depth (m) and the Q-z curve of a tip standing there.

    displacement: shape (n,), m; a standard set by default. A curve without reaction is left out.
    """
    u = _SHOWN * diameter if displacement is None else displacement
    at, width = np.array([depth]), np.array([diameter])
    reactions = {
        "py": profile.lateral(at, width),
        "tz": profile.shaft(at, width),
        "qz": profile.tip(depth, diameter),
    }
    return tuple(
        CurveTable(name, u, reaction.evaluate(u[:, None])[0][:, 0], reaction)
        for name, reaction in reactions.items()
        if reaction.laws
    )
