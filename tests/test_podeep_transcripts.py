"""Whole sessions of the command, held against the transcripts that lie beside this file.

`python tests/test_podeep_transcripts.py` writes the transcripts anew; read the difference.
"""

import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

import risers
from builders import dynamic_database, static_database

TRANSCRIPTS = Path(__file__).parent / "transcripts"
REAL_RUN = Path(__file__).parents[1] / "sample_dbs" / "conductor_waves.dst"

COMMAND = [sys.executable, "-c", "from podeep.cli.podeep import main; raise SystemExit(main())"]

#: A session: arguments of the command; the answers stand in NAME.answers.
SESSIONS = {
    "static": ["run.dss"],
    "dynamic": ["run.dst"],
    "both": ["run"],
    "foundations": ["several.dss", "--no-plot"],
    "single_step": ["single.dss", "--no-plot"],
    "spatial": ["spatial.dss", "--no-plot"],
    "csv": ["run", "--csv", "--no-plot"],
    "motion_evolution": ["conductor_waves"],
    "motion_snapshots": ["conductor_waves"],
    "motion_envelope": ["conductor_waves.dst"],
    "riser": ["riser.dss"],
    "riser_motion": ["riser.dst"],
    "riser_beside_pile": ["riser_and_pile.dss", "--csv", "--no-plot"],
    "refused_depth": ["run.dss"],
    "refused_distance": ["riser.dss"],
    "refused_sign": ["run.dss"],
    "refused_time": ["run.dst"],
    "missing_number": ["run.dss"],
    "missing_result": ["run.dss"],
}


def databases(folder: Path) -> None:
    static_database(folder / "run.dss")
    dynamic_database(folder / "run.dst", times=np.linspace(0.0, 10.0, 11))
    static_database(folder / "several.dss", foundations=("F1", "F2"))
    static_database(folder / "single.dss", steps=1)
    static_database(folder / "spatial.dss", spatial=True)
    risers.static_database(folder / "riser.dss")
    risers.dynamic_database(folder / "riser.dst", times=np.linspace(0.0, 10.0, 11))
    risers.static_database(folder / "riser_and_pile.dss", foundations=("F1",))
    shutil.copy(REAL_RUN, folder)


def transcript(name: str, folder: Path) -> str:
    """What a session writes: exit code, standard output, standard error, and its pictures."""
    before = set(folder.iterdir())
    answers = TRANSCRIPTS / f"{name}.answers"
    (folder / answers.name).write_bytes(answers.read_bytes())
    done = subprocess.run(
        [*COMMAND, *SESSIONS[name], "--answers", answers.name],
        cwd=folder,
        capture_output=True,
        encoding="utf-8",
    )
    made = sorted(path for path in set(folder.iterdir()) - before if path.suffix == ".png")
    for path in made:
        path.unlink()
    return "\n".join(
        [
            f"exit code {done.returncode}",
            f"=== standard output\n{done.stdout}=== standard error\n{done.stderr}=== pictures",
            *(path.name for path in made),
            "",
        ]
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sessions")
    databases(path)
    return path


@pytest.mark.parametrize("name", SESSIONS)
def test_a_session_goes_as_its_transcript(name: str, folder: Path) -> None:
    golden = (TRANSCRIPTS / f"{name}.txt").read_text(encoding="utf-8")
    assert transcript(name, folder) == golden


def test_there_is_no_transcript_without_a_session() -> None:
    names = {path.name for path in TRANSCRIPTS.iterdir()}
    assert names == {f"{name}.{end}" for name in SESSIONS for end in ("answers", "txt")}


if __name__ == "__main__":
    with TemporaryDirectory() as place:
        databases(Path(place))
        for session in SESSIONS:
            text = transcript(session, Path(place))
            (TRANSCRIPTS / f"{session}.txt").write_text(text, encoding="utf-8")
