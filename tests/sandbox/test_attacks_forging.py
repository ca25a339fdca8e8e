"""Attempts to forge an answer or a mark."""

import math

import numpy as np
import pytest
from attacks import NUMBER, asked

import autograder.sandbox.conversation
from autograder.sandbox.launcher import Stopped

pytestmark = pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")

FIND_THE_CHANNEL = """
import os, stat, sys, struct, json, socket
def is_socket(number):
    try: return stat.S_ISSOCK(os.fstat(number).st_mode)
    except OSError: return False
channel = next(filter(is_socket, range(3, 64)))
def frame(value, length=None):
    text = json.dumps({"body": value, "arrays": []}).encode()
    return struct.pack(">IQ", len(text) if length is None else length, 0) + text
def find_nonce():
    frame = sys._getframe()
    while "nonce" not in frame.f_locals: frame = frame.f_back
    return frame.f_locals["nonce"]
"""


# --- forging


def test_rubbish_on_the_channel_ends_the_notebook_not_the_grader(session):
    code = FIND_THE_CHANNEL + "os.write(channel, os.urandom(5000))"
    report = session.run(["a = 1", code, "b = 2"], ["a", "b"])
    assert report["errors"] == [None, "killed", None]
    assert report["understood"] == {"a": "1", "b": "2"}


def test_a_header_that_claims_four_gigabytes_takes_no_memory(session):
    code = FIND_THE_CHANNEL + "os.write(channel, struct.pack('>IQ', 2**32 - 1, 2**63))"
    assert session.run([code], [])["errors"] == ["killed"]


def test_a_header_within_the_cap_that_nothing_follows_is_a_timeout(session, monkeypatch):
    monkeypatch.setattr(autograder.sandbox.conversation, "_MESSAGE_SECONDS", 2.0)
    code = FIND_THE_CHANNEL + "os.write(channel, struct.pack('>IQ', 900_000, 0))\nwhile True: pass"
    assert session.run([code], [])["errors"] == ["timeout"]


def test_an_answer_without_the_nonce_is_passed_over(session):
    forged = '{"nonce": "guess", "reply": {"errors": [], "responses": {"Q1": "forged"}}}'
    code = FIND_THE_CHANNEL + f"os.write(channel, frame(json.loads('{forged}')) * 10)"
    report = session.run([code, "a = 1"], ["a"])
    assert report["errors"] == [None, None]
    assert (report["responses"], report["understood"]) == ({}, {"a": "1"})


def test_an_answer_before_the_real_one_wins_nothing_that_an_answer_could_not(session):
    """With the true nonce student code can only say what its own names could have said."""
    code = FIND_THE_CHANNEL + (
        "os.write(channel, frame({'nonce': find_nonce(), 'reply': {'errors': ['<script>'],\n"
        "    'understood': {'k': 'a\\x1b[31m\\ud800' + 'x' * 9999}, 'responses': {'Q': [1e999]},\n"
        "    'marks': {'Q1': 100}, 'status': 'right'}}))\n"
        "k = 5"
    )
    report = session.run([code], ["k"])
    assert set(report) == {"errors", "told", "responses", "understood"}
    assert report["errors"] == ["Exception"]
    assert report["responses"] == {"Q": [None]}
    assert report["understood"]["k"].isprintable()
    assert len(report["understood"]["k"]) <= 200
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 5}


ARRAY = """
ones = '{"~": "array", "at": 0}'
def frame_with_array(body):
    text = ('{"body": ' + body + ', "arrays": [["<f8", [2]]]}').encode()
    return struct.pack(">IQ", len(text), 16) + text + bytes(16)
"""


@pytest.mark.parametrize(
    "body",
    [
        "{'nonce': ARRAY}",
        "{'nonce': NONCE, 'cell': ARRAY}",
        "{'nonce': NONCE, 'reply': ARRAY}",
        "{'nonce': NONCE, 'reply': {'errors': [1, 2], 'responses': {'Q1': ARRAY}}}",
        "{'nonce': NONCE, 'reply': {'errors': ARRAY, 'responses': {'Q1': COMPLEX}}}",
    ],
)
def test_an_array_where_the_grader_expects_a_text_is_no_answer(session, body):
    body = body.replace("'", '"').replace("COMPLEX", '{"~": "complex", "re": 0, "im": 1}')
    code = f"{FIND_THE_CHANNEL}{ARRAY}body = {body!r}\n" + (
        "body = body.replace('NONCE', json.dumps(find_nonce())).replace('ARRAY', ones)\n"
        "os.write(channel, frame_with_array(body))\nk = 5"
    )
    report = session.run([code], ["k"])
    assert report["responses"] == {}
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 5}


@pytest.mark.parametrize(
    "reply",
    [
        '"reply": {"state": ARRAY}',
        '"ended_by": ARRAY',
        '"reply": {"state": "raised", "error": ARRAY}',
    ],
)
def test_an_array_in_the_answer_to_a_question_costs_that_question(session, reply):
    code = f"{FIND_THE_CHANNEL}{ARRAY}reply = {reply!r}\n" + (
        "def f(x):\n"
        "    body = '{\"nonce\": ' + json.dumps(find_nonce()) + ', ' + reply + '}'\n"
        "    os.write(channel, frame_with_array(body.replace('ARRAY', ones)))\n"
        "    os._exit(77)\n"
        "k = 5"
    )
    session.run([code], [])
    try:
        assert asked(session, "f", 1.0)["state"] in ("unusable", "raised")
    except Stopped as stopped:
        assert stopped.status == "killed"  # noqa: PT017 -- either way nothing is won
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 5}


def test_an_endless_stream_of_stray_answers_is_cut_off(session):
    code = FIND_THE_CHANNEL + "while True: os.write(channel, frame({'nonce': 'x'}))"
    assert session.run([code], [])["errors"] == ["killed"]


@pytest.mark.parametrize(
    "message",
    [
        "{'nonce': 'x', 'long': 'x' * 900_000}",
        "{'nonce': find_nonce(), 'cell': 1, 'x': 'x' * 900_000}",
    ],
    ids=["strays", "notices of cells"],
)
def test_a_few_long_stray_answers_are_enough(session, message):
    code = f"{FIND_THE_CHANNEL}for _ in range(3): os.write(channel, frame({message}))"
    assert session.run(["k = 5", code], ["k"])["errors"] == [None, "killed"]
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 5}


def test_more_notices_than_cells_are_strays(session):
    code = (
        FIND_THE_CHANNEL
        + "while True: os.write(channel, frame({'nonce': find_nonce(), 'cell': 0}))"
    )
    assert session.run([code], [])["errors"] == ["killed"]


def test_closing_the_channel_costs_the_cell_that_does_it(session):
    report = session.run([FIND_THE_CHANNEL + "os.close(channel)", "a = 1"], ["a"])
    assert report["errors"] == ["killed", None]
    assert report["understood"] == {"a": "1"}


def test_a_thread_that_reads_the_questions_away_costs_only_its_own_time(session):
    code = FIND_THE_CHANNEL + (
        "import threading, time\n"
        "def steal():\n"
        "    while True: os.read(channel, 1)\n"
        "threading.Thread(target=steal, daemon=True).start()\n"
        "k = 5"
    )
    session.run([code], [])
    try:
        session.evaluate("k", NUMBER)
    except Stopped as stopped:
        assert stopped.status in ("timeout", "killed")  # noqa: PT017 -- either way the race ends


TOO_LARGE = {"state": "unusable", "reason": "too large"}
LIARS = {
    "an object with __reduce__": (
        "class Liar:\n    def __reduce__(self): return (print, ('run',))\nx = Liar()",
        {"unusable": "not plain"},
    ),
    "a float that equals everything": (
        "class Liar(float):\n    def __eq__(self, other): return True\nx = Liar(3)",
        {"value": 3.0},
    ),
    "a text that equals everything": (
        "class Liar(str):\n    def __eq__(self, other): return True\n"
        "    __hash__ = str.__hash__\nx = Liar('a')",
        {"value": "a"},
    ),
    "a list that contains itself": ("x = []\nx.append(x)", {"unusable": "not plain"}),
    "an integer of a thousand digits": ("x = 10**1000", {"unusable": "not finite"}),
    "half a character": ("x = '\\ud800'", {"value": "\ud800"}),
    "a generator": ("x = (i for i in range(3))", {"unusable": "lazy"}),
    "an object array": (
        "import numpy as np\nx = np.array([print], dtype=object)",
        {"unusable": "not plain"},
    ),
    "more than the cap": ("import numpy as np\nx = np.zeros(10**6)", TOO_LARGE),
    "a huge list": ("x = [0.5] * 300_000", TOO_LARGE),
}


@pytest.mark.parametrize("name", LIARS)
def test_what_is_returned_is_plain_data_or_refused(session, name):
    code, expected = LIARS[name]
    session.run([code + "\ndef f(): return x", "good = 1"], [])
    if expected is TOO_LARGE:
        assert asked(session, "f") == TOO_LARGE
    else:
        (outcome,) = asked(session, "f")["outcomes"]
        assert outcome == expected
        assert type(outcome.get("value")) in (type(None), float, str)
    assert session.evaluate("good", NUMBER) == {"state": "given", "value": 1}


def test_an_array_whose_class_equals_everything_arrives_as_a_plain_array(session):
    code = (
        "import numpy as np\nclass Liar(np.ndarray):\n"
        "    def __eq__(self, other): return np.ones(self.shape, bool)\n"
        "def f(): return np.arange(3.0).view(Liar)"
    )
    session.run([code], [])
    returned = asked(session, "f")["outcomes"][0]["value"]
    assert type(returned) is np.ndarray
    np.testing.assert_array_equal(returned, [0, 1, 2])


def test_not_a_number_and_infinity_arrive_as_what_they_are(session):
    session.run(["def f(): return [float('nan'), float('inf')]", "n = float('nan')"], [])
    first, second = asked(session, "f")["outcomes"][0]["value"]
    assert math.isnan(first)
    assert second == math.inf
    assert session.evaluate("n", NUMBER) == {"state": "unusable", "reason": "not finite"}


@pytest.mark.parametrize(
    "text",
    ["__import__('os').system('touch /tmp/pwned')", "9**9**9**9", "().__class__", "k" * 10**6],
)
def test_no_text_of_a_student_is_evaluated(session, text):
    session.run([f"e = {text!r}"], ["e"])
    probe = {"inside": "autograder.kinds.expression.inside.evaluate", "points": {"x": np.ones(3)}}
    assert session.evaluate("e", probe) == {"state": "unusable", "reason": "text"}
    assert session.evaluate("e", NUMBER) == {"state": "unusable", "reason": "text"}


def test_an_expression_that_never_ends_costs_its_question(session):
    session.run(["import sympy as sp\ne = sp.Pow(9, sp.Pow(9, sp.Pow(9, 9, evaluate=False), "
                 "evaluate=False), evaluate=False)", "k = 1"], [])  # fmt: skip
    try:
        reply = session.evaluate(
            "e",
            {"inside": "autograder.kinds.expression.inside.evaluate", "points": {"x": np.ones(3)}},
        )
        assert reply["state"] in ("raised", "unusable", "given")
    except Stopped as stopped:
        assert stopped.status in ("timeout", "killed")  # noqa: PT017 -- sympy may give up first
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 1}


# --- the question


def test_changing_an_input_in_place_does_not_reach_the_next_case(session):
    session.run(["def f(x):\n    x[:] = 0\n    return float(x.sum())"], [])
    array = np.ones(3)
    probe = {
        "inside": "autograder.kinds.function.inside.evaluate",
        "cases": [{"args": [array]}, {"args": [array]}],
    }
    session.evaluate("f", probe)
    np.testing.assert_array_equal(array, np.ones(3))
