"""Stiffness of the soil under spudcans by every model, side by side, each by its name."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi

import numpy as np

from .arrays import Array
from .demand import demand
from .model.footing import footing, yield_surface
from .report import folded
from .scene import Scene, Spudcan
from .soil.spudcan import (
    MODELS,
    Moduli,
    Stiffness,
    arya_factors,
    elastic_stiffness,
)
from .soil.spudcan_bearing import clay_bearing_capacity, sand_bearing_capacity
from .units import short


@dataclass(frozen=True)
class Row:
    """One model of one spudcan: shear moduli by motion (Pa) and the springs they make."""

    tube: int
    model: str
    moduli: Moduli
    stiffness: Stiffness


def rows(scene: Scene) -> list[Row]:
    """Every model that the deck's spudcans give enough for."""
    return [row for spudcan in scene.spudcans for row in _rows(spudcan, _load(scene, spudcan))]


def _load(scene: Scene, spudcan: Spudcan) -> float:
    """Largest compression of any step on the spudcan's tube, N: of moduli that depend on it."""
    for foundation in scene.foundations:
        if spudcan.tube in foundation.tubes:
            return demand(scene, foundation).compression
    return 0.0


def _rows(spudcan: Spudcan, vertical: float) -> Iterator[Row]:
    radius, nu = 0.5 * spudcan.diameter, spudcan.poisson_ratio
    own = Moduli(*[spudcan.shear_modulus] * 3)
    yield Row(spudcan.tube, "deck: G, KD", own, footing(spudcan).stiffness)
    arya = arya_factors(nu, radius, spudcan.embedment)
    yield Row(spudcan.tube, "deck: G, KD of Arya", own, elastic_stiffness(own, nu, radius, arya))
    factors = (spudcan.vertical_factor, spudcan.horizontal_factor, spudcan.rotational_factor)
    for name, (clay, sand) in MODELS.items():
        found: Array | Moduli
        if spudcan.soil == "CLAY":
            found = clay(spudcan.undrained_shear_strength, spudcan.overconsolidation_ratio)
        elif spudcan.soil == "SAND" and spudcan.relative_density and vertical:
            area = pi * radius**2
            found = sand(spudcan.relative_density, vertical, area)
        else:
            continue
        moduli = found if isinstance(found, Moduli) else Moduli(found, found, found)
        yield Row(
            spudcan.tube,
            f"{name}: G of {spudcan.soil.lower()}, KD",
            moduli,
            elastic_stiffness(moduli, nu, radius, factors),
        )


def text(scene: Scene) -> str:
    """The table in words, 80 columns wide."""
    lines: list[str] = []
    for spudcan in scene.spudcans:
        lines += [*([""] if lines else []), *_heading(spudcan)]
        if spudcan.soil == "SAND" and spudcan.relative_density:
            lines.append(f"  G of sand under the deck's load, V {short(_load(scene, spudcan))} N")
        titles = ("vertical", "horizontal", "rotational", "torsional")
        lines.append(f"{'model':<30}" + "".join(f"{t:>12}" for t in titles))
        lines.append(
            f"{'':<30}" + "".join(f"{u:>12}" for u in ("N/m", "N/m", "N m/rad", "N m/rad"))
        )
        for row in _rows(spudcan, _load(scene, spudcan)):
            values = "".join(f"{float(k):>12.4g}" for k in row.stiffness)
            lines.append(f"{row.model:<30}{values}")
        lines += [line for text_ in _bearing(spudcan) for line in folded(text_)]
    return "\n".join(lines)


def _heading(spudcan: Spudcan) -> Iterator[str]:
    yield (
        f"spudcan of tube {spudcan.tube}: B {short(spudcan.diameter)} m, embedded "
        f"{short(spudcan.embedment)} m, G {short(spudcan.shear_modulus)} Pa, "
        f"nu {short(spudcan.poisson_ratio)}"
    )
    kd = (spudcan.vertical_factor, spudcan.horizontal_factor, spudcan.rotational_factor)
    yield f"  KD {', '.join(short(k) for k in kd)}: the table of ISO 19905-1 is not public"


def _bearing(spudcan: Spudcan) -> Iterator[str]:
    """Bearing capacity and yield surface, as far as the soil is known."""
    weight, depth = spudcan.effective_unit_weight, spudcan.embedment
    if weight is not None and spudcan.soil == "CLAY":
        assert spudcan.undrained_shear_strength is not None
        found = clay_bearing_capacity(
            spudcan.undrained_shear_strength, spudcan.diameter, depth, weight * depth
        )
        yield f"  bearing capacity in clay {short(float(found.capacity))} N (gross)"
    elif weight is not None and spudcan.friction_angle is not None:
        found = sand_bearing_capacity(
            spudcan.friction_angle, spudcan.diameter, depth, weight, weight * depth
        )
        yield f"  bearing capacity in sand {short(float(found.capacity))} N (gross)"
    surface = yield_surface(spudcan)
    if surface is not None:
        yield (
            f"  yield surface: QV {short(surface.vertical_capacity)} N, QH "
            f"{short(surface.horizontal_capacity)} N, QM {short(surface.moment_capacity)} N m, "
            f"a {short(surface.embedment)}"
        )


#: Columns of `csv_rows`.
COLUMNS = (
    *("tube", "model", "shear_modulus_vertical [Pa]", "shear_modulus_horizontal [Pa]"),
    *("shear_modulus_rotational [Pa]", "vertical [N m-1]", "horizontal [N m-1]"),
    *("rotational [N m rad-1]", "torsional [N m rad-1]"),
)


def csv_rows(scene: Scene) -> Iterator[tuple[str, ...]]:
    """The table in SI and full precision, by COLUMNS."""
    for row in rows(scene):
        numbers = np.array([*row.moduli, *row.stiffness], dtype=float).tolist()
        yield (str(row.tube), row.model, *map(repr, numbers))
