"""Why a response is none: the words that cross, and what they mean."""

REASONS = {
    "text": "it is a string; write it without quotes",
    "equation": "it is an equation; give only its right-hand side",
    "callable": "it is a function; give the value or expression itself",
    "not a number": "it is not a number",
    "not finite": "it is not a finite number",
    "several": "it holds several values; give the one that is asked for",
    "symbols left": "it still contains symbols; put the numbers in",
    "symbol unknown": "it contains a symbol that this question does not declare",
    "not an expression": "it is not a sympy expression",
    "not evaluable": "it has no value at the points where it was tried",
    "not a function": "it is not a function",
    "not plain": "it returned something that is not a number, text, list, dictionary or array",
    "lazy": "it returned a generator, of which nothing was computed yet; make a list of it",
    "too large": "it returned far more than any answer to this question needs",
    "missing": "nothing of that name is there",
}
