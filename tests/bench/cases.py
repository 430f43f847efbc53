"""Print the errors of the closed-form cases: python tests/bench/cases.py [DECK LINE]

DECK LINE is how the deck asks for accuracy, `*MODEL ELEMENTS=40` by default.
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from closed_forms import CASES

COLUMNS = ("head", "y", "slope", "moment", "shear")


def main(how: str = "*MODEL ELEMENTS=40") -> None:
    print(f"{how}: errors relative to the largest value")
    print(f"{'case':<30}" + "".join(f"{c:>10}" for c in COLUMNS))
    with tempfile.TemporaryDirectory() as folder:
        for name, case in CASES.items():
            errors = case.errors(how, Path(folder))
            cells = (f"{errors[c]:10.1e}" if c in errors else f"{'':>10}" for c in COLUMNS)
            print(f"{name:<30}" + "".join(cells))


if __name__ == "__main__":
    main(*sys.argv[1:])
