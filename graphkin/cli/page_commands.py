"""The commands for pages on this computer: ``studio``, ``manual`` and ``help``."""

from __future__ import annotations

import gc
import re
from collections.abc import Callable, Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.folder_options import FolderType
from graphkin.cli.options import (
    command,
    current,
    force_option,
    lang_option,
    say_aside,
    tell,
)
from graphkin.scene.findings import near_name

if TYPE_CHECKING:
    from graphkin.studio.server import Served

port_option = click.option(
    "--port",
    metavar="N",
    type=click.IntRange(0, 65535),
    default=0,
    help="Port to listen on; a free one by default.",
)
"""The option for the port of a local page."""
browser_option = click.option(
    "--no-browser", is_flag=True, help="Only print the address; open no browser."
)
"""The option to open no browser."""


def refuse_without(what: str, extra: str, needed: Iterable[tuple[str, str]]) -> None:
    """Raise UsageError if an extra is not installed: modules, each with its package."""
    if missing := [package for module, package in needed if not find_spec(module)]:
        raise click.UsageError(
            f"{what} needs {' and '.join(missing)}: pip install '.[{extra}]' where graphkin was "
            f"installed from, or pip install 'graphkin[{extra}]'",
            current(),
        )


def show(listen: Callable[[Callable[[], None]], Served], *, no_browser: bool) -> None:
    """Print the address of a page, open the page, and serve it until the command ends.

    ``listen`` starts the server; it receives the function to call when the page is requested.
    """
    from graphkin.studio.server import Redirect

    redirect = Redirect()
    served = listen(redirect.remove)
    tell([served.address])
    try:
        if not no_browser:
            import webbrowser

            webbrowser.open(redirect.write(served.address))
        served.server.run()
    finally:
        redirect.remove()


NEEDED = ("bottle", "tomlkit", "waitress")
"""The packages of the extra [studio]."""


@command()
@click.argument("name", metavar="[SCENE]", required=False, default="")
@port_option
@browser_option
@lang_option("Initial language; the scene's by default. You can change it on the page.")
def studio(name: str, port: int, no_browser: bool, lang: str | None) -> None:
    """Write, move and view a scene in a browser.

    Opens a page that only this computer can reach. It shows the text of SCENE with its mistakes
    marked in place, and a slider for each parameter. It draws the mechanism and both plans, and
    lists results, flattest crossings and the independent check. Everything follows what you write
    and move. For a lab, the page also shows its lab.toml below the scene, and how fair the lab is
    to a class.

    Scenes and sheets are saved into the current folder; nothing outside it is read or written.
    Without SCENE, the page first offers pictures of the labs and of the scenes in the folder, or an
    empty field.

    The page's address holds a secret token. The page ends with this command (Ctrl+C).

    \b
    Examples:
      graphkin studio
      graphkin studio pump --lang en
      graphkin studio crank-lab
      graphkin studio mine.toml --no-browser --port 8080
    """
    refuse_without("the studio", "studio", ((name, name) for name in NEEDED))
    from graphkin.studio.folder import Folder
    from graphkin.studio.server import serve
    from graphkin.studio.session import Session

    session = Session(Folder(Path()), lang)
    first = session.address_of(name) or {"gallery": "yes"}
    gc.collect()
    gc.freeze()  # garbage collection during a move then skips the loaded modules
    show(lambda known: serve(session, port, first, known), no_browser=no_browser)


LINK = re.compile(r"!?\[([^]]*)\]\([^)]*\)")
"""A link or a picture in Markdown, with its words."""
INDENT = 12
"""The column in which the meaning of a key begins."""


@command()
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


@command("help")
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
