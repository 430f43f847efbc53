"""How far a solution is from the converged one, and how far it says it is."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from podeep.arrays import Array
from podeep.record import progress_values
from podeep.scene import Scene
from podeep.solve.analysis import Solved, limits, rebuilt, run, solve
from podeep.study.measure import Probe, asking, errors, factors_of

QUANTITIES = ("displacement", "reaction", "moment")
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5)
FLOOR = 1e-9  # errors below it are as good as none
_REFERENCE = 1e-8  # accuracy of the mesh that the converged solution starts from
_RESIDUAL, _ITERATIONS = 1e-11, 300
_PARTS = 2  # of each of its elements
_DEGREE, _SHEAR_DEGREE = 7, 5  # high powers of a shear's softness are rounding


@dataclass(frozen=True)
class Converged:
    """A solution on a much finer mesh of a higher degree, and what that changed."""

    solved: Solved
    probe: Probe
    values: Array
    change: float


@dataclass(frozen=True)
class Measured:
    """One accuracy: true errors and estimates of the three quantities, largest of all steps."""

    asked: float
    elements: int
    true: Array
    estimate: Array

    @property
    def excess(self) -> float:
        """Largest true error over the accuracy asked."""
        return float(self.true.max()) / self.asked

    @property
    def ratios(self) -> Array:
        """Estimates over true errors, both at least the floor."""
        return np.asarray(np.maximum(self.estimate, FLOOR) / np.maximum(self.true, FLOOR))


def converged(scene: Scene) -> Converged:
    """The first foundation of a scene on the mesh of a small accuracy, halved, of degree 7."""
    fine = asking(scene, _REFERENCE)
    own = solve(fine, scene.foundations[0])
    assert own.failure is None, own.failure
    degree = _SHEAR_DEGREE if own.model.needs.shear else _DEGREE
    edges = own.model.edges
    share = np.arange(_PARTS) / _PARTS
    finer = (edges[:-1, None] + np.diff(edges)[:, None] * share).ravel()
    more = degree - own.model.lateral.system.field.degree
    model = rebuilt(fine, own.model, np.append(finer, edges[-1]), more)
    limit = replace(limits(fine), residual=_RESIDUAL, iterations=_ITERATIONS)
    states, failure, _ = run(model, factors_of(scene), limit)
    assert failure is None, failure
    solved = replace(own, model=model, states=tuple(states))
    probe = Probe(own.model)
    values = probe.values(solved.results)
    change = errors(probe.values(own.results), values)
    return Converged(solved, probe, values, change.largest)


def measured(scene: Scene, against: Converged) -> Iterator[Measured]:
    """Each accuracy in turn."""
    for accuracy in ACCURACIES:
        one = solve(asking(scene, accuracy), scene.foundations[0])
        found = errors(against.probe.values(one.results), against.values)
        true = [found.displacement, found.reaction, found.moment]
        told = progress_values(one)
        estimate = [told[f"estimate/{q}"].max() for q in QUANTITIES]
        yield Measured(accuracy, one.model.elements, np.array(true), np.array(estimate))
