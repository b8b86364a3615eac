"""The command ``studio``: a local web page to write and view a scene."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.options import current, lang_option, tell

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
    from graphkin.studio.redirect import Redirect

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


@click.command()
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
