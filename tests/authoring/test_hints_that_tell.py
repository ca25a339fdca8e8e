"""A hint or a feedback that holds the answer is named with its line and with what to write."""

from __future__ import annotations

import pytest

from autograder.authoring.proof_for_students import prove_for_students

QUESTIONS = "notebooks/questions/kitchen.toml"
ANSWERS = "solutions/answers/kitchen.toml"


# What stands there, what is put there; the file and the text whose line is told; what is said.
POOR: dict[str, tuple[str, str, str, str, str, str]] = {
    "a hint twice": (
        *(QUESTIONS, '["Walk around it."]', '["Walk around it.", "Walk  around it."]'),
        *(QUESTIONS, 'hints = ["Walk around'),
        "question 'Q1.4' in {file}, line {line}: this hint stands there already",
    ),
    "a hint that says the prompt again": (
        *(QUESTIONS, "Count one box first.", "Three boxes of four eggs: how many eggs?"),
        *(QUESTIONS, 'hints = ["Three boxes'),
        "question 'Q1.3' in {file}, line {line}: this hint only says the prompt again",
    ),
    "a hint with the answer as it is typed": (
        *(QUESTIONS, "Walk around it.", "It is 2*(a+b)."),
        *(QUESTIONS, 'hints = ["It is'),
        "question 'Q1.4' in {file}, line {line}: this hint holds the whole answer, '2 * (a + b)'",
    ),
    "a hint with the answer in TeX": (
        *(QUESTIONS, '["Walk around it."]', "['Try $2 \\cdot a + 2 \\cdot b$.']"),
        *(QUESTIONS, "hints = ['Try"),
        "question 'Q1.4' in {file}, line {line}: this hint holds the whole answer, '2*a + 2*b'",
    ),
    "a hint with the answer as it is written by hand": (
        *(QUESTIONS, "Walk around it.", "It is $2(a + b)$."),
        *(QUESTIONS, 'hints = ["It is'),
        "question 'Q1.4' in {file}, line {line}: this hint holds the whole answer, '2 * (a + b)'",
    ),
    "feedback with the right formula": (
        *(ANSWERS, "there are four.", "there are four: 2 * a + 2 * b."),
        *(ANSWERS, 'feedback = "You walked'),
        "the answer to Q1.4 in {file}, line {line}: the feedback of 'half the rim' holds the whole",
    ),
    "feedback with the right number": (
        *(ANSWERS, "That is one box; there are three of them.", "That is one box; all have 12."),
        *(ANSWERS, 'feedback = "That is one box'),
        "the answer to Q1.3 in {file}, line {line}: the feedback of 'one box' holds the whole "
        "answer, '12'; name the error",
    ),
}


@pytest.mark.parametrize("poor", POOR)
def test_a_hint_or_feedback_that_tells_is_named_with_its_line(toy, poor: str):
    file, old, new, where, text, said = POOR[poor]
    toy.replace(file, old, new)
    (found,) = prove_for_students(toy.load())
    assert said.format(file=where, line=toy.line_of(where, text)) in found
    assert found.endswith(".")


@pytest.mark.parametrize(
    "hint",
    [
        "It is not 2*(a+b)**2.",  # something else
        "Think of $a + b$ first.",  # a part of it
        "What are 1.2*a+2*b of a tray?",  # ends like it
    ],
)
def test_a_hint_towards_the_answer_is_no_answer(toy, hint: str):
    toy.replace(QUESTIONS, "Walk around it.", hint)
    assert list(prove_for_students(toy.load())) == []


@pytest.mark.parametrize(("eggs", "told"), [("12", False), ("144", True)])
def test_a_hint_with_the_right_number_tells_if_it_can_be_nothing_else(toy, eggs: str, told: bool):
    """Twelve may be a number of steps; 144 is what was asked for."""
    toy.replace(ANSWERS, "value = 12\n", f"value = {eggs}\n")
    toy.replace(QUESTIONS, "Count one box first.", f"You should come to {eggs}.")
    found = list(prove_for_students(toy.load()))
    assert bool(found) == told
    assert all(f"this hint holds the whole answer, '{eggs}'" in said for said in found)
