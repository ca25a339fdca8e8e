"""Bands that differ by more than their hue, and names that keep their direction."""

from __future__ import annotations

import re

from autograder.reports.color_patterns import definitions, fill_of
from autograder.reports.markdown import isolated
from autograder.reports.questions_html import _BANDS
from autograder.reports.svg_charts import Chart, swatch


def test_no_two_bands_have_one_pattern_and_each_pattern_is_defined():
    patterns = [pattern for *_, pattern in _BANDS]
    assert len(set(patterns)) == len(patterns)
    defined = set(re.findall(r'id="(pattern-[a-z]+)"', definitions()))
    assert {f"pattern-{pattern}" for pattern in patterns if pattern} <= defined


def test_a_pattern_lies_over_the_color_of_its_band_and_of_its_key():
    chart = Chart(100, 100, (0, 1), (0, 1))
    chart.box(0, 0, 1, 1, "red", "dots")
    for drawn in (chart.svg("t", "d"), swatch("red", "dots")):
        assert drawn.index('fill="red"') < drawn.index(fill_of("dots"))
    assert "pattern" not in swatch("red")


def test_a_name_is_isolated_and_escaped():
    assert isolated("عمر <b>") == "<bdi>عمر &lt;b&gt;</bdi>"
