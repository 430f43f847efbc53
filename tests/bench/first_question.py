"""Time from the start of podeep to its first question, at a pseudo-terminal and through a pipe.

python tests/bench/first_question.py DATABASE [ROUNDS]
"""

import platform
import statistics
import subprocess
import sys
import time
from pathlib import Path

import pexpect

PODEEP = str(Path(sys.executable).with_name("podeep"))


def at_terminal(database: str) -> float:
    start = time.perf_counter()
    child = pexpect.spawn(PODEEP, [database], dimensions=(30, 80))
    child.expect("Exit.*<q>")
    spent = time.perf_counter() - start
    child.close(force=True)
    return spent


def through_pipe(database: str) -> float:
    start = time.perf_counter()
    with subprocess.Popen(
        [PODEEP, database], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        assert child.stdin is not None
        assert child.stdout is not None
        child.stdout.readline()
        spent = time.perf_counter() - start
        child.stdin.write(b"q\n")
    return spent


def main(database: str, rounds: str = "15") -> None:
    print(f"{platform.machine()}, Python {platform.python_version()}")
    for name, one in (("terminal", at_terminal), ("pipe", through_pipe)):
        one(database)
        times = [one(database) for _ in range(int(rounds))]
        print(f"{name}: median {statistics.median(times):.3f} s, largest {max(times):.3f} s")


if __name__ == "__main__":
    main(*sys.argv[1:])
