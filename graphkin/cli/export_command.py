"""The command that writes a mechanism for another language or another program: export."""

from __future__ import annotations

from pathlib import Path

import click

from graphkin.cli.options import complain, force_option, mechanism_of, say, scene_argument, tell


@click.command()
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
        from graphkin.web.formula import formula_of
        from graphkin.web.formula_workbook import formula_workbook

        data = formula_workbook(formula_of(mechanism))
    else:
        from graphkin.web.formula import LANGUAGES, formula_of

        data = LANGUAGES[language](formula_of(mechanism)).encode()
    if file is None:
        say(data.decode().rstrip())
    else:
        tell([str(write_apart(file, data, name, force))])
