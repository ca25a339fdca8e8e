"""Runs where the student's code runs: turns a response into plain data.

A *probe* says what is to be found out about a response; it carries hidden points or inputs but no
answer. What comes back is one of::

    {"state": "not attempted"}
    {"state": "given", ...}             value, values or outcomes
    {"state": "unusable", "reason": ..} one of `autograder.exchange.why_unusable.REASONS`
    {"state": "raised", "error": ..}    the class of the exception, and its text only ("told")
                                        where the probe says that nothing in it is hidden

How a response is read is the business of its kind: the probe names the kind, and the module whose
``evaluate`` does it where that is not in the kind's folder here. The trusted side decides what it
is worth. The same code serves the grader's sandbox and a student's own notebook.
"""

from __future__ import annotations

import importlib
import pkgutil
from contextlib import suppress

from autograder.exchange.messages import Message
from autograder.sandbox.inside.exceptions import tell
from autograder.sandbox.inside.plain_data import Unusable, describe, public_name

_KINDS = "autograder.kinds"  # a folder for each kind of question

__all__ = ["describe", "evaluate", "load_kinds"]


def evaluate(response: object, probe: Message) -> Message:
    """Turn a response into plain data, as the probe's kind asks."""
    if response is ...:
        return {"state": "not attempted"}
    try:
        name = probe.get("inside") or _inside(probe["kind"])
        inside = importlib.import_module(name)
        return {"state": "given", **inside.evaluate(response, probe)}
    except NotImplementedError:
        return {"state": "not attempted"}
    except Unusable as unusable:
        return {"state": "unusable", "reason": str(unusable)}
    except Exception as error:
        told = {"told": tell(error)} if probe.get("tell") is True else {}
        return {"state": "raised", "error": public_name(error), **told}


def load_kinds() -> None:
    """Import what the kinds bring along, so that no fork has to."""
    for entry in pkgutil.iter_modules(importlib.import_module(_KINDS).__path__):
        if entry.ispkg:
            with suppress(ModuleNotFoundError):  # a kind whose responses are data has nothing here
                importlib.import_module(_inside(entry.name))


def _inside(kind: str) -> str:
    return f"{_KINDS}.{kind}.inside.evaluate"
