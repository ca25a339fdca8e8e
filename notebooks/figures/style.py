"""How every picture of the course looks, and how it reaches the notebook."""

import base64
import html
import io
import os
from collections.abc import Callable
from typing import Any

import numpy as np
from IPython.display import display
from matplotlib.axes import Axes
from matplotlib.figure import Figure

# What a student writes: its results are looked at before they are drawn.
StudentFunction = Callable[..., Any]

# Okabe and Ito's palette: told apart by every kind of colour vision. Where two colours carry a
# meaning, the markers differ as well.
BLUE = "#0072B2"
VERMILLION = "#D55E00"
GREEN = "#009E73"
ORANGE = "#E69F00"
SKY = "#56B4E9"
PURPLE = "#CC79A7"
GRAY = "#707070"
LIGHT = "#D8D8D8"
PREDICTED = "#8A3C6B"
PALETTE = [BLUE, ORANGE, GREEN, VERMILLION, PURPLE, SKY, "#000000", "#B8A000"]

PIXELS_PER_INCH = 144  # stored; shown at half of the usual width, so that it is sharp
SHOWN_PER_INCH = 96
READABLE = 560  # pixels on the screen, of a picture as wide as the notebook


def figure(width: float = 8.0, height: float = 4.0) -> Figure:
    """Return an empty figure, in inches; 8 inches is the width of a notebook."""
    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def show(fig: Figure, alt: str) -> None:
    """Show the figure in the notebook, with `alt` as its text for those who cannot see it.

    JupyterLab gives no text to a picture that is an output of its own, so the picture goes into
    HTML. Where nobody looks (tests, building, grading) it stays a picture, which is not compared.
    """
    buffer = io.BytesIO()
    fig.savefig(buffer, format="png", dpi=PIXELS_PER_INCH)
    picture = base64.b64encode(buffer.getvalue()).decode()
    width = round(fig.get_size_inches()[0] * SHOWN_PER_INCH)
    if os.environ.get("AUTOGRADER_WIDGETS") == "0":
        shape = {"image/png": {"alt": alt, "width": width}}
        display({"image/png": picture}, raw=True, metadata=shape)
        return
    text = html.escape(alt, quote=True)
    source = f"data:image/png;base64,{picture}"
    # On a narrow screen the picture is scrolled sideways before its words become too small to read.
    least = min(width, READABLE)
    style = f"max-width: 100%; min-width: {least}px"
    image = f'<img alt="{text}" width="{width}" style="{style}" src="{source}">'
    image = f'<div style="overflow-x: auto">{image}</div>'
    display({"text/html": image, "text/plain": alt}, raw=True)


def quiet(axes: Axes) -> None:
    """Take away the box around the axes, which says nothing."""
    axes.spines[["top", "right"]].set_visible(False)


def plan(axes: Axes, title: str = "", unit: str = "m") -> None:
    """Make the axes a map: both directions have the same scale and a unit."""
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel(f"x [{unit}]")
    axes.set_ylabel(f"y [{unit}]")
    axes.set_title(title)
    axes.grid(color=LIGHT, linewidth=0.5)
    axes.set_axisbelow(True)
    quiet(axes)


def photograph(axes: Axes, image: np.ndarray, title: str = "", size: float = 10.0) -> None:
    """Show an image without axes; grey images are shown in grey."""
    axes.imshow(image, cmap="gray" if image.ndim == 2 else None)
    axes.set_title(title, fontsize=size)
    axes.set_xticks([])
    axes.set_yticks([])


def note(axes: Axes, text: str) -> None:
    """Write a remark across the axes, for what cannot be drawn yet."""
    axes.text(
        0.5,
        0.5,
        text,
        transform=axes.transAxes,
        ha="center",
        va="center",
        fontsize=11,
        bbox={"boxstyle": "round", "facecolor": "#FFF6D6", "edgecolor": ORANGE},
        zorder=10,
    )


def predicted_beside(fig: Figure, predicted: object, unit: str = "", truth: str = "") -> str:
    """Write what was predicted above the picture, and what is true if that can be said so briefly.

    The same words come back, for the text of the picture.
    """
    if predicted is None:
        said = "Not predicted."
    else:
        value = predicted if isinstance(predicted, str) else f"{predicted:,.6g}"
        said = f"You predicted: {value}{unit}."
    said = f"{said} {truth}".strip()
    fig.suptitle(
        said, x=0.01, ha="left", fontsize=10, color=GRAY if predicted is None else PREDICTED
    )
    return said


def attempt(function: StudentFunction, *args: Any) -> Any:
    """Return what a student's function returns, or None while it is not written.

    Any other exception passes through: its traceback helps.
    """
    try:
        return function(*args)
    except NotImplementedError:
        return None


def not_written(function: StudentFunction) -> str:
    """Return the remark for a function that is still a stub."""
    return f"{function.__name__} is not written yet.\nWrite it above and run this cell again."


def draw_line(axes: Axes, r: float, alpha: float, reach: float = 100.0, **style: Any) -> None:
    """Draw the line x cos(alpha) + y sin(alpha) = r across the axes, which keep their limits."""
    limits = axes.get_xlim(), axes.get_ylim()
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    along = np.array([-normal[1], normal[0]])
    ends = r * normal + np.outer([-reach, reach], along)
    axes.plot(*ends.T, **style)
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])
