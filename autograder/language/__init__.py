"""What people read, in their language: gettext, with a catalog ``LANGUAGE.po`` in this folder."""

from autograder.language.translate import N_, _, n_
from autograder.language.which_language import chosen, follow_environment, languages, use

__all__ = ["N_", "_", "chosen", "follow_environment", "languages", "n_", "use"]
