"""A problem of a table is told with the line of the field that has it, in whatever file it is."""

from __future__ import annotations

import re

import pytest

from autograder.authoring.proof import prove_course
from tests.toy import Toy
from tests.toy.market import make_market

QUESTIONS = "notebooks/questions/kitchen.toml"
ANSWERS = "solutions/answers/kitchen.toml"
MASTER = "notebooks/source/1_kitchen.py"
TEXT = """
[[question]]
id = "Q1.6"
kind = "text"
title = "Why"
points = 2
longest = 50
prompt = "Why does water boil?"
hints = ["What is a bubble?"]
"""
RUBRIC = """
["Q1.6"]
model = "Its vapour pushes as hard as the air does."
[["Q1.6".criterion]]
name = "pressure"
levels = [
    {name = "named", points = 2},
    {name = "missing", points = 0},
]
"""
PREDICTION = """
[[prediction]]
id = "P1.1"
prompt = "How hot?"
between = [0, 100]
"""

# What stands there and what is put there; the file and the text whose line is told; what is said.
FIELDS: dict[str, tuple[str, str, str, str, str]] = {
    "a card that is twice there": (
        *(QUESTIONS, 'id = "stir_again"', 'id = "stir"'),
        *('{id = "stir", text = "Stir"},\n    {id = "pour"', "two cards have the same id"),
    ),
    "a statement that is twice there": (
        *(QUESTIONS, '"Ice sinks in water."', '"Water boils at 100 °C."'),
        *("statements = ", "this statement stands there already"),
    ),
    "a range that is turned round": (
        *(QUESTIONS, "integer = true", "integer = true\nbetween = [9, 1]"),
        *("between = ", "the first number of between"),
    ),
    "a symbol without a meaning": (
        *(QUESTIONS, 'b = "the other side"', 'b = " "'),
        *('b = " "', "say in words what the symbol 'b' means"),
    ),
    "a variable that Python keeps": (
        *(QUESTIONS, 'variable = "eggs"', 'variable = "lambda"'),
        *('variable = "lambda"', "which is not a Python name"),
    ),
    "an id that two questions have": (
        *(QUESTIONS, 'id = "Q1.4"', 'id = "Q1.3"'),
        *('id = "Q1.3"\nkind = "expression"', "two questions have this id"),
    ),
    "a variable that two questions have": (
        *(QUESTIONS, 'variable = "rim"', 'variable = "eggs"'),
        *('variable = "eggs"\nprompt = "How long', "Q1.3 and Q1.4 both store"),
    ),
    "a pair of cards against the order": (
        *(ANSWERS, '["stir", "pour"],', '["pour", "stir"],'),
        *('["pour", "stir"],', "the canonical order puts 'stir' before 'pour'"),
    ),
    "a pair with a card that is not there": (
        *(ANSWERS, '["cup", "drink"],', '["mug", "drink"],'),
        *('["mug", "drink"],', "no card has the id 'mug'"),
    ),
    "a mistake with a card that is not there": (
        *(ANSWERS, 'first = "pour"', 'first = "milk"'),
        *('[["Q1.2".alternative]]', "no card has the id 'milk'"),
    ),
    "cards that are not interchangeable": (
        *(ANSWERS, '[["stir", "stir_again"]]', '[["cup", "boil"]]'),
        *("interchangeable = ", "are called interchangeable"),
    ),
    "an order without a card": (
        *(ANSWERS, 'order = ["cup", ', "order = ["),
        *("order = [", "order must name every card"),
    ),
    "two mistakes of one name": (
        *(ANSWERS, 'name = "one box"', 'name = "added"'),
        *('name = "added"\nvalue = 4', "two alternatives have the same name"),
    ),
    "a range of a symbol": (
        *(ANSWERS, "sample = {a = [1.0, 5.0]", "sample = {a = [5.0, 1.0]"),
        *("sample = ", "sample must give 'a' two numbers"),
    ),
    "a symbol without a range": (
        *(ANSWERS, 'derived = {half = "a + b"}\n', ""),
        *("sample = ", "'half' has no range in sample"),
    ),
    "mistakes of a question of statements": (
        ANSWERS,
        '["Q1.1"]\n',
        '["Q1.1"]\nalternative = [{name = "x", credit = 0, feedback = "x"}]\n',
        *("alternative = [{", "put what is wrong into each statement's misconception"),
    ),
    "a level that is twice there": (
        *(ANSWERS, '{name = "missing"', '{name = "named"'),
        *('{name = "named", points = 0', "two levels have the same name"),
    ),
    "levels in a wrong order": (
        *(ANSWERS, "points = 0}", "points = 3}"),
        *("levels = [", "write the levels from the most points"),
    ),
    "points that do not add up": (
        *(ANSWERS, "points = 2}", "points = 1}"),
        *('[["Q1.6".criterion]]', "the best levels add up to 1 points"),
    ),
    "a model that nobody may write": (
        *(ANSWERS, "as hard as the air does.", "as hard as all of the air above it does."),
        *("model = ", "model has 58 characters, and the question takes 50"),
    ),
    "a prediction of two kinds": (
        *(QUESTIONS, "between = [0, 100]", 'between = [0, 100]\nchoices = ["a", "b"]'),
        *("between = [0, 100]", "say either choices"),
    ),
    "a setting": (
        *("pyproject.toml", "[tool.autograder]", '[tool.autograder]\npackages = ["a b"]'),
        *("packages = ", "as they are imported"),
    ),
    "code for the solved notebook": (
        *(ANSWERS, 'code = "3 * 4"\n', ""),
        *('["Q1.3"]', "has no code for the solved notebook"),
    ),
    "a reference of another name": (
        *(ANSWERS, 'solutions.kitchen:mean_weight"', 'solutions.kitchen:total_weight"'),
        *('["Q1.5"]', "must be a function called mean_weight"),
    ),
}


def check_line(course: Toy, file: str, text: str, said: str) -> None:
    (found,) = prove_course(course.root, mutants=False)
    line = re.search(rf"{re.escape(file)},? (?:table .*)?line (\d+)", found)
    assert line is not None, found
    assert int(line[1]) == course.line_of(file, text), found
    assert said in found


@pytest.mark.parametrize("field", FIELDS)
def test_the_line_is_that_of_the_field(toy, field: str):
    file, old, new, text, said = FIELDS[field]
    toy.add("kitchen", TEXT + PREDICTION, RUBRIC)
    toy.append(MASTER, '\n# %% exercise="Q1.6"\n\n# %%\npredict("P1.1")\n')
    toy.replace(file, old, new)
    check_line(toy, file, text, said)


@pytest.mark.parametrize(
    ("file", "old", "new", "text", "said"),
    [
        (QUESTIONS, "{4*price:.2f}", "{4*price:zz}", 'hints = ["A box', "has a format that"),
        (ANSWERS, "{boxes} + 4 adds.", "{boxes/0} adds.", '{name = "added"', "no finite value"),
        (ANSWERS, 'value = "m/2"', 'value = "m/0"', "alternative = [{name", "no finite value"),
    ],
)
def test_a_text_that_its_numbers_do_not_fit(tmp_path, file, old, new, text, said):
    market = make_market(tmp_path / "course")
    market.replace(file, old, new)
    text = text if text != "alternative = [{name" else 'code = "m / 2"\nalternative'
    (found,) = prove_course(market.root, mutants=False)
    further = 1 if text.startswith("code") else 0
    assert f"{file}, line {market.line_of(file, text) + further}: " in found
    assert said in found


@pytest.mark.parametrize(
    ("old", "new", "function", "said"),
    [
        ('"name": "no weights", ', "", "mean_weight_cases", "Case 1 of Q1.5: it needs a"),
        (
            '"""Return the mean of `weights`, a list of numbers in grams; 0 for none."""',
            *("pass", "mean_weight", "has no docstring to tell a student what to write"),
        ),
    ],
)
def test_code_of_the_key_is_named_with_its_own_file_and_line(toy, old, new, function, said):
    toy.replace("solutions/kitchen.py", old, new)
    (found,) = prove_course(toy.root, mutants=False)
    lines = (toy.root / "solutions/kitchen.py").read_text(encoding="utf-8").splitlines()
    number = lines.index(next(line for line in lines if line.startswith(f"def {function}("))) + 1
    assert f"(solutions/kitchen.py, line {number})" in found
    assert said in found


def test_a_question_that_is_asked_twice_is_told_with_both_lines(toy):
    toy.append(MASTER, '\n# %% exercise="Q1.3"\n')
    (found,) = prove_course(toy.root, mutants=False)
    lines = (toy.root / MASTER).read_text(encoding="utf-8").splitlines()
    first, second = (n for n, line in enumerate(lines, 1) if 'exercise="Q1.3"' in line)
    assert f"(1_kitchen.py, line {first}; 1_kitchen.py, line {second})" in found
