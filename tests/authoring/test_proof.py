"""``autograder check`` finds what is wrong with a broken course, and nothing in a sound one."""

import json
from contextlib import nullcontext

import pytest

from autograder.authoring.proof import prove_course
from autograder.cli import main
from tests.toy import Toy

QUESTIONS = "notebooks/questions/kitchen.toml"
ANSWERS = "solutions/answers/kitchen.toml"
MASTER = "notebooks/source/1_kitchen.py"


def problems(course: Toy) -> list[str]:
    found = prove_course(course.root)
    assert all(problem.endswith(".") and "\n" not in problem for problem in found), found
    return found


def the_problem(course: Toy) -> str:
    found = problems(course)
    assert len(found) == 1, found
    return found[0]


def test_a_sound_course_has_no_problem_and_each_step_is_reported(toy):
    toy.write_notebooks()
    steps: list[str] = []
    assert prove_course(toy.root, steps.append) == []
    assert list(dict.fromkeys(step.partition(" (")[0] for step in steps)) == [
        "questions and answers",
        "mistakes",
        "mutants",
        "leaks",
        "solved notebooks",
        "untouched notebooks",
    ]


def test_the_command_says_sound_or_broken_and_exits_accordingly(toy, capsys):
    toy.append("notebooks/questions/kitchen.toml", "")
    (toy.root / "notebooks/stray.txt").write_text("")
    assert main(["--course", str(toy.root), "check"]) == 1
    said = capsys.readouterr().out
    assert "notebooks/stray.txt is unexpected" in said
    assert "1 problem." in said


# What is found before anything runs: file, what stands there, what is put there, what is said.
FOUND_IN_THE_FILES: dict[str, tuple[str, str, str, str]] = {
    "a duplicate id": (QUESTIONS, 'id = "Q1.3"', 'id = "Q1.4"', "two questions have this id"),
    "an empty hint": (QUESTIONS, '["Walk around it."]', '[""]', "'Q1.4'"),
    "a missing answer": (ANSWERS, '["Q1.1"]', '["Q1.9"]', "Q1."),
    "a backslash that TOML took": (
        QUESTIONS,
        '["Walk around it."]',
        '["Walk by $\\theta$."]',
        "line 45: a text in double quotes reads \\t as a sign of its own: write \\\\theta with two",
    ),
    "a backslash that TOML took in the key": (
        ANSWERS,
        "Two sides of either length.",
        "Half is $\\frac{1}{2}$.",
        "write \\\\frac with two backslashes",
    ),
    "a reference that calls what is not there": (
        "solutions/kitchen.py",
        "return total / len(weights)",
        "return totl / len(weights)",
        "Q1.5: the reference raises NameError for 'two equal weights', 'many weights'",
    ),
    "a case with too few arguments": (
        "solutions/kitchen.py",
        '"args": [[3.0, 3.0]]',
        '"args": []',
        "Q1.5: the case 'two equal weights' cannot be given to the reference: missing a required "
        "argument: 'weights'",
    ),
    "a question never asked": (MASTER, '# %% exercise="Q1.3"\n', "", "Q1.3 is asked 0 times"),
    "no second mistake": (
        ANSWERS,
        '[["Q1.3".alternative]]\nname = "one box"\nvalue = 4\ncredit = 0.0\n'
        'feedback = "That is one box; there are three of them."\n',
        "",
        "Q1.3: 1 known mistakes",
    ),
    "no right number": (
        ANSWERS,
        "value = 12\ncredit = 1.0",
        'value = 12\ncredit = 0.9\nfeedback = "Almost."',
        "Q1.3: no alternative has full credit",
    ),
    "two numbers that cannot be told apart": (
        ANSWERS,
        "value = 4\n",
        "value = 7\n",
        "'one box' is taken for 'added' and gets 0.25",
    ),
    "a mistake that has the value of the right number": (
        ANSWERS,
        "value = 7\n",
        "value = 12\n",
        "'added' is taken for 'right' and gets 1",
    ),
    "a mistake that equals the right expression": (
        ANSWERS,
        'expression = "a*b"',
        'expression = "2*half"',
        "'the area' is taken for 'right' and gets 1",
    ),
    "two expressions that cannot be told apart": (
        ANSWERS,
        'expression = "a*b"',
        'expression = "half"',
        "'the area' is taken for 'half the rim' and gets 0.5",
    ),
    "a formula with an unknown name": (
        ANSWERS,
        'expression = "a*b"',
        'expression = "a*c"',
        "Q1.4: the formula 'a*c' uses 'c'",
    ),
    "a formula that is code": (
        ANSWERS,
        'expression = "a*b"',
        "expression = \"__import__('os')\"",
        "is not allowed in a formula",
    ),
    "a wrong function with full credit": (
        ANSWERS,
        'credit = 0.25\nfeedback = "You return the sum',
        'credit = 1.0\nfeedback = "You return the sum',
        "Q1.5: the mistake 'the sum' gets full credit",
    ),
    "a mistake that is the reference": (
        "solutions/kitchen.py",
        "    return float(sum(weights))",
        "    return mean_weight(weights)",
        "'the sum' is taken for 'right' and gets 1",
    ),
    "two functions that cannot be told apart": (
        "solutions/kitchen.py",
        "    return float(np.median(weights)) if len(weights) else 0.0",
        "    return total_weight(weights)",
        "'the middle' is taken for 'the sum'",
    ),
    "inputs that do not tell a mistake from the reference": (
        "solutions/kitchen.py",
        '        {"name": "many weights", "args": [list(map(float, rng.uniform(1, 9, 5)))]},\n'
        '        {"name": "one heavy weight", "args": [[1.0, 2.0, float(rng.uniform(50, 90))]]},\n',
        "",
        "'the middle' is taken for 'right'",
    ),
    "a mistake that does not exist": (
        ANSWERS,
        '"solutions.kitchen:total_weight"',
        '"solutions.kitchen:gross_weight"',
        "'solutions.kitchen:gross_weight' in solutions/answers/kitchen.toml, line",
    ),
    "cases that are no list": (
        "solutions/kitchen.py",
        "    return [\n",
        "    return None and [\n",
        "cases of Q1.5 must be a list",
    ),
    "an order dealt in a right order": (
        ANSWERS,
        '    ["boil", "stir"],\n    ["stir", "pour"],\n    ["pour", "stir_again"],\n'
        '    ["stir_again", "drink"],\n    ["cup", "drink"],\n',
        '    ["boil", "pour"],\n',
        "Q1.2: the cards are dealt in a right order",
    ),
    "a mistake in an order that is none": (
        ANSWERS,
        'first = "drink"\nsecond = "pour"',
        'first = "cup"\nsecond = "pour"',
        "Q1.2: the mistake 'an empty cup' is none",
    ),
}


@pytest.mark.parametrize("broken", FOUND_IN_THE_FILES)
def test_a_broken_course_is_found_out(toy, broken):
    file, old, new, said = FOUND_IN_THE_FILES[broken]
    toy.replace(file, old, new)
    found = problems(toy)
    assert any(said in problem for problem in found), found


@pytest.mark.parametrize(
    "file",
    [
        "notebooks/questions/attic.txt",
        "notebooks/source/notes.md",
        "notebooks/9_attic.ipynb",
        "notebooks/key.toml",
        "solutions/answers/attic.toml",
        "solutions/notebooks/9_attic.ipynb",
    ],
)
def test_an_unexpected_file_is_named(toy, file):
    toy.write_notebooks()
    (toy.root / file).write_text("")
    assert the_problem(toy).startswith(f"{file} is unexpected")


def test_a_stub_that_passes_is_found_out(toy):
    """The master defines the response already, so the untouched notebook is marked."""
    toy.replace(MASTER, '# %% exercise="Q1.4"', '# %% exercise="Q1.4"\n\n# %%\nrim = 2 * half')
    found = [problem for problem in problems(toy) if "stub" in problem]
    assert found == ["Q1.4: the untouched stub is marked right; it must be not attempted."]


def test_a_solved_notebook_that_fails_is_found_out(toy):
    toy.replace(ANSWERS, 'code = "3 * 4"', 'code = "3 + 4"')
    found = the_problem(toy)
    assert found.startswith("Q1.3: the solved notebook is marked partial: You added")


def test_a_solved_notebook_that_raises_is_found_out(toy):
    toy.replace(ANSWERS, 'code = "3 * 4"', 'code = "1 / 0"')
    assert "Q1.3: the solved notebook is marked error" in the_problem(toy)


LEAKS = {
    "code of the key in a notebook": (MASTER, "Now some numbers.", "2 * (a + b)", "Q1.4"),
    "an explanation": (MASTER, "Now some numbers.", "Two sides of either length.", "Q1.4"),
    "feedback": (MASTER, "numbers.", "That is one box; there are three of them.", "Q1.3"),
    "a misconception": (
        MASTER,
        "Now some numbers.",
        "Most solids sink in their liquid; look at a lake in winter.",
        "Q1.1",
    ),
    "why a statement is true": (MASTER, "numbers.", "That is why roads are salted.", "Q1.1"),
    "a number in a prompt": (QUESTIONS, "how many eggs?", "how many, if not 12?", "Q1.3"),
    "a formula in a prompt": (QUESTIONS, "given sides?", "given sides, not 2*a + 2*b?", "Q1.4"),
}


@pytest.mark.parametrize("leak", LEAKS)
def test_an_answer_in_what_students_get_is_found_out(toy, leak, monkeypatch):
    """Running the notebooks is left out: it finds nothing here and takes its time."""
    monkeypatch.setattr("autograder.authoring.proof.grade_contents", lambda *_: [])
    monkeypatch.setattr("autograder.authoring.proof.Sandbox", nullcontext)
    file, old, new, id = LEAKS[leak]
    toy.replace(file, old, new)
    found = problems(toy)
    assert found
    assert all(problem.startswith(f"{id}: ") for problem in found)
    assert all("which is in the key" in problem for problem in found)


def test_notebooks_are_proven_as_they_would_be_built_not_as_they_lie_there(toy):
    toy.write_notebooks()
    path = toy.root / "solutions/notebooks/1_kitchen.ipynb"
    notebook = json.loads(path.read_text())
    notebook["cells"] = []
    path.write_text(json.dumps(notebook))
    assert problems(toy) == []
