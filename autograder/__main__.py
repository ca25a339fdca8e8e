"""``python -m autograder`` is the command ``autograder``."""

import gc
import os
import sys


def main() -> int:
    """Load the command line quickly and run it."""
    _read_names_as_utf8()
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


def _read_names_as_utf8() -> None:
    """Start anew where Python takes arguments and names of files for ASCII or Latin-1.

    That is so with an old locale: half a letter of a name can neither be printed nor kept in a
    gradebook. What is printed stays in the terminal's encoding.
    """
    if sys.getfilesystemencoding() == "utf-8" or os.environ.get("PYTHONUTF8") == "1":
        return
    if os.name == "posix" and sys.executable:
        os.environ["PYTHONUTF8"] = "1"
        if sys.stdout is not None:
            os.environ.setdefault("PYTHONIOENCODING", sys.stdout.encoding)
        os.execv(sys.executable, sys.orig_argv)


def _import_nothing_from_here() -> None:
    """Forget the current folder, which ``python -m`` searches first: it may be a submission's."""
    here = os.getcwd()
    if here != os.path.dirname(os.path.dirname(os.path.abspath(__file__))):
        sys.path[:] = [entry for entry in sys.path if entry not in ("", here)]


if __name__ == "__main__":
    sys.exit(main())
