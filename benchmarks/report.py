"""What a benchmark module returns, and how it becomes a table.

A module of this package has one function, `run() -> Section`. It times its
contenders with `benchmarks.timing.measure`, which makes the rows, and adds curves
where a size grows. `benchmarks/__main__.py` runs the modules and calls `write_report`.
"""

from dataclasses import dataclass, field
from pathlib import Path

OURS = "this project"


@dataclass(frozen=True)
class Row:
    """One contender at one task.

    `seconds` is the median time of one call, None where only quality is compared.
    `ratio` is `seconds` divided by this project's seconds at the same task: 35 reads
    "takes 35 times as long as this project". `extra` holds further columns, such as
    {"mAP": 0.66}; a number is shown with three significant digits.
    """

    group: str
    task: str
    contender: str
    seconds: float | None = None
    ratio: float | None = None
    extra: dict[str, float | str] = field(default_factory=dict)


@dataclass(frozen=True)
class Curve:
    """How one contender grows; curves with the same `panel` share one small plot (log-log)."""

    panel: str
    contender: str
    x_label: str
    y_label: str
    x: tuple[float, ...]
    y: tuple[float, ...]


@dataclass(frozen=True)
class Section:
    """All results of one module.

    `setup` says in Markdown what data, sizes and settings were used, so that a reader can
    judge whether the comparison is fair. `missing` has one sentence for every peer that
    could not run.
    """

    title: str
    setup: str
    rows: list[Row]
    curves: list[Curve] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)


def markdown_table(rows: list[Row]) -> str:
    """The rows as one Markdown table; extra columns appear in the order first seen."""
    extra_names = list(dict.fromkeys(name for row in rows for name in row.extra))
    timed = any(row.seconds is not None for row in rows)
    header = ["task", "contender", *(["time", "ratio"] if timed else []), *extra_names]
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    previous_task = None
    for row in rows:
        cells = [row.task if row.task != previous_task else "", row.contender]
        if timed:
            cells += [_duration(row.seconds), "" if row.ratio is None else f"{row.ratio:.3g} ×"]
        cells += [_cell(row.extra.get(name, "")) for name in extra_names]
        lines.append("| " + " | ".join(cells) + " |")
        previous_task = row.task
    return "\n".join(lines)


def markdown_section(section: Section) -> str:
    """A section as Markdown: heading, setup, one table a group, what is missing."""
    parts = [f"## {section.title}", section.setup.strip()]
    for group in dict.fromkeys(row.group for row in section.rows):
        rows = [row for row in section.rows if row.group == group]
        parts += [f"### {group}", markdown_table(rows)]
    parts += [f"- {sentence}" for sentence in section.missing]
    return "\n\n".join(parts)


def write_report(sections: list[Section], introduction: str, path: Path) -> None:
    """Write all sections to one Markdown file."""
    parts = ["# Benchmark results", introduction.strip()]
    parts += [markdown_section(section) for section in sections]
    path.write_text("\n\n".join(parts) + "\n", encoding="utf-8")


def _duration(seconds: float | None) -> str:
    if seconds is None:
        return ""
    for unit, scale in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-6:.3g} µs"


def _cell(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.3g}"
