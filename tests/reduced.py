"""A scene as the program models it against the same scene with all of the model."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from podeep.deck.read import read_deck
from podeep.scene import Scene
from podeep.solve.analysis import Solved, solve

DECKS = (Path(__file__).parents[1] / "sample_dbs").glob("*.deck")
SAMPLES = sorted(deck for deck in DECKS if read_deck(deck).scene.foundations)


@dataclass(frozen=True)
class Pair:
    """What both make of one foundation: largest relative difference in any step of the largest
    displacement, settlement and moment; unknowns and CPU seconds of the reduced and the full."""

    name: str
    accuracy: float
    difference: float
    unknowns: tuple[int, int]
    seconds: tuple[float, float]
    choices: Sequence[str]


def compared(path: Path, accuracy: float) -> Pair:
    """The first foundation of a deck both ways: spatial, under P-delta and as it was chosen."""
    scene = read_deck(path).scene
    asked = replace(scene.numerics, accuracy=accuracy)
    whole = replace(asked, components=2, second_order=True, accuracy=0.1 * accuracy)
    (chosen, fast), (full, slow) = (timed(replace(scene, numerics=n)) for n in (asked, whole))
    assert chosen.failure is None
    assert full.failure is None
    difference = max(
        float(np.abs(a - b).max() / max(np.abs(b).max(), 1e-12))
        for a, b in zip(largest(chosen), largest(full), strict=True)
    )
    return Pair(
        path.stem,
        accuracy,
        difference,
        (unknowns(chosen), unknowns(full)),
        (fast, slow),
        [str(d) for d in chosen.model.needs.decisions],
    )


def timed(scene: Scene) -> tuple[Solved, float]:
    start = time.process_time()
    one = solve(scene, scene.foundations[0])
    return one, time.process_time() - start


def unknowns(solved: Solved) -> int:
    return solved.model.lateral.system.size + solved.model.axial.system.size


def largest(solved: Solved) -> list[np.ndarray]:
    """Largest deflection, settlement and moment of each step."""
    results = solved.results
    x = np.linspace(results.model.edges[0], results.model.edges[-1], 1001)
    moments = results.of_all(lambda x, tube: results.shear_and_moment(x, tube)[1], x)
    return [
        np.linalg.norm(results.deflection(x), axis=1).max(axis=1),
        np.abs(results.settlement(x)).max(axis=1),
        np.linalg.norm(moments, axis=1).max(axis=1),
    ]
