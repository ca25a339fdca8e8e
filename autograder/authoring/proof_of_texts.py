"""What an author typed and did not mean, in the texts of questions, predictions and the key.

In a text in double quotes TOML reads ``\\theta`` as a tab and ``heta``: nothing is wrong with the
file, and students see nonsense. So they do of ``{longitud}`` where the variable is ``longitude``.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator

from msgspec.structs import asdict

from autograder.course import Course
from autograder.course.folders import ANSWERS, QUESTIONS
from autograder.course.placeholders import KEPT
from autograder.course.questions import Written
from autograder.course.selections import FIELD
from autograder.questions.key_formulas import CONSTANTS, FUNCTIONS
from autograder.questions.nearest_name import nearest
from autograder.questions.strict_reader import Place
from autograder.questions.toml_lines import Path

_MATH = re.compile(r"\$\$.*?\$\$|\$[^$]{0,400}\$", re.DOTALL)
_CODE = re.compile(r"(`+).*?\1", re.DOTALL)
_LEFT_OPEN = re.compile(r"(?<!\\)\$[^$]*[\\^_=]")  # and not an amount of money
_ESCAPES = {"\t": "t", "\b": "b", "\f": "f", "\r": "r", "\n": "n"}
_EATEN = re.compile(r"[\b\f](?=[A-Za-z])|\r(?=[A-Za-z])")
_EATEN_IN_MATH = re.compile(r"\t(?=[A-Za-z])|\n(?=(?:u|abla|eq|ot|otin)\b)")
_BRACES = re.compile(r"\{([^{}:]*)(?::[^{}]*)?\}")


def prove_texts(course: Course) -> Iterator[str]:
    """One sentence for each text that says something else than what its author typed."""
    for chapter in course.chapters:
        answers, tables = course.answer_tables[chapter.name]
        for written in chapter.written:
            id, names = str(written.table["id"]), _names(written)
            of_key = f"the answer to {id} in {ANSWERS.as_posix()}/{chapter.name}.toml"
            yield from _problems(written.table, written.place, names)
            yield from _problems(tables[id], Place(of_key, answers, (id,)), names)
        text = next((written.text for written in chapter.written), "")
        for number, asked in enumerate(chapter.predictions):
            words = f"prediction {asked.id!r} in {QUESTIONS.as_posix()}/{chapter.name}.toml"
            place = Place(words, text, ("prediction", number))
            told = next((w for w in chapter.written if w.table.get("story") == asked.story), None)
            names = _names(told) if told and asked.story else ()
            yield from _problems(asdict(asked), place, names)


def _names(written: Written) -> Collection[str]:
    """The variables of a question; those by which entries are drawn stand in no text."""
    return written.variables.values if written.variables and FIELD not in written.table else ()


def _problems(table: object, place: Place, names: Collection[str]) -> Iterator[str]:
    for path, text in _texts(table):
        if eaten := _eaten(text):
            meant = _ESCAPES[eaten[0]] + eaten[1:]
            yield str(
                place.error(
                    f"a text in double quotes reads \\{meant[0]} as a sign of its own: write "
                    f"\\\\{meant} with two backslashes, or the text in single quotes",
                    path,
                )
            )
        if _LEFT_OPEN.search(_MATH.sub("", _CODE.sub("", text))):
            yield str(place.error("a $ has no partner: a formula begins and ends with one", path))
        if names and not KEPT & set(map(str, path)):
            for found in _BRACES.finditer(text):
                if problem := _misspelt(found, text, names):
                    yield str(place.error(f"{found[0]} {problem}", path))


def _texts(value: object, path: Path = ()) -> Iterator[tuple[Path, str]]:
    if isinstance(value, str):
        yield path, value
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from _texts(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _texts(inner, (*path, index))


def _eaten(text: str) -> str:
    """The sign that an escape became and the word behind it; empty if there is none."""
    found = _EATEN.search(text)
    if found is None:
        inside = (_EATEN_IN_MATH.search(text, *math.span()) for math in _MATH.finditer(text))
        found = next((one for one in inside if one), None)
    if found is None:
        return ""
    word = re.match(r"[A-Za-z]+", text[found.end() :])
    assert word is not None
    return found[0] + word[0]


def _misspelt(found: re.Match[str], text: str, names: Collection[str]) -> str:
    """What is wrong with a placeholder that is a formula of no variables; empty if nothing is."""
    try:
        tree = ast.parse(found[1].strip(), mode="eval")
    except (SyntaxError, ValueError):
        return ""
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    unknown = sorted(used - {*names, *FUNCTIONS, *CONSTANTS})
    for name in unknown:
        near = nearest(name, names)
        if near:
            return f"is not filled in: there is no variable {name!r}; perhaps {near!r} is meant"
    in_math = any(math.start() < found.start() < math.end() for math in _MATH.finditer(text))
    if unknown and used & set(names) and not in_math:
        return f"is not filled in: {unknown[0]!r} is neither a variable nor a function of formulas"
    return ""
