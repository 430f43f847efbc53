"""Opens a database with random bytes changed: `python damage_driver.py KIND FOLDER`.

Each must open and read, or raise UserError; anything else ends this process.
"""

import random
import resource
import sys
from pathlib import Path

import numpy as np

import builders
import risers
from podeep.database.write import Writer
from podeep.errors import UserError
from test_database_hostile import read_everything

MEMORY = 2**31  # bytes
FILES = 60


def running_database(path: Path) -> Path:
    grids = [builders.grid("F1")]
    with Writer(
        path, kind="dynamic", title="", deck_text="x", grids=grids, loads=(), block=16
    ) as out:
        axis = np.arange(40.0)
        out.append(axis, builders.row_values("dynamic", grids, axis))
        copy = path.with_name("copy.dst.partial")
        copy.write_bytes(out.path.read_bytes())
        out.finish("complete")
    return copy


def make(kind: str, folder: Path) -> Path:
    times, depth = np.linspace(0.0, 20.0, 1100), np.linspace(0.0, 30.0, 25)
    match kind:
        case "static":
            return builders.static_database(folder / "run.dss", spatial=True)
        case "lines":
            return risers.static_database(folder / "run.dss", foundations=("F1",))
        case "dynamic":
            return builders.dynamic_database(folder / "run.dst", times=times, depth=depth)
        case "compressed":
            return builders.dynamic_database(
                folder / "run.dst", times=times, depth=depth, compress=True
            )
    return running_database(folder / "run.dst")


def damaged(whole: bytes, chance: random.Random) -> bytes:
    changed = bytearray(whole)
    for _ in range(chance.choice([1, 2, 30])):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


def main(kind: str, folder: Path) -> None:
    path = make(kind, folder)
    whole = path.read_bytes()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    chance = random.Random(kind)
    count = {"read": 0, "refused": 0}
    for _ in range(FILES):
        path.write_bytes(damaged(whole, chance))
        try:
            read_everything(path)
            count["read"] += 1
        except UserError:
            count["refused"] += 1
    print(count)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
