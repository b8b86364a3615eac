"""The commands ``manual`` and ``help``: the manual as a web site, and what it says about a key."""

from __future__ import annotations

import re
from pathlib import Path

import click

from graphkin.cli.options import FolderType, current, force_option, nearest, tell
from graphkin.cli.studio_command import browser_option

LINK = re.compile(r"!?\[([^]]*)\]\([^)]*\)")
"""A link or a picture in Markdown, with its words."""


@click.command()
@click.option(
    "--write",
    metavar="DIR",
    type=FolderType(path_type=Path),
    help="Write the site into DIR, made if it is missing, and do not open it.",
)
@browser_option
@force_option
def manual(write: Path | None, no_browser: bool, force: bool) -> None:
    """Open the manual in a browser.

    Makes the manual as a web site that needs no network, in a new temporary folder, prints the
    address of its first page, and opens it. With --write, writes the site into a folder, from which
    you can copy it to any web server.

    \b
    Examples:
      graphkin manual
      graphkin manual --write manual
    """
    from graphkin.manual.site import site
    from graphkin.writers.files import write_all

    files = dict(site())
    if write is not None:
        write_all(write, files, force)
        tell([str(write / "index.html")])
        return
    import tempfile
    import webbrowser

    folder = Path(tempfile.mkdtemp(prefix="graphkin-manual-"))
    write_all(folder, files, force=False)
    address = (folder / "index.html").as_uri()
    tell([address])
    if not no_browser:
        webbrowser.open(address)


@click.command("help")
@click.argument("key", metavar="[KEY]", required=False, default="")
def help_on(key: str) -> None:
    """Explain a key of a scene or of a lab.

    Prints what the manual says about KEY in each table that may hold it: meaning, default and
    example. Without KEY, prints all keys. For a command, use its own --help.

    \b
    Examples:
      graphkin help slides
      graphkin help apart
    """
    from graphkin.manual.pages import explained

    found = explained()
    if not key:
        tell(click.wrap_text(" ".join(sorted(found)), 88).splitlines())
        return
    if key not in found:
        raise click.UsageError(f"{key!r} is not a key; {nearest(key, [*found])}", current())
    for number, place in enumerate(found[key]):
        blank = [""] if number else []
        tell([*blank, place.where, *(f"  {plain(line)}".rstrip() for line in place.lines)])
    tell(["", "graphkin manual opens the whole manual."])


def plain(line: str) -> str:
    """A line of Markdown for a terminal: links without addresses, rows without bars."""
    line = LINK.sub(r"\1", line)
    if line.startswith("|"):
        line = "" if set(line) <= set("|- ") else "  ".join(line.strip("| ").split(" | "))
    return line.replace("**", "").replace("`", "")
