"""How well drawings are read: photographs of simulated students of four labs, against their truth.

    python -m tests.bench.reading 120 [-o FOLDER]

A third of the sheets have a mistake, a twelfth lacks a point; every fourth picture is hard. Prints
how far the map is off, where points are placed, how much is decided, and how much of it wrongly.
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from click.testing import CliRunner

from graphkin.classroom.grading.class_folder import open_class
from graphkin.cli.main import app
from graphkin.reading.paper_map import HALF
from graphkin.reading.pictures import Photograph
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, read_one
from tests.reading.camera import Shot, photograph
from tests.reading.hand import Habits, drawn_sheet, sheets_of

LABS = {
    "pump": (3, 7, 12, 20),
    "slotted-lever": (4, 7, 12, 21),
    "offset-slider-crank": (3, 8, 13, 19),
    "tests/scenes/reading/class-three": (7, 10, 13, 18),
}
"""The labs, one with Coriolis and one of class III, and the numbers of their students."""
XS, YS = tuple(np.linspace(22, 408, 17).tolist()), tuple(np.linspace(12, 285, 13).tolist())
TURNS = (0.0, 90.0, 180.0, 270.0)


def folder_of(lab: str, numbers: tuple[int, ...], where: Path) -> Path:
    """The class folder of a lab with some students."""
    rows = "".join(f"{n};{n:04};Student {n}\n" for n in numbers)
    (where / "class.csv").write_text(f"Nr.;Matricol;Nume\n{rows}", encoding="utf-8")
    out = where / Path(lab).name
    words = ["variants", lab, where / "class.csv", "-o", out, "--force"]
    CliRunner().invoke(app, [str(word) for word in words])
    return out


def habits_of(i: int, rng: Any) -> Habits:
    """How the i-th student draws."""
    return Habits(
        point=rng.uniform(0.25, 0.5),
        line=rng.uniform(0.25, 0.5),
        grey=rng.uniform(0.3, 0.75),
        width=rng.uniform(0.25, 0.4),
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
    )


def main(count: int, keep: Path | None) -> None:
    """Draw, photograph, read and compare so many sheets."""
    tally, placed, maps, spent = Counter[Any](), [], [], []
    asked, refused, wrongly = [0, 0], [], []
    with TemporaryDirectory() as folder:
        where = keep or Path(folder)
        where.mkdir(exist_ok=True)
        classes = {lab: folder_of(lab, numbers, where) for lab, numbers in LABS.items()}
        orders = {lab: read_order(open_class(path), Grid(XS, YS)) for lab, path in classes.items()}
        places = np.stack(np.meshgrid(XS, YS), axis=-1).reshape(-1, 2)
        for i in range(count):
            if i and i % 20 == 0 and maps:
                report(tally, placed, maps, spent, asked, refused, wrongly)
            rng = np.random.default_rng([i, 23])
            lab = list(LABS)[i % len(LABS)]
            variants = list(orders[lab].variants)
            code = variants[(i // len(LABS)) % len(variants)]
            kinds = [each.kind for each in sheets_of(classes[lab], code).drawings]
            kind = kinds[int(rng.integers(len(kinds)))]
            habits = habits_of(i, rng)
            try:
                drawing = drawn_sheet(classes[lab], code, kind, habits, i)
            except AssertionError:
                continue
            taken = photograph(drawing.image, shot_of(i, rng), i)
            path = where / f"p{i:03}.jpg"
            path.write_bytes(taken.data)
            record = read_one(orders[lab], Photograph(path.stem, path), "").record
            if record.refused is not None:
                refused.append(f"{path.stem}: {record.refused}")
                continue
            spent.append(record.seconds)
            true = taken.where(places)
            scale = np.hypot(*(true[0] - true[len(XS) - 1])) / (XS[-1] - XS[0])
            maps.append(np.hypot(*(np.array(record.map) - true).T) / scale)
            found = {each.step: each for each in record.points}
            clean = all(each.verdict == "right" for each in drawing.points)
            for point in drawing.points:
                read = found.get(point.step)
                if read is None:
                    continue
                tally[Path(lab).name, point.verdict, read.verdict, read.ask] += 1
                if point.at is not None:
                    off = 2 * HALF
                    if read.at is not None:
                        off = float(np.hypot(read.at[0] - point.at[0], read.at[1] - point.at[1]))
                    placed.append(off)
                asked[0] += clean and not read.ask
                asked[1] += clean
                if not read.ask and read.verdict != point.verdict:
                    told = f"{point.verdict}, said {read.verdict}"
                    wrongly.append(f"{path.stem} {Path(lab).name} {point.name}: {told}")
    report(tally, placed, maps, spent, asked, refused, wrongly)


def report(
    tally: Any, placed: Any, maps: Any, spent: Any, asked: Any, refused: Any, wrongly: Any
) -> None:
    """Print what came of it."""
    off, every = np.array(placed), np.concatenate(maps)
    near = off[off < 1]
    print(f"refused {len(refused)}, read {len(maps)}", *refused, sep="\n")
    print(f"map      median {np.median(every):.3f} mm, 95 % {np.percentile(every, 95):.3f} mm")
    print(f"points   {len(off)}, within 1 mm {np.mean(off < 1):.1%},", end=" ")
    print(f"95 % of them within {np.percentile(near, 95):.2f} mm")
    print(f"decided  {asked[0]} of {asked[1]} on sheets without a mistake")
    print(f"wrongly  {len(wrongly)} of {sum(tally.values())}", *wrongly, sep="\n")
    print(f"seconds  median {np.median(spent):.2f}, most {np.max(spent):.2f}")
    for name, times in sorted(tally.items()):
        print(*name[:3], "asked" if name[3] else "decided", times)


if __name__ == "__main__":
    where = Path(sys.argv[sys.argv.index("-o") + 1]) if "-o" in sys.argv else None
    main(int(sys.argv[1]), where)
