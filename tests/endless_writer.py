"""Writes a database without end, for the tests that kill it: `python endless_writer.py TARGET`."""

import sys
from pathlib import Path

import numpy as np

from builders import grid, row_values
from podeep.database.write import Writer

STEP = 0.25  # s


def main(target: Path) -> None:
    grids = [grid(name, spatial=False) for name in ("F1", "F2")]
    with Writer(
        target, kind="dynamic", title="", deck_text="", grids=grids, loads=(), force=True, block=8
    ) as writer:
        count = 0
        while True:
            axis = STEP * np.arange(count, count + 3)
            writer.append(axis, row_values("dynamic", grids, axis))
            count += len(axis)
            if count == 15:
                print("running", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
