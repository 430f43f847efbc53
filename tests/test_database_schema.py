"""The schema's table, and that what is written follows it for whoever reads it."""

from itertools import product
from pathlib import Path

import h5py
import netCDF4
import numpy as np
import pytest
import xarray

import builders
from podeep.database.schema import TABLES, places, variables
from podeep.database.variable import KINDS
from podeep.subject import SUBJECTS

UNITS = {"m", "N m-1", "1", "N", "N m", "Pa", "rad", "s", "axis", ""}
ENGINES = ("h5netcdf", "netcdf4")


@pytest.fixture(params=[*product(KINDS, (False, True))], ids=str)
def database(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    kind, spatial = request.param
    make = builders.static_database if kind == "static" else builders.dynamic_database
    return make(tmp_path / "run.h5", spatial=spatial, foundations=("F2", "F10"))


def schema_of(path: Path) -> dict[str, tuple[str, ...]]:
    """Path and dimensions of every variable that the file should have in F2."""
    with h5py.File(path) as file:
        kind, spatial = file.attrs["kind"], "lateral_axis" not in file["F2"].attrs
    table = variables(kind, spatial=spatial, loads=kind == "static")
    return {place: variable.dims for place, variable, _ in places(table, builders.TUBES)}


@pytest.mark.parametrize("subject", SUBJECTS, ids=lambda s: s.name)
def test_table_is_consistent(subject):
    table = TABLES[subject.name]
    names = [(v.group, v.name) for v in table]
    assert len(names) == len(set(names))
    assert {v.units for v in table} <= UNITS
    assert all(v.long_name for v in table)
    assert {v.name for v in table} >= {*subject.quantities, *subject.slopes.values()}
    shown = {v.name: v.dims for v in table if v.name in subject.quantities}
    assert set(shown.values()) == {("axis", subject.coordinate)}
    assert set(shown) >= set(subject.slopes)


@pytest.mark.parametrize("subject", SUBJECTS, ids=lambda s: s.name)
@pytest.mark.parametrize(("kind", "spatial"), [*product(KINDS, (False, True))])
def test_a_scale_comes_before_its_users(kind, spatial, subject):
    known = set()
    table = variables(kind, spatial=spatial, loads=True, subject=subject)
    for _, variable, _ in places(table, [1, 2]):
        if variable.is_scale:
            known.add(variable.name)
        assert set(variable.dims) <= known


def test_components_only_in_spatial_databases():
    planar = {v.name for v in variables("static", spatial=False, loads=True)}
    spatial = {v.name for v in variables("static", spatial=True, loads=True)}
    more = {
        f"lateral_{name}_{axis}" for name in ("displacement", "slope", "force") for axis in "xy"
    }
    assert spatial - planar == more
    assert planar <= spatial


def test_no_load_factor_without_loads():
    assert not [v for v in variables("static", spatial=False, loads=False) if "load" in v.dims]


def test_netcdf_sees_every_variable_with_its_dimensions(database):
    with netCDF4.Dataset(database) as file:
        group = file["F2"]
        for path, dims in schema_of(database).items():
            variable = group[path]
            assert variable.dimensions == dims
            assert variable.long_name
        for tube, elevation in builders.TUBES.items():
            assert group[f"tubes/{tube}/moment_x"].shape[1] == len(elevation)
        assert list(file.groups) == ["input", "F2", "F10"]
        assert file["input"]["deck"][...] == builders.DECK


def test_values_have_their_precision(database):
    with h5py.File(database) as file:
        result = {"static": np.float64, "dynamic": np.float32}[file.attrs["kind"]]
        group = file["F2"]
        assert group["lateral_force"].dtype == result
        assert group["tubes/7/moment_x"].dtype == result
        assert group["depth"].dtype == group["tubes/7/elevation"].dtype == np.float64
        assert group["envelope/axial_force_max_at"].dtype == np.float64


@pytest.mark.parametrize("engine", ENGINES)
def test_xarray_opens_every_group(database, engine):
    with xarray.open_dataset(database, engine=engine) as root:
        assert root.attrs["Conventions"].startswith("CF-")
        assert root.attrs["schema"] == "podeep-soil"
    for group in ("", "/envelope", "/estimate", "/convergence", "/tubes/7"):
        with xarray.open_dataset(database, engine=engine, group=f"F10{group}") as data:
            data.load()
            assert data.variables


@pytest.mark.parametrize("engine", ENGINES)
def test_xarray_has_coordinates_and_values(tmp_path, engine):
    path = builders.static_database(tmp_path / "run.dss")
    with xarray.open_dataset(path, engine=engine, group="F1") as data:
        assert data.coords.keys() == {"step", "depth", "load"}
        assert data["load"].values.tolist() == ["H", "V"]
        assert data["depth"].attrs["positive"] == "down"
        assert data["lateral_force"].attrs["units"] == "N m-1"
        assert "lateral_axis" in data["lateral_force"].attrs["comment"]
        at = data["axial_displacement"].sel(step=2, depth=7.5).item()
    assert at == pytest.approx(2 * 0.002 * np.exp(-7.5 / 40.0), rel=1e-15)


def test_nothing_but_plain_types_and_hard_links(database):
    helpers = {"DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "_Netcdf4Dimid"}
    plain = "fiO"  # floats, integers, variable-length strings

    def check(name: str, item: h5py.Group | h5py.Dataset) -> None:
        assert isinstance(item.parent.get(item.name.split("/")[-1], getlink=True), h5py.HardLink)
        kinds = [item.attrs.get_id(a).dtype for a in item.attrs if a not in helpers]
        if isinstance(item, h5py.Dataset):
            kinds.append(item.dtype)
        for kind in kinds:
            assert kind.kind in plain
            assert kind.kind != "O" or h5py.check_string_dtype(kind).encoding == "utf-8"

    with h5py.File(database) as file:
        assert file.userblock_size == 0
        file.visititems(check)


def test_every_axis_has_its_scale(database):
    with h5py.File(database) as file:
        for path, dims in schema_of(database).items():
            data = file["F2"][path]
            if not data.is_scale:
                attached = [dimension[0].name.split("/") for dimension in data.dims]
                assert tuple(parts[-1] for parts in attached) == dims
                assert all(path.startswith("/".join(parts[2:-1])) for parts in attached)
