"""The errors that a person is meant to read: one sentence, and what to do next."""


class AutograderError(Exception):
    """Anything the autograder cannot do, said in one sentence."""


class CourseError(AutograderError):
    """The course itself is broken: a question, an answer or a notebook of it."""


class UsageError(AutograderError, ValueError):
    """Somebody asked for something that does not exist or gave a response of the wrong shape."""
