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
from copy import copy
from fractions import Fraction
from pathlib import Path
from typing import NoReturn
from xml.parsers.expat import ExpatError, ParserCreate

from msgspec import Struct
from openpyxl.utils import column_index_from_string, get_column_letter

from graphkin.classroom.roster.read_roster import NAMES, POSSIBLE
from graphkin.classroom.roster.spreadsheets import (
    MOST_CELLS,
    bytes_of,
    cell_text,
    folded,
    full_rows,
    open_sheet,
    opened,
    separator_of,
    too_large,
    unreadable,
)
from graphkin.classroom.roster.student_signs import EMAIL, Match, Signs
from graphkin.classroom.roster.student_signs import signs as signs_of
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
        raise GradebookError(Problem(book.name, found, message("one for points"), hint))


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
    raise GradebookError(
        Problem(
            book.name, message("no column holds {meant} of this class", meant=meant), NO_WORDS, hint
        )
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
        raise GradebookError(
            Problem(
                book.name,
                words,
                message("one of {names}", names=names),
                message("name the column with --column"),
            )
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
    if data.startswith(START):
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
        raise GradebookError(
            Problem(path.name, message("has no row below its head"), message("a gradebook"))
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
            raise GradebookError(
                Problem(
                    place,
                    message("a quote that is opened and never closed"),
                    message('a closing "'),
                )
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


START = b"PK\x03\x04"
"""The first bytes of an XLSX file, which is a ZIP file."""
WORKBOOK = re.compile(r"xl/workbook[0-9]*\.xml")
"""The part of the file that says how formulas are computed."""


class Workbook(Gradebook, frozen=True):
    """An export as XLSX: its bytes, and the cells of the sheet that was open last.

    An empty row has no cells. ``formulas`` are the places of formulas, by line and column from
    zero. ``sheet`` is the part of the file with this sheet, ``sheets`` are the parts with all
    sheets.
    """

    data: bytes
    formulas: frozenset[tuple[int, int]]
    sheet: str
    sheets: tuple[str, ...]

    def filled(self, column: int, marks: Mapping[int, Fraction]) -> bytes:
        """The bytes with the marks. Raises GradebookError where they would replace formulas."""
        wrong = [line for line in marks if (line, column) in self.formulas]
        if wrong:
            where = f"{self.name}, row {wrong[0] + 1}"
            text = message('"{text}" holds a formula', text=self.rows[0][column].text)
            hint = message("name another one with --column")
            raise GradebookError(Problem(where, text, message("a column for points"), hint))
        numbers = {
            (line + 1, column + 1): mark_text(mark, comma=False) for line, mark in marks.items()
        }
        try:
            return with_cells(self, numbers)
        except (ExpatError, ValueError) as error:
            raise GradebookError(unreadable(self.name).problems) from error


def read_workbook(data: bytes, name: str) -> Workbook:
    """Read an export as XLSX. Raises GradebookError where it is no table."""
    rows: list[tuple[Cell, ...]] = []
    formulas: set[tuple[int, int]] = set()
    try:
        with opened(data, name, data_only=False) as book:
            sheet = open_sheet(book)
            for number, cells in full_rows(sheet, name):
                rows += [()] * (number - 1 - len(rows))
                formulas |= {(len(rows), i) for i, c in enumerate(cells) if c.data_type == "f"}
                rows.append(tuple(Cell(text, text.strip()) for text in map(cell_text, cells)))
            parts = tuple(each._worksheet_path for each in book.worksheets)
            part = sheet._worksheet_path
    except RosterError as error:
        raise GradebookError(error.problems) from error
    if not rows or not rows[0]:
        raise GradebookError(
            Problem(name, message("has nothing in its first row"), message("the names of columns"))
        )
    if len(rows) < 2:
        raise GradebookError(
            Problem(name, message("has no row below its head"), message("a gradebook"))
        )
    return Workbook(name, tuple(rows), data, frozenset(formulas), part, parts)


def with_cells(book: Workbook, numbers: Mapping[tuple[int, int], str]) -> bytes:
    """The file with numbers in cells of its sheet; parts that need no change are copied."""

    found = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(book.data)) as packed, zipfile.ZipFile(found, "w") as again:
        changed: dict[str, bytes] = {}
        for name in book.sheets if numbers else ():
            xml = packed.read(name)
            new = with_numbers(xml, numbers if name == book.sheet else {})
            changed |= {name: new} if new != xml else {}
        if changed.keys() - {book.sheet} or (changed and book.formulas):
            main = filter(WORKBOOK.fullmatch, packed.namelist())
            changed |= {name: computed_anew(packed.read(name)) for name in main}
        for part in packed.infolist():
            content = packed.read(part)
            again.writestr(copy(part), changed.get(part.filename, content), part.compress_type)
    return found.getvalue()


# --- the XML of a workbook with new numbers in some cells; every other byte is kept ---------------


ROW = ["worksheet", "sheetData", "row"]
CELL = [*ROW, "c"]
FORMULA, VALUE = [*CELL, "f"], [*CELL, "v"]
PLACE = re.compile(r"([A-Z]+)[0-9]+")
TYPE = re.compile(rb"""\st\s*=\s*("[^"]*"|'[^']*')""")
COMPUTES = re.compile(rb"<([\w.-]+:)?calcPr\b[^>]*>")
FULL_CALCULATION = re.compile(rb"""\sfullCalcOnLoad\s*=\s*("[^"]*"|'[^']*')""")
BEFORE = re.compile(rb"</([\w.-]+:)?(?:sheets|functionGroups|externalReferences|definedNames)\s*>")
"""The ends of the elements after which a workbook says how it computes."""


def with_numbers(xml: bytes, numbers: Mapping[tuple[int, int], str]) -> bytes:
    """A worksheet with numbers in cells, by row and column from 1, without results of formulas.

    Every row of a number already holds a cell. Raises ExpatError or ValueError where the bytes are
    no worksheet that can be changed.
    """
    if b"\0" in xml:
        raise ValueError("not UTF-8")
    return Worksheet(xml, numbers).changed()


class Worksheet:
    """A parser of a worksheet that collects the replacements of byte ranges."""

    def __init__(self, xml: bytes, numbers: Mapping[tuple[int, int], str]) -> None:
        self.xml = xml
        self.rows: dict[int, dict[int, str]] = {}
        for (row, column), number in sorted(numbers.items()):
            self.rows.setdefault(row, {})[column] = number
        self.pieces: list[tuple[int, int, bytes]] = []
        self.path: list[str] = []
        self.row = self.column = 0
        self.tag = self.style = ""
        self.begin = 0
        self.formula = False
        self.value: tuple[int, int] | None = None
        self.parser = ParserCreate()
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.StartDoctypeDeclHandler = refuse

    def changed(self) -> bytes:
        """The bytes with all replacements made."""
        self.parser.Parse(self.xml, True)
        found, at = [], 0
        for begin, end, new in self.pieces:
            found += [self.xml[at:begin], new]
            at = end
        return b"".join([*found, self.xml[at:]])

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Handle the start of an element."""
        self.path.append(name.rpartition(":")[2])
        here = self.parser.CurrentByteIndex
        if self.path == ROW:
            self.row = int(attributes.get("r", self.row + 1))
            self.column = 0
        elif self.path == CELL:
            place = PLACE.fullmatch(attributes.get("r", ""))
            self.column = column_index_from_string(place[1]) if place else self.column + 1
            self.insert(here, self.column)
            self.tag, self.style, self.begin = name, attributes.get("s", ""), here
            self.formula, self.value = False, None
        elif self.path == FORMULA:
            self.formula = True
        elif self.path == VALUE:
            self.value = (here, here)

    def end(self, name: str) -> None:
        """Handle the end of an element."""
        here = self.parser.CurrentByteIndex
        if self.path == VALUE and self.value is not None:
            self.value = (self.value[0], self.behind(name, here))
        elif self.path == CELL:
            number = self.rows.get(self.row, {}).pop(self.column, None)
            if number is not None:
                whole = self.cell(self.column, number, self.style)
                self.pieces.append((self.begin, self.behind(name, here), whole))
            elif self.formula and self.value is not None:
                inner = self.xml.index(b">", self.begin) + 1
                tag = TYPE.sub(b"", self.xml[self.begin : inner])
                self.pieces += [(self.begin, inner, tag), (*self.value, b"")]
        elif self.path == ROW:
            self.insert(here)
        self.path.pop()

    def insert(self, here: int, column: int | None = None) -> None:
        """Insert the numbers of missing cells before a column, or at the end of the row."""
        waiting = self.rows.get(self.row, {})
        for each in [each for each in waiting if column is None or each < column]:
            self.pieces.append((here, here, self.cell(each, waiting.pop(each))))

    def cell(self, column: int, number: str, style: str = "") -> bytes:
        """A cell with a number, in the format ``style``."""
        prefix = self.tag[:-1]
        form = f' s="{style}"' if style else ""
        place = f"{get_column_letter(column)}{self.row}"
        return (
            f'<{self.tag} r="{place}"{form}><{prefix}v>{number}</{prefix}v></{self.tag}>'.encode()
        )

    def behind(self, name: str, here: int) -> int:
        """The position after an element's end tag.

        After an element with a single tag, the parser is already past it.
        """
        tag = f"</{name}".encode()
        ends = self.xml.startswith(tag, here) and self.xml[here + len(tag)] in b"> \t\r\n"
        return self.xml.index(b">", here) + 1 if ends else here


def refuse(*_: object) -> NoReturn:
    """Raise ValueError: a document type may declare entities, which shift the byte positions."""
    raise ValueError("a document type")


def computed_anew(xml: bytes) -> bytes:
    """The XML of a workbook that makes programs recompute all formulas on opening."""
    found = COMPUTES.search(xml)
    if found:
        name = (found[1] or b"") + b"calcPr"
        tag = FULL_CALCULATION.sub(b"", found[0])
        tag = tag.replace(b"<" + name, b"<" + name + b' fullCalcOnLoad="1"', 1)
        return xml[: found.start()] + tag + xml[found.end() :]
    *_, last = BEFORE.finditer(xml)
    tag = b"<" + (last[1] or b"") + b'calcPr fullCalcOnLoad="1"/>'
    return xml[: last.end()] + tag + xml[last.end() :]
