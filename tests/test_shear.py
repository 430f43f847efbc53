"""Tubes soft in shear against CF15, Timoshenko's beam on Winkler soil."""

import csv
from pathlib import Path

import numpy as np
import pytest

from decks import deck, solved
from podeep.beam.field import Field
from podeep.cli.solve import main
from podeep.database.read import Database
from podeep.scene import Section

EI, GAS, K = 50e9, 4e9, 200e6
with (Path(__file__).parent / "data" / "valid" / "CF15_profiles.csv").open() as file:
    ROWS = list(csv.DictReader(file))
LOADS = {
    "H": ("1e6 0 0", ""),
    "M0": ("0 0 0 0 5e6 0", ""),
    "H_fixed": ("1e6 0 0", "*SUPPORT\n1 0 RY"),
}


def pile(load: str, held: str, extra: str = "") -> str:
    return deck(
        title="CF15",
        depths=(0.0,),
        moduli=(K,),
        casing=[f"0 -60 1 0.05 210e9 7850 EI={EI!r} GAS={GAS!r}"],
        actions=[*([held] if held else []), f"*LOAD\nHEAD 1 0 {load}"],
        extra=f"*MODEL, SHEAR=ON\n{extra}",
    )


def errors(database: Database, case: str) -> dict[str, float]:
    """Errors of displacement, rotation and moment at the depths of the case that are written."""
    rows = [row for row in ROWS if row["case"] == case]
    z, y, psi, M = (np.array([float(r[n]) for r in rows]) for n in ("z_m", "y_m", "psi", "M_Nm"))
    tube = database.foundation("F1")
    depth = -tube.elevations[1]
    found = {
        name: tube.read_tube(1, name, -1)[0]
        for name in ("displacement_x", "rotation_y", "moment_y")
    }
    at = np.abs(depth[:, None] - z).argmin(axis=0)
    keep = np.abs(depth[at] - z) < 2e-6
    assert keep.sum() > 10
    pairs = (("displacement_x", y), ("rotation_y", -psi), ("moment_y", M))
    return {
        name: float(np.abs(found[name][at[keep]] - exact[keep]).max() / np.abs(exact).max())
        for name, exact in pairs
    }


@pytest.mark.parametrize("case", LOADS)
def test_profiles_of_cf15(tmp_path, case):
    with solved(tmp_path, pile(*LOADS[case], "*ACCURACY\n1e-6\n")) as database:
        found = errors(database, case)
    assert max(found.values()) < 1e-5, found


def test_observed_order_of_the_head():
    """Deflections of degree 5: order 6 of the head, that of the moment's balance."""
    import test_moment_springs as springs
    from podeep.model.around import quadrature
    from podeep.model.points import Points
    from podeep.model.system import System
    from podeep.solve.newton import Limits, newton

    exact = float(next(r["y_m"] for r in ROWS if r["case"] == "H"))
    errors = []
    for count in (10, 20, 40):
        edges = np.linspace(0.0, 60.0, count + 1)
        field = Field(edges, np.full(count, EI), 5, 1, 1.0, np.full(count, GAS))
        x, weight = quadrature(edges, np.arange(count), 5)
        points = [Points(x, weight, springs.reaction(K, len(x)))]
        system = System(field, 1, points, [], np.zeros(0, dtype=np.intp))
        load = np.zeros(field.size)
        load[0] = 1e6
        errors.append(abs(newton(system, 0.0 * load, load, Limits(1e-12)).q[0] / exact - 1.0))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 5.5).all()


@pytest.mark.parametrize("degree", [3, 4, 5, 6, 7])
def test_the_section_turns_as_its_nodes_say_and_rigid_tubes_as_their_slope(degree):
    edges = np.array([0.0, 1.0, 3.0])
    soft = Field(edges, np.ones(2), degree, 1, 2.0, np.array([0.5, 8.0]))
    ends = soft.rotation(edges).toarray()
    nodes = [soft.node(x) for x in edges]
    for row, node in zip(ends, nodes, strict=True):
        expected = np.zeros(soft.size)
        expected[node + 1] = 1.0 / 2.0  # the unknown is the rotation times the slope's length
        np.testing.assert_allclose(row, expected, atol=1e-8)
    rigid = Field(edges, np.ones(2), degree, 1, 2.0)
    nearly = Field(edges, np.ones(2), degree, 1, 2.0, np.full(2, 1e14))
    x = np.linspace(0.0, 3.0, 13)
    np.testing.assert_allclose(
        nearly.interpolation(x).toarray(), rigid.interpolation(x).toarray(), atol=1e-9
    )
    np.testing.assert_allclose(
        nearly.element_stiffness, rigid.element_stiffness, rtol=1e-9, atol=1e-9
    )


@pytest.mark.parametrize("degree", [3, 5, 7])
def test_rigid_motions_cost_no_energy_and_strains_are_those_of_the_matrix(degree):
    edges = np.array([0.0, 0.5, 2.0])
    field = Field(edges, np.array([3.0, 5.0]), degree, 1, 1.0, np.array([2.0, 0.7]))
    shift, turn = np.zeros(field.size), np.zeros(field.size)
    for x in edges:
        node = field.node(x)
        shift[node] = 1.0
        turn[node], turn[node + 1] = x, 1.0
    rows, stiffness = field.strain_modes
    modes = rows.toarray()
    for rigid in (shift, turn):
        assert abs(modes @ rigid).max() < 1e-12
    matrix = (modes.T * stiffness) @ modes
    whole = np.zeros((field.size, field.size))
    for dofs, element in zip(field.dofs, field.element_stiffness, strict=True):
        whole[np.ix_(dofs, dofs)] += element
    np.testing.assert_allclose(matrix, whole, atol=1e-11 * abs(whole).max())


def test_a_thin_tube_and_a_bar_have_cowpers_areas():
    """nu 0.3: 0.53 of the area of a thin tube, 0.886 of a solid one."""
    for wall, share in ((1e-6, 0.5306), (0.5, 0.8864)):
        section = Section(0.0, -1.0, 1.0, wall, 2.6, 1.0)
        assert section.shear_stiffness / section.area == pytest.approx(share, rel=2e-4)


def test_shear_of_a_section_of_given_bending_stiffness_must_be_given_too(tmp_path, capsys):
    path = tmp_path / "a.deck"
    path.write_text(pile("1e6 0 0", "").replace(f" GAS={GAS!r}", ""))
    assert main(["check", str(path)]) == 2
    assert "SHEAR=ON, but a section of given EI has no GAS" in capsys.readouterr().err
