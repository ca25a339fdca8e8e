"""nbgrader: ``submitted/STUDENT/ASSIGNMENT/`` with ``timestamp.txt``, as its exchange collects it.

(nbgrader/exchange/default/collect.py and the directory structure in nbgrader's documentation)
"""

from __future__ import annotations

import re
from datetime import UTC, datetime
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from autograder.errors import UsageError
from autograder.intake.file_kinds import is_notebook_name, is_system
from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context, Entry, Found, fit_most, side_entry, visible
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.origin import LAYOUT, Claim, Origin

TIMESTAMP = "timestamp.txt"
SUBMITTED = "submitted"
# What else lies in the folder of a course.
_OF_COURSE = ("source", "release", "autograded", "feedback", "nbgrader_config.py", "gradebook.db")
_TIME = re.compile(r"(\d{4}-\d\d-\d\d)[ T](\d\d:\d\d:\d\d)(?:\.\d+)?\s*(\S+)?")


class NbGrader:
    """Folders of students that hold folders of assignments with ``timestamp.txt``."""

    name = "nbgrader"
    rule = f"nbgrader's {SUBMITTED}/STUDENT/ASSIGNMENT/: one student for each folder"

    def recognises(self, folder: Place) -> bool:
        if _in_course(folder) is not None:
            return True
        students = [place for place in visible(folder) if place.is_folder]
        if folder.name == SUBMITTED:
            return any(_assignments(student) for student in students)
        stamped = [
            student
            for student in students
            if any(
                below.name == TIMESTAMP
                for assignment in _assignments(student)
                for below in assignment.children()
            )
        ]
        return fit_most(stamped, folder)

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        submitted = _in_course(folder)
        for place in folder.children() if submitted is not None else ():
            if place.name in _OF_COURSE:
                found.pass_over(place, "nbgrader's own, beside what was handed in", False)
            elif place.name != SUBMITTED:
                side_entry(place, found)
        folder = submitted or folder
        students = []
        for place in folder.children():
            if place.is_folder and not place.name.startswith(".") and not is_system(place.name):
                students.append((place, _assignments(place)))
            else:
                side_entry(place, found, not place.is_folder)
        chosen = _assignment({a.name for _, all in students for a in all}, students, context)
        for student, assignments in students:
            mine = [assignment for assignment in assignments if assignment.name == chosen]
            for other in assignments:
                if other.name != chosen:
                    found.pass_over(other, f"another assignment than {shown(chosen)}", False)
            if not mine:
                found.pass_over(student, f"holds no folder {shown(chosen)}", not assignments)
                continue
            time = _timestamp(mine[0], context)
            origin = Origin(
                self.name,
                student.name,
                (Claim(called=student.name),),
                handed_in=time,
                time_from=LAYOUT if time else "",
                pieces=(mine[0].piece,),
            )
            found.entries.append(Entry(student.name, origin))
        return found


def _in_course(folder: Place) -> Place | None:
    """What was handed in, where the whole folder of a course is given."""
    below = {place.name: place for place in folder.children()}
    submitted = below.get(SUBMITTED)
    if submitted is None or not any(name in below for name in _OF_COURSE):
        return None
    students = [place for place in visible(submitted) if place.is_folder]
    return submitted if any(_assignments(student) for student in students) else None


def _assignments(student: Place) -> list[Place]:
    """The folders in a student's, unless notebooks lie beside them."""
    below = visible(student)
    if any(is_notebook_name(place.name) for place in below):
        return []
    return [place for place in below if place.is_folder and not place.name.startswith(".")]


def _assignment(
    names: set[str], students: list[tuple[Place, list[Place]]], context: Context
) -> str:
    """The one assignment, or of several the one whose notebooks are this course's.

    Raises:
        UsageError: if several are.
    """
    if len(names) <= 1:
        return next(iter(names), "")
    fitting = {
        assignment.name
        for _, assignments in students
        for assignment in assignments
        if any(
            is_notebook_name(place.name)
            and any(chapter.casefold() in place.name.casefold() for chapter in context.handout)
            for place in assignment.children()
        )
    }
    if len(fitting) == 1:
        return fitting.pop()
    listed = ", ".join(shown(name) for name in sorted(fitting or names)[:6])
    raise UsageError(
        f"There are several assignments here ({listed}) and it is not clear which is meant; give "
        "the students' folders of one of them."
    )


def _timestamp(assignment: Place, context: Context) -> datetime | None:
    place = next((p for p in assignment.children() if p.name == TIMESTAMP), None)
    if place is None or place.is_folder:
        return None
    try:
        found = _TIME.search(place.read(200).decode("ascii", "replace"))
    except (Unreadable, OSError):
        return None
    if found is None:
        return None
    time = datetime.fromisoformat(f"{found[1]}T{found[2]}")
    zone = found[3]
    if zone is None or zone.upper() in ("UTC", "GMT", "Z"):
        return time.replace(tzinfo=UTC)
    if re.fullmatch(r"[+-]\d\d:?\d\d", zone):
        return datetime.fromisoformat(f"{found[1]}T{found[2]}{zone}")
    try:
        return time.replace(tzinfo=ZoneInfo(zone))
    except (ZoneInfoNotFoundError, ValueError, OSError):
        # An abbreviation such as PST says too little; the class's own zone is the likeliest.
        return time.replace(tzinfo=context.zone) if context.zone else time.astimezone(UTC)
