"""Fills in the lecturer's own gradebook export: Moodle's, Canvas's, or any other table.

Every cell except the marks keeps its exact characters, with quotes, separators and line ends.
Order, language, ids and unknown columns therefore stay.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any

from msgspec import Struct

from graphkin.classroom.roster.read_roster import NAMES, POSSIBLE
from graphkin.classroom.roster.spreadsheets import (
    MOST_CELLS,
    ZIP,
    bytes_of,
    cell_text,
    folded,
    full_rows,
    open_sheet,
    opened,
    separator_of,
    too_large,
)
from graphkin.classroom.roster.students import EMAIL, Match, Signs
from graphkin.classroom.roster.students import signs as signs_of
from graphkin.text.errors import NO_WORDS, GraphkinError, Problem, RosterError, joined, message

COMMA = re.compile(r"[0-9]+,[0-9]+")
POINT = re.compile(r"[0-9]+\.[0-9]+")
NUMERIC = re.compile(r"[-+]?[0-9]")
"""The beginning of points, dates and ids, but not of names."""
EMPTY = ("", "-")
"""Cells without a mark."""
MAILS = {folded(name) for name in ("email", *EMAIL)}
PERSONS = {*MAILS, *(folded(h) for what, every in NAMES.items() for h in (what, *every))}
"""Heads of columns that identify a person."""
DECIMAL = re.compile(r"[0-9]+(?:\.[0-9]+)?", re.ASCII)
MAXIMA = {
    folded(name)
    for name in ("maximum grade", "nota maximă", "valutazione massima", "voto massimo", "max grade")
}
"""Heads of the column with an assignment's maximum in Moodle's grading worksheet."""
GRADES = {folded(name) for name in ("grade", "notă", "valutazione", "voto")}
"""Heads of the column for the points in Moodle's grading worksheet."""
COMPUTED = "(read only)"
"""The text in Canvas's row of maxima for a column that Canvas computes."""
NAMED = {folded(h) for what in ("name", "first", "last") for h in (what, *NAMES[what])}
"""Heads of columns with a person's name."""
NOBODY = Signs()


class GradebookError(GraphkinError):
    """A gradebook that cannot be filled in."""


class Cell(Struct, frozen=True):
    """The characters of a cell as they are in the file, and the text they mean."""

    raw: str
    text: str


class Gradebook(Struct, frozen=True):
    """An export in any format: its file name, and its cells row by row, the head first."""

    name: str
    rows: tuple[tuple[Cell, ...], ...]

    def filled(self, column: int, marks: Mapping[int, Fraction]) -> bytes:
        """The bytes of the file, with the marks of some lines in a column."""
        raise NotImplementedError


class CsvGradebook(Gradebook, frozen=True):
    """A gradebook as CSV, with the end of each line."""

    ends: tuple[str, ...]
    separator: str
    coding: str
    bom: bytes

    def filled(self, column: int, marks: Mapping[int, Fraction]) -> bytes:
        """The bytes with the marks; decimals are written like the others in the file."""
        comma = writes_comma(self, column)
        rows = list(self.rows)
        for line, mark in marks.items():
            rows[line] = with_mark(rows[line], column, mark_text(mark, comma), self.separator)
        text = "".join(
            self.separator.join(each.raw for each in row) + end
            for row, end in zip(rows, self.ends, strict=True)
        )
        errors = "surrogateescape" if self.coding == "cp1250" else "strict"
        return self.bom + text.encode(self.coding, errors)


class Filled(Struct, frozen=True):
    """The place of the marks in a gradebook, and its bytes with the marks.

    ``place`` is the column; ``lines`` maps lines to student ids. Both count from zero, lines from
    the head. ``absent`` are students of the class who are not in the gradebook.

    ``worth`` is the column's maximum, where the file states it, as Canvas does. ``replaced`` counts
    the marks that replace other content. ``strangers`` are the names in rows of nobody in the
    class, by row number.
    """

    place: int
    column: str
    lines: Mapping[int, str]
    absent: tuple[str, ...]
    worth: Fraction | None
    replaced: int
    strangers: Mapping[int, str]
    data: bytes

    @property
    def count(self) -> int:
        """How many marks there are."""
        return len(self.lines)


def with_marks(
    book: Gradebook,
    marks: Mapping[str, Fraction],
    column: str | None = None,
    signs: Signs = NOBODY,
    match: Match = "",
) -> Filled:
    """The gradebook with the marks in a column; students are found by id or e-mail address.

    ``signs`` identify the whole class, including students without a mark. Raises GradebookError
    where no column holds ids or addresses, where the column for marks is unclear, and where a
    student occurs twice.
    """
    signs = signs if signs.ids else signs_of(marks)
    where = id_column(book, signs, match)
    target = mark_column(book, [each.text for each in book.rows[0]], column, where)
    refuse_names(book, target, where)
    lines: dict[int, str] = {}
    met: set[str] = set()
    twice: list[Problem] = []
    ours = tuple(students(book, where, signs, match))
    for line, who in ours:
        if who not in marks:
            continue
        if who in met:
            twice.append(
                Problem(
                    message("{table}, row {row}", table=book.name, row=line + 1),
                    message('"{who}" is in the table twice', who=who),
                )
            )
        lines[line] = who
        met.add(who)
    if twice:
        raise GradebookError(twice)
    absent = tuple(who for who in marks if who not in met)
    before = {line: text_at(book.rows[line], target) for line in lines}
    replaced = sum(is_other(text, marks[lines[line]]) for line, text in before.items())
    head = book.rows[0][target].text
    worth, others = worth_of(book, target), strangers(book, where, {line for line, _ in ours})
    data = book.filled(target, {line: marks[who] for line, who in lines.items()})
    return Filled(target, head, lines, absent, worth, replaced, others, data)


def students(book: Gradebook, where: int, signs: Signs, match: Match) -> Iterator[tuple[int, str]]:
    """The student of each line, by id.

    A line without an id is matched by its e-mail address, unless ``match`` is "id" or another line
    has that student's id.
    """
    known = {
        line: who
        for line, row in rows_of(book)
        if (who := signs.who(text_at(row, where))) is not None
    }
    yield from known.items()
    for line, row in rows_of(book) if match != "id" else ():
        found = {signs.emails.get(each.text.casefold()) for each in row} - {None}
        if text_at(row, where) in EMPTY and len(found) == 1:
            (who,) = found
            if who is not None and who not in known.values():
                yield line, who


def strangers(book: Gradebook, where: int, ours: Collection[int]) -> dict[int, str]:
    """The names in rows that have an id or address of nobody in the class, by row number."""
    names = [i for i, head in enumerate(book.rows[0]) if folded(head.text) in NAMED]
    found: dict[int, str] = {}
    for line, row in rows_of(book):
        sign = text_at(row, where)
        if line not in ours and sign not in EMPTY:
            found[line + 1] = " ".join(filter(None, (text_at(row, i) for i in names))) or sign
    return found


def refuse_names(book: Gradebook, column: int, ids: int) -> None:
    """Raise GradebookError for a column that identifies persons: no mark goes there."""
    head = book.rows[0][column].text
    texts = [text_at(row, column) for row in of_students(book, ids)]
    filled_in = [text for text in texts if text not in EMPTY]
    words = [text for text in filled_in if not NUMERIC.match(text)]
    if column == ids or folded(head) in PERSONS or 2 * len(words) > max(len(filled_in), 1):
        found = message(
            '"{head}" holds the ids, no points'
            if column == ids
            else '"{head}" holds names or texts, no points',
            head=head,
        )
        hint = message("name another one with --column")
        raise GradebookError.at(book.name, found, message("one for points"), hint)


def text_at(row: Sequence[Cell], column: int) -> str:
    """The text of a cell; empty where the row is too short."""
    return row[column].text if column < len(row) else ""


def is_other(text: str, mark: Fraction) -> bool:
    """Whether a cell holds something else than the mark to be put there."""
    number = text.replace(",", ".")
    if DECIMAL.fullmatch(number):
        return float(number) != float(mark_text(mark, comma=False))
    return text not in EMPTY


def worth_of(book: Gradebook, column: int) -> Fraction | None:
    """The maximum of a column; None where the file does not state it.

    Canvas has a row for it, Moodle's grading worksheet a column.
    """
    row = points_row(book)
    texts = {text_at(row, column)}
    for i, head in enumerate(book.rows[0]):
        if folded(head.text) in MAXIMA:
            texts = {text_at(row, i) for row in book.rows[1:] if text_at(row, i)}
    text = texts.pop().replace(",", ".") if len(texts) == 1 else ""
    return Fraction(text) if DECIMAL.fullmatch(text) else None


def points_row(book: Gradebook) -> Sequence[Cell]:
    """Canvas's row with the maximum of each column; empty where there is none."""
    return next((row for row in book.rows[1:4] if is_possible(row)), ())


def rows_of(book: Gradebook) -> Iterator[tuple[int, Sequence[Cell]]]:
    """The rows below the head with their lines, without Canvas's row of maxima."""
    every = enumerate(book.rows[1:], 1)
    return ((line, row) for line, row in every if not is_possible(row))


def is_possible(row: Sequence[Cell]) -> bool:
    """Whether a row is Canvas's row of maxima."""
    return any(each.text == POSSIBLE for each in row[:1])


def id_column(book: Gradebook, signs: Signs, match: Match) -> int:
    """The column in which most cells are ids of the class, whatever its name.

    Without one, the column with the most e-mail addresses, or with ids that lack leading zeros.
    """
    counts = {
        "id": known_cells(book, lambda text: text in signs.exact),
        "email": known_cells(book, lambda text: text.casefold() in signs.emails),
        "bare": known_cells(book, lambda text: text.isdecimal() and signs.who(text) is not None),
    }
    tried = {"id": ("id", "bare"), "email": ("email",)}.get(match, tuple(counts))
    for what in tried:
        best = max(range(len(book.rows[0])), key=lambda i: counts[what][i])
        students = sum(bool(text_at(row, best)) for row in book.rows[1:])
        if counts[what][best] and (what != "bare" or 2 * counts[what][best] > students):
            return best
    meant = {"id": message("ids"), "email": message("e-mail addresses")}.get(
        match, message("ids or e-mail addresses")
    )
    hint = message("the {meant} of the class list must be those of one of its columns", meant=meant)
    if match != "id" and not signs.emails:
        hint = joined("; ", (hint, message("the class list has no column e-mail")))
    raise GradebookError.at(
        book.name, message("no column holds {meant} of this class", meant=meant), NO_WORDS, hint
    )


def known_cells(book: Gradebook, is_known: Callable[[str], bool]) -> Counter[int]:
    """How many cells of each column identify a student of the class."""
    return Counter(
        i
        for row in book.rows[1:]
        for i, each in enumerate(row)
        if each.text and is_known(each.text)
    )


def mark_column(book: Gradebook, head: Sequence[str], column: str | None, ids: int) -> int:
    """The column for the marks: the named one, else the only empty one.

    Columns for feedback and columns that Canvas computes do not count. Of several empty columns,
    one with Moodle's own name is used.
    """
    students = of_students(book, ids)
    if column is not None:
        found = [i for i, text in enumerate(head) if folded(text) == folded(column)]
        found = found or [i for i, text in enumerate(head) if folded(column) in folded(text)]
        found = [i for i in found if not is_comment(head[i])] or found
    else:
        full = {i for i, each in enumerate(points_row(book)) if each.text == COMPUTED}
        full |= {i for row in students for i, each in enumerate(row) if each.text not in EMPTY}
        found = [
            i for i, name in enumerate(head) if name and i not in full and not is_comment(name)
        ]
        found = [i for i in found if folded(head[i]) in GRADES] or found
    if len(found) != 1:
        words = (
            message(
                '"{column}" is several columns' if found else '"{column}" is no column',
                column=column,
            )
            if column
            else message("{count} columns are empty", count=len(found))
            if found
            else message("no column is empty")
        )
        lacking = {i for i in range(len(head)) for row in students if text_at(row, i) in EMPTY}
        meant = [head[i] for i in found or sorted(lacking) if head[i]]
        meant = meant or [text for text in head if text]
        names = ", ".join(f'"{text}"' for text in meant)
        raise GradebookError.at(
            book.name,
            words,
            message("one of {names}", names=names),
            message("name the column with --column"),
        )
    return found[0]


def of_students(book: Gradebook, ids: int) -> list[Sequence[Cell]]:
    """The rows of students, which have an entry in the id column; averages have none."""
    return [row for _, row in rows_of(book) if text_at(row, ids)]


def is_comment(head: str) -> bool:
    return head.casefold().startswith(("feedback", "comment", "commenti", "comentarii"))


def writes_comma(book: CsvGradebook, target: int) -> bool:
    """Whether a gradebook writes decimals with a comma, judged by its other numbers."""
    texts = [each.text for row in book.rows[1:] for i, each in enumerate(row) if i != target]
    commas = sum(COMMA.fullmatch(text) is not None for text in texts)
    points = sum(POINT.fullmatch(text) is not None for text in texts)
    return commas > points or (commas == points and book.separator == ";")


def mark_text(mark: Fraction, comma: bool) -> str:
    """A mark with at most two decimals."""
    text = f"{float(mark):.2f}".rstrip("0").rstrip(".")
    return text.replace(".", ",") if comma else text


def with_mark(row: tuple[Cell, ...], column: int, text: str, separator: str) -> tuple[Cell, ...]:
    """A row with a mark in a column.

    The mark is quoted where the old cell was quoted, or where the mark contains the separator.
    """
    cells = list(row) + [Cell("", "")] * (column + 1 - len(row))
    quoted = cells[column].raw.strip().startswith('"') or separator in text
    cells[column] = Cell(f'"{text}"' if quoted else text, text)
    return tuple(cells)


# --- a gradebook export as CSV --------------------------------------------------------------------


BOMS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}


def read_gradebook(path: Path) -> Gradebook:
    """Read an export, CSV or XLSX. Raises GradebookError where it is no table."""
    data = bytes_of(path)
    if data.startswith(ZIP):
        return read_workbook(data, path.name)
    bom = next((mark for mark in BOMS if data.startswith(mark)), b"")
    coding = BOMS.get(bom, "utf-8").removesuffix("-sig")
    try:
        text = data[len(bom) :].decode(coding)
    except UnicodeDecodeError:
        text, coding = data.decode("cp1250", "surrogateescape"), "cp1250"
    separator = separator_of(text)
    rows, ends = split(text, separator, path.name)
    if len(rows) < 2:
        raise GradebookError.at(
            path.name, message("has no row below its head"), message("a gradebook")
        )
    return CsvGradebook(path.name, rows, ends, separator, coding, bom)


def split(
    text: str, separator: str, name: str
) -> tuple[tuple[tuple[Cell, ...], ...], tuple[str, ...]]:
    """The rows of cells of a CSV text and their line ends; quotes and spaces are kept.

    Raises GradebookError for a quote that is never closed, or where there are too many cells.
    """
    piece = re.compile(
        rf'([^\S\r\n{separator}]*+"[^"]*+(?:""[^"]*+)*+"|)([^\r\n{separator}]*+)'
        rf"({separator}|\r\n|\r|\n|\Z)"
    )
    rows: list[tuple[Cell, ...]] = []
    ends: list[str] = []
    row: list[Cell] = []
    for count, found in enumerate(piece.finditer(text), 1):
        quoted, rest, end = found.groups("")
        if count > MOST_CELLS:
            raise GradebookError(
                too_large(name, message("more than {most} cells", most=MOST_CELLS)).problems
            )
        if not quoted and rest.lstrip().startswith('"'):
            place = f"{name}, row {len(rows) + 1}"
            raise GradebookError.at(
                place, message("a quote that is opened and never closed"), message('a closing "')
            )
        if end or row or quoted or rest:
            row.append(cell(quoted + rest))
        if end != separator and row:
            rows.append(tuple(row))
            ends.append(end)
            row = []
        if not end:
            break
    return tuple(rows), tuple(ends)


def cell(raw: str) -> Cell:
    """A cell from its characters: the text without quotes and spaces around it."""
    bare = raw.strip()
    if len(bare) >= 2 and bare[0] == bare[-1] == '"':
        return Cell(raw, bare[1:-1].replace('""', '"').strip())
    return Cell(raw, bare)


KEPT_PARTS = re.compile(
    r"(?!xl/).*|xl/(_rels/.*|(workbook|styles|sharedStrings|calcChain)\.xml|theme/.*|tables/.*"
    r"|(worksheets|externalLinks)/(_rels/)?[^/]*|printerSettings/.*|comments.*"
    r"|drawings/vmlDrawing[^/]*|vbaProject.*)"
)
"""The parts of a workbook whose contents openpyxl writes again as it has read them."""
EXTENSIONS = b"<extLst"
"""What begins the things in a sheet that openpyxl does not read, such as sparklines."""
PACKED = (1980, 1, 1, 0, 0, 0)
"""The date of each part of a written workbook, so that equal marks give equal files."""


class Workbook(Gradebook, frozen=True):
    """An export as XLSX: its bytes, and the cells of the sheet that was open last.

    An empty row has no cells. ``formulas`` are the places of formulas, by line and column from
    zero.
    """

    data: bytes
    formulas: frozenset[tuple[int, int]]

    def filled(self, column: int, marks: Mapping[int, Fraction]) -> bytes:
        """The bytes with the marks; programs compute the formulas anew when they open the file.

        Raises GradebookError where a mark would replace a formula, and where the workbook holds
        something that would be lost.
        """
        from openpyxl.cell.cell import MergedCell

        if not marks:
            return self.data
        refuse_loss(self)
        with workbook(self.data, self.name, read_only=False) as book:
            for line, mark in marks.items():
                cell = open_sheet(book).cell(line + 1, column + 1)
                if (line, column) in self.formulas or isinstance(cell, MergedCell):
                    where = f"{self.name}, row {line + 1}"
                    text = self.rows[0][column].text
                    if isinstance(cell, MergedCell):
                        found = message('"{text}" holds merged cells', text=text)
                    else:
                        found = message('"{text}" holds a formula', text=text)
                    hint = message("name another one with --column")
                    expected = message("a column for points")
                    raise GradebookError.at(where, found, expected, hint)
                cell.value = float(mark_text(mark, comma=False))
            book.calculation.fullCalcOnLoad = True
            return saved(book)


@contextmanager
def workbook(data: bytes, name: str, *, read_only: bool) -> Iterator[Any]:
    """The workbook, opened with its formulas. Raises GradebookError where it is none."""
    try:
        with opened(data, name, data_only=False, read_only=read_only) as book:
            yield book
    except RosterError as error:
        raise GradebookError(error.problems) from error


def refuse_loss(book: Workbook) -> None:
    """Raise GradebookError for a workbook with pictures, charts or others that would be lost."""
    with zipfile.ZipFile(io.BytesIO(book.data)) as packed:
        names = packed.namelist()
        lost = [name for name in names if not KEPT_PARTS.fullmatch(name)]
        sheets = [name for name in names if name.startswith("xl/worksheets/")]
        lost += [f"extLst of {name}" for name in sheets if EXTENSIONS in packed.read(name)]
    if lost:
        found = message("has parts that would be lost: {parts}", parts=", ".join(lost))
        expected = message("cells, formats and formulas, without pictures or charts")
        hint = message("save the sheet with the marks as CSV UTF-8 and name that file")
        raise GradebookError.at(book.name, found, expected, hint)


def saved(book: Any) -> bytes:
    """The bytes of a workbook, the same for the same cells at any time."""
    from openpyxl.writer.excel import ExcelWriter

    written, found = io.BytesIO(), io.BytesIO()
    ExcelWriter(book, zipfile.ZipFile(written, "w")).save()
    with zipfile.ZipFile(written) as packed, zipfile.ZipFile(found, "w") as again:
        for part in packed.infolist():
            named = zipfile.ZipInfo(part.filename, PACKED)
            again.writestr(named, packed.read(part), zipfile.ZIP_DEFLATED)
    return found.getvalue()


def read_workbook(data: bytes, name: str) -> Workbook:
    """Read an export as XLSX. Raises GradebookError where it is no table."""
    rows: list[tuple[Cell, ...]] = []
    formulas: set[tuple[int, int]] = set()
    with workbook(data, name, read_only=True) as book:
        for number, cells in full_rows(open_sheet(book), name):
            rows += [()] * (number - 1 - len(rows))
            formulas |= {(len(rows), i) for i, c in enumerate(cells) if c.data_type == "f"}
            rows.append(tuple(Cell(text, text.strip()) for text in map(cell_text, cells)))
    if not rows or not rows[0]:
        raise GradebookError.at(
            name, message("has nothing in its first row"), message("the names of columns")
        )
    if len(rows) < 2:
        raise GradebookError.at(name, message("has no row below its head"), message("a gradebook"))
    return Workbook(name, tuple(rows), data, frozenset(formulas))
