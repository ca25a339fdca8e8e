"""Questions in a notebook, marked outside of it: what a notebook imports.

``ask`` shows a question, ``check`` marks a response, ``progress`` sums up, ``submit`` packs what is
handed in.
"""

from autograder.student.api import ask, check, progress, submit

__all__ = ["ask", "check", "progress", "submit"]
