"""Sandboxes beside each other, and what they hold of the machine."""

import os
import subprocess
import sys
import threading

import pytest
from attacks import check_good

from autograder.sandbox import host
from autograder.sandbox.launcher import Sandbox
from autograder.sandbox.own_user import OwnIdentity
from autograder.sandbox.processes import users

as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can take another identity")
HOLD = """
from autograder.sandbox.own_user import OwnIdentity
mine = OwnIdentity()
print(mine.number, flush=True)
input()
"""


@as_root
def test_no_two_identities_are_the_same_and_a_released_one_is_taken_again():
    first, second = OwnIdentity(), OwnIdentity()
    assert first.number != second.number
    first.release()
    third = OwnIdentity()
    assert third.number == first.number
    second.release()
    third.release()


@as_root
def test_another_runs_identity_is_not_taken_until_that_run_ends():
    pipe = subprocess.PIPE
    other = subprocess.Popen([sys.executable, "-c", HOLD], stdin=pipe, stdout=pipe, text=True)
    assert other.stdout is not None
    taken = int(other.stdout.readline())
    mine = OwnIdentity()
    assert mine.number != taken
    mine.release()
    other.kill()
    other.communicate()


@as_root
def test_an_identity_that_a_process_was_left_with_is_not_taken():
    free = OwnIdentity()
    free.release()
    pipe = subprocess.PIPE
    left = subprocess.Popen(["/bin/cat"], stdin=pipe, user=free.number)
    try:
        assert free.number in users()
        mine = OwnIdentity()
        assert mine.number != free.number
        mine.release()
    finally:
        left.kill()
        left.communicate()


def test_a_sandbox_outlives_the_thread_that_asked_for_it(sandbox, course):
    """As one that replaces another does, which a worker thread starts."""
    started: list[Sandbox] = []
    name = "bubblewrap" if "bubblewrap" in sandbox.isolation else "reduced"

    def start() -> None:
        another = Sandbox(course, isolation=name, seed=1).__enter__()
        another._host.stop()  # the one of the trial, if it is its first use
        another._take_host().wait_until_ready()
        started.append(another)

    thread = threading.Thread(target=start)
    thread.start()
    thread.join()
    (another,) = started
    try:
        kept = another._host
        check_good(another)
        assert another._host is kept
        assert kept._process.poll() is None
    finally:
        another.stop()


def test_what_a_sandbox_held_is_given_back(course):
    started = host.Host(course.root, course.settings, with_namespaces=False)
    folder, identity = started._folder, started._own_identity
    assert folder.is_dir()
    started.stop()
    assert not folder.exists()
    if identity.number:
        assert identity.number not in users()
