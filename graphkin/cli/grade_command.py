"""The command ``grade``: mark the answers of a class against each student's own drawing."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from os.path import relpath
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphkin.cli.folder_options import class_argument
from graphkin.cli.options import (
    FAILED,
    command,
    complain,
    formats_option,
    jobs_option,
    lang_option,
    say,
)

if TYPE_CHECKING:
    from fractions import Fraction

    from graphkin.classroom.grading.answers import Answers
    from graphkin.classroom.grading.desk_rulings import DeskDecided
    from graphkin.classroom.grading.feedback import DrawingBack
    from graphkin.classroom.grading.gradebook import Filled
    from graphkin.classroom.grading.graded import DrawingRemark, Graded, Result
    from graphkin.classroom.printing.edition import Edition
    from graphkin.classroom.roster.students import Match
    from graphkin.text import Words
    from graphkin.text.errors import Refusals

KINDS = ("html", "pdf")
MANY = 100
"""The number of different variants above which several processes are faster."""
TERMINAL = "en"
"""The language of the terminal, which all commands and all errors use."""
AMOUNT = re.compile(r"[0-9]{1,6}(?:\.[0-9]{1,4})?", re.ASCII)
SHOWN = 10
"""The most notes of one kind that are printed."""


@command("grade")
@class_argument
@click.argument("answers", metavar="ANSWERS", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    "report",
    metavar="REPORT",
    type=click.Path(path_type=Path),
    help="Folder to write into, made if it is missing; DIR/report by default.",
)
@lang_option(
    "Language of the report, and of the feedback to students without one in the class list"
    " (language, limba, lingua); by default that of the class. Messages are in English."
)
@formats_option("html,pdf", "html,pdf", "Kinds of feedback page to write for each student.")
@click.option(
    "--gradebook",
    "gradebooks",
    metavar="FILE",
    multiple=True,
    type=click.Path(path_type=Path),
    help="An export of your own from Moodle or Canvas (CSV or XLSX) to fill in; repeatable.",
)
@click.option(
    "--column",
    metavar="NAME",
    help="The gradebook column for the points; by default the empty one.",
)
@click.option(
    "--scale",
    metavar="N",
    help="Full marks in the gradebooks, such as 10 or 100; the lab's points by default.",
)
@click.option(
    "--match",
    type=click.Choice(["id", "email"]),
    help="How to identify students in tables of answers and gradebooks; by default by id or, if a"
    " table has no ids, by the e-mail addresses of the class list.",
)
@jobs_option(
    "Processes that mark at once; by default one, or all cores for over a hundred variants."
)
@click.option(
    "--release",
    "released",
    metavar="ID",
    multiple=True,
    help="A student who gets a mark although the lab holds it (hold = true), now and whenever this"
    " report is marked again; repeatable.",
)
@click.option(
    "--hold",
    "held",
    metavar="ID",
    multiple=True,
    help="A released student to hold again; repeatable.",
)
@click.option(
    "--as-it-is",
    is_flag=True,
    help="Mark the class even where its answers look like those of another table, lab or scale.",
)
@click.option("--force", is_flag=True, help="Replace an earlier report, and list what changed.")
@click.pass_context
def grade(  # noqa: PLR0915
    context: click.Context,
    folder: Path,
    answers: Path,
    report: Path | None,
    lang: str | None,
    formats: str,
    gradebooks: tuple[Path, ...],
    column: str | None,
    scale: str | None,
    match: Match | None,
    jobs: int | None,
    released: tuple[str, ...],
    held: tuple[str, ...],
    as_it_is: bool,
    force: bool,
) -> None:
    """Mark the answers of a class.

    DIR is the folder that graphkin variants wrote. ANSWERS is a table, a folder, a ZIP file, or the
    folder that graphkin read wrote.

    A table is a CSV or XLSX file with a column id, a column for each field of the form (v_D_mm,
    v_D, omega_3, omega_3_sense, …), and a row for each student. A folder or a ZIP file holds one
    file for each student, in a folder of its own or not, as Moodle and Canvas deliver submissions.

    Numbers may have a decimal comma or point, and a unit. A sense is + or -, ccw or cw, or words in
    a language of the sheets (în sens orar, anticlockwise). A sense that contradicts the sign of
    its own value earns nothing. An empty cell is an unanswered field; an empty row is a form that
    was not handed in.

    A cell that cannot be read is reported. Its points wait, and no gradebook gets the marks of that
    student until you correct the cell and mark again. The same holds for a file or row that cannot
    be read, or that is signed with the id of another student. All other answers are marked.

    The class is looked at as a whole first. Nothing is marked where rows or columns are shifted or
    in another order, where columns lost their decimal points, where all lengths, or all speeds and
    accelerations, are off by one power of ten, or where the answers are those of another lab or
    scale. A single column in another unit is marked. --as-it-is marks such a class.

    The tolerance of a value is the error of a careful pencil in that student's own drawing;
    tolerances.csv lists the tolerances. A sheet with wrong values is first explained as a whole: a
    cause that is known by name costs once, and everything that agrees with it is right. Any other
    wrong value is compared with what follows from the student's own earlier values. Writes
    marks.csv, a feedback page for each student and a report on the class, and fills in gradebooks.
    Where students have several sheets, students.csv and gradebooks have the sum of their points.

    You have the last word: REPORT/decisions.csv is yours and is never overwritten. Its columns are
    id;field;points;reason. A row sets the points of a field, or of the whole form (total). Without
    points the mark stays; "?" records a student's request that is not yet decided. Mark again with
    --force to update feedback, report and gradebook.

    A row or column named drawing holds what a student drew on the board of the task page. Fields in
    mm that are left empty are measured on the drawing, and the feedback page shows it in green and
    red. A drawing that cannot be drawn again waits like a cell that cannot be read.

    graphkin desk REPORT shows everything that waits for you, one by one, and keeps what you decide.
    Mark again with --force to apply it. Put what students object to into REPORT/appeals.csv, with
    the columns id;field;text: it is on the desk too.

    Students can save score sheets from "your turn" on their pages, as ID-turn.json in the same
    folder as their answers. These sheets are listed in turns.csv; they earn nothing and prove
    nothing.

    If lab.toml has hold = true in [marking], some students get no mark until you decide: those
    whose answers fit another student's data or are another student's answers. To decide, add a row
    to decisions.csv, or mark again with --force and --release ID. The report remembers the released
    students for every later marking, until --hold ID.

    \b
    Examples:
      graphkin grade class answers.csv -o report
      graphkin grade class answers.xlsx -o report --gradebook moodle.csv --column "Lab 3"
      graphkin grade class submissions.zip -o report --gradebook moodle.csv --scale 10
      graphkin grade class answers.csv -o report --force
      graphkin grade class answers.csv -o report --force --release 0042 --release 0057
      graphkin grade class answers.csv -o report --force --hold 0057

    \b
    Exit status: 0 success; 1 some cells, rows or files cannot be read; 2 nothing was marked.
    """
    from msgspec.structs import replace

    from graphkin.classroom.grading.answers import read_answers
    from graphkin.classroom.grading.class_marking import graded_class
    from graphkin.classroom.grading.class_report import open_cells, result_lines
    from graphkin.classroom.grading.decisions import (
        DECISIONS,
        EMPTY,
        Deciding,
        read_decisions,
        releases,
        settled,
    )
    from graphkin.classroom.grading.desk_rulings import (
        all_decisions,
        desk_decided,
        read_appeals,
        read_as,
    )
    from graphkin.classroom.grading.gradebook import read_gradebook, with_marks
    from graphkin.classroom.grading.grading_files import (
        KEPT_MARKS,
        gradebook_name,
        kept_marks,
        points_by_id,
    )
    from graphkin.classroom.grading.turn_scores import TURNS, read_turns, turns_table
    from graphkin.classroom.printing.edition import read_edition
    from graphkin.text import words as words_in
    from graphkin.text.errors import Refusals
    from graphkin.writers.commit import settle
    from graphkin.writers.files import write_all

    kinds = kinds_of(formats, context)
    if len({path.name for path in gradebooks}) < len(gradebooks):
        raise click.UsageError("--gradebook: two files of the same name", context)
    opened = read_edition(folder)
    ids = {taker.student.id: taker.code for taker in opened.takers}
    refuse_strangers(context, "--release", released, ids)
    refuse_strangers(context, "--hold", held, ids)
    if both := ", ".join(who for who in released if who in held):
        raise click.UsageError(f"--release, --hold: {both} cannot be both", context)
    full = scale_of(scale, context)
    out = report or folder / "report"
    settle(out)
    free = releases(out, tuple(ids), released, held)
    deciding = Deciding(opened.takers, opened.book.form, opened.book.lab.rubric, opened.signs)
    table, desk = read_decisions(out, deciding), desk_decided(out, deciding)
    fields = {taker.student.id: deciding.worth_of(taker) for taker in opened.takers}
    appeals = read_appeals(out, opened.signs, fields)
    decisions = all_decisions(table, desk.decisions, appeals.every)
    if both := ", ".join(who for who in held if who in settled(decisions)):
        said = f"--hold: {both} is decided: take the row out of {DECISIONS}, or undo it at the desk"
        raise click.UsageError(said, context)
    refusals = Refusals()
    drawings, answers = answers, drawn_table(opened, answers, refusals)
    given = read_answers(answers, opened.book.form, opened.signs, match or "")
    if drawings != answers:
        note_handwritten(opened, drawings, given)
    given.of = read_as(given.of, desk.readings, opened.book.form)
    if drawings != answers:
        note_followed(opened, drawings, given, refusals)
    pictures = boards(opened, given, refusals)
    turns = read_turns(answers, ids, refusals)
    words = opened.words(lang)
    processes = jobs or usual_jobs(opened)
    found = graded_class(
        opened.book, opened.takers, given.of, processes, free.ids, decisions, as_it_is=as_it_is
    )
    pins = pins_of(opened, drawings) if drawings != answers else {}
    found = replace(found, graded=tuple(remarked(g, desk.remarks, pins) for g in found.graded))
    asked, given.unread = given.unread, open_cells(found, given.unread)
    for who, problems in found.refused.items():
        refusals.add(who, problems)
    files = all_files(opened, found, given, words, kinds, out, refusals, pictures) | free.files()
    cells = [c for c in asked if c in given.unread or (c.who, c.field) in desk.readings]
    readings = relpath(drawings, out) if drawings != answers else ""
    files[KEPT_MARKS] = kept_marks(found, opened.book.form, cells, readings)
    if drawings != answers:
        files |= marked_drawings(opened, drawings, words, kinds, refusals)
    files |= {} if (out / DECISIONS).exists() else {DECISIONS: EMPTY}
    files |= {TURNS: turns_table(turns)} if turns else {}
    spoken = words_in(TERMINAL)
    points = points_by_id(found, full)
    books = {
        path: with_marks(read_gradebook(path), points, column, opened.owners, match or "")
        for path in gradebooks
    }
    files |= {gradebook_name(path): book.data for path, book in books.items()}
    written = write_all(out, files, force)
    tell_books(books, found, spoken, full)
    for line in result_lines(found, spoken):
        say(line)
    if free.ids and opened.book.lab.rubric.hold:
        say(spoken("class.released", who=", ".join(free.ids)))
    if turns:
        say(spoken("class.turns", count=len(turns), file=TURNS))
    changes(files, spoken)
    notes(opened, given, refusals, spoken)
    left_out = [*desk_lines(desk, spoken), *map(str, appeals.problems)]
    tell_some(left_out, spoken)
    say("")
    for path in paths_printed(written):
        say(path)
    if given.unread or given.refused or refusals.found or left_out:
        context.exit(FAILED)


def pins_of(opened: Edition, folder: Path) -> dict[str, tuple[DrawingRemark, ...]]:
    """The remarks pinned to the drawings of each student, by id."""
    from graphkin.reading.marked_drawing import pinned_remarks

    owners = {taker.code: taker.student.id for taker in opened.takers}
    pins_by_code = pinned_remarks(folder)
    return {owners[code]: pins for code, pins in pins_by_code.items() if code in owners}


def remarked(
    graded: Graded,
    remarks: Mapping[tuple[str, str], str],
    pins: Mapping[str, tuple[DrawingRemark, ...]],
) -> Graded:
    """A student's marks with the lecturer's remarks."""
    from msgspec.structs import replace

    who = graded.taker.student.id
    own = {field: text for (of, field), text in remarks.items() if of == who}
    return replace(graded, remarks=own, pins=pins.get(who, ()))


def desk_lines(desk: DeskDecided, words: Words) -> Iterator[str]:
    """A line for each decision of the desk that does not count."""
    for each in desk.strangers:
        yield words("class.desk_stranger", who=each.who, field=each.field or words("class.whole"))
    for rivals in desk.rivals:
        about = rivals[-1].what
        markers = words("list_mark").join(dict.fromkeys(each.line.by for each in rivals))
        field = about.field or words("class.whole")
        yield words("class.desk_rivals", who=about.who, field=field, markers=markers)


def is_read(answers: Path) -> bool:
    """Whether the answers are a folder of drawings that graphkin read."""
    from graphkin.reading.settled_points import READING

    return answers.is_dir() and any(answers.glob(f"*{READING}"))


def drawn_table(opened: Edition, folder: Path, refusals: Refusals) -> Path:
    """The table of what was read and decided so far, for readings; else the path itself."""
    if not is_read(folder):
        return folder
    from graphkin.reading.drawn_answers import ANSWERS
    from graphkin.reading.read_run import write_answers

    write_answers(opened, folder, refusals)
    return folder / ANSWERS


def note_handwritten(opened: Edition, folder: Path, given: Answers) -> None:
    """Let the fields wait whose numbers are in the tables of a photographed sheet."""
    from graphkin.reading.handwritten_answers import add_handwritten

    add_handwritten(opened, folder, given)


def note_followed(opened: Edition, folder: Path, given: Answers, refusals: Refusals) -> None:
    """Flag answers that follow from a student's own earlier points in the drawing."""
    from msgspec.structs import replace

    from graphkin.reading.drawn_answers import drawn_rows

    for row in drawn_rows(opened, folder, refusals):
        own = given.of.get(row.who, {})
        own |= {field: replace(own[field], followed=True) for field in row.followed if field in own}


def boards(opened: Edition, given: Answers, refusals: Refusals) -> dict[str, DrawingBack]:
    """The drawings made on task pages, in green and red; what they answer is added."""
    if not given.drawings:
        return {}
    from graphkin.reading.board_drawing import add_drawings

    return add_drawings(opened, given, refusals)


def marked_drawings(
    opened: Edition, folder: Path, words: Words, kinds: tuple[str, ...], refusals: Refusals
) -> dict[str, bytes]:
    """The drawings of all students who were read, with marks in green and red."""
    from graphkin.classroom.grading.grading_files import FEEDBACK
    from graphkin.reading.marked_drawing import drawings_of_class

    found = drawings_of_class(opened, folder, words, kinds, refusals)
    return {f"{FEEDBACK}/{name}": data for name, data in found.items()}


def refuse_strangers(
    context: click.Context, option: str, named: tuple[str, ...], ids: Collection[str]
) -> None:
    """Raise UsageError for ids that belong to no student."""
    if unknown := ", ".join(who for who in named if who not in ids):
        raise click.UsageError(f"{option}: {unknown} is no student of this class", context)


def usual_jobs(opened: Edition) -> int:
    """The default number of processes: all cores if there are many different variants, else one."""
    from graphkin.classroom.printing.workers import cores

    variants = {tuple(sorted(taker.settings.items())) for taker in opened.takers}
    return cores() if len(variants) > MANY else 1


def kinds_of(text: str, context: click.Context) -> tuple[str, ...]:
    """The kinds of feedback page, given with commas between them; ``none`` is allowed."""
    kinds = tuple(dict.fromkeys(part.strip().lower() for part in text.split(",") if part.strip()))
    wrong = [kind for kind in kinds if kind not in (*KINDS, "none")]
    if wrong:
        known = f"{', '.join(KINDS)} or none"
        raise click.UsageError(f"--format: {', '.join(wrong)} is not {known}", context)
    return kinds


def all_files(
    opened: Edition,
    found: Result,
    given: Answers,
    words: Words,
    kinds: tuple[str, ...],
    report: Path,
    refusals: Refusals,
    pictures: Mapping[str, DrawingBack],
) -> dict[str, bytes]:
    """The files of the report, with the changes since the marks already in its folder."""
    from graphkin.classroom.grading.grading_files import (
        MARKS,
        ReportSettings,
        report_files,
        returned,
    )
    from graphkin.scene.file_limits import whole_file

    scene = opened.book.mechanism({}).scene
    title = scene.title_in(words.language)
    before = report / MARKS
    earlier = whole_file(before) if before.is_file() else b""
    refused = list(refused_lines(opened, given, refusals, words))
    written = ReportSettings(
        title, words, given.unread, scene.titles, scene, refused, refusals, pictures
    )
    files = report_files(found, opened.lab, written, kinds, earlier)
    return files | returned(files, found.graded, given.senders, kinds)


def scale_of(text: str | None, context: click.Context) -> Fraction | None:
    """The points of full marks; None if the points are used as they are."""
    from fractions import Fraction

    if text is None:
        return None
    written = text.strip().replace(",", ".")
    if not AMOUNT.fullmatch(written) or not Fraction(written):
        raise click.UsageError(f"--scale: {text} is no number above 0, such as 10", context)
    return Fraction(written)


def tell_books(
    books: Mapping[Path, Filled], found: Result, words: Words, scale: Fraction | None
) -> None:
    """Report the gradebooks: the marks written, the students missing, and the unknown rows."""
    from graphkin.classroom.grading.answer_numbers import shown_cell
    from graphkin.classroom.grading.grading_files import number, of_one_student

    graded = found.graded
    held = [each.taker.student.id for each in graded if each.held]
    waiting = [each.taker.student.id for each in graded if each.pending and not each.held]
    for path, book in books.items():
        say(words("class.filled", file=path.name, count=book.count, column=book.column))
        sheets = of_one_student(found).values()
        points = scale or max((sum(each.points for each in own) for own in sheets), default=None)
        if book.worth != points:
            key = "class.worth_unknown" if book.worth is None else "class.worth"
            amounts = {"worth": number(book.worth or 0), "points": number(points or 0)}
            amounts = {name: words.decimal(amount) for name, amount in amounts.items()}
            if book.worth is not None or scale is None:
                complain(words(key, file=path.name, column=book.column, **amounts))
        if book.replaced:
            amounts = {"count": str(book.replaced), "column": book.column}
            complain(words("class.replaced", file=path.name, **amounts))
        kept = (("class.not_in", book.absent), ("class.waits", waiting), ("class.held_back", held))
        for key, who in kept:
            tell_some([words(key, file=path.name, who=each) for each in who], words)
        if book.strangers:
            rows = [f"{row} ({shown_cell(who)})" for row, who in book.strangers.items()]
            more = len(rows) - SHOWN
            others = words("class.more", count=more) if more > 0 else ""
            strangers = ", ".join(rows[:SHOWN]) + others
            complain(words("class.not_ours", file=path.name, who=strangers))


def changes(files: dict[str, bytes], words: Words) -> None:
    """Print how much a new marking changed, and the first changes."""
    from graphkin.classroom.grading.grading_files import CHANGES, change_lines

    if CHANGES in files:
        for line in change_lines(files[CHANGES], words):
            say(line)


def paths_printed(written: list[Path]) -> list[str]:
    """The paths written; feedback pages only as their folder and number."""
    from graphkin.classroom.grading.grading_files import FEEDBACK

    pages = [path for path in written if path.parent.name == FEEDBACK]
    lines = [str(path) for path in written if path.parent.name != FEEDBACK]
    return [*lines, f"{pages[0].parent}: {len(pages)} pages"] if pages else lines


def refused_lines(
    opened: Edition, given: Answers, refusals: Refusals, words: Words
) -> Iterator[str]:
    """A line for everything that is not marked, and for the students whose points wait."""
    from graphkin.classroom.grading.answers import merged

    yield from map(str, merged("", given.refused))
    yield from refusals.lines()
    if given.withheld:
        names = {taker.student.id: taker.student.called for taker in opened.takers}
        who = words("list_mark").join(names[each] for each in given.withheld)
        yield words("class.refused_who", who=who)


def notes(opened: Edition, given: Answers, refusals: Refusals, words: Words) -> None:
    """Print notes on the answers.

    The notes are on columns that are no fields, files that are no tables, unknown languages, cells
    that cannot be read, and answers that are not marked.
    """
    from graphkin.classroom.grading.class_report import language_lines, stranger_lines, unread_lines

    names = [taker.student for taker in opened.takers]
    tell_some(list(stranger_lines(given, earning(opened), words)), words)
    tell_some([words("class.no_table", who=each.name) for each in given.empty], words)
    tell_some(list(language_lines(opened.takers, words)), words)
    tell_some(list(unread_lines(names, given.unread, words)), words)
    if given.unread:
        complain(words("class.mend"))
    named = {taker.student.id: taker.student.called for taker in opened.takers}
    unlisted = given.unlisted.items()
    tell_some([words("class.by_id", name=by.name, who=named[who]) for who, by in unlisted], words)
    tell_some([words("class.not_read", file=name) for name in given.others], words)
    tell_some(list(refused_lines(opened, given, refusals, words)), words)
    if given.refused:
        complain(words("class.mend_files"))


def earning(opened: Edition) -> set[str]:
    """The fields that earn points on at least one student's form."""
    from graphkin.classroom.lab.items import asked_of

    form, points = opened.book.form, opened.book.lab.rubric.points
    every = (asked_of(form, points, taker.compute)[1] for taker in opened.takers)
    return {field for worths in every for field, worth in worths.items() if worth}


def tell_some(lines: list[str], words: Words) -> None:
    """Print the first notes, and how many more there are."""
    lines = list(dict.fromkeys(lines))
    for line in lines[:SHOWN]:
        complain(line)
    if len(lines) > SHOWN:
        complain(words("class.told_more", count=len(lines) - SHOWN))
