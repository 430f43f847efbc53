"""Scenes that several tests share."""

from dataclasses import replace
from math import radians

from podeep.scene import Curve, Foundation, Ground, Load, Numerics, Scene, Section, Steps, Tube


def clay(id_: int, strength: float, shape: str = "POWER") -> Curve:
    parameters = {
        "undrained_shear_strength": strength,
        "effective_unit_weight": 8e3,
        "j": 0.5,
        "strain_50": 0.01,
    }
    return Curve(id_, "soft_clay", parameters, {"cyclic": False, "shape": shape})


def sand(id_: int) -> Curve:
    parameters = {
        "effective_unit_weight": 10e3,
        "friction_angle": radians(35.0),
        "subgrade_modulus": 22e6,
    }
    return Curve(id_, "sand", parameters, {"cyclic": False})


def clay_shaft(id_: int, strength: float) -> Curve:
    parameters = {"undrained_shear_strength": strength, "effective_unit_weight": 8e3}
    return Curve(id_, "cohesive", parameters, {"shape": "2GEO"})


def sand_shaft(id_: int) -> Curve:
    parameters = {
        "earth_pressure_coefficient": 0.46,
        "effective_unit_weight": 10e3,
        "interface_friction_angle": radians(45.0),
        "bearing_factor": 40.0,
        "friction_limit": 96e3,
        "end_bearing_limit": 10e6,
    }
    return Curve(id_, "cohesionless", parameters, {"shape": "2GEO"})


def linear_ground(modulus: float, diameter: float, friction: float = 1e3) -> Ground:
    """Lateral p = modulus y (N/m), by a user curve that is linear up to 1000 m."""
    curve = Curve(1, "user", {}, {}, ((1e3 * modulus / diameter, 1e3),))
    shaft = Curve(
        1, "direct", {"unit_friction": 1e12, "initial_stiffness": friction}, {"shape": "EP"}
    )
    return Ground((0.0, 1.0), (1, 1), (1, 1), {1: curve}, {1: shaft})


def reference_ground(shape: str = "POWER") -> Ground:
    """Clay of 20 to 60 kPa over 15 m, then sand of 35 degrees."""
    return Ground(
        (0.0, 15.0, 15.0, 40.0),
        (1, 2, 3, 3),
        (1, 2, 3, 3),
        {1: clay(1, 20e3, shape), 2: clay(2, 60e3, shape), 3: sand(3)},
        {1: clay_shaft(1, 20e3), 2: clay_shaft(2, 60e3), 3: sand_shaft(3)},
    )


def reference_pile(
    force: tuple[float, float, float] = (2e6, 0.0, -5e6),
    steps: int = 10,
    numerics: Numerics | None = None,
    shape: str = "POWER",
) -> Scene:
    """A tube of 2 m by 50 mm, 10 m free and 40 m embedded, loaded at its head in equal steps.

    Of first order unless P-delta is asked for: so are the references that it is compared with.
    """
    numerics = numerics or Numerics()
    if numerics.second_order is None:
        numerics = replace(numerics, second_order=False)
    tube = Tube(1, "pile", (Section(10.0, -40.0, 2.0, 0.05, 210e9, 7850.0),))
    factors = tuple((i / steps,) for i in range(1, steps + 1))
    return Scene(
        "reference pile",
        {1: tube},
        (Foundation(1, (1,), 0.0),),
        reference_ground(shape),
        loads=(Load("HEAD", 1, 10.0, force, (0.0, 0.0, 0.0)),),
        steps=Steps(("HEAD",), factors),
        numerics=numerics,
    )
