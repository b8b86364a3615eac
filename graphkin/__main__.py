"""``python -m graphkin``: the command line."""

from __future__ import annotations

from graphkin.cli.main import main

if __name__ == "__main__":
    main()
