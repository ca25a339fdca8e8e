import time

import pytest

from benchmarks import peers
from benchmarks.report import OURS, Row, Section, markdown_section, markdown_table, write_report
from benchmarks.timing import measure


def test_a_table_shows_each_task_once_and_extra_columns_in_order():
    rows = [
        Row("RANSAC", "line", OURS, 1.5e-4, 1.0, {"success": "96%"}),
        Row("RANSAC", "line", "peer", 6e-3, 40.0, {"mAP": 0.12345}),
    ]
    assert markdown_table(rows).splitlines() == [
        "| task | contender | time | ratio | success | mAP |",
        "| --- | --- | --- | --- | --- | --- |",
        "| line | this project | 150 µs | 1 × | 96% |  |",
        "|  | peer | 6 ms | 40 × |  | 0.123 |",
    ]


def test_a_table_of_qualities_has_no_empty_time_columns():
    table = markdown_table([Row("retrieval", "mAP", "peer", extra={"mAP": 0.5})])
    assert "time" not in table


def test_a_report_names_what_is_missing(tmp_path):
    section = Section("A", "How.", [Row("g", "t", OURS, 1.0, 1.0)], missing=["x is missing here."])
    write_report([section], "Intro.", tmp_path / "results.md")
    text = (tmp_path / "results.md").read_text()
    assert text.startswith("# Benchmark results\n\nIntro.\n\n## A\n\nHow.")
    assert "- x is missing here." in text
    assert markdown_section(section) in text


def test_ratios_are_to_this_project_and_times_for_one_item():
    def busy(seconds: float) -> None:
        end = time.process_time() + seconds
        while time.process_time() < end:
            pass

    contenders = {OURS: lambda: busy(0.01), "slow": lambda: busy(0.03)}
    ours, slow = measure("g", "t", contenders, 3, {"slow": {"n": 1.0}}, {OURS: 10, "slow": 10})
    assert ours.seconds == pytest.approx(1e-3, rel=0.3)
    assert ours.ratio == 1.0
    assert slow.ratio == pytest.approx(3.0, rel=0.3)
    assert slow.extra == {"n": 1.0}


def test_without_this_project_there_is_no_ratio():
    (row,) = measure("g", "t", {"peer": lambda: None}, 1)
    assert row.ratio is None


def test_a_missing_peer_is_one_sentence():
    missing: list[str] = []
    assert peers.load("no_such_peer", missing) is None
    (sentence,) = missing
    assert sentence.startswith("no_such_peer is missing here")
    assert "\n" not in sentence
