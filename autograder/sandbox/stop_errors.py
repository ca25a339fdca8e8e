"""What is raised when student code did not answer."""

import signal

from autograder.language import N_

BY_THE_SYSTEM = N_("it was ended by the system, as happens when memory runs out")
# Why a process ended, by the signal that ended it; translated where it is shown.
BY_SIGNAL: dict[int, str] = {
    signal.SIGSEGV: N_("it crashed (segmentation fault)"),
    signal.SIGBUS: N_("it crashed (bus error)"),
    signal.SIGFPE: N_("it crashed (arithmetic error)"),
    signal.SIGILL: N_("it crashed (illegal instruction)"),
    signal.SIGABRT: N_("it aborted"),
    signal.SIGXCPU: N_("it used too much processor time"),
    signal.SIGKILL: BY_THE_SYSTEM,
}


class Stopped(Exception):
    """Student code did not answer.

    ``status`` is ``timeout`` or ``killed``; ``why`` is a short text, such as "it crashed".
    """

    def __init__(self, status: str, why: str = "") -> None:
        super().__init__(status, why)
        self.status = status
        self.why = why


def out_of_time() -> Stopped:
    """What is raised where a submission has used up the time that all of it may take."""
    return Stopped("timeout", N_("the submission as a whole had used up its time"))


def stop_by(number: object) -> Stopped:
    """What it means that the fork for one question ended without an answer.

    ``number`` is the signal that ended it, or anything else that student code sent.
    """
    if type(number) is not int:
        number = 0
    if number in (signal.SIGALRM, signal.SIGPROF):
        return Stopped("timeout")
    if number == signal.SIGXCPU:
        return Stopped("timeout", BY_SIGNAL[signal.SIGXCPU])
    return Stopped("killed", BY_SIGNAL.get(number, N_("it ended its own process")))
