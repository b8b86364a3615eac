"""The commands ``manual`` and ``help``: the manual as a web site, and what it says about a key."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import click

from graphkin.cli.options import FolderType, current, force_option, say_aside, tell
from graphkin.cli.studio_command import browser_option
from graphkin.scene.findings import near_name

LINK = re.compile(r"!?\[([^]]*)\]\([^)]*\)")
"""A link or a picture in Markdown, with its words."""
INDENT = 12
"""The column in which the meaning of a key begins."""


@click.command()
@click.option(
    "--write",
    metavar="DIR",
    type=FolderType(path_type=Path),
    help="Write the site into DIR, made if it is missing, and do not open it.",
)
@click.option(
    "--moving", is_flag=True, help="With --write: add the page that moves for each shipped scene."
)
@browser_option
@force_option
def manual(write: Path | None, moving: bool, no_browser: bool, force: bool) -> None:
    """Open the manual in a browser.

    Makes the manual as a web site that needs no network, in a new temporary folder, prints the
    address of its first page, and opens it. With --write, writes the site into a folder, from which
    you can copy it to any web server. With --moving, each scene of the gallery has the page that
    draws and moves it: some minutes of work, and 40 MB.

    \b
    Examples:
      graphkin manual
      graphkin manual --write manual
      graphkin manual --write manual --moving
    """
    from graphkin.manual.site import moving_page, moving_pages, nowhere, site
    from graphkin.writers.files import refuse_folder, write_all

    if moving and write is None:
        raise click.UsageError("--moving needs --write DIR", current())
    files = dict(site(moving_page if moving else nowhere))
    if moving and write is not None:
        refuse_folder(write, files, force=force)
        files |= dict(moving_pages(say_aside))
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
    """Explain a key of a scene or of a lab, or a command.

    Prints what the manual says about KEY in each table that may hold it: meaning, default and
    example. Without KEY, prints all keys. For a command, prints its --help.

    \b
    Examples:
      graphkin help slides
      graphkin help apart
      graphkin help sheet
    """
    from graphkin.manual.pages import explained

    found = explained()
    if not key:
        tell(click.wrap_text(" ".join(sorted(found)), 88).splitlines())
        return
    commands = current().find_root().command
    assert isinstance(commands, click.Group)
    command = commands.get_command(current(), key)
    if key not in found:
        if command is None:
            near = near_name(key, [*found, *commands.list_commands(current())])
            hint = f"did you mean {near}?" if near else "graphkin help lists all keys"
            raise click.UsageError(f"{key!r} is not a key; {hint}", current())
        with command.make_context(f"graphkin {key}", [], resilient_parsing=True) as context:
            tell(command.get_help(context).splitlines())
        return
    for number, place in enumerate(found[key]):
        blank = [""] if number else []
        tell([*blank, place.where, *(line.rstrip() for line in explanation(place.lines))])
    also = f"; graphkin {key} --help explains the command" if command is not None else ""
    tell(["", f"graphkin manual opens the whole manual{also}."])


def explanation(lines: Iterable[str]) -> Iterator[str]:
    """Lines of Markdown for a terminal; a row of a table as meaning, default and example."""
    from graphkin.manual.pages import cells

    heads: list[str] = []
    for line in (plain(line) for line in lines if not line.startswith("```")):
        if not line.startswith("|"):
            yield f"  {line}"
        elif set(line) <= set("|- "):
            continue
        elif not heads:
            heads = cells(line)
        else:
            own, meaning, *rest = cells(line)
            said = zip(heads[2:], rest, strict=True)
            more = [f"{head}: {cell}" for head, cell in said if cell != "–"]
            blank = " " * max(len(own) + 4, INDENT)
            yield from click.wrap_text(meaning, 88, f"  {own:{INDENT - 4}}  ", blank).splitlines()
            yield blank + "; ".join(more)


def plain(line: str) -> str:
    """A line of Markdown without addresses of links and without marks of code."""
    return LINK.sub(r"\1", line).replace("**", "").replace("`", "")
