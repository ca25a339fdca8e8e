"""Blackboard, "Assignment file download": files of all attempts of all students in one folder.

``Exercise 3_ada_attempt_2026-11-01-12-30-05_submission.zip``, and for each attempt a
``Exercise 3_ada_attempt_2026-11-01-12-30-05.txt`` that gives the name and the login as well.
"""

from __future__ import annotations

import re

from autograder.intake.download_names import SystemName, blackboard_name
from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import (
    Context,
    Entry,
    Found,
    fit_most,
    local_time,
    pieces_of,
    side_entry,
)
from autograder.intake.names_in_sentences import shown
from autograder.intake.notebook_reader import Unreadable
from autograder.intake.origin import LAYOUT, Claim, Origin

_NAME = re.compile(r"^\s*Name:\s*(?P<name>.*?)\s*(?:\((?P<login>[^()]*)\))?\s*$", re.MULTILINE)


class Blackboard:
    """Files whose names hold ``_attempt_`` and a time."""

    name = "blackboard"
    rule = "Blackboard's download: one student for each login, the newest attempt that has files"

    def recognises(self, folder: Place) -> bool:
        return fit_most([p for p in folder.children() if blackboard_name(p.name)], folder)

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        files: dict[tuple[str, str], list[Place]] = {}
        told_in: dict[tuple[str, str], Place] = {}
        claims: dict[str, Claim] = {}
        prefixes: dict[str, str] = {}
        for place in folder.children():
            name = blackboard_name(place.name)
            if name is None:
                side_entry(place, found, place.name.lower().endswith(".csv"))
                continue
            prefix = name.prefix
            of_attempt = files.setdefault((prefix, name.attempt), [])
            prefixes[prefix] = name.claim.login
            claims.setdefault(prefix, name.claim)
            if name.rest:
                of_attempt.append(place)
                continue
            told_in[prefix, name.attempt] = place
            told = _told(place, name)
            if told is not None:
                claims[prefix] = told
            found.pass_over(place, "Blackboard's own note on an attempt; it was read", False)
        for prefix in prefixes:
            attempts = sorted(attempt for of, attempt in files if of == prefix)
            with_files = [attempt for attempt in attempts if files[prefix, attempt]]
            chosen = (with_files or attempts)[-1]
            notes = []
            for attempt in attempts:
                if attempt != chosen:
                    for place in files[prefix, attempt]:
                        found.pass_over(place, f"an attempt before that of {chosen}", False)
            if chosen != attempts[-1]:
                notes.append(f"The attempt of {attempts[-1]} has no files; an earlier one counts.")
            number = attempts.index(chosen) + 1
            time = local_time(chosen, "%Y-%m-%d-%H-%M-%S", context)
            origin = Origin(
                self.name,
                prefix,
                (claims[prefix],),
                f"{number} of {len(attempts)}",
                time,
                LAYOUT if time else "",
                pieces=pieces_of(files[prefix, chosen] or [told_in[prefix, chosen]]),
            )
            key = claims[prefix].login or claims[prefix].name
            found.entries.append(Entry(key, origin, shown(prefix), tuple(notes)))
        return found


def _told(place: Place, name: SystemName) -> Claim | None:
    """Who the attempt's note says it is: the first lines are Blackboard's, the rest a student's."""
    try:
        text = place.read(4096).decode("utf-8-sig", "replace")
    except (Unreadable, OSError):
        return None
    found = _NAME.match(text)
    if found is None:
        return None
    login = (found["login"] or "").strip()
    # An assignment's or a login's name may hold "_": the file's name then does not tell them apart.
    if login and not f"_{name.prefix}".casefold().endswith(f"_{login}".casefold()):
        return None
    return Claim(name=found["name"], login=login or name.claim.login)
