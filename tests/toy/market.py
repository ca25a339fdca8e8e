"""The kitchen with three questions of each student's own numbers."""

from __future__ import annotations

from pathlib import Path

from tests.toy import Toy, make_toy

QUESTIONS = """

[story.market]
boxes = [3, 5, 7, 11]
price = {sheet = 0.5, from = 0.1, to = 0.4, step = 0.1}

[[question]]
id = "Q7"
kind = "number"
title = "Eggs at {price} each"
points = 2
story = "market"
variable = "bought"
integer = true
prompt = '''{boxes} boxes of 4 eggs at ${price}$ each: how many eggs? $\\frac{1}{2}$, $x_{boxes}$'''
hints = ["A box costs {4*price:.2f}."]

[[question]]
id = "Q7.1"
kind = "number"
title = "All of them"
points = 1
variable = "cost"
decimals = 2
prompt = "What do they cost?"
hints = ["Multiply."]
story = "market"

[[question]]
id = "Q7.2"
kind = "number"
title = "Alone"
points = 1
variable = "alone"
decimals = 1
prompt = "Halve {m}."
hints = ["Divide."]
variables = {m = [3, 4, 5]}
"""
ANSWERS = """
["Q7"]
explanation = "{boxes} times 4 is {4*boxes}."
code = "4 * boxes"
alternative = [
    {name = "right", credit = 1, value = "4*boxes"},
    {name = "added", credit = 0.25, value = "4 + boxes", feedback = "{boxes} + 4 adds."},
]

["Q7.1"]
code = "4 * boxes * price"
alternative = [{name = "right", credit = 1, value = "4*boxes*price"}]

["Q7.2"]
code = "m / 2"
alternative = [{name = "right", credit = 1, value = "m/2"}]
"""


def make_market(root: Path) -> Toy:
    """The toy course, where students have numbers of their own."""
    return make_toy(root).add("kitchen", QUESTIONS, ANSWERS).set('variants = "student"')
