"""Bundle the scripts of the pages: ``python -m tests.scripts`` (needs Node and its tools)."""

from __future__ import annotations

import sys

from graphkin.web.offline_page import WEB
from tests.scripts.actions import modules
from tests.scripts.node import HERE, missing_tools, ran


def main() -> None:
    """Write the actions from the registry, then bundle all scripts."""
    for name, text in modules().items():
        (WEB / name).write_text(text, encoding="utf-8")
    if missing_tools():
        sys.exit(missing_tools())
    made = ran("node", str(HERE / "build.js"))
    sys.exit(made.stderr if made.returncode else 0)


if __name__ == "__main__":
    main()
