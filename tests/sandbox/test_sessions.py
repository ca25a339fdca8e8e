"""What student code is offered: everything that a notebook in Jupyter has, and no more."""

import contextlib
import time

import numpy as np
import pytest
from attacks import CASE, GOOD, NUMBER, PATIENT, check_good

from autograder.sandbox.launcher import Stopped


def test_a_good_notebook_gets_through(sandbox):
    check_good(sandbox)


def test_the_isolation_is_named_for_reports(sandbox):
    assert "Landlock" in sandbox.isolation or "bubblewrap" in sandbox.isolation


def test_cells_run_as_in_jupyter(patient_session):
    cells = [
        "%matplotlib inline\nimport matplotlib.pyplot as plt",
        "%%time\na = 1",
        "!ls -l\nb = 2",
        "%%bash\nexit 3",
        "%pip install something\nc = 3",
        "files = !ls",
        "import asyncio\nawait asyncio.sleep(0)\nd = 4",
        "plt.plot([1, 2])\nplt.show()",
        "e = len(plt.get_fignums())",
        "from IPython.display import display\ndisplay(a)",
        "%timeit -n1 -r1 a",
        "x = input()",
        "import sys; sys.exit()",
        "this is no Python",
        "1 / 0",
        "f = 6",
    ]
    report = patient_session.run(cells, list("abcdef"))
    assert report["errors"] == [
        None, None, None, None, None, None, None, None, None, None, None,
        "StdinNotImplementedError" if report["errors"][11] != "EOFError" else "EOFError",
        "SystemExit", "SyntaxError", "ZeroDivisionError", None,
    ]  # fmt: skip
    assert report["understood"] == {"a": "1", "b": "2", "c": "3", "d": "4", "e": "0", "f": "6"}


def test_the_working_folder_looks_like_the_courses_own(patient_session):
    cells = [
        "import os, figures, data\nfrom notebooks import figures as same",
        "where = os.path.basename(os.getcwd())",
        "here = sorted(os.listdir('.'))",
        "open('mine.txt', 'w').write('x'); beside = open('../data/__init__.py').read()[:7]",
    ]
    report = patient_session.run(cells, ["where", "here", "beside"])
    assert report["errors"] == [None] * 4
    assert report["understood"] == {
        "where": "notebooks",
        "here": "['__init__.py', 'figures.py', 'questions', 'source']",
        "beside": "numbers",
    }


def test_a_question_cannot_change_what_the_next_one_sees(patient_session):
    patient_session.run(
        ["items = []", "def grow():\n    items.append(1)\n    return len(items)"], []
    )
    probe = {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": []}]}
    for _ in range(2):
        assert patient_session.evaluate("grow", probe)["outcomes"] == [{"value": 1}]


def test_chance_repeats_itself_from_run_to_run(sandbox):
    cells = [
        "import random, numpy as np, cv2",
        "drawn = [random.random(), np.random.rand(), np.random.default_rng().random()]",
        "names = str({'a', 'b', 'c', 'd'})",
    ]
    seen = set()
    for _ in range(3):
        with sandbox.session() as session:
            seen.add(str(session.run(cells, ["drawn", "names"])["understood"]))
    assert len(seen) == 1


def test_arrays_and_arguments_cross_as_they_are(patient_session):
    patient_session.run(["def same(*a, **k): return [*a, k]"], [])
    array = np.arange(6.0).reshape(2, 3)
    probe = {
        "inside": "autograder.kinds.function.inside.evaluate",
        "cases": [{"args": [array, 1, "é"], "kwargs": {"w": None}}],
    }
    (outcome,) = patient_session.evaluate("same", probe)["outcomes"]
    returned = outcome["value"]
    np.testing.assert_array_equal(returned[0], array)
    assert returned[1:] == [1, "é", {"w": None}]


def test_a_recorded_response_comes_back(patient_session):
    code = (
        "import json, os, pathlib\n"
        "folder = pathlib.Path(os.environ['AUTOGRADER_RESPONSES'])\n"
        "entry = {'responses': {'Q1.1': {'response': [True, False]}}}\n"
        "(folder / 'kitchen.json').write_text(json.dumps(entry))\n"
    )
    assert patient_session.run([code], [])["responses"] == {"Q1.1": [True, False]}


def test_a_loop_in_one_cell_costs_that_cell(session):
    report = session.run(["a = 1", "while True: pass", "b = 2"], ["a", "b"])
    assert report["errors"] == [None, "timeout", None]
    assert report["understood"] == {"a": "1", "b": "2"}


def test_a_question_whose_cell_was_stopped_says_so(session):
    session.run(["a = 1", "while True: pass\nk = 5"], [])
    with pytest.raises(Stopped) as stopped:
        session.evaluate("k", NUMBER)
    assert stopped.value.status == "timeout"
    assert session.evaluate("other", NUMBER) == {"state": "unusable", "reason": "missing"}
    assert session.evaluate("a", NUMBER) == {"state": "given", "value": 1}


def test_a_loop_in_one_function_costs_that_question(session):
    session.run(["def hang():\n    while True: pass", *GOOD], [])
    with pytest.raises(Stopped) as stopped:
        session.evaluate(
            "hang", {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": []}]}
        )
    assert stopped.value.status == "timeout"
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}


def test_a_crash_in_one_function_costs_that_question_and_is_named(session):
    session.run(["import ctypes\ndef crash():\n    ctypes.string_at(0)", *GOOD], [])
    with pytest.raises(Stopped) as stopped:
        session.evaluate(
            "crash",
            {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": []}]},
        )
    assert (stopped.value.status, stopped.value.why) == (
        "killed",
        "it crashed (segmentation fault)",
    )
    assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}


def test_after_the_submissions_time_nothing_is_begun_any_more(sandbox):
    loop = "def hang():\n    while True: pass"
    with sandbox.session(time.monotonic() + 1000) as session:
        assert session.run([loop, "k = 1"], ["k"])["understood"] == {"k": "1"}
        session._deadline = time.monotonic() + 0.5  # now, however busy the machine was until here
        with pytest.raises(Stopped):
            session.evaluate(
                "hang",
                {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": []}]},
            )
        for _ in range(20):
            with pytest.raises(Stopped) as stopped:
                session.evaluate("k", NUMBER)
            assert stopped.value.status == "timeout"
            assert stopped.value.why == "the submission as a whole had used up its time"
    with sandbox.session(time.monotonic()) as session, pytest.raises(Stopped):
        session.run(["k = 1"], ["k"])


def test_restarts_do_not_give_a_submission_more_time(sandbox):
    """Each cell ends its process, and before the first of them each run takes a while."""
    cells = ["import os, time\ntime.sleep(0.9)", *["os._exit(0)"] * 60]
    with sandbox.session(time.monotonic() + 1.2) as session, contextlib.suppress(Stopped):
        session.run(cells, [])
    assert session._restarts_left > 0  # with time of its own for each, all would be used up


def test_cells_after_the_notebooks_time_are_not_run(sandbox):
    from msgspec.structs import replace

    from autograder.sandbox.session import Session

    limits = replace(sandbox._course.settings, notebook_seconds=1, cell_seconds=30)
    with Session(sandbox._take_host, limits, 0) as session:
        report = session.run(["import time", *["time.sleep(0.45)"] * 6, "k = 1"], ["k"])
    errors = report["errors"]
    first = errors.index("timeout")
    assert 1 <= first <= 3  # two sleeps fit into the second; a busy machine fits fewer
    assert errors == [None] * first + ["timeout"] * (8 - first)


def test_a_notebook_begun_anew_loses_only_the_time_that_it_had(sandbox, monkeypatch):
    """Others may have kept a stopped process waiting: the clock goes on, its own time does not."""
    from types import SimpleNamespace

    from msgspec.structs import replace

    from autograder.sandbox import session as module

    waited = 0.0
    clock = SimpleNamespace(monotonic=lambda: time.monotonic() + waited)
    monkeypatch.setattr(module, "time", clock)

    class Waiting(module.Session):
        def _restart(self) -> None:
            nonlocal waited
            waited = 100.0
            super()._restart()

    limits = replace(sandbox._course.settings, notebook_seconds=30, cell_seconds=30)
    with Waiting(sandbox._take_host, limits, 0) as session:
        cells = ["import os, time\nos._exit(0)", "import time", *["time.sleep(0.5)"] * 4, "k = 1"]
        report = session.run(cells, ["k"])
    assert report["errors"] == ["killed", *[None] * 6]
    assert report["understood"] == {"k": "1"}


BOMB = """
import os
for _ in range(12):
    if os.fork() == 0:
        while True: pass
while True: pass
"""


def test_what_an_interrupted_cell_left_running_costs_the_other_questions_nothing(sandbox):
    """A dozen forks that spin use up the time that the notebook's processes have together."""
    from msgspec.structs import replace

    from autograder.sandbox.session import Session

    limits = replace(sandbox._course.settings, cell_seconds=1, question_seconds=1)
    work = "def double(x):\n    end = sum(range(8_000_000))\n    return 2 * x"
    with Session(sandbox._take_host, limits, 0) as session:
        session.run([BOMB, work, "k = 74"], ["k"])
        assert session.evaluate("double", CASE)["state"] == "given"
        assert session.evaluate("k", NUMBER) == {"state": "given", "value": 74}


FAILING_BOMB = """
import os
try:
    while True:
        if os.fork() == 0:
            if os.fork() != 0: os._exit(0)
            while True: pass
except BlockingIOError:
    raise ValueError
"""


@pytest.mark.parametrize("where", ["a cell", "a response"])
def test_what_is_left_running_costs_the_next_question_nothing(sandbox, where):
    """As many orphans that spin as are allowed, of a cell or of a function that fails by itself."""
    from msgspec.structs import replace

    from autograder.sandbox.session import Session

    limits = replace(sandbox._course.settings, cell_seconds=1, question_seconds=1)
    work = "def double(x):\n    end = sum(range(8_000_000))\n    return 2 * x"
    as_function = "def bomb(x):" + FAILING_BOMB.replace("\n", "\n    ")
    with Session(sandbox._take_host, limits, 0) as session:
        report = session.run([FAILING_BOMB if where == "a cell" else as_function, work], [])
        if where == "a response":
            assert report["errors"] == [None, None]
            assert session.evaluate("bomb", CASE)["state"] == "given"
        else:
            assert report["errors"] == ["ValueError", None]
        assert session.evaluate("double", CASE)["state"] == "given"


def test_processor_time_is_limited_by_a_setting_and_the_mark_says_so(sandbox):
    from msgspec.structs import replace

    from autograder.sandbox.session import Session

    limits = replace(PATIENT, cpu_seconds=1)
    with Session(sandbox._take_host, limits, 0) as session:
        session.run(["def spin(x):\n    while True: pass", "def double(x):\n    return 2 * x"], [])
        with pytest.raises(Stopped, match="processor time") as stopped:
            session.evaluate("spin", CASE)
        assert stopped.value.status == "timeout"
        assert session.evaluate("double", CASE)["state"] == "given"
