"""The crosses of a printed sheet in its picture, and their distances from the map's places."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from graphkin.classroom.printing.personal import ARM
from graphkin.reading.paper_map import PaperMap
from graphkin.reading.paper_ripple import CROSSED, Offsets

STEP = 0.1
"""Distance of samples, in mm."""
CROSS_REACH, CROSS_SIDE, CROSS_BLUR = 1.5, 1.6, 0.16
"""Search range for a cross, half the side of its window, and its blur, in mm."""
CROSS_ALIKE, LEAST_CROSSES = 0.7, 0.3
"""Least likeness of a cross, and the least share that a sheet printed with crosses shows.

A drawing covers some of them.
"""


def crosses_off(smooth: Any, over: PaperMap, places: Any) -> tuple[Offsets, float]:
    """The distances of clearly visible crosses from their places, and the share that is visible.

    Distances are right and down. The share is relative to the crosses that the picture contains.
    """
    near = np.arange(-CROSS_REACH - CROSS_SIDE, CROSS_REACH + CROSS_SIDE + STEP / 2, STEP)
    window = np.stack(np.meshgrid(near, near), axis=-1)
    right, down = (way[:, None, None] for way in over.ways(places))
    pixels = over(places)[:, None, None] + window[..., :1] * right + window[..., 1:] * down
    height, width = smooth.shape
    inside = (pixels > 1).all((1, 2, 3)) & (pixels < [width - 2, height - 2]).all((1, 2, 3))
    looked = np.flatnonzero(inside)
    model = cross_model()
    found, off = np.zeros(len(places), bool), np.zeros((len(places), 2))
    for i in looked:
        x, y = np.moveaxis(pixels[i].astype(np.float32), -1, 0)
        light = cv2.remap(smooth, x, y, cv2.INTER_LINEAR).astype(np.float32)
        alike = cv2.matchTemplate(light, model, cv2.TM_CCOEFF_NORMED)
        row, column = np.unravel_index(int(alike.argmax()), alike.shape)
        if alike[row, column] < CROSS_ALIKE or not 0 < row < len(alike) - 1 > column > 0:
            continue
        found[i] = True
        off[i] = (
            STEP * (column + vertex(alike[row, column - 1 : column + 2])) - CROSS_REACH,
            STEP * (row + vertex(alike[row - 1 : row + 2, column])) - CROSS_REACH,
        )
    both = np.repeat(places[found], 2, axis=0)
    ways = np.tile(np.eye(2), (int(found.sum()), 1))
    offsets = Offsets(both, ways, off[found].ravel(), np.full(len(both), CROSSED))
    return offsets, float(found.sum() / max(len(looked), 1))


def cross_model() -> Any:
    """The brightness of a blurred cross about its middle."""
    near = np.arange(-CROSS_SIDE, CROSS_SIDE + STEP / 2, STEP)
    along = np.clip((ARM + CROSS_BLUR / 2 - abs(near)) / CROSS_BLUR, 0, 1)
    across = np.exp(-((near / CROSS_BLUR) ** 2) / 2)
    dark = np.maximum(np.outer(across, along), np.outer(along, across))
    return (255 * (1 - dark)).astype(np.float32)


def vertex(three: Any) -> float:
    """The position of a parabola's maximum through three values, in steps from the middle one."""
    first, middle, last = (float(each) for each in three)
    return (first - last) / 2 / min(first - 2 * middle + last, -1e-9)
