"""Pictures of a response beside the right one, on an input that students may see.

An answer names the function that describes the picture, such as
``picture = "solutions.pictures:fitted_line"``. It takes ``(case, expected, actual)`` and returns
None, or a dictionary: ``title``, ``alt`` (in words), ``x_label``, ``y_label``, and ``layers``, a
list of ``{"kind": "points" or "line" or "expected", "xy": (n, 2) array, "label": text}``. The axes
have equal scales.
"""

from __future__ import annotations

import numpy as np

from autograder.course import Course
from autograder.course.loading import load_object, place_of
from autograder.exchange.messages import Message
from autograder.marking import Mark
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of
from autograder.reports.markdown import text
from autograder.reports.svg_charts import BLUE, DARK, GREEN, RED, Chart, swatch

_SIZE = 380.0
_LOOKS = {"points": DARK, "expected": GREEN, "line": RED, "other": BLUE}


class Pictures:
    """Draws the pictures of a course's answers; the same seed draws the same inputs again.

    Raises:
        CourseError: if an answer names a picture that cannot be loaded.
    """

    def __init__(self, course: Course) -> None:
        self._course = course
        self._describe = {
            id: load_object(name, course.root)
            for id, answer in course.key.items()
            if (name := kind_of(course.question(id)).picture(answer))
        }
        self._markers: dict[int, Marker] = {}

    def html(self, question: str, mark: Mark, seed: int, whose: str = "") -> str:
        """The picture of a marked response, or nothing where there is none to show.

        ``whose`` is who the work says it is from, where each student has their own inputs.
        """
        describe = self._describe.get(question)
        if describe is None or mark.shown is None:
            return ""
        marker = self._markers.setdefault(seed, Marker(self._course, seed))
        drawn = marker.for_student(whose).drawn(question)
        example = kind_of(self._course.question(question)).example(drawn)
        if example is None:
            return ""
        try:
            described = describe(*example, mark.shown)
        except Exception:
            # What a student's function returned may be anything: then there is nothing to draw.
            return ""
        return draw(described) if described else ""

    def problem(self, question: str, seed: int) -> str:
        """Why the right response has no picture, which nobody meant; empty if it has one.

        A response may be anything and then has none, without a word: only here is it told.
        """
        describe = self._describe.get(question)
        if describe is None:
            return ""
        marker = self._markers.setdefault(seed, Marker(self._course, seed))
        example = kind_of(self._course.question(question)).example(marker.drawn(question))
        if example is None:
            return (
                "its picture is never drawn: it shows the first case, which must be public and "
                "have a value; put such a one first"
            )
        try:
            described = describe(*example, example[1])
            if described:
                draw(described)
        except Exception as error:  # the author's own code may raise anything
            return (
                f"its picture, called with (case, expected, actual), raises "
                f"{type(error).__name__} for the right result: {error}"
                f"{place_of(describe, self._course.root)}; correct it"
            )
        return ""


def draw(described: Message) -> str:
    """A figure with its key, from the description of a picture."""
    layers = [
        (layer["kind"], np.asarray(layer["xy"], dtype=float).reshape(-1, 2), str(layer["label"]))
        for layer in described["layers"]
    ]
    everything = np.vstack([xy for _, xy, _ in layers])
    if not np.isfinite(everything).all() or np.abs(everything).max() > 1e9:
        return ""
    low, high = everything.min(axis=0), everything.max(axis=0)
    reach = max(float((high - low).max()), 1e-6) * 1.12
    center = (low + high) / 2
    x_range, y_range = ((float(c) - reach / 2, float(c) + reach / 2) for c in center)
    chart = Chart(_SIZE, _SIZE - 22, x_range, y_range, left=54, right=10, top=10, bottom=44)
    # Equal scales: the inner area is square.
    chart.height = _SIZE - 54 - 10 + 10 + 44
    chart.axes(str(described["x_label"]), str(described["y_label"]))
    key = []
    for kind, xy, label in layers:
        color = _LOOKS.get(kind, BLUE)
        if kind == "points":
            for x, y in xy:
                chart.dot(float(x), float(y), color)
        else:
            dash = "7 5" if kind == "expected" else ""
            chart.line([(float(x), float(y)) for x, y in xy], color, 3, dash)
        key.append(f"<li>{swatch(color)}{text(label)}</li>")
    picture = chart.svg(str(described["title"]), str(described["alt"]))
    return f'<figure>{picture}<figcaption><ul class="key">{"".join(key)}</ul></figcaption></figure>'
