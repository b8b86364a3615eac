"""Whether small crosses on the fields would help to flatten hard photographs of a sheet.

    python -m tests.bench.fiducials 24 [--seed 23]

Blank sheets of the pump, half of them with twelve crosses of 6 mm on the fields, are photographed
with cropped edges, a thumb on the frame, paper that ripples by half a millimetre, and all of that
at once: the same pictures with and without. Prints how many are refused and how far the map is off.
"""

from __future__ import annotations

import argparse
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import cv2
import numpy as np
from msgspec.structs import replace

from graphkin.classroom.grading.class_folder import open_class
from graphkin.drawing.areas import AREA
from graphkin.drawing.marks import LineMark, Page
from graphkin.reading.codes import codes_in
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, task_pages
from graphkin.reading.registration import Registration, SheetSearch
from tests.bench.reading import XS, YS, folder_of
from tests.reading.camera import Shot, photograph
from tests.reading.hand import DENSITY, printed, sheets_of

CASES = {
    "cropped": {"fill": 1.04},
    "thumb": {"thumb": True},
    "ripple": {"ripple": 0.5},
    "all": {"fill": 1.02, "thumb": True, "ripple": 0.5},
}
HALF = 3.0
"""Half the size of a cross, in mm."""
WIDTH = 0.25


def crosses() -> list[LineMark]:
    """The crosses: four across and three down, as far from the fields' edges as from one another
    at least.
    """
    left, top, right, bottom = AREA
    marks = []
    for i, j in product(range(4), range(3)):
        x = left + 12 + i * (right - left - 24) / 3
        y = top + 12 + j * (bottom - top - 24) / 2
        marks += [
            LineMark(x - HALF, y, x + HALF, y, "panel"),
            LineMark(x, y - HALF, x, y + HALF, "panel"),
        ]
    return marks


def found(image: Any, page: Page, shot: Shot, seed: int) -> tuple[Registration | None, Any]:
    """The map of a photographed page, none without a code; how far it is off at a grid, in mm."""
    taken = photograph(image, shot, seed)
    grey = cv2.imdecode(np.frombuffer(taken.data, np.uint8), cv2.IMREAD_GRAYSCALE)
    codes = codes_in(grey)
    if not codes:
        return None, None
    result = SheetSearch(grey, codes[0].corners).registered(page)
    places = np.stack(np.meshgrid(XS, YS), axis=-1).reshape(-1, 2)
    true = taken.where(places)
    scale = np.hypot(*(true[0] - true[len(XS) - 1])) / (XS[-1] - XS[0])
    if result is None:
        return None, None
    return result, np.hypot(*(result.map(places) - true).T) / scale


def main(count: int, seed: int) -> None:
    """Photograph so many blank sheets, with and without, and compare."""
    cv2.setNumThreads(1)
    with TemporaryDirectory() as where:
        folder = folder_of("pump", Path(where), seed)
        code = next(iter(read_order(open_class(folder), Grid()).variants))
        kind, page = task_pages(sheets_of(folder, code))[0]
        plain = printed(folder, code, kind)
        marked = plain.copy()
        for mark in crosses():
            ends = np.array([[mark.x1, mark.y1], [mark.x2, mark.y2]]) * DENSITY - 0.5
            first, last = np.round(ends * 16).astype(int).tolist()
            cv2.line(marked, first, last, 60, round(WIDTH * DENSITY), cv2.LINE_AA, 4)
        crossed = replace(page, marks=[*page.marks, *crosses()])
        for case, more in CASES.items():
            for name, image, own in (("without", plain, page), ("with", marked, crossed)):
                offs, refused = [], 0
                for i in range(count // len(CASES)):
                    rng = np.random.default_rng([seed, i])
                    hard = {"tilt": rng.uniform(0, 20), "bow": rng.uniform(0, 4)}
                    hard |= {"k1": rng.uniform(-0.06, 0.06), "turn": rng.uniform(-5, 5)}
                    shot = Shot(**{"fill": 0.92, **hard, **more})
                    result, off = found(image, own, shot, 100 * seed + i)
                    if result is None or result.refused:
                        refused += 1
                    else:
                        offs.append(off)
                every = np.concatenate(offs) if offs else np.array([np.nan])
                told = f"{np.median(every):.3f} mm, 95 % {np.percentile(every, 95):.3f} mm"
                print(f"{case:8} {name:8} refused {refused} of {count // len(CASES)}, {told}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=23)
    said = parser.parse_args()
    main(said.count, said.seed)
