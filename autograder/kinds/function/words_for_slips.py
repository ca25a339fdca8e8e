"""What a student reads of a change with which the reference gives their results."""

from __future__ import annotations

import re

from autograder.language import N_, _

OWN_NAMES_EXCHANGED = "two quantities exchanged"
_WORDS = {
    OWN_NAMES_EXCHANGED: N_("two quantities in it have changed places"),
    "comparison strict": N_("a comparison leaves out the case of equality, as `<` does for `<=`"),
    "comparison loose": N_("a comparison lets in the case of equality, as `<=` does for `<`"),
    "comparison turned round": N_("a condition is the wrong way round"),
    "truth value turned round": N_("a true stands for a false, or the other way round"),
    "constant one more": N_("a number in it is one too large"),
    "constant one less": N_("a number in it is one too small"),
    "sign turned": N_("a plus stands for a minus, or the other way round"),
    "sign left out": N_("a minus sign was lost"),
    "not left out": N_("a “not” is missing in a condition"),
    "or for and": N_("one of two conditions is enough where both are needed"),
    "and for or": N_("two conditions are needed where one is enough"),
    "part of a condition left out": N_("a condition lacks one of its parts"),
    "arguments exchanged": N_("two arguments of a call have changed places"),
    "always the first": N_("of two cases one is treated like the other"),
    "always the second": N_("of two cases one is treated like the other"),
    "branch left out": N_("a special case is not treated"),
    "branch always taken": N_("what is meant for a special case is done always"),
    "other branch left out": N_("what is to be done otherwise is missing"),
    "raise left out": N_("an error is not raised that is asked for"),
    "statement left out": N_("one step is left out"),
    "early break": N_("a loop ends after its first turn"),
    "loop one short": N_("a loop leaves out its last turn"),
    "first turn left out": N_("a loop leaves out its first turn"),
    "returned element changed": N_("one of the results is twice what it should be"),
    "result changed": N_("the result is twice what it should be"),
    "returned elements exchanged": N_("two results have changed places"),
    "random numbers that are always the same": N_(
        "the random numbers do not come from the generator that was given"
    ),
    "input changed in place": N_("an input is changed in place; work on a copy"),
    "power left out": N_("a power is missing, such as a square"),
    "a product for a power": N_("a product stands for a power"),
    "factor left out": N_("a factor is missing"),
    "a factor once more": N_("a factor is there twice"),
    "not divided": N_("a division is missing"),
    "fraction upside down": N_("a fraction is upside down"),
    "term left out": N_("a term is missing"),
    "zero for a number": N_("a zero stands where another number is asked for"),
    "one for a number": N_("a factor or a number is missing"),
    "nothing for infinity": N_("nothing is returned where infinity is asked for"),
    "zero for infinity": N_("a zero is returned where infinity is asked for"),
    "infinity for a number": N_("infinity is returned where a number is asked for"),
    "nothing returned": N_("nothing is returned in a special case"),
    "a value for an error": N_("something is returned where an error is to be raised"),
    "an absolute value for a square": N_("an absolute value stands for a square"),
    "a square for an absolute value": N_("a square stands for an absolute value"),
    "divided by a length": N_(
        "it was divided by the length of a vector, the root of the sum of its squares, and not by "
        "the sum of its entries"
    ),
    "a length for a sum": N_("the root of a sum of squares stands for a sum of absolute values"),
    "halved": N_("a sum is half of what it should be"),
    "slice one shorter": N_("a range of an array leaves out its last entry"),
    "slice one longer": N_("a range of an array has one entry too many"),
    "one added inside a logarithm": N_("one was added inside of a logarithm"),
    "the opposite direction": N_("a direction is turned round before its angle is taken"),
    "a complement in a power": N_("the probability of the opposite stands in a power"),
    "a complement left out": N_("a share stands for its complement, `x` for `1 - x`"),
    "a share for its logarithm": N_("a share stands where its logarithm is asked for"),
    "one more in a result": N_("the result is one too large"),
    "one less in a result": N_("the result is one too small"),
    "another axis": N_("it runs along the other axis of the array"),
    "an event for its complement": N_(
        "the probability of an event stands for that of its complement"
    ),
}
# What a reference was called with, by the end of the change's name.
_OF_AN_ARGUMENT = {
    "ignored": N_("the argument `{name}` changes nothing: one value stands in its place"),
    "one more": N_("one is added to the argument `{name}`"),
    "one less": N_("one is taken from the argument `{name}`"),
    "doubled": N_("the argument `{name}` is doubled"),
    "halved": N_("the argument `{name}` is halved"),
    "squared": N_("the argument `{name}` is squared"),
    "rooted": N_("the argument `{name}` is rooted"),
    "its columns in reverse order": N_(
        "the function works with {name}, its columns in reverse order"
    ),
    "its rows and columns exchanged": N_(
        "the function works with {name}, its rows and columns exchanged"
    ),
}


def in_words(operator: str, argument: str = "") -> str:
    """A kind of change as a student may read it: nothing of the reference's text is in it."""
    if operator in _WORDS:
        return _(_WORDS[operator])
    if argument:
        return _(_OF_AN_ARGUMENT[operator.removeprefix("argument ")]).format(name=argument)
    if exchanged := re.fullmatch(r"(\w+) and (\w+) exchanged", operator):
        sentence = _("the function works with {one} and {other} exchanged")
        return sentence.format(one=exchanged[1], other=exchanged[2])
    name, between, how = operator.partition(" with ")
    if between:
        return _(_OF_AN_ARGUMENT[how]).format(name=name)
    other, between, name = operator.partition(" for ")
    if between:
        return _("`{other}` stands for `{name}`").format(other=other, name=name)
    name, between, _rest = operator.partition(" left out")
    if between:
        return _("a `{name}` is missing").format(name=name)
    return _("there is a change: {change}").format(change=operator)
