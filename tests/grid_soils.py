"""The soils of the robustness grid: every law, static and cyclic, as curves by name."""

from collections.abc import Mapping
from math import radians

from podeep.scene import Curve

CLAY = {"undrained_shear_strength": 60e3, "effective_unit_weight": 8e3}
SOFT = {**CLAY, "j": 0.5, "strain_50": 0.01}
HARD = {"undrained_shear_strength": 120e3, "effective_unit_weight": 9e3, "strain_50": 0.006}
SAND = {"effective_unit_weight": 9e3, "friction_angle": radians(34.0)}
ROCK = {"compressive_strength": 2e6, "rock_mass_modulus": 5e8, "strain_rm": 5e-4}
ISO = {**CLAY, "overconsolidation_ratio": 2.0}
PISA = {"undrained_shear_strength": 60e3, "initial_shear_modulus": 30e6}
SHAFT = {**CLAY, "initial_stiffness": 1e8}
GRAINS = {
    "earth_pressure_coefficient": 0.8,
    "effective_unit_weight": 9e3,
    "interface_friction_angle": radians(28.0),
    "bearing_factor": 20.0,
    "initial_stiffness": 1e8,
}
GIVEN = {"unit_friction": 50e3, "tip_pressure": 1e6, "initial_stiffness": 1e8}


def _curve(law: str, parameters: Mapping[str, float], **options: str | float | bool) -> Curve:
    return Curve(1, law, parameters, options)


def _rows(*rows: tuple[float, ...]) -> Curve:
    return Curve(1, "user", {}, {}, rows)


#: p-y whose reaction never falls: the peak of a stub is the mechanism of a rigid one.
LATERAL: Mapping[str, Curve] = {
    "soft clay": _curve("soft_clay", SOFT),
    "soft clay, WSD": _curve("soft_clay", SOFT, shape="WSD"),
    "soft clay, cube root": _curve("soft_clay", SOFT, shape="POWER"),
    "sand": _curve("sand", SAND),
    "cyclic sand": _curve("sand", SAND, cyclic=True),
    "Reese sand": _curve("reese_sand", SAND),
    "cyclic Reese sand": _curve("reese_sand", SAND, cyclic=True),
    "stiff clay": _curve("stiff_clay", {**CLAY, "strain_50": 0.007}),
    "cyclic stiff clay": _curve("stiff_clay", {**CLAY, "strain_50": 0.007}, cyclic=True),
    "weak rock": _curve("weak_rock", {**ROCK, "rock_quality_designation": 0.5}),
    "ISO clay": _curve("iso_clay", ISO),
    "ISO clay, low plasticity": _curve("iso_clay", ISO, plasticity="LOW", no_gap=True),
    "PISA clay": _curve("pisa_clay", PISA),
    "PISA clay, Bothkennar": _curve("pisa_clay", PISA, site="BOTHKENNAR"),
    "PISA sand": _curve(
        "pisa_sand",
        {"effective_unit_weight": 9e3, "relative_density": 0.7, "initial_shear_modulus": 60e6},
    ),
    "user, elastic-plastic": _rows((200e3, 0.02)),
    "user, gap": _rows((0.0, 0.02), (200e3, 0.04)),
}
#: p-y whose reaction falls: the peak is the model's own.
SOFTENING: Mapping[str, Curve] = {
    "cyclic soft clay": _curve("soft_clay", SOFT, cyclic=True),
    "cyclic soft clay, cube root": _curve("soft_clay", SOFT, cyclic=True, shape="POWER"),
    "stiff clay in free water": _curve("stiff_clay_free_water", HARD),
    "cyclic stiff clay in free water": _curve("stiff_clay_free_water", HARD, cyclic=True),
    "user, softening": _rows((200e3, 0.02), (120e3, 0.1)),
}
ASIDE: Mapping[str, Curve] = {**LATERAL, **SOFTENING}
#: t-z and Q-z without a residual.
AXIAL: Mapping[str, Curve] = {
    "clay shaft": _curve("cohesive", SHAFT),
    "sand shaft": _curve("cohesionless", GRAINS),
    "sand shaft, API": _curve("cohesionless", GRAINS, shape="API"),
    "sand shaft, 2GEO": _curve("cohesionless", GRAINS, shape="2GEO"),
    "direct shaft": _curve("direct", GIVEN),
    "direct shaft, 2GEO": _curve("direct", GIVEN, shape="2GEO"),
    "user shaft": _rows((50e3, 0.01, 1e6, 0.1)),
}
#: t-z with one.
RESIDUAL: Mapping[str, Curve] = {
    "clay shaft, API": _curve("cohesive", SHAFT, shape="API"),
    "clay shaft, 2GEO, residual 0.7": _curve("cohesive", SHAFT, shape="2GEO", residual=0.7),
    "direct shaft, 2GEO, residual 0.8": _curve("direct", GIVEN, shape="2GEO", residual=0.8),
    "user shaft, residual": _rows((50e3, 0.005, 0.0, 0.05), (30e3, 0.01, 1e6, 0.1)),
}
DOWN: Mapping[str, Curve] = {**AXIAL, **RESIDUAL}
