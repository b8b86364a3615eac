"""The commands ``read`` and ``desk``: mark drawings from photographs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.options import FAILED, folder_option, jobs_option, lang_option, tell
from graphkin.cli.print_command import progress
from graphkin.cli.studio_command import browser_option, port_option, refuse_without, show
from graphkin.text.errors import PageError, Problem, message, verbatim

if TYPE_CHECKING:
    from graphkin.reading.read_sheet import Grid

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


@click.command("read")
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
        raise PageError(Problem(f"--grid {path}", found, expected)) from None
    if not 0 < len(grid.x) * len(grid.y) <= MOST_PLACES:
        found = message("has {count} places", count=len(grid.x) * len(grid.y))
        raise PageError(Problem(f"--grid {path}", found, message("1 to {most}", most=MOST_PLACES)))
    return grid


@click.command("desk")
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
