"""Reading the key: what does not fit its question is said in one sentence that says where."""

import contextlib
import copy
import tomllib
from typing import Any

import pytest

from autograder.course.answers import answer_from_table
from autograder.course.questions import question_from_table
from autograder.errors import CourseError
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.function.answer import FunctionAnswer
from autograder.kinds.number.answer import NumberAnswer
from autograder.kinds.order.answer import OrderAnswer
from autograder.kinds.true_false.answer import TrueFalseAnswer
from tests.toy import text_of

KITCHEN = "solutions/answers/kitchen.toml"
TEXT = text_of(KITCHEN)
ANSWERS = tomllib.loads(TEXT)
QUESTIONS = {
    table["id"]: question_from_table(table, "kitchen")
    for table in tomllib.loads(text_of("notebooks/questions/kitchen.toml"))["question"]
}


def test_a_sound_key_is_read_as_it_is_written(toy):
    key = toy.load().key
    water, tea, eggs, rim, mean = (key[f"Q1.{n}"] for n in range(1, 6))
    assert isinstance(water, TrueFalseAnswer)
    assert [statement.truth for statement in water.statements] == [True, False, True]
    assert isinstance(tea, OrderAnswer)
    assert tea.order == ("cup", "boil", "stir", "pour", "stir_again", "drink")
    assert ("cup", "drink") in tea.before
    assert tea.interchangeable == (("stir", "stir_again"),)
    assert isinstance(eggs, NumberAnswer)
    assert [(entry.value, entry.credit) for entry in eggs.alternatives] == [
        (12, 1.0),
        (7, 0.25),
        (4, 0.0),
    ]
    assert isinstance(rim, ExpressionAnswer)
    assert rim.sample == {"a": (1.0, 5.0), "b": (1.0, 5.0)}
    assert rim.derived == {"half": "a + b"}
    assert isinstance(mean, FunctionAnswer)
    assert (mean.reference, mean.compare) == ("solutions.kitchen:mean_weight", None)


# A mistake of an author: what stands there, what is put there, what the sentence must name.
MISTAKES: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "an unknown field": ('code = "3 * 4"', 'kode = "3 * 4"', ("Q1.3", "'kode'")),
    "an unknown field of a mistake": ("value = 7", "value = 7\nreason = 1", ("added", "'reason'")),
    "a mistake without a name": ('name = "added"\n', "", ("Q1.3", "'name'")),
    "a mistake without credit": ("value = 7\ncredit = 0.25\n", "value = 7\n", ("Q1.3", "'credit'")),
    "a mistake without a value": ("value = 7\n", "", ("Q1.3", "'value'")),
    "a mistake without feedback": (
        'feedback = "That is one box; there are three of them."',
        "",
        ("Q1.3", "'one box'", "feedback"),
    ),
    "a mistake with blank feedback": (
        '"That is one box; there are three of them."',
        '"  "',
        ("Q1.3", "'one box'", "feedback"),
    ),
    "too much credit": ("value = 7\ncredit = 0.25", "value = 7\ncredit = 25", ("Q1.3", "credit")),
    "negative credit": ("value = 7\ncredit = 0.25", "value = 7\ncredit = -1", ("Q1.3", "credit")),
    "credit that is no number": ("7\ncredit = 0.25", "7\ncredit = nan", ("Q1.3", "credit")),
    "credit that is a truth value": ("7\ncredit = 0.25", "7\ncredit = true", ("Q1.3", "credit")),
    "a value that is text": ("value = 7", 'value = "7"', ("Q1.3", "value")),
    "a value that is a truth value": ("value = 7", "value = true", ("Q1.3", "value")),
    "a value that is infinite": ("value = 7", "value = inf", ("Q1.3", "value")),
    "a tolerance that is negative": ("value = 7", "value = 7\ntolerance = -1", ("Q1.3",)),
    "two mistakes with one name": ('name = "one box"', 'name = "added"', ("Q1.3", "same name")),
    "code that is a number": ('code = "3 * 4"', "code = 12", ("Q1.3", "code")),
    "a statement too few": (
        "\n".join(TEXT.split("\n")[10:14]),
        "",
        ("Q1.1", "2 statements", "asks 3"),
    ),
    "a truth that is text": ("truth = false", 'truth = "false"', ("Q1.1", "truth")),
    "a truth that is a number": ("truth = false", "truth = 0", ("Q1.1", "truth")),
    "a statement without its misconception": (
        'misconception = "Think of a road in winter, and of what is strewn on it."',
        "",
        ("Q1.1", "statement 3", "'misconception'"),
    ),
    "an empty explanation of a statement": (
        '"At sea level, at normal pressure."',
        '""',
        ("Q1.1", "statement 1", "explanation"),
    ),
    "a blank explanation of a statement": (
        '"At sea level, at normal pressure."',
        '" "',
        ("Q1.1", "statement 1", "explanation"),
    ),
    "an order without a card": ('order = ["cup", ', "order = [", ("Q1.2", "order")),
    "an order with a card twice": ('order = ["cup", ', 'order = ["boil", ', ("Q1.2", "order")),
    "a pair of an unknown card": ('["cup", "drink"]', '["mug", "drink"]', ("Q1.2", "'mug'")),
    "a pair of three": ('["cup", "drink"]', '["cup", "boil", "drink"]', ("Q1.2", "before")),
    "a pair that is text": ('["cup", "drink"]', '"cd"', ("Q1.2", "before")),
    "a canonical order against the graph": (
        '["cup", "drink"]',
        '["drink", "cup"]',
        ("Q1.2", "'cup'", "'drink'"),
    ),
    "an unknown interchangeable card": ('[["stir", "stir_again"]]', '[["stir", "x"]]', ("'x'",)),
    "interchangeable cards of different text": (
        '[["stir", "stir_again"]]',
        '[["stir", "pour"]]',
        ("Q1.2", "'stir'", "'pour'"),
    ),
    "a mistake about an unknown card": ('first = "pour"', 'first = "tea"', ("Q1.2", "'tea'")),
    "a symbol without a range": (", b = [1.0, 5.0]}", "}", ("Q1.4", "sample", "derived")),
    "a symbol that is not declared": ("{half =", "{whole =", ("Q1.4", "sample", "derived")),
    "a range of one number": ("b = [1.0, 5.0]", "b = [1.0]", ("Q1.4", "sample")),
    "a range that is a number": ("b = [1.0, 5.0]", "b = 1.0", ("Q1.4", "sample")),
    "a range of texts": ("b = [1.0, 5.0]", 'b = ["1", "5"]', ("Q1.4", "sample")),
    "a range upside down": ("b = [1.0, 5.0]", "b = [5.0, 1.0]", ("Q1.4", "sample")),
    "an infinite range": ("b = [1.0, 5.0]", "b = [1.0, inf]", ("Q1.4", "sample")),
    "a derived symbol that is a number": ('{half = "a + b"}', "{half = 3}", ("Q1.4", "derived")),
    "free of an unknown symbol": (
        'derived = {half = "a + b"}',
        'derived = {half = "a + b"}\nfree_of = ["z"]',
        ("Q1.4", "free_of"),
    ),
    "free of a derived symbol": (
        'derived = {half = "a + b"}',
        'derived = {half = "a + b"}\nfree_of = ["half"]',
        ("Q1.4", "free_of"),
    ),
    "an empty formula": ('expression = "a*b"', 'expression = ""', ("Q1.4", "expression")),
    "a function without its reference": (
        'reference = "solutions.kitchen:mean_weight"\n',
        "",
        ("Q1.5", "'reference'"),
    ),
    "a comparison that is a list": ('cases = "', 'compare = []\ncases = "', ("Q1.5", "compare")),
    "alternatives that are no tables": (
        '["Q1.1"]',
        '["Q1.1"]\nalternative = ["x"]',
        ("Q1.1", "alternative"),
    ),
    "an alternative of statements": (
        '["Q1.2"]',
        '[["Q1.1".alternative]]\nname = "x"\ncredit = 0.5\nfeedback = "y"\n["Q1.2"]',
        ("Q1.1",),
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_the_key_is_said_with_file_and_question(toy, mistake):
    old, new, named = MISTAKES[mistake]
    toy.replace(KITCHEN, old, new)
    with pytest.raises(CourseError) as refused:
        assert toy.load().key
    sentence = str(refused.value)
    assert "\n" not in sentence
    assert sentence.endswith(".")
    for word in (*named, KITCHEN):
        assert word in sentence


def test_an_answer_that_is_no_table_is_said(toy):
    (toy.root / "solutions/answers/cellar.toml").write_text('"Q2.1" = 3\n')
    with pytest.raises(CourseError, match=r"Q2\.1 in solutions/answers/cellar\.toml"):
        assert toy.load().key


WRONG: list[Any] = [True, 0, -1, 1.5, float("nan"), "", "a b", [], [1], [[]], {}, {"a": 1}]
WRONG += [None, [""], ["x"], [{}], [["a"]], [["a", "b", "c"]], [None], {"a": [1]}, {"a": ["x", 1]}]


@pytest.mark.parametrize("id", ANSWERS)
def test_any_field_of_a_wrong_type_is_a_course_error_or_harmless(id):
    for field in ANSWERS[id]:
        for value in WRONG:
            table = copy.deepcopy(ANSWERS[id]) | {field: value}
            with contextlib.suppress(CourseError):
                assert answer_from_table(table, QUESTIONS[id]).id == id


@pytest.mark.parametrize("id", ANSWERS)
def test_any_field_of_a_wrong_type_in_a_list_is_a_course_error_or_harmless(id):
    """The same one level deeper: in the statements and alternatives."""
    for lists in ("statement", "alternative"):
        for position, entry in enumerate(ANSWERS[id].get(lists, [])):
            for field in entry:
                for value in WRONG:
                    table = copy.deepcopy(ANSWERS[id])
                    table[lists][position][field] = value
                    with contextlib.suppress(CourseError):
                        assert answer_from_table(table, QUESTIONS[id]).id == id
