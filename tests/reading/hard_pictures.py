"""Three hard photographs as they were read and one that is refused, as a picture for the manual.

    python -m tests.reading.hard_pictures FOLDER -o graphkin/manual/pictures/hard-photographs.jpg

FOLDER is what ``python -m tests.bench.reading N -o FOLDER`` keeps.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from textwrap import wrap
from typing import Any

import cv2
import msgspec
import numpy as np

from graphkin.classroom.printing.edition import read_edition
from graphkin.reading.marked_drawing import colour_of
from graphkin.reading.pictures import Photograph
from graphkin.reading.read_run import read_order
from graphkin.reading.read_sheet import Grid, SheetRead, read_one
from tests.bench.reading import Taken

WIDE, HIGH = 460, 345
SIGN = cv2.FONT_HERSHEY_SIMPLEX


def shown(data: bytes, read: SheetRead) -> Any:
    """A photograph above what was read of it."""
    taken = cv2.resize(picture_of(data), (WIDE, HIGH), interpolation=cv2.INTER_AREA)
    flat = np.full((HIGH, WIDE, 3), 255, np.uint8)
    if read.record.refused is not None:
        words = wrap(read.record.refused, 44)
        for i, line in enumerate(("refused:", *words)):
            cv2.putText(flat, line, (14, 150 + 26 * i), SIGN, 0.42, (24, 24, 200), 1, cv2.LINE_AA)
        return np.vstack([taken, flat])
    sheet = picture_of(read.picture)
    density = sheet.shape[1] / 420
    for point in read.record.points:
        if point.at is not None:
            red, green, blue = bytes.fromhex(colour_of(point)[1:])
            x, y = (round(part * density) for part in point.at)
            cv2.circle(sheet, (x, y), 22, (blue, green, red), 8, cv2.LINE_AA)
    high = round(WIDE * 297 / 420)
    flat[(HIGH - high) // 2 :][:high] = cv2.resize(
        sheet, (WIDE, high), interpolation=cv2.INTER_AREA
    )
    return np.vstack([taken, flat])


def picture_of(data: bytes) -> Any:
    """The picture of a JPEG."""
    return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)


def main(folder: Path, names: list[str], out: Path) -> None:
    """Read some photographs of a bench and put them side by side."""
    columns = []
    for name in names:
        path = folder / f"{name}.jpg"
        taken = msgspec.json.decode(path.with_suffix(".truth.json").read_bytes(), type=Taken)
        order = read_order(read_edition(folder / Path(taken.lab).stem), Grid())
        columns.append(shown(path.read_bytes(), read_one(order, Photograph(name, path), "")))
    gap = np.full((2 * HIGH, 12, 3), 255, np.uint8)
    row = [part for column in columns for part in (column, gap)][:-1]
    cv2.imwrite(str(out), np.hstack(row), [cv2.IMWRITE_JPEG_QUALITY, 72])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", default=["p007", "p091", "p023", "p043"])
    parser.add_argument("-o", type=Path, required=True)
    said = parser.parse_args()
    main(said.folder, said.names, said.o)
