"""Every sample with the model that was chosen and with all of it: how far apart, what was saved.

    python tests/bench/reduced_models.py

All of it is spatial and under P-delta, at a tenth of the accuracy; CPU times are those of whole
solutions.
"""

from pathlib import Path
from sys import path

path.insert(0, str(Path(__file__).parents[1]))
from reduced import SAMPLES, compared


def main() -> None:
    print(f"{'sample':<18}{'accuracy':>9}{'difference':>11}{'unknowns':>14}{'CPU s':>14}")
    for sample in SAMPLES:
        for accuracy in (1e-2, 1e-3, 1e-4):
            one = compared(sample, accuracy)
            unknowns = f"{one.unknowns[0]} of {one.unknowns[1]}"
            seconds = f"{one.seconds[0]:.2f} of {one.seconds[1]:.2f}"
            print(
                f"{one.name:<18}{accuracy:>9.0e}{one.difference:>11.1e}{unknowns:>14}{seconds:>14}"
            )
        for choice in one.choices:
            print(f"    {choice}")


if __name__ == "__main__":
    main()
