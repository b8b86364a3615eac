"""Draws where a lab is fair: the share by each parameter's values, and maps of pairs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING, Any

from graphkin.classroom.lab.fair_ranges import FairRanges, Tried
from graphkin.numbers.arithmetic import np
from graphkin.writers.plot_style import (
    COLOURS,
    FORMATS,
    figure_file,
    figure_title,
    look,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MAPPED = 4
"""The number of parameters in the maps: those that decide most."""
BINS = 24
"""The number of parts of a parameter's values."""


def pictures(found: FairRanges, name: str, title: str) -> Iterator[tuple[str, bytes]]:
    """The files of the pictures, with their names."""
    tried = found.tried
    worst = sorted(tried.space, key=tried.guilt, reverse=True)
    with look():
        figures = {"fair-by-parameter": by_parameter(tried, title)}
        if len(worst) > 1:
            figures["fair-by-pairs"] = by_pairs(tried, worst[:MAPPED], title)
        for what, figure in figures.items():
            for kind in FORMATS:
                yield f"{name}-{what}.{kind}", figure_file(figure, kind)


def by_parameter(tried: Tried, title: str) -> Figure:
    """Draw the fair share by the values of each parameter, one panel below the other."""
    figure = new_figure(7.2, 0.6 + 1.7 * len(tried.space))
    figure_title(figure, title)
    panels = figure.subplots(len(tried.space), 1, squeeze=False)[:, 0]
    for axes, name in zip(panels, tried.space, strict=True):
        step = float(tried.space[name].step)
        for first, last, share, _ in tried.by_value(name, BINS):
            low, high = float(first) - step / 2, float(last) + step / 2
            axes.bar(low, 100 * share, high - low, align="edge", color=COLOURS[0], lw=0)
        axes.set_ylim(0, 100)
        axes.set_xlabel(name)
        axes.set_ylabel("fair, %")
    return figure


def by_pairs(tried: Tried, names: list[str], title: str) -> Figure:
    """Draw a map of the fair share for each pair of parameters."""
    pairs = [*combinations(names, 2)]
    across = min(3, len(pairs))
    down = -(-len(pairs) // across)
    figure = new_figure(3.4 * across + 0.6, 3.0 * down + 0.5)
    figure_title(figure, title)
    panels = figure.subplots(down, across, squeeze=False).ravel()
    for axes, pair in zip(panels, pairs, strict=False):
        fair_map(axes, tried, *pair)
    for axes in panels[len(pairs) :]:
        axes.set_visible(False)
    return figure


def fair_map(axes: Axes, tried: Tried, across: str, up: str) -> None:
    """Draw the fair share over two parameters, from red (none) to blue (all)."""
    x, y = values_of(tried, across), values_of(tried, up)
    edges = [np.linspace(v.min(), v.max(), min(BINS, len(set(v))) + 1) for v in (x, y)]
    every, _, _ = np.histogram2d(x, y, bins=edges)
    fair, _, _ = np.histogram2d(x, y, bins=edges, weights=tried.fairness.fair.astype(float))
    with np.errstate(all="ignore"):
        share = np.where(every > 0, 100 * fair / every, np.nan)
    drawn = axes.pcolormesh(*edges, share.T, cmap="RdYlBu", vmin=0, vmax=100, rasterized=True)
    axes.figure.colorbar(drawn, ax=axes, label="fair, %")
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(visible=False)


def values_of(tried: Tried, name: str) -> Any:
    """The value of a parameter at each draw."""
    values, column = tried.space[name], [*tried.space].index(name)
    return np.array([float(values.value(int(k))) for k in tried.places[:, column]])
