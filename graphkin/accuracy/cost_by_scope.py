"""The third picture: what a position costs by what is asked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from graphkin.accuracy.point_names import GREY
from graphkin.accuracy.scope import ASKED
from graphkin.accuracy.study import Study
from graphkin.construction.core.timing import Timing
from graphkin.writers.plot_style import COLOURS, INK, figure_title, new_figure, panel_heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def bars(study: Study, machine: str) -> Figure:
    """Time of one position by what is wanted, one by one and in a batch, with quartiles."""
    figure = new_figure(11.2, 4.6)
    left, right = figure.subplots(1, 2, sharey=True)
    scopes = study.scopes
    figure_title(
        figure,
        f"What a position costs by what is asked: {study.mechanism.scene.title}",
        fontweight="bold",
        fontsize=12.5,
    )
    labels = [f"{scope.name}\n{scope.steps} steps" for scope in scopes]
    colours = [COLOURS[1] if scope.name == ASKED else COLOURS[0] for scope in scopes]
    panel(left, labels, colours, [scope.single for scope in scopes])
    panel_heading(left, "One position after the other")
    panel(right, labels, colours, [scope.batch for scope in scopes])
    panel_heading(right, "In a batch")
    figure.supxlabel(
        f"Medians with quartiles of everything up to each scope. {machine}",
        fontsize=7,
        color=GREY,
        x=0.01,
        ha="left",
    )
    return figure


def panel(ax: Axes, labels: Sequence[str], colours: Sequence[str], times: Sequence[Timing]) -> None:
    """Bars in microseconds with their numbers, the first scope on top."""
    micro = [time.median * 1e6 for time in times]
    rows = range(len(times))
    ax.barh(rows, micro, color=colours, height=0.62)
    for row, time in zip(rows, times, strict=True):
        ax.plot([time.low * 1e6, time.high * 1e6], [row, row], color=INK, lw=1.2)
        ax.annotate(
            f"{time.median * 1e6:.3g}",
            (max(time.high, time.median) * 1e6, row),
            (5, 0),
            textcoords="offset points",
            va="center",
            fontsize=9,
        )
    ax.set_yticks(rows, labels)
    ax.set_ylim(len(labels) - 0.5, -0.5)
    ax.set_xlim(0, max([time.high * 1e6 for time in times] + micro) * 1.15)
    ax.set_xlabel("µs a position")
    ax.grid(False, axis="y")
