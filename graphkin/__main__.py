"""``graphkin``, and ``python -m graphkin``: the command line."""

from __future__ import annotations

import gc
import os

GARBAGE = 50_000
"""New objects after which garbage is looked for: at 700, as usual, that takes a seventh of the time
of ``graphkin solve pump``, some of it before a command is known."""


def main() -> None:
    """Run the command line and leave with its status."""
    gc.set_threshold(GARBAGE)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # our matrices are small, its threads slow
    from graphkin.cli.main import app
    from graphkin.cli.options import end

    try:
        app(prog_name="graphkin")
    except SystemExit as left:
        end(left)


if __name__ == "__main__":
    main()
