"""Makes the film of a chapter and of grading: ``uv run python tests/browser/film.py``.

A student draws samples in the third chapter and types a number that one inlier would need; then an
instructor grades the sample class. Each picture stands for as long as there is something to read.
"""

from __future__ import annotations

import html
import io
import shutil
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Iterator
from pathlib import Path

from lab import ROOT, Notebook, Server
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect, sync_playwright

FILM = ROOT / "docs/film.gif"
SIZE = {"width": 900, "height": 620}
COLORS = 128
COMMAND = "autograder grade solutions/sample_class"
STEPS = "Explorer: RANSAC, one sample after the other"

Frame = tuple[Image.Image, int]  # a picture, and for how many milliseconds it stands


def main() -> None:
    """Act, take the pictures and put them together."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        server = Server(Path(folder))
        try:
            frames = [*chapter(browser, server), *grading(browser, Path(folder))]
        finally:
            server.stop()
            browser.close()
    first, *others = (image for image, _ in frames)
    first.save(
        FILM,
        save_all=True,
        append_images=others,
        duration=[stands for _, stands in frames],
        loop=0,
        optimize=True,
        disposal=1,
    )
    print(f"{FILM.relative_to(ROOT)}: {len(frames)} pictures, {FILM.stat().st_size / 1e6:.2f} MB")


def chapter(browser: Browser, server: Server) -> Iterator[Frame]:
    """Samples in the explorer, and a number that has the name of its mistake."""
    page = browser.new_page(viewport=SIZE)
    page.emulate_media(reduced_motion="reduce")
    sheet = Notebook(page, server, "3_ransac.ipynb").open()
    for command in ("application:toggle-left-area", "application:toggle-mode"):
        sheet.command(command)
    # Without the number of samples that the question before it asks for.
    explorer = sheet.index_of("explore_ransac_steps(")
    sheet.write(explorer, "explore_ransac_steps(points, 40)")
    sheet.run_all()
    page.evaluate(
        """() => {
        const panel = window.jupyterapp.shell.currentWidget;
        panel.content.scrollToItem(EXPLORER, 'start');
    }""".replace("EXPLORER", str(explorer))
    )
    steps = page.get_by_role("group", name=STEPS)
    into_view(page, steps)
    yield picture(page, 1800)
    for _ in range(6):
        steps.get_by_role("button", name="Draw a sample").click()
        yield picture(page, 700)
    steps.get_by_role("button", name="Run:").click()
    yield picture(page, 2200)
    steps.get_by_role("button", name="100 runs").click()
    page.wait_for_timeout(300)
    yield picture(page, 2500)
    question = sheet.question("Q3.2.1")
    into_view(page, question)
    yield picture(page, 1800)
    field = question.get_by_role("textbox")
    for so_far in ("1", "14"):
        field.fill(so_far)
        into_view(page, field, "center")
        yield picture(page, 500)
    field.press("Enter")
    expect(question.locator(".ag-verdict")).to_be_visible()
    into_view(page, question.locator(".ag-verdict"), "center")
    yield picture(page, 4500)
    page.close()


def grading(browser: Browser, folder: Path) -> Iterator[Frame]:
    """The sample class in a terminal, and the page that comes of it."""
    page = browser.new_page(viewport=SIZE)
    for letters in range(0, len(COMMAND) + 1, 6):
        yield terminal(page, f"$ {COMMAND[:letters]}▌", 120)
    done = subprocess.run(
        [sys.executable, "-m", *COMMAND.split(), "--out", str(folder / "graded")],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    said = textwrap.fill(done.stdout.replace(f"{folder}/", ""), 96)
    yield terminal(page, f"$ {COMMAND}\n{said}\n$ ▌", 4000)
    page.goto((folder / "graded/class.html").as_uri())
    yield picture(page, 4000)
    page.mouse.wheel(0, 560)
    page.wait_for_timeout(300)
    yield picture(page, 5000)
    page.close()


def into_view(page: Page, element: Locator, block: str = "start") -> None:
    """Scroll so that a widget stands at the top, or elsewhere."""
    element.evaluate("(node, block) => node.scrollIntoView({block})", block)
    page.wait_for_timeout(400)


def terminal(page: Page, text: str, stands: int) -> Frame:
    """A terminal with a text."""
    shown = html.escape(text)
    page.set_content(
        "<body style='margin:0;background:#10151c'><pre style='margin:18px;color:#dce6f0;"
        f"font:14px/1.5 monospace'>{shown}</pre></body>"
    )
    return picture(page, stands)


def picture(page: Page, stands: int) -> Frame:
    """What the page shows now, in few colours."""
    image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    return image.quantize(COLORS, dither=Image.Dither.NONE), stands


if __name__ == "__main__":
    main()
