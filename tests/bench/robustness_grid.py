"""Run the whole robustness grid and print what came of it: python robustness_grid.py [SOIL ...]

Every soil, head free and fixed (shafts: stub and slender, down and up), 4 to 48 elements, 0.1 to
1.5 of the capacity in 1 to 50 steps. A cut is a step that was halved on the way; the error is that
of the peak, relative to the capacity.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from grid import SURE, Run, runs, ways, whole
from grid_soils import ASIDE, DOWN


def line(name: str, found: list[Run]) -> str:
    below = [r for r in found if r.share <= SURE]
    above = [r for r in found if r.share > SURE]
    steps = sum(r.steps for r in below)
    return (
        f"{name:<50}{len(found):>6}{sum(r.wrong for r in found):>7}"
        f"{sum(r.halved for r in below):>5}"
        f"{sum(r.iterations for r in below) / steps:>8.2f}{max(r.most for r in below):>6}"
        f"{sum(r.factorisations for r in below) / steps:>8.2f}"
        f"{sum(r.factorisations for r in above) / len(above):>9.0f}"
        f"{max(abs(r.reached - 1.0) for r in above):>9.1e}"
    )


def main(*names: str) -> int:
    print(
        f"{'':<50}{'runs':>6}{'wrong':>7}{'cuts':>5}{'it/step':>8}{'most':>6}{'fact.':>8}"
        f"{'fact/stop':>9}{'error':>9}"
    )
    every: list[Run] = []
    start = time.process_time()
    for soil in names or (*ASIDE, *DOWN):
        for way in ways(soil):
            found = runs(soil, way, whole())
            print(line(f"{soil}; {way}", found), flush=True)
            for r in found:
                if r.wrong:
                    print("   ", r.case.elements, r.share, r.steps, r.reached, r.told.split("\n"))
            every += found
    print(line("all", every))
    print(f"{time.process_time() - start:.0f} s of CPU", file=sys.stderr)
    return int(any(r.wrong for r in every))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
