"""How many processes student code may have, whatever else its user runs."""

import os
import subprocess
import sys
import threading

import pytest
from attacks import LIMITS

from autograder.sandbox import attempts_to_get_out, tiers
from autograder.sandbox.lockdown import Limits
from autograder.sandbox.notebook_limits import limits
from autograder.sandbox.processes import tasks_of

THREADS = 100  # more than LIMITS allows
START_THREADS = f"""
import threading, sys
for _ in range({THREADS}):
    threading.Thread(target=sys.stdin.read, daemon=True).start()
print("started", flush=True)
threading.Event().wait()
"""


def test_a_users_threads_count_as_the_kernel_counts_them():
    before = tasks_of(os.getuid())
    pipe = subprocess.PIPE
    process = subprocess.Popen([sys.executable, "-c", START_THREADS], stdin=pipe, stdout=pipe)
    try:
        assert process.stdout is not None
        process.stdout.readline()
        assert tasks_of(os.getuid()) >= before + THREADS // 2  # others come and go meanwhile
    finally:
        process.kill()
        process.communicate()


def test_a_user_without_processes_has_no_task():
    assert tasks_of(2**32 - 2) == 0


def test_what_the_user_runs_already_is_added_to_the_limit():
    own = Limits(**limits(LIMITS)["limits"])
    assert own.processes == LIMITS.processes + 1
    beside = own.beside(500)
    assert beside.processes == own.processes + 500 + own.spare
    assert beside.memory_mb == own.memory_mb


def test_what_else_the_instructor_runs_takes_no_process_away(lab):
    """Fails for an ordinary user if the limit is not beside what that user runs."""
    done = threading.Event()
    threads = [threading.Thread(target=done.wait) for _ in range(THREADS)]
    for thread in threads:
        thread.start()
    try:
        code = "import os\nchild = os.fork()\nif child == 0: os._exit(7)\n"
        code += "found = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])"
        assert lab.value(code) == "7"
    finally:
        done.set()
        for thread in threads:
            thread.join()


@pytest.mark.skipif(os.geteuid() != 0, reason="only a user of its own has no more processes")
def test_isolation_in_which_nothing_can_be_forked_does_not_pass_its_trial(course, monkeypatch):
    monkeypatch.setattr(attempts_to_get_out, "_TRIAL_PROCESSES", 0)
    tier = tiers.Tier("reduced", False, course)
    assert not tier.try_out()
    assert "a process can be forked" in tier.problem
    assert tier.take_started() is None
