"""The notebook's line to the process that marks."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading

from autograder.course import Course, load_course
from autograder.errors import AutograderError, CourseError
from autograder.exchange import wire
from autograder.exchange.identity import VARIANTS
from autograder.exchange.messages import Message
from autograder.language import _
from autograder.marking.snapshots import SNAPSHOTS, SnapshotMarker
from autograder.questions.mark import Mark

_client: MarkerClient | None = None
_bundle: BundleMarker | None = None


def marker_for(course: Course) -> MarkerClient | BundleMarker | None:
    """The marker of this kernel, started at the first call.

    Where there is no key, a student bundle's snapshots mark what they can; None without those too.
    """
    global _client
    if not course.has_key:
        return bundle_marker(course)
    if _client is None or _client.course is not course or not _client.alive:
        _client = MarkerClient(course)
    return _client


def bundle_marker(course: Course) -> BundleMarker | None:
    """What a student bundle marks with; None if it has no snapshots."""
    global _bundle
    if not (course.root / SNAPSHOTS).is_dir():
        return None
    if _bundle is None or _bundle.course is not course:
        practice = course.root / "practice"
        key = load_course(practice).with_variants(course.variants) if practice.is_dir() else None
        _bundle = BundleMarker(course, key)
    return _bundle


def key_marker(course: Course, id: str) -> MarkerClient | None:
    """What marks a question here with its key; None where only others have that."""
    marker = marker_for(course)
    if isinstance(marker, BundleMarker):
        return marker.key_marker(id)
    return marker


class BundleMarker:
    """Marks the chapters that are for practice with their key, the others with snapshots."""

    def __init__(self, course: Course, practice: Course | None) -> None:
        self.course = course
        self._snapshots = SnapshotMarker(course)
        self._practice = practice
        self._client: MarkerClient | None = None

    def can_mark(self, id: str) -> bool:
        """Whether a response to a question can be marked, or only recorded."""
        return self._is_practice(id) or self._snapshots.can_mark(id)

    def probe(self, id: str) -> Message:
        """What the kernel has to evaluate for a question."""
        return self._for(id).probe(id)

    def mark(self, id: str, response: object, understood: str = "") -> Mark:
        """The mark of what came out."""
        return self._for(id).mark(id, response, understood)

    def _for(self, id: str) -> MarkerClient | SnapshotMarker:
        return self.key_marker(id) or self._snapshots

    def key_marker(self, id: str) -> MarkerClient | None:
        """What marks a question with its key, if that is handed out for practice."""
        if self._practice is None or not self._is_practice(id):
            return None
        if self._client is None or not self._client.alive:
            self._client = MarkerClient(self._practice)
        return self._client

    def _is_practice(self, id: str) -> bool:
        return self._practice is not None and id in self._practice.questions


class MarkerClient:
    """Asks a process of its own for probes and marks."""

    def __init__(self, course: Course) -> None:
        self.course = course
        self._lock = threading.Lock()
        environment = {
            **os.environ,
            "AUTOGRADER_COURSE": str(course.root),
            VARIANTS: json.dumps(dict(course.variants)),
        }
        self._process = subprocess.Popen(
            [sys.executable, "-m", "autograder.marking.marker_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=course.root,
            env=environment,
            # Interrupting the kernel must not end the marker.
            start_new_session=True,
        )

    @property
    def alive(self) -> bool:
        """Whether the process still runs."""
        return self._process.poll() is None

    def can_mark(self, id: str) -> bool:
        """Whether a response to a question can be marked, or only recorded."""
        return True

    def probe(self, id: str, variant: int | None = None) -> Message:
        """What the kernel has to evaluate for a question, or for one of its variants."""
        probe: Message = self._ask({"do": "probe", "question": id, "variant": variant})["probe"]
        return probe

    def mark(
        self, id: str, response: object, understood: str = "", variant: int | None = None
    ) -> Mark:
        """The mark of what came out."""
        said = {"response": response, "understood": understood, "variant": variant}
        reply = self._ask({"do": "mark", "question": id, **said})
        return Mark.from_dict(reply["mark"])

    def reading(self, id: str, seed: int) -> Message:
        """Functions to read, as `autograder.questions.functions_to_read.Reading.shown` has them."""
        shown: Message = self._ask({"do": "reading", "question": id, "seed": seed})["shown"]
        return shown

    def mark_reading(self, id: str, seed: int, chosen: int, returned: int) -> Message:
        """What is said of the answers to them, as `questions.reading.Reading.mark` does."""
        said = {"chosen": chosen, "returned": returned}
        message = {"do": "mark_reading", "question": id, "seed": seed, **said}
        verdict: Message = self._ask(message)["verdict"]
        return verdict

    def _ask(self, message: Message) -> Message:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None

        with self._lock:
            try:
                stdin.write(wire.encode(message))
                stdin.flush()
                reply = wire.read_stream(stdout)
            except (EOFError, OSError, wire.WireError):
                self._end()
                raise AutograderError(
                    _(
                        "Marking stopped unexpectedly; run the cell again. If that does not help, "
                        "run `autograder check` in the course's folder."
                    )
                ) from None
            except BaseException:
                # An interrupt in the middle of a message: the next one would read its rest.
                self._end()
                raise
        if "error" in reply:
            raise CourseError(reply["error"])
        return dict(reply)

    def _end(self) -> None:
        """Kill the process and wait for it, so that `alive` says so at once."""
        self._process.kill()
        self._process.wait()


class VariantMarker:
    """Marks one variant of a question, whatever numbers the student has."""

    def __init__(self, client: MarkerClient, variant: int) -> None:
        self._client, self._variant = client, variant

    def can_mark(self, id: str) -> bool:
        """Whether a response to a question can be marked, or only recorded."""
        return True

    def probe(self, id: str) -> Message:
        """What the kernel has to evaluate for the question."""
        return self._client.probe(id, self._variant)

    def mark(self, id: str, response: object, understood: str = "") -> Mark:
        """The mark of what came out."""
        return self._client.mark(id, response, understood, self._variant)
