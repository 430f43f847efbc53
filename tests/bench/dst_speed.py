"""Speed and memory of a dynamic database of many steps, and of what is read off it.

python tests/bench/dst_speed.py [STEPS [DEPTHS [FOLDER]]]

One foundation, one tube, a row for each step. Writing is by the program's own writer, from blocks
of 1024 rows as a run makes them, with a state to go on from; at the end all is copied to the file
that stays. The same with the results of the tube at as many elevations. Queries are
`podeep.query`'s on the open file, its pages in memory. Of all times the best and the median are
printed, by the clock and of the processor, as other programs share the machine. Memory is the peak
of a process that writes 10 000 steps against that of one that writes all.
"""

import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from podeep.arrays import Array
from podeep.database.read import open_database
from podeep.database.schema import variables
from podeep.database.write import Grid, Writer
from podeep.query import envelope, snapshot, spread, step_evolution
from podeep.subject import FOUNDATION

STEPS, DEPTHS, BLOCK, FEW = 100_000, 200, 1024, 10_000
STEP = 0.01  # s
DEEPEST = 50.0  # m
ROUNDS, WRITTEN = 9, 3  # times that a query is asked, and that a database is written


def grid(depths: int, *, tubes: bool) -> Grid:
    depth, none = np.linspace(0.0, DEEPEST, depths), np.zeros(depths, dtype=int)
    elevations = {1: -depth} if tubes else {}
    return Grid("F1", depth, none + 1, none, np.zeros(0), 0.0, 0.0, elevations)


def block_of_rows(on: Grid) -> dict[str, Array]:
    """What a run hands over for a block: every variable that has a row for each step."""
    sway = np.sin(np.linspace(0.0, 30.0, BLOCK))
    found = {}
    for number, variable in enumerate(variables("dynamic", spatial=False, loads=False), start=1):
        of_tube = variable.group == "tubes"
        if "time" not in variable.dims or variable.is_scale or (of_tube and not on.tubes):
            continue
        group = "tubes/1/" if of_tube else f"{variable.group}/" if variable.group else ""
        over_depth = np.exp(-on.depth / (10.0 + number))
        flat = variable.dims == ("time",)
        found[f"F1/{group}{variable.name}"] = sway if flat else np.multiply.outer(sway, over_depth)
    return found


def now() -> Array:
    """Seconds by the clock, and of the processor."""
    return np.array([time.perf_counter(), time.process_time()])


def write(target: Path, steps: int, depths: int, *, tubes: bool) -> Array:
    """Write a database; seconds as the run goes, and for the file's end, each as `now`."""
    on = grid(depths, tubes=tubes)
    rows = block_of_rows(on)
    of_all = {f"F1/{q}": rows[f"F1/{q}"] for q in FOUNDATION.quantities}
    state = {"state": np.zeros(16 * depths)}
    options: dict[str, Any] = {"kind": "dynamic", "title": "", "deck_text": "", "loads": ()}
    begin = now()
    with Writer(target, grids=[on], force=True, room=steps, state=state, **options) as writer:
        for first in range(0, steps, BLOCK):
            n = min(BLOCK, steps - first)
            at = STEP * np.arange(first, first + n)
            writer.widen(at, {name: v[:n] for name, v in of_all.items()})
            writer.append(at, {name: v[:n] for name, v in rows.items()})
            writer.flush(state)
        gone = now()
        writer.finish("complete")
    return np.array([gone - begin, now() - gone])


def timed(what: Callable[[], object]) -> Array:
    """Seconds that it takes, a row for each round, as `now`."""
    what()
    times = [now()]
    for _ in range(ROUNDS):
        what()
        times.append(now())
    return np.diff(times, axis=0)


def shown(times: Array, unit: float) -> str:
    """Best and median of rounds, by the clock and of the processor."""
    best, middle = times.min(axis=0) / unit, np.median(times, axis=0) / unit
    return f"{best[0]:.1f} / {middle[0]:.1f} ({best[1]:.1f} / {middle[1]:.1f})"


def queries(path: Path) -> None:
    with open_database(path) as database:
        data = database.foundation("F1")
        ten, all_ = spread(0.0, data.depth[-1], 10), data.depth
        mid = 0.5 * float(data.axis[-1]) + 0.3 * STEP
        for quantity in FOUNDATION.quantities:
            asked = {
                "step evolution at 10 depths": lambda q=quantity: step_evolution(data, q, ten),
                "snapshot": lambda q=quantity: snapshot(data, q, all_, [mid]),
                "envelope": lambda q=quantity: envelope(data, q, all_),
            }
            for what, query in asked.items():
                print(f"{what}, {quantity}: {shown(timed(query), 1e-3)} ms")


def peak(folder: Path, steps: int, depths: int) -> float:
    """Largest resident memory of a process that writes so many steps, MB."""
    arguments = [sys.executable, __file__, "--write", str(folder / "m.dst"), str(steps)]
    done = subprocess.run([*arguments, str(depths)], capture_output=True, text=True, check=True)
    return float(done.stdout)


def main(steps: int = STEPS, depths: int = DEPTHS, folder: str | None = None) -> None:
    machine = f"{platform.machine()}, Python {platform.python_version()}, h5py {h5py.__version__}"
    print(f"{machine}: {steps} steps, {depths} depths; best / median (those of the processor)")
    with tempfile.TemporaryDirectory(dir=folder) as place:
        path = Path(place) / "run.dst"
        for tubes in (True, False):
            rounds = np.array([write(path, steps, depths, tubes=tubes) for _ in range(WRITTEN)])
            what = "with a tube's 11 results" if tubes else "6 quantities over the depth, errors"
            print(f"writing, {what}, {path.stat().st_size / 2**20:.0f} MB:")
            print(f"  as the run goes {shown(rounds[:, 0], 1e-6 * steps)} us a step")
            print(f"  copy at the end {shown(rounds[:, 1], 1e-6 * steps)} us a step")
        queries(path)
        few, many = (peak(Path(place), n, depths) for n in (min(FEW, steps), steps))
        print(f"peak memory of the writer: {few:.1f} MB at {FEW} steps, {many:.1f} MB at {steps}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        write(Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), tubes=False)
        # not of getrusage: that has the peak of the process that started this one in it
        status = Path("/proc/self/status").read_text(encoding="utf-8")
        print(float(status.split("VmHWM:")[1].split()[0]) / 1024.0)
    else:
        main(*map(int, sys.argv[1:3]), *sys.argv[3:4])
