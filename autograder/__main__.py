"""``python -m autograder`` is the command ``autograder``."""

import gc
import os
import sys


def main() -> int:
    """Load the command line quickly and run it."""
    # Marking multiplies nothing large: more threads would only wait, and keep a processor busy.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.disable()  # what is imported stays: looking through it for garbage is for nothing
    from autograder import cli

    gc.freeze()
    gc.enable()
    return cli.main()


if __name__ == "__main__":
    sys.exit(main())
