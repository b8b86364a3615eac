"""A simulated camera: a sheet lies on a table, bent and lit, and is photographed; its true map."""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from tests.reading.hand import DENSITY

WIDE, HIGH = 420.0, 297.0
RIGHT, DOWN = np.array([0.5, 0.0]), np.array([0.0, 0.5])


class Shot(Struct, frozen=True):
    """How a picture is taken: tilt (degrees), lens, bow and ripple of the paper (mm), light."""

    size: tuple[int, int] = (4000, 3000)
    sheet: tuple[float, float] = (WIDE, HIGH)
    """The width and height of the paper, in mm."""
    tilt: float = 0.0
    k1: float = 0.0
    bow: float = 0.0
    ripple: float = 0.0
    turn: float = 0.0
    light: float = 0.0
    shadow: bool = False
    blur: float = 0.6
    noise: float = 2.0
    quality: int = 80
    fill: float = 0.9
    thumb: bool = False
    table: float = 90.0
    grain: float = 0.0
    """Of the paper, in greys."""
    fold: float = 0.0
    """By how many degrees the quarters of a sheet that was folded in four are still raised."""
    cut: float = 0.0
    """How much of the sheet's upper edge is not in the picture, in mm."""


class Picture(Struct, frozen=True):
    """A photograph as JPEG, and where places of the paper (mm) really lie in it (pixels)."""

    data: bytes
    where: Callable[[Any], Any]


def forward(shot: Shot, rng: Any) -> Callable[[Any], Any]:
    """From places of the paper to pixels."""
    width, height = shot.size
    wide, high = shot.sheet
    focal = 1.15 * width
    way = rng.uniform(0, 2 * np.pi)
    lean = radians(shot.tilt)
    axis = np.array([np.cos(way), np.sin(way), 0.0])
    tilted, _ = cv2.Rodrigues(axis * lean)
    spun, _ = cv2.Rodrigues(np.array([0.0, 0.0, radians(shot.turn)]))
    turned = tilted @ spun
    across = abs(np.cos(radians(shot.turn))) > 0.7
    distance = focal * (wide if across else high) / (width * shot.fill)
    other = focal * (high if across else wide) / (height * shot.fill)
    distance = max(distance, other) * (1 + 0.6 * abs(np.sin(lean)))
    place = np.array([rng.uniform(-8, 8), rng.uniform(-8, 8), distance])
    bent = rng.uniform(0, 2 * np.pi)
    phases = rng.uniform(0, 2 * np.pi, 2)
    raised = np.radians(shot.fold) * rng.choice([-1.0, -0.6, 0.6, 1.0], 2)

    def where(points: Any) -> Any:
        x, y = points[..., 0] - wide / 2, points[..., 1] - high / 2
        u = (x * np.cos(bent) + y * np.sin(bent)) / 210
        z = shot.bow * (1 - u**2)
        shorter = -2 * shot.bow**2 / (3 * 210) * u**3
        z = z - np.tan(raised[0]) * abs(x) - np.tan(raised[1]) * abs(y)
        z = z + shot.ripple * np.sin(x / 25 + phases[0]) * np.sin(y / 30 + phases[1])
        x, y = x + shorter * np.cos(bent), y + shorter * np.sin(bent)
        x, y = x * np.cos(raised[0]), y * np.cos(raised[1])
        space = np.stack([x, y, -z], axis=-1) @ turned.T + place
        flat = space[..., :2] / space[..., 2:]
        half = np.hypot(width, height) / 2 / focal
        r2 = (flat**2).sum(-1, keepdims=True) / half**2
        bulged = flat * (1 + shot.k1 * r2)
        return bulged * focal + np.array([width / 2, height / 2])

    return where


def backward(where: Callable[[Any], Any], size: tuple[int, int], sheet: tuple[float, float]) -> Any:
    """The place of the paper behind each pixel, by Newton's method on every eighth."""
    width, height = size
    xs, ys = np.arange(0, width + 8, 8.0), np.arange(0, height + 8, 8.0)
    pixels = np.stack(np.meshgrid(xs, ys), axis=-1)
    wide, high = sheet
    corners = np.array([[0, 0], [wide, 0], [wide, high], [0, high]])
    rough = cv2.getPerspectiveTransform(
        where(corners).astype(np.float32), corners.astype(np.float32)
    )
    paper = cv2.perspectiveTransform(pixels.reshape(1, -1, 2), rough).reshape(pixels.shape)
    paper = np.clip(paper, -300, 800)
    for _ in range(6):
        here = where(paper)
        right = where(paper + RIGHT) - where(paper - RIGHT)
        down = where(paper + DOWN) - where(paper - DOWN)
        size_of = right[..., 0] * down[..., 1] - right[..., 1] * down[..., 0]
        off = pixels - here
        first = (off[..., 0] * down[..., 1] - off[..., 1] * down[..., 0]) / size_of
        second = (right[..., 0] * off[..., 1] - right[..., 1] * off[..., 0]) / size_of
        paper = np.clip(paper + np.clip(np.stack([first, second], -1), -40, 40), -300, 800)
    full = cv2.resize(
        paper.astype(np.float32), (len(xs) * 8, len(ys) * 8), interpolation=cv2.INTER_LINEAR
    )
    shift = np.float32([[1, 0, -3.5], [0, 1, -3.5]])  # resize puts samples at centres of blocks
    return cv2.warpAffine(full, shift, size, borderMode=cv2.BORDER_REPLICATE)


def photograph(image: Any, shot: Shot, seed: int) -> Picture:
    """The picture of a drawn sheet."""
    rng = np.random.default_rng([seed, 77])
    where = forward(shot, rng)
    width, height = shot.size
    paper = backward(where, shot.size, shot.sheet)
    wide, high = shot.sheet
    source = paper * np.float32(DENSITY) - np.float32(0.5)
    seen = cv2.remap(image, source[..., 0], source[..., 1], cv2.INTER_LINEAR, borderValue=0).astype(
        np.float32
    )
    on = (paper[..., 0] > 0) & (paper[..., 0] < wide) & (paper[..., 1] > 0) & (paper[..., 1] < high)
    small = rng.normal(0, 1, (height // 16 + 1, width // 16 + 1)).astype(np.float32)
    grain = cv2.resize(cv2.GaussianBlur(small, (0, 0), 2), (width, height))
    table = np.clip(shot.table + 25 * grain, 5, 250)
    fibres = rng.normal(0, 1, (height // 3 + 1, width // 3 + 1)).astype(np.float32)
    seen = seen + shot.grain * cv2.resize(fibres, (width, height))
    seen = np.where(on, seen * 0.92, table)
    ys, xs = np.mgrid[0:height, 0:width].astype(np.float32)
    lit = 1 - shot.light * (0.6 * xs / width + 0.4 * ys / height)
    if shot.shadow:
        edge = rng.uniform(0.3, 0.7) * width + 0.3 * ys
        lit = lit * (1 - 0.175 * (1 + np.tanh((xs - edge) / 60)))
    seen = seen * lit
    if shot.thumb:
        along = rng.uniform(60, 360)
        edges = (along, 290.0), (along, 7.0), (8.0, along * 0.7), (412.0, along * 0.7)
        spot = where(np.array(edges[int(rng.integers(4))]))
        cv2.ellipse(seen, (int(spot[0]), int(spot[1])), (130, 200), 20, 0, 360, 140, -1)
    seen = cv2.GaussianBlur(seen, (0, 0), shot.blur)
    seen = seen + rng.normal(0, shot.noise, seen.shape).astype(np.float32)
    if shot.cut:
        seen, where = without_edge(seen, where, shot.cut)
    ok, data = cv2.imencode(
        ".jpg", np.clip(seen, 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, shot.quality]
    )
    assert ok
    return Picture(data.tobytes(), where)


def without_edge(seen: Any, where: Callable[[Any], Any], cut: float) -> Any:
    """A picture without what lies within ``cut`` mm of the sheet's upper edge, and its places."""
    edge = where(np.stack([np.linspace(0, WIDE, 9), np.full(9, cut)], axis=-1))
    middle = where(np.array([WIDE / 2, HIGH / 2]))
    way = int(np.argmax(abs(edge.mean(axis=0) - middle)))
    first = bool(edge[:, way].mean() < middle[way])
    at = int(edge[:, way].max() if first else edge[:, way].min())
    part = slice(at, None) if first else slice(None, at)
    shift = np.where(np.arange(2) == way, at if first else 0, 0)
    kept = seen[:, part] if way == 0 else seen[part]
    return np.ascontiguousarray(kept), lambda places: where(places) - shift


def scan(
    image: Any, dpi: float, turn: float, seed: int, part: tuple[float, float] = (0.0, WIDE)
) -> Picture:
    """A flatbed's picture of a drawn sheet, or of what of it lies between two distances (mm) from
    its left edge, as it lies on a glass somewhat larger than that.
    """
    rng = np.random.default_rng([seed, 78])
    density, lean = dpi / 25.4, radians(turn)
    left, right = part
    corners = np.array([[left, 0], [right, 0], [right, HIGH], [left, HIGH]])
    spin = np.array([[np.cos(lean), np.sin(lean)], [-np.sin(lean), np.cos(lean)]])
    low = (corners @ spin).min(0) - rng.uniform(0, 4, 2)
    high = (corners @ spin).max(0) + rng.uniform(0, 4, 2)
    width, height = (int(each) for each in (high - low) * density)
    stretch = 1 + rng.uniform(-0.002, 0.002, 2)

    def where(points: Any) -> Any:
        return (points @ spin - low) * density * stretch - 0.5

    spots = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    paper = ((spots + 0.5) / density / stretch + low) @ spin.T
    source = (paper * DENSITY - 0.5).astype(np.float32)
    fine = cv2.GaussianBlur(image, (0, 0), 0.4 * DENSITY / density)
    seen = cv2.remap(fine, source[..., 0], source[..., 1], cv2.INTER_LINEAR, borderValue=235)
    on = (paper[..., 0] >= left) & (paper[..., 0] <= right)
    seen = np.where(on, seen, 235) + rng.normal(0, 1.5, seen.shape)
    ok, data = cv2.imencode(
        ".jpg", np.clip(seen, 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, 85]
    )
    assert ok
    return Picture(data.tobytes(), where)
