"""Peers that may be missing on a machine."""

import contextlib
import ctypes
import importlib
from types import ModuleType


def load(module: str, missing: list[str]) -> ModuleType | None:
    """Import a peer; if that fails, append one sentence to `missing` and return None."""
    try:
        return importlib.import_module(module)
    except Exception as error:  # a broken wheel may raise anything
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        missing.append(f"{module} is missing here and was left out ({reason}).")
        return None


def load_open3d(missing: list[str]) -> ModuleType | None:
    """Import Open3D; its wheel needs libusb, which the wheel `libusb-package` brings."""
    with contextlib.suppress(ImportError, OSError):
        path = importlib.import_module("libusb_package").get_library_path()
        ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
    return load("open3d", missing)
