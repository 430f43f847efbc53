"""What the disk may refuse, in words."""

from pathlib import Path

from .errors import Fault, UserError


def make_folder(folder: Path) -> Path:
    """Make a folder for results, and those above it; it may exist. Raises UserError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(
            Fault(f"{folder} is no folder for results: {error.strerror}", "choose another with -o")
        ) from error
    return folder
