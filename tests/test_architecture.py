"""Imports point one way, files stay small, and only the command line prints."""

import ast
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[1] / "src" / "podeep"

#: Every module, lowest first: a file imports only from files above it in this list.
ORDER = """
__init__ arrays errors files units subject tubes motion lines scene
soil.__init__ soil.group soil.polyline soil.way soil.law
seabed.__init__ seabed.parameters seabed.bearing seabed.at_rest seabed.law seabed.powers
seabed.verley_lund seabed.f114 seabed.dnv14 seabed.audibert seabed.models seabed.stiffness
seabed.lay seabed.bounds seabed.pull_out
deck.__init__ deck.faults deck.scan deck.column deck.curve_columns deck.ground_keywords
deck.py_keyword deck.tz_keyword deck.structure_keywords deck.action_keywords deck.motion_keywords
deck.analysis_keywords deck.seabed_keyword deck.line_keywords deck.keywords deck.cells
deck.registry deck.paragraphs deck.curves deck.ground
deck.structure deck.lines deck.seabed deck.seabed_contacts deck.foundations deck.actions
deck.steps deck.histories deck.line_motions deck.ties deck.dynamics deck.read
soil.backbone soil.soft_clay soil.sand soil.initial_line soil.stiff_clay
soil.weak_rock
soil.reese_sand soil.iso_clay soil.pisa_fits soil.pisa soil.lateral soil.axial soil.layering
soil.layers soil.surroundings soil.kinds soil.equivalent soil.reaction soil.profile soil.curves
soil.memory soil.energy soil.masing soil.degrading soil.sliders soil.iwan soil.approach soil.gap
soil.near_field soil.series soil.py_simple soil.tz_simple soil.qz_simple soil.tip_memory
soil.secant soil.memory_of
soil.lateral_capacity soil.axial_capacity soil.required_length soil.spudcan soil.spudcan_bearing
soil.spudcan_yield
seabed.normal seabed.friction seabed.suction
seabed.hyperbolic seabed.breakout
beam.__init__ beam.shapes beam.strings beam.rows beam.field beam.band beam.bubbles
model.__init__ model.needs model.mesh model.weave model.compression model.contact model.points
model.moduli model.springs model.system model.many model.mean model.footing model.holds model.weight
model.around model.assemble model.inertia model.remember
model.recover model.results model.moved model.coupling model.effects model.grid
solve.__init__ solve.newton solve.advance solve.yielding solve.rubbing solve.statics solve.loaded
solve.bordered solve.continuation solve.path solve.together solve.prolong solve.across solve.refine
solve.accuracy solve.analysis solve.diagnosis
solve.equations solve.stage solve.integrators solve.conserving solve.drive solve.moving solve.body
solve.starts solve.mover solve.dynamics solve.simulate solve.resume
solve.eigen solve.families solve.about_state solve.modes solve.ready solve.plan solve.adaptive
solve.pace
line.__init__ line.rod line.rod_step line.catenary line.boundary_layer line.pulled line.peel
line.free_span line.bed line.equations
line.statics line.results line.assemble line.analysis line.moving line.motion
database.__init__ database.variable database.foundation_variables database.line_variables
database.schema database.envelope database.grids database.rows database.layout database.target
database.stream database.trust database.restart database.write database.stored
database.foundation database.read
named demand embedded capacity
risks.__init__ risks.ranges risks.risk risks.curves risks.site risks.piles risks.bearing
risks.motion risks.seabed risks.lines
checks record describe_motion describe_lines describe report stiffness seabed_report
capacity_report query table picture figure
soil_figure modes_report modes_figure
session.__init__ session.question session.console session.points session.flow session.terminal
session.cases session.result
line_record line_report motion_record line_motion_record resume motion_log run_motion run
study.__init__ study.chart study.settings study.measure study.line_settings study.line_measure
study.chart_report study.chart_figure
study.oscillator study.trials study.limits study.stability study.stability_report
study.stability_figure
study.motion_settings study.motion_chart study.motion_history study.motion_base
study.motion_measure study.motion_report study.motion_figure
cli.__init__ cli.common cli.podeep cli.chart cli.modes cli.stiffness cli.solve
""".split()

FILES = sorted(SOURCE.rglob("*.py"))


def name_of(file: Path) -> str:
    return ".".join(file.relative_to(SOURCE).with_suffix("").parts)


def imported(file: Path) -> set[str]:
    """Modules of the package that a file imports anywhere, also inside functions."""
    package = file.relative_to(SOURCE).parts[:-1]
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            stem = ".".join((*base, *(node.module.split(".") if node.module else ())))
            for alias in node.names:
                inner = f"{stem}.{alias.name}" if stem else alias.name
                known = inner if inner in ORDER else stem or "__init__"
                found.add(known if known in ORDER else f"{known}.__init__")
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else [node.module]
            found.update(n for n in names if n and n.split(".")[0] == "podeep")
    return found


def test_the_list_names_every_file_once() -> None:
    assert sorted(ORDER) == sorted(name_of(f) for f in FILES)


@pytest.mark.parametrize("file", FILES, ids=name_of)
def test_imports_point_up_the_list(file: Path) -> None:
    place = ORDER.index(name_of(file))
    below = {m for m in imported(file) if m not in ORDER or ORDER.index(m) >= place}
    assert not below, f"{name_of(file)} imports {below}, which stand below it or nowhere"


EVERY = [*FILES, *Path(__file__).parent.rglob("*.py"), *(SOURCE.parents[1] / "docs").rglob("*.py")]


@pytest.mark.parametrize("file", EVERY, ids=str)
def test_no_file_is_two_rooms_in_one(file: Path) -> None:
    assert len(file.read_text(encoding="utf-8").splitlines()) <= 400


@pytest.mark.parametrize("file", [f for f in FILES if f.parent.name != "cli"], ids=name_of)
def test_only_the_command_line_prints(file: Path) -> None:
    calls = [n.func for n in ast.walk(ast.parse(file.read_text())) if isinstance(n, ast.Call)]
    assert not [c for c in calls if isinstance(c, ast.Name) and c.id in ("print", "input")]


def test_the_import_check_sees_deferred_imports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    planted = tmp_path / "units.py"
    planted.write_text("def f():\n    from .scene import Scene\n    return Scene\n")
    monkeypatch.setattr("test_architecture.SOURCE", tmp_path)
    assert imported(planted) == {"scene"}
    assert ORDER.index("scene") > ORDER.index(name_of(planted))


def _names(text: str) -> set[str]:
    return {
        n.module for n in ast.walk(ast.parse(text)) if isinstance(n, ast.ImportFrom) and n.module
    }
