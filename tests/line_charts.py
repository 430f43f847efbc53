"""Lines and few settings that tests of their charts share."""

from pathlib import Path

from podeep.deck.read import read_deck
from podeep.lines import Line
from podeep.scene import Scene
from podeep.study.line_settings import LinePlan, LineSeries

DECKS = Path(__file__).parent / "data" / "decks"
GRADED, EVEN = (LineSeries("integrated", graded=graded) for graded in (True, False))
GRADED_NODAL, EVEN_NODAL = (LineSeries("nodal", graded=graded) for graded in (True, False))
CASE_B = """\
*TITLE
The riser of table 05, case B
*DEPTH
-1000
*SEA
1000 10
*LINE
1 SCR
1635 0.4 0.02 200e9 7850 EI=55.3e6 EA=4.93e9 MASS=270.663706
*END
1 1 0 0 -1000.029 X Y Z RX RY RZ
1 2 991 0 0 X Y Z
*TYPCONTACT
0 1 3 0 0 5e4
*EXEC
"""
SMALL = LinePlan(
    (1e-2, 1e-3),
    (
        (GRADED, range(-1, 3)),
        (EVEN, range(3)),
        (GRADED_NODAL, range(-1, 3)),
        (EVEN_NODAL, range(3)),
    ),
    2,
    1e3,
)
SHORT = LinePlan((1e-2,), ((EVEN, range(1)), (EVEN_NODAL, range(1))), 1, 1e3)


def silent(_: str) -> None:
    """Hear nothing."""


def read(folder: Path, text: str) -> tuple[Scene, Line]:
    path = folder / "riser.deck"
    path.write_text(text, encoding="utf-8")
    scene = read_deck(path).scene
    return scene, next(iter(scene.lines.values()))
