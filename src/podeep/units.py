"""How numbers are shown: display units, significant digits, one notation for a whole table.

Everything inside is SI; only tables and pictures convert, and only by this table.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import degrees, floor, log10
from typing import Any

import numpy as np

from .arrays import Array

_DIGITS = 6
_LEAST_DIGITS = 3  # of the largest value of each curve of a fixed-point table
_NOISE = 1e-9  # share of a table's largest value below which rounding made the value


@dataclass(frozen=True, slots=True)
class Quantity:
    """A result: its name, its SI unit, and the unit it is shown in (shown = scale * SI)."""

    key: str
    title: str
    si_unit: str
    unit: str
    scale: float

    @property
    def label(self) -> str:
        return f"{self.title} ({self.unit})"


QUANTITIES = {
    q.key: q
    for q in (
        Quantity("lateral_displacement", "Lateral displacement", "m", "m", 1.0),
        Quantity("lateral_force", "Lateral force", "N/m", "kN/m", 1e-3),
        Quantity("axial_displacement", "Axial displacement", "m", "m", 1.0),
        Quantity("axial_force", "Axial force", "N/m", "kN/m", 1e-3),
        Quantity("penetration", "Normal displacement", "m", "m", 1.0),
        Quantity("normal_reaction", "Normal force", "N/m", "kN/m", 1e-3),
        Quantity("effective_tension", "Effective tension", "N", "kN", 1e-3),
        Quantity("bending_moment", "Bending moment", "N m", "kN m", 1e-3),
    )
}

PARAMETER_UNITS = {
    **dict.fromkeys(("depth", "depth_in_rock", "diameter", "embedded_length"), "m"),
    **dict.fromkeys(
        ("effective_unit_weight", "subgrade_modulus", "verley_lund_unit_weight"), "N/m3"
    ),
    **dict.fromkeys(("friction_angle", "interface_friction_angle"), "deg"),
    **dict.fromkeys(("initial_stiffness", "strength_gradient"), "Pa/m"),
    **dict.fromkeys(
        (
            "compressive_strength",
            "effective_overburden",
            "end_bearing_limit",
            "friction_limit",
            "given_dynamic_stiffness",
            "given_static_stiffness",
            "initial_shear_modulus",
            "mean_undrained_shear_strength",
            "mudline_strength",
            "rock_mass_modulus",
            "tip_pressure",
            "undrained_shear_strength",
            "unit_friction",
        ),
        "Pa",
    ),
}
"""Units of the parameters of laws; the others have none. Angles are shown in degrees."""

DERIVED_UNITS = {
    **dict.fromkeys(("transition_depth", "y50", "y_A", "y_k", "y_rm"), "m"),
    **dict.fromkeys(("peak_bearing", "peak_friction"), "Pa"),
    **dict.fromkeys(
        ("residual_resistance", "theoretical_resistance", "ultimate_resistance"), "N/m"
    ),
    "initial_stiffness": "Pa",
}
"""Units of what lateral and axial laws derive from their parameters; the others have none."""

_SHARES = ("relative_density", "rock_quality_designation")  # shown in percent

AXIS_UNITS = {"step": "", "time": "s", "depth": "m", "distance": "m"}
"""Units of what results are given against; a step is a plain number."""


def short(value: float) -> str:
    """A number in running text: six significant digits at most, no trailing zeros."""
    return f"{value + 0.0:.{_DIGITS}g}"


def with_unit(value: float, axis: str) -> str:
    """A step, time, depth or distance in running text: `12`, `0.5 s`, `30 m`."""
    return f"{short(value)} {AXIS_UNITS[axis]}".rstrip()


def parameter(name: str, value: Any, unit: str | None = None) -> str:
    """A parameter of a law in words; angles in degrees, some shares in percent.

    unit: that of a number which is no parameter, in place of the parameter's own.
    """
    words = name.replace("_", " ")
    if isinstance(value, bool):
        return words if value else f"not {words}"
    if isinstance(value, str):
        return f"{words} {value}"
    number = float(np.ravel(value)[0])
    if np.isposinf(number):
        return f"no {words}"
    if unit is None:
        unit = "%" if name in _SHARES else PARAMETER_UNITS.get(name, "")
        number = {"deg": degrees(number), "%": 100.0 * number}.get(unit, number)
    return f"{words} {short(number)} {unit}".rstrip()


def plain(text: str) -> str:
    """Text of a file, fit for a terminal: one line without control characters."""
    return "".join(c if c.isprintable() else " " for c in text)


def number_format(curves: Array) -> Callable[[float], str]:
    """One format for all values of a table; `curves` has shape (curves, values).

    Fixed, with six significant digits for the largest value, as long as the largest value of
    every curve keeps three; otherwise, and where that takes more than nine decimals or digits,
    scientific with six. Curves of zeros or of rounding noise have no say.
    """
    sizes = np.abs(curves).max(axis=1)
    largest = float(sizes.max())
    if largest == 0.0:
        return lambda value: f"{value:z.1f}"
    place = floor(log10(largest))
    decimals = max(_DIGITS - 1 - place, 0)
    smallest = float(sizes[sizes > _NOISE * largest].min())
    digits = floor(log10(smallest)) + decimals + 1
    if digits < _LEAST_DIGITS or decimals > 9 or place > 8:
        return lambda value: f"{value + 0.0:.{_DIGITS - 1}e}"
    return lambda value: f"{value:z.{decimals}f}"


def coordinates(values: Sequence[float] | Array) -> list[str]:
    """Depths, distances, times or steps with the fewest decimals that tell them to six digits.

    >>> coordinates([0.0, 2.5, 10.0])
    ['0.0', '2.5', '10.0']
    """
    numbers = np.asarray(values, dtype=float)
    largest = float(np.max(np.abs(numbers), initial=0.0))
    most = _DIGITS if largest == 0.0 else min(max(_DIGITS - 1 - floor(log10(largest)), 0), 12)
    tolerance = 0.5 * 10.0**-most
    decimals = next(
        (d for d in range(most) if np.all(np.abs(np.round(numbers, d) - numbers) < tolerance)), most
    )
    return [f"{value:z.{decimals}f}" for value in numbers]
