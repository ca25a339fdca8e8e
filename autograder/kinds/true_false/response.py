"""How a list of true and false is understood and shown."""

from __future__ import annotations

from autograder.errors import UsageError
from autograder.kinds.true_false.question import TrueFalse
from autograder.language import _, n_
from autograder.questions.given_entries import given_entries


def chosen(question: TrueFalse, response: object) -> list[bool | None] | None:
    """The response, if it is a list of True, False or None, one for each statement; else None."""
    if not isinstance(response, list | tuple) or len(response) != len(question.statements):
        return None
    if not all(choice is None or isinstance(choice, bool) for choice in response):
        return None
    return list(response)


def fits(question: TrueFalse, response: object) -> bool:
    """Whether it is a response to this question."""
    return chosen(question, response) is not None


def read_response(question: TrueFalse, response: object) -> list[bool | None]:
    """A response given in code, as it is kept.

    Raises:
        UsageError: if it does not fit the question.
    """
    choices = chosen(question, given_entries(response))
    if choices is None:
        count = len(question.statements)
        raise UsageError(
            n_(
                "{question} has {count} statement: respond with a list of {count} True or False "
                "(None leaves one open). Nothing was changed.",
                "{question} has {count} statements: respond with a list of {count} True or False "
                "(None leaves one open). Nothing was changed.",
                count,
            ).format(question=question.id, count=count)
        )
    return choices


def in_words(response: list[bool | None]) -> str:
    """A kept response in one line."""
    words = {True: _("true"), False: _("false"), None: _("open")}
    return " · ".join(f"{n} {words[said]}" for n, said in enumerate(response, 1))


def lines(question: TrueFalse, response: list[bool | None] | None) -> list[str]:
    """The statements and what was called true or false so far, as Markdown."""
    choices = response or [None] * len(question.statements)
    words = {True: f" → **{_('true')}**", False: f" → **{_('false')}**", None: ""}
    return [
        *(
            f"{n}. {statement}{words[choice]}"
            for n, (statement, choice) in enumerate(
                zip(question.statements, choices, strict=False), 1
            )
        ),
        "",
        _(
            "Answer with a line of code: put `True` or `False` for each `None` that you have "
            "decided."
        ),
        "",
        f"`{respond_line(question, response)}`",
    ]


def respond_line(question: TrueFalse, response: list[bool | None] | None) -> str:
    """A line of code that gives this response, open where nothing was said."""
    return f'ask("{question.id}").respond({list(response or [None] * len(question.statements))})'
