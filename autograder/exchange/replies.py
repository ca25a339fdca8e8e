"""Checks what came out of a sandbox: whatever student code sent, only clean data goes on."""

from __future__ import annotations

import builtins
import re
from typing import TypeGuard

import numpy as np

from autograder.exchange.messages import Evaluation, Message, Outcome, Report, Told
from autograder.exchange.printable import printable
from autograder.exchange.responses import keep_response
from autograder.exchange.why_unusable import REASONS

_CLASS_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,60}")
_MAX_TEXT = 200
_MAX_TABLE = 2**24  # characters of a list as an array of texts
NOT_PLAIN: Evaluation = {"state": "unusable", "reason": "not plain"}


def clean_report(reply: object, cells: int) -> Report:
    """The report on a run: one error (class name or None) a cell, responses, understood texts."""
    reply = _dictionary(reply)
    errors = reply.get("errors")
    errors = errors if isinstance(errors, list) and len(errors) == cells else [None] * cells
    told = reply.get("told")
    told = told if isinstance(told, list) and len(told) == cells else [None] * cells
    responses: dict[str, object] = {}
    for id, response in _dictionary(reply.get("responses")).items():
        responses |= keep_response(id, response)
    return {
        "errors": [error if error is None else _class_name(error) for error in errors],
        "told": [clean_told(entry) for entry in told],
        "responses": responses,
        "understood": {
            name: clean_text(text) for name, text in _dictionary(reply.get("understood")).items()
        },
    }


def clean_evaluation(reply: object) -> Evaluation:
    """The reply to a probe, in the form that `autograder.sandbox.inside.evaluate` describes."""
    reply = _dictionary(reply)
    state = reply.get("state")
    # An array in its place would raise on being compared.
    match state if isinstance(state, str) else None:
        case "not attempted":
            return {"state": "not attempted"}
        case "raised":
            return {"state": "raised", "error": _public_name(reply.get("error"))}
        case "unusable" if _is_reason(reply.get("reason")):
            return {"state": "unusable", "reason": reply["reason"]}
        case "given" if isinstance(reply.get("outcomes"), list):
            outcomes = [_outcome(entry) for entry in reply["outcomes"]]
            told = clean_told(reply.get("told"))
            given: Evaluation = {"state": "given", "outcomes": outcomes}
            if told:
                given["told"] = told
            return given
        case "given" if isinstance(reply.get("values"), np.ndarray):
            return {"state": "given", "values": reply["values"]}
        case "given" if _is_number(reply.get("value")):
            return {"state": "given", "value": reply["value"]}
    return NOT_PLAIN


def clean_told(entry: object) -> Told | None:
    """What was told of an exception: kind, message, maybe module, line and source; or None."""
    entry = _dictionary(entry)
    if not entry:
        return None
    line = entry.get("line")
    return {
        "kind": _class_name(entry.get("kind")),
        "message": clean_text(entry.get("message"), 300),
        "module": clean_text(entry.get("module"), 100),
        "line": line if type(line) is int and 0 < line < 100_000 else 0,
        "source": clean_text(entry.get("source")),
    }


def clean_text(text: object, limit: int = _MAX_TEXT) -> str:
    """One printable line without control characters or halves of characters."""
    if not isinstance(text, str):
        return ""
    line = printable(text[: 2 * limit], " ")
    return " ".join(line.split())[:limit]


def _outcome(entry: object) -> Outcome:
    entry = _dictionary(entry)
    if "value" in entry:
        if entry.keys() <= {"value", "changed", "drawn", "sampled"} and _is_bounded(entry["value"]):
            clean: Outcome = {"value": entry["value"]}
            if "changed" in entry:
                clean["changed"] = True
            if type(entry.get("drawn")) is int:
                clean["drawn"] = entry["drawn"]
            if _is_pair_of_counts(sampled := entry.get("sampled")):
                clean["sampled"] = sampled
            return clean
    elif len(entry) == 1:
        ((kind, value),) = entry.items()
        if kind == "raised":
            return {"raised": _public_name(value)}
        if kind == "unusable" and _is_reason(value):
            return {"unusable": value}
    return {"unusable": "not plain"}


def _is_pair_of_counts(value: object) -> TypeGuard[list[int]]:
    return type(value) is list and len(value) == 2 and all(type(count) is int for count in value)


def _is_bounded(value: object) -> bool:
    """Whether NumPy can be given the value, whatever is then compared with it.

    It makes an array of texts out of a list that holds one, each as long as the longest: a long
    text beside many short entries would take gigabytes.
    """
    entries, longest = 0, 0
    left = [value]
    while left:
        item = left.pop()
        if isinstance(item, list):
            left += item
        elif isinstance(item, dict):
            left += item.values()
        elif isinstance(item, np.ndarray):
            entries += item.size
        else:
            entries += 1
            longest = max(longest, len(item) if isinstance(item, str) else 0)
    return entries * longest <= _MAX_TABLE


def _is_reason(value: object) -> bool:
    return isinstance(value, str) and value in REASONS


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | complex) and not isinstance(value, bool)


def _class_name(value: object) -> str:
    if isinstance(value, str) and _CLASS_NAME.fullmatch(value):
        return value
    return "Exception"


def _public_name(value: object) -> str:
    if not isinstance(value, str):
        return "Exception"
    known = getattr(builtins, value, None)
    if value == "LinAlgError" or (isinstance(known, type) and issubclass(known, BaseException)):
        return value
    return "Exception"


def _dictionary(value: object) -> Message:
    return value if isinstance(value, dict) else {}
