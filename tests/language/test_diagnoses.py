"""Diagnoses in German: no sentence that a wrong response can be given stays English."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest

from autograder import language
from autograder.diagnosis.relations import RELATIONS, looks_as_if
from autograder.kinds.expression.diagnosis import _of_one_place
from autograder.kinds.expression.slopes import slopes
from autograder.kinds.expression.wrong_throughout import wholes
from autograder.kinds.function.changed_values import changes
from autograder.kinds.function.right_but_for_form import repairs
from autograder.kinds.function.words_for_slips import _WORDS, in_words
from autograder.kinds.number.variations import variations
from autograder.kinds.order.diagnosis import diagnose_order
from autograder.mutants.formula_edits import edited_formulas
from autograder.questions.key_formulas import evaluate_formula

# Words of every second English sentence, and of no German one.
ENGLISH = re.compile(r"\b(the|is|are|of|and|not|stands?|returned|result|results|asked)\b")
FORMULA = "a*sin(2*b)**2 + c**2/(1 - a) - atan2(b, c)/2"
SYMBOLS = ("a", "b", "c")


@pytest.fixture(autouse=True)
def _german() -> Iterator[None]:
    language.use("de")
    yield
    language.use("")


def english(sentences: Iterator[str]) -> list[str]:
    """The sentences in which an English word is left; there must be some sentences."""
    said = list(sentences)
    assert said
    return [
        sentence for sentence in said if ENGLISH.search(re.sub("`[^`]*`|„[^“]*“", "", sentence))
    ]


def test_the_words_that_tell_english_are_in_the_english_sentences():
    language.use("en")
    assert len(english(words for _, words, _ in repairs())) > 100


def test_relations_alone_and_two_together():
    first, second = RELATIONS[:2]
    assert english(relation.diagnosis.sentence for relation in RELATIONS) == []
    assert english(iter([first.and_then(second).sentence])) == []


def test_changes_and_repairs_of_what_a_function_returns():
    value = [np.arange(3.0), np.arange(3.0)]
    cases = [{"name": "some", "args": [np.arange(3.0), 1.0]}]
    made = changes(cases, [{"value": value}], [0])
    assert english(diagnosis.sentence for diagnosis, _ in made) == []
    assert english(words for _, words, _ in repairs()) == []


def test_slips_in_a_function():
    forms = ("x and y exchanged", "x with its columns in reverse order", "max for min",
             "x with its rows and columns exchanged", "sqrt left out")  # fmt: skip
    assert english(in_words(operator) for operator in (*_WORDS, *forms)) == []
    assert english(in_words(f"argument {how}", "x") for how in ("squared", "rooted")) == []


def test_what_went_wrong_in_a_formula():
    operators = {mutant.operator for mutant, _ in edited_formulas(FORMULA, SYMBOLS)}
    assert english(_of_one_place(operator) for operator in operators) == []
    assert english(words for _, words, _ in wholes(FORMULA, SYMBOLS)) == []
    at = {symbol: np.linspace(0.1, 0.4, 5) for symbol in SYMBOLS}
    found = slopes(evaluate_formula, FORMULA, SYMBOLS, at)
    assert english(words for _, words, _ in found) == []


@pytest.mark.parametrize(
    "code", ["math.ceil(math.log(1 - p) / math.log(1 - w**2))", "math.comb(N, 3)", "N * (1 - w)"]
)
def test_another_way_to_compute_a_number(code: str):
    found = variations(code, {"p": 0.95, "w": 0.2, "N": 1000})
    assert english(words for _, words, _ in found) == []


@pytest.mark.parametrize(
    "order",
    [
        "bcdefgha",
        "habcdefg",
        "afcdebgh",
        "hgfedcba",
        "abfedcgh",
        "fghabcde",
        "cdefghab",
        "ghcdefab",
    ],
)
def test_cards_in_a_wrong_order(order: str):
    right = tuple("abcdefgh")
    after = {card: set(right[n + 1 :]) for n, card in enumerate(right)}
    found = diagnose_order(tuple(order), right, after, {card: card.upper() for card in right})
    assert found is not None
    assert english(iter([found.sentence])) == []
    assert found.sentence.startswith("Es sieht so aus, als ")


def test_a_clause_becomes_a_sentence():
    assert looks_as_if("ein Faktor fehlte") == "Es sieht so aus, als ob ein Faktor fehlte."
