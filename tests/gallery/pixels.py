"""Pages as pixels, by matplotlib with the sheet's own marks and lettering."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imsave

from graphkin.drawing.marks import Page
from graphkin.drawing.style import Ink
from graphkin.writers.axes import put_marks

GUTTER = 12
"""White between pages, in pixels."""


def picture(page: Page, ink: Ink, dpi: float) -> np.ndarray:
    """A page as rows of pixels (height, width, 3), frame and title block included."""
    figure = Figure((page.width / 25.4, page.height / 25.4), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    put_marks(axes, page.marks, (0, 0), ink)
    axes.set_axis_off()
    axes.set_xlim(0, page.width)
    axes.set_ylim(-page.height, 0)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()


def side_by_side(pages: Sequence[np.ndarray]) -> np.ndarray:
    """Pictures in a row, their tops level, white between them."""
    height = max(page.shape[0] for page in pages)
    padded = [padding(page, height, page.shape[1] + GUTTER) for page in pages]
    return np.concatenate(padded, axis=1)


def stacked(rows: Sequence[np.ndarray]) -> np.ndarray:
    """Pictures below each other, flush left, white between them."""
    width = max(row.shape[1] for row in rows)
    padded = [padding(row, row.shape[0] + GUTTER, width) for row in rows]
    return np.concatenate(padded, axis=0)


def padding(picture: np.ndarray, height: int, width: int) -> np.ndarray:
    """A picture with white below and to its right."""
    down, across = height - picture.shape[0], width - picture.shape[1]
    return np.pad(picture, ((0, down), (0, across), (0, 0)), constant_values=255)


def write_png(path: Path, pixels: np.ndarray) -> None:
    """Write a picture; the same pixels give the same bytes."""
    imsave(path, pixels, metadata={"Software": ""})
