"""What some commands need beyond what grading needs, and how to install it."""

from __future__ import annotations

# Modules of the extra `author`: they read masters, and make and run notebooks.
_OF_AUTHORS = frozenset({"jupytext", "nbclient", "nbformat"})


def missing_extra(error: ModuleNotFoundError) -> str | None:
    """One sentence for a module that an extra of the engine brings; None for any other."""
    from autograder.authoring.bundle_pyproject import ENGINE
    from autograder.authoring.new_course import engine_source

    name = (error.name or "").partition(".")[0]
    if name not in _OF_AUTHORS:
        return None
    source = engine_source()
    if source.folder is not None:
        wanted = f"{source.folder}[author,lab]"
    elif source.git:
        below = f"#subdirectory={source.subdirectory}" if source.subdirectory else ""
        wanted = f"{ENGINE}[author,lab] @ git+{source.git}@{source.commit}{below}"
    else:
        wanted = f"{ENGINE}[author,lab]"
    return (
        f"{name} is not installed, which writing a course needs and grading does not: type "
        f'pip install "{wanted}" and run this again.'
    )
