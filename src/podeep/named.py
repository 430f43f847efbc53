"""Which foundation or line of a deck a command is of."""

from collections.abc import Mapping
from typing import TypeVar

from .errors import Fault, UserError
from .scene import Foundation, Line, Scene

T = TypeVar("T")


def foundation_of(scene: Scene, name: str | None) -> Foundation:
    """The foundation of this name, or the first one. Raises UserError if there is none."""
    found = {foundation.name: foundation for foundation in scene.foundations}
    if not found and scene.lines:
        names = ", ".join(_lines(scene))
        message = f"the deck has lines alone ({names}): this is of foundations"
        raise UserError(
            Fault(message, "for lines there are podeep-solve run, check, chart and stiffness")
        )
    return _named(found, name, "foundation", "name tubes in *FONDATION: this is of them")


def line_of(scene: Scene, name: str | None) -> Line:
    """The line of this name, L and its number, or the first one. Raises UserError if none is."""
    return _named(_lines(scene), name, "line", "lines are those of *LINE")


def _lines(scene: Scene) -> dict[str, Line]:
    return {f"L{number}": line for number, line in scene.lines.items()}


def _named(found: Mapping[str, T], name: str | None, kind: str, remedy: str) -> T:
    if not found:
        raise UserError(Fault(f"the deck has no {kind}", remedy))
    wanted = next(iter(found)) if name is None else name
    if wanted not in found:
        raise UserError(Fault(f"no {kind} {wanted}", f"the deck has {', '.join(found)}"))
    return found[wanted]
