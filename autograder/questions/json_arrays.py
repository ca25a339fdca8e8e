"""Plain data with arrays as JSON, and back."""

from __future__ import annotations

import numpy as np

from autograder.exchange.messages import Value


def pack(value: object) -> Value:
    """Plain data with arrays as JSON."""
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "c":
            return {"complex": [value.real.tolist(), value.imag.tolist()]}
        return {"array": value.tolist(), "dtype": value.dtype.str, "shape": list(value.shape)}
    if isinstance(value, dict):
        return {str(key): pack(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [pack(entry) for entry in value]
    if isinstance(value, np.generic):
        return value.item()
    return value


def unpack(value: object) -> Value:
    """What `pack` made of plain data, as it was; named tuples are lists."""
    if isinstance(value, dict):
        if value.keys() == {"array", "dtype", "shape"}:
            return np.array(value["array"], dtype=value["dtype"]).reshape(value["shape"])
        if value.keys() == {"complex"}:
            real, imaginary = value["complex"]
            return np.array(real) + 1j * np.array(imaginary)
        return {key: unpack(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [unpack(entry) for entry in value]
    return value
