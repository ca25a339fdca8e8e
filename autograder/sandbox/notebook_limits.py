"""What one notebook may use, for the kernel and for the zygote: memory, time, processes, files."""

from __future__ import annotations

from autograder.course import Settings
from autograder.exchange.messages import Message

_SPARE_PROCESSES = 256  # what an instructor may start while a notebook runs


def limits(settings: Settings) -> Message:
    """What one notebook may use, for the kernel and for the zygote's own look."""
    return {
        "limits": {
            "memory_mb": settings.memory_mb,
            "cpu_seconds": settings.cpu_seconds,
            "processes": settings.processes + 1,
            "spare": _SPARE_PROCESSES,
            "file_mb": settings.files_mb,
        },
        "usage": {
            "memory_mb": settings.memory_mb,
            "processes": settings.processes,
            "files": settings.files,
            "files_mb": settings.files_mb,
        },
    }
