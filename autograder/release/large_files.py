"""Files of a student bundle that are large for what it is handed out by."""

from __future__ import annotations

from collections.abc import Iterator

from autograder.release.bundle import Bundle

_LARGE = 25  # MB; what is sent back by e-mail or uploaded to GitHub in a browser may not be more


def large_files(bundle: Bundle) -> Iterator[str]:
    """One sentence for each file that learning systems may refuse."""
    for path in bundle.files:
        if (megabytes := (bundle.folder / path).stat().st_size / 1e6) > _LARGE:
            yield (
                f"{path} has {megabytes:.0f} MB, and every student downloads it: learning systems "
                "and GitHub may refuse that; store less of it, or store it smaller."
            )
