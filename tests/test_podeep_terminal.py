"""Sessions at a real pseudo-terminal."""

import os
import re
from io import StringIO
from pathlib import Path

import pexpect
import pytest

from builders import static_database
from test_podeep_transcripts import COMMAND

ESCAPE = re.compile(r"\x1b(\[[0-9;?]*[A-Za-z]|\][^\x07]*\x07|[=>])")
BACKSPACE, UP, CTRL_C, CTRL_D = "\x7f", "\x1b[A", "\x03", "\x04"


class Terminal:
    """The command at a terminal."""

    def __init__(self, command, **environment):
        self.log = StringIO()
        self._child = pexpect.spawn(
            command[0],
            command[1:],
            env={**os.environ, "TERM": "xterm", **environment},
            encoding="utf-8",
            dimensions=(40, 100),
            timeout=60,
        )
        self._child.logfile_read = self.log

    def see(self, text):
        self._child.expect_exact(text)

    def type(self, text):
        self._child.send(text)

    def end(self):
        """Exit code once the command has ended."""
        self._child.expect(pexpect.EOF)
        self._child.close()
        return self._child.exitstatus

    def screen(self):
        return ESCAPE.sub("", self.log.getvalue())


@pytest.fixture
def terminal(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    static_database(Path("run.dss"))
    return lambda *arguments, **more: Terminal([*COMMAND, "run", *arguments], **more)


def to_types(terminal):
    for seen, typed in (("Exit", "g"), ("exit<q>", "f")):
        terminal.see(seen)
        terminal.type(f"{typed}\r")
    terminal.see("Type of results:")
    terminal.see("Exit")


def test_a_whole_session(terminal):
    session = terminal()
    to_types(session)
    session.type("l\r")
    for text, answer in (
        ("First depth below the mudline (m):", "0"),
        ("Second depth below the mudline (m):", "30"),
        ("Number of calculation points:", "4"),
        ("Number of the quasi-static step:", "3"),
    ):
        session.see(text)
        session.type(f"{answer}\r")
    session.see("0.0014936")
    session.see("Picture: run_static_snapshot_lateral_displacement.png")
    session.see("Exit")
    session.type("q\r")
    assert session.end() == 0
    assert Path("run_static_snapshot_lateral_displacement.png").exists()


def test_a_refused_answer_says_why_and_stays_editable(terminal):
    session = terminal("--no-plot")
    session.see("Exit")
    session.type("z\r")
    session.see("'z' is not one of g, q")
    session.type(f"{BACKSPACE}g\r")
    session.see("exit<q>")
    session.type("f\r")
    session.see("Exit")
    session.type("l\r")
    session.see("First depth")
    session.type("55\r")
    session.see("55 m is outside 0 to 30 m")
    session.type(f"{BACKSPACE}\r")  # what is left is 5
    session.see("Second depth")
    session.type("5\r")
    session.see("1, as the two depths are equal")
    session.type("\r0\r")
    session.see("Depths      5 m below the mudline, 1 point")
    session.see("Exit")
    session.type(CTRL_D)
    assert session.end() == 0


def test_several_numbers_on_a_line_and_one_of_them_refused(terminal):
    session = terminal("--no-plot", "--record", "record")
    to_types(session)
    session.type("l\r")
    session.see("First depth")
    session.type("0, 99 7\r")
    session.see("99 m is outside 0 to 30 m")
    session.see("Second depth below the mudline (m):")
    session.type(f"{BACKSPACE}\r")  # the refused 99 stands there again; 9 is left
    session.see("Number of calculation points:")
    session.type("2 3 4\r")
    session.see("Step        3")
    session.see("Exit")
    session.see("Not asked for: 4")
    session.type(CTRL_D)
    assert session.end() == 0
    answers = [x for x in Path("record").read_text().splitlines() if not x.startswith("#")]
    assert answers == ["g", "f", "l", "0", "9", "2", "3", "q"]


def test_an_empty_answer_takes_the_proposal(terminal):
    session = terminal("--no-plot")
    to_types(session)
    session.type("l\r")
    session.see("First depth")
    session.type("0 30\r")
    session.see("2 or more, both ends included; Enter takes 10")
    session.type("\r")
    session.see("quasi-static step:")
    session.type("3\r")
    session.see("30 m below the mudline, 10 points")
    session.see("Exit")
    session.type("q\r")
    assert session.end() == 0


def test_ctrl_c_goes_up_one_menu_and_out_of_the_first(terminal):
    session = terminal("--record", "record")
    to_types(session)
    session.type("l\r")
    session.see("First depth")
    session.type(f"0\r1{CTRL_C}")
    session.see("Type of results:")
    session.see("Exit")
    session.type(CTRL_C)
    session.see("exit<q>")
    session.type(CTRL_C)
    session.see("Static soil results")
    session.see("Exit")
    session.type(CTRL_C)
    session.see("podeep: interrupted")
    assert session.end() == 130
    answers = [x for x in Path("record").read_text().splitlines() if not x.startswith("#")]
    assert answers == ["g", "f", "l", "0", "q", "o", "o"]


@pytest.mark.parametrize(
    "answers", [[], ["g"], ["g", "f"], ["g", "f", "l"], ["g", "f", "l", "0 1"]]
)
def test_ctrl_d_leaves_from_anywhere_even_with_text_on_the_line(terminal, answers):
    session = terminal("--record", "record")
    seen = ["Exit", "exit<q>", "Exit", "First depth", "Number of calculation"]
    for question, answer in zip(seen, answers, strict=False):
        session.see(question)
        session.type(f"{answer}\r")
    session.see(seen[len(answers)])
    session.type(f"1{CTRL_D}")
    assert session.end() == 0
    last = Path("record").read_text().splitlines()
    assert last[-1] == "q"
    assert len([x for x in last if x == "q"]) == (2 if len(answers) > 2 else 1)


def test_the_history_of_a_question_is_its_own(terminal):
    session = terminal("--no-plot")
    to_types(session)
    session.type("l\r")
    session.see("First depth")
    session.type("12\r")
    session.see("Second depth")
    session.type("q\r")
    session.see("Exit")
    session.type(f"{UP}\r")
    session.see("First depth")
    session.type(f"{UP}\r")
    session.see("Second depth")
    session.type(CTRL_D)
    assert session.end() == 0
    assert session.screen().count("First depth below the mudline (m): 12") == 2


def test_tab_completes(terminal):
    static_database(Path("run.dss"), foundations=("F1", "F2"), force=True)
    session = terminal()
    session.see("Exit")
    session.type("g\r")
    session.see("Foundation (F1, F2):")
    session.type("\t")
    session.see("F2")
    session.type("\t\r")
    session.see("exit<q>")
    session.type(CTRL_D)
    assert session.end() == 0


def test_no_color_means_no_color(terminal):
    session = terminal(NO_COLOR="1")
    session.see("Exit")
    session.type(f"z\r{CTRL_D}")
    assert session.end() == 0
    codes = re.findall(r"\x1b\[([0-9;]+)m", session.log.getvalue())
    assert not [c for code in codes for c in code.split(";") if re.fullmatch(r"[34][0-8]", c)]


def test_results_may_go_to_a_file_while_the_dialogue_is_at_the_terminal(terminal):
    parts = " ".join(f"'{part}'" for part in [*COMMAND, "run", "--no-plot"])
    session = Terminal(["sh", "-c", f"{parts} > table"])
    to_types(session)
    session.type("l\r0 30 2 1\r")
    session.see("Number of the quasi-static step: 1")
    session.see("Exit")
    session.type(CTRL_D)
    assert session.end() == 0
    assert Path("table").read_text().startswith("\nDatabase    run.dss (static)\n")
    assert "Database " not in session.screen()
