"""The command ``import``: a mechanism of another program as a scene."""

from __future__ import annotations

from pathlib import Path

import click

from graphkin.cli.options import READING, complain, current, force_option, tell


@click.command("import")
@click.argument("given", metavar="FILE|LINK")
@click.option(
    "-o",
    "--output",
    metavar="SCENE",
    type=click.Path(path_type=Path),
    help="The scene file to write; without it the scene is printed.",
)
@force_option
def import_scene(given: str, output: Path | None, force: bool) -> None:
    """Write a mechanism of another program as a scene.

    FILE is a .pmks file of PMKS+, a .linkage2 file of Linkage, a .json file of pylinkage, or a
    text with an expression M[J[…], …] of Pyslvs. LINK is an address with which PMKS+ or the
    older PMKS shares a mechanism, in quotes; it is read, never opened. The scene has the
    closure that is nearest to the drawing. What a scene cannot hold is named on standard error,
    and in comments at the head of the scene.

    \b
    Examples:
      graphkin import crank.linkage2 -o crank.toml
      graphkin import shared.pmks
    """
    from graphkin.importing.formats import LINK, content, imported
    from graphkin.importing.scene_text import scene_text
    from graphkin.writers.files import write_apart

    text = content(given)
    current().meta[READING] = given if LINK.match(given) is None else "the link"
    found = scene_text(imported(text))
    if output is None:
        tell(found.text.splitlines())
    else:
        tell([str(write_apart(output, found.text.encode(), given, force))])
    for note in found.notes:
        complain(note)
