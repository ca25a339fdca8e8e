"""Wrong responses written blind get names, and the right ones."""

import pytest

from tests.diagnosis.blind import BlindMarker, name_of, read_blind_set


@pytest.fixture(scope="module")
def named():
    marker = BlindMarker()
    wanted = [r for r in read_blind_set() if r.question.startswith(("Q1.2", "Q3.2"))]
    return [(r, name_of(marker.mark(r.question, r.given))) for r in wanted]


def test_four_of_five_wrong_responses_have_a_name_that_says_what_is_wrong(named):
    rightly = sum(name in response.expect for response, name in named)
    assert rightly >= 0.8 * len(named)


def test_names_that_say_something_else_are_few_and_known(named):
    wrongly = [
        (response.question, response.error)
        for response, name in named
        if name is not None and name not in response.expect
    ]
    # The author's mistake of the key: an approximated logarithm gives the same number.
    assert wrongly == [("Q3.2.1", "one too many")]
