"""What a function returns for the cases of a probe. Runs beside the student's code."""

from __future__ import annotations

from types import GeneratorType

import numpy as np

from autograder.exchange.messages import Message, Value
from autograder.kinds.function.inside.counted_draws import CountedDraws
from autograder.sandbox.inside.exceptions import tell
from autograder.sandbox.inside.plain_data import Unusable, public_name, to_plain

_LAZY = (GeneratorType, map, filter, zip, range, enumerate)  # nothing has been computed yet


def evaluate(response: object, probe: Message) -> Message:
    """One outcome a case: {"value": ..}, {"unusable": reason} or {"raised": class}.

    With a value comes "changed": true if an argument was changed in place, and "drawn", how many
    random numbers were taken, if an argument was a generator of them; "sampled" is the size and the
    number of the samples, where only such were taken.

    Raises:
        NotImplementedError: if the response is still the stub that was handed out.
        Unusable: if the response is no function.
    """
    if not callable(response):
        raise Unusable("not a function")
    outcomes: list[Message] = []
    told = None
    as_handed_out = 0  # cases on which the function was still the stub
    # Only of inputs that are not hidden, or before a hidden one was sent: a message may quote what
    # the function was called with.
    telling = probe.get("tell", ())
    for place, case in enumerate(probe["cases"]):
        arguments = [_argument(argument) for argument in case["args"]]
        keywords = {name: _argument(value) for name, value in case.get("kwargs", {}).items()}
        try:
            returned = response(*arguments, **keywords)
            if type(returned) in _LAZY:
                raise Unusable("lazy")
            outcome = {"value": to_plain(returned)}
            given = [*arguments, *keywords.values()]
            if not _same(given, [*case["args"], *case.get("kwargs", {}).values()]):
                outcome["changed"] = True
            generators = [value for value in given if isinstance(value, CountedDraws)]
            if generators:
                outcome["drawn"] = sum(generator.drawn for generator in generators)
            if len(generators) == 1 and generators[0].sampled:
                outcome["sampled"] = list(generators[0].sampled)
            outcomes.append(outcome)
        except Unusable as unusable:
            outcomes.append({"unusable": str(unusable)})
        except Exception as error:
            as_handed_out += _is_from_its_own_stub(error, response)
            outcomes.append({"raised": public_name(error)})
            if told is None and (telling is True or place in telling):
                told = tell(error)
    if outcomes and as_handed_out == len(outcomes):
        raise NotImplementedError
    return {"outcomes": outcomes, **({"told": told} if told else {})}


def _is_from_its_own_stub(error: BaseException, response: object) -> bool:
    """Whether it comes from this function as it was handed out, maybe decorated.

    A function that is written may call one of another question that is not.
    """
    if not isinstance(error, NotImplementedError):
        return False
    place = error.__traceback__
    while place is not None and place.tb_next is not None:
        place = place.tb_next
    if place is None:
        return False
    code = place.tb_frame.f_code
    is_stub = code.co_names == ("NotImplementedError",)
    own = code is getattr(response, "__code__", None)
    return is_stub and (own or code.co_name == getattr(response, "__name__", None))


def _argument(value: object) -> Value:
    """A fresh copy of an argument, so that changing it in place cannot reach the next case."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, dict):
        if value.keys() == {"rng"}:
            return CountedDraws(value["rng"])
        return {key: _argument(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_argument(entry) for entry in value]
    return value


def _same(given: Value, sent: Value) -> bool:
    """Whether an argument is still what was sent; a generator may have been used."""
    if isinstance(sent, np.ndarray):
        # Compared as bytes: NaN is equal to itself, and a zero that lost its sign is not.
        return isinstance(given, np.ndarray) and (
            (given.dtype, given.shape) == (sent.dtype, sent.shape)
            and given.tobytes() == sent.tobytes()
        )
    if type(given) is CountedDraws:
        return True
    if isinstance(sent, list):
        same_length = isinstance(given, list) and len(given) == len(sent)
        return same_length and all(map(_same, given, sent))
    if isinstance(sent, dict):
        same_keys = isinstance(given, dict) and given.keys() == sent.keys()
        return same_keys and all(_same(given[key], sent[key]) for key in sent)
    return bool(given is sent or given == sent or sent != sent)
