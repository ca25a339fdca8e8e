"""Moodle, "Download all submissions": a folder for each student, or files with that prefix.

``First Last_12345_assignsubmission_file_/`` holds what the student uploaded, as it was uploaded;
``..._assignsubmission_onlinetext_/`` what was typed into the page. The number is the participant's
in this one assignment and stands in the offline grading worksheet. Entries of the zip carry the
time of the download. (mod/assign/classes/downloader.php of moodle/moodle)
"""

from __future__ import annotations

from autograder.intake.download_names import SystemName, moodle_name
from autograder.intake.file_or_zip import Place
from autograder.intake.layouts.layout import Context, Entry, Found, fit_most, pieces_of, side_entry
from autograder.intake.name_spellings import is_anonymous
from autograder.intake.origin import Origin


class Moodle:
    """Folders or files whose names hold ``_assignsubmission_``."""

    name = "moodle"
    rule = "Moodle's download: one student for each name and number before _assignsubmission_"

    def recognises(self, folder: Place) -> bool:
        return fit_most([p for p in folder.children() if moodle_name(p.name)], folder)

    def read(self, folder: Place, context: Context) -> Found:
        found = Found(self.name, self.rule)
        files: dict[str, list[Place]] = {}
        texts: dict[str, list[Place]] = {}
        names: dict[str, SystemName] = {}
        for place in folder.children():
            name = moodle_name(place.name)
            if name is None:
                side_entry(place, found, place.name.lower().endswith(".csv"))
                continue
            names.setdefault(name.prefix, name)
            (files if name.plugin == "file" else texts).setdefault(name.prefix, []).append(place)
        for prefix, name in names.items():
            places = files.get(prefix, [])
            for place in texts.get(prefix, []):
                if places:
                    found.pass_over(place, "typed into Moodle's page, not a file handed in")
            claim = name.claim
            anonymous = is_anonymous(claim.name)
            key = prefix.replace("_", " ") if anonymous else claim.name
            origin = Origin(
                self.name,
                f"{prefix}_assignsubmission_file",
                (claim,),
                pieces=pieces_of(places or texts[prefix]),
            )
            found.entries.append(Entry(key, origin, claim.number))
        return found
