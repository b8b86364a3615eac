"""The sheets of two students, as task and as key, written into a folder.

Run it with ``python examples/03_sheets.py FOLDER``; without a folder it makes a temporary one.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import graphkin
from graphkin.documents.sheet_documents import hand_out
from graphkin.writers.files import file_stem, rendered, write_all

STUDENTS = (7, 8)


def write_sheets(student: int, view: str, folder: Path) -> list[Path]:
    """The three documents of one student: velocity, acceleration, calculation."""
    pump = graphkin.load("pump", n=student)
    stem = file_stem(pump.scene.name, {"n": str(student)})
    files: dict[str, bytes] = {}
    for document in hand_out(pump, view=view, language="en"):
        name = f"{stem}-{document.kind}-{view}"
        files |= rendered(name, document.kind, document.pages, ("svg", "pdf"))
    return write_all(folder, files, force=True)


def main() -> None:
    """Write everything and name each file."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(tempfile.mkdtemp(prefix="graphkin-"))
    print(f"sheets in {folder}")
    for student in STUDENTS:
        for view in ("task", "key"):
            for path in write_sheets(student, view, folder):
                print(f"  {path.name:34} {path.stat().st_size / 1024:6.0f} KiB")
    print("print at 100 %: the bar at the top of a sheet is then 100 mm long")


if __name__ == "__main__":
    main()
