"""Parts of the key that stand in what students get."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

from autograder.course import Course
from autograder.course.folders import NOTEBOOKS
from autograder.questions.registry import kind_of

TELLING_DIGITS = 3


def parts_of_key_told(course: Course, student_notebooks: list[str]) -> Iterator[str]:
    """Parts of the key that stand in what students get: the notebooks and all beside them."""
    texts = {
        str(path.relative_to(course.root)): path.read_text(encoding="utf-8")
        for path in sorted((course.root / NOTEBOOKS).rglob("*"))
        if path.suffix in (".py", ".toml", ".md", ".js") and "responses" not in path.parts
    }
    for text in student_notebooks:
        cells = json.loads(text)["cells"]
        title = "".join(cells[0]["source"]).partition("\n")[0].strip("# ")
        texts[f"the notebook “{title}”"] = "\n".join("".join(cell["source"]) for cell in cells)
    for id, answer in course.key.items():
        question = course.questions[id]
        kind = kind_of(question)
        patterns = [re.escape(s) for s in kind.secrets(question, answer) if len(s) > 8]
        own = "\n".join([question.title, question.prompt, *question.hints])
        for number in kind.secret_numbers(question, answer):
            pattern = rf"(?<![\w.]){re.escape(number)}(?![\w]|\.\d)"
            # A short number stands in many places and gives nothing away but in its own question.
            if sum(sign.isdigit() for sign in number) >= TELLING_DIGITS:
                patterns.append(pattern)
            elif re.search(pattern, own):
                yield f"{id}: its own text contains {number!r}, which is in the key."
        for pattern in patterns:
            for name, text in texts.items():
                found = re.search(pattern, text)
                if found:
                    yield f"{id}: {name} contains {found[0][:60]!r}, which is in the key."
