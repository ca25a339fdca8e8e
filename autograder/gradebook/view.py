"""The records of a class as everybody is to see them: with people, and as the scheme has it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from autograder.course import Course
from autograder.gradebook.book import Gradebook
from autograder.gradebook.grading_scheme import Scheme, plain_scheme
from autograder.gradebook.read_grading_toml import read_scheme
from autograder.gradebook.record import Record
from autograder.gradebook.stored_records import StoredRecords
from autograder.intake.class_list import ClassList
from autograder.intake.match_people import Match
from autograder.intake.person import Person

SCHEME = "grading"  # the setting that holds the text of the accepted grading.toml


@dataclass(frozen=True)
class ClassView:
    """A class: its course, its scheme, everybody's record, and who is in the class list.

    ``matches`` says by the student's key whose each submission is, or why that is not certain.
    """

    course: Course
    scheme: Scheme
    records: Sequence[Record]
    class_list: ClassList
    matches: dict[str, Match]

    @property
    def missing(self) -> list[Person]:
        """Those of the class list who handed in nothing that is certainly theirs."""
        found = {person for match in self.matches.values() for person in match.people}
        return [person for person in self.class_list.students if person not in found]

    @property
    def nobodys(self) -> list[Record]:
        """The work that belongs to nobody in the class list, where there is one."""
        if not self.class_list.students:
            return []
        return [record for record in self.records if not record.people]

    @property
    def open(self) -> list[Record]:
        """The work in which a question waits for a person."""
        return [record for record in self.records if record.open]


def view_class(
    course: Course,
    book: Gradebook,
    class_list: ClassList,
    proposed: str | None = None,
    where: str = "the grading.toml that was accepted",
    streamed: bool = False,
) -> ClassView:
    """Everything about a class, as it was last decided.

    ``proposed`` is the text of a grading.toml to see it by instead, and ``where`` its name. If
    ``streamed``, the records of a large class are read anew whenever they are gone through, as they
    are then, and the gradebook has to stay open; without a class list there are no ``matches``.

    Raises:
        CourseError: if the scheme names what the course or the class does not have.
    """
    text = (book.setting(SCHEME) or "") if proposed is None else proposed
    matches: dict[str, Match] = {}
    records: Sequence[Record]
    if not streamed:
        records, matches = with_people(book.records(), class_list)
    else:
        if class_list.students:
            matches = class_list.match_all({student: o for student, _, o in book.origins()})
        records = StoredRecords(book, lambda record: _with_match(record, matches))
    scheme = read_scheme(text, course, records, where) if text else plain_scheme(course)
    if text and isinstance(records, StoredRecords):
        records = StoredRecords(
            book, lambda record: replace(_with_match(record, matches), scheme=scheme)
        )
    elif text:
        records = [replace(record, scheme=scheme) for record in records]
    if not streamed:
        records = tuple(records)
    return ClassView(course, scheme, records, class_list, matches)


def _with_match(record: Record, matches: Mapping[str, Match]) -> Record:
    match = matches.get(record.student)
    return replace(record, people=match.people) if match else record


def with_people(
    records: Sequence[Record], class_list: ClassList
) -> tuple[list[Record], dict[str, Match]]:
    """The records with the people whose work they are, and what each was matched by."""
    matches = class_list.match_all({record.student: record.origin for record in records})
    return [replace(r, people=matches[r.student].people) for r in records], matches
