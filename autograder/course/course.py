"""The course on disk: where it is, its chapters and questions, its key and its settings."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from autograder.course.answers import Answer, answer_from_table
from autograder.course.folders import (
    ANSWERS,
    DATA,
    MASTERS,
    NOTEBOOKS,
    QUESTIONS,
    SOLUTIONS,
    student_notebooks,
)
from autograder.course.places import Places, read_places
from autograder.course.predictions import Prediction
from autograder.course.questions import Question, Written
from autograder.course.settings import Settings, read_settings
from autograder.course.toml_file import read_toml, unreadable
from autograder.errors import CourseError, UsageError
from autograder.language import N_, _, use
from autograder.questions.registry import load_kind
from autograder.questions.strict_reader import Place, Table, meant, read_table
from autograder.questions.variables import Variables, read_variables

DEMO = "demo"  # the tag of a cell that only shows something
_PACKAGE = Path(__file__).parents[1]
_MARKS_NOTHING = ("authoring", "cli", "gradebook", "release", "reports")  # folders of the package
_LARGE_FILE = 32 * 2**20  # bytes
_FIELDS = ("title", "question", "story", "prediction")  # of a file of questions
_T = TypeVar("_T")


@dataclass(frozen=True)
class Chapter:
    """One notebook with its questions, in the order in which they are asked."""

    name: str
    title: str
    questions: tuple[Question, ...]
    written: tuple[Written, ...] = ()  # the tables of its questions, in their order
    predictions: tuple[Prediction, ...] = ()  # what students predict, with no points


@dataclass(frozen=True)
class Course:
    """The notebooks, questions and answers under one folder, the course root."""

    root: Path
    chapters: tuple[Chapter, ...]
    settings: Settings
    own_kinds: tuple[str, ...] = ()  # packages of the kinds of question that it brings along
    personal: bool = False  # whether each student has numbers of their own
    others_count: bool = True  # whether work on somebody else's numbers counts
    places: Places | None = None  # in the class list, if it was dealt
    variants: Mapping[str, int] = field(default_factory=dict)  # of the questions that have any

    @cached_property
    def questions(self) -> dict[str, Question]:
        """Every question by its id, in the order of the course."""
        return {
            question.id: question for chapter in self.chapters for question in chapter.questions
        }

    def question(self, id: str) -> Question:
        """The question with this id.

        Raises:
            UsageError: if there is none; the sentence lists the ids that exist.
        """
        sentence = N_("There is no question {name}; this course has {listed}.")
        return _named(id, self.questions, sentence)

    @cached_property
    def predictions(self) -> dict[str, Prediction]:
        """Everything that students predict, by its id, in the order of the course."""
        return {
            entry.id: entry.with_numbers(self.story(entry.story)) if entry.story else entry
            for chapter in self.chapters
            for entry in chapter.predictions
        }

    def prediction(self, id: str) -> Prediction:
        """The prediction with this id.

        Raises:
            UsageError: if there is none; the sentence lists the ids that exist.
        """
        sentence = N_("There is no prediction {name}; this course has {listed}.")
        return _named(id, self.predictions, sentence)

    def chapter(self, name: str) -> Chapter:
        """The chapter with this name."""
        return next(chapter for chapter in self.chapters if chapter.name == name)

    @cached_property
    def varied(self) -> dict[str, Written]:
        """The questions that have variants, by their ids."""
        return {
            str(written.table["id"]): written
            for chapter in self.chapters
            for written in chapter.written
            if written.variables is not None
        }

    def numbers(self, id: str) -> dict[str, int | float] | None:
        """The numbers of a question here; None if it has no variables."""
        if id not in self.varied:
            return None
        variables = self.varied[id].variables
        assert variables is not None
        return variables.numbers(self.variants.get(id, 0))

    def entries_of(self, id: str, student: str) -> tuple[int, ...]:
        """The entries of its bank that a student's question has, by their numbers from 1."""
        written = self.varied.get(id)
        if not self.personal or not student or written is None or written.variables is None:
            return ()
        return written.entries(self.variant_of(id, student))

    def story(self, name: str) -> dict[str, int | float]:
        """The numbers of a story here, by their names.

        Raises:
            UsageError: if no question tells it; the sentence lists the stories there are.
        """
        tellers = {
            written.table["story"]: id
            for id, written in self.varied.items()
            if written.table.get("story")
        }
        sentence = N_("There is no story {name}; this course has {listed}.")
        return self.numbers(_named(name, tellers, sentence)) or {}

    def with_variants(self, variants: Mapping[str, int]) -> Course:
        """The course with these variants of the questions that have any; the others have 0.

        All that does not vary is shared with this one.
        """
        changed = {id for id in self.varied if variants.get(id, 0) != self.variants.get(id, 0)}
        if not changed:
            return self
        chapters = tuple(
            replace(
                chapter,
                questions=tuple(
                    written.question(variants.get(question.id, 0))
                    if question.id in changed
                    else question
                    for question, written in zip(chapter.questions, chapter.written, strict=True)
                ),
            )
            for chapter in self.chapters
        )
        made = replace(self, chapters=chapters, variants=dict(variants))
        if self.has_key:
            made.__dict__["answer_tables"] = self.answer_tables
        if "key" in self.__dict__:
            varied = {id: made._answer(made.question(id)) for id in changed}
            made.__dict__["key"] = {**self.key, **varied}
        return made

    def for_student(self, student: str) -> Course:
        """The course as a student has it: their own numbers, where the course gives such.

        ``student`` is what they say they are called; nobody has the sheet's numbers.
        """
        if not self.personal or not student.strip():
            return self
        return self.with_variants({id: self.variant_of(id, student) for id in self.varied})

    def variant_of(self, id: str, student: str) -> int:
        """The variant of a question that a student has, who says what they are called."""
        written = self.varied[id]
        assert written.variables is not None
        place = None if self.places is None else self.places.of(student)
        return written.variables.variant_of(written.chapter, student, place)

    @property
    def has_key(self) -> bool:
        """Whether the answers are at hand, as in the whole repository but not in a bundle."""
        return (self.root / ANSWERS).is_dir()

    @cached_property
    def key(self) -> dict[str, Answer]:
        """The answer to every question.

        Raises:
            CourseError: if an answer is missing, left over or does not fit its question.
        """
        if not self.has_key:
            raise CourseError(
                f"There is no key in {self.root / ANSWERS}; "
                "marking needs the whole repository, not the student bundle."
            )
        return {id: self._answer(question) for id, question in self.questions.items()}

    def _answer(self, question: Question) -> Answer:
        text, tables = self.answer_tables[question.chapter]
        table = tables[question.id]
        if question.id in self.varied:
            table = self.varied[question.id].key(table, self.variants.get(question.id, 0))
        return answer_from_table(table, question, text, self.numbers(question.id))

    @cached_property
    def answer_tables(self) -> dict[str, tuple[str, Table]]:
        """For each chapter the text of its key, and the tables in it.

        Raises:
            CourseError: if an answer is missing or left over.
        """
        read: dict[str, tuple[str, Table]] = {}
        for chapter in self.chapters if self.has_key else ():
            path = self.root / ANSWERS / f"{chapter.name}.toml"
            text, tables = read_toml(path, f"write the answers to {chapter.name}.toml there")
            asked = {question.id: question for question in chapter.questions}
            for id in tables.keys() - asked.keys():
                place = Place((ANSWERS / path.name).as_posix(), text)
                raise place.error(
                    f"it answers {id}, which nobody asks; add the question to "
                    f"{(QUESTIONS / path.name).as_posix()}, remove the answer, or write an id with "
                    'dots in quotes, as in ["Q1.2"]',
                    (id,),
                )
            for id in asked.keys() - tables.keys():
                written = next(one for one in chapter.written if one.table["id"] == id)
                file = path.relative_to(self.root).as_posix()
                raise written.place.error(f"it has no answer; add one to {file}", ("id",))
            read[chapter.name] = text, tables
        return read

    @cached_property
    def demo_cells(self) -> frozenset[str]:
        """The sources of the cells that only show something, from the handed-out notebooks.

        A submission that left them unchanged is graded without running them.
        """
        cells = [
            cell
            for path in student_notebooks(self.root)
            for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
            if DEMO in cell["metadata"].get("tags", ())
        ]
        return frozenset("".join(cell["source"]) for cell in cells)

    @cached_property
    def version(self) -> str:
        """A fingerprint of everything that can change a mark.

        That is the key, what student code finds around it, the limits on it, and the autograder.
        Of files only the contents count, since a fresh checkout has other times; of a large one,
        which no course has so far, the size and the ends.
        """
        digest = hashlib.sha256()
        digest.update(f"{self.settings}\0{sorted(self.demo_cells)}\0".encode())
        if self.personal:
            digest.update(f"{self.others_count}\0".encode())
            digest.update(f"{self.places.text() if self.places else ''}\0".encode())
        for top, folder, pattern, left_out in (
            (self.root, QUESTIONS, "*.toml", ()),
            (self.root, ANSWERS, "*.toml", ()),
            (self.root, SOLUTIONS, "**/*.py", ()),
            (self.root, NOTEBOOKS, "**/*.py", (MASTERS.name,)),
            (self.root, DATA, "**/*", ()),
            (_PACKAGE, ".", "**/*.py", _MARKS_NOTHING),
        ):
            for path in sorted((top / folder).glob(pattern)):
                inside = path.relative_to(top / folder)
                if inside.parts[0] in left_out or "__pycache__" in inside.parts:
                    continue
                if path.is_file():
                    digest.update(f"{folder}/{inside.as_posix()}\0".encode())
                    _digest_file(path, digest.update)
        return digest.hexdigest()[:16]


def _digest_file(path: Path, update: Callable[[bytes], object]) -> None:
    try:
        with path.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(0)
            update(f"{size}\0".encode())
            update(file.read(_LARGE_FILE // 2))
            file.seek(max(_LARGE_FILE // 2, size - _LARGE_FILE // 2))
            update(file.read(_LARGE_FILE // 2))
    except OSError as error:
        raise unreadable(path, error) from None


def find_course_root(start: Path | None = None) -> Path:
    """The nearest folder, from ``start`` (default: here) upwards, that holds a course.

    The environment variable ``AUTOGRADER_COURSE`` names it outright.

    Raises:
        CourseError: if there is none.
    """
    given = os.environ.get("AUTOGRADER_COURSE")
    if given and start is None:
        return Path(given)
    here = (start or Path.cwd()).resolve()
    for folder in (here, *here.parents):
        if (folder / QUESTIONS).is_dir():
            return folder
    raise CourseError(
        f"There is no course in {here} or above it (a folder with {QUESTIONS}); "
        "change to the course's folder, or name it with --course."
    )


def load_course(root: Path | None = None) -> Course:
    """Read the questions and settings of the course at ``root`` (default: found from here).

    Raises:
        CourseError: if there is no course, a file cannot be read, or an id or a variable is used
            twice.
    """
    if root is None:
        root = find_course_root()
    elif not (root / QUESTIONS).is_dir():
        # Not the course of a folder above: that would hide a mistyped name.
        raise CourseError(f"There is no course in {root}: it has no folder {QUESTIONS}.")
    root = root.resolve()
    settings = read_settings(root)
    use(settings.language)
    for package in settings.kinds:
        load_kind(package, root)
    chapters = []
    for path in sorted((root / QUESTIONS).glob("*.toml"), key=_chapter_position(root)):
        text, table = read_toml(path, "write it or remove the file")
        title = _check_fields(table, Place(path.relative_to(root).as_posix(), text))
        entries = table.get("question", [])
        if not (isinstance(entries, list) and all(isinstance(entry, dict) for entry in entries)):
            place = Place(path.relative_to(root).as_posix(), text)
            raise place.error(
                "each question is a table that begins with [[question]]", ("question",)
            )
        stories = _read_stories(table.get("story", {}), text, path.relative_to(root))
        written = tuple(
            Written.read(entry, path.stem, text, n, stories) for n, entry in enumerate(entries)
        )
        questions = tuple(entry.question() for entry in written)
        told = {entry.table.get("story") for entry in written}
        tables = table.get("prediction", [])
        heard = {name: told_by for name, told_by in stories.items() if name in told}
        predictions = _read_predictions(tables, text, path.relative_to(root), heard)
        chapters.append(Chapter(path.stem, title, questions, written, predictions))
    if not chapters:
        raise CourseError(f"{root / QUESTIONS} holds no questions; add a CHAPTER.toml.")
    _reject_duplicates(chapters)
    return Course(
        root,
        tuple(chapters),
        settings.limits,
        settings.kinds,
        personal=settings.variants == "student",
        others_count=settings.others_numbers == "count",
        places=read_places(root),
    )


def _check_fields(table: Table, place: Place) -> str:
    """The title of a file of questions, which holds nothing but what it may.

    Raises:
        CourseError: if there is none, or if there is anything else.
    """
    for name in table:
        if name not in _FIELDS:
            raise place.error(f"unknown field {name!r}; {meant(name, _FIELDS)}", (name,))
    title = table.get("title")
    if not isinstance(title, str):
        raise place.error(
            'a file of questions needs a title; write title = "..." in its first line'
        )
    return title


def _named(name: str, there_are: Mapping[str, _T], refusal: str) -> _T:
    """The entry of this name; a `UsageError` lists the names that exist, by a marked sentence."""
    try:
        return there_are[name]
    except (KeyError, TypeError):
        listed = ", ".join(there_are) or _("none")
        raise UsageError(_(refusal).format(name=repr(name), listed=listed)) from None


def _read_stories(stories: object, text: str, file: Path) -> dict[str, Variables]:
    place = Place(f"story in {file.as_posix()}", text, ("story",))
    if not isinstance(stories, dict):
        raise place.error("a story is a table such as [story.cloud]")
    return {
        name: read_variables(
            table, name, Place(f"story {name!r} in {file.as_posix()}", text, ("story", name))
        )
        for name, table in stories.items()
    }


def _read_predictions(
    tables: object, text: str, file: Path, stories: Mapping[str, Variables]
) -> tuple[Prediction, ...]:
    if not (isinstance(tables, list) and all(isinstance(table, dict) for table in tables)):
        raise Place(file.as_posix(), text).error(
            "each prediction is a table that begins with [[prediction]]", ("prediction",)
        )
    found = []
    for number, table in enumerate(tables):
        words = f"prediction {table.get('id', '?')!r} in {file.as_posix()}"
        place = Place(words, text, ("prediction", number))
        prediction = read_table(table, Prediction, place, chapter=file.stem)
        if prediction.story:
            if prediction.story not in stories:
                raise place.error("no question of this file tells that story", ("story",))
            try:
                prediction.with_numbers(stories[prediction.story].numbers(0))
            except CourseError as error:
                raise place.error(str(error).rstrip("."), ("prompt",)) from None
        found.append(prediction)
    return tuple(found)


def _reject_duplicates(chapters: list[Chapter]) -> None:
    placed: dict[str, str] = {}
    predicted: set[str] = set()
    for chapter in chapters:
        file = f"{chapter.name}.toml"
        text = next((written.text for written in chapter.written), "")
        for number, prediction in enumerate(chapter.predictions):
            if prediction.id in predicted:
                words = f"prediction {prediction.id!r} in {(QUESTIONS / file).as_posix()}"
                place = Place(words, text, ("prediction", number))
                raise place.error("two predictions have this id; rename one", ("id",))
            predicted.add(prediction.id)
        stored: dict[str, str] = {}
        for question, written in zip(chapter.questions, chapter.written, strict=True):
            if question.id in placed:
                files = " and ".join(dict.fromkeys([placed[question.id], file]))
                raise written.place.error(
                    f"two questions have this id (in {files}); rename one", ("id",)
                )
            placed[question.id] = file
            if question.name is None:
                continue
            if question.name in stored:
                field = next(key for key, value in written.table.items() if value == question.name)
                raise written.place.error(
                    f"{stored[question.name]} and {question.id} both store their response in "
                    f"{question.name!r}; rename one, or the later cell would overwrite the earlier",
                    (field,),
                )
            stored[question.name] = question.id


def _chapter_position(root: Path) -> Callable[[Path], str]:
    """Sort key: the number in the master's file name, so chapters stand as in the notebooks."""
    numbers = {
        path.stem.partition("_")[2]: path.stem for path in (root / NOTEBOOKS).glob("[0-9]*_*.ipynb")
    } | {path.stem.partition("_")[2]: path.stem for path in (root / MASTERS).glob("[0-9]*_*.py")}
    return lambda path: numbers.get(path.stem, "~" + path.stem)
