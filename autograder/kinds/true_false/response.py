"""How a list of true and false is understood and shown."""

from __future__ import annotations

from typing import Any

from autograder.errors import UsageError
from autograder.kinds.true_false.question import TrueFalse


def fits(question: TrueFalse, response: object) -> bool:
    """Whether the response is a list of True, False or None, one for each statement."""
    return (
        isinstance(response, list | tuple)
        and len(response) == len(question.statements)
        and all(said is None or isinstance(said, bool) for said in response)
    )


def read_response(question: TrueFalse, response: Any) -> list[bool | None]:
    """A response given in code, as it is kept.

    Raises:
        UsageError: if it does not fit the question.
    """
    if not fits(question, response):
        count = len(question.statements)
        raise UsageError(
            f"{question.id} has {count} statements: respond with a list of {count} True or "
            "False (None leaves one open). Nothing was changed."
        )
    return list(response)


def in_words(response: list[bool | None]) -> str:
    """A kept response in one line."""
    words = {True: "true", False: "false", None: "open"}
    return " · ".join(f"{n} {words[said]}" for n, said in enumerate(response, 1))


def lines(question: TrueFalse, response: list[bool | None] | None) -> list[str]:
    """The statements and what was called true or false so far, as Markdown."""
    choices = response or [None] * len(question.statements)
    words = {True: " → **true**", False: " → **false**", None: ""}
    return [
        *(
            f"{n}. {statement}{words[choice]}"
            for n, (statement, choice) in enumerate(
                zip(question.statements, choices, strict=False), 1
            )
        ),
        "",
        f'Answer with `ask("{question.id}").respond([True, False, ...])`.',
    ]
