"""Time is a student's own: what others do on the machine costs nobody a mark."""

import os
import signal
import time
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from attacks import LIMITS, asked

from autograder.sandbox.launcher import Stopped
from autograder.sandbox.own_time import OwnTime
from autograder.sandbox.processes import descendants, stat_fields
from autograder.sandbox.session import Session


@contextmanager
def forked(action):
    process = os.fork()
    if process == 0:
        os.setsid()
        try:
            action()
        finally:
            os._exit(0)
    try:
        yield process
    finally:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)


def spin():
    while True:
        pass


@contextmanager
def spinners(count):
    """Processes that keep every processor busy, however many there are."""
    if count == 0:
        yield
    else:
        with forked(spin), spinners(count - 1):
            yield


@contextmanager
def busy_processor():
    """All that this process has started on one processor, which two others keep busy.

    They want it no more than student's code does, so that each gets a third.
    """
    every = os.sched_getaffinity(0)

    def spin_without_haste():
        os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
        spin()

    with forked(spin_without_haste), forked(spin_without_haste):
        keep_to({min(every)})
        try:
            yield
        finally:
            keep_to(every)


def keep_to(processors):
    for process in descendants(os.getpid()):
        with suppress(ProcessLookupError):
            os.sched_setaffinity(process, processors)


def processor_time(process):
    with open(f"/proc/{process}/stat", encoding="utf-8") as file:
        return sum(map(int, file.read().rpartition(")")[2].split()[11:15])) / 100


def test_a_process_that_works_has_had_the_processor_time_that_it_got():
    with spinners(4), forked(spin) as process:
        own = OwnTime()
        began, used = time.monotonic(), processor_time(process)
        for _ in range(30):
            time.sleep(0.05)
            own.look([process])
        used = processor_time(process) - used
        assert own.since(began) == pytest.approx(used, abs=0.1)


def test_a_process_that_sleeps_has_had_what_the_clock_shows():
    with spinners(4), forked(lambda: time.sleep(60)) as process:
        time.sleep(0.3)
        own = OwnTime()
        began = time.monotonic()
        for _ in range(20):
            time.sleep(0.05)
            own.look([process])
        assert own.since(began) == pytest.approx(time.monotonic() - began, rel=0.2)


def test_the_time_of_several_processes_adds_up():
    with forked(spin) as first, forked(spin) as second:
        own = OwnTime()
        began, used = time.monotonic(), processor_time(first) + processor_time(second)
        for _ in range(20):
            time.sleep(0.05)
            own.look([first, second])
        used = processor_time(first) + processor_time(second) - used
        assert own.since(began) == pytest.approx(used, abs=0.15)


WORK = """
import time
def work(seconds):
    began = time.process_time()
    while time.process_time() - began < seconds:
        pass
    return 1
def forks(count):
    import os
    for _ in range(int(count)):
        if os.fork() == 0:
            while True: pass
    while True: pass
def sleep(seconds):
    time.sleep(seconds)
"""


def test_work_within_its_time_counts_on_a_busy_machine(sandbox):
    """0.7 s take 2.1 by the clock, and may take 1."""
    with Session(sandbox._take_host, LIMITS, 1) as session, busy_processor():
        assert session.run([WORK], [])["errors"] == [None]
        assert asked(session, "work", 0.7)["outcomes"] == [{"value": 1}]


def test_a_cell_within_its_time_counts_on_a_busy_machine(sandbox):
    with Session(sandbox._take_host, LIMITS, 1) as session, busy_processor():
        assert session.run([WORK, "work(0.6)"], [])["errors"] == [None, None]


@pytest.mark.parametrize("call", [("work", 600), ("sleep", 600), ("forks", 3)])
def test_work_that_takes_too_long_is_a_timeout_and_the_next_question_works(session, call):
    session.run([WORK], [])
    with pytest.raises(Stopped) as stopped:
        asked(session, *call)
    assert stopped.value.status == "timeout"
    assert asked(session, "work", 0.01)["outcomes"] == [{"value": 1}]


def test_student_code_gives_way_to_everybody_and_cannot_change_that(sandbox):
    cell = """
import os
found = os.sched_getscheduler(0) == os.SCHED_IDLE
try:
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    found = "changed"
except PermissionError:
    pass
"""
    with sandbox.session() as session:
        assert session.run([cell], ["found"])["understood"] == {"found": "True"}


def test_a_process_whose_name_is_no_text_is_found_and_its_time_counted():
    def hide_and_spin():
        with open("/proc/self/comm", "wb") as name:
            name.write(b"\xff) R \xfe")
        spin()

    with forked(hide_and_spin) as process:
        while b"\xff" not in Path(f"/proc/{process}/comm").read_bytes():
            time.sleep(0.01)
        assert process in descendants(os.getpid())
        assert stat_fields(process)[1] == str(os.getpid()).encode()
