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
    """One accuracy: true errors and estimates of the three quantities, largest of all steps.

    true: against the converged solution. own: against one that takes or leaves P-delta as this one
    does; the estimate is of these errors.
    """

    asked: float
    elements: int
    true: Array
    own: Array
    estimate: Array

    @property
    def excess(self) -> float:
        """Largest true error over the accuracy asked."""
        return float(self.true.max()) / self.asked

    @property
    def ratios(self) -> Array:
        """Estimates over errors, both at least the floor."""
        return np.asarray(np.maximum(self.estimate, FLOOR) / np.maximum(self.own, FLOOR))

    @property
    def misses(self) -> tuple[str, ...]:
        """Bars that do not hold, in words."""
        found = []
        for name, true, own, ratio in zip(
            QUANTITIES, self.true, self.own, self.ratios, strict=True
        ):
            if true > MOST * self.asked:
                found.append(f"{name} {true:.1e} of {self.asked:g}")
            if not LEAST_RATIO <= ratio <= MOST_RATIO:
                found.append(f"{name} {own:.1e} estimated at {ratio:.2g} times that")
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


def of_same_model(scene: Scene, against: Converged, solved: Solved) -> Converged:
    """A converged solution that takes or leaves P-delta as `solved` does."""
    asked = solved.model.needs.second_order
    if asked == against.solved.model.needs.second_order:
        return against
    return converged(replace(scene, numerics=replace(scene.numerics, second_order=asked)))


def apart(solved: Solved, against: Converged) -> Array:
    """Errors of the largest displacement, reaction and moment."""
    found = errors(against.probe.values(solved.results), against.values)
    return np.array([found.displacement, found.reaction, found.moment])


def measured(scene: Scene, against: Converged) -> Iterator[Measured]:
    """Each accuracy in turn."""
    same = against
    for accuracy in ACCURACIES:
        one = solve(asking(scene, accuracy), scene.foundations[0])
        assert one.failure is None, one.failure.ending
        same = of_same_model(scene, same, one)
        told = progress_values(one)
        estimate = np.array([told[f"estimate/{q}"].max() for q in QUANTITIES])
        found = apart(one, against), apart(one, same)
        yield Measured(accuracy, one.model.elements, *found, estimate)
