"""The command ``quiz``: a lab as questions for Moodle."""

from __future__ import annotations

from pathlib import Path

import click

from graphkin.cli.console import complain, say
from graphkin.cli.folder_options import output_option
from graphkin.cli.options import force_option, jobs_option, language_option, tell

SHOWN = 5
"""Variants that are left out, of which it is told one by one."""


@click.command("quiz")
@click.argument("name", metavar="LAB")
@output_option
@language_option
@click.option(
    "--count",
    metavar="N",
    type=click.IntRange(1, 1000),
    default=30,
    show_default=True,
    help="Variants at most.",
)
@jobs_option()
@force_option
@click.pass_context
def quiz(
    context: click.Context,
    name: str,
    folder: Path,
    lang: str | None,
    count: int,
    jobs: int | None,
    force: bool,
) -> None:
    """Write a lab as a bank of questions for Moodle.

    LAB is the name of a shipped lab or a folder with scene.toml and lab.toml; or the folder of a
    class, for its lab in its language.

    Writes LAB-moodle.xml (question bank, import, Moodle XML): a category for each fair variant,
    and in it one question with embedded answers: the task as pictures and as a PDF to be printed at
    100 %, a gap for each field with the tolerance of that variant's own drawing, and what slips
    would give, with their share (lab.toml) and a sentence. What follows from own wrong values only
    graphkin grade can tell.

    \b
    Example:
      graphkin quiz pump -o out --lang en
    """
    from graphkin.classroom.lab.read_lab import read_lab
    from graphkin.classroom.printing.edition import read_edition
    from graphkin.classroom.printing.print_work import PrintOrder
    from graphkin.classroom.printing.workers import cores
    from graphkin.classroom.quiz.moodle_quiz import bank, questions, variants_of
    from graphkin.classroom.variants.manifest import MANIFEST
    from graphkin.documents.sheet_documents import language_of
    from graphkin.mechanism import Mechanism
    from graphkin.scene.read_scene import read_text
    from graphkin.text.errors import Problem, SceneError
    from graphkin.writers.files import refuse_folder, write_all

    whole = read_edition(Path(name)) if (Path(name) / MANIFEST).is_file() else None
    lab = whole.lab if whole else read_lab(name)
    lang = lang or (whole.language if whole else "")
    refuse_folder(folder, [f"{lab.name}-moodle.xml"], force=force)
    if not lab.rubric.points:
        hint = "give points in [marks] of lab.toml"
        raise SceneError(Problem(lab.name, "no field earns marks", "a field that does", hint))
    fair, unfair = variants_of(lab, count)
    for each in unfair[:SHOWN]:
        told = ", ".join(f"{key} = {value}" for key, value in each.settings.items())
        complain(f"{told} is left out: {'; '.join(map(str, each.faults))}")
    if len(unfair) > SHOWN:
        complain(f"and {len(unfair) - SHOWN} more unfair variants")
    if not fair:
        raise SceneError(Problem(lab.name, "no variant is fair", "one at least"))
    scene = lab.scene.read_text(encoding="utf-8-sig")
    words = language_of(Mechanism(read_text(scene, lab.name)), lang)
    order = PrintOrder(lab, scene, words.language, "colour")
    found = questions(order, fair, jobs or cores())
    file = {f"{lab.name}-moodle.xml": bank(lab.name, found)}
    written = write_all(folder, file, force)
    say(f"{len(found)} questions, a category for each")
    tell(map(str, written))
