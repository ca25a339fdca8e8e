"""Made-up classes of twelve as learning systems give them: two of one name, old attempts, ghosts.

Each maker writes a download into a folder and returns a `Download`: what to grade, the class list
to go with it, and for each person who handed in the time that the download gives (None: none).
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path

from tests.classroom import START, notebook
from tests.intake.handed_in import zipped

NAMES = (
    "Ada Lovelace", "Ada Lovelace", "José Núñez", "Zoë O'Brien-Smith", "李 小龙",
    "Anna Maria van Dyk", "Łukasz Żółć", "Jean-Luc Picard", "Robert Müller 2",
    "Fatima al-Zahra", "Björk", "Kim Lee",
)  # fmt: skip
FIRST_TIME = datetime(2026, 11, 1, 12, 30, 5, tzinfo=UTC)


@dataclass(frozen=True)
class Someone:
    """One of the class; ``number`` is what makes all identifiers unique."""

    name: str
    number: int

    @property
    def login(self) -> str:
        return f"user{self.number:02d}"

    @property
    def email(self) -> str:
        return f"{self.login}@example.org"

    @property
    def id(self) -> str:
        return str(90000 + self.number)

    @property
    def participant(self) -> str:
        return str(871000 + self.number)

    @property
    def time(self) -> datetime:
        return FIRST_TIME + timedelta(hours=self.number)

    def last_first(self) -> str:
        first, _, last = self.name.rpartition(" ")
        return f"{last}, {first}" if first else last

    def book(self, attempt: str = "last") -> bytes:
        """A notebook that says whose it is."""
        cells = [START, f"trees = 12  # {self.email} {attempt}", 'check("Q2", trees)']
        return notebook(cells).encode()

    def zip(self, attempt: str = "last", folder: str = "") -> bytes:
        return zipped({f"{folder}3_orchard.ipynb": self.book(attempt)})


PEOPLE = tuple(Someone(name, number) for number, name in enumerate(NAMES))


@dataclass
class Download:
    """What an instructor has on disk, and what is true of it."""

    path: Path
    class_list: Path
    times: dict[str, datetime | None] = field(default_factory=dict)


def put(path: Path, data: bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return path


def ghosts(folder: Path) -> None:
    """What lies about in every download and nobody handed in."""
    put(folder / ".DS_Store", b"\0")
    put(folder / "__MACOSX/._3_orchard.ipynb", b"\0")
    put(folder / "Thumbs.db", b"\0")


def moodle(root: Path) -> Download:
    """In folders: zips, loose notebooks, one more folder, with and without the last ``_``."""
    work = root / "CS101-Exercise 3-4711"
    for person in PEOPLE:
        end = "_" if person.number % 2 else ""
        folder = work / f"{person.name}_{person.participant}_assignsubmission_file{end}"
        kind = person.number % 3
        if kind == 0:
            put(folder / "submission.zip", person.zip())
        elif kind == 1:
            put(folder / "3_orchard.ipynb", person.book())
        else:
            put(folder / "my work/notebooks/3_orchard.ipynb", person.book())
    online = f"{PEOPLE[2].name}_{PEOPLE[2].participant}_assignsubmission_onlinetext"
    put(work / online / "onlinetext.html", b"<p>see file</p>")
    ghosts(work)
    return Download(work, worksheet(root), {p.email: p.time for p in PEOPLE})


def moodle_flat(root: Path) -> Download:
    """The same as files with a prefix."""
    work = root / "download"
    for person in PEOPLE:
        start = f"{person.name}_{person.participant}_assignsubmission_file_"
        if person.number % 2:
            put(work / f"{start}submission (1).zip", person.zip(folder="notebooks/"))
        else:
            put(work / f"{start}3_orchard.ipynb", person.book())
    return Download(work, worksheet(root), {p.email: p.time for p in PEOPLE})


def worksheet(root: Path) -> Path:
    """Moodle's offline grading worksheet."""
    rows = ["Identifier,Full name,Email address,Status,Grade,Last modified (submission)"]
    for person in PEOPLE:
        time = person.time.strftime("%A, %d %B %Y, %I:%M:%S %p")
        rows.append(f'Participant {person.participant},{person.name},{person.email},,,"{time}"')
    return put(root / "worksheet.csv", "\r\n".join(rows).encode("utf-8-sig"))


def canvas(root: Path) -> Download:
    """One folder of files, some late, some with versions, some of several notebooks."""
    work = root / "submissions"
    for person in PEOPLE:
        plain = "".join(c for c in person.last_first() if c.isalnum() or c == "_").lower()
        start = f"{plain}{'_LATE' if person.number == 3 else ''}_{person.id}"
        if person.number % 3 == 1:
            put(work / f"{start}_{4000 + person.number}_submission.zip", person.zip("old"))
            put(work / f"{start}_{5000 + person.number}_submission-1.zip", person.zip())
        elif person.number % 3 == 2:
            put(work / f"{start}_{5000 + person.number}_3_orchard.ipynb", person.book())
            extra = notebook(["# more"]).encode()
            put(work / f"{start}_{6000 + person.number}_scratch_12_34_x.ipynb", extra)
        else:
            put(work / f"{start}_{5000 + person.number}_3_orchard-2.ipynb", person.book())
    ghosts(work)
    rows = ["Student,ID,SIS User ID,SIS Login ID,Section,Exercise 3 (4711)"]
    rows.append("    Points Possible,,,,,10")
    rows += [f'"{p.last_first()}",{p.id},S{p.id},{p.email},Tuesday,' for p in PEOPLE]
    rows.append('"Student, Test",99999,,t,Tuesday,')
    path = put(root / "gradebook.csv", "\n".join(rows).encode("utf-8-sig"))
    return Download(work, path, dict.fromkeys((p.email for p in PEOPLE), None))


def gradescope(root: Path) -> Download:
    """A folder for each submission, and the side file."""
    work = root / "assignment_77_export"
    said = ["---"]
    for person in PEOPLE:
        folder = f"submission_{3000 + person.number}"
        put(work / folder / "3_orchard.ipynb", person.book())
        time = person.time.strftime("%Y-%m-%d %H:%M:%S.000000000 Z")
        said += [f"{folder}:", "  :submitters:", f"  - :name: {person.name}"]
        said += [f"    :sid: 'S{person.id}'", f"    :email: {person.email}"]
        said += [f"  :created_at: {time}", "  :score: 0.0", "  :status: processed"]
    put(work / "submission_metadata.yml", "\n".join(said).encode())
    ghosts(work)
    rows = ["First Name,Last Name,SID,Email,Role"]
    for person in PEOPLE:
        first, _, last = person.name.rpartition(" ")
        rows.append(f"{first or last},{last if first else ''},S{person.id},{person.email},Student")
    rows.append("Tea,Cher,S1,tea@example.org,Instructor")
    path = put(root / "roster.csv", "\n".join(rows).encode("utf-8"))
    return Download(work, path, {p.email: p.time for p in PEOPLE})


def blackboard(root: Path) -> Download:
    """Every attempt, with a note to each."""
    work = root / "gradebook_CS101"
    for person in PEOPLE:
        for attempt in ("old", "last") if person.number % 2 else ("last",):
            when = person.time - timedelta(days=attempt == "old")
            start = f"Exercise_3 on lines_{person.login}_attempt_{when:%Y-%m-%d-%H-%M-%S}"
            note = f"Name: {person.name} ({person.login})\nAssignment: Exercise_3 on lines\n"
            put(work / f"{start}.txt", note.encode())
            put(work / f"{start}_submission.zip", person.zip(attempt))
    return Download(work, plain_list(root, "utf-16"), {p.email: p.time for p in PEOPLE})


def nbgrader(root: Path) -> Download:
    """One folder above ``submitted``."""
    work = root / "course"
    for person in PEOPLE:
        folder = work / "submitted" / person.login / "ex3"
        put(folder / "3_orchard.ipynb", person.book())
        put(folder / "timestamp.txt", f"{person.time:%Y-%m-%d %H:%M:%S}.123456 UTC".encode())
    ghosts(work)
    ghosts(work / "submitted")
    return Download(work, plain_list(root, "latin-1"), {p.email: p.time for p in PEOPLE})


def github(root: Path) -> Download:
    """Repositories; the first person pushed once more after the due time."""
    work = root / "exercise-3-submissions"
    for person in PEOPLE:
        folder = work / f"exercise-3-git-{person.login}"
        put(folder / "3_orchard.ipynb", person.book())
        git(folder, "init", "-q")
        commit(folder, person.time)
        if person.number == 0:
            put(folder / "3_orchard.ipynb", person.book("too late"))
            commit(folder, FIRST_TIME + timedelta(days=30))
    ghosts(work)
    rows = ["identifier,github_username,github_id,name"]
    rows += [f"{p.email},git-{p.login},{p.id},{p.name}" for p in PEOPLE]
    path = put(root / "classroom_roster.csv", "\n".join(rows).encode())
    return Download(work, path, {p.email: p.time for p in PEOPLE})


def git(folder: Path, *arguments: str, **environment: str) -> None:
    ours = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, **environment}
    who = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
    command = ["git", *who, *arguments]
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, **ours})


def commit(folder: Path, time: datetime) -> None:
    git(folder, "add", "-A")
    when = time.isoformat()
    git(folder, "commit", "-qm", "x", GIT_AUTHOR_DATE=when, GIT_COMMITTER_DATE=when)


def plain(root: Path) -> Download:
    """Zips, folders, bare notebooks, a zip in a zip; by login, e-mail address or whole name."""
    work = root / "handed in"
    for person in PEOPLE:
        kind = person.number % 4
        if kind == 0:
            put(work / f"{person.login}.zip", person.zip(folder="notebooks/"))
        elif kind == 1:
            put(work / person.login / "3_orchard.ipynb", person.book())
        elif kind == 2:
            called = person.email if person.number == 2 else person.name
            put(work / f"{called}.ipynb", person.book())
        else:
            put(work / f"{person.login}.zip", zipped({"submission.zip": person.zip()}))
    ghosts(work)
    return Download(work, plain_list(root, "utf-8"), dict.fromkeys((p.email for p in PEOPLE), None))


def plain_list(root: Path, encoding: str) -> Path:
    rows = ["Name;Login;Email"]
    for person in PEOPLE:
        name = person.name.encode(encoding, "ignore").decode(encoding).strip() or "Li"
        rows.append(f"{name};{person.login};{person.email}")
    return put(root / "people.csv", "\r\n".join(rows).encode(encoding))


MAKERS: dict[str, Callable[[Path], Download]] = {
    maker.__name__: maker
    for maker in (*(moodle, moodle_flat, canvas, gradescope, blackboard, nbgrader, github, plain),)
}


def as_it_is(download: Download) -> Path:
    return download.path


def one_folder_higher(download: Download) -> Path:
    above = download.path.parent / "higher"
    above.mkdir()
    shutil.move(download.path, above / download.path.name)
    return above


def zipped_whole(download: Download) -> Path:
    made = shutil.make_archive(
        str(download.path) + "-download", "zip", download.path.parent, download.path.name
    )
    return Path(made)


PACKINGS = (as_it_is, one_folder_higher, zipped_whole)
