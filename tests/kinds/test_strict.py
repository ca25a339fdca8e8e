"""What an author wrote wrong is said with its line and with what to write."""

from __future__ import annotations

import tomllib

import pytest

from autograder.errors import CourseError
from autograder.kinds.number.answer import NumberAnswer
from autograder.questions.strict_reader import Place, read_table
from autograder.questions.toml_lines import line_of

TEXT = '''# a key
["Q1"]
explanation = """
value = 3 is no field, and ["Q2"] no table
"""
[["Q1".alternative]]
name = "right"
value = 3
credit = 1.0

[["Q1".alternative]]
name = 'half'
"value" = 6
credit = 0.5
feedback = "Halve it."

["Q2"]
alternative = [{name = "right", value = 1, credit = 1}]

["Q4"]
cards = [  # of a list, each entry has its line
    # the first
    {id = "a", text = "a ] here"},

    {id = "b", text = "b"},
]
order = ["a",
    "b"]
[["Q4".alternative]]
name = "last"
'''


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("Q1",), 2),
        (("Q1", "explanation"), 3),
        (("Q1", "alternative", 0, "value"), 8),
        (("Q1", "alternative", 1), 11),
        (("Q1", "alternative", 1, "value"), 13),
        (("Q1", "alternative", 1, "tolerance"), 11),
        (("Q2", "alternative", 0, "value"), 18),
        (("Q3",), None),
        (("Q4", "cards", 0, "text"), 23),
        (("Q4", "cards", 1), 25),
        (("Q4", "order", 1), 27),
        (("Q4", "alternative"), 29),
        (("Q4", "alternative", 0, "name"), 30),
    ],
)
def test_the_line_of_a_field(path, line):
    assert line_of(TEXT, path) == line


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"value" = 6', '', "line 11: in alternative 'half', the field 'value' is missing"),
        ("credit = 0.5", "credit = 5", "line 14: credit of alternative 'half' is 5"),
        ("credit = 0.5", "credit = nan", "line 14: credit of alternative 'half' is not a finite"),
        ("credit = 0.5", "credit = 0.5\ntoleranz = 1", "line 15: in alternative 'half', unknown "),
        ("credit = 0.5", "credit = 0.5\ntoleranz = 1", "perhaps 'tolerance' is meant"),
        ('feedback = "Halve it."', "", "line 11: in alternative 'half', the mistake 'half' has no"),
        ("value = 3\nc", "value = '3'\nc", "value of alternative 'right' is '3', and must be a nu"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_its_line(old, new, sentence):
    text = TEXT.replace(old, new)
    assert text != TEXT
    with pytest.raises(CourseError) as caught:
        read_table(tomllib.loads(text)["Q1"], NumberAnswer, Place("the key", text, ("Q1",)))
    assert sentence in str(caught.value)
