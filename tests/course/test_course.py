"""Loading a course: what an author gets wrong is said in one sentence, with file and question."""

import contextlib
import copy
import re
import tomllib
from typing import Any

import pytest

from autograder.course import find_course_root, load_course
from autograder.course.questions import question_from_table
from autograder.errors import CourseError, UsageError
from autograder.kinds.expression.question import Expression
from autograder.kinds.function.question import Function
from autograder.kinds.number.question import Number
from autograder.kinds.order.question import Order
from autograder.kinds.true_false.question import TrueFalse
from tests.toy import refusal, text_of

KITCHEN = "notebooks/questions/kitchen.toml"
TABLES = {table["kind"]: table for table in tomllib.loads(text_of(KITCHEN))["question"]}


def test_a_sound_course_has_its_chapters_and_questions_in_order(toy):
    course = toy.load()
    assert [chapter.name for chapter in course.chapters] == ["kitchen", "cellar"]
    assert list(course.questions) == ["Q1.1", "Q1.2", "Q1.3", "Q1.4", "Q1.5", "Q2.1"]
    kinds = [TrueFalse, Order, Number, Expression, Function, Number]
    assert [type(question) for question in course.questions.values()] == kinds
    assert sum(question.points for question in course.questions.values()) == 3 + 5 + 2 + 4 + 4 + 1
    assert list(course.key) == list(course.questions)
    assert course.question("Q1.3").name == "eggs"
    assert course.question("Q1.5").name == "mean_weight"
    assert course.question("Q1.1").name is None


def test_chapters_stand_in_the_order_of_the_masters_numbers(toy):
    source = toy.root / "notebooks/source"
    (source / "1_kitchen.py").rename(source / "3_kitchen.py")
    assert [chapter.name for chapter in toy.load().chapters] == ["cellar", "kitchen"]


def test_a_question_that_does_not_exist_is_refused_with_the_ids_that_do(toy):
    with pytest.raises(UsageError, match=r"no question 'Q9'.* Q1\.1, .*Q2\.1"):
        toy.load().question("Q9")


# A mistake of an author: what stands there, what is put there, what the sentence must name.
QUESTION_MISTAKES: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "a field is missing": ('title = "Eggs"\n', "", ("Q1.3", "'title'", "kitchen.toml")),
    "the points are missing": ("points = 4\nvariable", "variable", ("Q1.4", "'points'")),
    "the hints are missing": ('hints = ["Divide by what?"]', "", ("Q1.5", "'hints'")),
    "an unknown field": ('unit = "eggs"', 'units = "eggs"', ("Q1.3", "'units'", "kitchen.toml")),
    "an unknown kind": ('kind = "expression"', 'kind = "term"', ("Q1.4", "'term'")),
    "an empty list of hints": ('hints = ["Count one box first."]', "hints = []", ("Q1.3", "hints")),
    "an empty hint": ('["Count one box first."]', '["Count.", ""]', ("Q1.3", "hints")),
    "a blank hint": ('["Count one box first."]', '["Count.", "  "]', ("Q1.3", "hints")),
    "a hint that is no text": ('["Count one box first."]', "[3]", ("Q1.3", "hints")),
    "hints that are no list": ('["Count one box first."]', '"Count."', ("Q1.3", "hints")),
    "an empty prompt": ('"How long is the rim of a tray of the given sides?"', '""', ("Q1.4",)),
    "a blank title": ('title = "Eggs"', 'title = "  "', ("Q1.3", "title")),
    "points that are text": ("points = 2", 'points = "2"', ("Q1.3", "points")),
    "points that are a truth value": ("points = 2", "points = true", ("Q1.3", "points")),
    "fewer points than none": ("points = 2", "points = -1", ("Q1.3", "points")),
    "negative points": ("points = 2", "points = -2", ("Q1.3", "points")),
    "infinite points": ("points = 2", "points = inf", ("Q1.3", "points")),
    "points that are no number": ("points = 2", "points = nan", ("Q1.3", "points")),
    "points for statements": ('title = "Water"', 'title = "Water"\npoints = 3', ("Q1.1", "points")),
    "an empty statement": ('"Ice sinks in water.", ', '"", ', ("Q1.1", "statements")),
    "two cards with one id": ('id = "pour"', 'id = "boil"', ("Q1.2", "card")),
    "a card without text": (', text = "Fetch a cup"', "", ("Q1.2", "card")),
    "a card of empty text": ('"Fetch a cup"', '""', ("Q1.2", "card")),
    "neither integer nor decimals": ("integer = true\n", "", ("Q1.3", "integer")),
    "an integer with decimals": (
        "integer = true\n",
        "integer = true\ndecimals = 2\n",
        ("Q1.3", "decimals"),
    ),
    "a negative number of decimals": ("integer = true\n", "decimals = -1\n", ("Q1.3", "decimals")),
    "decimals that are a fraction": ("integer = true\n", "decimals = 1.5\n", ("Q1.3", "decimals")),
    "a variable that is no name": (
        'variable = "eggs"',
        'variable = "2 eggs"',
        ("Q1.3", "'2 eggs'"),
    ),
    "a variable that is a keyword": ('variable = "eggs"', 'variable = "is"', ("Q1.3", "'is'")),
    "a function that is no name": ('"mean_weight"', '"mean-weight"', ("Q1.5", "'mean-weight'")),
    "a symbol that is no name": ('half = "half', '"1/2" = "half', ("Q1.4", "'1/2'")),
    "a symbol without a meaning": ('a = "one side"', 'a = ""', ("Q1.4", "'a'")),
    "a symbol that means a number": ('a = "one side"', "a = 3", ("Q1.4", "'a'")),
    "an id of another form": ('id = "Q1.3"', 'id = "eggs"', ("'eggs'", "kitchen.toml", "Q3.2.1")),
    "an id that is a number": ('id = "Q1.3"', "id = 13", ("13", "kitchen.toml")),
    "no id": ('id = "Q1.3"\n', "", ("id", "kitchen.toml")),
    "an id used twice in a chapter": ('id = "Q1.3"', 'id = "Q1.4"', ("Q1.4", "kitchen.toml")),
    "an id used in another chapter": (
        'id = "Q1.3"',
        'id = "Q2.1"',
        ("Q2.1", "kitchen.toml", "cellar.toml"),
    ),
    "two questions with one variable": (
        'variable = "rim"',
        'variable = "eggs"',
        ("'eggs'", "Q1.3", "Q1.4", "kitchen.toml"),
    ),
    "a variable with the name of a function": (
        'variable = "rim"',
        'variable = "mean_weight"',
        ("'mean_weight'", "Q1.4", "Q1.5", "kitchen.toml"),
    ),
}


@pytest.mark.parametrize("mistake", QUESTION_MISTAKES)
def test_a_mistake_in_the_questions_is_said_with_file_and_question(toy, mistake):
    old, new, named = QUESTION_MISTAKES[mistake]
    toy.replace(KITCHEN, old, new)
    sentence = refusal(toy)
    for word in named:
        assert word in sentence


def test_the_same_variable_in_two_chapters_is_fine(toy):
    toy.replace("notebooks/questions/cellar.toml", '"share"', '"eggs"')
    assert toy.load().question("Q2.1").name == "eggs"


@pytest.mark.parametrize("kind", TABLES)
def test_any_field_of_a_wrong_type_is_a_course_error_or_harmless(kind):
    """Whatever TOML can hold in place of a field: a question comes out, or one sentence."""
    wrong: list[Any] = [True, 0, -1, 1.5, float("nan"), "", "a b", [], [1], [[]], {}, {"a": 1}]
    wrong += [None, [""], ["x"], [{}], [{"id": 1, "text": 2}], [None], {"a b": "c"}, {"": ""}]
    for field in TABLES[kind]:
        for value in wrong:
            table = copy.deepcopy(TABLES[kind]) | {field: value}
            with contextlib.suppress(CourseError):
                assert question_from_table(table, "kitchen").points >= 0


FILE_MISTAKES = {
    "broken TOML": ('title = "The kitchen"', 'title = "The kitchen'),
    "no title": ('title = "The kitchen"', ""),
    "a title that is a number": ('title = "The kitchen"', "title = 3"),
    "a field of nobody's": ('title = "The kitchen"', 'title = "K"\nauthor = "A"'),
}


@pytest.mark.parametrize("mistake", FILE_MISTAKES)
def test_a_mistake_in_a_file_is_said_with_its_name(toy, mistake):
    toy.replace(KITCHEN, *FILE_MISTAKES[mistake])
    assert "kitchen.toml" in refusal(toy)


@pytest.mark.parametrize(
    "text",
    [
        'title = "The cellar"\n[question]\nid = "Q2.1"\n',
        'title = "The cellar"\nquestion = ["Q2.1"]\n',
        'title = "The cellar"\nquestion = "Q2.1"\n',
    ],
)
def test_questions_that_are_no_list_of_tables_are_said(toy, text):
    (toy.root / "notebooks/questions/cellar.toml").write_text(text)
    assert "cellar.toml" in refusal(toy)


def test_a_file_in_another_encoding_is_said(toy):
    path = toy.root / KITCHEN
    path.write_bytes(path.read_text().encode("utf-16"))
    assert "kitchen.toml" in refusal(toy)


def test_a_course_without_questions_is_said(toy):
    for path in (toy.root / "notebooks/questions").iterdir():
        path.unlink()
    assert "holds no questions" in refusal(toy)


def test_a_folder_that_is_no_course_is_said(tmp_path):
    with pytest.raises(CourseError, match=r"no course in .* it has no folder"):
        load_course(tmp_path)


def test_looking_for_a_course_where_there_is_none_above_is_said(tmp_path, monkeypatch):
    monkeypatch.delenv("AUTOGRADER_COURSE", raising=False)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(CourseError, match=r"no course in .* or above it"):
        load_course()


def test_a_missing_file_of_answers_is_said(toy):
    (toy.root / "solutions/answers/cellar.toml").unlink()
    sentence = refusal(toy)
    assert "cellar.toml" in sentence
    assert "missing" in sentence


def test_an_answer_that_is_missing_is_said(toy):
    (toy.root / "solutions/answers/cellar.toml").write_text("")
    assert "line 4: it has no answer; add one to solutions/answers/cellar.toml" in refusal(toy)


def test_an_answer_that_nobody_asked_for_is_said(toy):
    toy.append("solutions/answers/cellar.toml", '\n["Q2.7"]\nexplanation = "x"\n')
    sentence = refusal(toy)
    assert re.match(r"solutions/answers/cellar.toml, line \d+: it answers Q2.7, which", sentence)


def test_without_the_key_the_questions_load_and_marking_is_refused(toy):
    (toy.root / "solutions").rename(toy.root / "elsewhere")
    course = toy.load()
    assert not course.has_key
    assert len(course.questions) == 6
    with pytest.raises(CourseError, match="There is no key"):
        assert course.key


def test_the_course_is_found_from_any_folder_inside_it(toy, monkeypatch):
    inside = toy.root / "notebooks/questions"
    assert find_course_root(inside) == toy.root
    monkeypatch.chdir(inside)
    assert find_course_root() == toy.root


def test_a_variable_of_the_environment_names_the_course(toy, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AUTOGRADER_COURSE", str(toy.root))
    assert load_course().root == toy.root


def test_every_question_of_the_sheet_is_asked_and_answered(real_course):
    """The sheet's numbering, with Q2.2 in steps and the two parts of Q3.2.3."""
    sheet = ["Q1.1", "Q1.2", "Q2.1", "Q3.1", "Q3.2.1", "Q3.2.2", "Q3.2.4", "Q3.2.5"]
    steps = ["Q2.2a", "Q2.2b", "Q2.2c", "Q2.2d", "Q2.2e", "Q3.2.3a", "Q3.2.3b"]
    assert {*sheet, *steps} <= real_course.questions.keys()
    assert any(id.startswith("Q2.2f") for id in real_course.questions)
    assert real_course.key.keys() == real_course.questions.keys()


def test_no_question_of_the_real_course_lacks_hints_or_two_known_mistakes(real_course):
    for id, question in real_course.questions.items():
        assert all(len(hint) > 15 for hint in question.hints), id
        if isinstance(question, Number | Expression | Function):
            mistakes = [entry for entry in real_course.key[id].alternatives if entry.is_mistake]
            assert len(mistakes) >= 2, id
