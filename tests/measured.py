"""How far a solution is from the converged one, and how far it says it is."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from podeep.arrays import Array
from podeep.model.assemble import Model
from podeep.record import progress_values
from podeep.scene import Scene
from podeep.solve.analysis import Solved, limits, rebuilt, run, solve
from podeep.study.measure import Probe, asking, errors, factors_of

QUANTITIES = ("displacement", "reaction", "moment")
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5)
FLOOR = 1e-9  # errors below it are as good as none
MOST, LEAST_RATIO, MOST_RATIO = 2.0, 0.1, 10.0  # errors over accuracies, estimates over errors
_REFERENCE = 1e-7  # accuracy of the mesh that the converged solution starts from
_RESIDUAL, _ITERATIONS = 1e-11, 300
_DEGREE, _SHEAR_DEGREE = 7, 5  # high powers of a shear's softness are rounding


@dataclass(frozen=True)
class Converged:
    """A solution on a finer mesh of a higher degree than that of 1e-7, and what that changed."""

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

    @property
    def misses(self) -> tuple[str, ...]:
        """Bars that do not hold, in words."""
        told = [f"{q} {e:.1e}" for q, e in zip(QUANTITIES, self.true, strict=True)]
        pairs = zip(told, self.true, self.ratios, strict=True)
        found = []
        for name, true, ratio in pairs:
            if true > MOST * self.asked:
                found.append(f"{name} of {self.asked:g}")
            if not LEAST_RATIO <= ratio <= MOST_RATIO:
                found.append(f"{name} estimated at {ratio:.2g} times that")
        return tuple(found)


def finer_models(scene: Scene, own: Model) -> Iterator[Model]:
    """Meshes to converge on, the finest first: elements of a stiff tube must not be too short."""
    degree = _SHEAR_DEGREE if own.needs.shear else _DEGREE
    more = degree - own.lateral.system.field.degree
    middle = 0.5 * (own.edges[:-1] + own.edges[1:])
    yield rebuilt(scene, own, np.union1d(own.edges, middle), more)
    yield rebuilt(scene, own, own.edges, max(more, 1))


def converged(scene: Scene) -> Converged:
    """The first foundation of a scene on the mesh of a small accuracy, halved, of degree 7."""
    fine = asking(scene, _REFERENCE)
    own = solve(fine, scene.foundations[0])
    assert own.failure is None, own.failure.ending
    limit = replace(limits(fine), residual=_RESIDUAL, iterations=_ITERATIONS)
    for model in finer_models(fine, own.model):
        states, failure, _ = run(model, factors_of(scene), limit)
        if failure is None:
            break
    assert failure is None, failure.ending
    solved = replace(own, model=model, states=tuple(states))
    probe = Probe(own.model)
    values = probe.values(solved.results)
    change = errors(probe.values(own.results), values)
    return Converged(solved, probe, values, change.largest)


def measured(scene: Scene, against: Converged) -> Iterator[Measured]:
    """Each accuracy in turn."""
    for accuracy in ACCURACIES:
        one = solve(asking(scene, accuracy), scene.foundations[0])
        assert one.failure is None, one.failure.ending
        found = errors(against.probe.values(one.results), against.values)
        true = np.array([found.displacement, found.reaction, found.moment])
        told = progress_values(one)
        estimate = np.array([told[f"estimate/{q}"].max() for q in QUANTITIES])
        yield Measured(accuracy, one.model.elements, true, estimate)
