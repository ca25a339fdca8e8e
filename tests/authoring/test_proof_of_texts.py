"""Texts that say something else than what was typed are found; all others are left alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from autograder.authoring.proof_of_texts import prove_texts
from tests.toy import Toy, make_toy

QUESTIONS = "notebooks/questions/kitchen.toml"
PROMPT = '"Three boxes of four eggs: how many eggs?"'
VARIABLES = 'integer = true\nvariables = {boxes = [3, 5], share = [0.5, 0.25]}\nunit = "eggs"'


@pytest.fixture
def eggs(tmp_path: Path) -> Toy:
    toy = make_toy(tmp_path / "course")
    toy.replace(QUESTIONS, 'integer = true\nunit = "eggs"', VARIABLES)
    return toy


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        (
            '"{boxs} boxes?"',
            "{boxs} is not filled in: there is no variable 'boxs'; perhaps 'boxes'",
        ),
        ('"${boxs}$?"', "perhaps 'boxes' is meant"),
        ('"{100*shar:g} %?"', "perhaps 'share' is meant"),
        ('"{root(boxes)}?"', "'root' is neither a variable nor a function of formulas"),
        (
            r"'A half of {boxes}: $\frac{1}{2}'",
            "a $ has no partner: a formula begins and ends with",
        ),
        ('"$x$ and y^2$ = 3 of {boxes}?"', "a $ has no partner"),
        (r'"$\tan(x)$ of {boxes}?"', r"reads \t as a sign of its own: write \\tan with"),
        (r'"An angle $\beta$?"', r"write \\beta with two backslashes"),
        (r'"A density $\rho$?"', r"write \\rho with two backslashes"),
        (r'"A frequency $\nu$?"', r"write \\nu with two backslashes"),
        (r"'''$\frac{1}{2}$ of\n'''".replace("'''", '"""'), r"write \\frac with two backslashes"),
    ],
)
def test_a_text_that_is_not_what_was_typed_is_told_with_its_line(eggs, prompt, said):
    eggs.replace(QUESTIONS, PROMPT, prompt)
    (problem,) = prove_texts(eggs.load())
    assert said in problem
    assert problem.startswith("question 'Q1.3' in notebooks/questions/kitchen.toml, line 3")


@pytest.mark.parametrize(
    "prompt",
    [
        r"'$\theta$, $\frac{n}{boxes}$ and {boxes}'",
        r'"$\\theta_{i}$ and a set {a, b} of {boxes:g}"',
        r'"A table:\n\n| a\t| b |\nnow $5 and\nnot $6"',
        r'"$x_{boxes k}$, \\frac{1}{2}, {} and {share:.2f}"',
        "'It costs $5 in {boxes}, or `$a_b = 3`: ${boxes}$'",
        "'''\n$\\nu$\n{sqrt(boxes):.1f}\n'''",
    ],
)
def test_other_texts_are_left_alone(eggs, prompt):
    eggs.replace(QUESTIONS, PROMPT, prompt)
    assert list(prove_texts(eggs.load())) == []


def test_a_prediction_is_read_too(eggs):
    eggs.append(
        QUESTIONS,
        '\n[[prediction]]\nid = "P1.1"\nprompt = "How far is $\\theta$?"\nbetween = [0, 9]\n',
    )
    (problem,) = prove_texts(eggs.load())
    assert problem.startswith("prediction 'P1.1' in notebooks/questions/kitchen.toml, line 6")
