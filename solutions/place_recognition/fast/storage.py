"""Arrays in a file, without pickle: reading one runs no code."""

import zipfile
from pathlib import Path

import numpy as np


def write_arrays(path: str | Path, **arrays: np.ndarray) -> None:
    """Write arrays of any shape to an npz file under exactly this path."""
    with open(path, "wb") as file:
        np.savez(file, allow_pickle=False, **arrays)


def read_arrays(path: str | Path, what: str, *needed: str) -> dict[str, np.ndarray]:
    """Return the arrays of an npz file that has to hold `what`, with the `needed` among them.

    They are of any shape; whoever needs them looks at it.

    Raises:
        FileNotFoundError: if there is no such file.
        ValueError: with the file's name, if it cannot be that.
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
    except FileNotFoundError:
        raise
    except (OSError, ValueError, EOFError, AttributeError, TypeError, zipfile.BadZipFile) as error:
        raise ValueError(
            f"{path} does not hold {what}, or it is damaged: save it again."
        ) from error
    missing = [name for name in needed if name not in arrays]
    if missing:
        raise ValueError(f"{path} does not hold {what}: {missing[0]} is missing; save it again.")
    return arrays
