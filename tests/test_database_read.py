"""The reader: what comes back is what was written, of any rows and depths."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import builders
from podeep.database.read import Database, open_database
from podeep.database.write import Writer
from podeep.errors import UserError
from podeep.subject import FOUNDATION

TIMES = np.linspace(0.0, 12.0, 1500)
STEPS = 5


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("databases")
    builders.static_database(folder / "run.dss", steps=STEPS, foundations=("F2", "F10", "F1"))
    builders.static_database(folder / "spatial.dss", steps=STEPS, spatial=True)
    builders.dynamic_database(folder / "run.dst", times=TIMES, dtype=np.float64, block=200)
    return folder


@pytest.fixture(scope="module", params=["run.dss", "spatial.dss", "run.dst"])
def database(request: pytest.FixtureRequest, folder: Path):
    with open_database(folder / request.param) as database:
        yield database


def expected(database: Database, quantity: str, number: int = 1) -> np.ndarray:
    axis = database.foundation(database.foundations[0]).axis
    amplitude = builders.amplitude(database.kind, axis)
    return builders.field(quantity, amplitude, builders.DEPTH, number)


def test_what_it_is(folder):
    with open_database(folder / "run.dss") as database:
        assert database.kind == "static"
        assert database.title == "static case"
        assert (database.status, database.stop_reason) == ("complete", "")
        assert database.deck_text == builders.DECK
        assert database.path == folder / "run.dss"


def test_foundations_keep_their_order(folder):
    with open_database(folder / "run.dss") as database:
        assert database.foundations == ("F2", "F10", "F1")
        for number, name in enumerate(database.foundations, start=1):
            force = database.foundation(name).read("axial_force")
            assert np.array_equal(force, expected(database, "axial_force", number))
        with pytest.raises(UserError, match="no foundation F3; it has F2, F10, F1"):
            database.foundation("F3")


def test_coordinates(database):
    data = database.foundation(database.foundations[0])
    assert np.array_equal(data.depth, builders.DEPTH)
    assert np.array_equal(data.axis, np.arange(STEPS + 1) if database.kind == "static" else TIMES)
    assert data.mudline == builders.MUDLINE
    assert data.layer_boundaries.tolist() == [5.0]
    assert data.layer.tolist() == [0, 0, 0, 0, 1, 1, 1, 1, 1, 1]
    assert set(data.tube) == {builders.TUBE}
    assert data.tubes == tuple(builders.TUBES)
    for tube, elevation in builders.TUBES.items():
        assert np.array_equal(data.elevations[tube], elevation)


def test_planar_and_spatial(database):
    data = database.foundation(database.foundations[0])
    spatial = database.path.name == "spatial.dss"
    assert data.spatial == spatial
    assert data.lateral_axis == (None if spatial else 0.0)
    assert ("lateral_force_x" in data.datasets) == spatial
    if spatial:
        parts = [data.read(f"lateral_force_{c}") for c in "xy"]
        assert np.allclose(np.hypot(*parts), data.read("lateral_force"), rtol=1e-15)


def test_load_factors(folder):
    with open_database(folder / "run.dss") as database:
        data = database.foundation("F1")
        assert data.load_names == ("H", "V")
        assert data.load_factor.tolist() == [[s, 2 * s] for s in range(STEPS + 1)]
    with open_database(folder / "run.dst") as database:
        data = database.foundation("F1")
        assert data.load_names == ()
        assert data.load_factor.shape == (len(TIMES), 0)


def test_static_database_without_named_loads(tmp_path):
    path = builders.static_database(tmp_path / "run.dss", loads=())
    with open_database(path) as database:
        assert database.foundation("F1").load_factor.shape == (4, 0)


@given(data=st.data())
def test_any_rows_and_depths(database, data):
    foundation = database.foundation(database.foundations[0])
    count, depths = len(foundation.axis), len(foundation.depth)
    index = st.integers(-count, count - 1)
    rows = data.draw(st.none() | index | st.lists(index, max_size=8) | st.slices(count))
    window = data.draw(st.none() | st.builds(slice, *[st.integers(0, depths)] * 2))
    found = foundation.read("axial_displacement", rows, window)
    every = expected(database, "axial_displacement")
    wanted = np.atleast_2d(every[[rows] if isinstance(rows, int) else rows or slice(None)])
    if isinstance(rows, list):
        wanted = every[np.array(rows, dtype=int)]
    assert np.array_equal(found, wanted[:, window or slice(None)])


def test_rows_without_depths(database):
    data = database.foundation(database.foundations[0])
    assert np.array_equal(data.read("tip_displacement"), data.read("axial_displacement")[:, -1])
    assert data.read("estimate/moment", [2, 0]).tolist() == [1.0, 1.0]
    assert data.read("convergence/iterations", -1).tolist() == [1.0]


def test_tube_values(database):
    data = database.foundation(database.foundations[0])
    moment = data.read_tube(builders.TUBE, "moment_y", [0, 3])
    ratio = moment[1] / builders.ELEVATION
    assert moment.shape == (2, len(builders.ELEVATION))
    assert np.allclose(ratio, ratio[0], rtol=1e-14)


def test_unknown_names_and_rows(database):
    data = database.foundation(database.foundations[0])
    with pytest.raises(KeyError):
        data.read("colour")
    with pytest.raises(IndexError):
        data.read("lateral_force", len(data.axis))


@pytest.mark.parametrize("quantity", FOUNDATION.quantities)
def test_envelope_is_that_of_all_rows(database, quantity):
    data = database.foundation(database.foundations[0])
    values = data.read(quantity)
    low, high, low_at, high_at = data.envelope(quantity)
    assert np.array_equal(low, values.min(axis=0))
    assert np.array_equal(high, values.max(axis=0))
    assert np.array_equal(low_at, data.axis[values.argmin(axis=0)])
    assert np.array_equal(high_at, data.axis[values.argmax(axis=0)])


def test_single_precision_rounds_once(tmp_path):
    with open_database(builders.dynamic_database(tmp_path / "run.dst")) as database:
        data = database.foundation("F1")
        exact = builders.field("lateral_force", np.sin(data.axis), data.depth)
        assert np.array_equal(data.read("lateral_force"), exact.astype(np.float32))


def test_running_database_shows_committed_rows_only(tmp_path):
    grids = [builders.grid("F1")]

    def rows(first: int, last: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        axis = np.arange(first, last)
        return axis, builders.row_values("dynamic", grids, axis)

    out = Writer(
        tmp_path / "run.dst", kind="dynamic", title="", deck_text="", grids=grids, loads=(), block=4
    )
    with out:
        with open_database(out.path) as database:
            data = database.foundation("F1")
            assert data.axis.shape == (0,)
            assert data.read("lateral_force").shape == (0, len(builders.DEPTH))
            with pytest.raises(UserError, match="holds no rows yet"):
                data.envelope("lateral_force")
        out.append(*rows(0, 5))
        out.append(*rows(5, 7))
        with open_database(out.path) as database:
            data = database.foundation("F1")
            assert database.status == "running"
            assert data.axis.tolist() == [0, 1, 2, 3, 4]
            out.flush()  # what is open already does not change
            assert data.read("lateral_force").shape == (5, len(builders.DEPTH))
            high = data.envelope("lateral_force")[1]
            assert np.array_equal(high, data.read("lateral_force").max(axis=0))
        with open_database(out.path) as database:
            assert len(database.foundation("F1").axis) == 7
        out.finish("complete")
