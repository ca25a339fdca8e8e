"""Takes the pictures in ``docs/``: ``uv run python tests/browser/screenshots.py``."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

import numpy as np
from lab import ROOT, Notebook, Server
from playwright.sync_api import Locator, Page, expect, sync_playwright

DOCS = ROOT / "docs"
CELLS = (
    "from autograder import ask, check, predict, progress, submit\n"
    "from notebooks.explorers import explore_polar_line, explore_ransac",
    'ask("Q0.1")',
    'ask("Q1.2")',
    "iterations = ...",
    'check("Q3.2.1", iterations)',
    "outlier_model = ...",
    'check("Q3.2.3a", outlier_model)',
    "progress()",
    "submit()",
    "explore_ransac()",
    "explore_polar_line({points})",
    'predict("P1.1")',
)


# A question of the pictures' own: pictures of the course's would tell its answers.
QUESTION = """
title = "The garden"

[[question]]
id = "Q0.1"
kind = "true_false"
title = "Plants"
prompt = "Four claims about a garden with beds of the area $a = w l$."
statements = [
    "A fern has flowers.",
    "An oak has acorns.",
    "A bed of width $w = 2$ and length $l = 3$ has the area $a = 6$.",
    "Moss grows only on the north side of a tree.",
]
hints = ["Look under the leaf of a fern: what do you see there?"]
"""
ANSWER = """
["Q0.1"]
explanation = "Ferns have spores."
[["Q0.1".statement]]
truth = false
explanation = "Ferns are older than flowers."
misconception = "You may be thinking of a flower bed. Look for seeds on the fern."
[["Q0.1".statement]]
truth = true
explanation = "That is where oaks come from."
misconception = "Shake one."
[["Q0.1".statement]]
truth = true
explanation = "Two times three."
misconception = "Multiply width and length."
[["Q0.1".statement]]
truth = false
explanation = "It grows where it is damp."
misconception = "Walk round a few trees in a damp wood and look at all sides."
"""


def main() -> None:
    """Answer a few questions and take their pictures in light, dark and narrow."""
    DOCS.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = Server(Path(folder))
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        try:
            page = browser.new_page(viewport={"width": 1100, "height": 1400})
            take_all(page, server)
        finally:
            browser.close()
            server.stop()


def take_all(page: Page, server: Server) -> None:
    """Every picture, from one notebook."""
    rng = np.random.default_rng(3)
    along = rng.uniform(-2, 3, 25)
    wall = np.column_stack([3 - 0.5 * along, 1 + along]) + rng.normal(0, 0.08, (25, 2))
    (server.course / "notebooks/questions/garden.toml").write_text(QUESTION)
    (server.course / "solutions/answers/garden.toml").write_text(ANSWER)
    notebook = write_notebook(server, wall.round(2).tolist())
    sheet = Notebook(page, server, notebook.name).open()
    sheet.command("application:toggle-left-area")
    sheet.run_all()
    statements, cards = sheet.question("Q0.1"), sheet.question("Q1.2")
    for at in (0, 2, 4, 6):
        statements.get_by_role("radio").nth(at).click()
    statements.get_by_role("button", name="Check").click()
    statements.get_by_role("button", name="Hint 1").click()
    expect(statements.locator(".ag-hints li")).to_have_count(1)
    sheet.question("Q3.2.1").get_by_role("textbox").fill("2 * w * N")
    formula = sheet.question("Q3.2.3a")
    formula.get_by_role("textbox").fill("(1 - w)**2 / sqrt(2)")
    formula.get_by_role("textbox").press("Enter")
    expect(formula.locator(".ag-verdict")).to_be_visible()
    ransac = page.get_by_role("group", name="Explorer: how many iterations RANSAC needs")
    ransac.get_by_role("button", name="Simulate").click()
    line = page.get_by_role("group", name="Explorer: a line in polar form and its cost")
    # Last, because a card is put down when it loses the focus.
    cards.locator(".ag-grip").nth(0).focus()
    for key in ("Space", "ArrowDown", "ArrowDown"):
        page.keyboard.press(key)
    expect(cards.locator(".ag-status")).to_have_text("Kept.")
    panel = page.get_by_role("group", name="Submission")
    progress = page.get_by_role("group", name="Progress")
    # The folder of the picture's own course says nothing to a reader.
    panel.locator(".ag-path").evaluate(
        "path => { path.textContent = '/home/ada/course/notebooks/submission.zip' }"
    )

    for theme, name in (("JupyterLab Light", "light"), ("JupyterLab Dark", "dark")):
        page.evaluate(
            "theme => { window.jupyterapp.commands.execute('apputils:change-theme', {theme}) }",
            theme,
        )
        page.wait_for_function(
            f"document.body.dataset.jpThemeLight === '{str(name == 'light').lower()}'"
        )
        page.wait_for_timeout(800)
        take(statements, f"statements-{name}")
        take(cards, f"cards-{name}")
        take(line, f"explorer-line-{name}")
        if name == "light":
            take(formula, "formula")
            take(ransac, "explorer-ransac")
            take(progress, "progress")
            take(sheet.question("P1.1"), "prediction")
            take(panel, "submission")
    page.evaluate(
        "() => { window.jupyterapp.commands.execute('apputils:change-theme',"
        " {theme: 'JupyterLab Light'}) }"
    )
    page.set_viewport_size({"width": 460, "height": 2000})
    page.wait_for_timeout(800)
    for picture, name in ((statements, "statements"), (cards, "cards"), (line, "explorer-line")):
        take(picture, f"{name}-narrow")


def write_notebook(server: Server, points: list[list[float]]) -> Path:
    """A notebook with one of each."""
    import nbformat
    from nbformat.v4 import new_code_cell, new_notebook

    cells = [
        new_code_cell(source.replace("{points}", str(points)), id=f"cell-{n}")
        for n, source in enumerate(CELLS)
    ]
    path = server.course / "notebooks/9_pictures.ipynb"
    notebook = new_notebook(cells=cells)
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "name": "python3"}
    nbformat.write(notebook, path)
    return path


def take(element: Locator, name: str) -> None:
    """A picture of one widget."""
    element.scroll_into_view_if_needed()
    element.screenshot(path=DOCS / f"{name}.png")


if __name__ == "__main__":
    main()
