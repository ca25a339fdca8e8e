"""What is sound by itself and serves no student is named with its line and with what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.authoring.proof import prove_course
from autograder.authoring.proof_for_students import prove_for_students
from autograder.course import load_course
from tests.toy import Toy

QUESTIONS = "notebooks/questions/kitchen.toml"
ANSWERS = "solutions/answers/kitchen.toml"
CASES = "solutions/kitchen.py"


def the_problem(course: Toy) -> str:
    (found,) = prove_course(course.root, mutants=False)
    return found


def test_a_function_without_a_public_case_is_named_with_its_cases(toy):
    toy.replace(CASES, ', "public": True', "")
    said = the_problem(toy)
    assert said.startswith("Q1.5: no case of 'solutions.kitchen:mean_weight_cases'")
    assert f"(solutions/kitchen.py, line {toy.line_of(CASES, 'def mean_weight_cases')})" in said
    assert 'write "public": True into one' in said
    assert f"({ANSWERS}, line {toy.line_of(ANSWERS, 'cases = ')})" in said


def test_cases_that_nobody_can_read_are_named_all_the_same(toy):
    toy.replace(CASES, ', "public": True', "")
    toy.append(CASES, "\nimport functools\nmade = functools.partial(mean_weight_cases)\n")
    toy.replace(ANSWERS, "solutions.kitchen:mean_weight_cases", "solutions.kitchen:made")
    assert the_problem(toy).startswith("Q1.5: no case of 'solutions.kitchen:made' is public")


# What stands there, what is put there; the file and the text whose line is told; what is said.
POOR: dict[str, tuple[str, str, str, str, str, str]] = {
    "two questions that ask the same": (
        *(QUESTIONS, "Three boxes of four eggs: how many eggs?"),
        "How long is the rim of a tray\\n of the given sides?",
        *(QUESTIONS, 'prompt = "How long is the rim of a tray of'),
        "question 'Q1.4' in {file}, line {line}: it asks the very same as Q1.3; say in its prompt",
    ),
    "the name of what asks": (
        *(QUESTIONS, 'variable = "eggs"', 'variable = "check"'),
        *(QUESTIONS, 'variable = "check"'),
        "question 'Q1.3' in {file}, line {line}: 'check' is taken in the notebook: the notebook ",
    ),
    "the name of what is imported": (
        *(QUESTIONS, 'variable = "rim"', 'variable = "np"'),
        *(QUESTIONS, 'variable = "np"'),
        "'np' is taken in the notebook: its cells import it: import numpy as np; choose another",
    ),
}


@pytest.mark.parametrize("poor", POOR)
def test_what_serves_no_student_is_named_with_its_line(toy, poor: str):
    file, old, new, where, text, said = POOR[poor]
    toy.replace(file, old, new)
    (found,) = prove_for_students(toy.load())
    assert said.format(file=where, line=toy.line_of(where, text)) in found
    assert found.endswith(".")


def test_one_prompt_may_have_other_statements(toy):
    statements = 'statements = ["Water boils at 100 °C."]'
    question = (
        f'[[question]]\nid = "Q1.7"\nkind = "true_false"\ntitle = "Ice"\n{statements}\n'
        'prompt = "Three claims about water at sea level."\nhints = ["Look."]\n'
    )
    statement = '[["Q1.7".statement]]\ntruth = true\nexplanation = "x"\nmisconception = "x"\n'
    toy.add("kitchen", question, f'["Q1.7"]\n{statement}')
    toy.append("notebooks/source/1_kitchen.py", '\n# %% exercise="Q1.7"\n')
    assert list(prove_for_students(toy.load())) == []


def test_cards_that_read_alike_must_be_interchangeable(toy):
    toy.replace(ANSWERS, 'interchangeable = [["stir", "stir_again"]]\n', "")
    said = prove_course(toy.root, mutants=False)[0]
    assert said.startswith("Q1.2: the cards 'stir' and 'stir_again' have the same text")
    assert 'write interchangeable = [["stir", "stir_again"]]' in said
    assert ANSWERS in said


def test_this_course_and_the_other_serve_their_students(real_course):
    other = Path(__file__).parents[1] / "courses/kalman"
    for course in (real_course, load_course(other)):
        assert list(prove_for_students(course)) == []
