"""What a function was asked with in secret does not come back in what its author is shown."""

import json
from collections.abc import Iterator

import pytest

from autograder.course import Course
from autograder.grading.submission import grade_contents
from autograder.intake.submissions import Contents, Notebook
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.sandbox.launcher import Sandbox
from tests.classroom import RIGHT, make_course
from tests.toy import Toy

QUESTIONS = """
[[question]]
id = "Q5"
kind = "number"
points = 1
variable = "rows"
decimals = 2
unit = "m"
title = "Rows"
prompt = "How far apart are the rows?"
hints = ["Measure."]

[[question]]
id = "Q6"
kind = "function"
points = 2
function = "scale"
title = "The scale"
prompt = "Return the weights in kilograms."
hints = ["Divide."]
"""
ANSWERS = """
["Q5"]
code = "4"
[["Q5".alternative]]
name = "right"
value = 4
credit = 1.0

["Q6"]
reference = "orchard_reference:scale"
cases = "orchard_reference:scale_cases"
picture = "orchard_reference:picture"
"""
REFERENCE = """
HIDDEN = 4711.25

def scale(weights):
    return [weight / 1000 for weight in weights]

def scale_cases(rng):
    return [
        {"name": "one apple", "args": [[500.0]], "public": True},
        {"name": "hidden apples", "args": [[HIDDEN, HIDDEN]]},
    ]

def picture(case, right, given):
    return None
"""
KEEP = "    open('../tmp/seen', 'a').write(str(list(weights)) + ' ')\n"


@pytest.fixture(scope="module")
def meadow(tmp_path_factory: pytest.TempPathFactory) -> Course:
    root = tmp_path_factory.mktemp("meadow") / "course"
    make_course(root)
    return Toy(root).add("orchard", QUESTIONS, ANSWERS, REFERENCE).load()


@pytest.fixture(scope="module")
def meadow_sandbox(meadow: Course) -> Iterator[Sandbox]:
    with Sandbox(meadow, seed=1) as sandbox:
        yield sandbox


def marks(meadow: Course, sandbox: Sandbox, *cells: str) -> dict[str, Mark]:
    cells = ("import os", RIGHT["Q3"], *cells)
    contents = Contents({"orchard": Notebook(list(cells))})
    return {
        mark.question: mark for mark in grade_contents(contents, Marker(meadow, seed=1), sandbox)
    }


SCALE = "def scale(weights):\n    return [weight / 1000 for weight in weights]"


def test_a_good_submission_gets_its_marks_though_one_case_is_asked_alone(meadow, meadow_sandbox):
    found = marks(meadow, meadow_sandbox, RIGHT["Q4"], "rows = 4.0", SCALE)
    assert [found[id].status for id in ("Q3", "Q4", "Q5", "Q6")] == ["right"] * 4
    assert found["Q6"].shown == [0.5]
    assert found["Q4"].shown is None  # nothing draws it
    assert found["Q5"].understood == "4 m"


def test_a_number_cannot_give_back_what_a_function_was_asked_with(meadow, meadow_sandbox):
    code = (
        f"def heaviest(weights):\n{KEEP}    return max(weights)\n"
        "class Rows:\n"
        "    def __float__(self):\n"
        "        try: return float(open('../tmp/seen').read().split('[')[2].split(',')[0])\n"
        "        except OSError: return 4.0\n"
        "    def __str__(self): return 'before: ' + str(float(self))\n"
        "rows = Rows()"
    )
    found = marks(meadow, meadow_sandbox, code)
    # It does read the hidden weights by then: it is no 4 any more.
    assert (found["Q4"].status, found["Q5"].status) == ("right", "wrong")
    assert found["Q5"].understood == "before: 4.0"


@pytest.mark.parametrize(
    "steal",
    [
        # In the frames of its callers, which hold the message.
        "    import sys\n"
        "    frame = sys._getframe()\n"
        "    while 'probe' not in frame.f_locals: frame = frame.f_back\n"
        "    cases = frame.f_locals['probe']['cases']\n"
        "    return cases[-1]['args'][0]\n",
        # In what another function, asked before, has left behind.
        "    try: seen = open('../tmp/seen').read().split('[')[2].split(',')\n"
        "    except OSError: return weights\n"
        "    return [float(weight) for weight in seen[:2]]\n",
        # In what this function itself was asked with.
        f"    try: return eval(open('../tmp/seen').read().split(' ')[-2])\n"
        f"    except OSError: return weights\n    finally:\n    {KEEP}",
    ],
    ids=["frames", "another function", "itself"],
)
def test_the_value_that_is_drawn_holds_no_hidden_input(meadow, meadow_sandbox, steal):
    code = f"def heaviest(weights):\n{KEEP}    return max(weights)\ndef scale(weights):\n{steal}"
    found = marks(meadow, meadow_sandbox, code)
    assert found["Q4"].status == "right"
    assert found["Q6"].shown == [500.0]
    assert "4711" not in json.dumps([mark.to_dict() for mark in found.values()])


def test_a_forged_answer_cannot_put_a_hidden_outcome_in_the_place_of_the_drawn_one(
    meadow, meadow_sandbox
):
    code = (
        "from autograder.sandbox import evaluate\n"
        "def answer(response, probe):\n"
        "    cases = probe['cases']\n"
        "    if cases[0]['args'] == [[500.0]]: return {'state': 'given', 'outcomes': []}\n"
        "    outcomes = [{'value': case['args'][0]} for case in cases]\n"
        "    return {'state': 'given', 'outcomes': outcomes * 2}\n"
        "import autograder.sandbox.inside.notebook as notebook\n"
        f"notebook.evaluate = answer\n{SCALE}"
    )
    found = marks(meadow, meadow_sandbox, code)
    assert found["Q6"].shown is None
    assert found["Q6"].points == 0
