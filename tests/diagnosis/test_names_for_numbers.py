"""Wrong numbers are named by how they come out of the right one, or of its formula."""

import pytest

from autograder.kinds.number.answer import NumberAlternative, NumberAnswer
from autograder.kinds.number.diagnosis import diagnose_number
from autograder.kinds.number.question import Number
from autograder.questions.drawn import Around

CASTS = "math.ceil(math.log(1 - p) / math.log(1 - w**2))"
HERE = Around(numbers={"p": 0.95, "w": 0.2, "N": 1000})


def asked(id="Q9", **fields):
    """A question; a whole number is asked for unless decimals are."""
    fields = fields if "decimals" in fields else {"integer": True, **fields}
    return Number(id=id, title=f"title of {id}", prompt="p", hints=("h",), points=1, chapter="c",
                  variable="x", **fields)  # fmt: skip


def key(*right, wrong=(), code="", id="Q9"):
    """The answer with these right values, after those that are wrong."""
    known = [NumberAlternative(name=f"{v}", credit=0.5, feedback="f", value=v) for v in wrong]
    known += [NumberAlternative(name=f"{v}", credit=1.0, value=v) for v in right]
    return NumberAnswer(id=id, code=code, alternatives=tuple(known))


def name(value, *right, code="", around=HERE, **fields):
    found = diagnose_number(asked(**fields), key(*right, code=code), value, around)
    return found and found.name


@pytest.mark.parametrize(
    ("value", "found"),
    [
        (-12.25, "sign turned"), (24.5, "twice"), (6.125, "half"), (1225, "in percent"),
        (0.1225, "a hundredth"), (-11.25, "complement"), (1 / 12.25, "reciprocal"),
        (13.25, "one more"), (11.25, "one less"), (150.0625, "squared"), (3.5, "its root"),
        (12, "rounded"), (13, "rounded up"), (5.3201, "common logarithm"),
        (5.32, "common logarithm"), (5.321, None),
        (25, None), (1200, None),  # a whole number is not taken for a rounded one
    ],
)  # fmt: skip
def test_a_number_is_named_by_its_simplest_relation_to_the_right_one(value, found):
    assert name(value, 12.25, decimals=2) == found
    assert name(value, 777, 12.25, decimals=2) == found  # of several right ones


@pytest.mark.parametrize(
    ("value", "right", "found"),
    [
        (0.82, 0.1800494, "complement"), (18.005, 0.1800494, "in percent"),
        (0.42, 0.1800494, None),  # its root is 0.4243, but two digits are near many things
        (0.6, 0.36, "its root"),  # exactly
        (0.4243, 0.1800494, "its root"),
        # Half of the last digit away from what they are rounded from, and no further.
        (0.82, 0.1834, "complement"), (0.82, 0.185, "complement"), (0.82, 0.1858, None),
        (24.5, 12.27, "twice"), (0.4, 0.1834, None), (0.43, 0.1834, None),
        (0.428, 0.1834, "its root"),
    ],
)  # fmt: skip
def test_a_number_of_few_digits_is_named_by_the_plainest_relations_only(value, right, found):
    assert name(value, right, decimals=2) == found


@pytest.mark.parametrize(
    ("value", "found"),
    [(-74, "sign turned"), (148, "twice"), (37, "half"), (75, "one more"), (73, "one less"),
     (5476, "squared"), (73.5, None), (76, None)],
)  # fmt: skip
def test_a_whole_number_is_named_only_if_it_is_met_exactly(value, found):
    assert name(value, 74) == found


@pytest.mark.parametrize("value", [200_003, 200_000.4])
def test_a_large_whole_number_is_named_only_if_it_is_met_exactly(value):
    assert name(200_000, 100_000) == "twice"
    assert name(value, 100_000) is None
    assert name(100_002, 100_001) == "one more"
    assert (
        name(100_003, 100_001, code="math.ceil(N / 8)", around=Around(numbers={"N": 800_002}))
        is None
    )


@pytest.mark.parametrize(
    ("value", "right", "found"),
    [
        (777, 777.1, None),
        (777, 777.27, None),
        (777, 777.35, "rounded"),
        (5, 0.0, None),  # one divided by it is no number
    ],
)
def test_what_leads_to_a_right_number_is_no_mistake(value, right, found):
    assert name(value, right, decimals=2) == found


def test_a_right_number_has_no_name():
    assert name(74, 74, code=CASTS) is None
    assert name(12.25, 12.25, decimals=2) is None


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (0.1, "it was rounded to fewer decimals than are asked for"),
        (0.12, "it was rounded to fewer decimals than are asked for"),
        (0.125, "it was rounded up, and not to the nearest"),
        (0.123, None),  # as right as 0.124 to the question's tolerance
    ],
)
def test_a_number_that_was_rounded_otherwise_is_told_how(value, words):
    for right in ((0.12449,), (0.777, 0.12449)):
        found = diagnose_number(asked(decimals=3), key(*right), value)
        if words is None:
            assert found is None or found.name != "rounded too coarsely"
        else:
            assert found is not None
            assert found.name == "rounded too coarsely"
            assert found.sentence == f"It looks as if {words}."


def test_a_number_that_was_cut_off_is_told_so():
    found = diagnose_number(asked(decimals=3), key(0.12367), 0.123)
    assert found is not None
    assert found.sentence == "It looks as if it was cut off, and not rounded to the nearest."


def test_the_answer_to_a_question_around_is_recognised():
    neighbors = tuple(
        (asked(id, decimals=2), key(*values, wrong=wrong, id=id))
        for id, values, wrong in (
            ("Q1", [41.37], [41.37 / 7]),
            ("Q2", [12.252], []),
            ("Q3", [58.91, 61.7], []),
        )
    )
    around = Around(neighbors=neighbors)
    for value, id in ((41.37, "Q1"), (41.4, "Q1"), (58.91, "Q3"), (61.7, "Q3")):
        found = diagnose_number(asked(decimals=2), key(12.25), value, around)
        assert found is not None
        assert found.name == "another question's answer"
        assert found.sentence == (
            f"It looks as if this is the answer to {id}, 'title of {id}'; what is different here?"
        )
    for value in (41.37 / 7, 12.2531, 50.0):  # a mistake there; as good as the right one; neither
        assert name(value, 12.25, around=around, decimals=2) is None


FAILED = "(1 - w**2)**42"
CHOSEN = "math.comb(n, 3)"


@pytest.mark.parametrize(
    ("code", "right", "value", "found"),
    [
        (CASTS, 74, 73.38, "not rounded"),
        (CASTS, 74, 14, "power left out"),
        (CASTS, 74, 373, "a number one more"),
        (CASTS, 74, 51, "binary logarithm"),
        (CASTS, 74, 14.4, None),
        (CASTS, 74, 2, None),  # comes out of two slips, and tells neither
        (CASTS, 74, 6, "a product for a power"),
        (CASTS, 74, 32, "common logarithm"),
        (CHOSEN, 35, 20, "n - 1 for n"),  # the first of all
        (CHOSEN, 35, 105, "multiplied once more"),  # the last of all
        (CHOSEN, 35, 343, "a power for a choice"),
        (CHOSEN, 35, 7, "one for each"),
        ("k * 3 + 1", 10, 7, None),
        ("k * 3 + 1", 10, 13, "k + 1 for k"),
        ("j * 5 + 5", 15, 10, "j - 1 for j"),  # or a part of it: from 10 on the first is told
        ("math.ceil(k * 41 / 9)", 14, 13.7, "not rounded"),
    ],
)
def test_a_whole_number_is_named_by_the_slip_in_the_formula_that_gives_it(
    code, right, value, found
):
    around = Around(numbers={"p": 0.95, "w": 0.2, "n": 7, "j": 2, "k": 3})
    assert name(value, right, code=code, around=around) == found


@pytest.mark.parametrize(
    ("value", "found"),
    [
        (40.32, "a product for a power"),
        (40.3, "a product for a power"),
        (0.96, "power left out"),  # exactly
        (0.7137, "a number one more"),
        (0.71, None),  # two digits are near many things
        (0.71366, "a number one more"),
        (0.7138, None),
        (0.18, None),
        (7.5621, "multiplied once more"),
        (0, "rounded"),
    ],
)
def test_another_number_is_named_by_a_slip_if_its_digits_tell(value, found):
    assert name(value, 0.9**0.5, 0.1800494453, code=FAILED, decimals=2) == found


def test_words_are_told_in_the_sentence():
    found = diagnose_number(asked(), key(74, code=CASTS), 51, HERE)
    assert found is not None
    assert found.sentence == "It looks as if a binary logarithm stands beside a natural one."


@pytest.mark.parametrize(
    ("value", "found"),
    [
        (0.4099753, "complement, then half"),
        (0.41, "complement, then half"),
        (-0.3600988, "sign turned, then twice"),
        (0.6723188, "complement, then squared"),
        (0.672, "complement, then squared"),
        (0.67, None),  # two digits are near many things
        (42.43223, "its root, then in percent"),
        (0.0180049, None),
    ],
)
def test_two_things_at_once_are_named_in_their_order(value, found):
    assert name(value, 0.1800494, decimals=2) == found
    assert name(value, 555.0, 0.1800494, decimals=2) == found


def test_two_things_are_not_looked_for_in_whole_numbers():
    assert name(-148, 74) is None
    assert name(36.5, 74) is None
