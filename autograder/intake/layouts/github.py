"""GitHub Classroom: a repository for each student, ``assignment-login/``, as its tools clone them.

``gh classroom clone student-repos`` puts them into ``assignment-submissions/``. What counts is the
last commit before the due time. (docs.github.com, "Downloading student work")
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta

from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context, Entry, Found, side_entry, visible
from autograder.intake.origin import LAYOUT, Claim, Origin, Piece
from autograder.intake.person import Person
from autograder.intake.repository import Commit, choose_commits

_COLLECTION = "-submissions"


class GitHub:
    """Folders that are git repositories."""

    name = "github"
    rule = "GitHub Classroom: one student for each repository, the last commit before the due time"

    def recognises(self, folder: Place) -> bool:
        repositories = [place for place in visible(folder) if _is_repository(place)]
        has_clone_name = folder.name.endswith(_COLLECTION)
        # One repository among other folders is a student who works with git, not a classroom.
        names = {place.name for place in repositories}
        others = [p for p in visible(folder) if p.is_folder and p.name not in names]
        return bool(repositories) and (has_clone_name or len(repositories) > len(others))

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        places = []
        for place in folder.children():
            if place.is_folder and not place.name.startswith((".", "__")):
                places.append(place)
            else:
                side_entry(place, found, place.name.lower().endswith(".csv"))
        prefix = assignment_prefix([place.name for place in places], folder.name, context.people)
        logins = [place.name.removeprefix(prefix) or place.name for place in places]
        repositories = [
            (place, _until(login, context))
            for place, login in zip(places, logins, strict=True)
            if _is_repository(place)
        ]
        commits = dict(
            zip(
                (place.name for place, _ in repositories), choose_commits(repositories), strict=True
            )
        )
        for place, login in zip(places, logins, strict=True):
            found.entries.append(self._entry(place, login, commits.get(place.name, "")))
        return found

    def _entry(self, place: Place, login: str, commit: Commit | str) -> Entry:
        time: datetime | None = None
        piece = place.piece
        notes: tuple[str, ...] = ()
        if isinstance(commit, Commit):
            time = commit.time
            if not commit.is_last:
                piece = Piece(piece.path, piece.inside, commit.id)
                notes = (
                    f"The commit {commit.id[:7]} was marked, the last before the due time; "
                    f"{commit.later} later ones were not.",
                )
        elif commit:
            notes = (f"The time of its last commit is not known: {commit}.",)
        else:
            notes = ("It is not a git repository, so nothing says when it was handed in.",)
        claim = Claim(login=login)
        origin = Origin(
            self.name, place.name, (claim,), "", time, LAYOUT if time else "", pieces=(piece,)
        )
        return Entry(login, origin, place.name, notes)


def assignment_prefix(names: Sequence[str], folder: str, people: Sequence[Person]) -> str:
    """What stands before the login in every name, with its hyphen; empty if that is not certain.

    Logins hold hyphens too, so the folder of the clones decides, then the logins of the class list,
    and only then what many names have in common.
    """
    given = folder.removesuffix(_COLLECTION) + "-"
    if folder.endswith(_COLLECTION) and all(name.startswith(given) for name in names):
        return given
    first = min(names, default="")
    cuts = [first[: n + 1] for n, letter in enumerate(first) if letter == "-"]
    cuts = [cut for cut in cuts if all(name.startswith(cut) for name in names)]
    logins = {
        login.casefold() for person in people for login in (person.github, person.login) if login
    }
    known = {
        cut: sum(name.removeprefix(cut).casefold() in logins for name in names) for cut in cuts
    }
    best = max(known, key=lambda cut: known[cut], default="")
    if best and known[best]:
        return best
    return cuts[-1] if len(names) > 2 and cuts else ""


def _is_repository(place: Place) -> bool:
    return place.is_folder and any(
        child.name == ".git" and child.is_folder for child in place.children()
    )


def _until(login: str, context: Context) -> datetime | None:
    """The due time of one student, with their extension."""
    if context.due is None:
        return None
    for person in context.people:
        if login.casefold() in (person.login.casefold(), person.github.casefold()):
            return context.due + timedelta(days=person.extension_days)
    return context.due
