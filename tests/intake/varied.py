"""Classes of twelve that no two seeds make alike: layouts, names, packings, lists, odd uploads.

`make_class` writes a download as a system would give it, the class lists to go with it, and says
what is true: who handed in, when, which people cannot be told apart, and what belongs to nobody.
"""

from __future__ import annotations

import csv
import io
import random
import shutil
import unicodedata
import zipfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Literal
from zoneinfo import ZoneInfo

from tests.classroom import START, notebook
from tests.intake.classes import commit, ghosts, git, put
from tests.intake.handed_in import zipped

FIRST = (
    *("Ada", "José", "Zoë", "Łukasz", "Jean-Luc", "Fatima", "Anna Maria", "Søren", "Kim", "D'Arcy"),
    *("小龙", "Ольга", "Nguyễn Văn", "Mehmet", "Ines", "O", "Bob", "Chloé", "Ümit", "Åsa"),
)
LAST = (
    *("Lovelace", "Núñez", "O'Brien-Smith", "Żółć", "Picard", "al-Zahra", "van Dyk", "Kierkegaard"),
    *(
        "Lee",
        "李",
        "Иванова",
        "An",
        "Öztürk",
        "da Silva e Souza",
        "Ng",
        "Tables",
        "Müller",
        "St. John",
    ),
    *("Doe Jr.", "Ångström", "Weiß"),
)
DAYS = ("Montag", "Dienstag", "Mittwoch", "Donnerstag", "Freitag", "Samstag", "Sonntag")
MONTHS = ("Januar", "Februar", "März", "April", "Mai", "Juni", "Juli", "August", "September",
          "Oktober", "November", "Dezember")  # fmt: skip
DUE = datetime(2026, 11, 20, 12, 0, tzinfo=UTC)


@dataclass(frozen=True)
class Student:
    """One of the class, with all that any system calls them."""

    first: str
    last: str
    number: int
    login: str
    time: datetime

    @property
    def name(self) -> str:
        return f"{self.first} {self.last}".strip()

    @property
    def email(self) -> str:
        return f"{self.login}@uni.example.org"

    @property
    def id(self) -> str:
        return str(98700 + self.number)

    @property
    def sis(self) -> str:
        return f"S-{1815 + self.number}"

    @property
    def github(self) -> str:
        return f"{self.login}-gh".replace(".", "-")

    @property
    def participant(self) -> str:
        return str(871030 + self.number)


@dataclass
class MadeClass:
    """A class on disk and the truth about it; ``times`` and ``attempt`` are by address.

    ``untold`` are people who handed in but whom nothing in the download tells apart; ``strangers``
    counts the work of people who are not in the list.
    """

    paths: list[Path]
    lists: list[Path]
    people: list[Student]
    layout: str
    times: dict[str, datetime | None] = field(default_factory=dict)
    untold: set[str] = field(default_factory=set)
    strangers: int = 0
    options: list[str] = field(default_factory=list)
    settled: dict[str, str] = field(default_factory=dict)
    partners: dict[str, list[Student]] = field(default_factory=dict)
    story: list[str] = field(default_factory=list)


def book(student: Student, attempt: str = "last") -> bytes:
    """A notebook that says whose it is and which attempt."""
    cells = [START, f"trees = {student.number}  # {student.email} {attempt}", 'check("Q2", trees)']
    return notebook(cells).encode()


HANDOUT = notebook([START]).encode()


def uploads(student: Student, attempt: str, rng: random.Random) -> dict[str, bytes]:
    """What one student uploads, by its path."""
    own = book(student, attempt)
    old = book(student, "forgotten checkpoint")
    nice = {"3_orchard.ipynb": own}
    in_folder = {"notebooks/3_orchard.ipynb": own, "responses/orchard.json": b'{"responses": {}}'}
    mac = {
        "ex3/3_orchard.ipynb": own,
        "__MACOSX/ex3/._3_orchard.ipynb": b"\0\5\x16\7",
        "ex3/.DS_Store": b"\0",
        "ex3/.ipynb_checkpoints/3_orchard-checkpoint.ipynb": old,
    }
    two = {"backup/3_orchard.ipynb": HANDOUT, "final/3_orchard.ipynb": own}
    ways: list[Callable[[], dict[str, bytes]]] = [
        lambda: nice,
        lambda: {"3_orchard (1).ipynb": own},
        lambda: {"3_orchard.ipynb.json": own},
        lambda: {"3_orchard.ipynb.txt": own},
        lambda: {"3_orchard.ipynb (1).json": own},
        lambda: {"3_orchard-Copy1.ipynb": own},
        lambda: {f"{student.last.split()[0]}_ORCHARD final.ipynb": own},
        lambda: {"Untitled3.ipynb": own},
        lambda: {"submission.zip": zipped(nice)},
        lambda: {"submission (2).zip": zipped(in_folder)},
        lambda: {"my work.zip": zipped(mac)},
        lambda: {"final.zip": zipped({"submission.zip": zipped(in_folder)})},
        lambda: {"ex3.zip": zipped(two)},
        lambda: {"SUBMISSION.ZIP": zipped({f"{student.login}/notebooks/3_orchard.ipynb": own})},
        lambda: {"windows.zip": raw_zip({"work\\notebooks\\3_orchard.ipynb": own})},
        lambda: {"drive.zip": raw_zip({"C:/work/3_orchard.ipynb": own})},
        lambda: {"absolute.zip": raw_zip({"/home/me/3_orchard.ipynb": own})},
        lambda: {"3_orchard.ipynb": own, "submission.zip": zipped(nice)},
        lambda: {"3_orchard.ipynb": own, "report.pdf": b"%PDF-1.4", "notes.txt": b"hello"},
        lambda: {"3_orchard.ipynb": own, "scratch.ipynb": notebook(["# nothing"]).encode()},
        lambda: {"twice.zip": raw_zip_twice("3_orchard.ipynb", old, own)},
    ]
    return rng.choice(ways)()


def raw_zip(entries: dict[str, bytes]) -> bytes:
    """A zip with names as they are, which `zipfile` would mend."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in entries.items():
            info = zipfile.ZipInfo("x")
            info.filename = name
            archive.writestr(info, data)
    return buffer.getvalue()


def raw_zip_twice(name: str, first: bytes, second: bytes) -> bytes:
    buffer = io.BytesIO()
    import warnings

    with warnings.catch_warnings(), zipfile.ZipFile(buffer, "w") as archive:
        warnings.simplefilter("ignore")
        archive.writestr(name, first)
        archive.writestr(name, second)
    return buffer.getvalue()


def make_people(rng: random.Random) -> list[Student]:
    """Twelve, two of one name, some with logins that hold dots, hyphens and digits."""
    names = {(rng.choice(FIRST), rng.choice(LAST)) for _ in range(40)}
    chosen = rng.sample(sorted(names), 11)
    chosen.insert(rng.randrange(12), chosen[rng.randrange(11)])
    people = []
    for number, (first, last) in enumerate(chosen):
        login = rng.choice(["al{:02d}", "user{}", "x{}y", "st.{:03d}", "a-{}-b"]).format(number)
        hours = rng.randrange(1, 300)
        time = DUE - timedelta(hours=hours, seconds=rng.randrange(60))
        people.append(Student(first, last, number, login, time))
    late = rng.randrange(12)
    one = people[late]
    later = DUE + timedelta(hours=rng.choice([1, 30, 50]), minutes=7)
    people[late] = Student(one.first, one.last, one.number, one.login, later)
    return people


def table(
    root: Path, name: str, rows: Iterable[Iterable[str]], rng: random.Random, story: list[str]
) -> Path:
    """A table in one of the encodings, separators and ends of line that are about."""
    separator = rng.choice([",", ",", ";", "\t"])
    end = rng.choice(["\r\n", "\n"])
    quoting = rng.choice([csv.QUOTE_MINIMAL, csv.QUOTE_ALL])
    text = io.StringIO()
    writer = csv.writer(text, delimiter=separator, lineterminator=end, quoting=quoting)
    writer.writerows(rows)
    encodings = ["utf-8", "utf-8-sig", "utf-16", "latin-1", "cp1252"]
    rng.shuffle(encodings)
    for encoding in encodings:
        try:
            data = text.getvalue().encode(encoding)
        except UnicodeEncodeError:
            continue
        story.append(f"{name}: {encoding}, {separator!r}, {end!r}")
        return put(root / name, data)
    raise AssertionError("UTF-8 takes everything")


def plain_list(root: Path, people: list[Student], rng: random.Random, story: list[str]) -> Path:
    ways: list[tuple[list[str], Callable[[Student], list[str]]]] = [
        (["Name", "Login", "Email"], lambda p: [p.name, p.login, p.email]),
        (
            ["Last name", "First name", "Username", "E-mail"],
            lambda p: [p.last, p.first, p.login, p.email],
        ),
        (
            ["Nachname", "Vorname", "Benutzername", "E-Mail-Adresse", "Gruppe"],
            lambda p: [p.last, p.first, p.login, p.email, "Di"],
        ),
        (
            ["student_name", "student id", "login", "email"],
            lambda p: [f"{p.last}, {p.first}", p.sis, p.login, p.email],
        ),
    ]
    header, row = rng.choice(ways)
    return table(root, "people.csv", [header, *map(row, people)], rng, story)


# ---------------------------------------------------------------------------------- the layouts


def moodle(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / rng.choice(["CS101-Exercise 3-4711", "work", "Übung 3"])
    flat, end = rng.random() < 0.4, rng.choice(["", "_"])
    group = rng.choice(["", "", "Group A-"])
    form: Literal["NFC", "NFD"] = rng.choice(["NFC", "NFD"])  # macOS unpacks to the second
    anonymous = not group and rng.random() < 0.2
    for person in people:
        name = "Participant" if anonymous else f"{group}{person.name}".replace("_", " ")
        name = unicodedata.normalize(form, name)
        prefix = f"{name}_{person.participant}_assignsubmission_file"
        for path, data in uploads(person, "last", rng).items():
            if flat:
                put(work / f"{prefix}_{path}", data)
            else:
                deeper = rng.choice(["", "", "my folder/"])
                put(work / (prefix + end) / (deeper + path), data)
        if rng.random() < 0.2:
            text = f"{name}_{person.participant}_assignsubmission_onlinetext"
            inside = f"{text}_onlinetext.html" if flat else f"{text}{end}/onlinetext.html"
            put(work / inside, b"<p>done</p>")
    made.paths = [work]
    if anonymous or rng.random() < 0.7:
        made.lists.append(worksheet(root, made.people, rng, made.story, anonymous))
        made.times = {p.email: p.time for p in people}
    else:  # the list of participants knows no numbers: two of one name are not told apart
        header = ["First name", "Last name", "ID number", "Email address", "Groups"]
        rows = [[p.first, p.last, p.sis, p.email, "Group A, Tue"] for p in made.people]
        made.lists.append(table(root, "participants.csv", [header, *rows], rng, made.story))
        made.times = dict.fromkeys((p.email for p in people), None)
        names = [p.name for p in made.people]
        made.untold = {p.email for p in people if names.count(p.name) > 1}


def worksheet(
    root: Path, people: list[Student], rng: random.Random, story: list[str], anonymous: bool
) -> Path:
    """Moodle's offline grading worksheet; with hidden names somebody adds the addresses."""
    german = rng.random() < 0.4
    header = [
        "Identifier",
        "Full name",
        "Email address",
        "Status",
        "Grade",
        "Last modified (submission)",
    ]
    word = "Participant "
    if german:
        header = ["ID", "Vollständiger Name", "E-Mail-Adresse", "Status", "Bewertung",
                  "Zuletzt geändert (Abgabe)"]  # fmt: skip
        word = "Teilnehmer/in"
    rows = []
    for person in people:
        local = person.time.astimezone(ZoneInfo("Europe/Zurich"))
        if german:
            day, month = DAYS[local.weekday()], MONTHS[local.month - 1]
            time = f"{day}, {local.day}. {month} {local.year}, {local:%H:%M:%S}"
        else:
            time = f"{local:%A}, {local.day} {local:%B %Y, %I:%M:%S %p}"
        rows.append(
            [f"{word}{person.participant}", person.name, person.email, "Submitted", "", time]
        )
    return table(root, "worksheet.csv", [header, *rows], rng, story)


def canvas(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / rng.choice(["submissions", "canvas files", "ex3"])
    file = 500_000
    anonymous = rng.random() < 0.2
    for person in people:
        run = "".join(c for c in f"{person.last}{person.first}".casefold() if c.isalnum())
        late = "_LATE" if person.time > DUE else ""
        start = f"{run}{late}_{person.id}"
        if anonymous:
            code = f"x{person.number:02d}Yz"
            start = f"{'LATE_' if late else ''}anon_{code}"
            made.settled[f"anon_{code}"] = rng.choice([person.id, person.email, person.sis])
        sent = uploads(person, "last", rng)
        again = len(sent) == 1 and rng.random() < 0.4
        for path, data in sent.items():
            if again:
                older = dict.fromkeys(sent, book(person, "old"))
                if path.lower().endswith(".zip"):
                    older = {path: zipped({"3_orchard.ipynb": book(person, "old")})}
                file += rng.randrange(1, 900)
                put(work / f"{start}_{file}_{path}", older[path])
                path = _versioned(path)
            file += rng.randrange(1, 900)
            put(work / f"{start}_{file}_{path}", data)
    made.paths = [work]
    made.times = dict.fromkeys((p.email for p in people), None)
    header = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Exercise 3 (4711)"]
    rows = [[f"{p.last}, {p.first}", p.id, p.sis, p.email, "Tue", ""] for p in made.people]
    extra = [["    Points Possible", "", "", "", "", "10"]]
    if rng.random() < 0.3:
        extra.insert(0, ["", "", "", "", "", "Manual Posting"])
    test = [["Student, Test", "99999", "", "c0ffee", "Tue", ""]]
    made.lists.append(table(root, "gradebook.csv", [header, *extra, *rows, *test], rng, made.story))
    if rng.random() < 0.5:
        column = rng.choice(["login", "email", "id"])
        values = {"login": lambda p: p.email, "email": lambda p: p.email, "id": lambda p: p.id}
        times = [[column, "submitted at"]]
        times += [[values[column](p), p.time.isoformat()] for p in people]
        path = table(root, "when.csv", times, rng, made.story)
        made.options += ["--times", str(path)]
        made.times = {p.email: p.time for p in people}


def _versioned(path: str) -> str:
    stem, dot, suffix = path.rpartition(".")
    return f"{stem}-1{dot}{suffix}"


def gradescope(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / "assignment_77_export"
    absent = [p for p in made.people if p not in people]
    if absent and rng.random() < 0.5:  # who did not hand in by themselves did so with another
        made.partners[people[0].email] = [absent[0]]
    said = ["---"]
    for person in people:
        folder = f"submission_{3000 + person.number}"
        for path, data in uploads(person, "last", rng).items():
            put(work / folder / path, data)
        said += [f"{folder}:", "  :submitters:"]
        for member in (person, *made.partners.get(person.email, ())):
            sid = rng.choice([f"'{member.sis}'", member.sis])
            said += [f'  - :name: "{member.name}"', f"    :sid: {sid}"]
            said += [f"    :email: {member.email}"]
        said += [f"  :created_at: {person.time:%Y-%m-%d %H:%M:%S}.000000000 Z"]
        said += ["  :score: 0.0", "  :status: processed", "  :history: []"]
    put(work / "submission_metadata.yml", "\n".join(said).encode())
    made.paths = [work]
    made.times = {p.email: p.time for p in people}
    for email, partners in made.partners.items():
        made.times |= dict.fromkeys((p.email for p in partners), made.times[email])
    header = ["First Name", "Last Name", "SID", "Email", "Role", "Section"]
    rows = [[p.first, p.last, p.sis, p.email, "Student", "A"] for p in made.people]
    rows.append(["Tea", "Cher", "S1", "tea@example.org", "Instructor", ""])
    made.lists.append(table(root, "roster.csv", [header, *rows], rng, made.story))


def blackboard(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / "gradebook_CS101"
    title = rng.choice(["Exercise 3", "Ex_3 (lines)", "Übung 3_attempt"])
    zone = ZoneInfo("Europe/Zurich")
    for person in people:
        attempts = [(person.time, "last")]
        for n in range(rng.choice([0, 0, 1, 2])):
            attempts.insert(0, (person.time - timedelta(hours=20 * (n + 1)), "old"))
        for time, attempt in attempts:
            start = f"{title}_{person.login}_attempt_{time.astimezone(zone):%Y-%m-%d-%H-%M-%S}"
            note = f"Name: {person.name} ({person.login})\r\nAssignment: {title}\r\n"
            note += "Date Submitted: Sunday, 1 November 2026 12:30:05 o'clock CET\r\n"
            put(work / f"{start}.txt", note.encode())
            for path, data in uploads(person, attempt, rng).items():
                put(work / f"{start}_{path}", data)
    made.paths = [work]
    made.times = {p.email: p.time for p in people}
    made.lists.append(plain_list(root, made.people, rng, made.story))


def nbgrader(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / rng.choice(["course101", "nb"])
    for person in people:
        folder = work / "submitted" / person.login / "ex3"
        for path, data in uploads(person, "last", rng).items():
            put(folder / path, data)
        local = person.time.astimezone(ZoneInfo("Europe/Zurich"))
        stamp = rng.choice(
            [
                f"{person.time:%Y-%m-%d %H:%M:%S}.123456 UTC",
                f"{local:%Y-%m-%d %H:%M:%S}.123456 Europe/Zurich",
                f"{local:%Y-%m-%d %H:%M:%S %z}",
                f"{person.time:%Y-%m-%d %H:%M:%S} UTC\n",
            ]
        )
        put(folder / "timestamp.txt", stamp.encode())
    made.paths = [rng.choice([work, work / "submitted"])]
    made.times = {p.email: p.time for p in people}
    made.lists.append(plain_list(root, made.people, rng, made.story))


def github(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    title = rng.choice(["exercise-3", "ransac", "my-long-exercise"])
    work = root / "download" / rng.choice([f"{title}-submissions", "clones"])
    for person in people:
        folder = work / f"{title}-{person.github}"
        folder.mkdir(parents=True)
        git(folder, "init", "-q")
        if rng.random() < 0.2 and person.time < DUE:
            put(folder / "3_orchard.ipynb", book(person, "old"))
            commit(folder, person.time - timedelta(hours=20))
        put(folder / rng.choice(["", "notebooks/"]) / "3_orchard.ipynb", book(person))
        if (folder / "notebooks").exists() and (folder / "3_orchard.ipynb").exists():
            (folder / "3_orchard.ipynb").unlink()
        commit(folder, person.time)
        if rng.random() < 0.2 and person.time < DUE:
            for path in folder.rglob("3_orchard.ipynb"):
                path.write_bytes(book(person, "too late"))
            commit(folder, DUE + timedelta(days=3))
    made.paths = [work]
    made.times = {p.email: p.time for p in people}
    if rng.random() < 0.5:
        header = ["identifier", "github_username", "github_id", "name", "email"]
        rows = [[p.sis, p.github, p.id, p.name, p.email] for p in made.people]
    else:
        header = ["Name", "Email", "GitHub"]
        rows = [[p.name, p.email, p.github] for p in made.people]
    made.lists.append(table(root, "classroom_roster.csv", [header, *rows], rng, made.story))


def plain(root: Path, people: list[Student], rng: random.Random, made: MadeClass) -> None:
    work = root / "download" / rng.choice(["handed in", "class", "abgaben"])
    names = [p.name for p in made.people]
    for person in people:
        called = [person.login, person.email]
        if names.count(person.name) == 1 and not person.name.endswith("."):
            called += [person.name, f"{person.last}, {person.first}".strip(", ")]
        name = rng.choice(called)
        kind = rng.randrange(4)
        if kind == 0:
            for path, data in uploads(person, "last", rng).items():
                put(work / name / path, data)
        elif kind == 1:
            put(work / f"{name}.ipynb", book(person))
        else:
            sent = uploads(person, "last", rng)
            put(work / f"{name}.zip", zipped(sent))
    made.paths = [work]
    made.times = dict.fromkeys((p.email for p in people), None)
    made.lists.append(plain_list(root, made.people, rng, made.story))
    if rng.random() < 0.5:
        rows = [["student", "time"], *([p.login, p.time.isoformat()] for p in people)]
        path = table(work if rng.random() < 0.5 else root, "times.csv", rows, rng, made.story)
        if path.parent == root:
            made.options += ["--times", str(path)]
        else:
            made.story.append("times.csv beside")
        made.times = {p.email: p.time for p in people}


LAYOUTS = {
    maker.__name__: maker
    for maker in (moodle, canvas, gradescope, blackboard, nbgrader, github, plain)
}


# ---------------------------------------------------------------------------------- the packings


def packed(made: MadeClass, rng: random.Random) -> None:
    """The download as it is, one folder higher, as a zip, by the shell's star."""
    (work,) = made.paths
    has_times = (work / "times.csv").exists()
    ways = ["as it is", "higher", "zip", "zip of the folder", "zip in a folder", "star"]
    if has_times:
        ways = ["as it is"]
    if made.layout in ("gradescope", "github") or work.name == "submitted":
        ways.remove("star") if "star" in ways else None
    way = rng.choice(ways)
    made.story.append(f"packed: {way}")
    if way == "higher":
        above = work.parent.parent / "higher"
        above.mkdir()
        shutil.move(work, above / work.name)
        if rng.random() < 0.5:
            ghosts(above)
        made.paths = [above]
    elif way == "star":
        made.paths = sorted(p for p in work.iterdir() if not p.name.startswith("."))
    elif way != "as it is":
        inside = work if way == "zip" else work.parent
        name = (
            work.parent.parent / "zips" / rng.choice(["submissions", "download (3)", "Ex 3-4711"])
        )
        path = Path(shutil.make_archive(str(name), "zip", inside))
        made.paths = [path.parent if way == "zip in a folder" else path]


def make_class(root: Path, layout: str, seed: int) -> MadeClass:
    """A class in a layout, the same for the same seed."""
    rng = random.Random(f"{layout} {seed}")
    people = make_people(rng)
    made = MadeClass([], [], people, layout)
    absent = rng.sample(people, rng.choice([0, 1, 2]))
    present = [person for person in people if person not in absent]
    if rng.random() < 0.3:
        stranger = Student("Guy", "Incognito", 40, "incognito", DUE - timedelta(hours=5))
        present.append(stranger)
        made.strangers = 1
    LAYOUTS[layout](root, present, rng, made)
    if made.strangers:
        made.times.pop(stranger.email)
    names = [p.name for p in people]
    if len({p.email for p in absent} & made.untold):
        # The one who handed in is still not certain: the other has the same name.
        made.untold = {p.email for p in present if names.count(p.name) > 1}
    if rng.random() < 0.7:
        ghosts(made.paths[0])
    policy = "[late]\ndue = 2026-11-20T13:00:00\nzone = 'Europe/Zurich'\npercent_a_day = 10\n"
    if made.strangers:
        made.settled = {key: value for key, value in made.settled.items() if "x40Yz" not in key}
    if made.settled:
        lines = [f'"{key}" = "{value}"' for key, value in made.settled.items()]
        put(root / "students.toml", "\r\n".join(lines).encode("utf-8-sig"))
    made.lists.append(put(root / "policy.toml", policy.encode()))
    packed(made, rng)
    return made
