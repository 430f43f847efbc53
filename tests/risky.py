"""Sound curves and piles, from which tests of risky ones differ by a value."""

import re
from math import radians

from podeep.scene import (
    Curve,
    Foundation,
    Ground,
    Load,
    Numerics,
    Scene,
    Section,
    Steps,
    Support,
    Tube,
)

LINE = re.compile(r"((p-y|t-z) curve \d+|tube \d+|F\d+( spudcan)?): .+: .+; .+")

#: Curves that nothing is wrong with, in SI, by family and law.
SOUND = {
    ("p-y", "soft_clay"): {
        "undrained_shear_strength": 40e3,
        "effective_unit_weight": 8e3,
        "j": 0.5,
        "strain_50": 0.01,
    },
    ("p-y", "sand"): {
        "effective_unit_weight": 10e3,
        "friction_angle": radians(35.0),
        "subgrade_modulus": 22e6,
    },
    ("p-y", "stiff_clay_free_water"): {
        "undrained_shear_strength": 120e3,
        "effective_unit_weight": 9e3,
        "strain_50": 0.005,
        "subgrade_modulus": 270e6,
    },
    ("p-y", "stiff_clay"): {
        "undrained_shear_strength": 120e3,
        "effective_unit_weight": 19e3,
        "strain_50": 0.005,
        "j": 0.5,
        "cycles": 100.0,
    },
    ("p-y", "weak_rock"): {
        "compressive_strength": 2e6,
        "rock_mass_modulus": 500e6,
        "rock_quality_designation": 0.5,
        "strain_rm": 1e-4,
        "effective_unit_weight": 14e3,
    },
    ("p-y", "iso_clay"): {
        "undrained_shear_strength": 40e3,
        "effective_unit_weight": 8e3,
        "overconsolidation_ratio": 1.5,
        "mudline_strength": 5e3,
        "strength_gradient": 1.5e3,
        "strength_ratio": 1.0,
    },
    ("p-y", "pisa_clay"): {
        "undrained_shear_strength": 100e3,
        "initial_shear_modulus": 80e6,
        "effective_unit_weight": 9e3,
    },
    ("p-y", "pisa_sand"): {
        "effective_unit_weight": 10e3,
        "relative_density": 0.7,
        "initial_shear_modulus": 100e6,
    },
    ("p-y", "reese_sand"): {
        "effective_unit_weight": 10e3,
        "friction_angle": radians(35.0),
        "subgrade_modulus": 22e6,
    },
    ("p-y", "user"): {"multiplier": 0.8, "effective_unit_weight": 8e3},
    ("t-z", "direct"): {"unit_friction": 50e3, "tip_pressure": 2e6, "effective_unit_weight": 9e3},
    ("t-z", "cohesive"): {
        "undrained_shear_strength": 40e3,
        "effective_unit_weight": 8e3,
        "residual": 0.8,
    },
    ("t-z", "cohesionless"): {
        "earth_pressure_coefficient": 0.8,
        "effective_unit_weight": 10e3,
        "interface_friction_angle": radians(25.0),
        "bearing_factor": 20.0,
        "friction_limit": 81.3e3,
        "end_bearing_limit": 4.8e6,
    },
}
OPTIONS = {
    "soft_clay": {"cyclic": False, "shape": "2GEO"},
    "iso_clay": {"no_gap": True, "plasticity": "HIGH"},
    "pisa_clay": {"site": "COWDEN"},
    "cohesive": {"shape": "2GEO", "method": "ALPHA"},
    "cohesionless": {"shape": "2GEO", "method": "BETA"},
    "direct": {"shape": "2GEO"},
}


def curve(family, law, id_=1, rows=(), options=None, **changed):
    """A sound curve with some values changed; None takes one out."""
    values = {k: v for k, v in (SOUND[family, law] | changed).items() if v is not None}
    return Curve(id_, law, values, OPTIONS.get(law, {}) | (options or {}), rows)


def scene(
    lateral,
    axial,
    diameter=2.0,
    length=40.0,
    force=(1e6, 0.0, -1e6),
    wall=0.05,
    depths=(0.0,),
    numerics=None,
    density=7850.0,
    **more,
):
    """A pile of 5 m free and a length embedded; one curve of each family, or one at each depth."""
    section = Section(5.0, -length, diameter, wall, 210e9, density)
    curves = [c if isinstance(c, tuple) else (c,) * len(depths) for c in (lateral, axial)]
    ids = [tuple(c.id if c else 0 for c in family) for family in curves]
    found = [{c.id: c for c in family if c} for family in curves]
    return Scene(
        "",
        {1: Tube(1, "", (section,))},
        (Foundation(1, (1,), 0.0),),
        Ground(depths, *ids, *found, **more.pop("ground", {})),
        loads=(Load("A", 1, 5.0, force, (0.0, 0.0, 0.0)),),
        steps=Steps(("A",), ((0.5,), (1.0,))),
        numerics=numerics or Numerics(),
        **more,
    )


CLAY, SAND = curve("p-y", "soft_clay"), curve("p-y", "sand", 2)
SHAFT, SAND_SHAFT = curve("t-z", "cohesive"), curve("t-z", "cohesionless", 2)

TIP = (Support(1, -40.0, ("Z",)),)
OFF = Numerics(axial_curves=False)


def kilo(newtons):
    return f"{float(f'{1e-3 * newtons:.4g}'):g} kN"
