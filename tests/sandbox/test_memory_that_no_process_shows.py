"""Memory in the buffers of sockets, and in many forks, counts; the environment shows nothing."""

import pytest
from attacks import CASE, LIMITS, Lab
from msgspec.structs import replace

from autograder.sandbox.launcher import Stopped
from autograder.sandbox.session import Session

ROOMY = replace(LIMITS, cell_seconds=20, question_seconds=20, notebook_seconds=60, processes=40)
SOCKETS = """
import os, socket, time
def double(x):
    for _ in range(30):
        if os.fork() == 0:
            kept = []
            try:
                while True:
                    pair = socket.socketpair()
                    kept.append(pair)
                    for end in pair:
                        end.setblocking(False)
                        try:
                            while True:
                                end.send(b"x" * 65536)
                        except BlockingIOError:
                            pass
            except OSError:
                time.sleep(60)
            os._exit(0)
    time.sleep(60)
"""
FORKS = """
import os, time
def double(x):
    for _ in range(24):
        if os.fork() == 0:
            kept = bytearray(40 * 2**20)  # each alone is far below what a notebook may use
            kept[::4096] = b"x" * len(kept[::4096])
            time.sleep(60)
            os._exit(0)
    time.sleep(60)
"""


@pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")
@pytest.mark.parametrize(("code", "why"), [(SOCKETS, "buffers"), (FORKS, "MB of memory")])
def test_many_processes_together_hold_no_more_than_one_may(sandbox, code, why):
    with Session(sandbox._take_host, ROOMY, 1) as session:
        session.run([code], [])
        with pytest.raises(Stopped) as stopped:
            session.evaluate("double", CASE)
    assert stopped.value.status == "killed"
    assert why in stopped.value.why


def test_a_few_processes_with_their_pipes_are_nothing_special(sandbox):
    code = """
import os
def double(x):
    ends = [os.pipe() for _ in range(20)]
    for reading, writing in ends[:8]:
        if os.fork() == 0:
            os.write(writing, b"2.0")
            os._exit(0)
    return [float(os.read(reading, 3)) for reading, _ in ends[:2]]
"""
    with Session(sandbox._take_host, ROOMY, 1) as session:
        session.run([code], [])
        (outcome,) = session.evaluate("double", CASE)["outcomes"]
    assert outcome["value"] == [2.0, 2.0]


def test_the_environment_does_not_show_where_libraries_lie(lab: Lab):
    code = "import cv2, os\nfound = sorted(n for n in os.environ if n.startswith('LD_'))"
    assert lab.value(code) == "[]"
