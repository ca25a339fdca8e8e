"""The environment variables that student code finds in a sandbox."""

from __future__ import annotations

from pathlib import Path

from autograder.course import Settings


def student_environment(course: Path, scratch: Path, settings: Settings) -> dict[str, str]:
    """All environment variables; of the instructor's own none is passed on."""
    work = scratch / "work"
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": str(work),
        "USER": "student",
        "LANG": "C.UTF-8",
        "TMPDIR": str(work / "tmp"),
        "MPLBACKEND": "agg",
        "MPLCONFIGDIR": str(scratch / "matplotlib"),
        "IPYTHONDIR": str(scratch / "ipython"),
        "PYTHONPATH": str(course),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONHASHSEED": "0",
        "PYTHONWARNINGS": "ignore",
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "MALLOC_ARENA_MAX": "2",
        "AUTOGRADER_COURSE": str(course),
        "AUTOGRADER_RESPONSES": str(work / "responses"),
        "AUTOGRADER_PACKAGES": " ".join(settings.packages),
    }
