"""The README of a student bundle."""

from __future__ import annotations

from collections.abc import Collection

from autograder.course import Course
from autograder.course.folders import student_notebooks

# The course's folder is put on the path by hand: a kernel that runs does not see what was installed
# to be edited, and restarting it would ask the student for another step.
COLAB = """\
from google.colab import drive
drive.mount("/content/drive")
COURSE = "/content/drive/MyDrive/course"
%cd -q {COURSE}/notebooks
%pip install -q -e {COURSE}
import sys
sys.path.insert(0, COURSE)"""


def student_readme(
    course: Course, practice: Collection[str] = (), checked: Collection[str] = ()
) -> str:
    """How to start, how to answer, how to hand in.

    ``checked`` names the questions that the bundle itself tries on a few examples.
    """
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
    first = min((path.name for path in student_notebooks(course.root)), default="1.ipynb")
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

In Google Colab: put this folder into your Drive under the name `course`, open a notebook of it
there, and make this its first cell. It installs what Colab lacks and leaves its kernel as it is.
Run it whenever Colab gives you a new machine; your answers stay in your Drive.

```python
{COLAB}
```

## Answer

{_ways(course, checked)}
- `progress()` shows what you have answered.
{full}
Your answers are kept in `notebooks/responses/`. You may close notebooks, restart kernels and clear
outputs; do not delete that folder.

## Hand in

Run `submit()` in the last notebook. It writes `notebooks/submission.zip` and names what is still
open. Hand in that one file. You can do so again until the deadline.
"""


def _ways(course: Course, checked: Collection[str]) -> str:
    """How questions are answered, by those of this course."""
    clicked = [entry for entry in course.questions.values() if entry.name is None]
    tried = [entry for entry in course.questions.values() if entry.id in checked]
    written = [
        entry
        for entry in course.questions.values()
        if entry.name is not None and entry.id not in checked
    ]
    lines = []
    if course.personal and course.varied:
        lines.append(
            '- `me("Ada Lovelace")`, with your name or number as the class list has it, says who '
            "you are. Some questions have numbers that are yours alone: say it before you answer."
        )
    if clicked:
        lines.append(
            f'- `ask("{clicked[0].id}")` shows a question to click on. Your answer is kept as soon '
            "as you give it."
        )
    if tried:
        lines.append(
            f'- `check("{tried[-1].id}", {tried[-1].name})` tries what you wrote on a few examples '
            "and shows the first that goes wrong. The marks that count come later, on other inputs."
        )
    if written:
        lines.append(f'- `check("{written[0].id}", {written[0].name})` records what you found.')
    lines.append("- What is only recorded is marked after you hand in.")
    return "\n".join(lines)
