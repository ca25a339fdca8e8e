"""Attempts to take for ever and to end what grades; the kind of isolation makes no difference."""

import pytest
from attacks import NUMBER, asked
from msgspec.structs import replace

from autograder.sandbox.launcher import Stopped
from autograder.sandbox.session import Session

pytestmark = pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks_here")


# --- exhausting: what hangs


@pytest.mark.parametrize(
    "code",
    [
        "import time\ntime.sleep(3600)",
        "while True:\n    try:\n        while True: pass\n    except Exception: pass",
        "import threading\nthreading.Event().wait()",
        "x = 9**9**9",
    ],
)
def test_what_hangs_in_a_cell_costs_the_cell(best_session, code):
    report = best_session.run(["a = 1", code, "b = 2"], ["a", "b"])
    assert report["errors"] == [None, "timeout", None]
    assert report["understood"] == {"a": "1", "b": "2"}


@pytest.mark.parametrize(
    "code",
    [
        "while True:\n    try:\n        while True: pass\n    except BaseException: pass",
        "import signal\nfor n in set(range(1, 65)) - {9, 19}:\n"
        "    try: signal.signal(n, signal.SIG_IGN)\n    except (OSError, ValueError): pass\n"
        "while True: pass",
        "import signal\nsignal.pthread_sigmask(signal.SIG_BLOCK, range(1, 64))\nwhile True: pass",
        "import ctypes\nctypes.CDLL(None).sleep(1000)\nctypes.CDLL(None).sleep(1000)",
    ],
)
def test_what_cannot_be_interrupted_costs_the_cell_too(best_session, code):
    report = best_session.run(["a = 1", code, "b = 2"], ["a", "b"])
    assert report["errors"] == [None, "timeout", None]
    assert report["understood"] == {"a": "1", "b": "2"}


def test_a_function_that_hangs_with_all_signals_blocked_costs_its_question(best_session):
    code = (
        "import signal\ndef hang():\n"
        "    signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 64))\n    while True: pass\n"
    )
    best_session.run([code, "k = 1"], [])
    with pytest.raises(Stopped) as stopped:
        asked(best_session, "hang")
    assert stopped.value.status == "timeout"
    assert best_session.evaluate("k", NUMBER) == {"state": "given", "value": 1}


# --- dying


@pytest.mark.parametrize(
    ("code", "error"),
    [
        ("import os\nos._exit(0)", "killed"),
        ("import os\nos.abort()", "killed"),
        ("import ctypes\nctypes.string_at(0)", "killed"),
        ("import sys\nsys.exit(0)", "SystemExit"),
        ("raise SystemExit", "SystemExit"),
        ("raise KeyboardInterrupt", "KeyboardInterrupt"),
        ("class Odd(BaseException): pass\nraise Odd", "Odd"),
        ("import sys\nsys.setrecursionlimit(10**9)\ndef f(): f()\nf()", None),
        ("exit()", None),
        ("import sys\nsys.stdout.close()\nsys.stderr.close()", None),
        ("import os\nos.closerange(0, 3)", None),
        ("import os\nos.chdir('/')\nimport shutil; shutil.rmtree('/scratch', True)", None),
        ("get_ipython().reset()", None),
        ("%reset -f", None),
        ("get_ipython().run_cell = None", None),
        ("import gc, sys\nsys.settrace(lambda *a: 1/0)", None),
        ("import atexit, os\natexit.register(os._exit, 1)", None),
        ("import sys\nsys.modules.clear()", None),
        ("__import__('builtins').__dict__.clear()", None),
    ],
)
def test_a_cell_that_dies_costs_no_more_than_itself(best_session, code, error):
    report = best_session.run([code, "b = 2"], ["b"])
    if error is not None:
        assert report["errors"] == [error, None]
        assert report["understood"] == {"b": "2"}
    assert len(report["errors"]) == 2


@pytest.mark.parametrize("code", ["os._exit(0)", "sys.exit(3)", "os.abort()", "raise SystemExit"])
def test_a_function_that_ends_its_process_costs_its_question(best_session, code):
    best_session.run([f"import os, sys\ndef f():\n    {code}", "k = 1"], [])
    with pytest.raises(Stopped) as stopped:
        asked(best_session, "f")
    assert stopped.value.status == "killed"
    assert best_session.evaluate("k", NUMBER) == {"state": "given", "value": 1}


def test_a_notebook_that_kills_itself_again_and_again_is_given_up(best_sandbox):
    limits = replace(best_sandbox._course.settings, notebook_seconds=5)
    with (
        Session(best_sandbox._take_host, limits, 0) as session,
        pytest.raises(Stopped) as stopped,
    ):
        session.run(["import os\nos._exit(0)"] * 6, [])
    assert stopped.value.status == "killed"
