"""What is sound by itself and serves no student is named with its line and with what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.authoring.proof import prove_course
from autograder.authoring.proof_for_students import prove_for_students
from autograder.course import load_course
from autograder.errors import CourseError
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


def test_a_reference_that_lacks_its_return_is_named(toy):
    """Everybody who leaves the stub's docstring and writes ``pass`` would be right."""
    toy.replace(CASES, "    return total / len(weights)", "    total / len(weights)")
    toy.replace(CASES, "        return 0.0", "        return None")
    said = next(problem for problem in prove_course(toy.root, mutants=False) if "None" in problem)
    assert said.startswith("Q1.5: the reference returns None in every case")
    assert "does it lack a return?" in said


@pytest.mark.parametrize(
    ("drawn", "said"),
    [
        ("np.random.default_rng(7)", "are the same in every draw, so that nothing stays hidden"),
        ("np.random.default_rng()", "differ between two draws of one seed"),
    ],
)
def test_cases_that_are_not_drawn_from_their_generator_are_named(toy, drawn: str, said: str):
    head = "def mean_weight_cases(rng):\n"
    toy.replace(CASES, head, f"{head}    import numpy as np\n\n    rng = {drawn}\n")
    problems = [one for one in prove_course(toy.root, mutants=False) if said in one]
    (problem,) = problems
    assert problem.startswith("Q1.5: the cases of 'solutions.kitchen:mean_weight_cases'")
    assert "draw from the generator that the function is given" in problem


def test_a_picture_that_is_not_there_is_named_with_its_line(toy):
    master = min((toy.root / "notebooks/source").glob("*.py"))
    shown = "# %% [markdown]\n# ![A pot](../data/my%20pot.png) ![x](https://example.org/x.png)\n"
    master.write_text(f"{master.read_text()}\n{shown}")
    said = the_problem(toy)
    assert f"{master.name}, line {len(master.read_text().splitlines())}" in said
    assert "shows the picture ../data/my%20pot.png, which does not exist" in said
    (toy.root / "data").mkdir(exist_ok=True)
    (toy.root / "data/my pot.png").write_bytes(b"a picture")
    assert not any("picture" in problem for problem in prove_course(toy.root, mutants=False))


@pytest.mark.parametrize("file", [QUESTIONS, "pyproject.toml"])
def test_a_byte_order_mark_in_a_table_is_named(toy, file: str):
    path = toy.root / file
    path.write_text(path.read_text(encoding="utf-8"), encoding="utf-8-sig")
    with pytest.raises(CourseError, match="begins with a byte order mark"):
        load_course(toy.root)


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
