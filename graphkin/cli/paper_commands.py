"""The commands from paper and back: ``print``, ``read`` and ``desk``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.folder_options import class_argument, folder_option
from graphkin.cli.options import (
    FAILED,
    command,
    complain,
    formats_option,
    ink_option,
    jobs_option,
    lang_option,
    option_words,
    say,
    say_aside,
    tell,
)
from graphkin.cli.page_commands import browser_option, port_option, refuse_without, show
from graphkin.documents import PRINTED_VIEWS
from graphkin.text.errors import PageError, message, verbatim

if TYPE_CHECKING:
    from graphkin.classroom.printing.print_run import Outcome, Tell
    from graphkin.classroom.roster.students import Student
    from graphkin.drawing.style import Ink
    from graphkin.reading.read_sheet import Grid

TENTHS = 10
"""The number of progress lines of a run without a terminal."""


@command("print")
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
    from graphkin.classroom.roster.students import counted

    chosen = option_words("--view", views, PRINTED_VIEWS)
    kinds = option_words("--format", formats, ("pdf", "svg", "html"))
    if "pdf" in kinds:
        refuse_without("print", "class", [("pikepdf", "pikepdf")])
    if "html" in kinds and "overlay" in chosen:
        raise click.UsageError("--view overlay is laid on paper: not with --format html", context)
    if cluster and not cluster.startswith(CLUSTER):
        raise click.UsageError(f"--engine {cluster}: write {CLUSTER}HOST:PORT", context)
    edition = read_edition(folder)
    what = counted(taker.student for taker in edition.takers)
    with progress(what) as tell:
        ink = ink or edition.lab.house.ink
        wishes = PrintRequest(chosen, kinds, lang, ink, force)
        outcome = print_class(edition, wishes, Means(jobs or cores(), cluster), tell)
    report(outcome, what)
    if lang and lang != edition.language and (force or not edition.language):
        keep_language(folder, lang)
        say(f"{folder} keeps --lang {lang} for print, read and grade")
    if outcome.refused:
        context.exit(FAILED)


@contextmanager
def progress(what: str) -> Iterator[Tell]:
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


def report(outcome: Outcome, what: str) -> None:
    """Report a run: the files to print, and the students without files, with the reasons.

    ``what`` is the name of what is counted, students or sheets.
    """
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
    say(f"{outcome.made} {what.removesuffix('s') if outcome.made == 1 else what} printed{stood}")
    for path in outcome.files or [outcome.folder]:
        say(str(path))


NEEDED = {
    "bottle": "bottle",
    "cv2": "opencv-python-headless",
    "pillow_heif": "pillow-heif",
    "waitress": "waitress",
    "zxingcpp": "zxing-cpp",
}
"""The packages of the extra [read], by the names of their modules."""
MOST_PLACES = 10_000
"""The most places of a grid."""


@command("read")
@click.argument("folder", metavar="CLASS", type=click.Path(path_type=Path))
@click.argument(
    "photos", metavar="PHOTOS…", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@folder_option("Folder of the readings, made if it is missing.", "READ", "out", required=True)
@click.option(
    "--json", "as_json", is_flag=True, help="Also write NAME.points.json next to each picture."
)
@click.option(
    "--grid",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help='JSON, {"x": [mm, …], "y": [mm, …]}: report the pixels of these places on the paper.',
)
@click.option(
    "--by-hand",
    is_flag=True,
    help="Only flatten the pictures; you click the points that the marks need.",
)
@jobs_option("Processes; by default one for each core.")
@click.pass_context
def read(
    context: click.Context,
    folder: Path,
    photos: tuple[Path, ...],
    out: Path,
    as_json: bool,
    grid: Path | None,
    by_hand: bool,
    jobs: int | None,
) -> None:
    """Read the drawings of a class from photographs.

    CLASS is the folder that graphkin variants wrote. PHOTOS are pictures (JPEG, PNG, HEIC), scans
    (PDF), or folders of them. Each shows one sheet, with the whole QR code and most of the frame.
    The two pages of a sheet on A4, and the scanned halves of one on A3, are named NAME-left and
    NAME-right.

    The command identifies each sheet by its code and flattens it to millimetres of paper by its
    frame. It reads the points one after the other, and expects each from the student's own earlier
    points. A point that is surely right, or surely follows from the student's own mistake, is
    decided. Every mistake and every doubt is left to you: graphkin desk READ shows them one by one.

    Then graphkin grade CLASS READ -o report marks the lengths and places that were read. Pictures
    are kept in READ without the camera's metadata. Run the same command again to continue a run
    that was stopped.

    \b
    Examples:
      graphkin read pump-2026 photos -o read
      graphkin desk read
      graphkin grade pump-2026 read -o report

    \b
    Exit status: 0 success; 1 some pictures were refused, each with its reason; 2 bad input.
    """
    refuse_without("read", "read", NEEDED.items())
    from graphkin.classroom.printing.edition import read_edition
    from graphkin.classroom.printing.workers import cores
    from graphkin.reading.pictures import photographs
    from graphkin.reading.read_run import POINTS, points_file, read_class, read_order, said
    from graphkin.writers.files import write_all

    opened = read_edition(folder)
    pictures = photographs(list(photos))
    order = read_order(opened, read_grid(grid), by_hand=by_hand)
    with progress("photographs") as shown:
        outcome = read_class(opened, pictures, out, order, jobs or cores(), shown)
    if as_json:
        point_files = {r.name: points_file(r) for r in outcome.records if r.key}
        beside: dict[Path, dict[str, bytes]] = {}
        for each in pictures:
            if each.name in point_files:
                files = beside.setdefault(each.path.parent, {})
                files[f"{each.shown_name}{POINTS}"] = point_files[each.name]
        for place, files in beside.items():
            write_all(place, files, force=True)
    tell(said(opened, outcome))
    refused = any(record.refused is not None for record in outcome.records)
    if refused or outcome.refusals.found:
        context.exit(FAILED)


def read_grid(path: Path | None) -> Grid:
    """The places of a grid file. Raises PageError for an invalid file."""
    import msgspec

    from graphkin.reading.read_sheet import Grid
    from graphkin.scene.file_limits import file_bytes

    if path is None:
        return Grid()
    expected = message('{{"x": [mm, …], "y": [mm, …]}}')
    try:
        grid = msgspec.json.decode(file_bytes(path, 1 << 20), type=Grid)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None)
        found = verbatim(str(reason).lower()) if reason else message("is no such JSON")
        raise PageError.at(f"--grid {path}", found, expected) from None
    if not 0 < len(grid.x) * len(grid.y) <= MOST_PLACES:
        found = message("has {count} places", count=len(grid.x) * len(grid.y))
        raise PageError.at(f"--grid {path}", found, message("1 to {most}", most=MOST_PLACES))
    return grid


@command("desk")
@click.argument("folder", metavar="FOLDER", type=click.Path(path_type=Path))
@port_option
@browser_option
@lang_option("Language of the page.", "en")
@click.option(
    "--marker",
    metavar="NAME",
    help="Your name beside your decisions, for other markers; by default your login name.",
)
@click.option("--anonymous", is_flag=True, help="Hide the names of the students.")
def desk(
    folder: Path, port: int, no_browser: bool, lang: str, marker: str | None, anonymous: bool
) -> None:
    """Decide in a browser what waits for you.

    FOLDER is what graphkin grade wrote (a report), or what graphkin read wrote. The page shows one
    thing after the other; press a key or click to decide:

    \b
    - cells that cannot be read
    - doubtful points of drawings, enlarged, with the key over the drawing
    - appeals of students, from REPORT/appeals.csv (id;field;text)
    - suspected copies
    - sheets that lost much and that no known cause explains
    - clusters of like wrong answers, decided once for all

    Each decision is appended at once to decisions.jsonl in the folder, and can be undone. The next
    graphkin grade applies it. Several markers can have a desk on one folder; where they disagree,
    nothing counts until one of them decides again.

    Only this computer can reach the page, and its address holds a secret token. The page ends with
    this command (Ctrl+C).

    \b
    Examples:
      graphkin desk report
      graphkin desk report --marker Ana --anonymous
      graphkin desk read --lang it --no-browser --port 8080
    """
    needed = ((module, NEEDED[module]) for module in ("bottle", "waitress"))
    refuse_without("desk", "read", needed)
    from getpass import getuser

    from graphkin.reading.desk_app import DeskSession, desk_application
    from graphkin.studio.server import served
    from graphkin.text import words
    from graphkin.writers.commit import settle

    settle(folder)
    who = getuser() if marker is None else marker.strip()
    session = DeskSession(folder, words(lang), who, anonymous)
    tell(map(str, session.problems()))
    show(
        lambda known: served(lambda: desk_application(session), port, known=known),
        no_browser=no_browser,
    )
