"""Accuracy asked and true error of motions, as `measured_motion.py` has them.

pip install "podeep[test]" && python tests/bench/motion_accuracy.py [--short]
"""

import argparse
from pathlib import Path
from sys import path

path.insert(0, str(Path(__file__).parents[1]))
from measured_motion import CASES, GAPS, rows
from podeep.solve.dynamics import End


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--short", action="store_true", help="1e-2 and 1e-3 alone")
    asked = (1e-2, 1e-3) if parser.parse_args().short else (1e-2, 1e-3, 1e-4)
    print(f"{'motion':26}{'asked':>8}{'error':>9}{'estimate':>10}{'peak':>9}{'lost':>9}", end="")
    print(f"{'steps':>7}{'el.':>5}{'s':>7}")
    for case in (*CASES, *GAPS):
        for row in rows(case, asked):
            line = f"{row.case.name:26}{row.accuracy:8.0e}{row.error:9.1e}{row.estimate:10.1e}"
            line += f"{row.peak:9.1e}{row.lost:9.1e}{row.steps:7}{row.elements:5}{row.seconds:7.1f}"
            print(line, "" if row.ending is End.COMPLETE else row.ending.value, flush=True)


if __name__ == "__main__":
    main()
