"""The commands for a class: new, variants, quiz, ranges; and the part of check about a lab."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.folder_options import FolderType, class_argument, folder_option, output_option
from graphkin.cli.options import (
    FAILED,
    READING,
    command,
    complain,
    current,
    force_option,
    formats_option,
    house_option,
    jobs_option,
    lab_of_command,
    lang_option,
    language_option,
    leave,
    option_words,
    say,
    tell,
    working,
)

if TYPE_CHECKING:
    from graphkin.classroom.lab.fair_ranges import FairRanges
    from graphkin.classroom.lab.lab_model import Lab
    from graphkin.classroom.lab.new_lab import ProposedRanges
    from graphkin.classroom.roster.students import Student
    from graphkin.classroom.variants.assign import Assigned


@click.group(invoke_without_command=True)
@click.pass_context
def new(context: click.Context) -> None:
    """Make a lab, a school's conventions, or an empty table of answers, to start from.

    \b
    Examples:
      graphkin new lab crank-lab
      graphkin new answers crank-2026 -o answers.csv
      graphkin new house
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


@new.command("lab")
@click.argument("name", metavar="NAME")
@folder_option(
    "Folder in which the lab's folder is made; the current one by default.", default=Path()
)
@click.option("--from", "scene", metavar="SCENE", help="Make the lab for this scene.")
@force_option
def new_lab(name: str, folder: Path, scene: str | None, force: bool) -> None:
    """Make a lab: a folder with a scene and a rule.

    The folder is called NAME and holds a scene and the rule of its variants, for you to change.
    Both files have a comment at each key, and graphkin check accepts them unchanged.

    With --from, the scene is a copy of SCENE, a path or the name of a shipped lab. If none of its
    parameters has min and max, the position of its driver becomes one. The rule draws from the
    ranges in which every variant is fair and lists every field and every known mistake of this
    scene.

    \b
    Example:
      graphkin new lab crank-lab
      graphkin new lab my-lab --from my-mechanism.toml
      graphkin check my-lab
    """
    from graphkin.classroom.lab.new_lab import lab_from
    from graphkin.classroom.lab.new_lab import new_lab as made

    if scene is None:
        tell(str(path) for path in made(name, folder, force=force))
        return
    from graphkin.scene import scene_files
    from graphkin.text.tables import labelled

    path = scene_files.find(scene)
    current().meta[READING] = path
    with working() as step:
        lab = lab_from(Path(path), name, folder, force=force, say=step)
    tell(map(str, lab.files))
    if lab.added:
        tell(["", *labelled("added", [f"{lab.added}: the position of the driver varies"])])
    if lab.proposed is None:
        complain(f"{NO_RANGES}: graphkin ranges {folder / name} lists the limits that are broken")
        leave(FAILED)
    else:
        tell(["", *notes_of(lab.proposed)])


@new.command("answers")
@class_argument
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="The CSV file to write; without it, the table is printed.",
)
@force_option
def new_answers(folder: Path, output: Path | None, force: bool) -> None:
    """Make an empty table of a class's answers, to be filled in and marked.

    DIR is the folder that graphkin variants wrote. The table has a row for each form and a column
    for each of its fields. Its first columns are on the form too: id, name and code, and the
    position where a student has several. graphkin grade reads the table.

    \b
    Example:
      graphkin new answers crank-2026 -o answers.csv
    """
    from graphkin.classroom.grading.grading_files import csv_bytes
    from graphkin.classroom.lab.items import items
    from graphkin.classroom.printing.edition import read_edition
    from graphkin.mechanism import Mechanism
    from graphkin.scene.read_scene import read_text
    from graphkin.writers.files import write_apart

    opened = read_edition(folder)
    mechanism = Mechanism(read_text(opened.scene, opened.lab.name))
    fields = [item.field for item in items(mechanism, opened.lab)]
    several = opened.lab.rule.positions
    own = [several.parameter] if several is not None else []
    rows = [
        [e.student.id, e.student.name, e.code, *(e.settings[name] for name in own)]
        for e in opened.takers
    ]
    head = ["id", "name", "code", *own]
    table = csv_bytes([[*head, *fields], *([*row, *("" for _ in fields)] for row in rows)])
    if output is None:
        tell(table.decode("utf-8-sig").splitlines())
    else:
        tell([str(write_apart(output, table, folder, force))])


@new.command("house")
@folder_option("Folder to write it into; the current one by default.", default=Path())
@click.option("--own", is_flag=True, help="Write your own, for all scenes without one beside them.")
@force_option
def new_house(folder: Path, own: bool, force: bool) -> None:
    """Make a house.toml: the conventions of a school.

    The file has a comment at each key: header, logo, title block, language, ink, signs. Beside a
    scene or a lab it holds for these; --own writes the one that holds for all others.

    \b
    Examples:
      graphkin new house -o my-lab
      graphkin new house --own
    """
    from graphkin.scene.house import HOUSE, template
    from graphkin.writers.files import write_all

    place = Path(click.get_app_dir("graphkin")) if own else folder
    tell(map(str, write_all(place, {HOUSE: template().encode()}, force)))


@command()
@click.argument("name", metavar="LAB")
@click.argument("roster", metavar="ROSTER", type=click.Path(path_type=Path))
@folder_option("Folder of the class, made if it is missing.", required=True)
@lang_option("Language of the class, kept for print, read and grade; the scene's by default.")
@house_option
@click.option("--force", is_flag=True, help="Replace an existing class; it keeps its codes.")
def variants(name: str, roster: Path, folder: Path, lang: str | None, force: bool) -> None:
    """Give each student of a class data of their own.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml. ROSTER is a class
    list, CSV or XLSX, whose first row names its columns in a language of the sheets. It needs
    an id for each student, and a number if the lab's formula uses one; name and group are optional.

    Reports how fair the data are. Writes variants.csv, manifest.json, from which every sheet can be
    derived again, and a copy of the lab with its house.toml. Unfair data from a formula are
    reported and still written, and the exit status is 1. Unfair data from ranges are drawn again
    until they are fair. If lab.toml gives each student several positions, each has an id of its
    own, such as 0042-1.

    \b
    Example:
      graphkin variants pump class.csv -o pump-2026 --lang en
    """
    from graphkin.classroom.roster.read_roster import read_roster
    from graphkin.classroom.variants.assign import assigned, check_of
    from graphkin.classroom.variants.class_files import class_lines, write_class

    lab = lab_of_command(name)
    students = read_roster(roster, numbered=lab.rule.counts, check=check_of(lab), tell=complain)
    with working() as step:
        found = assigned(lab, students, roster.name, step)
    written = write_class(folder, lab, found, roster, force=force, language=lang)
    tell(class_lines(lab, found))
    tell(["", *(str(path) for path in written)])
    warn_of_languages(roster.name, students)
    warn_of(found)


def warn_of_languages(roster: str, students: list[Student]) -> None:
    """Warn of languages in a class list that the pages do not have."""
    from graphkin.classroom.roster.students import named_languages, unknown_lines

    for line in unknown_lines(named_languages(roster, students)):
        complain(line)


def warn_of(found: list[Assigned]) -> None:
    """Warn of unfair data on standard error, and end with the status for them."""
    from graphkin.classroom.roster.students import counted

    unfair = sum(not each.fair for each in found)
    if unfair:
        what = counted(each.student for each in found)
        who = f"{what.removesuffix('s')} has" if unfair == 1 else f"{what} have"
        complain(f"{unfair} {who} unfair data")
        leave(FAILED)


def check_lab(name: str) -> None:
    """The part of check about a lab, after its scene: a thousand variants are tried.

    Errors in the lab name its own files, not the scene given on the command line.
    """
    from graphkin.classroom.lab.lab_trial import trial_lines, tried

    click.get_current_context().meta.pop(READING, None)
    outcome = tried(lab_of_command(name))
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


# --- the command ``quiz``: a lab as questions for Moodle ------------------------------------------


SHOWN = 5
"""The most unfair variants that are listed."""


@command("quiz")
@click.argument("name", metavar="LAB")
@output_option
@language_option
@click.option(
    "--count",
    metavar="N",
    type=click.IntRange(1, 1000),
    default=30,
    show_default=True,
    help="Largest number of variants; each of a student's several positions is a question.",
)
@formats_option(
    "moodle,canvas,qti3",
    "moodle",
    "Platforms: moodle (XML), canvas (QTI 1.2), qti3 (QTI 3.0 for any other).",
)
@jobs_option()
@house_option
@force_option
@click.pass_context
def quiz(
    context: click.Context,
    name: str,
    folder: Path,
    lang: str | None,
    count: int,
    formats: str,
    jobs: int | None,
    force: bool,
) -> None:
    """Write a lab as a bank of questions for Moodle, Canvas or another platform.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml. It may also be a
    class folder, for its lab in its language.

    Writes LAB-moodle.xml (question bank, import, Moodle XML) with a category for each fair variant.
    A category has one question with embedded answers: the task as pictures and as a PDF to print at
    100 %, and a gap for each field, with the tolerance of that variant's own drawing. A gap also
    accepts the results of causes, each with what the cause leaves (lab.toml) and a sentence of
    feedback. Only graphkin grade can recognise what follows from a student's own wrong values.

    --format canvas writes LAB-canvas.zip (QTI 1.2) with a quiz for each fair variant: the task, and
    a question for each field. Canvas gives a number all points or none. --format qti3 writes
    LAB-qti3.zip (QTI 3.0) with an item for each fair variant, and what causes leave.

    \b
    Examples:
      graphkin quiz pump -o out --lang en
      graphkin quiz pump -o out --format moodle,canvas
    """
    from graphkin.classroom.printing.edition import read_edition
    from graphkin.classroom.printing.print_run import PrintOrder
    from graphkin.classroom.printing.workers import cores
    from graphkin.classroom.quiz.moodle_quiz import bank, questions, variants_of
    from graphkin.classroom.quiz.qti_packages import canvas_package, qti3_package
    from graphkin.classroom.variants.assign import MANIFEST
    from graphkin.documents.sheet_documents import language_of
    from graphkin.mechanism import Mechanism
    from graphkin.scene.read_scene import read_text
    from graphkin.text.errors import SceneError, message
    from graphkin.writers.files import refuse_folder, write_all

    whole = read_edition(Path(name)) if (Path(name) / MANIFEST).is_file() else None
    lab = whole.lab if whole else lab_of_command(name)
    lang = lang or (whole.language if whole else "")
    written_by: dict[str, tuple[str, Callable[..., bytes]]] = {
        "moodle": (f"{lab.name}-moodle.xml", lambda found, words: bank(lab.name, found)),
        "canvas": (f"{lab.name}-canvas.zip", partial(canvas_package, lab.name)),
        "qti3": (f"{lab.name}-qti3.zip", partial(qti3_package, lab.name)),
    }
    chosen = [written_by[each] for each in option_words("--format", formats, tuple(written_by))]
    refuse_folder(folder, [file for file, _ in chosen], force=force)
    if not lab.rubric.points:
        hint = message("give points in [marks] of lab.toml")
        raise SceneError.at(
            lab.name, message("no field earns marks"), message("a field that does"), hint
        )
    fair, unfair = variants_of(lab, count)
    for each in unfair[:SHOWN]:
        named = ", ".join(f"{key} = {value}" for key, value in each.settings.items())
        complain(f"{named} is left out: {'; '.join(map(str, each.faults))}")
    if len(unfair) > SHOWN:
        complain(f"and {len(unfair) - SHOWN} more unfair variants")
    if not fair:
        raise SceneError.at(lab.name, message("no variant is fair"), message("one at least"))
    scene = lab.scene.read_text(encoding="utf-8-sig")
    words = language_of(Mechanism(read_text(scene, lab.name, house=lab.house)), lang)
    order = PrintOrder(lab, scene, words.language, "colour")
    found = questions(order, fair, jobs or cores())
    written = write_all(folder, {file: work(found, words) for file, work in chosen}, force)
    say(f"questions: {len(found)}, each with a category of its own")
    tell(map(str, written))


# --- ``graphkin ranges``: where in the space of its parameters a lab is fair ----------------------


@command()
@click.argument("name", metavar="LAB")
@click.option("-o", "--output", "folder", metavar="DIR", type=FolderType(path_type=Path))
@house_option
@force_option
def ranges(name: str, folder: Path | None, force: bool) -> None:
    """Find the parameter ranges in which every variant is fair.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml. The search covers the
    scene's parameters from min to max, with the limits of [fair]. Prints the fair share by the
    values of each parameter and the parameter that matters most, and proposes [variants] for you to
    paste. For a formula, prints the numbers for which it is unfair, the reasons, and the smallest
    change that makes it fair. With -o, writes pictures of the fair share, by parameter and by
    pairs.

    \b
    Example:
      graphkin ranges crank-lab -o ranges
    """
    from graphkin.classroom.lab.fair_ranges import fair_ranges
    from graphkin.classroom.lab.new_lab import range_lines
    from graphkin.text.tables import labelled
    from graphkin.writers.files import refuse_folder, write_all

    lab = lab_of_command(name)
    if folder is not None:
        refuse_folder(folder)
    with working() as step:
        found = fair_ranges(lab, step)
    tell(range_lines(lab, found))
    if not lab.rule.is_drawn:
        tell(labelled("formula", formula_lines(lab)))
    tell(["", *proposed(lab, found)])
    if folder is not None:
        from graphkin.classroom.lab.fair_ranges import pictures

        files = dict(pictures(found, lab.name, lab.name))
        tell(["", *map(str, write_all(folder, files, force))])


NO_RANGES = "no ranges were found in which all is fair"


def formula_lines(lab: Lab) -> list[str]:
    """The numbers for which a formula is unfair, the reasons, and the change that helps."""
    from graphkin.classroom.lab.new_lab import formula_faults, mending_lines

    found = formula_faults(lab)
    return mending_lines(found.unfair, found.mending)


def proposed(lab: Lab, found: FairRanges) -> list[str]:
    """The proposed ranges as text, with how many students get different data."""
    from graphkin.classroom.lab.new_lab import proposed_ranges

    new = proposed_ranges(lab, found)
    if new is None:
        complain(NO_RANGES)
        return []
    return [*(f"# {note}" for note in notes_of(new)), *new.lines]


def notes_of(new: ProposedRanges) -> list[str]:
    """How many different data the proposed ranges give, and to how many students."""
    what = "students" if new.positions is None else "sheets"
    room = f"{new.kept} of {new.of} {what}"
    if new.kept == new.of:
        room = f"all {new.of} {what} of a class"
    note = f"{new.count} different data; at apart = {new.apart:g} they keep {room} apart"
    again = "the others are drawn again"
    coarse = f"a pencil draws {100 * new.exact:.0f} % of these exactly enough, {again}"
    return [note, coarse] if new.exact < 1 else [note]
