"""Sentences in other languages: every one is translated, and what is filled in stays filled in."""

from __future__ import annotations

import ast
import gettext
import io
import re
import symtable
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from autograder import language
from autograder.course import load_course
from autograder.gradebook import Record
from autograder.language import _
from autograder.language.catalog import as_mo, read_po
from autograder.marking import Mark
from autograder.questions.mark import not_attempted
from autograder.questions.status import Status
from autograder.reports.feedback_html import Feedback, feedback_html
from autograder.reports.pictures import Pictures
from autograder.student.views import MarkView, QuestionView
from autograder.student.widgets.base import SENTENCE, source
from autograder.student.widgets.base import sentences as in_other_words
from tests.classroom import graded, make_course
from tests.toy import Toy

ENGINE = Path(language.__file__).parents[1]
CATALOGS = sorted((ENGINE / "language").glob("*.po"))
# Names of keys, not sentences.
KEYS = ("Enter", "Escape", "Home", "End")
FIELD = re.compile(r"\{(\w+)\}")


@cache  # not while tests are collected, which every worker does
def sentences() -> dict[str, tuple[str, ...]]:
    """The sentences of the engine that are marked for translation, by where they stand."""
    found = {}
    for path in sorted(ENGINE.rglob("*.py")):
        if "template" in path.parts:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
                continue
            count = {"_": 1, "N_": 1, "n_": 2}.get(node.func.id)
            texts = [a.value for a in node.args[:count] if isinstance(a, ast.Constant)]
            if count and texts:
                where = f"{path.relative_to(ENGINE)}:{node.lineno}:{node.col_offset}"
                assert len(texts) == count, where
                found[where] = tuple(map(str, texts))
    for path in sorted(ENGINE.rglob("*.js")):
        for text in SENTENCE.findall(path.read_text(encoding="utf-8")):
            found[f"{path.relative_to(ENGINE)}: {text}"] = (text,)
    return found


@pytest.mark.parametrize("path", CATALOGS, ids=lambda path: path.stem)
def test_every_sentence_is_translated_and_keeps_its_fields(path: Path):
    catalog = read_po(path.read_text(encoding="utf-8"))
    missing = [
        f"{where}: {texts[0]}"
        for where, texts in sentences().items()
        if "\0".join(texts) not in catalog
    ]
    assert missing == []
    for key, translated in catalog.items():
        for text in translated.split("\0") if key else ():
            wanted = set(FIELD.findall(key))
            assert set(FIELD.findall(text)) <= wanted, key
            assert set(FIELD.findall(text)) == wanted or "\0" in key, key


@pytest.mark.parametrize("path", CATALOGS, ids=lambda path: path.stem)
def test_no_translation_is_left_of_a_sentence_that_is_gone(path: Path):
    known = {"", *("\0".join(texts) for texts in sentences().values())}
    assert set(read_po(path.read_text(encoding="utf-8"))) - known == set()


# Where a sentence may reach a student, and the modules there that speak to authors only.
ROOMS = ("student", "questions", "kinds", "marking", "diagnosis", "grading/chapter.py",
         "grading/visible_example.py", "grading/own_exceptions.py", "exchange/why_unusable.py",
         "gradebook/grading_scheme.py",
         "sandbox/stop_errors.py", "reports/feedback_html.py", "course/predictions.py",
         "grading/numbers_of_others.py", "intake/notebook_reader.py", "intake/archive.py",
         "intake/read_files.py", "intake/limits_on_files.py")  # fmt: skip
OF_AUTHORS = {"answer.py", "question.py", "trial.py", "raises_promises.py", "sensible.py",
              "stub.py", "expected.py", "strict_reader.py", "toml_lines.py", "author_tables.py",
              "registry.py", "key_formulas.py", "variables.py", "exercise.py", "draw.py",
              "marker.py", "marker_process.py", "take_snapshot.py",
              "reference_failures.py", "nearest_name.py"}  # fmt: skip
TO_AUTHORS = {"CourseError", "FieldError", "ValueError", "problems", "unsound", "poor_draw",
              "poor_value", "too_few_mistakes", "check_answer", "other_mistakes"}  # fmt: skip


def bare_sentences(tree: ast.AST, finds: re.Pattern[str]) -> list[str]:
    """The texts that are neither marked, nor docstrings, nor said to authors."""
    left_out: set[int] = set()
    for node in ast.walk(tree):
        name = getattr(getattr(node, "func", node), "id", getattr(node, "name", ""))
        said_to_authors = name in TO_AUTHORS and isinstance(node, ast.Call | ast.FunctionDef)
        marks = isinstance(node, ast.Call) and name in ("_", "n_", "N_")
        if said_to_authors or marks or (isinstance(node, ast.Expr) and _is_text(node.value)):
            left_out |= set(map(id, ast.walk(node)))
        elif isinstance(node, ast.JoinedStr):
            left_out |= set(map(id, node.values))  # they are looked at together
    return [
        text
        for node in ast.walk(tree)
        if id(node) not in left_out and finds.search(text := _as_text(node))
    ]


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _as_text(node: ast.AST) -> str:
    if isinstance(node, ast.JoinedStr):
        return "".join(_as_text(part) or "{}" for part in node.values)
    value = getattr(node, "value", "") if isinstance(node, ast.Constant) else ""
    return value if isinstance(value, str) and value not in tuple(Status) else ""


def modules_that_students_hear() -> list[Path]:
    found = []
    for room in ROOMS:
        path = ENGINE / room
        found += [path] if path.is_file() else sorted(path.rglob("*.py"))
    return [path for path in found if path.name not in OF_AUTHORS and "mutants" not in path.parts]


@pytest.mark.parametrize(
    "path", modules_that_students_hear(), ids=lambda path: str(path.relative_to(ENGINE))
)
def test_what_students_read_is_marked_for_translation(path: Path):
    """No sentence stands bare: words with a full stop, and in the student's room any words."""
    words = r"(?<![\w\"=<-])[A-Za-z]{3,} [a-z]{2,}(?![^<]*>)"
    telling = words if "student" in path.parts else rf"{words}[\s\S]*\.$"
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert bare_sentences(tree, re.compile(telling)) == []


def test_a_bare_sentence_would_be_found():
    code = """def f(x):
    '''A docstring is none.'''
    raise UsageError(f"Write {x} in quotes.")
    raise CourseError("Authors read this one.")
    return _("This one is marked."), "not attempted", "a name of something"
"""
    found = bare_sentences(ast.parse(code), re.compile(r"[a-z] [a-z]+.*\.$"))
    assert found == ["Write {} in quotes."]


def test_what_widgets_say_is_marked_for_translation():
    """No text of a widget's module stands bare that begins with a capital letter or has blanks."""
    bare = []
    for path in sorted(ENGINE.rglob("*.js")):
        code = re.sub(r"(?m)^\s*//.*|\s//\s.*$", "", path.read_text(encoding="utf-8"))
        code = SENTENCE.sub("", code)
        texts = re.findall(r'"([^"\n]*)"|`([^`]*)`', code)
        bare += [
            f"{path.name}: {text}"
            for text in map("".join, texts)
            if re.search(r"^[A-Z][a-z]+$|[A-Za-z]{2,} [a-z]{2,}", re.sub(r"\$\{[^}]*\}", "", text))
            and text not in KEYS
            and not re.search(r"(^| )ag-|\[tabindex", text)
        ]
    assert bare == []


def test_a_widget_speaks_german(monkeypatch: pytest.MonkeyPatch):
    module = source("common.js", "kernel_line.js", "question.js")
    assert in_other_words(module) == {}
    language.use("de")
    words = in_other_words(module)
    assert words["Check"] == "Prüfen"
    assert words["Hint {number} of {count}"] == "Hinweis {number} von {count}"


def test_a_catalog_reads_as_the_standard_library_reads_it():
    text = (
        'msgid ""\nmsgstr "Content-Type: text/plain; charset=UTF-8\\n"\n'
        '"Plural-Forms: nplurals=2; plural=(n != 1);\\n"\n'
        '# a remark\nmsgid "a \\"tree\\"\\n"\n"in two lines"\nmsgstr "ein Baum"\n'
        'msgid "{n} tree"\nmsgid_plural "{n} trees"\nmsgstr[0] "{n} Baum"\nmsgstr[1] "{n} Bäume"\n'
        'msgid "open"\nmsgstr ""\n'
    )
    read = gettext.GNUTranslations(io.BytesIO(as_mo(read_po(text))))
    assert read.gettext('a "tree"\nin two lines') == "ein Baum"
    assert read.ngettext("{n} tree", "{n} trees", 1) == "{n} Baum"
    assert read.ngettext("{n} tree", "{n} trees", 3) == "{n} Bäume"
    assert read.gettext("open") == "open"
    with pytest.raises(ValueError, match="line 1"):
        read_po('msgctx "x"')


def test_a_course_in_german_marks_and_returns_feedback_in_german(tmp_path: Path):
    make_course(tmp_path)
    Toy(tmp_path).set('language = "de"')
    course = load_course(tmp_path)
    first, second = list(course.questions.values())[:2]
    marks = (not_attempted(first), Mark(second.id, "right", 1.0, 2.0, _("Right.")))
    html = feedback_html(
        Feedback(course, Pictures(course)), Record(graded("ada", *marks), 1, 1, late_days=2)
    )
    assert '<html lang="de">' in html
    assert "Rückmeldung für" in html
    assert "2 von 2 Punkten" in html
    assert "2 Tage zu spät" in html
    assert "Noch nichts beantwortet." in html
    assert "Richtig." not in html  # the verdict says so
    view = repr(MarkView(second, marks[1], None))
    assert view.startswith("✓ Q2 richtig · 2 von 2 Punkten")
    assert "2 Punkte" in repr(QuestionView(second))


@pytest.mark.parametrize(
    "path",
    [p for p in sorted(ENGINE.rglob("*.py")) if "import" in p.read_text("utf-8")
     and re.search(r"autograder\.language import .*\b_\b", p.read_text("utf-8"))],
    ids=lambda path: str(path.relative_to(ENGINE)),
)  # fmt: skip
def test_nothing_else_is_called_as_the_translation_is(path: Path):
    """Whoever binds ``_`` and calls it would call what was bound."""

    def scopes(table: symtable.SymbolTable) -> Iterator[symtable.SymbolTable]:
        yield table
        for inner in table.get_children():
            yield from scopes(inner)

    tree = ast.parse(path.read_text(encoding="utf-8"))
    calls = {
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "_"
    }
    for function in ast.walk(tree):
        if not isinstance(function, ast.FunctionDef | ast.Lambda):
            continue
        table = symtable.symtable(ast.unparse(function), path.name, "exec").get_children()[0]
        if "_" in table.get_identifiers() and table.lookup("_").is_local():
            inside = range(function.lineno, (function.end_lineno or function.lineno) + 1)
            assert not calls & set(inside), f"line {function.lineno}"
