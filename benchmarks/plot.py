"""One picture of all results: ratios as bars, growth as curves."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.report import OURS, Curve, Row, Section

# Okabe and Ito's colours, which colour-blind readers can tell apart; this project is blue.
BLUE, SKY = "#0072B2", "#56B4E9"
OTHERS = ("#D55E00", "#009E73", "#CC79A7", "#E69F00", SKY, "#000000")
MARKERS = "osv^Dxp"


def write_plot(sections: list[Section], path: Path) -> None:
    """Draw all sections: on the left the ratios, on the right one small plot a panel."""
    rows = [row for section in sections for row in section.rows if _is_peer(row)]
    curves = [curve for section in sections for curve in section.curves]
    panels = list(dict.fromkeys(curve.panel for curve in curves))
    panel_rows = max(1, -(-len(panels) // 2))
    height = max(3.0 * panel_rows, 0.28 * len(rows) + 1.5)
    figure: Figure = plt.figure(figsize=(15, height), layout="constrained")
    left, right = np.asarray(figure.subfigures(1, 2, width_ratios=[1, 1.2])).ravel()
    _draw_ratios(left.subplots(), rows)
    if panels:
        axes = right.subplots(panel_rows, 2, squeeze=False).ravel()
        for axis, panel in zip(axes, panels, strict=False):
            _draw_panel(axis, [curve for curve in curves if curve.panel == panel])
        for axis in axes[len(panels) :]:
            axis.set_axis_off()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _is_peer(row: Row) -> bool:
    return row.ratio is not None and row.contender != OURS


def _draw_ratios(axis: Axes, rows: list[Row]) -> None:
    names = [f"{row.group}, {row.task}:  {row.contender}" for row in rows]
    ratios = [row.ratio or 1.0 for row in rows]
    tasks = list(dict.fromkeys((row.group, row.task) for row in rows))
    shades = [
        "#0072B2" if tasks.index((row.group, row.task)) % 2 == 0 else "#56B4E9" for row in rows
    ]
    axis.barh(range(len(rows)), ratios, color=shades)
    for place, ratio in enumerate(ratios):
        axis.annotate(f" {ratio:.3g} ×", (ratio, place), va="center", fontsize=8)
    axis.axvline(1.0, color="black", linewidth=1)
    axis.set_yticks(range(len(rows)), names, fontsize=8)
    axis.set_xscale("log")
    axis.margins(y=0.01)
    # Room for the longest bar's number.
    axis.set_xlim(min([1.0, *ratios]) / 1.5, max([1.0, *ratios]) * 6)
    axis.invert_yaxis()
    axis.set_xlabel("time, as a multiple of this project's")


def _draw_panel(axis: Axes, curves: list[Curve]) -> None:
    others = iter(OTHERS)
    for curve, marker in zip(curves, MARKERS, strict=False):
        color = BLUE if curve.contender == OURS else next(others)
        axis.loglog(curve.x, curve.y, marker=marker, color=color, label=curve.contender, ms=4)
    axis.set_title(curves[0].panel, fontsize=9)
    axis.set_xlabel(curves[0].x_label, fontsize=8)
    axis.set_ylabel(curves[0].y_label, fontsize=8)
    axis.tick_params(labelsize=8)
    axis.legend(fontsize=7)
    axis.grid(alpha=0.3)
