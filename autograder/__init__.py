"""Questions in a notebook, marked outside of it: what a notebook imports.

``ask`` shows a question, ``hint`` a hint, ``check`` marks a response, ``predict`` keeps a
prediction, which ``predicted`` gives to a picture; ``progress`` sums up, ``submit`` packs what is
handed in. Where students have numbers of their own, ``me`` says whose they are, and ``numbers``
gives them. ``practise`` asks for more of the same.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.student.api import (
        ask,
        check,
        hint,
        me,
        numbers,
        practise,
        predict,
        predicted,
        progress,
        submit,
    )

__version__ = "0.1.0"
__all__ = [
    "ask",
    "check",
    "hint",
    "me",
    "numbers",
    "practise",
    "predict",
    "predicted",
    "progress",
    "submit",
]


def __getattr__(name: str) -> object:
    """Load the notebook side only where a notebook asks for it: the grader starts faster."""
    if name in __all__:
        from autograder.student import api

        return getattr(api, name)
    raise AttributeError(f"module 'autograder' has no attribute {name!r}")
