"""A step of a tube on a spudcan whose rotational spring softens as its loads near the surface.

ISO 19905-1 asks for a share kappa of the elastic stiffness such that kappa = fr(rf(V, H, M)), the
loads being those that are found with kappa; where rf would pass 1, kappa keeps them on the
surface. kappa less what its loads ask for changes sign once between 0 and 1: it is bracketed.
"""

from dataclasses import dataclass, field, replace

from scipy.optimize import brentq

from ..arrays import Array
from ..model.footing import Footing
from ..soil.spudcan_yield import YieldSurface, target_factor
from .advance import Advance, Track
from .newton import Ending, Work

_EXACT = 1e-12  # of kappa
_LEAST = 1e-6  # share of the stiffness that is always left: no tube is free to turn
_OUTSIDE = 1e-6  # excess of rf over 1 from which loads lie outside the surface


@dataclass
class _Trials:
    """One step with one share of stiffness after another, each from the same start."""

    track: Track
    footing: Footing
    surface: YieldSurface
    vertical: float
    factors: tuple[Array, Array]
    work: Work = field(default_factory=Work)
    last: tuple[Track, Advance] | None = None
    failure_ratio: float = 0.0

    def imbalance(self, kappa: float) -> float:
        """kappa less what its loads ask for; what was found is kept in `last`."""
        problem = replace(self.track.problem, system=self.track.problem.system.softened(kappa))
        trial = replace(self.track, problem=problem)
        made = trial.advance(*self.factors)
        self.work.iterations += made.work.iterations
        self.work.evaluations += made.work.evaluations
        self.last = trial, made
        if made.outcome.ending is not Ending.CONVERGED:
            raise _NoEquilibrium
        loads = self.footing.across(problem.system, trial.q)
        if not any((self.vertical, *loads)):  # at rest: nothing to be outside of
            self.failure_ratio = 0.0
            return kappa - 1.0
        self.failure_ratio = float(self.surface.utilisation(self.vertical, *loads))
        return kappa - target_factor(self.surface, self.vertical, *loads)


class _NoEquilibrium(Exception):
    """A trial found none."""


def advance_yielding(
    track: Track, footing: Footing, vertical: float, before: Array, after: Array
) -> Advance:
    """Take a track from factors `before` to `after`, and find the softening of its springs.

    vertical: load on the spudcan, N. A spudcan without preload stays elastic.
    """
    if footing.surface is None:
        return track.advance(before, after)
    trials = _Trials(track, footing, footing.surface, vertical, (before, after))
    try:
        if trials.imbalance(1.0) > 0.0:
            if trials.imbalance(_LEAST) < 0.0:
                trials.imbalance(float(brentq(trials.imbalance, _LEAST, 1.0, xtol=_EXACT)))
            outside = trials.failure_ratio > 1.0 + _OUTSIDE
        else:
            outside = False
    except _NoEquilibrium:
        outside = False
    assert trials.last is not None
    trial, made = trials.last
    if outside:
        yielded = replace(made.outcome, ending=Ending.YIELDED)
        return Advance(yielded, 0.0, made.smallest, trials.work)
    if made.outcome.ending is Ending.CONVERGED:
        track.take(trial)
    return Advance(made.outcome, made.reached, made.smallest, trials.work)
