"""Damaged, foreign and hostile files end in words, not in a crash or a runaway allocation."""

import os
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import builders
from podeep.database.read import open_database
from podeep.errors import UserError

HUGE = 2**40


def read_everything(path: Path) -> None:
    with open_database(path) as database:
        assert database.deck_text
        for name in database.names:
            data = database[name]
            for quantity, values in data.datasets.items():
                if values.ndim and values.shape[0] == len(data.axis):
                    data.read(quantity)
            for quantity in data.subject.quantities:
                data.envelope(quantity)


def refused(path: Path, message: str) -> None:
    with pytest.raises(UserError, match=message) as error:
        read_everything(path)
    assert str(error.value).startswith(str(path))


@pytest.fixture
def good(tmp_path: Path) -> Path:
    return builders.static_database(tmp_path / "run.dss")


def attribute(where: str, name: str, value: object):
    return lambda file: file[where].attrs.__setitem__(name, value)


def without(where: str):
    return lambda file: file.__delitem__(where)


def instead(where: str, **arguments: object):
    """Put another dataset in the place of one, with its units."""

    def change(file: h5py.File) -> None:
        units = file[where].attrs.get("units")
        del file[where]
        data = file.create_dataset(where, **arguments)
        if units:
            data.attrs["units"] = units

    return change


def linked(where: str, link: object):
    def change(file: h5py.File) -> None:
        del file[where]
        file[where] = link

    return change


def virtual(file: h5py.File) -> None:
    layout = h5py.VirtualLayout((4, 10), float)
    layout[:] = h5py.VirtualSource("/etc/hostname", "x", (4, 10))
    del file["F1/lateral_force"]
    file.create_virtual_dataset("F1/lateral_force", layout).attrs["units"] = "N m-1"


def value(where: str, index: object, new: float):
    return lambda file: file[where].__setitem__(index, new)


FORCE, DEPTH = "F1/lateral_force", "F1/depth"
CHANGES = {
    "another program": (lambda f: f.attrs.__delitem__("schema"), "HDF5 file of another program"),
    "another schema": (attribute("/", "schema", "other"), "HDF5 file of another program"),
    "schema is a number": (attribute("/", "schema", 1), "attribute schema is no text"),
    "newer schema": (attribute("/", "schema_version", "2.0"), "its schema is 2.0.*reads 1.x"),
    "strange version": (attribute("/", "schema_version", "1"), "schema_version is '1'"),
    "strange kind": (attribute("/", "kind", "cyclic"), "kind is 'cyclic', none of static"),
    "wrong ending": (attribute("/", "kind", "dynamic"), "a dynamic database that ends in .dss"),
    "strange status": (attribute("/", "status", "done"), "status is 'done'"),
    "a list as title": (attribute("/", "title", ["a", "b"]), "attribute title is no text"),
    "no UTF-8": (
        lambda f: f.attrs.create("title", b"\xff\xfe", dtype=h5py.string_dtype()),
        "attribute title is no UTF-8 text",
    ),
    "no foundation": (without("F1"), "holds no foundation"),
    "foundation is a variable": (linked("F1", np.arange(3)), "F1 is no group"),
    "no mudline": (lambda f: f["F1"].attrs.__delitem__("mudline"), "mudline of F1 is missing"),
    "mudline in words": (attribute("F1", "mudline", "deep"), "mudline of F1 holds no finite"),
    "endless mudline": (attribute("F1", "mudline", np.inf), "mudline of F1 holds no finite"),
    "two axes": (attribute("F1", "lateral_axis", [0.0, 1.0]), "lateral_axis of F1 is not one"),
    "missing variable": (without(FORCE), "lateral_force is missing"),
    "group for variable": (linked(FORCE, h5py.SoftLink("/F1")), "is a link to elsewhere"),
    "external link": (linked(FORCE, h5py.ExternalLink("/etc/hostname", "/")), "link to elsewhere"),
    "external group": (linked("F1", h5py.ExternalLink("x.h5", "/")), "link to elsewhere"),
    "external values": (
        instead(FORCE, shape=(4, 10), dtype="f8", external=[("/etc/hostname", 0, 320)]),
        "keeps its values in another file",
    ),
    "virtual values": (virtual, "keeps its values in another file"),
    "wrong shape": (instead(FORCE, data=np.zeros((4, 9))), "shape .4, 9., its dimensions .4, 10."),
    "wrong type": (instead(FORCE, data=np.zeros((4, 10), complex)), "is of type complex128"),
    "bool": (instead("F1/layer", data=np.zeros(10, bool)), "is of type bool"),
    "wrong units": (attribute(FORCE, "units", "kN m-1"), "in 'kN m-1', not in 'N m-1'"),
    "no units": (lambda f: f[FORCE].attrs.__delitem__("units"), "units of .* is missing"),
    "float32 depth": (instead(DEPTH, data=np.arange(10, dtype="f4")), "depth is of type float32"),
    "depth falls": (value(DEPTH, 4, 1.0), "depth does not hold finite, rising values"),
    "depth not finite": (value(DEPTH, 9, np.nan), "depth does not hold finite, rising values"),
    "step twice": (value("F1/step", 2, 1), "step does not hold finite, rising values"),
    "elevation rises": (value("F1/tubes/7/elevation", 0, -200.0), "finite, falling values"),
    "value not finite": (value(FORCE, (2, 3), np.nan), "lateral_force holds values that are not"),
    "deck changed": (instead("input/deck", data="other"), "attribute sha256 .*missing"),
    "deck's checksum": (attribute("input/deck", "sha256", "0"), "not agree with its checksum"),
    "deck is a number": (instead("input/deck", data=1), "damaged|no text"),
    "huge, not stored": (
        lambda f: [
            instead("F1/step", shape=(HUGE,), dtype="i4")(f),
            instead(FORCE, shape=(HUGE, 10), dtype="f8")(f),
        ],
        "declares",
    ),
    "huge, packed": (
        instead(FORCE, shape=(4, 10), dtype="f8", compression="gzip"),
        "declares 320 bytes and stores 0",
    ),
    "huge chunks": (
        instead(FORCE, shape=(4, 10), maxshape=(None, None), chunks=(4096, 4096), dtype="f8"),
        "absurdly large chunks",
    ),
    "unknown packing": (
        instead(FORCE, data=np.zeros((4, 10)), compression="lzf"),
        "packed in an unknown way",
    ),
}


@pytest.mark.parametrize("case", CHANGES)
def test_changed_databases_are_refused_in_words(good, case):
    change, message = CHANGES[case]
    with h5py.File(good, "r+") as file:
        change(file)
    refused(good, message)


@pytest.mark.parametrize("count", [-1, 65])
def test_counter_outside_the_room(tmp_path, count):
    path = builders.dynamic_database(tmp_path / "run.dst", times=np.arange(64.0))
    with h5py.File(path, "r+") as file:
        file.attrs["status"] = "running"
        file["committed"] = count
    refused(path, f"room for 64 rows, not for {count}")


def test_additions_of_a_newer_minor_version_are_ignored(good):
    with h5py.File(good, "r+") as file:
        file.attrs["schema_version"] = "1.7"
        file.attrs["colour"] = np.arange(3)
        file["extra/more"] = np.zeros(2, bool)
        file["F1/settlement"] = np.zeros(3)
        file["F1/tubes/notes"] = "text"
    read_everything(good)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "it is not an HDF5 file; DeepLines"),
        (b"DeepLines simulation", "it is not an HDF5 file; DeepLines' own simulation files"),
        (b"\x89HDF\r\n\x1a\n", "damaged or cut short"),
    ],
)
def test_foreign_files(tmp_path, content, message):
    path = tmp_path / "run.dss"
    path.write_bytes(content)
    refused(path, message)
    assert path.read_bytes() == content


def test_what_is_no_file(tmp_path):
    refused(tmp_path, "a folder, not a database")
    refused(tmp_path / "none.dss", "there is no such file")
    os.mkfifo(tmp_path / "pipe.dss")
    refused(tmp_path / "pipe.dss", "not an ordinary file")


def test_cut_short(good):
    whole = good.read_bytes()
    for length in range(8, len(whole), len(whole) // 40):
        good.write_bytes(whole[:length])
        refused(good, "damaged or cut short")


@pytest.mark.parametrize("kind", ["static", "dynamic", "compressed", "running", "lines"])
def test_random_damage_never_crashes(tmp_path, kind):
    # In a process of its own, as HDF5 itself might crash; memory is bounded there.
    driver = Path(__file__).with_name("damage_driver.py")
    done = subprocess.run(
        [sys.executable, str(driver), kind, str(tmp_path)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "refused" in done.stdout
