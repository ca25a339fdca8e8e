"""Files of the course's folders that belong to no chapter."""

from __future__ import annotations

from collections.abc import Iterator

from autograder.course import Course
from autograder.course.folders import ANSWERS, MASTERS, NOTEBOOKS, QUESTIONS, SOLVED


def misplaced_files(course: Course) -> Iterator[str]:
    """One sentence for each file that is of no chapter and that no notebook imports."""
    chapters = {f"{chapter.name}.toml" for chapter in course.chapters}
    masters = {path.stem for path in (course.root / MASTERS).glob("*.py")}
    notebooks = {f"{stem}.ipynb" for stem in masters}
    expected = {
        QUESTIONS: chapters,
        ANSWERS: chapters,
        MASTERS: {f"{stem}.py" for stem in masters},
        NOTEBOOKS: notebooks,
        SOLVED: notebooks,
    }
    for folder, names in expected.items():
        for path in sorted((course.root / folder).glob("*")):
            generated = path.name in ("responses", "submission.zip", "__pycache__")
            module = path.suffix == ".py" and folder == NOTEBOOKS
            if path.is_dir() or path.name.startswith(".") or generated or module:
                continue
            if path.name not in names:
                yield (
                    f"{path.relative_to(course.root)} is unexpected; "
                    "remove it, or add the chapter that it belongs to."
                )
