"""Arrays in one file whose bytes depend on nothing but the arrays."""

import io
import zipfile
from pathlib import Path

import numpy as np

_LONG_AGO = (1980, 1, 1, 0, 0, 0)  # the earliest time that a zip can hold


def write_arrays(path: Path, **arrays: np.ndarray) -> None:
    """Write arrays of any shape to a compressed ``.npz``.

    NumPy's own differs from one version of Python to the next.
    """
    with zipfile.ZipFile(path, "w") as archive:
        for name, array in arrays.items():
            buffer = io.BytesIO()
            np.lib.format.write_array(buffer, array, allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy", _LONG_AGO)
            entry.create_system = 3  # Unix, wherever it is made
            archive.writestr(entry, buffer.getvalue(), zipfile.ZIP_DEFLATED, compresslevel=6)
