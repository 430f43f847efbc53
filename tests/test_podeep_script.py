"""Scripts of answers: lines and comments, how they end, and recorded ones."""

from io import StringIO

import pytest

from podeep.errors import AnswerRefused
from podeep.session.console import Recorder, ScriptConsole
from podeep.session.question import Question, Up, whole
from test_podeep_questions import refusal, session

MENU = "Type of results: Lateral displacement <l>, Lateral force <f>, Axial displacement <a>, "
MENU += "Axial force <r>, Other <o>, Exit <q>:"


def test_blank_lines_comments_and_a_byte_order_mark_are_skipped():
    script = "\ufeff# a comment\n\n  \ng  # the static one\n#t\nf\nl\n\n0 1 # 2 3\n2 0"
    assert len(session(script)[0]) == 1


def test_the_line_of_a_refused_answer_counts_blank_lines_and_comments():
    assert refusal("# one\n\ng\n\nz").startswith("answers.txt:5: 'z' is not one of t, f, o, q\n")


@pytest.mark.parametrize(
    ("script", "line", "asked"),
    [
        ("", 1, "Static soil results <g>, Dynamic soil results <h>, Exit <q>:"),
        ("# nothing\n", 2, "Static soil results <g>, Dynamic soil results <h>, Exit <q>:"),
        ("g", 2, "Step evolution <t>, Snapshot <f>, Other analysis <o>, exit<q>:"),
        ("g\nf\nl\n0 30", 5, "Number of calculation points:"),
        ("g\nf\nl\n0 30 2 1\nl", 6, "First depth below the mudline (m):"),
    ],
)
def test_a_missing_answer_is_told_with_its_question(script, line, asked):
    reason = "the answer is missing, the script ends here"
    assert refusal(script) == f"answers.txt:{line}: {reason}\n  asked: {asked}"


def test_the_end_at_a_menu_counts_as_q_only_after_a_result():
    requests, out = session("g\nf\nl\n0 30 2 1")
    assert len(requests) == 1
    assert out.endswith("Exit.............................<q>\n> q\n")
    with pytest.raises(AnswerRefused, match="the answer is missing"):
        session("g\nf\nl\n0 30 2 1", results=False)


def test_numbers_that_nothing_asked_for_are_refused():
    message = refusal("g\nf\nl\n0 30 2 1 9 8\nq")
    assert message == (
        f"answers.txt:4: '9 8' is more than the questions asked for\n  asked: {MENU}"
    )


def test_a_recorded_session_is_a_script_of_the_same_session():
    script = "G\nx\n1\n0, 30 # m\n3 5\nl\n0 q\no\no\nh\nf\n1\n0 30 2\na 1\n".replace(
        "a 1", "a\n0 60 4"
    )
    record = StringIO()
    requests, out = session(script, record=Recorder(record))
    text = record.getvalue()
    assert text.startswith(
        "# Static soil results <g>, Dynamic soil results <h>, Exit <q>:\nG\n"
        "# Step evolution <t>, Snapshot <f>, Other analysis <o>, exit<q>:\nx\n"
        f"# {MENU}\n1\n"
        "# First depth below the mudline (m):\n0\n"
        "# Second depth below the mudline (m):\n30\n"
        "# Number of calculation points:\n3\n"
    )
    again, out_again = session(text)
    assert out_again == out
    assert [(r.analysis, r.quantity, r.points.tolist(), r.at) for r in again] == [
        (r.analysis, r.quantity, r.points.tolist(), r.at) for r in requests
    ]


def test_a_refused_answer_is_not_recorded():
    record = StringIO()
    with pytest.raises(AnswerRefused):
        session("g\nz", record=Recorder(record))
    assert "z" not in record.getvalue()


def test_the_question_is_out_before_its_answer_is_read():
    """A program at the other end of a pipe must see what it is asked."""
    out = StringIO()
    seen = []

    def lines():
        seen.append(out.getvalue())
        yield "4"

    question = Question("How many", whole(0), exits={"q": Up}, one_number=True)
    assert ScriptConsole(lines(), "a", out, out).ask(question) == 4
    assert seen == ["How many: "]
    assert out.getvalue() == "How many: 4\n"
