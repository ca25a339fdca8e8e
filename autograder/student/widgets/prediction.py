"""A prediction: one click or one number, kept before the picture shows."""

from __future__ import annotations

from autograder.course.predictions import Prediction
from autograder.exchange.messages import Message
from autograder.language import _
from autograder.questions.typed_characters import bare
from autograder.questions.typed_digits import without_percent
from autograder.questions.typed_number import read_number
from autograder.reports.markdown import inline, markdown
from autograder.student.desk import Desk
from autograder.student.widgets.base import CourseWidget, receipt_output, source


class PredictionWidget(CourseWidget):
    """Something to predict, on show; once it is kept, it stands."""

    _esm = source("common.js", "kernel_line.js", "prediction.js")
    _css = source("common.css", "value.css", "prediction.css")

    def __init__(self, desk: Desk, prediction: Prediction) -> None:
        self.prediction = prediction
        self.topic = prediction.id
        super().__init__(desk)

    def what_is_fixed(self) -> dict[str, object]:
        prediction = self.prediction
        return {
            "label": f"{prediction.id} · {_('Predict')}",
            "prompt": markdown(prediction.prompt),
            "choices": [inline(choice) for choice in prediction.choices],
            "unit": prediction.unit,
        }

    def what_is_kept(self) -> dict[str, object]:
        value = self.desk.prediction(self.prediction)
        return {"said": "" if value is None else inline(self.prediction.in_words(value))}

    def receipt(self) -> dict[str, object] | None:
        value = self.desk.prediction(self.prediction)
        sentence = _("nothing yet.") if value is None else self.prediction.in_words(value)
        words = _("Predicted for {prediction}: {said}").format(
            prediction=self.prediction.id, said=sentence
        )
        return receipt_output(words, self.prediction.id, value)

    def do_choose(self, message: Message) -> dict[str, object]:
        """Keep a choice, by its number from 0."""
        self.desk.predict(self.prediction, self.prediction.choices[int(message["choice"])])
        return {}

    def do_type(self, message: Message) -> dict[str, object]:
        """Keep a number that was typed."""
        self.desk.predict(self.prediction, _number(str(message["text"])))
        return {}


def _number(text: str) -> int | float:
    """What a typed number means; arithmetic such as ``1/3`` will do.

    A percent sign says what the unit says already, and is passed over.

    Raises:
        UsageError: if it is none.
    """

    return read_number(without_percent(bare(text)), {})
