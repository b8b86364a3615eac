"""How well drawings are read: pictures of simulated students of some labs, against their truth.

    python -m tests.bench.reading 120 [LAB | SCENE.toml …] [--seed 23] [-o FOLDER] [-j 2]
        [--wrong KIND …]

Without labs, of those below. A scene becomes a lab whose students have its first parameter.

A third of the sheets have a mistake, a twelfth lacks a point; every fourth picture is hard, every
eighth a flatbed scan. Prints how far the map is off, where points are placed, how much is decided,
and how much of it wrongly, twice: by definition, where *right* is what lies within the student's
pencil of the key, and with what comes after a mistake counted as wrong wherever it lies. With
``--wrong``, one thing alone is wrong on each sheet, in turn of the kinds: a vector that is too
``long`` or ``short`` or has its head at its tail (``turned``), two letters ``exchanged``, the whole
plan ``halved``, ``spun`` or ``mirrored``. A folder keeps the pictures with their truth: they are
read again.
"""

from __future__ import annotations

import argparse
import tomllib
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any
from unittest.mock import patch

import msgspec
import numpy as np
from click.testing import CliRunner
from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import Pencil
from graphkin.classroom.printing.edition import read_edition
from graphkin.cli.main import app
from graphkin.drawing.field import A3
from graphkin.reading.lettered_points import LetteredSheet
from graphkin.reading.pictures import Photograph
from graphkin.reading.point_reader import forecast_points
from graphkin.reading.point_reading import PointReading
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, ReadOrder, SheetRecord, read_one
from graphkin.reading.read_sheet import sheets_of as key_sheets
from tests.reading.camera import Shot, photograph, scan
from tests.reading.hand import PLANS, Habits, TruePoint, drawn_sheet, sheets_of

LABS = "pump", "slotted-lever", "offset-slider-crank", "tests/scenes/reading/class-three"
"""The labs, one with Coriolis and one of class III."""
CLASS, TAKEN = 30, 6
"""The numbers of students run up to the first; so many of them are photographed."""
XS, YS = tuple(np.linspace(22, 408, 17).tolist()), tuple(np.linspace(12, 285, 13).tolist())
TURNS = (0.0, 90.0, 180.0, 270.0)
TRIALS = "¹²"
"""How the names of points of trial plans end: the reader follows these points, and tells none."""


class Taken(Struct, frozen=True):
    """What is true of a picture: its lab, what was drawn, and where a grid of places lies in it."""

    lab: str
    points: tuple[TruePoint, ...]
    grid: tuple[tuple[float, float], ...]


def folder_of(lab: str, where: Path, seed: int) -> Path:
    """The class folder of a lab, or of a scene, with some students whose data are fair.

    A seed gives the same codes, which are printed on the sheets.
    """
    rng = np.random.default_rng([seed, *lab.encode()])
    out, numbers = where / Path(lab).stem, rng.permutation(np.arange(1, CLASS + 1)).tolist()
    if out.exists():
        return out
    ours = lab_of(Path(lab), where) if lab.endswith(".toml") else lab
    while numbers:
        taken = sorted(numbers[:TAKEN])
        rows = "".join(f"{n};{n:04};Student {n}\n" for n in taken)
        (where / "class.csv").write_text(f"Nr.;Matricol;Nume\n{rows}", encoding="utf-8")
        words = ["variants", ours, where / "class.csv", "-o", out, "--force"]
        with patch("secrets.token_hex", lambda size: rng.bytes(size).hex()):
            told = CliRunner().invoke(app, [str(word) for word in words])
        if told.exit_code == 0:
            return out
        unfair = [n for n in taken if f"{n:04}" in told.output]
        if not unfair:
            raise SystemExit(told.output)
        numbers = [n for n in numbers if n not in unfair]
    raise SystemExit(told.output)


def lab_of(scene: Path, where: Path) -> Path:
    """A lab of a scene: its first parameter runs with the students' numbers."""
    folder = where / f"lab-{scene.stem}"
    folder.mkdir(exist_ok=True)
    text = scene.read_text(encoding="utf-8")
    name, one = next(iter(tomllib.loads(text)["parameters"].items()))
    count = round((one["max"] - one["min"]) / one["step"]) + 1
    law = f"{one['min']} + {one['step']}*(number mod {count})"
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    (folder / "lab.toml").write_text(
        f'graphkin = 1\n[variants]\nset = {{ {name} = "{law}" }}\n'
        "[fair]\ncrossing = 5\nsegment = 2\ntriangle = [0.01, 20]\n",
        encoding="utf-8",
    )
    return folder


WRONG = "long", "short", "turned", "exchanged", *PLANS
"""What alone may be wrong on the sheets of a run."""


def turn_of(i: int, labs: Sequence[str], wrong: Sequence[str], seed: int) -> tuple[str, str]:
    """The lab of the i-th picture and what is wrong on it: each pair once a round, in any order."""
    pairs = list(product(labs, wrong or ("",)))
    past, now = divmod(i, len(pairs))
    return pairs[int(np.random.default_rng([seed, past]).permutation(len(pairs))[now])]


def habits_of(i: int, rng: Any, end: str) -> Habits:
    """How the i-th student draws; if an ``end`` is given, that alone is wrong."""
    drawn = usual_habits(i, rng)
    return replace(drawn, end=end, mistake=False, missing=False, headless=0.0) if end else drawn


def usual_habits(i: int, rng: Any) -> Habits:
    """How the i-th student draws, with a mistake in a third and a point missing in a twelfth."""
    return Habits(
        point=rng.uniform(0.25, 0.5),
        line=rng.uniform(0.25, 0.5),
        grey=rng.uniform(0.3, 0.75),
        width=rng.uniform(0.22, 0.45),
        wobble=rng.uniform(0.03, 0.1),
        mistake=i % 3 == 1,
        missing=i % 12 == 2,
        stray=int(rng.integers(0, 3)),
        erased=bool(rng.random() < 0.3),
    )


def shot_of(i: int, rng: Any) -> Shot:
    """How the i-th picture is taken."""
    hard = i % 4 == 3
    most = 1.0 if hard else 0.6
    return Shot(
        size=(4000, 3000),
        tilt=rng.uniform(0, 25 * most),
        k1=rng.uniform(-0.08, 0.08) * most,
        bow=rng.uniform(0, 5) * most,
        ripple=0.3 if hard and i % 8 == 7 else 0.0,
        turn=float(rng.choice(TURNS)) + rng.uniform(-5, 5),
        light=rng.uniform(0, 0.5) * most,
        shadow=bool(rng.random() < 0.3),
        blur=rng.uniform(0.5, 1.4 if hard else 1.0),
        table=float(rng.choice([60, 110, 180, 235])),
        fill=rng.uniform(0.78, 0.95),
        thumb=hard and i % 8 == 3,
        grain=float(rng.choice([0.0, 1.5, 4.0])),
    )


def take(classes: dict[str, Path], where: Path, seed: int, wrong: Sequence[str], i: int) -> None:
    """Draw the i-th sheet and take its picture, unless it is there."""
    path, truth = where / f"p{i:03}.jpg", where / f"p{i:03}.truth.json"
    if truth.exists():
        return
    rng = np.random.default_rng([i, seed])
    lab, end = turn_of(i, list(classes), wrong, seed)
    variants = list(read_order(read_edition(classes[lab]), Grid()).takers)
    code = variants[(i // len(classes)) % len(variants)]
    kinds = [each.kind for each in sheets_of(classes[lab], code).drawings]
    kind = kinds[int(rng.integers(len(kinds)))]
    habits = habits_of(i, rng, end)
    try:
        drawing = drawn_sheet(classes[lab], code, kind, habits, 1000 * seed + i)
    except AssertionError:
        return
    shot = shot_of(i, rng)
    if i % 8 == 5:
        turn = round(shot.turn / 90) * 90 + rng.uniform(-1, 1)
        taken = scan(drawing.image, float(rng.choice([150, 200, 300])), turn, 1000 * seed + i)
    else:
        taken = photograph(drawing.image, shot, 1000 * seed + i)
    places = np.stack(np.meshgrid(XS, YS), axis=-1).reshape(-1, 2)
    grid = tuple((float(x), float(y)) for x, y in taken.where(places))
    path.write_bytes(taken.data)
    truth.write_bytes(msgspec.json.encode(Taken(lab, drawing.points, grid)))


Again = tuple[str, Taken, SheetRecord, dict[int, float], float]
"""A picture's name, what is true of it, what was read, how far off the key is right, in mm, and how
long reading took, in seconds.
"""


def read_again(classes: dict[str, Path], where: Path, i: int) -> Again | None:
    """What is read of the i-th picture, with what is true of it."""
    import cv2

    cv2.setNumThreads(1)
    path = where / f"p{i:03}.jpg"
    if not path.exists():
        return None
    taken = msgspec.json.decode(path.with_suffix(".truth.json").read_bytes(), type=Taken)
    order = read_order(read_edition(classes[taken.lab]), Grid(XS, YS))
    start = process_time()
    record = read_one(order, Photograph(path.stem, path), "").record
    spent = process_time() - start
    return path.stem, taken, record, tolerances(order, record), spent


def tolerances(order: ReadOrder, record: SheetRecord) -> dict[int, float]:
    """Within so many mm of the key the student's pencil has 95 of 100 drawings of each point."""
    if record.refused is not None:
        return {}
    taker = order.takers[record.code]
    sheets = key_sheets(order.order, taker, taker.spoken or order.order.language)
    drawing = next(each for each in sheets.drawings if each.kind == record.kind)
    sheet = LetteredSheet(drawing, sheets.task_pages[record.kind])
    pencil = Pencil(sheets.lab.rubric.point, sheets.lab.rubric.line)
    return {point.step: point.error for point in forecast_points(sheet, pencil)}


class Tally:
    """What came of all pictures so far."""

    def __init__(self) -> None:
        self.count, self.labs = Counter[Any](), Counter[Any]()
        self.placed: list[float] = []
        self.maps: list[Any] = []
        self.spent: list[float] = []
        self.decided, self.clean = 0, 0
        self.refused: list[str] = []
        self.wrongly: list[str] = []
        self.after: list[str] = []
        self.missed: list[str] = []
        self.untold: list[str] = []

    def add(
        self,
        name: str,
        taken: Taken,
        record: SheetRecord,
        within: dict[int, float],
        spent: float,
    ) -> None:
        """Hold what was read of a picture to what is true of it."""
        if record.refused is not None:
            self.refused.append(f"{name}: {record.refused}")
            return
        self.spent.append(spent)
        true = np.array(taken.grid)
        scale = np.hypot(*(true[0] - true[len(XS) - 1])) / (XS[-1] - XS[0])
        self.maps.append(np.hypot(*(np.array(record.map) - true).T) / scale)
        found = {each.step: each for each in record.points}
        clean = all(each.verdict == "right" for each in taken.points)
        lab = Path(taken.lab).stem
        for point in taken.points:
            read = found.get(point.step)
            where = f"{name} {lab} {record.kind} {point.name} ({point.step})"
            if read is None and point.name[-1] in TRIALS:
                continue
            self.clean += clean
            if read is None:
                self.untold.append(f"{where}: {point.verdict}")
                if point.at is not None:
                    self.placed.append(A3.width)
                    self.labs[lab, False] += 1
                continue
            self.count[lab, point.verdict, read.verdict, read.ask] += 1
            self.decided += clean and not read.ask
            if point.at is not None:
                off = A3.width
                if read.at is not None:
                    off = float(np.hypot(read.at[0] - point.at[0], read.at[1] - point.at[1]))
                self.placed.append(off)
                self.labs[lab, off < 1] += 1
                if off >= 1:
                    asked = ", asked" if read.ask else ""
                    self.missed.append(
                        f"{where}: {point.verdict}, {read.verdict}{asked}, {off:.1f}"
                    )
            if not read.ask and read.verdict != point.verdict:
                told = f"{where}: {point.verdict}, said {read.verdict}"
                (self.after if is_right(point, read, within) else self.wrongly).append(told)
            elif clean and read.ask and point.at is not None and off < 1:
                why = ", ".join(read.doubts)
                self.missed.append(
                    f"{where}: asked ({why}), {read.verdict} at {read.off} of {read.error}"
                )

    def report(self) -> None:
        """Print it."""
        off, residuals = np.array(self.placed), np.concatenate(self.maps)
        near = off[off < 1]
        print(f"refused  {len(self.refused)}, read {len(self.maps)}", *self.refused, sep="\n")
        print(f"map      median {np.median(residuals):.3f} mm,", end=" ")
        print(f"95 % {np.percentile(residuals, 95):.3f} mm")
        print(f"points   {len(off)}, within 1 mm {np.mean(off < 1):.1%},", end=" ")
        print(f"95 % of them within {np.percentile(near, 95):.2f} mm")
        for lab in sorted({lab for lab, _ in self.labs}):
            right, off_it = self.labs[lab, True], self.labs[lab, False]
            print(f"         {lab}: {right} of {right + off_it}")
        share = self.decided / max(self.clean, 1)
        print(f"decided  {self.decided} of {self.clean} on sheets without a mistake, {share:.1%}")
        every = sum(self.count.values())
        print(f"wrongly  {len(self.wrongly)} of {every} by definition", *self.wrongly, sep="\n")
        both = len(self.wrongly) + len(self.after)
        print(
            f"         {both} where a mistake before it makes a point wrong", *self.after, sep="\n"
        )
        wrong = sum(n for (_, true, *_), n in self.count.items() if true == "wrong")
        passed = sum(n for (_, *said), n in self.count.items() if said == ["wrong", "right", False])
        proposed = sum(
            n for (_, *said), n in self.count.items() if said == ["wrong", "wrong", True]
        )
        print(f"mistakes {wrong}: {passed} decided right, {proposed} asked with wrong proposed")
        print(f"seconds  median {np.median(self.spent):.2f}, most {np.max(self.spent):.2f}")
        for name, times in sorted(self.count.items()):
            print(*name[:3], "asked" if name[3] else "decided", times)
        print(f"not told of  {len(self.untold)}, counted as beside", *self.untold, sep="\n")
        print("beside or asked:", *self.missed, sep="\n")


def is_right(true: TruePoint, read: PointReading, within: dict[int, float]) -> bool:
    """Whether a point that was drawn after a mistake lies so near the key that it is right."""
    if true.at is None or read.verdict != "right":
        return False
    return float(np.hypot(true.at[0] - read.key[0], true.at[1] - read.key[1])) <= within[true.step]


def main(
    count: int, labs: list[str], seed: int, keep: Path | None, jobs: int, wrong: Sequence[str]
) -> None:
    """Draw, photograph, read and compare so many sheets."""
    tally = Tally()
    with TemporaryDirectory() as folder, ProcessPoolExecutor(jobs) as executor:
        where = keep or Path(folder)
        where.mkdir(parents=True, exist_ok=True)
        classes = {lab: folder_of(lab, where, seed) for lab in labs}
        list(executor.map(partial(take, classes, where, seed, wrong), range(count)))
        for found in executor.map(partial(read_again, classes, where), range(count)):
            if found is not None:
                tally.add(*found)
    tally.report()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("labs", nargs="*", default=list(LABS))
    parser.add_argument("--seed", type=int, default=23)
    parser.add_argument("-o", type=Path)
    parser.add_argument("-j", type=int, default=1)
    parser.add_argument("--wrong", nargs="+", choices=WRONG, default=[])
    said = parser.parse_args()
    main(said.count, said.labs, said.seed, said.o, said.j, said.wrong)
