"""Lines in a database: what comes back is what was written, beside foundations and alone."""

from pathlib import Path

import h5py
import netCDF4
import numpy as np
import pytest
import xarray

import builders
import risers
from podeep.database.read import FoundationData, LineData, open_database
from podeep.database.schema import places, variables
from podeep.database.write import LineGrid, Writer
from podeep.errors import UserError
from podeep.subject import LINE
from test_database_hostile import HUGE, attribute, instead, linked, refused, value, without

STEPS = np.arange(6)
SHAPE = (6, 81)


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return risers.static_database(
        tmp_path_factory.mktemp("lines") / "run.dss",
        lines=("L2", "L10"),
        foundations=("F3",),
        loads=("H", "V"),
    )


def test_foundations_and_lines_stand_side_by_side(both):
    with open_database(both) as database:
        assert database.names == ("F3", "L2", "L10")
        assert database.foundations == ("F3",)
        assert database.lines == ("L2", "L10")
        assert isinstance(database["F3"], FoundationData)
        assert isinstance(database["L10"], LineData)
        assert database["L2"] is database.line("L2")
        with pytest.raises(UserError, match="no line F3; it has F3, L2, L10"):
            database.line("F3")
        with pytest.raises(UserError, match="no foundation L2; it has F3, L2, L10"):
            database.foundation("L2")


def test_every_value_of_a_line_comes_back(both):
    with open_database(both) as database:
        for name in database.lines:
            data = database.line(name)
            assert np.array_equal(data.points, risers.DISTANCE)
            assert np.array_equal(data.axis, STEPS)
            assert data.mudline == risers.MUDLINE
            assert data.layer_boundaries.size == 0
            assert not data.spatial
            assert data.load_factor.tolist() == [[s, 2 * s] for s in STEPS]
            written = risers.riser(risers.DISTANCE, STEPS)
            for quantity, values in written.items():
                assert np.array_equal(data.read(quantity), values)
            assert set(written) >= set(map(LINE.stored, LINE.quantities))


def test_its_envelopes_are_over_all_steps_and_tell_when(both):
    with open_database(both) as database:
        written = risers.riser(risers.DISTANCE, STEPS)
        for quantity in LINE.quantities:
            low, high, low_at, high_at = database.line("L2").envelope(quantity)
            values = written[LINE.stored(quantity)]
            assert np.array_equal(low, values.min(axis=0))
            assert np.array_equal(high, values.max(axis=0))
            assert np.array_equal(low_at, values.argmin(axis=0))
            assert np.array_equal(high_at, values.argmax(axis=0))


def test_a_line_changes_no_byte_of_what_stands_beside_it(both, tmp_path):
    alone = builders.static_database(tmp_path / "alone.dss", steps=5, foundations=("F3",))
    with h5py.File(both) as first, h5py.File(alone) as second:
        assert list(first["F3"].attrs) == list(second["F3"].attrs)
        same = []
        second["F3"].visititems(lambda name, item: same.append(name))
        assert len(same) > 40
        for name in same:
            if isinstance(second["F3"][name], h5py.Dataset):
                assert np.array_equal(first["F3"][name][...], second["F3"][name][...])


def test_lines_in_motion_open_at_any_row(tmp_path):
    times = np.linspace(0.0, 10.0, 50)
    path = risers.dynamic_database(tmp_path / "run.dst", times=times, block=7)
    written = risers.riser(risers.DISTANCE, risers.amplitude("dynamic", times))
    with open_database(path) as database:
        data = database.line("L1")
        assert np.array_equal(data.read("penetration", [40, 3]), written["penetration"][[40, 3]])
        assert np.array_equal(data.envelope("penetration")[1], written["penetration"].max(axis=0))


def test_the_partial_of_a_line_opens(tmp_path):
    times, grids = np.linspace(0.0, 1.0, 8), [risers.grid()]
    arguments = {"kind": "dynamic", "title": "", "deck_text": "", "grids": grids, "loads": ()}
    with Writer(tmp_path / "run.dst", **arguments) as out:
        out.append(times, risers.row_values("dynamic", grids, times))
        out.flush()
        with open_database(out.path) as database:
            data = database.line("L1")
            lowest = data.read("penetration").min(axis=0)
            assert np.array_equal(data.envelope("penetration")[0], lowest)
            assert len(data.axis) == 8


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_opens_a_line(both, engine):
    with xarray.open_dataset(both, engine=engine, group="L10") as data:
        assert data.coords.keys() == {"step", "distance", "load"}
        assert data["distance"].attrs["units"] == "m"
        assert "end 1" in data["distance"].attrs["comment"]
        assert data["normal_reaction"].attrs["units"] == "N m-1"
        assert "suction" in data["normal_reaction"].attrs["comment"]
        assert data["penetration"].sel(step=5, distance=38.0).item() == 0.012
        assert data["touchdown_distance"].values.tolist() == [60.0, 56.0, 52.0, 48.0, 44.0, 40.0]
    for group in ("line", "envelope", "estimate", "convergence"):
        with xarray.open_dataset(both, engine=engine, group=f"L10/{group}") as data:
            data.load()
            assert data.variables
    with xarray.open_dataset(both, engine=engine, group="L10/line") as shape:
        assert shape["effective_tension"].dims == ("step", "distance")
        assert {"position_x", "position_y", "position_z", "bending_moment"} <= set(shape)


def test_netcdf_sees_every_variable_with_its_dimensions(both):
    table = variables("static", spatial=False, loads=True, subject=LINE)
    with netCDF4.Dataset(both) as file:
        assert list(file.groups) == ["input", "F3", "L2", "L10"]
        for path, variable, igr in places(table, ()):
            assert igr is None
            assert file["L2"][path].dimensions == variable.dims
            assert file["L2"][path].long_name


@pytest.mark.parametrize("distance", [np.empty(0), np.array([0.0, 2.0, 2.0])])
def test_impossible_distances(distance):
    with pytest.raises(ValueError, match="L1: distances do not increase"):
        LineGrid("L1", distance, -80.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda v: v.pop("L1/penetration"), "missing: .*L1/penetration"),
        (lambda v: v.update({"L1/lateral_slope": np.zeros(SHAPE)}), "unknown: .*L1/lateral_slope"),
        (lambda v: v.update({"L1/penetration": np.zeros((6, 80))}), r"\(6, 80\) is not \(6, 81\)"),
        (lambda v: v["L1/line/bending_moment"].__setitem__((1, 2), np.nan), "not finite"),
    ],
)
def test_bad_rows_of_a_line_are_a_fault_of_the_program(tmp_path, change, message):
    grids = [risers.grid()]
    values = risers.row_values("static", grids, STEPS)
    change(values)
    arguments = {"kind": "static", "title": "", "deck_text": "", "grids": grids, "loads": ()}
    with Writer(tmp_path / "run.dss", **arguments) as out, pytest.raises(ValueError, match=message):
        out.append(STEPS, values)


PUSH, AT = "L1/normal_reaction", "L1/distance"
CHANGES = {
    "neither": (without("L1"), "holds no foundation and no line"),
    "line is a variable": (linked("L1", np.arange(3)), "L1 is no group"),
    "external line": (linked("L1", h5py.ExternalLink("x.h5", "/")), "link to elsewhere"),
    "no mudline": (lambda f: f["L1"].attrs.__delitem__("mudline"), "mudline of L1 is missing"),
    "no distance": (without(AT), "distance is missing"),
    "distance falls": (value(AT, 4, 1.0), "distance does not hold finite, rising values"),
    "distance not finite": (value(AT, 80, np.inf), "distance does not hold finite, rising"),
    "float32 distance": (instead(AT, data=np.arange(81, dtype="f4")), "is of type float32"),
    "flat distance": (instead(AT, data=np.zeros((9, 9))), "L1/distance is no coordinate"),
    "missing variable": (without(PUSH), "normal_reaction is missing"),
    "wrong shape": (instead(PUSH, data=np.zeros((6, 80))), "its dimensions .6, 81."),
    "wrong units": (attribute(PUSH, "units", "kN m-1"), "in 'kN m-1', not in 'N m-1'"),
    "no shape of the line": (without("L1/line"), "line/position_x is missing"),
    "line/ is a variable": (linked("L1/line", np.zeros(3)), "line/position_x is missing"),
    "value not finite": (value(PUSH, (2, 3), np.nan), "normal_reaction holds values that are not"),
    "moment not finite": (value("L1/line/bending_moment", (0, 0), np.inf), "values that are not"),
    "envelope cut": (
        instead("L1/envelope/penetration_min", data=np.zeros(80)),
        "shape .80,., its dimensions .81,.",
    ),
    "huge, not stored": (
        lambda f: [
            instead("L1/step", shape=(HUGE,), dtype="i4")(f),
            instead(PUSH, shape=(HUGE, 81), dtype="f8")(f),
        ],
        "declares",
    ),
}


@pytest.mark.parametrize("case", CHANGES)
def test_changed_lines_are_refused_in_words(tmp_path, case):
    path = risers.static_database(tmp_path / "run.dss")
    change, message = CHANGES[case]
    with h5py.File(path, "r+") as file:
        change(file)
    refused(path, message)
