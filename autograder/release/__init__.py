"""What leaves the instructor's hands: the student bundle, and the grader for Gradescope."""

from autograder.release.bundle import Bundle, release

__all__ = ["Bundle", "release"]
