"""What the commands share whose page is for this computer alone: studio and desk."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib.util import find_spec
from typing import TYPE_CHECKING

import click

from graphkin.cli.options import current, tell

if TYPE_CHECKING:
    from graphkin.studio.server import Served

port_option = click.option(
    "--port",
    metavar="N",
    type=click.IntRange(0, 65535),
    default=0,
    help="Port to listen at; a free one by default.",
)
"""The port of a page on this computer."""
browser_option = click.option(
    "--no-browser", is_flag=True, help="Only print the address, open no browser."
)
"""Leave to open no browser."""


def refuse_without(what: str, extra: str, needed: Iterable[tuple[str, str]]) -> None:
    """Raise UsageError where an extra is not installed: modules, each with its package."""
    if missing := [package for module, package in needed if not find_spec(module)]:
        raise click.UsageError(
            f"{what} needs {' and '.join(missing)}: pip install '.[{extra}]' where graphkin was "
            f"installed from, or pip install 'graphkin[{extra}]'",
            current(),
        )


def show(listen: Callable[[Callable[[], None]], Served], *, no_browser: bool) -> None:
    """Print the address of a page, open it, and serve it until the command ends.

    ``listen`` begins to listen, and is told what to do when the page is asked for.
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
