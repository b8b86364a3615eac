"""Train the network that reads the letters beside points, on letters of many fonts.

    python -m tests.reading.letter_network [--parts 5] [--seed 5] [-j 2]

Each letter is thinned to strokes, bent, and drawn with a pencil beside a point to which lines lead.
The fonts are those of Debian's packages fonts-dejavu, fonts-liberation, fonts-urw-base35 and
fonts-freefont.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from graphkin.reading.drawn_ink import COARSE, DENSITY, FINE
from graphkin.reading.point_letters import ALPHABET, ROOM, SIDE, WEIGHTS, pieces

FOLDER = Path("/usr/share/fonts")
FONTS = (
    "DejaVuSans", "DejaVuSans-Oblique", "DejaVuSerif-Italic", "DejaVuSansMono-Oblique",
    "LiberationSans-Regular", "LiberationSans-Italic", "LiberationSerif-Italic",
    "LiberationMono-Italic", "URWGothic-Book", "URWGothic-BookOblique", "Z003-MediumItalic",
    "C059-Italic", "P052-Italic", "NimbusMonoPS-Italic", "FreeSansOblique", "FreeSerifItalic",
    "URWBookman-LightItalic", "DejaVuSans-ExtraLight",
)  # fmt: skip
TALL = 64
"""The size in pixels at which letters are thinned."""
FINER = 3
"""So many pixels of a drawing are one of what is read."""
SAME = 0.55
"""A piece is a letter where their boxes overlap by this share of both together."""
HIDDEN, BATCH, PASSES, RATE = 96, 128, 20, 2e-3
"""Neurons of the middle layer; pieces a step, passes over all pieces and length of a step."""


def font_file(name: str) -> Path | None:
    """The file of a font, if it is there."""
    return next((p for end in ("ttf", "otf") for p in FOLDER.rglob(f"{name}.{end}")), None)


@cache
def thinned(font: str, letter: str) -> Any:
    """The strokes of a letter: one pixel wide, on a square as high as the font."""
    drawn = Image.new("L", (2 * TALL, 2 * TALL))
    face = ImageFont.truetype(font, TALL)
    ImageDraw.Draw(drawn).text((TALL // 2, TALL // 4), letter, fill=255, font=face)
    return skeleton((np.array(drawn) > 127).astype(np.uint8))


def skeleton(shape: Any) -> Any:
    """A shape thinned to lines, by the steps of Zhang and Suen (1984)."""
    shape = np.pad(shape, 1)
    while True:
        changed = False
        for first in (True, False):
            p = [
                np.roll(shape, move, (0, 1))
                for move in ((1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1))
            ]
            count = sum(each.astype(int) for each in p)
            turns = sum((a == 0) & (b == 1) for a, b in zip(p, [*p[1:], p[0]], strict=True))
            n, e, s, w = p[0], p[2], p[4], p[6]
            one, two = (n * e * s, e * s * w) if first else (n * e * w, n * s * w)
            gone = (shape == 1) & (count >= 2) & (count <= 6) & (turns == 1)
            gone &= (one == 0) & (two == 0)
            changed |= bool(gone.any())
            shape = shape * ~gone
        if not changed:
            return shape[1:-1, 1:-1]


def bent(strokes: Any, tall: float, rng: Any) -> Any:
    """Strokes as a hand writes them, with capitals so many pixels high."""
    scale = tall / (0.73 * TALL)
    turn, lean = np.radians(rng.normal(0, 6)), rng.normal(0.05, 0.15)
    spin = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    way = spin @ np.array([[1, -lean], [0, 1]]) @ np.diag(rng.uniform(0.8, 1.2, 2)) * scale
    where = np.argwhere(strokes)[:, ::-1].astype(float)
    wave = rng.normal(0, 0.025 * TALL, (2, 2))
    for axis in range(2):
        along = where[:, 1 - axis] / TALL
        where[:, axis] += wave[axis, 0] * np.sin(2.5 * along) + wave[axis, 1] * np.cos(4 * along)
    return (where - where.mean(axis=0)) @ way.T


def scene(fonts: list[str], rng: Any) -> tuple[Any, dict[str, tuple[float, float, float, float]]]:
    """The ink about a point with letters beside it, and the boxes of these letters, in pixels."""
    half = round(ROOM * DENSITY)
    side, middle, px = 2 * half * FINER, half * FINER, DENSITY * FINER
    ink = np.zeros((side, side), np.float32)
    pen = rng.uniform(0.22, 0.5) * px

    def line(start: complex, end: complex, share: float = 1.0) -> None:
        layer = np.zeros(ink.shape, np.uint8)
        tone = int(255 * min(1.0, share * rng.uniform(0.7, 1.1)))
        a, b = ((round(each.real * 16), round(each.imag * 16)) for each in (start, end))
        cv2.line(layer, a, b, tone, max(1, round(pen * rng.uniform(0.8, 1.3))), cv2.LINE_AA, 4)
        np.maximum(ink, layer / np.float32(255), out=ink)

    at = complex(middle, middle)
    for _ in range(int(rng.integers(1, 5))):
        way = np.exp(2j * np.pi * rng.random())
        line(at, at + way * 20 * px)
        if rng.random() < 0.5:
            for barb in (0.27, -0.27):
                line(at, at + 3 * px * way * np.exp(1j * barb))
        if rng.random() < 0.3:
            line(at, at - way * rng.uniform(3, 20) * px)
    for _ in range(int(rng.integers(0, 4))):
        start = at + px * complex(*rng.uniform(-12, 12, 2))
        line(start, start + px * rng.uniform(3, 25) * np.exp(2j * np.pi * rng.random()))
    if rng.random() < 0.7:
        cv2.circle(ink, (middle, middle), round(0.7 * px), 1.0, round(pen))
    if rng.random() < 0.4:  # a scribble
        start = at + px * rng.uniform(2, 7) * np.exp(2j * np.pi * rng.random())
        for _ in range(3):
            ends = start + px * (rng.uniform(-1.4, 1.4, 3) + 1j * rng.uniform(-1.4, 1.4, 3))
            line(complex(ends[0]), complex(ends[1]))
            line(complex(ends[1]), complex(ends[2]))
    boxes = {}
    for letter in rng.choice(list(ALPHABET), 3, replace=False):
        tall = rng.uniform(2.2, 4.5) * px
        place = at + px * rng.uniform(2.5, 8) * np.exp(2j * np.pi * rng.random())
        where = bent(thinned(str(rng.choice(fonts)), str(letter)), tall, rng)
        spots = np.rint(where + np.array([place.real, place.imag])).astype(int)
        spots = spots[((spots > 0) & (spots < side - 1)).all(axis=1)]
        if len(spots) < 10:
            continue
        layer = np.zeros(ink.shape, np.uint8)
        layer[spots[:, 1], spots[:, 0]] = 1
        wide = max(1, round(pen * rng.uniform(0.8, 1.2)))
        round_pen = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (wide, wide))
        drawn = cv2.dilate(layer, round_pen)
        ink = np.maximum(ink, drawn * np.float32(rng.uniform(0.7, 1.0)))
        if rng.random() < 0.5:  # a prime
            prime = complex(spots[:, 0].max(), spots[:, 1].min()) + px * (0.5 + 0.3j)
            line(prime, prime + px * (-0.25 + 0.9j))
        low, high = spots.min(axis=0) - wide / 2, spots.max(axis=0) + wide / 2
        boxes[str(letter)] = tuple(float(e) / FINER for e in (*low, *(high - low)))
    return read_again(ink, rng), boxes


def read_again(ink: Any, rng: Any) -> Any:
    """The darkness of a fine drawing as ``drawn_ink`` finds it on a photograph."""
    size = ink.shape[1] // FINER, ink.shape[0] // FINER
    dark = cv2.resize(ink, size, interpolation=cv2.INTER_AREA)
    dark = cv2.GaussianBlur(dark, (0, 0), rng.uniform(0.3, 1.1))
    dark = dark + rng.normal(0, rng.uniform(0, 0.09), dark.shape).astype(np.float32)
    lines = cv2.GaussianBlur(dark, (0, 0), FINE * DENSITY)
    lines -= cv2.GaussianBlur(dark, (0, 0), COARSE * DENSITY)
    usual = max(float(np.percentile(lines, 97)), 0.05) * rng.uniform(0.9, 1.2)
    return np.clip(lines / usual, 0, 1.5).astype(np.float32)


def overlap(one: Any, other: Any) -> float:
    """The share of two boxes together that both cover."""
    x = min(one[0] + one[2], other[0] + other[2]) - max(one[0], other[0])
    y = min(one[1] + one[3], other[1] + other[3]) - max(one[1], other[1])
    both = max(x, 0) * max(y, 0)
    return both / (one[2] * one[3] + other[2] * other[3] - both)


def examples(fonts: list[str], count: int, rng: Any) -> tuple[Any, Any]:
    """Pieces as the network sees them, and the number of the letter that each is."""
    seen, named = [], []
    for _ in range(count):
        dark, boxes = scene(fonts, rng)
        for box, square in pieces(dark):
            best = max(boxes, key=lambda each: overlap(boxes[each], box), default="")
            known = best != "" and overlap(boxes[best], box) >= SAME
            if known or rng.random() < 0.5:
                seen.append(square)
                named.append(ALPHABET.index(best) if known else len(ALPHABET))
    return np.stack(seen), np.array(named)


def trained(seen: Any, named: Any, rng: Any) -> tuple[Any, ...]:
    """The layers of a network trained by Adam (Kingma and Ba, 2015)."""
    width, count = seen.shape[1], len(ALPHABET) + 1
    sizes = (width, HIDDEN), (HIDDEN,), (HIDDEN, count), (count,)
    layers = [
        (rng.normal(0, (2 / size[0]) ** 0.5, size) if len(size) > 1 else np.zeros(size)).astype(
            np.float32
        )
        for size in sizes
    ]
    first = [np.zeros_like(each) for each in layers]
    second = [np.zeros_like(each) for each in layers]
    step, total = 0, PASSES * (len(seen) // BATCH)
    for _ in range(PASSES):
        order = rng.permutation(len(seen))
        for start in range(0, len(order) - BATCH + 1, BATCH):
            some = order[start : start + BATCH]
            x = shifted(seen[some], rng)
            inner = x @ layers[0] + layers[1]
            kept = rng.random(inner.shape) < 0.8
            hidden = np.maximum(inner, 0) * kept / 0.8
            out = hidden @ layers[2] + layers[3]
            out = np.exp(out - out.max(axis=1, keepdims=True))
            out /= out.sum(axis=1, keepdims=True)
            out[np.arange(BATCH), named[some]] -= 1
            out /= BATCH
            back = (out @ layers[2].T) * (inner > 0) * kept / 0.8
            slopes = x.T @ back, back.sum(axis=0), hidden.T @ out, out.sum(axis=0)
            step += 1
            rate = RATE * (1 - step / total) + 1e-5
            for i, slope in enumerate(slopes):
                first[i] = 0.9 * first[i] + 0.1 * slope
                second[i] = 0.999 * second[i] + 0.001 * slope**2
                grown = first[i] / (1 - 0.9**step), second[i] / (1 - 0.999**step)
                decay = 1e-4 * layers[i] if layers[i].ndim > 1 else 0
                layers[i] -= (rate * (grown[0] / (np.sqrt(grown[1]) + 1e-8) + decay)).astype(
                    np.float32
                )
    return tuple(layers)


def shifted(seen: Any, rng: Any) -> Any:
    """Pieces moved by up to a pixel."""
    square = seen[:, : SIDE * SIDE].reshape(-1, SIDE, SIDE)
    moved = np.roll(square, tuple(rng.integers(-1, 2, 2)), (1, 2)).reshape(len(seen), -1)
    return np.concatenate([moved, seen[:, SIDE * SIDE :]], axis=1).astype(np.float32)


def part(seed: int, number: int) -> tuple[Any, Any]:
    """The examples of a thousand scenes."""
    fonts = [str(path) for name in FONTS if (path := font_file(name)) is not None]
    return examples(fonts, 1000, np.random.default_rng([seed, number]))


def main(parts: int, seed: int, jobs: int) -> None:
    """Train the network and write its weights."""
    with ProcessPoolExecutor(jobs) as executor:
        found = list(executor.map(partial(part, seed), range(parts)))
    seen, named = (np.concatenate(each) for each in zip(*found, strict=True))
    layers = trained(seen, named, np.random.default_rng(seed))
    np.savez_compressed(
        WEIGHTS, **{f"layer{i}": e.astype(np.float16) for i, e in enumerate(layers)}
    )
    print(f"{len(seen)} pieces, {WEIGHTS.stat().st_size} bytes")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--parts", type=int, default=5)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("-j", "--jobs", type=int, default=1)
    said = parser.parse_args()
    main(said.parts, said.seed, said.jobs)
