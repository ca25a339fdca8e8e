"""What a careless author writes is told in one sentence: the file, the line, and what to write."""

from __future__ import annotations

import re

import pytest

from autograder.authoring.proof import prove_course
from autograder.errors import CourseError
from tests.toy import Toy

QUESTIONS = "notebooks/questions/kitchen.toml"
ANSWERS = "solutions/answers/kitchen.toml"
IN_QUESTIONS = "notebooks/questions/kitchen.toml, line LINE"
IN_ANSWERS = "solutions/answers/kitchen.toml, line LINE"

# By file: what stands there, what is put there, and what is said; LINE is that of the slip.
CARELESS: dict[str, tuple[str, str, str, str]] = {
    "a field of the file": (
        QUESTIONS,
        'title = "The kitchen"',
        'titel = "The kitchen"',
        f"{IN_QUESTIONS}: unknown field 'titel'; perhaps 'title' is meant.",
    ),
    "the header of a question": (
        QUESTIONS,
        '[[question]]\nid = "Q1.3"',
        '[[questoin]]\nid = "Q1.3"',
        f"{IN_QUESTIONS}: unknown field 'questoin'; perhaps 'question' is meant.",
    ),
    "a single bracket": (
        QUESTIONS,
        '[[question]]\nid = "Q1.3"',
        '[question]\nid = "Q1.3"',
        "(at line LINE, column 10); this is there already: the tables of a list begin with [[...]]",
    ),
    "the kind": (
        QUESTIONS,
        'kind = "order"',
        'knid = "order"',
        "line LINE: unknown field 'knid'; perhaps 'kind' is meant.",
    ),
    "the name of a kind": (
        QUESTIONS,
        'kind = "order"',
        'kind = "oder"',
        "line LINE: kind 'oder' is not one of .*; perhaps 'order' is meant.",
    ),
    "points of statements": (
        QUESTIONS,
        'title = "Water"',
        'title = "Water"\npoints = 3',
        "line LINE: unknown field 'points'; each statement is a point, so remove it.",
    ),
    "a field of a card": (
        QUESTIONS,
        '{id = "boil", text = "Boil the water"}',
        '{id = "boil", txet = "Boil the water"}',
        "line LINE: in cards 'boil', unknown field 'txet'; perhaps 'text' is meant.",
    ),
    "one backslash": (
        QUESTIONS,
        '["Walk around it."]',
        r'["Walk along $\alpha$."]',
        r"write two backslashes, as in \\alpha, or the text in single quotes.",
    ),
    "no quotes": (QUESTIONS, 'unit = "eggs"', "unit = eggs", "; write a text in quotes, a number"),
    "a symbol": (
        QUESTIONS,
        'a = "one side"',
        'aa = "one side"',
        "'aa' has no range in sample and no formula in derived, and 'a' in sample or derived is no",
    ),
    "the header of a list in the key": (
        ANSWERS,
        '[["Q1.3".alternative]]\nname = "right"',
        '[["Q1.3".alternativ]]\nname = "right"',
        f"{IN_ANSWERS}: unknown field 'alternativ'; perhaps 'alternative' is meant.",
    ),
    "an id without quotes": (
        ANSWERS,
        '["Q1.3"]',
        "[Q1.3]",
        'line LINE: it answers Q1, which nobody asks; .* an id with dots in quotes, as in ["Q1.2"]',
    ),
    "a mistake that is right": (
        ANSWERS,
        "value = 7\n",
        "value = 12\n",
        "'added' is taken for 'right' .* two apart (solutions/answers/kitchen.toml, line BEFORE).",
    ),
    "a formula": (
        ANSWERS,
        'expression = "a + b"',
        'expression = "a + bb"',
        f"'a + bb' uses 'bb', which has no value here ({IN_ANSWERS}).",
    ),
    "a reference": (
        ANSWERS,
        'reference = "solutions.kitchen:mean_weight"',
        'reference = "solutions.kitchen:mean_wieght"',
        f"in {IN_ANSWERS}, which cannot be loaded: .*; perhaps solutions.kitchen:mean_weight is",
    ),
    "a reference without a colon": (
        ANSWERS,
        'reference = "solutions.kitchen:mean_weight"',
        'reference = "solutions.kitchen.mean_weight"',
        "; write solutions.kitchen:mean_weight, with a colon before the function.",
    ),
    "the table of settings": (
        "pyproject.toml",
        "[tool.autograder]",
        "[tool.autogrder]",
        "nobody reads this table; perhaps [tool.autograder] is meant.",
    ),
    "values in quotes": (
        QUESTIONS,
        'variable = "eggs"',
        'variable = "eggs"\nvariables = {boxes = ["3", "4"]}',
        "the variable 'boxes': write its values as numbers, such as [3, 4, 5]",
    ),
}


@pytest.mark.parametrize("slip", CARELESS)
def test_a_slip_is_told_with_what_to_write(toy: Toy, slip: str):
    file, old, new, said = CARELESS[slip]
    before = (toy.root / file).read_text().splitlines()
    toy.replace(file, old, new)
    after = (toy.root / file).read_text().splitlines()
    line = next(n for n, (a, b) in enumerate(zip(before, after, strict=False), 1) if a != b)
    said = said.replace("LINE", str(line)).replace("BEFORE", str(line - 1))
    try:
        (problem,) = prove_course(toy.root, mutants=False)
    except CourseError as error:
        problem = str(error)
    assert re.search(re.escape(said).replace(r"\.\*", ".*"), problem), problem
    assert re.search(r"line \d+|\[tool", problem)


@pytest.mark.parametrize(
    ("parameters", "public", "said"),
    [
        ("case, actual", "True", "raises TypeError for the right result: drawn() takes 2"),
        ("case, expected, actual", "True", "raises ValueError for the right result: no plot"),
        ("case, expected, actual", "False", "never drawn: it shows the first case, which must be"),
    ],
)
def test_a_picture_that_nobody_would_see_is_told(toy: Toy, parameters: str, public: str, said: str):
    """On a page of feedback it is left out without a word, since a student's result may be it."""
    cases = 'cases = "solutions.kitchen:mean_weight_cases"'
    toy.replace(ANSWERS, cases, f'{cases}\npicture = "solutions.kitchen:drawn"')
    first = '[{"name": "light", "args": [[2.0, 3.0]], "public": PUBLIC}'.replace("PUBLIC", public)
    source = (toy.root / "solutions/kitchen.py").read_text()
    source += f"\n\ndef drawn({parameters}):\n    raise ValueError('no plot')\n"
    source += "\n\n_others = mean_weight_cases\n\n\ndef mean_weight_cases(rng):\n"
    source += f"    return {first}, *_others(rng)]\n"
    (toy.root / "solutions/kitchen.py").write_text(source)
    problems = prove_course(toy.root, mutants=False)
    (problem,) = (problem for problem in problems if "picture" in problem)
    assert said in problem
    assert f"({ANSWERS}, line " in problem or "(solutions/kitchen.py, line " in problem


def test_a_solved_notebook_that_raises_says_what_and_where(toy: Toy):
    """The reference uses what its module has and the notebook has not."""
    path = toy.root / "solutions/kitchen.py"
    first = "    if len(weights) == 0:"
    source = path.read_text().replace(first, f"    weights = weights * GRAMS\n{first}", 1)
    path.write_text(f"GRAMS = 1\n{source}")
    (problem,) = prove_course(toy.root, mutants=False)
    assert problem.startswith("Q1.5: the solved notebook is marked error: ")
    assert "name 'GRAMS' is not defined" in problem
    assert re.search(rf"\({ANSWERS}, line \d+\)", problem)
