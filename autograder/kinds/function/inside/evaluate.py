"""What a function returns for the cases of a probe. Runs beside the student's code."""

from __future__ import annotations

from typing import Any

import numpy as np

from autograder.sandbox.inside.plain_data import Unusable, public_name, to_plain


def evaluate(response: Any, probe: dict[str, Any]) -> dict[str, Any]:
    """One outcome a case: its value, why that cannot be used, or the exception it raised.

    Raises:
        Unusable: if the response is no function.
    """
    if not callable(response):
        raise Unusable("not a function")
    outcomes: list[dict[str, Any]] = []
    for case in probe["cases"]:
        arguments = [_argument(argument) for argument in case["args"]]
        keywords = {name: _argument(value) for name, value in case.get("kwargs", {}).items()}
        try:
            outcomes.append({"value": to_plain(response(*arguments, **keywords))})
        except NotImplementedError:
            raise
        except Unusable as unusable:
            outcomes.append({"unusable": str(unusable)})
        except Exception as error:
            outcomes.append({"raised": public_name(error)})
    return {"outcomes": outcomes}


def _argument(value: Any) -> Any:
    """A fresh copy of an argument, so that changing it in place cannot reach the next case."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, dict):
        if value.keys() == {"rng"}:
            return np.random.default_rng(value["rng"])
        return {key: _argument(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_argument(entry) for entry in value]
    return value
