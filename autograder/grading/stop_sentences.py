"""What a student reads where a notebook or a response had to be stopped."""

from __future__ import annotations

from autograder.language import N_, _
from autograder.sandbox.stop_errors import Stopped


def notebook_stopped(stop: Stopped) -> str:
    """Of a notebook whose time was up, or whose process ended, before its last cell."""
    if stop.status == "timeout":
        if not stop.why:
            return _("Running the notebook took longer than the time limit.")
        sentence = _("Running the notebook took longer than the time limit: {why}.")
        return sentence.format(why=_(stop.why))
    why = _(stop.why or N_("too much memory, a crash, or an exit"))
    return _("The notebook's process ended while it ran: {why}.").format(why=why)


def response_stopped(stop: Stopped) -> str:
    """Of one response that was being evaluated; empty where the status says it all."""
    if stop.status == "timeout" and stop.why:
        return _("It took longer than the time limit: {why}.").format(why=_(stop.why))
    if not stop.why:
        return ""
    return _("The process that ran it was ended: {why}.").format(why=_(stop.why))
