"""A class printed by all cores, against one process and against a loop over single scenes.

``python -m tests.bench.printing [STUDENTS]`` prints the seconds in which task sheets, forms and
keys come of 300 students' pumps on two processes, on one, and in the plain loop that calls for each
student what ``graphkin sheet`` calls, once for the task and once for the key, and writes one PDF of
each sheet; and the memory of the largest worker.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from time import perf_counter

from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.printing.print_run import (
    Means,
    PrintOrder,
    PrintRequest,
    StudentSheets,
    make,
    print_class,
)
from graphkin.classroom.printing.workers import CHUNK, processes
from graphkin.classroom.roster.students import Student
from graphkin.classroom.variants.assign import assigned
from graphkin.classroom.variants.class_files import write_class
from graphkin.documents.sheet_documents import hand_out
from graphkin.mechanism import load
from graphkin.writers.files import rendered

LAB = "pump"
STUDENTS = 300
LIMIT = 60.0
"""Seconds that they may take on two cores."""
MEMORY = 300.0
"""Megabytes that a worker may take."""
SINGLES = 15
"""Students of the plain loop, from which that of the whole class is reckoned."""


def class_of(count: int, folder: Path) -> Path:
    """A class folder of so many students."""
    lab = read_lab(LAB)
    roster = folder / "roster.csv"
    roster.write_text("id\n", encoding="utf-8")
    students = [
        Student(i + 2, f"{i:05d}", 1 + i % 30, f"Ștefan Pop {i}", "331") for i in range(count)
    ]
    write_class(folder / "class", lab, assigned(lab, students), roster, force=False)
    return folder / "class"


def seconds(count: int, jobs: int) -> float:
    """Seconds in which a class is printed from nothing by so many processes."""
    with tempfile.TemporaryDirectory() as folder:
        made = class_of(count, Path(folder))
        start = perf_counter()
        outcome = print_class(
            read_edition(made), PrintRequest(), Means(jobs), lambda done, total: None
        )
        assert outcome.made == count
        return perf_counter() - start


def loop(count: int) -> float:
    """Seconds of the plain loop over single scenes for so many students."""

    def one(number: int) -> None:
        for view in ("task", "key"):
            for part in hand_out(load(LAB, n=number), view=view):
                rendered(f"{part.kind}-{view}", part.kind, part.pages, ("pdf",))

    one(30)
    start = perf_counter()
    for i in range(SINGLES):
        one(1 + 2 * i)
    return (perf_counter() - start) / SINGLES * count


def memory(count: int) -> float:
    """Megabytes that a worker has taken when it has made so many students' files."""
    with tempfile.TemporaryDirectory() as folder:
        edition = read_edition(class_of(count, Path(folder)))
    order = PrintOrder(edition.lab, edition.scene, "ro", "colour")
    parts = (("task", "pdf"), ("key", "pdf"))
    wanted = [StudentSheets(each, each.student.id, parts) for each in edition.takers]
    with processes(1) as pool:
        return pool.submit(worked, order, wanted).result()


def worked(order: PrintOrder, wanted: list[StudentSheets]) -> float:
    """What a worker does, and its largest memory in megabytes."""
    import resource

    for start in range(0, len(wanted), CHUNK):
        make(order, wanted[start : start + CHUNK])
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def table(count: int = STUDENTS) -> str:
    """All rows as one text."""
    plain = loop(count)
    rows = [
        ("loop over single scenes", plain),
        ("one process", seconds(count, 1)),
        ("two processes", seconds(count, 2)),
    ]
    lines = [f"{count} students' task sheets, forms and keys (limit {LIMIT:g} s on two cores)", ""]
    lines += [f"{name:28} {time:7.1f} s {time / plain:6.2f} × the loop" for name, time in rows]
    lines.append(f"{'memory of a worker':28} {memory(count // 2):7.0f} MB (limit {MEMORY:g} MB)")
    return "\n".join(lines)


if __name__ == "__main__":
    print(table(int(sys.argv[1]) if len(sys.argv) > 1 else STUDENTS))
