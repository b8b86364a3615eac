"""The command line: ``graphkin`` and ``python -m graphkin``."""

from __future__ import annotations

import gc
import os

GARBAGE = 200_000
"""The number of new objects between garbage collections.

With the default of 700, collections take a seventh of the time of ``graphkin solve pump``, partly
before the command is known; with 50 000 one is left, which takes a fortieth.
"""


def main() -> None:
    """Run the command line and exit with its status."""
    gc.set_threshold(GARBAGE)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small matrices: threads are slower
    from graphkin.cli.main import app
    from graphkin.cli.options import end

    try:
        app(prog_name="graphkin")
    except SystemExit as left:
        end(left)


if __name__ == "__main__":
    main()
