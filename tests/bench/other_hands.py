"""How well drawings of other hands are read: marks, inks, papers and cameras of their own.

    python -m tests.bench.other_hands 42 [LAB …] [--seed 1] [-o FOLDER]

Only the printed sheet and the exact places come from the program. Each student has one habit of
``HABITS`` and each picture one shot of ``SHOTS``, in turn; a third of the sheets have one slip.
Prints what was refused, placed within 1 mm, decided, and decided wrongly, by habit, shot and slip.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import cv2
import numpy as np
from msgspec import Struct

from graphkin.classroom.printing.edition import read_edition
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import lay_out
from graphkin.numbers.plane import Vector
from graphkin.reading.pictures import Photograph
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, SheetRecord, read_one
from tests.bench.reading import folder_of
from tests.reading.hand import lettered_steps, printed, sheets_of

LABS = "pump", "slotted-lever", "offset-slider-crank"
DENSITY = 8.0
"""Pixels of a drawn sheet for each mm."""
WIDE, HIGH = 420.0, 297.0
SHIFT = 4
"""Bits of a pixel's fraction."""
LEAST = 12.0
"""The shortest vector that has a slip, in mm."""
BLUE, GREY, BLACK, GREEN = (170, 70, 40), (95, 95, 95), (25, 25, 25), (80, 130, 40)


class Habit(Struct, frozen=True):
    """How somebody draws: the mark of a point, its letter, the lines, the ink and the paper."""

    name: str
    mark: str = "ring"
    over: bool = False
    """Letters are written over the points."""
    final: bool = False
    """Construction lines are rubbed out."""
    width: float = 0.35
    ink: tuple[int, int, int] = GREY
    squared: bool = False
    filled: bool = False
    """Arrowheads are filled."""


HABITS = (
    Habit("rings"),
    Habit("crosses", mark="cross", ink=BLUE),
    Habit("dots", mark="dot", filled=True),
    Habit("final lines only", mark="none", final=True),
    Habit("letters over points", mark="dot", over=True),
    Habit("thick marker", mark="dot", width=0.9, ink=BLACK, filled=True),
    Habit("squared paper", mark="cross", squared=True),
    Habit("green pencil", mark="none", width=0.5, ink=GREEN, final=True, filled=True),
)


class OtherShot(Struct, frozen=True):
    """How a picture is taken."""

    name: str
    size: tuple[int, int] = (4000, 3000)
    tilt: float = 8.0
    """In degrees, about an axis at 30° to the long edge."""
    turn: int = 0
    """Quarters of a turn."""
    radius: float = 0.0
    """Of the cylinder to which the sheet is bent, in mm; flat if zero."""
    crease: float = 0.0
    """By how many degrees the quarters of a sheet folded in four rise."""
    side: float = 0.1
    """How much darker one side is."""
    quality: int = 88


SHOTS = (
    OtherShot("12 MP"),
    OtherShot("2 MP", size=(1632, 1224), quality=70),
    OtherShot("lit from a side", side=0.65),
    OtherShot("JPEG quality 40", size=(3264, 2448), quality=40),
    OtherShot("curled", radius=900.0, tilt=15.0),
    OtherShot("turned by 90°", turn=1),
    OtherShot("turned by 180°", turn=2, tilt=20.0),
    OtherShot("tilted by 45°", tilt=45.0),
    OtherShot("folded in four", crease=4.0),
)
SLIPS = "", "", "too long", "", "", "exchanged", "", "", "missing"


class Truth(Struct, frozen=True):
    """A lettered point as it was drawn; ``at`` is None where it is missing."""

    at: complex | None
    verdict: str = "right"


class Pen:
    """A colour picture of a printed sheet on which somebody draws."""

    def __init__(self, sheet: Any, habit: Habit, rng: Any) -> None:
        size = round(WIDE * DENSITY), round(HIGH * DENSITY)
        self.paper = cv2.resize(sheet, size, interpolation=cv2.INTER_AREA).astype(np.float32)
        self.ink = np.zeros(self.paper.shape, np.uint8)
        self.habit, self.rng = habit, rng

    def line(self, one: complex, other: complex, share: float = 1.0) -> None:
        """A ruled line, with ends that are not quite where they should be."""
        off = self.rng.normal(0, 0.1, 4)
        self.path([one + complex(*off[:2]), other + complex(*off[2:])], share)

    def path(self, places: list[complex], share: float = 1.0, width: float = 0.0) -> None:
        points = np.array([[p.real, p.imag] for p in places]) * DENSITY - 0.5
        thick = max(1, round((width or self.habit.width) * DENSITY))
        fixed = np.round(points * 2**SHIFT).astype(np.int32)
        tone = int(255 * share * self.rng.uniform(0.75, 0.95))
        cv2.polylines(self.ink, [fixed], False, tone, thick, cv2.LINE_AA, SHIFT)

    def fill(self, places: list[complex]) -> None:
        points = np.array([[p.real, p.imag] for p in places]) * DENSITY - 0.5
        fixed = np.round(points * 2**SHIFT).astype(np.int32)
        cv2.fillPoly(self.ink, [fixed], 220, cv2.LINE_AA, SHIFT)

    def mark(self, place: complex) -> None:
        kind, turns = self.habit.mark, np.exp(1j * np.linspace(0, 2 * np.pi, 16))
        if kind == "ring":
            self.path((place + 1.1 * turns).tolist())
        elif kind == "dot":
            self.fill((place + max(0.6, 0.8 * self.habit.width) * turns).tolist())
        elif kind == "cross":
            for way in (1.4 * (1 + 1j), 1.4 * (1 - 1j)):
                self.path([place - way, place + way])

    def vector(self, tail: complex, tip: complex) -> None:
        self.line(tail, tip)
        long = abs(tip - tail)
        if long < 3:
            return
        back = min(4.0, 0.5 * long) * (tail - tip) / long
        sides = [tip + back * np.exp(1j * np.radians(each)) for each in (16, -16)]
        if self.habit.filled:
            self.fill([tip, *sides])
        else:
            for side in sides:
                self.path([tip, side])

    def letter(self, text: str, place: complex) -> None:
        """A letter in one of two hands, beside a point or over it."""
        away = 0j if self.habit.over else 4.5 * np.exp(1j * self.rng.uniform(0, 2 * np.pi))
        face = (cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_COMPLEX_SMALL)[int(self.rng.integers(2))]
        size = 4.0 * DENSITY / 22
        (width, height), _ = cv2.getTextSize(text, face, size, 2)
        at = (place + away) * DENSITY
        corner = round(at.real - width / 2), round(at.imag + height / 2)
        cv2.putText(self.ink, text, corner, face, size, 210, 3, cv2.LINE_AA)

    def sheet(self) -> Any:
        """The drawn sheet in colours."""
        paper = self.paper
        if self.habit.squared:
            for at in np.arange(0, WIDE, 5.0):
                paper[:, round(at * DENSITY)] *= 0.86
            for at in np.arange(0, HIGH, 5.0):
                paper[round(at * DENSITY)] *= 0.86
        taken = 1 - np.array(self.habit.ink, np.float32) / 255
        ink = cv2.GaussianBlur(self.ink.astype(np.float32) / 255, (0, 0), 0.7)[..., None]
        tint = np.array([0.93, 0.97, 1.0], np.float32)
        return paper[..., None] * tint * (1 - ink * taken)


def drawn(
    folder: Path, code: str, kind: str, habit: Habit, slip: str, rng: Any
) -> tuple[Any, dict[int, Truth]]:
    """A sheet on which a student drew bars, vectors, marks and letters, and what is true of it."""
    drawing = next(each for each in sheets_of(folder, code).drawings if each.kind == kind)
    layout, steps = lay_out(drawing), drawing.trace.program.steps
    pen = Pen(printed(folder, code, kind), habit, rng)

    def place(number: int, value: complex) -> complex:
        return complex(*layout.field(steps[number])(value))

    values = drawing.trace.values
    exact = {n: place(n, values[n]) for n in lettered_steps(drawing)}
    own = {n: at + complex(*rng.normal(0, 0.12, 2)) for n, at in exact.items()}

    def near(at: complex) -> complex:
        return next((own[n] for n, there in exact.items() if abs(there - at) < 0.05), at)

    arrows = [
        (n, near(place(n, v.tail)), near(place(n, v.tip)))
        for n, _, v in drawing.steps(drawing.plane)
        if isinstance(v, Vector) and steps[n].arrow
    ]
    truth = {n: Truth(at) for n, at in own.items()}
    letters = {n: str(steps[n].name)[0] for n in own}
    plan = [n for n in own if steps[n].plane is drawing.plane]
    hidden, moved = slipped(slip, plan, arrows, own, truth, letters, rng)
    for one, other in bars(drawing):
        pen.line(near(one), near(other))
    for n, tail, tip in arrows:
        if hidden in (tail, tip):
            continue
        end = moved.get(n, tip)
        pen.vector(tail, end)
        if not habit.final and abs(tip - tail) > 3:
            pen.line(tail, tip + 9 * (tip - tail) / abs(tip - tail), 0.6)
    for n, at in own.items():
        if at != hidden:
            pen.mark(truth[n].at if slip == "too long" else at)
            pen.letter(letters[n], truth[n].at if slip == "too long" else at)
    return pen.sheet(), truth


def slipped(
    slip: str,
    plan: list[int],
    arrows: list[tuple[int, complex, complex]],
    own: dict[int, complex],
    truth: dict[int, Truth],
    letters: dict[int, str],
    rng: Any,
) -> tuple[complex | None, dict[int, complex]]:
    """Make one slip: the point that is missing, and where vectors end instead, by step."""
    if slip == "missing" and len(plan) > 1:
        lost = plan[-1]
        truth[lost] = Truth(None, "missing")
        return own[lost], {}
    if slip == "exchanged":
        pairs = [p for p in combinations(plan, 2) if letters[p[0]] != letters[p[1]]]
        one, other = pairs[int(rng.integers(len(pairs)))]
        letters[one], letters[other] = letters[other], letters[one]
        truth[one], truth[other] = Truth(own[other], "wrong"), Truth(own[one], "wrong")
    if slip == "too long":
        able = [(n, a, b) for n, a, b in arrows if abs(b - a) > LEAST]
        able = [each for each in able if each[2] in {own[p] for p in plan}]
        n, tail, tip = able[int(rng.integers(len(able)))]
        end = tail + (tip - tail) * rng.uniform(1.12, 1.4)
        point = next(p for p in plan if own[p] == tip)
        truth[point] = Truth(end, "wrong")
        return None, {n: end}
    return None, {}


def bars(drawing: Drawing) -> list[tuple[complex, complex]]:
    """The bars of the mechanism on paper: each two points of a link."""
    layout, targets, found = lay_out(drawing), drawing.trace.program.targets, []
    for name, link in drawing.scene.links.items():
        if name == "0":
            continue
        numbers = [targets.get(("position", point)) for point in link.points]
        there = [n for n in numbers if n is not None and n in drawing.trace.values]
        for pair in combinations(there, 2):
            one, other = (
                complex(*layout.field(drawing.trace.program.steps[n])(drawing.trace.values[n]))
                for n in pair
            )
            found.append((one, other))
    return found


# --- the camera -----------------------------------------------------------------------------------


def camera(shot: OtherShot) -> Callable[[Any], Any]:
    """From places of the paper in mm, (…, 2), to pixels."""
    width, height = shot.size
    lean, axis = np.radians(shot.tilt), np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
    tilted, _ = cv2.Rodrigues(axis * lean)
    spun, _ = cv2.Rodrigues(np.array([0, 0, np.pi / 2 * shot.turn + 0.03]))
    focal = 0.95 * width
    wide, high = (WIDE, HIGH) if shot.turn % 2 == 0 else (HIGH, WIDE)
    away = 1.12 * focal * max(wide / width, high / height) * (1 + 0.55 * np.sin(lean))

    def where(places: Any) -> Any:
        x, y = places[..., 0] - WIDE / 2, places[..., 1] - HIGH / 2
        z = np.zeros_like(x)
        if shot.radius:
            z = shot.radius * (1 - np.cos(x / shot.radius))
            x = shot.radius * np.sin(x / shot.radius)
        if shot.crease:
            rise = np.radians(shot.crease)
            z = -np.tan(rise) * abs(x) + 0.6 * np.tan(rise) * abs(y)
            x, y = x * np.cos(rise), y * np.cos(0.6 * rise)
        space = np.stack([x, y, z], -1) @ (tilted @ spun).T + np.array([4.0, -3.0, away])
        return space[..., :2] / space[..., 2:] * focal + np.array([width / 2, height / 2])

    return where


def photographed(sheet: Any, shot: OtherShot, rng: Any) -> bytes:
    """A JPEG of a drawn sheet on a brown table."""
    width, height = shot.size
    where = camera(shot)
    rim = np.array([[0, 0], [WIDE, 0], [WIDE, HIGH], [0, HIGH]])
    flat = cv2.getPerspectiveTransform(where(rim).astype(np.float32), rim.astype(np.float32))

    def back(pixels: Any) -> Any:
        return cv2.perspectiveTransform(pixels.reshape(1, -1, 2), flat).reshape(pixels.shape)

    step = 8
    xs, ys = np.arange(0, width + step, step), np.arange(0, height + step, step)
    pixels = np.stack(np.meshgrid(xs, ys), -1).astype(np.float64)
    places = back(pixels)
    for _ in range(8):
        places = np.clip(places + back(pixels) - back(where(places)), -200, 700)
    rows, columns = np.mgrid[0:height, 0:width].astype(np.float32) / step
    dense = cv2.remap(places.astype(np.float32), columns, rows, cv2.INTER_LINEAR)
    # a sheet is seen through pixels as large as theirs on the paper
    blur = max(0.0, DENSITY * WIDE / width - 1) * 0.5
    seen = cv2.GaussianBlur(sheet, (0, 0), blur) if blur > 0.2 else sheet
    if shot.crease:
        seen = creased(seen, rng)
    spots = dense * DENSITY - 0.5
    seen = cv2.remap(seen, spots[..., 0], spots[..., 1], cv2.INTER_LINEAR, borderValue=0)
    on = (dense >= 0).all(-1) & (dense[..., 0] < WIDE) & (dense[..., 1] < HIGH)
    noise = rng.normal(0, 2.5, (256, 256, 3)).astype(np.float32)
    noise = np.tile(noise, (height // 256 + 1, width // 256 + 1, 1))[:height, :width]
    table = np.array([60, 90, 120], np.float32)
    seen = np.where(on[..., None], seen * np.float32(0.9), table)
    light = 1 - shot.side * (columns / columns.max()) ** 1.5
    if shot.crease:
        light = light * (1 - 0.08 * (dense[..., 0] > WIDE / 2) - 0.05 * (dense[..., 1] > HIGH / 2))
    seen = cv2.GaussianBlur(seen * light[..., None].astype(np.float32), (0, 0), 0.6)
    seen += noise
    options = [cv2.IMWRITE_JPEG_QUALITY, shot.quality]
    ok, data = cv2.imencode(".jpg", np.clip(seen, 0, 255).astype(np.uint8), options)
    assert ok
    return bytes(data)


def creased(sheet: Any, rng: Any) -> Any:
    """A sheet whose ink and paper are worn along both creases."""
    found = sheet.copy()
    x, y = round(WIDE / 2 * DENSITY), round(HIGH / 2 * DENSITY)
    for part in ((slice(None), slice(x - 3, x + 3)), (slice(y - 3, y + 3),)):
        found[part] = 0.55 * found[part] + 100 + rng.normal(0, 10, found[part].shape)
    return found


# --- what comes of it -----------------------------------------------------------------------------


class Told:
    """What came of all pictures so far."""

    def __init__(self) -> None:
        self.refused: list[str] = []
        self.count, self.by = Counter[str](), Counter[Any]()
        self.notes: list[str] = []
        self.spent: list[float] = []

    def add(
        self, name: str, tags: tuple[str, ...], true: dict[int, Truth], record: SheetRecord
    ) -> None:
        """Hold what was read to what is true."""
        if record.refused is not None:
            self.refused.append(f"{name} {tags}: {record.refused}")
            return
        found = {each.step: each for each in record.points}
        for step, truth in true.items():
            read = found.get(step)
            if read is None:
                continue
            self.count["points"] += 1
            asked = "asked" if read.ask else "decided"
            off = np.inf
            if truth.at is not None:
                self.count["there"] += 1
                off = abs(complex(*read.at) - truth.at) if read.at is not None else np.inf
                self.count["placed"] += off < 1
                for tag in tags:
                    self.by[tag, "placed" if off < 1 else "beside"] += 1
            self.count[asked] += 1
            for tag in tags:
                self.by[tag, asked] += 1
            wrong = not read.ask and read.verdict != truth.verdict
            self.count["wrongly"] += wrong
            self.count[truth.verdict, asked, read.verdict] += 1
            beside = truth.at is not None and off >= 1
            if wrong or beside or (read.ask and truth.verdict == "right"):
                said = "WRONGLY" if wrong else asked
                why = ", ".join(read.doubts)
                self.notes.append(
                    f"{name} {tags} {read.name}: {truth.verdict}, {said} {read.verdict} ({why}), "
                    f"{off:.1f}"
                )

    def report(self) -> None:
        """Print it."""
        print(f"refused  {len(self.refused)} of {len(self.spent)}", *self.refused, sep="\n")
        counts = self.count
        placed, there = counts["placed"], counts["there"]
        print(f"placed within 1 mm  {placed} of {there}, {placed / max(there, 1):.1%}")
        points, decided = counts["points"], counts["decided"]
        print(f"decided  {decided} of {points}, {decided / max(points, 1):.1%}")
        print(f"wrongly  {counts['wrongly']} of {decided}")
        print(f"seconds  median {np.median(self.spent):.2f}, most {np.max(self.spent):.2f}")
        for tag in dict.fromkeys(tag for tag, _ in self.by):
            cells = (
                f"{each} {self.by[tag, each]}" for each in ("placed", "beside", "decided", "asked")
            )
            print(f"  {tag or 'no slip':22}", ", ".join(cells))
        for key, times in sorted((k, n) for k, n in counts.items() if isinstance(k, tuple)):
            print(*key, times)
        print(*self.notes, sep="\n")


def main(count: int, labs: list[str], seed: int, keep: Path | None) -> None:
    """Draw, photograph and read so many sheets."""
    cv2.setNumThreads(1)
    told = Told()
    with TemporaryDirectory() as temporary:
        where = keep or Path(temporary)
        where.mkdir(parents=True, exist_ok=True)
        for i in range(count):
            rng = np.random.default_rng([seed, i])
            folder = folder_of(labs[i % len(labs)], where, seed)
            order = read_order(read_edition(folder), Grid())
            code = list(order.takers)[i // len(labs) % 2]
            kinds = [each.kind for each in sheets_of(folder, code).drawings]
            kind = kinds[i // (2 * len(labs)) % len(kinds)]
            habit, shot = HABITS[i % len(HABITS)], SHOTS[i % len(SHOTS)]
            slip = SLIPS[(i + i // len(SLIPS)) % len(SLIPS)]
            path = where / f"o{i:03}.jpg"
            sheet, true = drawn(folder, code, kind, habit, slip, rng)
            if not path.exists():
                path.write_bytes(photographed(sheet, shot, rng))
            start = process_time()
            record = read_one(order, Photograph(path.stem, path), "").record
            told.spent.append(process_time() - start)
            told.add(path.stem, (habit.name, shot.name, slip), true, record)
    told.report()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("labs", nargs="*", default=list(LABS))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", type=Path)
    said = parser.parse_args()
    main(said.count, said.labs, said.seed, said.o)
