"""The wire: what goes in comes out, and nothing else gets through or runs."""

import contextlib
import io
import json
import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from autograder.exchange import wire
from autograder.exchange.replies import NOT_PLAIN, clean_evaluation, clean_report, clean_text
from autograder.exchange.wire import HEADER, WireError, encode, read_message
from autograder.sandbox.conversation import _carries
from autograder.sandbox.stop_errors import stop_by


def read(data: bytes, **caps: int):
    stream = io.BytesIO(data)

    def read_exactly(count: int) -> bytes:
        part = stream.read(count)
        if len(part) < count:
            raise EOFError
        return part

    return read_message(read_exactly, **caps)


def frame(text: bytes, raw: bytes = b"") -> bytes:
    return HEADER.pack(len(text), len(raw)) + text + raw


_plain = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**30), 10**30)
    | st.floats(allow_nan=False)
    | st.text(max_size=8)
    | st.complex_numbers(allow_nan=False)
    | hnp.arrays(st.sampled_from([np.float64, np.int32, np.bool_, np.complex128]), (2, 3)),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.text(max_size=3) | st.just("~"), inner, max_size=3)
    ),
    max_leaves=12,
)


def same(a, b) -> bool:
    if isinstance(a, np.ndarray):
        return (
            isinstance(b, np.ndarray)
            and a.dtype == b.dtype
            and np.array_equal(a, b, equal_nan=a.dtype.kind in "fc")
        )
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    return type(a) is type(b) and a == b


@settings(max_examples=150, deadline=None)
@given(_plain)
def test_plain_data_comes_out_as_it_went_in(value):
    assert same(read(encode(value)), value)


@settings(max_examples=300, deadline=None)
@given(st.binary(max_size=120))
def test_any_bytes_are_a_message_or_refused(data):
    with contextlib.suppress(WireError, EOFError):
        read(data, max_json=1000, max_arrays=1000)


_json = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4)
    | st.sampled_from(["<f8", "|O", "<U4", "complex", "array", "dict", "|b1", "(9,9)f8", "f4,f4"]),
    lambda inner: st.lists(inner, max_size=4)
    | st.dictionaries(
        st.sampled_from(["~", "body", "arrays", "items", "at", "re", "im"]), inner, max_size=4
    ),
    max_leaves=20,
)  # fmt: skip


@settings(max_examples=300, deadline=None)
@given(_json, _json, st.binary(max_size=40))
def test_any_json_in_a_frame_is_a_message_or_refused(body, table, raw):
    for message in (body, {"body": body, "arrays": table}, {"body": body, "arrays": [table]}):
        with contextlib.suppress(WireError):
            read(frame(json.dumps(message).encode(), raw))


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**16), st.integers(0, 255), _plain)
def test_a_message_with_a_byte_changed_is_a_message_or_refused(position, byte, value):
    data = bytearray(encode(value))
    data[position % len(data)] = byte
    with contextlib.suppress(WireError, EOFError):
        read(bytes(data), max_json=10**6, max_arrays=10**6)


# What can stand in a message; `_json` is what can stand in its bytes.
_sent = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.complex_numbers()
    | st.text(st.characters(), max_size=4)
    | hnp.arrays(st.sampled_from([np.float64, np.int8, np.bool_, np.complex64]), st.integers(0, 2))
    | st.sampled_from(["given", "raised", "unusable", "missing", "not attempted", "TypeError"]),
    lambda inner: st.lists(inner, max_size=4)
    | st.dictionaries(
        st.sampled_from(["state", "reason", "error", "errors", "value", "values", "outcomes",
                         "raised", "unusable", "responses", "understood", "Q1", "nonce"]),
        inner, max_size=5,
    ),
    max_leaves=20,
)  # fmt: skip


@settings(max_examples=400, deadline=None)
@given(_sent)
def test_whatever_a_message_says_the_rest_of_the_grader_gets_clean_data(value):
    report = clean_report(value, 2)
    assert len(report["errors"]) == 2
    json.dumps(report, allow_nan=False).encode()
    reply = clean_evaluation(value)
    assert reply["state"] in ("given", "raised", "unusable", "not attempted")
    assert isinstance(reply.get("reason", ""), str)
    assert isinstance(reply.get("error", ""), str)
    assert stop_by(value).status in ("timeout", "killed")
    assert not _carries(value, "nonce of the question")


@pytest.mark.parametrize("odd", [np.arange(2), np.array("given"), 1j, [], {}, True], ids=str)
def test_what_takes_the_place_of_a_text_is_as_good_as_nothing(odd):
    assert clean_evaluation({"state": odd}) == NOT_PLAIN
    assert clean_evaluation({"state": "raised", "error": odd})["error"] == "Exception"
    assert clean_evaluation({"state": "unusable", "reason": odd}) == NOT_PLAIN
    assert clean_evaluation({"state": "given", "outcomes": [{"raised": odd}, {"unusable": odd}]})
    assert clean_report({"errors": [odd]}, 1)["errors"] == ["Exception"]
    assert clean_report({"understood": {"k": odd}}, 0)["understood"] == {"k": ""}
    assert clean_report({"responses": {"Q1": 1j, "Q2": [np.arange(2)]}}, 0)["responses"] == {}
    assert stop_by(odd).status == "killed"
    assert not _carries({"nonce": odd}, "given")


def test_a_claim_beyond_the_cap_is_refused_before_memory_is_taken():
    asked: list[int] = []

    def read_exactly(count: int) -> bytes:
        asked.append(count)
        return struct.pack(">IQ", 2**32 - 1, 2**60)

    with pytest.raises(WireError, match="larger than the cap"):
        read_message(read_exactly)
    assert asked == [HEADER.size]


@pytest.mark.parametrize(
    ("code", "shape", "raw"),
    [
        ("|O", [1], b"x" * 8),  # pickled objects
        ("<U4", [1], b"x" * 16),
        ("|V8", [1], b"x" * 8),
        ("<M8[s]", [1], b"x" * 8),
        ("<f16", [1], b"x" * 16),
        ("f8,f8", [1], b"x" * 16),
        ("(1000,1000)f8", [1], b"x" * 8),
        ("<f8", [2**40], b""),
        ("<f8", [-1], b"x" * 8),
        ("<f8", [1.0], b"x" * 8),
        ("<f8", [True], b"x" * 8),
        ("<f8", [0] * 40, b""),
        ("<f8", [1], b"x" * 7),
        ("<f8", [1], b"x" * 9),
        ("<f8", "11", b"x" * 8),
        (["<f8"], [1], b"x" * 8),
    ],
)
def test_only_arrays_of_numbers_that_fit_their_bytes_get_through(code, shape, raw):
    text = json.dumps({"body": {"~": "array", "at": 0}, "arrays": [[code, shape]]}).encode()
    with pytest.raises(WireError):
        read(frame(text, raw))


def test_a_truth_value_that_is_neither_0_nor_1_becomes_true():
    text = json.dumps({"body": {"~": "array", "at": 0}, "arrays": [["|b1", [3]]]}).encode()
    assert read(frame(text, b"\x00\x01\xff")).tolist() == [False, True, True]


@pytest.mark.parametrize("text", ["[" * 100_000, "9" * 5000, "[" * 500 + "]" * 500, "\ud800", "{"])
def test_json_made_to_break_a_parser_is_refused(text):
    with pytest.raises(WireError):
        read(frame(text.encode("utf-8", "surrogatepass")))


PARTS = 2**20 // wire.BYTES_A_PART


@pytest.mark.parametrize(
    "part", ["[]", "{}", '{"a":1}', "[[]]", "1", '""', '{"~":"complex","re":0,"im":0}']
)
def test_json_that_would_take_many_times_its_length_is_refused(part):
    text = b'{"body": [' + b",".join([part.encode()] * (PARTS + 1)) + b'], "arrays": []}'
    with pytest.raises(WireError, match="too many parts"):
        read(frame(text), max_json=2**20 if len(text) < 2**20 else len(text))


def test_a_long_list_of_numbers_and_a_long_text_get_through():
    value = {"numbers": [0.123456789] * 50_000, "text": "a, b " * 10_000}
    assert read(encode(value), max_json=2**20) == value


def test_an_array_that_stands_in_two_places_is_refused():
    """Sixty places of one array of eight megabytes would be half a gigabyte to whoever compares."""
    array = '{"~": "array", "at": 0}'
    text = f'{{"body": [{array}, {array}], "arrays": [["<f8", [1]]]}}'.encode()
    with pytest.raises(WireError, match="two places"):
        read(frame(text, bytes(8)))
    with pytest.raises(WireError, match="stands nowhere"):
        read(frame(b'{"body": 1, "arrays": [["<f8", [1]]]}', bytes(8)))


def test_an_array_that_is_sent_in_two_places_is_written_twice():
    array = np.arange(3)
    first, second = read(encode([array, array]))
    assert first is not second
    np.testing.assert_array_equal(first, second)


def test_more_arrays_than_anybody_returns_are_neither_sent_nor_read():
    with pytest.raises(WireError, match="too many arrays"):
        encode([np.zeros(0)] * (wire.MAX_ARRAY_COUNT + 1))
    table = ",".join(['["<f8",[0]]'] * (wire.MAX_ARRAY_COUNT + 1))
    with pytest.raises(WireError, match="too many arrays"):
        read(frame(f'{{"body":1,"arrays":[{table}]}}'.encode()))


@pytest.mark.parametrize(
    "value",
    [
        ["x" * 2**22] + [0] * 1000,
        [["x" * 2**22, *[""] * 200], [0.0] * 201],
        {"a": [np.zeros(10_000), ["x" * 10_000] * 2]},
    ],
    ids=["one long text", "in tables", "beside arrays"],
)
def test_a_list_that_numpy_would_make_gigabytes_of_does_not_get_to_it(value):
    """NumPy gives every entry as much room as the longest text needs."""
    outcomes = [{"value": value}, {"value": ["a", "bc", 1.0]}]
    assert clean_evaluation({"state": "given", "outcomes": outcomes})["outcomes"] == [
        {"unusable": "not plain"},
        {"value": ["a", "bc", 1.0]},
    ]


def repr_of(value: object) -> str:
    return type(value).__name__


@pytest.mark.parametrize(
    "value",
    [object(), print, {1: 2}, np.array([object()]), np.array(["a"]), 10**5000, b"bytes", {1, 2}],
    ids=repr_of,
)
def test_what_is_not_plain_is_not_sent(value):
    with pytest.raises(WireError):
        encode(value)


def test_a_text_for_reports_has_no_control_characters():
    assert clean_text("a\x1b[31m\ud800\u202e\nb") == "a [31m b"
    assert clean_text(7) == ""
