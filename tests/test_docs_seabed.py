"""The page on the stiffness of the seabed: what commands print, its models, its numbers."""

import re
import shlex
from math import pi, radians

import numpy as np
import pytest

from manual import DOCS
from podeep.cli.solve import main
from podeep.seabed import bearing
from podeep.seabed.models import MODELS
from podeep.seabed.parameters import PARAMETERS, PIPE
from test_docs import whole_deck

PAGE = (DOCS / "seabed_stiffness.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"```sh\n(podeep-solve .*?)```\n\n```text\n(.*?)```\n", PAGE, re.S)


def says(*parts):
    text = re.sub(r"\s+", " ", PAGE)
    for part in parts:
        assert part in text, part


@pytest.mark.parametrize(("command", "printed"), SHOWN, ids=["clay", "sand"])
def test_the_tables_are_what_the_command_prints(command, printed, capsys):
    _, *arguments = shlex.split(command.replace("\\\n", ""))
    assert main(arguments) == 0
    out, err = capsys.readouterr()
    assert out == printed
    assert err == ""
    assert max(map(len, (command + out).splitlines())) <= 80


def test_every_model_has_its_heading_and_is_shown():
    named = re.findall(r"^### (.*)", PAGE, re.M)
    assert sorted(", ".join(named).split(", ")) == sorted(MODELS)
    tables = "".join(printed for _, printed in SHOWN)
    assert all(f"\n{name} " in tables for name, model in MODELS.items() if model.soil)


def test_every_parameter_of_a_soil_is_in_the_table():
    (table,) = re.findall(r"^\| symbol \|.*?\n\n", PAGE, re.M | re.S)
    cells = [row.split("|")[2:4] for row in table.strip().splitlines()[2:]]
    columns, options = (
        set(re.findall(r"`([^`=]+)=?`", " ".join(column))) for column in zip(*cells, strict=True)
    )
    used = [p for m in MODELS.values() for p in m.parameters]
    assert columns == {p.symbol for p in used}
    assert options == {p.option for p in used if p.option} | {PARAMETERS[k].option for k in PIPE}


def test_the_deck_lines_are_read(tmp_path, capsys):
    (block,) = re.findall(r"^```text\n(\*SOILSTIFF.*?)^```", PAGE, re.M | re.S)
    path = tmp_path / "a.deck"
    curve = "*PYCURVE\n1 2 10e3 35 22e6\n"
    path.write_text(whole_deck(block + curve), encoding="utf-8")
    assert main(["stiffness", str(path), "--diameter", "0.3", "--weight", "800"]) == 0
    names = re.findall(r"^(\d) (\w+) +(?:printed|given)", capsys.readouterr().out, re.M)
    assert names == re.findall(r"^(\d) (\w+) ", block, re.M)


def example(name, **other):
    (row,) = (w.replace("\\\n", "") for w, p in SHOWN if f"\n{name} " in p)
    pairs = dict(re.findall(r"--([\w-]+) ([\d.e]+)", row))
    by_option = {p.option: p for p in PARAMETERS.values()}
    given = {by_option[f"--{k}"].key: by_option[f"--{k}"].taken(float(v)) for k, v in pairs.items()}
    law = MODELS[name].at(given["diameter"], given | other)
    return float(law.penetration(given["weight"]))


def test_numbers_in_prose():
    angles = np.radians((30.0, 35.0, 40.0))
    printed = np.exp(np.arctan(angles)) * np.tan(pi / 4 + angles / 2) ** 2
    more = example("VERLEYLUND", verley_lund_unit_weight=5e3) / example("VERLEYLUND")
    less = example("DNV14SAND", self_weight_factor=1.5) / example("DNV14SAND")
    says(
        "{:.2f}, {:.2f} and {:.2f}, not".format(*printed),
        "not {:.2f}, {:.2f} and {:.2f}".format(*bearing.sand_factors(angles)[0]),
        f"gives {100 * (more - 1):.0f} % more penetration",
        f"$z$ then grows by {100 * (less - 1):.0f} %",
        f"$K_d$ would be {1e3 / 1e3**0.5:.0f} times too small",
        f"At $z/D = {(6 / (3.4 * 10**0.5)) ** 4:.3f}$ the minimum changes sides",
    )
    assert bearing.sand_factors(radians(30.0), 1.5)[1] < bearing.sand_factors(radians(30.0))[1]


@pytest.mark.parametrize("start", ["infinite", "0 there"])
def test_slopes_at_rest(start):
    """The models named in brackets start infinitely stiff, or with no stiffness."""
    (named,) = re.findall(rf"it is {start}[^(]*\(([A-Z0-9, \s]+)\)", PAGE)
    strength = {"undrained_shear_strength": 5e3, "verley_lund_unit_weight": 18e3}
    strength |= {"effective_unit_weight": 5e3, "friction_angle": 0.6}
    strength |= {"given_static_stiffness": 1e5, "given_dynamic_stiffness": 1e6}
    slopes = {
        name: float(model.at(0.3, strength).stiffness(np.zeros(1))[0])
        for name, model in MODELS.items()
    }
    wanted = np.inf if start == "infinite" else 0.0
    assert named.split(", ") == [name for name, slope in slopes.items() if slope == wanted]
