"""Everything that the program gives, against what is committed: ``python -m tests.golden``."""

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from tests.golden.kept import Items, differences, kept, stored_of, write
from tests.golden.works import outputs, works


def main() -> int:
    """Make everything, tell what changed, and write it down unless that is only to be checked."""
    parser = argparse.ArgumentParser("python -m tests.golden", description=__doc__)
    parser.add_argument(
        "--check", action="store_true", help="write nothing down; status 1 if changed"
    )
    parser.add_argument("--only", nargs="+", metavar="NAME", choices=works(), help="these alone")
    parser.add_argument("-o", type=Path, metavar="DIR", help="write all outputs there, for diff -r")
    parser.add_argument("-n", type=int, default=os.cpu_count(), help="processes at once")
    options, count = parser.parse_args(), 0
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    chosen = options.only or list(works())
    with ProcessPoolExecutor(options.n) as pool:
        for subject, fresh in zip(chosen, pool.map(partial(made, options.o), chosen), strict=True):
            before = Items()
            for work in works()[subject]:
                before |= stored_of(subject, work)
            for line in differences(before, fresh):
                print(line, flush=True)
                count += 1
            if not options.check:
                write(subject, fresh)
    print(f"{count} items changed")
    return int(options.check and count > 0)


def made(folder: Path | None, subject: str) -> Items:
    """What is kept of a subject; its outputs go into a folder of its own."""
    found = Items()
    for work in works()[subject]:
        files = outputs(subject, work)
        for name, data in files.items() if folder else ():
            path = folder / subject / work / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        found |= kept(subject, work, files)
    return found


if __name__ == "__main__":
    sys.exit(main())
