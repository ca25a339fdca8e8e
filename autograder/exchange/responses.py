"""Responses that are kept: what one may be, and the receipt that shows it in a saved notebook.

They come from files and processes of students. Only the standard library is used.
"""

from __future__ import annotations

import json
from typing import Any

RECEIPT = "application/vnd.autograder.response+json"  # the type of an output that is a receipt
Entry = dict[str, Any]  # of a sidecar: what is kept of one question, as JSON

MAX_RESPONSE = 20_000  # characters of one response as JSON
MAX_DEPTH = 32


def plain_response(value: object, depth: int = 0) -> object:
    """A response from an untrusted file as clean JSON: strings are valid text, numbers are finite.

    Raises:
        ValueError: if it is nested too deeply.
    """
    if depth > MAX_DEPTH:
        raise ValueError("nested too deeply")
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode()
    if isinstance(value, list):
        return [plain_response(entry, depth + 1) for entry in value]
    if isinstance(value, dict):
        return {
            plain_response(str(key)): plain_response(entry, depth + 1)
            for key, entry in value.items()
        }
    if isinstance(value, float) and not (abs(value) < float("inf")):
        return None
    return value


def keep_response(id: object, response: object) -> dict[str, object]:
    """``{id: response}`` if both are what a course can hold, else an empty dictionary.

    The response may be anything that a process of a student sent, arrays included.
    """
    if not isinstance(id, str) or not 0 < len(id) <= 40 or not id.isprintable():
        return {}
    try:
        plain = plain_response(response)
        return {id: plain} if len(json.dumps(plain, ensure_ascii=False)) <= MAX_RESPONSE else {}
    except (TypeError, ValueError, RecursionError):
        return {}
