"""Exit statuses."""

DONE, BROKEN, WRONG_USAGE, INTERRUPTED = 0, 1, 2, 130
