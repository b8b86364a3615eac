"""The letters beside the points of a plan, read by a small network as evidence of their own.

Straight lines are taken away, what is left falls into pieces, and each piece is a letter from a to
z or none. The weights are made by ``python -m tests.reading.letter_network``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import combinations
from math import log
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from graphkin.reading.drawn_ink import DENSITY, DrawnInk

WEIGHTS = Path(__file__).parent / "letter_weights.npz"
ALPHABET = "abcdefghijklmnopqrstuvwxyz"
INKED = 0.65
"""The darkness from which a pixel belongs to a piece: specks of the paper are paler."""
ROOM, NEAR, ABOUT = 13.0, 8.0, 1.0
"""Half the side of the square about a point that is looked at; pieces lie between ABOUT and NEAR
mm from the point, where no ring is taken for a letter.
"""
STRAIGHT, TURNS = 55, np.arange(0.0, 180.0, 5.0)
"""Lines of so many pixels in one of these directions (degrees) are no part of a letter."""
SMALLEST, LARGEST = 0.8, 6.0
"""The least and the most height or width of a letter, in mm."""
JOINED = 0, 3, 5
"""Pieces less than so many pixels apart are one piece, tried in turn."""
PRINTED = 15
"""How many pixels of a stroke a printed cross may hide."""
SLIGHT = 0.65
"""A letter with pieces of less than this share of its size is no other letter: a prime, a speck."""
SIDE, BOX = 24, 20
"""The side of the square that the network sees, and of the piece in it, in pixels."""
FLOOR = 0.02
"""The least probability of a letter, since a letter may stand farther away or not at all."""
UNLIKE = 0.1
"""The least probability that a piece is one of the letters looked for, or none."""
FADES = 4.0
"""A letter so many mm farther away counts e times less."""
EXCHANGED, CLEARLY_EXCHANGED, BOTH, AGAINST = 1.0, 2.5, 0.2, -1.5
"""By how much likelier, as a logarithm, two letters are exchanged: asked, and proposed as wrong.

BOTH of the points saying so are enough; no point may say the opposite by more than AGAINST. Of a
point and an unsure one, both must say so.
"""


def pieces(dark: Any) -> Iterator[tuple[tuple[int, int, int, int], Any]]:
    """The pieces of ink in a square that may be letters: their box (x, y, width, height), and what
    the network sees of them.
    """
    inked = (dark > INKED).astype(np.uint8)
    left = inked * (cv2.dilate(straight(inked), np.ones((3, 3), np.uint8)) == 0)
    low, high = SMALLEST * DENSITY, LARGEST * DENSITY
    _, parts, boxes, _ = cv2.connectedComponentsWithStats(left)
    sizes = boxes[:, 2:4].max(axis=1)
    seen = set[tuple[int, int, int, int]]()
    for gap in JOINED:
        joined = cv2.dilate(left, np.ones((gap, gap), np.uint8)) if gap else left
        count, names = cv2.connectedComponents(joined)
        names = names * left
        for name in range(1, count):
            mask = (names == name).astype(np.uint8)
            x, y, width, height = cv2.boundingRect(mask)
            box = int(x), int(y), int(width), int(height)
            long, short = max(width, height), min(width, height)
            most, second = np.sort([0, *sizes[np.setdiff1d(parts[mask > 0], 0)]])[:-3:-1]
            alone = most >= low and 0 < second < SLIGHT * most
            if low <= long <= high and short >= 2 and box not in seen and not alone:
                seen.add(box)
                yield box, shown(dark * cv2.dilate(mask, np.ones((3, 3), np.uint8)), box)


def straight(inked: Any) -> Any:
    """The pixels of long straight lines."""
    found = np.zeros_like(inked)
    for kernel in kernels():
        found |= cv2.dilate(cv2.erode(inked, kernel), cv2.flip(kernel, -1))
    return found


@lru_cache(maxsize=1)
def kernels() -> tuple[Any, ...]:
    """A line of ``STRAIGHT`` pixels in each direction."""
    half, found = STRAIGHT // 2, []
    for turn in np.radians(TURNS):
        kernel = np.zeros((STRAIGHT, STRAIGHT), np.uint8)
        x, y = round(half * float(np.cos(turn))), round(half * float(np.sin(turn)))
        cv2.line(kernel, (half - x, half - y), (half + x, half + y), 1)
        found.append(kernel)
    return tuple(found)


def shown(dark: Any, box: tuple[int, int, int, int]) -> Any:
    """A piece as the network sees it: in the middle of a small square, and its size in mm."""
    x, y, width, height = box
    scale = BOX / max(width, height)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    part = cv2.resize(
        np.clip(dark[y : y + height, x : x + width], 0, 1), size, interpolation=cv2.INTER_AREA
    )
    square = np.zeros((SIDE, SIDE), np.float32)
    top, left = (SIDE - size[1]) // 2, (SIDE - size[0]) // 2
    square[top : top + size[1], left : left + size[0]] = part
    size_mm = np.array([width, height], np.float32) / DENSITY / LARGEST
    return np.concatenate([square.ravel(), size_mm])


@lru_cache(maxsize=1)
def network() -> tuple[Any, ...]:
    """The weights and offsets of the layers."""
    with np.load(WEIGHTS) as kept:
        return tuple(kept[name].astype(np.float32) for name in sorted(kept.files))


def probabilities(seen: Any, layers: tuple[Any, ...]) -> Any:
    """The probability of each letter, and at last of none, for each piece."""
    value = seen
    for weights, offsets in zip(layers[0::2], layers[1::2], strict=True):
        value = np.maximum(value, 0) if value is not seen else value
        value = value @ weights + offsets
    value = np.exp(value - value.max(axis=1, keepdims=True))
    return value / value.sum(axis=1, keepdims=True)


def bridged(dark: Any, known: Any) -> Any:
    """The ink outside print, and that under print which joins pieces of it."""
    inked = (dark * known > INKED).astype(np.uint8)
    joined = cv2.morphologyEx(inked, cv2.MORPH_CLOSE, np.ones((PRINTED, PRINTED), np.uint8))
    return dark * (known | (joined > 0))


def letters_near(ink: DrawnInk, place: complex, letters: str = ALPHABET) -> Mapping[str, float]:
    """How likely each of some letters is written beside a place: from FLOOR to 1.

    A piece is taken for one of these letters, or for none.
    """
    corner = complex(*ink.paper.fields[:2])
    x, y = (place - corner).real * DENSITY, (place - corner).imag * DENSITY
    half = round(ROOM * DENSITY)
    left, top = max(0, round(x) - half), max(0, round(y) - half)
    part = slice(top, max(0, round(y) + half)), slice(left, max(0, round(x) + half))
    found = np.full(len(letters), FLOOR)
    beside = []
    if min(ink.dark[part].shape) >= STRAIGHT:
        dark = bridged(ink.dark[part], ink.known[part] > 0)
        for (bx, by, width, height), seen in pieces(dark):
            far = np.hypot(left + bx + width / 2 - x, top + by + height / 2 - y) / DENSITY
            if ABOUT < far < NEAR:
                beside.append((far, seen))
    if beside:
        likely = probabilities(np.stack([seen for _, seen in beside]), network())
        likely = likely[:, [*(ALPHABET.index(each) for each in letters), -1]]
        likely /= np.maximum(likely.sum(axis=1, keepdims=True), UNLIKE)
        fades = np.exp(-np.maximum(np.array([far for far, _ in beside]) - FADES, 0) / FADES)
        found = np.maximum(found, (likely[:, :-1] * fades[:, None]).max(axis=0))
    return dict(zip(letters, found.tolist(), strict=True))


class WrittenPoint(Struct, frozen=True):
    """A point beside which a letter is expected.

    ``unsure``: a point of a trial plan, which is not read, or one that is asked about as wrong.
    """

    letter: str
    place: complex
    unsure: bool = False


def exchanged(
    ink: DrawnInk, points: Mapping[int, WrittenPoint]
) -> Iterator[tuple[int, int, float]]:
    """The pairs of points whose letters seem to be exchanged, and by how much likelier they are.

    A letter that a third point near by should have says nothing, and a clear pair comes before
    others of its points.
    """
    letters = "".join(dict.fromkeys(each.letter for each in points.values()))
    likely = {number: letters_near(ink, each.place, letters) for number, each in points.items()}

    def side(one: int, other: int) -> float:
        mine, letter = points[one], points[other].letter
        found = log(likely[one][letter] / likely[one][mine.letter])
        thirds = (each for number, each in points.items() if number not in (one, other))
        theirs = any(
            each.letter == letter and abs(each.place - mine.place) < NEAR for each in thirds
        )
        return min(found, 0.0) if theirs else found

    found = []
    for one, other in combinations(points, 2):
        both = points[one], points[other]
        if both[0].letter == both[1].letter or all(each.unsure for each in both):
            continue
        sides = side(one, other), side(other, one)
        gain = sum(sides)
        two = gain < EXCHANGED or any(each.unsure for each in both)
        if min(sides) >= (BOTH if two else AGAINST):
            found.append((one, other, gain))
    explained = set[int]()
    for one, other, gain in sorted(found, key=lambda each: -each[2]):
        if explained.isdisjoint((one, other)):
            yield one, other, gain
            explained.update((one, other) if gain > CLEARLY_EXCHANGED else ())
