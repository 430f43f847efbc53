"""Steps of one length and steps that follow the error, each as the program chooses them.

    python tests/bench/following_the_error.py

The scenes are the reference pile with 200 t on its head, swaying under 4 MN of 4 s period, and
knocked by 4 MN for half a second. Errors are those of the head at any time over its largest
displacement, against steps of half a millisecond; seconds are CPU time without the trials.
"""

import one_thread  # noqa: F401, I001  # before numpy


import time
from dataclasses import replace
from pathlib import Path
from sys import path

import numpy as np
from scipy.interpolate import CubicSpline

path.insert(0, str(Path(__file__).parents[1]))
path.insert(0, str(Path(__file__).parent))
from our_pile import machine

from moving_piles import start_of, swaying_pile
from podeep.motion import Hysteresis, TimeSeries
from podeep.scene import Scene
from podeep.solve.pace import pace_for, paced
from podeep.solve.plan import simulation
from podeep.solve.ready import Begun
from podeep.solve.simulate import Simulation

ACCURACIES = (1e-2, 1e-3, 1e-4)
EXACT = 5e-4  # s


def scene_of(name: str, hysteresis: Hysteresis, accuracy: float) -> Scene:
    """One of the scenes, asked for an accuracy."""
    scene = swaying_pile(force=4e6, accuracy=accuracy, end=12.0, hysteresis=hysteresis)
    if name == "swaying":
        return scene
    assert scene.dynamics is not None
    times, factors = (0.0, 1.0, 1.2, 1.5, 1.6), (0.0, 0.0, 1.0, 1.0, 0.0)
    series = (TimeSeries(scene.steps.names[0], times, factors),)
    return replace(scene, harmonics=(), series=series, dynamics=replace(scene.dynamics, end=40.0))


def head(one: Simulation) -> tuple[np.ndarray, np.ndarray]:
    """Times and displacements of the head."""
    blocks = list(one.blocks())
    times = np.concatenate([b.times for b in blocks])
    return times, np.concatenate([b.tracks[0][0].q[:, 0] for b in blocks])


def measured(scene: Scene, start: list[Begun], adaptive: bool) -> tuple[Simulation, str]:
    """A simulation that went all the way, and how it is told."""
    assert scene.dynamics is not None
    dynamics = replace(scene.dynamics, adaptive=adaptive)
    one = paced(scene, dynamics, start, pace_for(scene, dynamics, start), dynamics.end)
    one.record_each(dynamics.end)
    return one, "follow" if adaptive else "equal"


def main() -> None:
    print(machine())
    print(
        f"{'motion':16} {'asked':>6} {'steps':>7} {'error':>8} {'estimate':>8} {'number':>7}     s"
    )
    for name in ("swaying", "knocked"):
        for hysteresis in ("ELASTIC", "MASING"):
            loose = scene_of(name, hysteresis, 1e-3)
            assert loose.dynamics is not None
            start = [start_of(loose)]
            fine = simulation(loose, loose.dynamics, start, EXACT, loose.dynamics.end, twins=False)
            fine.share = 1e-7
            fine.record_each(loose.dynamics.end)
            times, true = head(fine)
            exact, largest = CubicSpline(times, true), np.abs(true).max()
            for accuracy in ACCURACIES:
                for adaptive in (False, True):
                    one, kind = measured(scene_of(name, hysteresis, accuracy), start, adaptive)
                    begin = time.process_time()
                    at, found = head(one)
                    spent = time.process_time() - begin
                    error = np.abs(found - exact(at)).max() / largest
                    print(f"{name}, {hysteresis.lower():7} {accuracy:>6.0e} {kind:>7}", end=" ")
                    print(f"{error:8.1e} {one.error:8.1e} {one.done:7d} {spent:5.1f}", flush=True)


if __name__ == "__main__":
    main()
