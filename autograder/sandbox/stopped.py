"""What is raised when student code did not answer."""


class Stopped(Exception):
    """Student code did not answer.

    ``status`` is ``timeout`` or ``killed``; ``why`` is a short text, such as "it crashed".
    """

    def __init__(self, status: str, why: str = "") -> None:
        super().__init__(status, why)
        self.status = status
        self.why = why
