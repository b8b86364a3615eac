"""How much the small crosses in the fields help to flatten hard photographs of a sheet.

    python -m tests.bench.fiducials 24 [--seed 23]

Blank sheets of the pump, with and without their crosses, are photographed with cropped edges, a
thumb on the frame, paper that ripples by half a millimetre, and all of that at once: the same
pictures twice. Prints how many are refused and how far the map is off.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import cv2
import numpy as np

from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.personal import without_crosses
from graphkin.drawing.marks import Page
from graphkin.reading.codes import codes_in
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid
from graphkin.reading.registration import Registration, SheetSearch
from tests.bench.reading import XS, YS, folder_of
from tests.reading.camera import Shot, photograph
from tests.reading.hand import printed_page, sheets_of

CASES = {
    "cropped": {"fill": 1.04},
    "thumb": {"thumb": True},
    "ripple": {"ripple": 0.5},
    "all": {"fill": 1.02, "thumb": True, "ripple": 0.5},
}


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
        code = next(iter(read_order(read_edition(folder), Grid()).takers))
        page = next(iter(sheets_of(folder, code).task_pages.values()))
        both = {"without": without_crosses(page), "with": page}
        images = {name: printed_page(own) for name, own in both.items()}
        for case, more in CASES.items():
            for name, image in images.items():
                offs, refused = [], 0
                for i in range(count // len(CASES)):
                    rng = np.random.default_rng([seed, i])
                    hard = {"tilt": rng.uniform(0, 20), "bow": rng.uniform(0, 4)}
                    hard |= {"k1": rng.uniform(-0.06, 0.06), "turn": rng.uniform(-5, 5)}
                    shot = Shot(**{"fill": 0.92, **hard, **more})
                    result, off = found(image, page, shot, 100 * seed + i)
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
