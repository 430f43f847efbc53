"""Energy that methods of time integration make of tubes that knock, and what each costs.

    pip install "podeep[test]" && python tests/bench/knocking_methods.py

A string in a conductor (`knocking.py`) that is set off and let go, for 4 s; ratios to HHT of CPU
times are the least of three runs, in turns.
"""

import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from sys import path

import numpy as np

path.insert(0, str(Path(__file__).parents[1]))
from knocking import energies, knocking
from moving_piles import head_of, motion_of, start_of
from podeep.motion import Damping, Method
from podeep.scene import Dynamics
from podeep.solve.dynamics import integrator
from podeep.solve.integrators import Integrator

NAMES: tuple[Method, ...] = ("HHT", "NEWMARK", "BATHE", "CONSERVE")
END, RUNS = 4.0, 3
STILL = 1e-7  # what iterations leave, as a share of the largest displacement


def rayleigh(ratio: float) -> Damping:
    """A share of critical damping at 0.4 and 5 Hz."""
    w = 2.0 * np.pi * np.array([0.4, 5.0])
    a, b = np.linalg.solve(np.stack([1.0 / w, w], axis=1), np.full(2, 2.0 * ratio))
    return Damping(float(a), float(b))


def main() -> None:
    methods: Mapping[str, Integrator] = {
        name: integrator(Dynamics(0.0, 1.0, method=name)) for name in NAMES
    }
    for ratio in (0.0, 0.01):
        scene = replace(knocking(end=END), damping=rayleigh(ratio) if ratio else None)
        start = start_of(scene)
        print(
            f"damping {ratio:g}: largest energy, and the last, over the first; CPU time over HHT's"
        )
        print(f"{'DT':>6}", *(f"{name:>27}" for name in NAMES))
        for h in (0.02, 0.01, 0.005, 0.002):
            steps, cells = round(END / h), []
            seconds = dict.fromkeys(NAMES, np.inf)
            for _ in range(RUNS):
                for name in NAMES:
                    motion, begin = motion_of(scene, start), time.process_time()
                    head_of(motion, methods[name], h, steps, STILL)
                    seconds[name] = min(seconds[name], time.process_time() - begin)
            for name in NAMES:
                found = energies(methods[name], motion_of(scene, start), h, steps, STILL)
                found /= found[0]
                cost = seconds[name] / seconds["HHT"]
                cells.append(f"{found.max():13.6f} {found[-1]:8.3g} {cost:4.1f}")
            print(f"{h:6g}", *cells, flush=True)


if __name__ == "__main__":
    main()
