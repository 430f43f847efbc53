"""The dialogue: texts to the letter, rules of every number, ways up and out."""

from io import StringIO

import numpy as np
import pytest

from podeep.errors import AnswerRefused
from podeep.session.console import ScriptConsole, no_record
from podeep.session.flow import Source, converse
from podeep.session.points import Extent

STATIC_ANALYSES = "Step evolution <t>, Snapshot <f>, Other analysis <o>, exit<q>"
DYNAMIC_ANALYSES = "Step evolution <t>, Snapshot <f>, Envelop <e>, Other analysis <o>, exit<q>"
STATIC_TYPES = """\
Type of results:
Lateral displacement.............<l>
Lateral force....................<f>
Axial displacement...............<a>
Axial force......................<r>
Other............................<o>
Exit.............................<q>
"""
DYNAMIC_TYPES = """\
Type of results:
Lateral displacement.............<1>
Lateral force....................<2>
Axial displacement...............<3>
Axial force......................<4>
Other............................<5>
Exit.............................<q>
"""
DATABASES = """\
Static soil results..............<g>
Dynamic soil results.............<h>
Exit.............................<q>
"""

EXTENT = Extent((0.0, 30.0), np.arange(6))
TIMES = Extent((0.0, 30.0), np.linspace(0.0, 60.0, 601))
STATIC = Source("static", {"F1": EXTENT})
DYNAMIC = Source("dynamic", {"F1": TIMES})


def session(script, *sources, record=no_record, results=True):
    """The requests that a script leads to and its transcript."""
    requests, out = [], StringIO()
    console = ScriptConsole(script.splitlines(), "answers.txt", out, out, record)

    def answer(request):
        requests.append(request)
        if results:
            console.show("")

    converse(console, sources or (STATIC, DYNAMIC), answer)
    return requests, out.getvalue()


def refusal(script, *sources):
    with pytest.raises(AnswerRefused) as caught:
        session(script, *sources)
    assert caught.value.exit_code == 3
    return str(caught.value)


def test_menus_are_to_the_letter():
    _, out = session("g\nt\nl\n0 30 2\no\no\nh\ne\n1\n0 30 2\nq\n")
    assert out.startswith(DATABASES + "> g\n" + STATIC_ANALYSES + "\n> t\n" + STATIC_TYPES + "> l")
    assert f"> h\n{DYNAMIC_ANALYSES}\n> e\n{DYNAMIC_TYPES}> 1\n" in out
    assert "\nNumber of calculation points: 2\n" in out
    assert "\nNumber of divisions: 2\n" in out


def test_the_database_menu_offers_what_is_open():
    one = "Static soil results..............<g>\nExit.............................<q>\n> q\n"
    assert session("q", STATIC)[1] == one
    assert session("q", DYNAMIC)[1] == one.replace("Static", "Dynamic").replace(".<g", "<h")
    assert "'h' is not one of g, q" in refusal("h", STATIC)
    assert "'g' is not one of h, q" in refusal("g", DYNAMIC)


@pytest.mark.parametrize(
    ("signs", "quantity"),
    [
        ("l1L", "lateral_displacement"),
        ("f2F", "lateral_force"),
        ("a3A", "axial_displacement"),
        ("r4R", "axial_force"),
    ],
)
def test_type_menus_take_either_case_and_each_others_signs(signs, quantity):
    for sign in signs:
        for start, end in (("g\nf", "0 1 2 0"), ("h\nE", "0 1 2")):
            requests, _ = session(f"{start}\n{sign}\n{end}\n")
            assert [r.quantity for r in requests] == [quantity]


@pytest.mark.parametrize("sign", ["f", "x", "X"])
def test_snapshot_is_f_and_x(sign):
    assert session(f"g\n{sign}\nl\n0 1 2 0\n")[0][0].analysis == "snapshot"
    assert session(f"h\n{sign}\n1\n0 1 2\nb\n1\n")[0][0].analysis == "snapshot"


@pytest.mark.parametrize("numbers", ["0\n30\n4\n5", "0 30 4 5", "0,30\n4, 5", " 0 ,30 # m\n\n4\n5"])
def test_numbers_stand_one_a_line_or_several(numbers):
    requests, out = session(f"g\nf\nl\n{numbers}\nq")
    assert requests[0].points.tolist() == [0.0, 10.0, 20.0, 30.0]
    assert requests[0].at == (5.0,)
    assert (
        "First depth below the mudline (m): 0\nSecond depth below the mudline (m): 30\n"
        "Number of calculation points: 4\nSteps from 0 to 5\nNumber of the quasi-static step: 5\n"
    ) in out


def test_the_order_of_depths_does_not_matter():
    there, back = session("g\nt\nl\n0 30 4\nl\n30 0 4\n")[0]
    assert there.points.tolist() == back.points.tolist()


@pytest.mark.parametrize(
    ("answers", "reason", "asked"),
    [
        ("55", "55 m is outside 0 to 30 m", "First depth below the mudline (m)"),
        ("0 -1", "-1 m is outside 0 to 30 m", "Second depth below the mudline (m)"),
        ("nan", "'nan' is not a number", "First depth below the mudline (m)"),
        ("0x1", "'0x1' is not a number", "First depth below the mudline (m)"),
        ("1_0", "'1_0' is not a number", "First depth below the mudline (m)"),
        (",", "',' is not a number", "First depth below the mudline (m)"),
        ("0 30 1", "1 is less than 2", "Number of calculation points"),
        ("0 30 2.5", "'2.5' is not a whole number", "Number of calculation points"),
        ("9 9 5", "5 is not 1, and the two depths are equal", "Number of calculation points"),
        ("0 30 2 6", "6 is outside 0 to 5", "Number of the quasi-static step"),
    ],
)
def test_a_refused_number_ends_the_script_with_reason_and_question(answers, reason, asked):
    assert refusal(f"g\nf\nl\n{answers}") == f"answers.txt:4: {reason}\n  asked: {asked}:"


@pytest.mark.parametrize(("letter", "sign"), [("g", "l"), ("h", "1")])
def test_a_step_evolution_takes_at_most_ten_points(letter, sign):
    assert len(session(f"{letter}\nt\n{sign}\n0 30 10\n")[0][0].points) == 10
    assert "11 is outside 2 to 10" in refusal(f"{letter}\nt\n{sign}\n0 30 11\n")


@pytest.mark.parametrize("script", ["g\nf\nl\n0 30 500 5", "h\ne\n1\n0 30 500"])
def test_snapshot_and_envelope_have_no_cap(script):
    assert len(session(script)[0][0].points) == 500


def test_equal_depths_are_one_point():
    assert session("g\nf\nl\n7 7 1 2\n")[0][0].points.tolist() == [7.0]


@pytest.mark.parametrize(
    ("answers", "times"),
    [
        ("a\n10 40 4", (10.0, 20.0, 30.0, 40.0)),
        ("a\n10\n40\n2", (10.0, 40.0)),
        ("a\n5 5 1", (5.0,)),
        ("b\n7.5 3,60", (7.5, 3.0, 60.0)),
    ],
)
def test_times_are_chosen_by_the_program_or_the_user(answers, times):
    assert session(f"h\nf\n1\n0 30 2\n{answers}\n")[0][0].at == times


@pytest.mark.parametrize(
    ("answers", "reason", "asked"),
    [
        ("c", "'c' is not one of a, b", "Times: chosen by the program <a>, your own <b>"),
        ("a\n61", "61 s is outside 0 to 60 s", "Start, end and number of times"),
        ("a\n9 8", "8 s is outside 9 to 60 s", "End and number of times"),
        ("a\n0 60 11", "11 is outside 2 to 10", "Number of times"),
        ("b\n1 2 3 4 5 6 7 8 9 10", "10 times are given; give 1 to 9", "Times (s)"),
        ("b\n1 61", "61 s is outside 0 to 60 s", "Times (s)"),
    ],
)
def test_times_keep_their_rules(answers, reason, asked):
    message = refusal(f"h\nf\n1\n0 30 2\n{answers}\n")
    assert message.partition(": ")[2] == f"{reason}\n  asked: {asked}:"


def test_q_goes_up_from_numbers_and_other_from_menus():
    _, out = session("g\nf\nl\n0 q\n5\no\nh\nx\n1\n0 30 2\nQ\no\nO\nq\n")
    asked = [line for line in out.splitlines() if line.startswith(("> ", "First", "Step", "Type"))]
    assert asked == [
        "> g",
        STATIC_ANALYSES,
        "> f",
        "Type of results:",
        "> l",
        "First depth below the mudline (m): 0",
        "Type of results:",
        "> 5",
        STATIC_ANALYSES,
        "> o",
        "> h",
        DYNAMIC_ANALYSES,
        "> x",
        "Type of results:",
        "> 1",
        "First depth below the mudline (m): 0",
        "Type of results:",
        "> o",
        DYNAMIC_ANALYSES,
        "> O",
        "> q",
    ]


@pytest.mark.parametrize(
    "script", ["q", "g\nq", "g\nt\nq", "g\nt\nl\nq\nq", "h\nf\n1\n0 1 2\nq\nQ"]
)
def test_q_leaves_from_every_menu(script):
    assert session(script)[0] == []


@pytest.mark.parametrize("rows", [1, 2])
def test_a_step_evolution_of_a_single_step_is_declined_in_one_line(rows):
    source = Source("static", {"F1": Extent((0.0, 30.0), np.arange(rows))})
    _, out = session("g\nt\nf\nq\n", source)
    menu, answer, line, again, *_ = out.splitlines()[3:]
    assert menu == again == STATIC_ANALYSES
    assert (answer, line) == ("> t", "No step evolution: only one static step is defined")


def test_two_steps_after_the_first_state_have_an_evolution():
    source = Source("static", {"F1": Extent((0.0, 30.0), np.arange(3))})
    assert session("g\nt\nl\n0 30 2\n", source)[0][0].analysis == "step_evolution"


def test_several_foundations_are_chosen_from_after_the_database_menu():
    other = Extent((0.0, 40.0), np.arange(6))
    source = Source("static", {"F1": EXTENT, "F2": other})
    requests, out = session("g\nf2\nf\nl\n0 40 2 1\no\no\ng\nq\ng\nF1\nf\nl\n0 3 2 1", source)
    assert [r.name for r in requests] == ["F2", "F1"]
    assert "> g\nFoundation (F1, F2): f2\n" + STATIC_ANALYSES in out
    assert "> g\nFoundation (F1, F2): q\nStatic soil results" in out
    message = refusal("g\nF3", source)
    assert message == "answers.txt:2: 'F3' is not one of F1, F2\n  asked: Foundation (F1, F2):"
