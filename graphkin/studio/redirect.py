"""A file readable by this user alone that redirects a browser to the page.

Every user of a computer can read the command line of a browser, so it names this file rather than
the address with its token.
"""

from __future__ import annotations

from html import escape
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={address}">
<title>graphkin</title>
</head>
<body><a href="{address}">graphkin studio</a></body>
</html>
"""


class Redirect:
    """A redirect that exists from its writing until the page is requested."""

    def __init__(self) -> None:
        self.folder: Path | None = None

    def write(self, address: str) -> str:
        """Write the file into a folder that only this user may open; return its address."""
        self.folder = Path(mkdtemp(prefix="graphkin-"))
        path = self.folder / "studio.html"
        path.write_text(PAGE.format(address=escape(address)), encoding="utf-8")
        return path.as_uri()

    def remove(self) -> None:
        """Remove the file, if it still exists."""
        folder, self.folder = self.folder, None
        if folder:
            rmtree(folder, ignore_errors=True)
