"""The README of a student bundle."""

from __future__ import annotations

from collections.abc import Collection

from autograder.course import Course


def student_readme(course: Course, practice: Collection[str] = ()) -> str:
    """How to start, how to answer, how to hand in."""
    points = sum(question.points for question in course.questions.values())
    chapters = "\n".join(
        f"- {chapter.title}: {len(chapter.questions)} questions, "
        f"{sum(question.points for question in chapter.questions):g} points"
        for chapter in course.chapters
    )
    practised = [chapter.title for chapter in course.chapters if chapter.name in practice]
    full = (
        f"\nIn {' and '.join(practised)} you get full marks and explanations at once: those are "
        "for practice, and their answers are in this folder.\n"
        if practised
        else ""
    )
    first = min(
        (path.name for path in (course.root / "notebooks").glob("*.ipynb")), default="1.ipynb"
    )
    return f"""# {" · ".join(chapter.title for chapter in course.chapters)}

{len(course.questions)} questions, {points:g} points:

{chapters}

## Start

You need Python 3.11 or newer. In this folder:

```sh
pip install uv
uv run --extra lab jupyter lab notebooks/{first}
```

The first call makes an environment in `.venv` and takes a while; later ones start at once. Without
uv, make an environment yourself:

```sh
python3 -m venv .venv
. .venv/bin/activate            # Windows: .venv\\Scripts\\activate
pip install -e ".[lab]"
jupyter lab notebooks/{first}
```

## Answer

- `ask("Q1.1")` shows a question with buttons or cards. Your answer is kept as soon as you give it.
- `check("Q2.3", fit_line)` tries a function or a formula on a few examples and shows the first that
  goes wrong. The marks that count come later, on other inputs.
- Numbers, choices and orders are recorded, and marked after you hand in.
- `progress()` shows what you have answered.
{full}
Your answers are kept in `notebooks/responses/`. You may close notebooks, restart kernels and clear
outputs; do not delete that folder.

## Hand in

Run `submit()` in the last notebook. It writes `notebooks/submission.zip` and names what is still
open. Hand in that one file. You can do so again until the deadline.
"""
