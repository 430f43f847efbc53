"""Which databases a command line means, and what a case is called."""

from collections.abc import Sequence
from pathlib import Path

from ..database.schema import ENDINGS, PARTIAL
from ..errors import Fault, UserError


def case_name(path: Path) -> str:
    """The name of a database without its ending: that of its pictures too."""
    return Path(path.name.removesuffix(PARTIAL)).stem


def find_databases(names: Sequence[str], folder: Path) -> tuple[Path, ...]:
    """Paths of the databases that the names mean: files by their ending, else cases.

    Without a name the only case in the folder is taken. Raises `UserError` for what is not
    there, and where no name is given and there is not exactly one case.
    """
    if not names:
        return _case(str(_only_case(folder)))
    paths = [path for name in names for path in ((Path(name),) if _is_file(name) else _case(name))]
    return tuple(dict.fromkeys(paths))


def _is_file(name: str) -> bool:
    return name.removesuffix(PARTIAL).lower().endswith(tuple(ENDINGS))


def _case(name: str) -> tuple[Path, ...]:
    """The databases of a case, whichever exist."""
    named = [Path(f"{name}{suffix}") for suffix in ENDINGS]
    found = tuple(path for path in named if path.exists())
    if found:
        return found
    partial = [p for path in named if (p := Path(f"{path}{PARTIAL}")).exists()]
    remedy = (
        f"an interrupted run left {partial[0]}: name that file to open it"
        if partial
        else "name a case, a .dss or a .dst that exists"
    )
    raise UserError(Fault(f"neither {named[0]} nor {named[1]} is there", remedy))


def _only_case(folder: Path) -> Path:
    paths = sorted(path for suffix in ENDINGS for path in folder.glob(f"*{suffix}"))
    cases = list(dict.fromkeys(path.with_suffix("") for path in paths))
    match cases:
        case [only]:
            return only
        case []:
            raise UserError(Fault("no .dss or .dst is in this folder", "name a case: podeep CASE"))
    names = ", ".join(case.name for case in cases)
    raise UserError(Fault(f"several cases are in this folder: {names}", "name one: podeep CASE"))
