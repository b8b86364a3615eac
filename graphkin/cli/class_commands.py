"""The commands for a whole class: new, variants; and what check says of a lab."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.console import FAILED, READING, complain
from graphkin.cli.folder_options import folder_option
from graphkin.cli.options import force_option, lang_option, leave, tell

if TYPE_CHECKING:
    from graphkin.classroom.roster.student import Student
    from graphkin.classroom.variants.assign import Assigned


@click.group(invoke_without_command=True)
@click.pass_context
def new(context: click.Context) -> None:
    """Make something to start from: a lab.

    \b
    Example:
      graphkin new lab crank-lab
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


@new.command("lab")
@click.argument("name", metavar="NAME")
@folder_option(
    "Folder in which the lab's folder is made; the current one by default.", default=Path()
)
@force_option
def new_lab(name: str, folder: Path, force: bool) -> None:
    """Make a lab: a folder NAME with a scene and the rule of its variants, to be changed.

    Both files have a word beside each key, and graphkin check passes them as they are.

    \b
    Example:
      graphkin new lab crank-lab
      graphkin check crank-lab
    """
    from graphkin.classroom.lab.new_lab import new_lab as made

    tell(str(path) for path in made(name, folder, force=force))


@click.command()
@click.argument("name", metavar="LAB")
@click.argument("roster", metavar="ROSTER", type=click.Path(path_type=Path))
@folder_option("Folder of the class, made if it is missing.", required=True)
@lang_option("Language of the class, kept for print, read and grade; the scene's by default.")
@click.option(
    "--force", is_flag=True, help="Replace a class that stands there; it keeps its codes."
)
def variants(name: str, roster: Path, folder: Path, lang: str | None, force: bool) -> None:
    """Give each student of a class data of their own.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml. ROSTER is a class
    list, CSV or XLSX, whose first row names its columns in English, Romanian or Italian: an id for
    each student, the number where the lab's formula needs one, name and group if there are any.

    Tells how fair the data are. Writes variants.csv, manifest.json, from which every sheet can be
    derived again, and a copy of the lab. Data by a formula that are unfair are told and written all
    the same, and the status is 1; data from ranges are drawn again until they are fair.

    \b
    Example:
      graphkin variants pump class.csv -o pump-2026 --lang en
    """
    from graphkin.classroom.lab.read_lab import read_lab
    from graphkin.classroom.roster.read_roster import read_roster
    from graphkin.classroom.variants.assign import assigned, check_of
    from graphkin.classroom.variants.class_files import write_class
    from graphkin.classroom.variants.class_words import class_lines

    lab = read_lab(name)
    students = read_roster(roster, numbered=lab.rule.counts, check=check_of(lab), tell=complain)
    found = assigned(lab, students, roster.name)
    written = write_class(folder, lab, found, roster, force=force, language=lang)
    tell(class_lines(lab, found))
    tell(["", *(str(path) for path in written)])
    warn_of_languages(roster.name, students)
    warn_of(found)


def warn_of_languages(roster: str, students: list[Student]) -> None:
    """Say which languages of a class list are none of the pages'."""
    from graphkin.classroom.roster.language_names import named_languages, unknown_lines

    for line in unknown_lines(named_languages(roster, students)):
        complain(line)


def warn_of(found: list[Assigned]) -> None:
    """Say, on the other channel, how many data are unfair, and leave with the status for it."""
    unfair = sum(not each.fair for each in found)
    if unfair:
        students = "student has" if unfair == 1 else "students have"
        complain(f"{unfair} {students} unfair data")
        leave(FAILED)


def check_lab(name: str) -> None:
    """What check says of a lab after its scene: a thousand variants tried.

    Mistakes of the lab name its own files, no longer the scene that was called.
    """
    from graphkin.classroom.lab.fairness_words import trial_lines
    from graphkin.classroom.lab.lab_trial import tried
    from graphkin.classroom.lab.read_lab import read_lab

    click.get_current_context().meta.pop(READING, None)
    outcome = tried(read_lab(name))
    tell(["", *trial_lines(outcome)])
    if outcome.unasked:
        complain(f"drawn on no sheet: {', '.join(outcome.unasked)}")
    if outcome.spoilt:
        unfair = outcome.unfair + len(outcome.coarse)
        if kept := {name for name, _ in outcome.by_keys}:
            have = "has" if len(kept) == 1 else "have"
            complain(f"{len(kept)} of a class of {len(outcome.compared)} {have} unfair data")
        if unfair:
            are = "is" if unfair == 1 else "are"
            complain(f"{unfair} of {len(outcome.many)} variants {are} unfair")
        leave(FAILED)
