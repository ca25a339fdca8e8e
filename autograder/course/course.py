"""The course on disk: where it is, its chapters and questions, its key and its settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from autograder.course.answers import Answer, answer_from_table
from autograder.course.course_version import course_version
from autograder.course.folders import (
    ANSWERS,
    QUESTIONS,
    readable_notebooks,
    student_notebooks,
)
from autograder.course.places import Places
from autograder.course.predictions import Prediction
from autograder.course.questions import Question, Written
from autograder.course.settings import Settings
from autograder.course.toml_file import read_toml
from autograder.errors import CourseError, UsageError
from autograder.language import N_, _
from autograder.questions.strict_reader import Place, Table

DEMO = "demo"  # the tag of a cell that only shows something
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
        return frozenset(
            cell["source"]
            for notebook in readable_notebooks(student_notebooks(self.root))
            for cell in notebook["cells"]
            if DEMO in (cell["metadata"].get("tags") or ())
        )

    @cached_property
    def version(self) -> str:
        """A fingerprint of everything that can change a mark; see `course_version`."""
        return course_version(self)


def _named(name: str, there_are: Mapping[str, _T], refusal: str) -> _T:
    """The entry of this name; a `UsageError` lists the names that exist, by a marked sentence."""
    try:
        return there_are[name]
    except (KeyError, TypeError):
        listed = ", ".join(there_are) or _("none")
        raise UsageError(_(refusal).format(name=repr(name), listed=listed)) from None
