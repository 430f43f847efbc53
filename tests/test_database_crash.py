"""Kills, full disks and interrupts: the earlier database and the committed rows survive."""

import errno
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

import builders
import endless_writer
from podeep.database.read import open_database
from podeep.database.write import Writer
from podeep.errors import UserError
from podeep.subject import FOUNDATION

KILLS = 10
LONGEST = 0.3  # s of writing before a kill
GRIDS = [builders.grid("F1")]


def started(target: Path) -> subprocess.Popen[bytes]:
    """Another process that writes this database, some rows committed."""
    child = subprocess.Popen(
        [sys.executable, endless_writer.__file__, str(target)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        stdout=subprocess.PIPE,
    )
    assert child.stdout is not None
    assert child.stdout.readline() == b"running\n"
    child.stdout.close()
    return child


def check_committed(partial: Path) -> tuple[int, str]:
    """Every row is there and right; their number and the status."""
    with open_database(partial) as database:
        counts = set()
        for number, name in enumerate(database.foundations, start=1):
            data = database.foundation(name)
            counts.add(len(data.axis))
            assert np.array_equal(data.axis, endless_writer.STEP * np.arange(len(data.axis)))
            for quantity in FOUNDATION.quantities:
                exact = builders.field(quantity, np.sin(data.axis), data.depth, number)
                values = exact.astype(np.float32)
                assert np.array_equal(data.read(quantity), values)
                assert np.array_equal(data.envelope(quantity)[0], values.min(axis=0))
        assert len(counts) == 1
        return counts.pop(), database.status


def test_killed_at_any_moment(tmp_path):
    target = builders.dynamic_database(tmp_path / "run.dst", title="earlier")
    before = target.read_bytes()
    chance = random.Random(20)
    for _ in range(KILLS):
        child = started(target)
        time.sleep(chance.uniform(0.0, LONGEST))
        child.send_signal(signal.SIGKILL)
        child.wait()
        assert target.read_bytes() == before
        count, status = check_committed(tmp_path / "run.dst.partial")
        assert (count >= 8, status) == (True, "running")
    builders.dynamic_database(target, title="later", force=True)
    assert [path.name for path in tmp_path.iterdir()] == ["run.dst"]


def test_two_processes_at_one_target(tmp_path):
    target = tmp_path / "run.dst"
    child = started(target)
    try:
        with pytest.raises(UserError, match=r"another run is writing .*run\.dst\.partial"):
            builders.dynamic_database(target)
        check_committed(tmp_path / "run.dst.partial")  # reading is not disturbed
    finally:
        child.kill()
        child.wait()


def test_two_writers_in_one_process(tmp_path):
    with writer(tmp_path / "run.dst") as first:
        first.append(*rows(0, 4))
        with pytest.raises(UserError, match="another run is writing"):
            builders.dynamic_database(tmp_path / "run.dst")
        first.finish("complete")
    check_committed(tmp_path / "run.dst")


def test_interrupted_by_the_user(tmp_path):
    target = tmp_path / "run.dst"
    child = started(target)
    child.send_signal(signal.SIGINT)
    assert child.wait() != 0
    count, status = check_committed(tmp_path / "run.dst.partial")
    assert (count >= 15, status) == (True, "interrupted")
    assert [path.name for path in tmp_path.iterdir()] == ["run.dst.partial"]


def writer(target: Path) -> Writer:
    return Writer(
        target, kind="dynamic", title="", deck_text="", grids=GRIDS, loads=(), force=True, block=8
    )


def rows(first: int, last: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    axis = endless_writer.STEP * np.arange(first, last)
    return axis, builders.row_values("dynamic", GRIDS, axis)


def test_an_error_in_the_run_leaves_what_was_appended(tmp_path):
    target = builders.dynamic_database(tmp_path / "run.dst")
    before = target.read_bytes()

    def run() -> None:
        with writer(target) as out:
            out.append(*rows(0, 11))
            raise ZeroDivisionError("a fault of the solver")

    with pytest.raises(ZeroDivisionError):
        run()
    assert target.read_bytes() == before
    partial = tmp_path / "run.dst.partial"
    assert check_committed(partial) == (11, "interrupted")
    with open_database(partial) as database:
        assert database.stop_reason == "a fault of the solver"


def test_left_without_finish(tmp_path):
    with writer(tmp_path / "run.dst") as out:
        out.append(*rows(0, 3))
    assert check_committed(out.path) == (3, "interrupted")
    assert not (tmp_path / "run.dst").exists()


def write_with(monkeypatch, target: Path, calls: int, trouble: Callable[[], None]) -> None:
    """Write 8 rows, then more until `trouble` comes in a write after so many."""
    write = os.pwrite
    left = iter(range(calls))

    def troubled(descriptor: int, data: bytes, offset: int) -> int:
        if next(left, None) is None:
            trouble()
        return write(descriptor, data, offset)

    with writer(target) as out:
        out.append(*rows(0, 8))
        monkeypatch.setattr(os, "pwrite", troubled)
        for first in range(8, 64, 4):
            out.append(*rows(first, first + 4))
        out.finish("complete")


@pytest.mark.parametrize("calls", [0, 1, 5, 40, 100, 150, 200])
def test_disk_full_at_any_moment(tmp_path, monkeypatch, calls):
    def full() -> None:
        raise OSError(errno.ENOSPC, "full")

    target = builders.dynamic_database(tmp_path / "run.dst")
    before = target.read_bytes()
    with pytest.raises(UserError, match=r"run\.dst\.partial cannot be written: No space left"):
        write_with(monkeypatch, target, calls, full)
    assert target.read_bytes() == before
    partial = tmp_path / "run.dst.partial"
    assert sorted(tmp_path.iterdir()) == [target, partial]
    count, status = check_committed(partial)
    assert (count % 8, status) == (0, "running")
    # HDF5 would come back to a file left open when the interpreter ends, and crash
    assert h5py.h5f.get_obj_count(h5py.h5f.OBJ_ALL, h5py.h5f.OBJ_FILE) == 0


@pytest.mark.parametrize("calls", [0, 1, 5, 40, 100, 150, 200])
def test_interrupt_within_a_write(tmp_path, monkeypatch, calls):
    went_on = []

    def interrupt() -> None:
        monkeypatch.undo()
        signal.raise_signal(signal.SIGINT)
        went_on.append(True)  # for HDF5 an exception here would be a failed write

    target = tmp_path / "run.dst"
    with pytest.raises(KeyboardInterrupt):
        write_with(monkeypatch, target, calls, interrupt)
    assert went_on
    partial = tmp_path / "run.dst.partial"
    assert list(tmp_path.iterdir()) == [partial]
    count, status = check_committed(partial)
    assert (count % 4, status) == (0, "interrupted")
    with open_database(partial) as database:
        assert database.stop_reason == "interrupted by the user"


def test_process_outlives_a_full_disk(tmp_path):
    # HDF5 itself would end in a segmentation fault when the process does.
    code = (
        "import resource, signal, sys; from pathlib import Path; import builders\n"
        "from podeep.errors import UserError\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000))\n"
        "try: builders.dynamic_database(Path(sys.argv[1]))\n"
        "except UserError as error: print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "run.dst")],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "File too large" in done.stdout
