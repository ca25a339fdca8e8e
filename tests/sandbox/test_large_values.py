"""What a function returns is counted by what it would become in the grader."""

import pytest
from attacks import CASE, GOOD, NUMBER

TOO_LARGE = [
    "np.zeros((2**28, 0))",
    "np.zeros((2**20, 2**8, 0), bool)",
    "[[]] * 10**6",
    "[np.zeros((10**5, 0))] * 100",
    "[[0] * 1000] * 1000",
    "'x' * 2**21",
]


@pytest.mark.parametrize("value", TOO_LARGE)
def test_a_value_that_is_far_too_large_costs_its_question_and_nothing_else(patient_session, value):
    patient_session.run([*GOOD, f"def double(x):\n    return {value}"], [])
    session = patient_session
    outcome = session.evaluate("double", CASE)
    assert outcome == {"state": "unusable", "reason": "too large"}
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}


def test_the_same_sent_past_the_honest_way_out_is_no_answer(session):
    cell = """
import gc, json, struct
from autograder.exchange import wire
def forged(value, most=None):
    text = json.dumps({"body": {"nonce": value["nonce"], "reply": {"state": "given",
        "outcomes": [{"value": {"~": "array", "at": 0}}]}}, "arrays": [["<f8", [2**28, 0]]]})
    return struct.pack(">IQ", len(text), 0) + text.encode()
def double(x):
    wire.encode = forged
    return x
"""
    session.run([*GOOD[:1], cell], [])
    with pytest.raises(Exception, match="no answer"):
        session.evaluate("double", CASE)
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}
