"""Points as a student reads them: ``1 of 2 points``."""

from __future__ import annotations

from autograder.language import n_


def number(value: float) -> str:
    """Points without needless zeros."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def points_of(earned: float, most: float) -> str:
    """``1 of 1 point``, ``1 of 2 points``."""
    sentence = n_("{earned} of {most} point", "{earned} of {most} points", most)
    return sentence.format(earned=number(earned), most=number(most))


def in_points(count: float) -> str:
    """``1 point``, ``2 points``."""
    return n_("{count} point", "{count} points", count).format(count=number(count))
