"""The command ``print``: a class folder as merged files to print, and files for each student."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.options import (
    FAILED,
    class_argument,
    complain,
    formats_option,
    ink_option,
    jobs_option,
    lang_option,
    option_words,
    say,
    say_aside,
)
from graphkin.cli.studio_command import refuse_without
from graphkin.documents.view_names import MOTION_VIEWS, PRINTED_VIEWS

if TYPE_CHECKING:
    from graphkin.classroom.printing.print_run import Outcome, Tell
    from graphkin.classroom.roster.student import Student
    from graphkin.drawing.style import Ink

TENTHS = 10
"""The number of progress lines of a run without a terminal."""


@click.command("print")
@class_argument
@click.option(
    "--view",
    "views",
    metavar="task,key,overlay,steps,positions,diagrams",
    default="task,key",
    show_default=True,
    help="Views to print for each student; a task includes its A4 form.",
)
@lang_option(
    "Language of the pages. Default: that of the class, set by variants or by the first print"
    " with --lang (later only with --force), else the scene's."
)
@ink_option
@formats_option(
    "pdf,svg,html",
    "pdf",
    "Kinds of file to write for each student; the merged files are PDF. html: a page for a"
    " browser; the task has a form that saves the answers.",
)
@jobs_option()
@click.option(
    "--engine",
    "cluster",
    metavar="dask://HOST:PORT",
    default="",
    help="Draw on the Dask cluster with this scheduler; needs the extra [cluster].",
)
@click.option("--force", is_flag=True, help="Replace files printed with other settings.")
@click.pass_context
def print_sheets(
    context: click.Context,
    folder: Path,
    views: str,
    lang: str | None,
    ink: Ink | None,
    formats: str,
    jobs: int | None,
    cluster: str,
    force: bool,
) -> None:
    """Print the sheets of a class.

    DIR is the folder that graphkin variants wrote.

    Writes into DIR/print a task sheet and a form for every student, and the other views
    that --view names. Then merges each view into one file to print, with all students in the order
    of the roster: class-task.pdf, class-key.pdf. Every sheet shows name, group and an opaque code,
    and a QR code where it fits. A column language of the class list sets each student's language;
    --lang is for students without one.

    Run the same command again to continue a run that was stopped: it makes the missing files, and
    the result is the same to the byte. A second run into the same folder is refused while one is
    running.

    \b
    Examples:
      graphkin print mechanics-331
      graphkin print mechanics-331 --view task,key,overlay --ink black
      graphkin print mechanics-331 --view steps --format pdf,svg --lang en
      graphkin print mechanics-331 --view task --format html
    """
    from graphkin.classroom.printing.edition import keep_language, read_edition
    from graphkin.classroom.printing.print_run import Means, PrintRequest, print_class
    from graphkin.classroom.printing.workers import CLUSTER, cores

    chosen = option_words("--view", views, PRINTED_VIEWS)
    kinds = option_words("--format", formats, ("pdf", "svg", "html"))
    if "pdf" in kinds:
        refuse_without("print", "class", [("pikepdf", "pikepdf")])
    if "html" in kinds and "overlay" in chosen:
        raise click.UsageError("--view overlay is laid on paper: not with --format html", context)
    if "html" in kinds and (paper := [view for view in chosen if view in MOTION_VIEWS]):
        raise click.UsageError(f"--view {paper[0]} is for paper: not with --format html", context)
    if cluster and not cluster.startswith(CLUSTER):
        raise click.UsageError(f"--engine {cluster}: write {CLUSTER}HOST:PORT", context)
    with progress() as tell:
        edition = read_edition(folder)
        ink = ink or edition.lab.house.ink
        wishes = PrintRequest(chosen, kinds, lang, ink, force)
        outcome = print_class(edition, wishes, Means(jobs or cores(), cluster), tell)
    report(outcome)
    if lang and lang != edition.language and (force or not edition.language):
        keep_language(folder, lang)
        say(f"{folder} keeps --lang {lang} for print, read and grade")
    if outcome.refused:
        context.exit(FAILED)


@contextmanager
def progress(what: str = "students") -> Iterator[Tell]:
    """A progress display: a bar on a terminal, else a line for each tenth."""
    if sys.stderr is not None and sys.stderr.isatty():
        with click.progressbar(length=1, label=what, show_pos=True, file=sys.stderr) as bar:

            def move(done: int, total: int) -> None:
                bar.length = max(total, 1)
                bar.update(done - bar.pos)

            yield move
        return
    last_tenth = -1

    def line(done: int, total: int) -> None:
        nonlocal last_tenth
        tenth = TENTHS * done // max(total, 1)
        if tenth > last_tenth:
            last_tenth = tenth
            say_aside(f"{done} of {total} {what}")

    yield line


def lost_words(student: Student) -> str:
    """A message about a student whose name or group has signs that cannot be printed."""
    from graphkin.classroom.printing.personal import UNKNOWN, is_readable, lost

    whole = ", ".join(filter(None, (student.name, student.group)))
    signs, instead = " ".join(lost(whole)), f"{UNKNOWN} replaces each"
    if student.name and not is_readable(student.name):
        instead = "the id replaces the name"
    return f'{student.id}: the font of the sheets lacks {signs} of "{whole}"; {instead}'


def report(outcome: Outcome) -> None:
    """Report a run: the files to print, and the students without files, with the reasons."""
    if outcome.left:
        complain(f"an earlier run did not end ({outcome.left}); what it had finished was kept")
    for student in outcome.lost:
        complain(lost_words(student))
    for line in outcome.strange:
        complain(line)
    for taker, problems in outcome.refused:
        for problem in problems:
            complain(f"{taker.student.id} {taker.student.name}: {problem}")
    stood = f", {outcome.stood} stood already" if outcome.stood else ""
    say(f"{outcome.made} student{'' if outcome.made == 1 else 's'} printed{stood}")
    for path in outcome.files or [outcome.folder]:
        say(str(path))
