"""The command line: ``autograder grade``, ``check``, ``build``."""


def main() -> int:
    """Run the command line and return its exit status."""
    return 0
