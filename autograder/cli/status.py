"""Exit statuses."""

DONE, BROKEN, WRONG_USAGE = 0, 1, 2
