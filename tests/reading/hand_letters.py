"""The letters that a simulated student writes: strokes of a school alphabet, no font.

Nothing here uses what reads letters. A letter that the alphabet lacks is a scribble.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from msgspec import Struct

from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import runs

Stroke = list[tuple[float, float]]
UNITS = 10.0
"""The height of a capital in units of the alphabet."""


def bow(x: float, y: float, across: float, up: float, start: float, end: float) -> Stroke:
    """A part of an ellipse, from one angle to another in degrees."""
    turns = np.radians(np.linspace(start, end, 14))
    return [(x + across * float(np.cos(t)), y + up * float(np.sin(t))) for t in turns]


BOWL = bow(2.6, 3, 2.6, 3, 60, 420)
ARCH: Stroke = [(0, 3.5), (1.2, 5.5), (2.6, 6), (4, 5.4), (4.6, 4), (4.6, 0)]
STEM, TALL = [(0.0, 6.0), (0.0, 0.0)], [(0.0, 10.0), (0.0, 0.0)]
LETTERS: dict[str, list[Stroke]] = {
    "a": [BOWL, [(5.2, 6), (5.2, 0.8), (6, 0)]],
    "b": [TALL, bow(2.6, 3, 2.6, 3, 170, -170)],
    "c": [bow(2.8, 3, 2.8, 3, 50, 310)],
    "d": [BOWL, [(5.2, 10), (5.2, 0)]],
    "e": [[(0.2, 3.1), (5.2, 3.3)], bow(2.7, 3, 2.6, 3, 5, 315)],
    "f": [[(5, 9.2), (4, 10), (2.8, 9.2), (2.4, 7), (2.4, 0)], [(0.4, 6), (4.6, 6)]],
    "g": [BOWL, [(5.2, 6), (5.2, -2), (4, -3.8), (2, -4), (0.4, -3)]],
    "h": [TALL, ARCH],
    "k": [TALL, [(4.4, 6), (0, 2.8), (4.6, 0)]],
    "m": [STEM, [(0, 4), (1.5, 6), (3, 5), (3, 0)], [(3, 4), (4.6, 6), (6, 5), (6, 0)]],
    "n": [STEM, ARCH],
    "o": [bow(2.8, 3, 2.8, 3, 90, 450)],
    "p": [[(0, 6), (0, -4)], bow(2.6, 3, 2.6, 3, 170, -170)],
    "q": [BOWL, [(5.2, 6), (5.2, -4)]],
    "r": [STEM, [(0, 4), (1.4, 5.8), (3.2, 5.8)]],
    "s": [bow(2.4, 4.5, 2, 1.5, 30, 270), bow(2.4, 1.5, 2.2, 1.5, 90, -150)],
    "v": [[(0, 6), (2.4, 0), (4.8, 6)]],
    "A": [[(0, 0), (3.6, 10), (7, 0)], [(1.2, 3.6), (5.8, 3.6)]],
    "B": [TALL, bow(0, 7.6, 5, 2.4, 90, -90), bow(0, 2.6, 5.6, 2.6, 90, -90)],
    "C": [bow(4, 5, 4, 5, 50, 310)],
    "D": [TALL, bow(0, 5, 6, 5, 90, -90)],
    "E": [TALL, [(0, 10), (5, 10)], [(0, 5.2), (4, 5.2)], [(0, 0), (5, 0)]],
    "F": [TALL, [(0, 10), (5, 10)], [(0, 5.2), (4, 5.2)]],
    "G": [bow(4, 5, 4, 5, 50, 340), [(7.8, 3.4), (7.8, 5), (5, 5)]],
    "O": [bow(4, 5, 4, 5, 90, 450)],
    "′": [[(1.6, 10), (0.4, 7)]],
    "1": [[(0, 7), (2.4, 10), (2.4, 0)]],
    "2": [[(0, 8), (1.4, 10), (4, 9.6), (4.6, 7.6), (0, 0), (5, 0)]],
    "3": [bow(2.2, 7.6, 2.2, 2.4, 150, -80), bow(2.2, 2.6, 2.6, 2.6, 80, -150)],
    "4": [[(3.6, 0), (3.6, 10), (0, 3), (5, 3)]],
}


class Writing(Struct, frozen=True):
    """How somebody writes: height relative to print, width relative to height, slant, wobble."""

    height: float = 1.1
    width: float = 0.9
    slant: float = 0.1
    wobble: float = 0.3


def writing_of(rng: Any) -> Writing:
    """A hand."""
    return Writing(
        rng.uniform(0.95, 1.5), rng.uniform(0.75, 1.1), rng.normal(0.1, 0.1), rng.uniform(0.1, 0.4)
    )


def written(mark: Text, hand: Writing, rng: Any) -> list[Any]:
    """The strokes of a text in mm of paper."""
    found: list[Any] = []
    turn = -np.radians(mark.rotate) + rng.normal(0, 0.06)
    spin = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    for run in runs(mark.markup, mark.height):
        x = mark.left() + run.x
        unit = run.size * 0.66 * hand.height / UNITS
        for letter in run.text:
            strokes = LETTERS.get(letter)
            if strokes is None:
                low, high = [0, -unit * UNITS], [0.6 * unit * UNITS, 0]
                strokes_mm = [rng.uniform(low, high, (3, 2)) for _ in range(2)]
            else:
                strokes_mm = [shaped(stroke, unit, hand, rng) for stroke in strokes]
            for path in strokes_mm:
                found.append((path + np.array([x, run.y])) @ spin.T + [mark.x, mark.y])
            ends = [path[:, 0].max() for path in strokes_mm]
            x += max(ends) + 1.6 * unit
    return found


def shaped(stroke: Stroke, unit: float, hand: Writing, rng: Any) -> Any:
    """A stroke in mm, right and down from where its letter begins."""
    path = np.array(stroke, dtype=float)
    along = np.linspace(0, 3, len(path))
    for axis in range(2):
        wave = rng.normal(0, hand.wobble, 2)
        path[:, axis] += wave[0] + wave[1] * np.sin(along + rng.uniform(0, 6))
    across = (path[:, 0] + hand.slant * path[:, 1]) * hand.width
    return np.stack([across, -path[:, 1]], axis=1) * unit
