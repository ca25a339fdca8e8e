"""What counts is what a value becomes, not its bytes."""

import json
import subprocess
import sys

import numpy as np
import pytest

from autograder.exchange import wire
from autograder.exchange.unpacked_size import count_parts, unpacked_bytes
from autograder.kinds.function.drawn_outcomes import shown_value

CAP = 8 * 2**20


def frame_of(shape, code="|i1", count=1):
    """A frame that claims arrays of a shape, as a hostile process would write it by hand."""
    size = int(np.prod(shape, dtype=object)) * int(code[-1])
    body = [{"~": "array", "at": at} for at in range(count)]
    text = json.dumps({"body": body, "arrays": [[code, list(shape)]] * count}).encode()
    return text, bytes(size * count)


def read(text, raw):
    parts = [wire.HEADER.pack(len(text), len(raw)), text, raw]
    return wire.read_message(lambda count: parts.pop(0), CAP, CAP)


@pytest.mark.parametrize(
    "shape",
    [
        (2**28, 0),
        (0, 2**28)[::-1],
        (2**20, 0, 5),
        (2**14, 2**14, 0),
        (2**22, 1),
        (1,) * 20 + (2**23,),
    ],
)
def test_an_array_that_would_become_millions_of_lists_is_refused(shape):
    text, raw = frame_of(shape)
    if len(raw) <= CAP and unpacked_bytes(shape, 1) <= wire.UNPACKED * CAP:
        assert read(text, raw)[0].shape == shape
    else:
        with pytest.raises(wire.WireError):
            read(text, raw)


def test_many_small_arrays_without_entries_count_together():
    assert len(read(*frame_of((2**6, 0), count=1000))) == 1000
    with pytest.raises(wire.WireError):
        read(*frame_of((2**12, 0), count=1000))


@pytest.mark.parametrize("shape", [(640, 426, 3), (100_000, 2), (1000, 1000), (0,), (0, 2), ()])
def test_what_honest_functions_return_is_taken(shape):
    array = np.zeros(shape)
    parts = wire.encode(array, CAP)
    text_length, _ = wire.HEADER.unpack(parts[: wire.HEADER.size])
    end = wire.HEADER.size + text_length
    assert (
        wire.decode(parts[wire.HEADER.size : end], parts[end:], wire.UNPACKED * CAP).shape == shape
    )


@pytest.mark.parametrize(
    "value",
    [
        np.zeros((2**28, 0)),
        np.zeros(2**21),
        [[]] * 2**20,
        "x" * 2**24,
        [np.zeros((2**17, 0))] * 100,
    ],
    ids=["no columns", "many numbers", "empty lists", "a long text", "many arrays"],
)
def test_the_writer_knows_what_the_reader_will_not_take(value):
    with pytest.raises(wire.TooLarge):
        wire.encode(value, CAP)


def test_the_parts_of_a_value_are_counted_up_to_a_limit():
    assert count_parts([[], [1, {"a": 2}]], 100) == 6
    assert count_parts([[]] * 10**6, 100) == 101


@pytest.mark.parametrize(
    "value",
    [np.zeros((2**28, 0)), np.zeros((400, 400, 0)), [[]] * 5000, [[[]] * 400] * 400],
    ids=["rows", "nested rows", "lists", "nested lists"],
)
def test_what_holds_no_number_is_not_kept_to_be_drawn(value):
    assert shown_value(value) is None


def test_a_few_points_are_kept_to_be_drawn():
    assert shown_value(np.ones((200, 2))) == [[1.0, 1.0]] * 200


def test_the_worst_messages_stay_within_the_budget_of_the_trusted_process():
    """Each is read, and what passes is unpacked, shown and compared, in a process of its own."""
    code = """
import json, resource
import numpy as np
from autograder.exchange import wire
from autograder.exchange.replies import clean_evaluation
from autograder.kinds.function.marking import close
from autograder.kinds.function.drawn_outcomes import shown_value
CAP = 8 * 2**20
start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
def answer(body, arrays=(), size=0):
    text = json.dumps({"body": {"state": "given", "outcomes": [{"value": body}]},
                       "arrays": list(arrays)}).encode()
    parts = [wire.HEADER.pack(len(text), size), text, bytes(size)]
    try:
        reply = wire.read_message(lambda count: parts.pop(0), CAP, CAP)
    except wire.WireError:
        return
    for outcome in clean_evaluation(reply)["outcomes"]:
        value = outcome.get("value")
        shown_value(value)
        for expected in (1.0, [1.0], [[1.0]], np.zeros(3), "x", None, np.zeros(2**20)):
            close({}, expected, value)
        if isinstance(value, np.ndarray):
            close({}, np.zeros(value.shape), value)
            value.tolist()
one = {"~": "array", "at": 0}
shapes = [((2**28, 0), "<f8"), ((2**20, 0), "<f8"), ((2**20 - 2**14, 0), "<f8"),
          ((2**23,), "|i1"), ((2**23,), "|b1"), ((2**20,), "<f8"), ((2**19, 1), "<c16"),
          ((2**22, 2), "|i1")]
for shape, code in shapes:
    answer(one, [[code, shape]], int(np.dtype(code).itemsize * np.prod(shape, dtype=object)))
answer([[]] * 500_000)
answer([{}] * 260_000)
answer([10**300] * 20_000)
answer(["x" * 4_000_000, *[1] * 500_000])
deep = []
for _ in range(60):
    deep = [deep]
answer([deep] * 4000)
answer([{"~": "array", "at": at} for at in range(10_000)], [["<f8", [100, 0]]] * 10_000)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - start)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(done.stdout) < 2**20, "more than 1 GB"
