"""Why a response is none: the words that cross, and what they mean, translated where shown."""

from autograder.language import N_

REASONS = {
    "text": N_("it is a string; write it without quotes"),
    "equation": N_("it is an equation; give only the side that is asked for"),
    "callable": N_("it is a function; give the value or expression itself"),
    "not a number": N_("it is not a number"),
    "not finite": N_("it is not a finite number"),
    "empty": N_("it is empty; there is no value in it"),
    "set": N_("it is a set; give one expression out of it"),
    "several": N_("it holds several values; give the one that is asked for"),
    "symbols left": N_("it still contains symbols; put the numbers in"),
    "symbol unknown": N_("it contains a symbol that this question does not declare"),
    "not an expression": N_("it is not a sympy expression"),
    "not evaluable": N_("it has no value at the points where it was tried"),
    "not a function": N_("it is not a function"),
    "not plain": N_("it returned something that is not a number, text, list, dictionary or array"),
    "lazy": N_("it returned a generator, of which nothing was computed yet; make a list of it"),
    "too large": N_("it returned far more than any answer to this question needs"),
    "missing": N_("nothing of that name is there"),
}
UNREAD = N_("it could not be read")
