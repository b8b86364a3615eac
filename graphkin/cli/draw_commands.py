"""The commands that write pictures: sheet, cycle, accuracy."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.folder_options import output_option
from graphkin.cli.options import (
    FAILED,
    command,
    complain,
    force_option,
    formats_option,
    ink_option,
    language_option,
    leave,
    mechanism_of,
    option_words,
    pairs_of,
    scales_of,
    scene_argument,
    tell,
    working,
)
from graphkin.documents import VIEWS

if TYPE_CHECKING:
    from graphkin.drawing.scale import Scales
    from graphkin.drawing.style import Ink
    from graphkin.mechanism import Mechanism
    from graphkin.motion.equal_positions import Start
    from graphkin.text.tables import Cell


@command()
@scene_argument
@output_option
@click.option(
    "--view",
    "views",
    metavar="VIEWS",
    default="key",
    show_default=True,
    help="Views, separated by commas. key: everything drawn; task: what the student is given;"
    " steps: pages that grow sentence by sentence; overlay: the key alone, to lay over a"
    " drawing; positions: the mechanism and its plans in all positions of [positions]; diagrams:"
    " their courses, differentiated and integrated on paper, laws of cams, and hodographs.",
)
@language_option
@ink_option
@formats_option(
    "svg,pdf,html,dxf,tikz,tex,pmks",
    "svg,pdf",
    "Kinds of file to write; calculations are PDF only. html: one page for a browser, which"
    " draws itself step by step (key and steps alike), or holds the task. dxf: the drawings at"
    " true scale for a CAD program, a layer for each class of line; needs the extra [cad]. tikz:"
    " the mechanism and the plan as a picture for LaTeX. tex: the relations of the calculation for"
    " LaTeX. pmks:"
    " the mechanism for PMKS+, if it has only pins, blocks with one pin and one crank.",
)
@force_option
def sheet(
    name: str,
    settings: tuple[str, ...],
    folder: Path,
    views: str,
    lang: str | None,
    ink: Ink | None,
    formats: str,
    force: bool,
) -> None:
    """Draw the velocity, acceleration and force sheets and the calculations.

    Writes drawings (SVG and PDF) on A3 or the paper of house.toml, and calculation pages (PDF),
    named after the scene and its settings: pump-n7-velocity-key.pdf. Existing files are kept unless
    you give --force. The force sheet is drawn if [ask] has reactions or balance.

    With --view positions, draws the whole motion: pump-n7-mechanism-positions.pdf has the mechanism
    in twelve positions, or as [positions] says, and more files have the plans of all of them.

    With --format html, writes one page for a browser, pump-n7-key.html, with both plans, every step
    and the results. Forces have a page of their own, and so has the whole motion. The pages need no
    network.

    \b
    Examples:
      graphkin sheet pump --set n=7 -o sheets
      graphkin sheet pump --set n=7 -o sheets --format html
      graphkin sheet pump --set n=7 -o sheets --view task,key --lang en --format pdf
      graphkin sheet pump --set n=7 -o sheets --view positions
    """
    kinds = option_words("--format", formats, ("svg", "pdf", "html", "dxf", "tikz", "tex", "pmks"))
    chosen = option_words("--view", views, VIEWS)
    from graphkin.classroom.sheet_files import sheet_files
    from graphkin.writers.files import file_stem, refuse_folder, write_all

    mechanism = mechanism_of(name, settings)
    refuse_folder(folder)
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    ink = ink or mechanism.scene.house.ink
    files: dict[str, bytes] = {}
    notes: dict[str, None] = {}
    for view in chosen:
        drawn, said = sheet_files(mechanism, name, stem, view, lang, kinds, ink)
        files |= drawn
        notes |= dict.fromkeys(said)
    tell(str(path) for path in write_all(folder, files, force))
    for note in notes:
        complain(note)


@command()
@scene_argument
@output_option
@click.option(
    "--driver",
    metavar="N",
    type=int,
    help="Move only this one of several drivers, counted from 1; the others stay still.",
)
@click.option(
    "--steps",
    metavar="N",
    type=click.IntRange(4, 1_000_000),
    default=360,
    show_default=True,
    help="Positions in a whole turn, in a range, or in the time shown.",
)
@click.option(
    "--from",
    "low",
    metavar="NUMBER",
    type=float,
    help="Start here instead of at the start of the range.",
)
@click.option("--to", "high", metavar="NUMBER", type=float, help="End here (degrees, lengths, s).")
@click.option(
    "--positions",
    metavar="N",
    type=click.IntRange(1, 10_000),
    help="Also write a table of the motion in this many equal steps of the driver.",
)
@click.option(
    "--positions-from",
    "begin",
    type=click.Choice(["scene", "dead"]),
    default="scene",
    show_default=True,
    help="Count these positions from the scene's own one, or from a dead point: of the driver, or"
    " of the last link or block that reverses.",
)
@click.option(
    "--advantage",
    is_flag=True,
    help="Also report the extremes of every follower's speed over the driver's: 1 over its"
    " mechanical advantage without friction.",
)
@click.option(
    "--units",
    type=click.Choice(["SI", "scene"]),
    default="SI",
    show_default=True,
    help="Units of lengths, speeds, accelerations and forces in the tables: SI, or the scene's.",
)
@language_option
@formats_option(
    "csv,xlsx,parquet,svg,png,gif,html",
    "svg",
    "Kinds of file to write; the tables are always written as CSV. xlsx: the tables as one"
    " workbook; needs the extra [class]. parquet: each table as an Apache Parquet file. gif, html:"
    " mechanism and plans in motion, as a picture and as a page.",
)
@force_option
def cycle(
    name: str,
    settings: tuple[str, ...],
    folder: Path,
    driver: int | None,
    steps: int,
    low: float | None,
    high: float | None,
    positions: int | None,
    begin: Start,
    advantage: bool,
    units: str,
    lang: str | None,
    formats: str,
    force: bool,
) -> None:
    """Move the driver through a whole turn, or as far as it can go.

    Prints the driver's range, the dead points and change points by name, how far the followers go,
    the least and largest values of all that the scene asks for and of the transmission and pressure
    angles, and what the lengths of a single loop mean. Writes tables of the motion and of the
    extremes (CSV, SI units unless --units says otherwise), curves of all motions, paths of points
    and centrodes. Also draws the path of the driven pin with the region that the other links can
    reach. Curves are in the units of results, so that a scene in inches has them in in/s.

    Several drivers, and laws of time, are moved by the time: for one turn of the first driver, for
    one cycle to and fro if its law never makes a turn, or from --from to --to seconds.

    \b
    Examples:
      graphkin cycle pump --set n=7 -o cycles
      graphkin cycle mine.toml -o cycles --steps 720 --format png
      graphkin cycle pump --set n=7 -o cycles --format gif,html
      graphkin cycle offset-slider-crank -o cycles --positions 12 --positions-from dead --format csv
      graphkin cycle offset-slider-crank -o cycles --advantage --format csv
      graphkin cycle mine.toml -o cycles --units scene
    """
    known = ("csv", "xlsx", "parquet", "svg", "png", "gif", "html")
    kinds = option_words("--format", formats, known)
    from graphkin.cli.report.cycle_report import (
        agrees,
        cycle_lines,
        cycle_rows,
        extremes_rows,
        positions_lines,
    )
    from graphkin.motion.cycle import cycle as moved
    from graphkin.motion.equal_positions import equal_positions
    from graphkin.motion.extremes import all_extremes
    from graphkin.motion.sweep import bounds_in_si
    from graphkin.text.tables import csv_text
    from graphkin.writers.files import file_stem, refuse_folder, write_all

    mechanism = mechanism_of(name, settings)
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    refuse_folder(folder, [f"{stem}-cycle.csv"], force=force)
    first, last = bounds_in_si(mechanism.scene, driver, low, high)
    with working() as step:
        step("following the motion")
        found = moved(mechanism, driver=driver, steps=steps, low=first, high=last)
        step(f"looking for extremes in {len(found.at)} rows")
        reached = all_extremes(found, ratios=advantage)
        few = equal_positions(found, positions, begin) if positions else None
        step(f"holding {len(found.at)} rows to the vector loops")
        lines = [*cycle_lines(found, reached)]
    tell(lines)
    tell(positions_lines(few) if few is not None else ())
    length = mechanism.scene.units["length"] if units == "scene" else "m"
    tables = {"cycle": cycle_rows(found, length)}
    tables |= {"extremes": extremes_rows(found, reached, length)} if any(reached) else {}
    tables |= {"positions": cycle_rows(few, length)} if few is not None else {}
    files = {f"{stem}-{kind}.csv": csv_text(rows, "\n").encode() for kind, rows in tables.items()}
    files |= table_files(stem, tables, kinds)
    with working() as step:
        if curves := [kind for kind in kinds if kind in ("svg", "png")]:
            from graphkin.motion.curves.plane_paths import picture_files

            step("drawing the curves")
            files |= picture_files(found, stem, curves, lang)
        if {"gif", "html"} & {*kinds}:
            from graphkin.web.player import animation_files

            files |= animation_files(found, stem, kinds, lang, step)
    tell(["", *(str(path) for path in write_all(folder, files, force))])
    if not agrees(found):
        complain("the independent route does not agree with the construction")
        leave(FAILED)


def table_files(
    stem: str, tables: Mapping[str, Sequence[Sequence[Cell]]], kinds: Collection[str]
) -> dict[str, bytes]:
    """The tables of a motion as a workbook and as Parquet files, as far as they are asked for."""
    files: dict[str, bytes] = {}
    if "xlsx" in kinds:
        from graphkin.writers.workbook import workbook

        files[f"{stem}-cycle.xlsx"] = workbook(tables)
    if "parquet" in kinds:
        from graphkin.writers.parquet import parquet

        files |= {f"{stem}-{kind}.parquet": parquet(rows) for kind, rows in tables.items()}
    return files


@command()
@scene_argument
@output_option
@click.option(
    "--quick",
    is_flag=True,
    help="Use few positions for a first look: time decimals and balls at one, the pencil at four"
    " towards a dead point.",
)
@formats_option("svg,png", "svg,png", "Kinds of picture to write; the table is CSV.")
@force_option
def accuracy(
    name: str, settings: tuple[str, ...], folder: Path, quick: bool, formats: str, force: bool
) -> None:
    """Measure what accuracy costs in time.

    Runs the same positions with every method and compares the results with certified answers. The
    methods are doubles one by one and in batches, single and extended precision, decimals of up to
    120 digits, and balls that prove their radius. Newton's method on the loop equations, central
    differences and a pencil are compared too.

    Writes a table (CSV) and two pictures: digits and time of each method; errors towards a dead
    point. Ends with the times that you wait (load, solve, check, page) and the accuracy of drawing
    and numbers. The command takes about half a minute, groups of class III and higher take
    some minutes. The command explain measures what each quantity costs.

    \b
    Examples:
      graphkin accuracy pump -o accuracy
      graphkin accuracy mine.toml -o accuracy --quick
    """
    kinds = option_words("--format", formats, ("svg", "png"))
    from graphkin.accuracy.methods import QUICK, Effort
    from graphkin.accuracy.study import picture_files, study
    from graphkin.cli.report.accuracy_report import accuracy_lines, accuracy_table
    from graphkin.cli.report.explain_report import waits_lines, waits_of
    from graphkin.writers.files import file_stem, refuse_folder, write_all

    mechanism = mechanism_of(name, settings)
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    refuse_folder(folder, [f"{stem}-accuracy.csv"], force=force)
    effort = QUICK if quick else Effort()
    with working() as step:
        found = study(mechanism, scales_if_any(mechanism), effort, say=step)
    tell(accuracy_lines(found))
    tell(["", *waits_lines(waits_of(lambda: mechanism_of(name, settings)))])
    files = {f"{stem}-accuracy.csv": accuracy_table(found).encode()}
    files |= picture_files(found, stem, kinds)
    tell(["", *(str(path) for path in write_all(folder, files, force))])


def scales_if_any(mechanism: Mechanism) -> Scales | None:
    """The scale factors of the sheets; None, with a message, if the sheets cannot be drawn."""
    from graphkin.text.errors import GraphkinError

    try:
        return scales_of(mechanism)
    except GraphkinError as error:
        for problem in error.problems:
            complain(f"the pencil is left out: {problem}")
        return None
