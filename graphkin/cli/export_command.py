"""The command that writes a mechanism as a function of another language: export."""

from __future__ import annotations

from pathlib import Path

import click

from graphkin.cli.options import force_option, mechanism_of, say, scene_argument, tell


@click.command()
@scene_argument
@click.option(
    "--to",
    "language",
    type=click.Choice(["python", "javascript", "c"]),
    required=True,
    help="The language of the function.",
)
@click.option(
    "-o",
    "--output",
    "file",
    metavar="FILE",
    type=click.Path(path_type=Path, dir_okay=False),
    help="File to write; without it, the function is printed.",
)
@force_option
def export(
    name: str, settings: tuple[str, ...], language: str, file: Path | None, force: bool
) -> None:
    """Write the motion as one function of the driver's coordinate and the parameters.

    The function needs only the standard library of its language. It gives positions, velocities and
    accelerations of all points, and angular velocities and accelerations of all links, in SI units.
    With several drivers it has the coordinate of each, and with a law of time it has the time.

    Mechanisms with groups of class III or higher, and those whose wheels are turned by pins alone,
    cannot be written as one line of formulas.

    \b
    Examples:
      graphkin export pump --to python -o pump.py
      graphkin export pump --to c -o pump.c
    """
    from graphkin.web.formula import LANGUAGES, formula_of
    from graphkin.writers.files import write_apart

    source = LANGUAGES[language](formula_of(mechanism_of(name, settings)))
    if file is None:
        say(source.rstrip())
    else:
        tell([str(write_apart(file, source.encode(), name, force))])
