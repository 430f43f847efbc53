"""The writer: what it accepts, what it leaves, and which files it refuses to touch."""

import errno
import os
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

import builders
from podeep.database.read import open_database
from podeep.database.target import UNFINISHED
from podeep.database.write import Grid, Writer, check_target
from podeep.errors import UserError

AXIS = np.arange(4)
GRIDS = [builders.grid("F1")]
LOADS = ("H",)


def writer(target: Path, **options: object) -> Writer:
    arguments = {"kind": "static", "title": "", "deck_text": "", "grids": GRIDS, "loads": LOADS}
    return Writer(target, **(arguments | options))


def rows(axis: np.ndarray = AXIS) -> dict[str, np.ndarray]:
    return builders.row_values("static", GRIDS, axis, LOADS)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_only_the_target_is_left(tmp_path):
    builders.static_database(tmp_path / "run.dss")
    assert names(tmp_path) == ["run.dss"]


def test_partial_beside_the_target_while_running(tmp_path):
    with writer(tmp_path / "run.dss") as out:
        assert names(tmp_path) == ["run.dss.partial"]
        assert out.path == tmp_path / "run.dss.partial"
        out.append(AXIS, rows())
        out.finish("complete")
    assert names(tmp_path) == ["run.dss"]


def test_same_input_same_bytes(tmp_path):
    first = builders.static_database(tmp_path / "a.dss", spatial=True).read_bytes()
    time.sleep(1.1)  # HDF5 counts the time of making an object in seconds
    assert builders.static_database(tmp_path / "b.dss", spatial=True).read_bytes() == first


def test_small_static_database_is_small(tmp_path):
    assert builders.static_database(tmp_path / "run.dss").stat().st_size < 80_000


def test_bytes_do_not_depend_on_blocks(tmp_path):
    first, *others = (
        builders.dynamic_database(tmp_path / f"{block}.dst", block=block).read_bytes()
        for block in (1024, 7, 101)
    )
    assert all(other == first for other in others)


def test_rows_one_by_one_or_together(tmp_path):
    with writer(tmp_path / "a.dss") as out:
        out.append(AXIS, rows())
        out.finish("complete")
    with writer(tmp_path / "b.dss", block=2) as out:
        for step in AXIS:
            out.append(step, rows(np.array([step])))
        out.finish("complete")
    assert (tmp_path / "a.dss").read_bytes() == (tmp_path / "b.dss").read_bytes()


def test_large_values_lie_in_chunks_and_compress(tmp_path):
    times, depth = np.linspace(0.0, 20.0, 2000), np.linspace(0.0, 30.0, 45)
    plain, small = (
        builders.dynamic_database(tmp_path / f"{c}.dst", times=times, depth=depth, compress=c)
        for c in (False, True)
    )
    with h5py.File(plain) as first, h5py.File(small) as second:
        assert first["F1/lateral_force"].chunks == (2000, 10)
        assert first["F1/lateral_force"].compression is None
        assert second["F1/lateral_force"].compression == "gzip"
        assert np.array_equal(first["F1/lateral_force"], second["F1/lateral_force"])
    assert small.stat().st_size < 0.8 * plain.stat().st_size
    with open_database(small) as database:
        assert database.foundation("F1").read("lateral_force").shape == (2000, 45)


@pytest.mark.parametrize("block", [700, 1024, 5000])
def test_rows_across_the_edges_of_chunks(tmp_path, block):
    """Blocks and chunks that end elsewhere, a last chunk that is not full, room that grows."""
    times, depth = np.linspace(0.0, 50.0, 5000), np.linspace(0.0, 30.0, 45)
    path = builders.dynamic_database(tmp_path / "long.dst", times=times, depth=depth, block=block)
    given = builders.row_values("dynamic", [builders.grid("F1", depth)], times)
    with h5py.File(path) as file:
        assert file["F1/lateral_force"].chunks == (2048, 10)
        for name, values in given.items():
            data = file[name]
            assert np.array_equal(data, np.asarray(values).astype(data.dtype)), name


def test_status_and_history(tmp_path):
    with writer(tmp_path / "run.dss", history="podeep-solve run run.dat") as out:
        out.append(AXIS, rows())
        out.finish("stopped", "no equilibrium above 0.83")
    with open_database(tmp_path / "run.dss") as database:
        assert (database.status, database.stop_reason) == ("stopped", "no equilibrium above 0.83")
    with h5py.File(tmp_path / "run.dss") as file:
        assert file.attrs["history"] == "podeep-solve run run.dat"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda v: v.pop("F1/lateral_force"), "missing: .*F1/lateral_force"),
        (lambda v: v.update({"F1/colour": AXIS}), "unknown: .*F1/colour"),
        (lambda v: v.update({"F1/tip_force": AXIS[:2]}), "F1/tip_force: .2,. is not .4,."),
        (lambda v: v["F1/axial_force"].__setitem__((1, 2), np.nan), "F1/axial_force: not finite"),
        (lambda v: v["F1/axial_force"].__setitem__((1, 2), np.inf), "F1/axial_force: not finite"),
    ],
)
def test_bad_rows_are_a_fault_of_the_program(tmp_path, change, message):
    values = rows()
    change(values)
    with writer(tmp_path / "run.dss") as out, pytest.raises(ValueError, match=message):
        out.append(AXIS, values)


def test_steps_must_increase(tmp_path):
    with writer(tmp_path / "run.dss") as out:
        out.append(AXIS, rows())
        with pytest.raises(ValueError, match="step does not increase"):
            out.append(AXIS, rows())


def test_finish_needs_a_row(tmp_path):
    with writer(tmp_path / "run.dss") as out, pytest.raises(ValueError, match="without a row"):
        out.finish("complete")


@pytest.mark.parametrize(
    "change",
    [
        {"depth": np.array([0.0, 1.0, 1.0])},
        {"tube": np.ones(2, int)},
        {"tubes": {1: np.array([-5.0, -4.0])}},
        {"lateral_axis": -90.0},
    ],
)
def test_impossible_grids(change):
    good = {
        "name": "F1",
        "depth": np.arange(3.0),
        "tube": np.ones(3, int),
        "layer": np.zeros(3, int),
        "layer_boundaries": np.empty(0),
        "mudline": -10.0,
        "lateral_axis": 0.0,
        "tubes": {1: np.array([0.0, -5.0])},
    }
    Grid(**good)
    with pytest.raises(ValueError, match="F1"):
        Grid(**(good | change))


def test_existing_database_is_kept_unless_forced(tmp_path):
    target = builders.static_database(tmp_path / "run.dss")
    before = target.read_bytes()
    with pytest.raises(UserError, match=r"run\.dss exists.*--force"):
        builders.static_database(target, title="new")
    assert target.read_bytes() == before
    builders.static_database(target, title="new", force=True)
    with open_database(target) as database:
        assert database.title == "new"


def test_replaced_while_someone_reads_it(tmp_path):
    target = builders.static_database(tmp_path / "run.dss", steps=3)
    with open_database(target) as database:
        builders.static_database(target, steps=5, force=True)
        assert database.foundation("F1").read("lateral_force").shape[0] == 4
    with open_database(target) as database:
        assert database.foundation("F1").read("lateral_force").shape[0] == 6


def foreign_files(path: Path) -> None:
    path.write_bytes(b"DeepLines simulation" * 20)


def foreign_hdf5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(3)


@pytest.mark.parametrize("make", [foreign_files, foreign_hdf5, Path.touch, Path.mkdir])
@pytest.mark.parametrize("name", ["run.dss", "run.dss.partial", "run.dss.partial.new"])
def test_foreign_files_are_never_touched(tmp_path, make, name):
    foreign = tmp_path / name
    make(foreign)
    before = foreign.read_bytes() if foreign.is_file() else None
    with pytest.raises(UserError, match=f"{name} (exists and is no|is in the way)"):
        builders.static_database(tmp_path / "run.dss", force=True)
    assert names(tmp_path) == [name]
    assert before is None or foreign.read_bytes() == before


def test_half_made_files_of_ours_are_cleared(tmp_path):
    (tmp_path / "run.dss.partial.new").write_bytes(UNFINISHED + bytes(100))
    builders.static_database(tmp_path / "run.dss")
    assert names(tmp_path) == ["run.dss"]


def test_target_that_turns_up_meanwhile_is_kept(tmp_path):
    target = tmp_path / "run.dss"
    with writer(target) as out:
        out.append(AXIS, rows())
        foreign_files(target)
        with pytest.raises(UserError, match=r"results are kept in .*run\.dss\.partial"):
            out.finish("complete")
    assert target.read_bytes().startswith(b"DeepLines")
    with open_database(out.path) as database:
        assert database.status == "complete"


def test_missing_folder_is_told(tmp_path):
    with pytest.raises(UserError, match="is no folder"):
        check_target(tmp_path / "none" / "run.dss", force=False)


def test_closed_folder_is_told(tmp_path, monkeypatch):
    def refuse(path: Path, *_: int) -> int:  # the superuser, who may run this, is never refused
        raise PermissionError(errno.EACCES, "no", str(path))

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(UserError, match=r"run\.dss\.partial cannot be written: Permission denied"):
        builders.static_database(tmp_path / "run.dss")
