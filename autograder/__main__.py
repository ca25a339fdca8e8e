"""``python -m autograder`` is the command ``autograder``."""

import gc
import os
import sys


def main() -> int:
    """Load the command line quickly and run it."""
    _import_nothing_from_here()
    # Marking multiplies nothing large: more threads would only wait, and keep a processor busy.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.disable()  # what is imported stays: looking through it for garbage is for nothing
    try:
        from autograder import cli
    except KeyboardInterrupt:  # nothing has begun yet
        print("autograder: stopped; run it again to go on.", file=sys.stderr)
        return 130

    gc.freeze()
    gc.enable()
    return cli.main()


def _import_nothing_from_here() -> None:
    """Forget the current folder, which ``python -m`` searches first: it may be a submission's."""
    here = os.getcwd()
    if here != os.path.dirname(os.path.dirname(os.path.abspath(__file__))):
        sys.path[:] = [entry for entry in sys.path if entry not in ("", here)]


if __name__ == "__main__":
    sys.exit(main())
