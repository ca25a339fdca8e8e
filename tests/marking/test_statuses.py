"""One table says how each status of a mark looks, wherever it is shown."""

from autograder.marking import STATUSES
from autograder.questions.status import Status
from autograder.reports.terminal import legend


def test_each_status_has_a_sign_of_its_own_and_words():
    assert len(STATUSES) == 9
    signs = [status.sign for status in Status]
    assert len(set(signs)) == 9
    assert all(len(sign) == 1 for sign in signs)
    assert all(status.words and status.color for status in Status)


def test_a_status_is_its_text_wherever_it_is_compared_or_written():
    assert Status("not attempted") == "not attempted"
    assert f"{Status.KILLED}" == "killed"
    assert "● recorded" in legend()
