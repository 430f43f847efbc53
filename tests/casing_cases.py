"""CF32 as decks: a conductor and an inner casing in layered linear soil, by an exact chain."""

from math import pi

from decks import linear_curve
from podeep.database.read import Database
from static_cases import Deviation, Deviations, StaticCase

CONDUCTOR, CASING = 0.762, 0.508
#: load and tie, the load's line, normal force, head displacement (or settlement) and slope
HEADS = {
    "CF32 cemented H": ("150e3 0 0", 0.0, 0.05554910611352, -0.007813042612026),
    "CF32 cemented M": ("0 0 0 0 300e3 0", 0.0, 0.01562608522405, -0.003116042186309),
    "CF32 sliding H N": ("150e3 0 0", 2e6, 0.06051471068625, -0.008574552458562),
    "CF32 sliding M N": ("0 0 0 0 300e3 0", 2e6, 0.01714910491712, -0.003356374077836),
    "CF32 cemented V": ("0 0 -3e6", 0.0, 0.007868014110609, 0.0),
}


def friction(id_: int, modulus: float, diameter: float) -> str:
    """An elastic shaft, modulus in N/m2."""
    return f"*TZCURVE\n{id_} 0\n0 1e12 0 {modulus / (pi * diameter)!r}\n"


def text(name: str) -> str:
    """The deck of a case."""
    load, normal, *_ = HEADS[name]
    soils = ((1, 6e6, CONDUCTOR), (2, 25e6, CONDUCTOR), (3, 15e6, CASING))
    curves = "".join(linear_curve(*soil) for soil in soils)
    axial = name.endswith("V")
    shaft = friction(1, 15e6, CONDUCTOR) + friction(2, 8e6, CASING) if axial else ""
    pairs = "1 1 1 1 2 1 2 1 3 2 3 2" if axial else "1 0 1 0 2 0 2 0 3 0 3 0"
    sliding = "sliding" in name
    tie = "*TYPCONTACT\n1 2 2\n" if sliding else "*SLAVE\n1 2 CEMENTED\n"
    held = "" if axial else "*SUPPORT\n2 -60 Z\n" + ("1 -40 Z\n" if sliding else "")
    push = f"*LOAD\nP 1 0 {load}\n" + (f"P 2 0 0 0 {-normal!r}\n" if normal else "")
    return (
        f"*TITLE\n{name}\n*DEPTH\n-5\n*GROUNDEPTH\n0 -15 -15 -35 -35 -55\n{curves}{shaft}"
        f"*GROUNDPROP\n{pairs}\n*CASING\n1 CONDUCTOR\n0 -40 {CONDUCTOR} 0.0254 210e9 7850\n"
        f"*CASING\n2 INNER\n0 -60 {CASING} 0.0127 210e9 7850\n*FONDATION\n1 1 2\n"
        f"{tie}{held}{push}*EXEC\n"
    )


def case(name: str) -> StaticCase:
    """Its deck and the comparison of its head."""
    *_, moved, slope = HEADS[name]

    def compare(database: Database) -> Deviations:
        data = database.foundation("F1")

        def head(quantity: str) -> float:
            return float(data.read_tube(1, quantity, -1)[0][0])

        if name.endswith("V"):
            return [Deviation("settlement", abs(-head("displacement_z") / moved - 1.0), 1e-5)]
        return [
            Deviation("y", abs(head("displacement_x") / moved - 1.0), 1e-5),
            Deviation("slope", abs(-head("rotation_y") / slope - 1.0), 1e-5),
        ]

    return StaticCase(text(name), compare)


CASING_CASES = {name: case(name) for name in HEADS}
