"""Questions with variables: the sheet's numbers, and each student's own."""

from __future__ import annotations

import pytest

from autograder.authoring.proof_of_drawn_numbers import prove_variants
from autograder.course.placeholders import fill, fill_text
from autograder.errors import CourseError
from autograder.marking.marker import Marker


def test_variant_0_has_the_sheets_numbers(market):
    course = market.load()
    question = course.question("Q7")
    assert question.prompt.startswith("3 boxes of 4 eggs at $0.5$ each")
    assert question.prompt.endswith(r"$\frac{1}{2}$, $x_{3}$")
    assert question.title == "Eggs at 0.5 each"
    assert question.hints == ("A box costs 2.00.",)
    assert course.key["Q7"].alternatives[0].value == 12
    assert course.key["Q7"].explanation == "3 times 4 is 12."
    assert course.key["Q7"].code == "4 * boxes"


def test_a_student_has_numbers_of_their_own_and_a_story_keeps_them(market):
    course = market.load()
    seen = set()
    for name in ("Ada Lovelace", "17-123-456", "boole", "kepler", "Émilie"):
        own = course.for_student(name)
        numbers = own.numbers("Q7")
        assert numbers == own.numbers("Q7.1")
        seen.add(tuple(numbers.values()))
        assert own.question("Q7").prompt.startswith(f"{numbers['boxes']} boxes")
        assert own.key["Q7"].alternatives[1].value == 4 + numbers["boxes"]
        assert own.question("Q1.3") is course.question("Q1.3")
        assert own.for_student(name).variants == own.variants
    assert len(seen) > 1
    again = course.for_student("  ada   LOVELACE ")
    assert again.numbers("Q7") == course.for_student("Ada Lovelace").numbers("Q7")


def test_every_variant_has_numbers_of_its_own(market):
    variables = market.load().varied["Q7"].variables
    assert variables.count == 4 * 5
    assert len({tuple(variables.numbers(n).values()) for n in range(20)}) == 20
    assert variables.values["price"] == (0.5, 0.1, 0.2, 0.3, 0.4)


def test_a_student_is_marked_by_their_own_numbers(market):
    marker = Marker(market.load(), 3)
    marker.prepare(["Q1.3", "Q7"])
    own = marker.for_student("ada")
    boxes = own.course.numbers("Q7")["boxes"]
    right = own.mark("Q7", {"state": "given", "value": 4 * boxes})
    added = own.mark("Q7", {"state": "given", "value": 4 + boxes})
    assert (right.status, added.alternative) == ("right", "added")
    assert added.feedback == f"{boxes} + 4 adds."
    assert own.drawn("Q1.3") is marker.drawn("Q1.3")


def test_a_function_has_its_own_example_and_one_of_few_sets_of_hidden_inputs(market):
    market.replace(
        "notebooks/questions/kitchen.toml",
        'prompt = "Write a function for the mean of some weights."',
        'prompt = "By hand: the mean of {a} and {a + 2} is {a + 1}."\n'
        "variables = {a = [1, 2, 3, 4]}",
    )
    marker = Marker(market.load(), 3)
    id = next(id for id, q in marker.course.questions.items() if q.kind == "function")
    assert marker.course.question(id).prompt == "By hand: the mean of 1 and 3 is 2."
    drawn = {}
    for name in ("ada", "boole", "curie", "dijkstra", "euler", "fourier", "gauss", "hopper"):
        own = marker.for_student(name)
        a = own.course.numbers(id)["a"]
        assert own.course.question(id).prompt == f"By hand: the mean of {a} and {a + 2} is {a + 1}."
        drawn.setdefault(own.course.variants[id], own.drawn(id))
    assert len(drawn) > 2
    # Two sets for all: to draw one takes long.
    for one in drawn:
        for other in drawn:
            same = one % 2 == other % 2
            assert (drawn[one] is drawn[other]) == same
    assert marker.drawn(id) is drawn.get(0, drawn.get(2))
    assert not list(prove_variants(market.load()))


def test_without_the_setting_everybody_has_the_sheets(market):
    market.replace("pyproject.toml", '"student"', '"sheet"')
    course = market.load()
    assert course.for_student("ada") is course


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("boxes = [3, 5, 7, 11]", "boxes = []", "at least one value"),
        ("boxes = [3, 5, 7, 11]", "boxes = [3, 3]", "stands twice"),
        ("boxes = [3, 5, 7, 11]", 'boxes = ["3"]', "the variable 'boxes'"),
        ("step = 0.1", "step = 0", "the variable 'price'"),
        ("to = 0.4", "to = 0.0", "the variable 'price'"),
        (
            'story = "market"\nvariable = "bought"',
            'story = "m"\nvariable = "bought"',
            "no [story.m]",
        ),
        ('"student"', '"everybody"', "write "),
    ],
)
def test_what_an_author_wrote_wrong_is_said(market, old, new, problem):
    for file in ("notebooks/questions/kitchen.toml", "pyproject.toml"):
        if old in (market.root / file).read_text():
            market.replace(file, old, new)
    with pytest.raises(CourseError) as caught:
        market.load()
    assert problem in str(caught.value)


def test_a_formula_without_a_value_is_said_with_its_numbers(market):
    market.replace("solutions/answers/kitchen.toml", '"4*boxes"', '"log(boxes - 3)"')
    with pytest.raises(CourseError, match=r"Q7 .*no finite value with boxes = 3, price = 0.5"):
        market.load().key  # noqa: B018


def test_braces_of_other_things_stay():
    numbers = {"w": 0.2, "N": 1000}
    text = r"{x} { } {w:.1%} {N} $\frac{N}{2}$ $w^{k}$ {w + unknown} {import os}"
    filled = r"{x} { } 20.0% 1000 $\frac{1000}{2}$ $w^{k}$ {w + unknown} {import os}"
    assert fill_text(text, numbers) == filled
    assert fill({"id": "{w}", "title": ["{w}"], "a": {"b": 1}}, numbers) == {
        "id": "{w}", "title": ["0.2"], "a": {"b": 1},
    }  # fmt: skip


def test_a_variant_that_breaks_the_question_is_named_with_its_numbers(market):
    assert list(prove_variants(market.load())) == []
    market.replace(
        "notebooks/questions/kitchen.toml", "boxes = [3, 5, 7, 11]", "boxes = [3, 5, 0, 7]"
    )
    said = "\n".join(prove_variants(market.load()))
    assert "Q7 with boxes = 0, price = 0.5 (and 4 more variants): the right answer is 0" in said
    market.replace("notebooks/questions/kitchen.toml", "[3, 5, 0, 7]", "[3, 5, 8, 7]")
    market.replace("solutions/answers/kitchen.toml", '"4 + boxes"', '"24 + boxes"')
    # 4 * 8 is 24 + 8: whoever makes the mistake would be right.
    said = "\n".join(prove_variants(market.load()))
    assert "Q7 with boxes = 8" in said
    assert "'added' is taken for 'right'" in said


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        (
            "[3, -5]",
            "Q7.2 with m = -5: the right answer -2.5 has another sign than the sheet's, 1.5",
        ),
        ("[3, 30000]", "Q7.2 with m = 30000: the right answer 15000 is of another size than"),
        ("[1, 3]", "Q7.2 with m = 3: the right answer is 1.5, and the sheet's is a share of one"),
        ("[3, 2.02]", "Q7.2 with m = 2.02: the right answer 1.01 is 1 to 1 decimals"),
    ],
)
def test_a_variant_of_another_kind_or_size_than_the_sheets_is_named(market, values, problem):
    market.replace("notebooks/questions/kitchen.toml", "{m = [3, 4, 5]}", f"{{m = {values}}}")
    assert problem in "\n".join(prove_variants(market.load()))


def test_a_variant_with_half_an_egg_is_named(market):
    market.replace("notebooks/questions/kitchen.toml", "[3, 5, 7, 11]", "[3, 3.3]")
    assert "the right answer 13.2 is not whole" in "\n".join(prove_variants(market.load()))
