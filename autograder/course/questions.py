"""What is asked, read from ``notebooks/questions/*.toml``. These files go to students.

What a question has beyond an id, a title, a prompt and hints is the business of its kind.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from autograder.course.placeholders import NotFilled, fill
from autograder.course.selections import DRAW, FIELD, drawn, read_draws
from autograder.questions.nearest_name import meant, nearest
from autograder.questions.question import Question
from autograder.questions.registry import has_kind, kind_named, kind_names
from autograder.questions.strict_reader import Place, Table, read_table
from autograder.questions.variables import Variables, read_variables

__all__ = ["Question", "Written", "question_from_table"]


@dataclass(frozen=True)
class Written:
    """A ``[[question]]`` table as it stands, at ``position`` in the ``text`` of its file."""

    table: Table
    chapter: str
    text: str = ""
    position: int = 0
    variables: Variables | None = None

    @property
    def place(self) -> Place:
        """Where it stands, for errors."""
        words = f"question {self.table.get('id', '?')!r} in notebooks/questions/{self.chapter}.toml"
        return Place(words, self.text, ("question", self.position))

    def question(self, variant: int = 0) -> Question:
        """The question with the numbers of a variant; 0 has the sheet's.

        Raises:
            CourseError: if a field is missing, unknown or of the wrong type; the sentence names the
                question, the field, the file and, given its text, the line.
        """
        if self.variables is None:
            return question_from_table(self.table, self.chapter, self.text, self.position)
        numbers = self.variables.numbers(variant)
        try:
            filled = fill(self.table, numbers)
        except NotFilled as error:
            raise error.at(self.place) from None
        if FIELD in self.table:
            listed = kind_named(self.table["kind"]).drawn_fields[0]
            filled = drawn(filled, listed, self.table[FIELD], numbers)
        return question_from_table(filled, self.chapter, self.text, self.position)

    def entries(self, variant: int) -> tuple[int, ...]:
        """The numbers of the entries that a variant draws from a bank, from 1; none elsewhere."""
        draws = self.table.get(FIELD)
        if self.variables is None or not isinstance(draws, list):
            return ()
        return tuple(draws[int(self.variables.numbers(variant)[DRAW])])

    def key(self, table: Table, variant: int) -> Table:
        """The table of its key with what belongs to a variant, where some entries are drawn.

        Raises:
            CourseError: if the key does not have as many entries as the question.
        """
        if self.variables is None or FIELD not in self.table or not isinstance(table, dict):
            return table
        listed, keyed = kind_named(self.table["kind"]).drawn_fields
        if not keyed:
            return table
        asked, known = len(self.table[listed]), table.get(keyed)
        if isinstance(known, list) and len(known) != asked:
            raise self.place.error(
                f"it has {asked} {listed}, but its key {len(known)} [[{keyed}]] tables"
            )
        return drawn(table, keyed, self.table[FIELD], self.variables.numbers(variant))

    @classmethod
    def read(
        cls,
        table: Table,
        chapter: str,
        text: str,
        position: int,
        stories: Mapping[str, Variables],
    ) -> Written:
        """A table, with the variables of its story or its own.

        Raises:
            CourseError: if there is no such story, or the variables are wrong.
        """
        written = cls(table, chapter, text, position)
        story, own = table.get("story"), table.get("variables")
        if FIELD in table and (story or own is not None):
            raise written.place.error("it has variables; remove them or draws", (FIELD,))
        if FIELD in table:
            kind = table.get("kind")
            if not isinstance(kind, str) or not has_kind(kind):
                return written  # reading the question says so
            listed = kind_named(kind).drawn_fields[0]
            return replace(written, variables=read_draws(table, listed, written.place))
        if isinstance(story, str) and story:
            if story not in stories:
                raise written.place.error(f"there is no [story.{story}] in this file", ("story",))
            return replace(written, variables=stories[story])
        if own is not None:
            name = str(table.get("id"))
            place = replace(written.place, path=(*written.place.path, "variables"))
            return replace(written, variables=read_variables(own, name, place))
        return written


def question_from_table(table: Table, chapter: str, text: str = "", position: int = 0) -> Question:
    """Read one ``[[question]]`` table: the one at ``position`` in the ``text`` of its file.

    Raises:
        CourseError: if a field is missing, unknown or of the wrong type; the sentence names the
            question, the field, the file and, given its text, the line.
    """
    place = Written(table, chapter, text, position).place
    name = table.get("kind")
    if "kind" not in table:
        near = nearest("kind", table)
        if near:
            raise place.error(f"unknown field {near!r}; perhaps 'kind' is meant", (near,))
        raise place.error(f"the field 'kind' is missing; write one of {', '.join(kind_names())}")
    if not isinstance(name, str) or not has_kind(name):
        cure = meant(str(name), kind_names())
        raise place.error(
            f"kind {name!r} is not one of {', '.join(kind_names())}; {cure}", ("kind",)
        )
    return read_table(dict(table), kind_named(name).question_type, place, chapter=chapter)
