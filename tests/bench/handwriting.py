"""Numbers in the tables of photographed sheets: which cells are cut out, and which are not.

    python -m tests.bench.handwriting 24 --seed 901

Every other cell of each sheet, by chance, holds a number in the hand of tests.reading.hand_letters.
The pictures are those of tests.bench.reading: every eighth a scan, every fourth a hard one.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import cv2
import numpy as np

from graphkin.classroom.printing.edition import read_edition
from graphkin.drawing.marks import Text
from graphkin.reading.cut_outs import written_cells
from graphkin.reading.pictures import Photograph, Unreadable, colours_of, darkest
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, found_sheet, known_code
from graphkin.reading.written_cells import WrittenCell, blank_cells
from tests.bench.reading import LABS, folder_of, shot_of, usual_habits
from tests.reading.camera import photograph, scan
from tests.reading.hand import drawn_sheet, sheets_of, stroke
from tests.reading.hand_letters import writing_of, written


def photographed(folder: Path, i: int, seed: int) -> tuple[bytes, set[WrittenCell], int]:
    """The i-th picture, the cells that hold a number, and the number of all cells."""
    rng = np.random.default_rng([i, seed])
    code = next(iter(read_order(read_edition(folder), Grid()).takers))
    kinds = [each.kind for each in sheets_of(folder, code).drawings]
    kind = kinds[int(rng.integers(len(kinds)))]
    habits = usual_habits(0, rng)
    image = drawn_sheet(folder, code, kind, habits, 1000 * seed + i).image.astype(np.float32)
    ink, hand = np.zeros(image.shape, np.float32), writing_of(rng)
    cells = list(blank_cells(sheets_of(folder, code).task_pages[kind]))
    filled = set()
    for cell, (left, top, right, low) in cells:
        if rng.random() < 0.5:
            number = "".join(rng.choice(list("1234"), int(rng.integers(1, 4))))
            x, y = (left + right) / 2 + rng.normal(), (top + low) / 2 + 1.6 + 0.4 * rng.normal()
            for path in written(Text(x, y, number, "table", 3.5, "middle"), hand, rng):
                stroke(ink, path, habits, rng)
            filled.add(cell)
    drawn = np.clip(image * (1 - cv2.GaussianBlur(ink, (0, 0), 0.8)), 0, 255).astype(np.uint8)
    shot = shot_of(i, rng)
    if i % 8 == 5:
        density = float(rng.choice([150, 200, 300]))
        data = scan(drawn, density, round(shot.turn / 90) * 90 + rng.uniform(-1, 1), i).data
    else:
        data = photograph(drawn, shot, 1000 * seed + i).data
    return data, filled, len(cells)


def main(count: int, seed: int, keep: Path | None) -> None:
    """Print how many cells with and without a number were cut out."""
    cv2.setNumThreads(1)
    right, missed, false, empty, refused = 0, 0, 0, 0, 0
    sizes, spent = list[int](), list[float]()
    with TemporaryDirectory() as kept:
        where = keep or Path(kept)
        where.mkdir(exist_ok=True)
        classes = [folder_of(lab, where, seed) for lab in LABS]
        for i in range(count):
            folder = classes[i % len(classes)]
            data, filled, cells = photographed(folder, i, seed)
            path = where / f"p{i:03}.jpg"
            path.write_bytes(data)
            order = read_order(read_edition(folder), Grid())
            picture = colours_of(Photograph(path.stem, path))
            grey = darkest(picture)
            try:
                found = found_sheet(grey, order, *known_code(grey, order.takers))
            except Unreadable:
                refused += 1
                continue
            start = process_time()
            cuts: list[Any] = written_cells(picture, grey, found.map, found.sheet.page)
            spent.append(process_time() - start)
            sizes += (len(cut) for _, cut in cuts)
            seen = {cell for cell, _ in cuts}
            right += len(seen & filled)
            missed += len(filled - seen)
            false += len(seen - filled)
            empty += cells - len(filled)
            for what, some in (("missed", filled - seen), ("without a number", seen - filled)):
                if some:
                    print(f"{path.name}: {what}: {', '.join(f'{c.name} {c.what}' for c in some)}")
    print(
        f"{count - refused} of {count} pictures; cells with a number: {right} cut out, {missed} not"
    )
    print(f"cells without a number: {false} of {empty} cut out")
    print(
        f"cut-outs: {np.median(sizes) / 1e3:.1f} kB in the median, {max(sizes) / 1e3:.1f} at most"
    )
    print(f"processor time a picture: {np.median(spent):.2f} s in the median")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=901)
    parser.add_argument("-o", type=Path)
    said = parser.parse_args()
    main(said.count, said.seed, said.o)
