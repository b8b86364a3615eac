"""The commands between programs: ``import`` and ``export``."""

from __future__ import annotations

from pathlib import Path

import click

from graphkin.cli.options import (
    READING,
    command,
    complain,
    current,
    force_option,
    mechanism_of,
    say,
    scene_argument,
    tell,
)

UNITS = ("mm", "cm", "m", "in")


@command("import")
@click.argument("given", metavar="FILE|LINK")
@click.option(
    "-o",
    "--output",
    metavar="SCENE",
    type=click.Path(path_type=Path),
    help="The scene file to write; without it the scene is printed.",
)
@click.option("--fixed", metavar="A,D", default="", help="Of a drawing: its fixed points.")
@click.option("--drive", metavar="A-B", default="", help="Of a drawing: the bar that turns.")
@click.option(
    "--slide",
    "slides",
    metavar="C=ANGLE",
    multiple=True,
    help="Of a drawing: a point on a fixed guide, at an angle in degrees; repeatable.",
)
@click.option(
    "--unit", type=click.Choice(UNITS), help="Of a drawing: its unit of length, if it states none."
)
@force_option
def import_scene(
    given: str,
    output: Path | None,
    fixed: str,
    drive: str,
    slides: tuple[str, ...],
    unit: str | None,
    force: bool,
) -> None:
    """Write a mechanism of another program as a scene.

    FILE is a .pmks or .csv file of PMKS+, a .linkage2 file of Linkage, a .json file of pylinkage,
    a .motiongen file of MotionGen, a .pyslvs file of Pyslvs, or a drawing. LINK is an address by
    which PMKS+ or the older PMKS shares a mechanism, in quotes; it is read, never opened. An
    expression M[J[…], …] of Pyslvs is given in quotes or in a file. The scene has the closure that
    is nearest to the drawing. What a scene cannot hold is named on standard error, and in comments
    at the head of the scene.

    A drawing is a .ggb file of GeoGebra or a DXF file (needs the extra [cad]). Its segments become
    bars, to scale. It does not say what is fixed: name the fixed points with --fixed. Without
    --fixed, the command lists the points.

    \b
    Examples:
      graphkin import crank.linkage2 -o crank.toml
      graphkin import shared.pmks
      graphkin import engine.ggb --fixed O --drive O-A --slide B=0
    """
    from graphkin.importing.formats import EXPRESSION, LINK, content, imported
    from graphkin.importing.record import Completion
    from graphkin.importing.scene_text import scene_text
    from graphkin.writers.files import write_apart

    tracing = Completion(words(fixed, ","), words(drive, "-"), guides(slides), unit or "")
    text = content(given)
    link, expression = LINK.match(given), EXPRESSION.match(given)
    current().meta[READING] = "the link" if link else "the expression" if expression else given
    found = scene_text(imported(text, tracing), "" if link or expression else given)
    if output is None:
        tell(found.text.splitlines())
    else:
        tell([str(write_apart(output, found.text.encode(), given, force))])
    for note in found.notes:
        complain(note)


def words(text: str, between: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(between) if word.strip())


def guides(slides: tuple[str, ...]) -> dict[str, str]:
    """The angle of the guide of each sliding point. Raises UsageError for other words."""
    found = {}
    for slide in slides:
        name, _, angle = (part.strip() for part in slide.partition("="))
        if not (name and angle):
            raise click.UsageError(f"--slide {slide}: write POINT=ANGLE, such as C=0", current())
        found[name] = angle
    return found


@command()
@scene_argument
@click.option(
    "--to",
    "language",
    type=click.Choice(
        ["python", "javascript", "c", "matlab", "excel", "linkage", "pmks", "pylinkage"]
    ),
    required=True,
    help="The language of the function, or the program that reads the file.",
)
@click.option(
    "-o",
    "--output",
    "file",
    metavar="FILE",
    type=click.Path(path_type=Path, dir_okay=False),
    help="File to write; without it, the text is printed.",
)
@force_option
def export(
    name: str, settings: tuple[str, ...], language: str, file: Path | None, force: bool
) -> None:
    """Write the motion as a function, or the mechanism for another program.

    python, javascript, c, matlab: one function of the driver's coordinate and the parameters. It
    needs only the standard library of its language. It gives positions, velocities and
    accelerations of all points, and angular velocities and accelerations of all links, in SI units.
    With several drivers it has the coordinate of each, and with a law of time it has the time.
    excel: the same as a workbook, which computes again when a value is changed.

    Mechanisms with groups of class III or higher, and those whose wheels are turned by pins alone,
    cannot be written as such a function.

    linkage, pmks, pylinkage: the mechanism in its position, as a .linkage2 file of Linkage, a .pmks
    file of PMKS+, or JSON of pylinkage. What such a program does not have is refused.

    \b
    Examples:
      graphkin export pump --to python -o pump.py
      graphkin export crank.toml --to linkage -o crank.linkage2
      graphkin export pump --to excel -o pump.xlsx
    """
    from graphkin.documents.program_files import PROGRAMS
    from graphkin.writers.files import write_apart

    if language == "excel" and file is None:
        context = click.get_current_context()
        raise click.UsageError("--to excel: a workbook is no text; write it with -o FILE", context)
    mechanism = mechanism_of(name, settings)
    if language in PROGRAMS:
        data = PROGRAMS[language](mechanism)
        if mechanism.scene.forces is not None:
            complain("masses and loads are left out: the file holds the motion alone")
    elif language == "excel":
        from graphkin.web.formula import formula_of, formula_workbook

        data = formula_workbook(formula_of(mechanism))
    else:
        from graphkin.web.formula import LANGUAGES, formula_of

        data = LANGUAGES[language](formula_of(mechanism)).encode()
    if file is None:
        say(data.decode().rstrip())
    else:
        tell([str(write_apart(file, data, name, force))])
