"""The dynamic questions of a real run at a pseudo-terminal."""

from pathlib import Path

from test_podeep_terminal import CTRL_C, Terminal
from test_podeep_transcripts import COMMAND, REAL_RUN


def test_times_are_asked_refused_left_and_chosen(tmp_path, monkeypatch):
    """The proposal of divisions, both ways to times, and each way up out of them."""
    monkeypatch.chdir(tmp_path)
    session = Terminal([*COMMAND, str(REAL_RUN), "--no-plot", "--record", "record"])
    for seen, typed in (
        ("Dynamic soil results", "h\r"),
        ("Envelop <e>", "x\r"),
        ("Type of results:", "2\r"),
        ("First depth", "0 26\r"),
        ("Number of divisions", "\r"),  # 10 are proposed
        ("your own <b>", "b\r"),
        ("1 to 9 times on one line, 0 to 32 s", "24 40\r"),
        ("40 s is outside", CTRL_C),  # up to the results
        ("Type of results:", "1\r"),
        ("First depth", "0\r"),
        ("Second depth", "12 4\r"),
        ("your own <b>", "a\r"),
        ("Start, end and number of times", "24 28 11\r"),
        ("11 is outside", "\x7f" * 2 + "q\r"),  # the number is edited away: q goes up too
        ("Type of results:", "1\r"),
        ("First depth", "0 12 4\r"),
        ("your own <b>", "a\r"),
        ("Start, end and number of times", "24 28 3\r"),
        ("Times       24 to 28 s, 3 times", ""),
        ("Type of results:", "5\r"),
        ("Envelop <e>", "q\r"),
    ):
        session.see(seen)
        session.type(typed)
    assert session.end() == 0
    lines = Path("record").read_text(encoding="utf-8").splitlines()
    answers = [line for line in lines if not line.startswith("#")]
    assert answers == [
        *("h", "x", "2", "0", "26", "10", "b", "q"),
        *("1", "0", "12", "4", "a", "24", "28", "q"),
        *("1", "0", "12", "4", "a", "24", "28", "3", "5", "q"),
    ]
