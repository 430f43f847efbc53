"""Kills a run at random moments and goes on with it: `python killed_runs.py FOLDER KILLS SEED`.

It forks, so that a run costs no start of Python, and prints one line for each kill: the rows that
the partial holds, those that the run had told of before, and what the run that went on from there
to the end differs in from one that nothing happened to (`-` where it was not tried).
"""

import os
import random
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path

import shaken
from podeep import motion_log
from podeep.database.read import open_database
from podeep.run import run_deck

END = 1.0  # s
BLOCK = 16  # steps, so that there are many commits
BLOCKS = round(END / shaken.STEP) // BLOCK
TRIED = 10  # of so many kills, one run goes on to the end


def in_child(deck: Path, folder: Path, *, resume: bool, tell: Callable[[str], None]) -> int:
    """Start a run in another process; its number."""
    child = os.fork()
    if child:
        return child
    try:
        run_deck(deck, folder, force=True, resume=resume, progress=tell)
    finally:
        os._exit(0)


def killed(deck: Path, folder: Path, chance: random.Random, longest: float) -> int:
    """Kill a run, perhaps one that goes on; the steps that it had told of."""
    partial = folder / "shaken.dst.partial"
    resume = partial.exists() and chance.random() < 0.5
    if not resume:
        partial.unlink(missing_ok=True)
    reading, writing = os.pipe()

    def tell(text: str) -> None:
        os.write(writing, f"{text}\n".encode())

    child = in_child(deck, folder, resume=resume, tell=tell)
    os.close(writing)
    while not partial.exists():
        time.sleep(0.002)
    blocks, lines = chance.randrange(BLOCKS), []
    with os.fdopen(reading, encoding="utf-8") as told:
        # after so many blocks, whatever else the machine does, and a part of the next one
        while len(lines) < blocks and (line := told.readline()):
            lines += [line] * ("of motion" in line)
        time.sleep(chance.uniform(0.0, longest))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        lines += [line for line in told if "of motion" in line]
    return round(float(lines[-1].split()[0]) / shaken.STEP) if lines else 0


def main(place: Path, kills: int, seed: int) -> None:
    motion_log.BLOCK = BLOCK
    deck = shaken.deck(place, end=END)
    (place / "whole").mkdir()
    (place / "cut").mkdir()
    told: list[float] = []
    run_deck(
        deck, place / "whole", force=False, progress=lambda text: told.append(time.monotonic())
    )
    longest = 2.0 * (told[-1] - told[1]) / BLOCKS
    whole, cut = (place / name / "shaken.dst" for name in ("whole", "cut"))
    partial = cut.with_name("shaken.dst.partial")
    chance = random.Random(seed)
    done = 0
    while done < kills:
        steps = killed(deck, place / "cut", chance, longest)
        if not partial.exists():  # it had come to its end
            continue
        with open_database(partial) as database:
            rows = len(database.foundation("F1").axis)
        done += 1
        found = "-"
        if done % TRIED == 0:
            run_deck(deck, place / "cut", force=True, resume=True)
            found = ",".join(shaken.differences(whole, cut)) or "nothing"
        print(rows, steps, found, flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), *map(int, sys.argv[2:]))
