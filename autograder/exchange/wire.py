"""Plain data across a process boundary: length-prefixed JSON with raw arrays behind it.

A message is a JSON value in which arrays, complex numbers and tuples may stand. Its frame is::

    4 bytes  length of the JSON, big endian
    8 bytes  length of the arrays together, big endian
    JSON     {"body": ..., "arrays": [[dtype, shape], ...]}
    bytes    the arrays, C order, one after the other

Nothing that is read here can run code: no pickle, no object arrays, and every length is compared
with a cap before memory is taken. What is read takes little more memory than its frame: JSON of
nothing but brackets would take fifty times its length, so lists and dictionaries and what they hold
are counted first, every array stands in one place only, and an array counts as what it becomes when
it is unpacked (`autograder.exchange.unpacked_size`), not as its bytes.
"""

from __future__ import annotations

import json
import math
import re
import struct
from collections.abc import Callable
from typing import IO

import numpy as np

from autograder.exchange.messages import Value
from autograder.exchange.unpacked_size import unpacked_bytes

HEADER = struct.Struct(">IQ")
MAX_JSON = 16 * 2**20
MAX_ARRAYS = 256 * 2**20
MAX_DEPTH = 32
MAX_ARRAY_COUNT = 10_000
BYTES_A_PART = 16  # of the cap on JSON, for each entry of a list or a dictionary
UNPACKED = 8  # times the cap on arrays: what they may take when they are unpacked
_KINDS = "biufc"
_ITEM_SIZES = {"b": (1,), "i": (1, 2, 4, 8), "u": (1, 2, 4, 8), "f": (2, 4, 8), "c": (8, 16)}
_TYPE = re.compile(r"[<>|=]?([biufc])(\d{1,2})")
_MAX_DIMENSIONS = 32


class WireError(Exception):
    """The bytes are no message, or the value is no plain data."""


class TooLarge(WireError):
    """The value is plain data, but the other side would not take as much."""


def encode(value: object, most: int | None = None) -> bytes:
    """The frame of a plain value.

    ``most`` is the other side's cap on the JSON and on the arrays, if it is known.

    Raises:
        TooLarge: if the other side would refuse the frame for its size.
        WireError: if the value holds anything but None, booleans, numbers, strings, lists,
            dictionaries with string keys and numeric arrays.
    """
    arrays: list[np.ndarray] = []

    def convert(item: object, depth: int = 0) -> object:
        if depth > MAX_DEPTH:
            raise WireError("nested too deeply")
        if item is None or isinstance(item, bool | int | float):
            return item
        if isinstance(item, str):
            return item
        if isinstance(item, complex):
            return {"~": "complex", "re": item.real, "im": item.imag}
        if isinstance(item, np.ndarray):
            if item.dtype.kind not in _KINDS:
                raise WireError(f"an array of {item.dtype} is not plain data")
            if len(arrays) == MAX_ARRAY_COUNT:
                raise WireError("too many arrays")
            # One that stands in several places is written several times.
            arrays.append(np.asarray(item))
            return {"~": "array", "at": len(arrays) - 1}
        if isinstance(item, list | tuple):
            return [convert(entry, depth + 1) for entry in item]
        if isinstance(item, dict):
            if not all(isinstance(key, str) for key in item):
                raise WireError("a dictionary's keys must be strings")
            plain = {key: convert(entry, depth + 1) for key, entry in item.items()}
            return {"~": "dict", "items": plain} if "~" in plain else plain
        raise WireError(f"a {type(item).__name__} is not plain data")

    body = convert(value)
    table = [[array.dtype.str, list(array.shape)] for array in arrays]
    try:
        text = json.dumps({"body": body, "arrays": table}).encode()
    except ValueError as error:  # an int too large to print
        raise WireError(str(error)) from None
    if most is not None and (
        len(text) > most
        or _has_too_many_parts(text, most)
        or sum(array.nbytes for array in arrays) > most
        or sum(unpacked_bytes(a.shape, a.itemsize) for a in arrays) > UNPACKED * most
    ):
        raise TooLarge("a message larger than the cap")
    raw = b"".join(array.tobytes() for array in arrays)
    return HEADER.pack(len(text), len(raw)) + text + raw


def decode(text: bytes, raw: bytes, max_unpacked: int = UNPACKED * MAX_ARRAYS) -> object:
    """The value of a frame's two parts.

    Raises:
        WireError: if they are not what `encode` writes, or if the arrays would take more than
            ``max_unpacked`` bytes when they are unpacked.
    """
    try:
        message = json.loads(text)
        body, table = message["body"], message["arrays"]
        if len(table) > MAX_ARRAY_COUNT:
            raise WireError("too many arrays")
        arrays: list[np.ndarray | None] = []
        at = unpacked = 0
        for code, shape in table:
            dtype = _allowed_type(code)
            if len(shape) > _MAX_DIMENSIONS or not all(
                type(n) is int and 0 <= n <= MAX_ARRAYS for n in shape
            ):
                raise WireError("an array of an impossible shape")
            unpacked += unpacked_bytes(shape, dtype.itemsize)
            if unpacked > max_unpacked:
                raise WireError("arrays that would become too large")
            size = dtype.itemsize * math.prod(shape)
            if at + size > len(raw):
                raise WireError("an array is longer than its bytes")
            array = np.frombuffer(raw[at : at + size], dtype)
            if dtype.kind == "b":  # any other byte than 0 and 1 would be no truth value to NumPy
                array = array.view(np.uint8) != 0
            arrays.append(array.reshape(shape))
            at += size
        if at != len(raw):
            raise WireError("bytes that belong to no array")
        value = _restore(body, arrays)
        if any(array is not None for array in arrays):
            raise WireError("an array that stands nowhere")
        return value
    except (
        ValueError,
        TypeError,
        LookupError,
        AttributeError,
        RecursionError,
        OverflowError,
    ) as error:
        raise WireError(f"not a message: {type(error).__name__}") from None


def _allowed_type(code: object) -> np.dtype[np.generic]:
    """The number type that a code such as ``<f8`` names."""
    match = _TYPE.fullmatch(code) if isinstance(code, str) else None
    if match is None or int(match[2]) not in _ITEM_SIZES[match[1]]:
        raise WireError("an array of a type that is not allowed")
    return np.dtype(match[0])


def _restore(item: object, arrays: list[np.ndarray | None], depth: int = 0) -> object:
    """The value with its arrays in place, each taken out of ``arrays``: none stands in two."""
    if depth > 2 * MAX_DEPTH:
        raise WireError("nested too deeply")
    if isinstance(item, list):
        return [_restore(entry, arrays, depth + 1) for entry in item]
    if isinstance(item, dict):
        match item.get("~"):
            case None:
                return {key: _restore(entry, arrays, depth + 1) for key, entry in item.items()}
            case "dict":
                return {
                    key: _restore(entry, arrays, depth + 1) for key, entry in item["items"].items()
                }
            case "complex":
                return complex(float(item["re"]), float(item["im"]))
            case "array":
                index = item["at"]
                if type(index) is not int or not 0 <= index < len(arrays):
                    raise WireError("an array that is not there")
                array, arrays[index] = arrays[index], None
                if array is None:
                    raise WireError("an array that stands in two places")
                return array
        raise WireError("an unknown marker")
    return item


def read_stream(stream: IO[bytes]) -> Value:
    """Read one message from a stream; raises as `read_message` does."""

    def read_exactly(count: int) -> bytes:
        data = stream.read(count)
        if len(data) < count:
            raise EOFError
        return data

    return read_message(read_exactly)


def read_message(
    read_exactly: Callable[[int], bytes],
    max_json: int = MAX_JSON,
    max_arrays: int = MAX_ARRAYS,
) -> object:
    """Read one message, of which ``read_exactly(n)`` gives the next n bytes.

    Raises:
        WireError: if the frame claims more than the caps, before memory is taken for it, or is
            not a message.
        EOFError: if the stream ends.
    """
    json_length, array_length = HEADER.unpack(read_exactly(HEADER.size))
    if json_length > max_json or array_length > max_arrays:
        raise WireError("a message larger than the cap")
    text = read_exactly(json_length)
    # Commas and brackets inside of texts count too; no honest message comes near the cap.
    if _has_too_many_parts(text, max_json):
        raise WireError("a message of too many parts")
    return decode(text, read_exactly(array_length), UNPACKED * max_arrays)


def _has_too_many_parts(text: bytes, max_json: int) -> bool:
    return sum(map(text.count, (b",", b"[", b"{"))) > max_json // BYTES_A_PART
