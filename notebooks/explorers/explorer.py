"""How an explorer gets onto the screen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from autograder.student.frontend import running_shell, widgets_wanted

_HERE = Path(__file__).parent


class Explorer:
    """A widget made of one ES module, with a sentence for where no widget can be drawn.

    ``module`` names a file beside this one; ``values`` are plain data that it starts from, or a
    function that computes them when a widget is drawn.
    ``still`` shows a picture with the same numbers where there is no widget.
    """

    def __init__(
        self,
        module: str,
        values: dict[str, object] | Callable[[], dict[str, object]],
        sentence: str,
        still: Callable[[], None] | None = None,
    ) -> None:
        self._module = module
        self._values = values
        self._sentence = sentence
        self._still = still

    def __repr__(self) -> str:
        return self._sentence

    def _repr_mimebundle_(
        self, include: object = None, exclude: object = None
    ) -> dict[str, object]:
        bundle: dict[str, object] = {"text/plain": self._sentence}
        if widgets_wanted():
            bundle["application/vnd.jupyter.widget-view+json"] = {
                "version_major": 2,
                "version_minor": 0,
                "model_id": self._widget().model_id,
            }
        elif self._still is not None and running_shell() is not None:
            self._still()
        return bundle

    def _widget(self) -> Any:
        import anywidget
        import traitlets

        module = "\n".join(
            (_HERE / name).read_text(encoding="utf-8") for name in ("plot.js", self._module)
        )

        class ExplorerWidget(anywidget.AnyWidget):
            _esm = module
            _css = (_HERE / "explorer.css").read_text(encoding="utf-8")
            values = traitlets.Dict().tag(sync=True)

        values = self._values() if callable(self._values) else self._values
        return ExplorerWidget(values=values)
