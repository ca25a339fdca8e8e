"""What is raised when student code did not answer."""

BY_THE_SYSTEM = "it was ended by the system, as happens when memory runs out"


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
    return Stopped("timeout", "the submission as a whole had used up its time")
