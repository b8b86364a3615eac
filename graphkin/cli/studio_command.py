"""The command ``studio``: a page on this computer in which a scene is written and looked at."""

from __future__ import annotations

import gc
from pathlib import Path

import click

from graphkin.cli.local_page import browser_option, port_option, refuse_without, show
from graphkin.cli.options import lang_option

NEEDED = ("bottle", "tomlkit", "waitress")
"""The packages of the extra [studio]."""


@click.command()
@click.argument("name", metavar="[SCENE]", required=False, default="")
@port_option
@browser_option
@lang_option("Language to begin with; the scene's by default. The page lets another be chosen.")
def studio(name: str, port: int, no_browser: bool, lang: str | None) -> None:
    """Write, move and look at a scene in a browser.

    Opens, for this computer alone, a page with the text of SCENE, its mistakes marked where they
    stand, a slider for each parameter, the mechanism, both plans, results, flattest crossings and
    the independent check; all of it follows what is written and moved. Of a lab, its lab.toml
    stands below the scene, and how fair it is to a class is followed as well. Scenes and sheets are
    saved into the current folder, and nothing outside it is read or written. Without SCENE it
    begins with a choice of what to start from: pictures of the labs and of the scenes here, or an
    empty field.

    The page's address holds a token that nobody else knows; it ends with this command (Ctrl+C).

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
    gc.freeze()  # what is loaded stays: a search for garbage during a move passes it over
    show(lambda known: serve(session, port, first, known), no_browser=no_browser)
