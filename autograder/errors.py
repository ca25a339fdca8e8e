"""The errors that a person is meant to read: one sentence, and what to do next.

::

    AutograderError
      CourseError      the course is broken: a question, an answer or a notebook of it
      UsageError       somebody asked for what does not exist
      MachineError     this machine is short of something: memory, room on a disk, processes, files
      ...              what only one room knows, such as a gradebook that cannot be read
"""

from __future__ import annotations

import errno
import tempfile
from pathlib import Path

_SHORT_OF = {
    errno.EMFILE: "This process may not open any more files (ulimit -n)",
    errno.ENFILE: "This machine may not open any more files",
    errno.EAGAIN: "No further process or thread can be started here (ulimit -u, or the limit of a "
    "container)",
    errno.ENOMEM: "This machine has no memory left",
    errno.ENOBUFS: "This machine has no memory left for a socket",
    errno.ENOSPC: "There is no room left on the disk",
    errno.EDQUOT: "Your share of the disk is used up",
    errno.EROFS: "The disk cannot be written",
    errno.EIO: "The disk cannot be read or written",
}
_TO_DO = {
    errno.EMFILE: "Allow more, for example by ulimit -n 1024",
    errno.ENFILE: "Close other programs",
    errno.EAGAIN: "Allow more, for example by ulimit -u 4096, or use fewer --jobs",
    errno.ENOMEM: "Close other programs, allow more (ulimit -v), or use fewer --jobs",
    errno.ENOBUFS: "Close other programs",
    errno.ENOSPC: "Make room there, or name another folder with TMPDIR or --out",
    errno.EDQUOT: "Make room there, or name another folder with TMPDIR or --out",
    errno.EROFS: "Name another folder with TMPDIR or --out",
    errno.EIO: "Check the disk, or name another folder with TMPDIR or --out",
}
# Only these can be meant where a submission is read: any other may come from what was handed in.
_WHILE_READING = frozenset(
    {errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.ENOSPC, errno.EDQUOT, errno.EIO}
)


class AutograderError(Exception):
    """Anything the autograder cannot do, said in one sentence."""


class CourseError(AutograderError):
    """The course itself is broken: a question, an answer or a notebook of it."""


class UsageError(AutograderError, ValueError):
    """Somebody asked for something that does not exist or gave a response of the wrong shape."""


class MachineError(AutograderError):
    """This machine is short of something. The run stops: it is no student's fault, and no mark."""


def machine_error(error: BaseException, where: str = "") -> MachineError | None:
    """What an error says about this machine, or None if it may be about something else.

    ``where`` names the file or folder if the error itself does not.
    """
    if isinstance(error, MachineError):
        return error
    if isinstance(error, MemoryError):
        return short_of(errno.ENOMEM)
    if isinstance(error, RuntimeError) and "can't start new thread" in str(error):
        return short_of(errno.EAGAIN)
    if isinstance(error, OSError) and error.errno is not None:
        return short_of(error.errno, str(error.filename or where))
    return None


def raise_if_short(error: BaseException) -> None:
    """Leave an error that came up while a submission was read to its handler, if it may be its own.

    Raises:
        MachineError: if the submission cannot have caused it.
    """
    if isinstance(error, OSError) and error.errno not in _WHILE_READING:
        return
    short = machine_error(error)
    if short is not None:
        raise short from None


def refuse_link(path: Path) -> None:
    """Refuse to write where somebody has put a link.

    Raises:
        MachineError: if there is one.
    """
    if path.is_symlink():
        raise MachineError(
            f"{path} is a link, and nothing is written through it. Remove it, or name another "
            "folder with --out."
        )


def short_of(number: int, where: str = "") -> MachineError | None:
    """What a number of the system's errors says about this machine; None for all others."""
    if number in (errno.EACCES, errno.EPERM) and where:
        return MachineError(
            f"{where} cannot be used by this user, so nothing can be graded. Change its "
            "permissions, or name another folder with TMPDIR or --out; then grade again."
        )
    if number not in _SHORT_OF:
        return None
    if number in (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO):
        where = where or f"the folder for temporary files, {tempfile.gettempdir()}"
    else:
        where = ""
    said = f"{_SHORT_OF[number]} ({where})" if where else _SHORT_OF[number]
    return MachineError(
        f"{said}, so nothing more can be graded. {_TO_DO[number]}; then grade again. "
        "What was marked until now is kept."
    )
