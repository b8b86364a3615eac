"""Tables as spreadsheets write them: CSV with any usual separator, or one sheet of an XLSX.

The reader makes no guess that could shift a column. It reports all broken rows at once, by number.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
import zipfile
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from datetime import date, datetime
from itertools import chain, islice
from pathlib import Path
from typing import IO, Any
from warnings import catch_warnings, simplefilter

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.file_limits import file_bytes
from graphkin.scene.findings import Findings, near_file, visible
from graphkin.text.errors import (
    MOST,
    NO_WORDS,
    About,
    Change,
    GraphkinError,
    Hint,
    InTable,
    Mend,
    Message,
    Problem,
    RosterError,
    joined,
    message,
)

MOST_ROWS, MOST_COLUMNS, LONGEST = 200_000, 1000, 4000
"""The most rows that are not empty, the most columns, and the most characters of a cell."""
MOST_CELLS, LAST_ROW = 2_000_000, 1 << 20
"""The most cells of a table, rows times columns, and the last row that a spreadsheet has."""


class SheetRow(Struct, frozen=True):
    """One row: its line in the file or its row in the sheet, and its cells by column.

    ``numbers`` are the columns whose cells are numbers in the file, without leading zeros.
    ``broken`` is the line at which the fault begins if the cells may be in wrong columns, else 0.
    """

    line: int
    cells: tuple[str, ...]
    numbers: frozenset[int] = frozenset()
    broken: int = 0


def too_large(name: str, found: Message) -> RosterError:
    """The error for a table beyond the limits, raised as soon as the limit is exceeded."""
    expected = message(
        "at most {most_rows} rows, {most_columns} columns, {most_cells} cells in all",
        most_rows=MOST_ROWS,
        most_columns=MOST_COLUMNS,
        most_cells=MOST_CELLS,
    )
    return RosterError.at(name, found, expected)


# --- reading tables -------------------------------------------------------------------------------


LARGEST = 16 * 1024 * 1024
"""The largest table, in bytes."""
SEPARATORS = {",": message("commas"), ";": message("semicolons"), "\t": message("tabs")}
VALUES = re.compile(r'"[^"]*"|\d+')
"""The parts of a message that differ from row to row although the cause is the same."""
FEW, NAMED_ROWS = 3, 4
"""Fewer than ``FEW`` further rows of one cause are each reported; else ``NAMED_ROWS`` are named."""
TITLES = 20
"""The number of rows that are not empty within which the reader looks for the head of a table."""
ZIP, OLD_EXCEL = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"
"""The first bytes of an XLSX, which is a ZIP file, and of an XLS."""


class Spreadsheet(Struct, frozen=True):
    """A table: the name of its file, its head and its rows; cells are texts without blanks around.

    ``separator`` separates the cells; it is a tab for XLSX. ``left_out`` are the broken rows.
    """

    name: str
    head: tuple[str, ...]
    rows: tuple[SheetRow, ...]
    separator: str = ","
    left_out: tuple[SheetRow, ...] = ()

    def place(self, row: SheetRow, column: str = "") -> InTable:
        """The place of a row, or of its cell in a column, for error messages."""
        return InTable(self.name, row.line, visible(column))


class TableProblems(Findings):
    """The problems of a table, reported all at once, with those of one cause together."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name
        self.causes: dict[tuple[str | int, ...], dict[tuple[str, str], Problem]] = {}

    def add(
        self,
        place: str | InTable,
        found: Message,
        expected: Message = NO_WORDS,
        hint: Hint = NO_WORDS,
        changes: tuple[Change, ...] = (),
        about: tuple[About, ...] = (),
    ) -> None:
        """Record one problem, of the whole table or of a row."""
        own = (place,) if isinstance(place, InTable) else ()
        words = place.message if isinstance(place, InTable) else place
        super().add(words, found, expected, hint, changes, (*own, *about))

    def extend(self, problems: Iterable[Problem]) -> None:
        """Record the new problems; stop once there are more causes than an error carries."""
        for problem in problems:
            alike = self.causes.setdefault(cause_of(problem), {})
            alike.setdefault((problem.place, problem.found), problem)
            if len(alike) == 1:
                self.problems.append(problem)
            if len(self.causes) > MOST:
                self.stop()

    @property
    def every(self) -> list[Problem]:
        """Every problem, without merging those of one cause."""
        return [each for alike in self.causes.values() for each in alike.values()]

    @property
    def merged(self) -> list[Problem]:
        """The problems in the order of the rows, those of one cause together."""
        faults = [line for alike in self.causes.values() for line in together(alike.values())]
        return sorted(faults, key=row_of)

    def stop(self) -> None:
        """Raise RosterError with the problems in the order of the rows, if there are any."""
        if self.problems:
            raise RosterError(self.merged)


class RowProblems(TableProblems):
    """The problems of a table whose rows are independent: broken rows do not stop the reading."""

    def stop(self) -> None:
        """Continue."""


def cause_of(problem: Problem) -> tuple[str | int, ...]:
    """The key shared by problems that differ only in their rows and values."""
    texts = (problem.found, problem.expected, problem.help)
    place = place_of(problem)
    if place is None:
        return (problem.place, *texts)
    return (place.table, place.column, *(VALUES.sub("", text) for text in texts))


def together(alike: Iterable[Problem]) -> list[Problem]:
    """The problems of one cause: each one if they are few, else the first with the other rows."""
    every = list(alike)
    rows = list(dict.fromkeys(row_of(problem) for problem in every))[1:]
    if len(rows) < FEW:
        return every
    named, more = joined(", ", map(str, rows[:NAMED_ROWS])), len(rows) - NAMED_ROWS
    if more > 0:
        named = message("{names} and {count} more", names=named, count=more)
    again = message("the same in rows {rows}", rows=named)
    return [replace(every[0], hint=joined("; ", (every[0].help, again)))]


def place_of(problem: Problem) -> InTable | None:
    """The place of a problem in a table; None for a problem of the whole table."""
    return next((each for each in problem.about if isinstance(each, InTable)), None)


def row_of(problem: Problem) -> int:
    """The row of a problem; zero for a problem of the whole table."""
    place = place_of(problem)
    return place.row if place else 0


def read_sheet(
    path: Path, heads: Sequence[str] = (), faults: TableProblems | None = None
) -> Spreadsheet:
    """The table in a CSV or XLSX file; raises RosterError with every row that cannot be read.

    ``heads`` are names of columns, which help to find the separator. Cells are normalised (NFC).
    With ``faults``, unreadable rows are skipped and recorded there: the caller finds the other
    problems and then stops.
    """
    return sheet_in(bytes_of(Path(path)), Path(path).name, heads, faults)


def sheet_in(
    data: bytes, name: str, heads: Sequence[str] = (), faults: TableProblems | None = None
) -> Spreadsheet:
    """The table in the bytes of a file, otherwise as ``read_sheet``; errors use ``name``."""
    own, faults = faults is None, faults or TableProblems(name)
    rows: Iterable[SheetRow]
    if data.startswith(OLD_EXCEL):
        hint = message("save it as .xlsx or as CSV UTF-8")
        raise RosterError.at(
            name, message("is an old Excel file (.xls)"), message("CSV or XLSX"), hint
        )
    if data.startswith(ZIP):
        rows, separator = list(xlsx_rows(data, name)), "\t"
    else:
        text = text_of(data, name)
        separator = separator_of(text, heads)
        rows = csv_rows(text, separator, faults)
    sheet = sheet_of(name, rows, separator, faults, heads)
    if own:
        faults.stop()
    return sheet


def bytes_of(path: Path) -> bytes:
    """The bytes of a file. Raises RosterError if it cannot be read or is too large."""
    try:
        data = file_bytes(path, LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or message("cannot be opened")
        reason = reason if isinstance(reason, Message) else f"{reason[:1].lower()}{reason[1:]}"
        found = message("cannot be read: {reason}", reason=reason)
        raise RosterError.at(
            str(path), found, message("a table, CSV or XLSX"), beside(path)
        ) from None
    if len(data) > LARGEST:
        raise RosterError.at(
            path.name, message("is too large"), message("at most {most} MiB", most=LARGEST >> 20)
        )
    return data


def beside(path: Path) -> Hint:
    """A hint for a table that cannot be read: the file with the nearest name in the same folder."""
    folder = path.parent
    if not folder.is_dir():
        return message("there is no folder {folder}", folder=folder)
    tables = [each.name for each in folder.iterdir() if each.suffix.lower() in (".csv", ".xlsx")]
    near = near_file(path.name, tables) if path.name not in tables else ""
    saved = message("a spreadsheet program saves one as XLSX or as CSV UTF-8")
    return Mend(path.name, near) if near else saved


def text_of(data: bytes, name: str) -> str:
    """The text of a CSV file: UTF-8 with or without a byte order mark, or UTF-16 with one."""
    wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        text = data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        row = data.count(b"\n", 0, error.start) + 1
        found = message("the byte 0x{data:02x} is not UTF-8", data=data[error.start])
        hint = message("in the spreadsheet, save as CSV UTF-8")
        at = InTable(name, row)
        problem = Problem(at.message, found, message("a text saved as UTF-8"), hint, about=(at,))
        raise RosterError(problem) from None
    if text.count("\0") > len(text) // 4:  # this many come from UTF-16; fewer are reported by row
        row = text.count("\n", 0, text.index("\0")) + 1
        hint = message("save the table again as CSV UTF-8")
        at = InTable(name, row)
        raise RosterError.at(
            at.message, message("a NUL character"), message("a text"), hint, about=(at,)
        )
    return text


def separator_of(text: str, heads: Sequence[str] = ()) -> str:
    """The separator of the cells: the one that finds the most known columns in the head.

    Each of the first lines may be the head, because titles may come before it.
    """
    full = (line for line in io.StringIO(text, newline="") if line.strip(" ,;\t\r\n"))
    lines = [line[: csv.field_size_limit()] for line in islice(full, TITLES if heads else 1)]
    known = {folded(head) for head in heads}

    def worth(separator: str) -> tuple[int, int]:
        rows = [next(csv.reader([line], delimiter=separator), []) for line in lines]
        return max((known_in(row, known) for row in rows), default=0), len(rows[0]) if rows else 0

    return max(SEPARATORS, key=worth)


def known_in(cells: Iterable[str], known: Collection[str]) -> int:
    """The number of cells of a row that are known names of columns."""
    return sum(bool(cell) and folded(cell) in known for cell in cells)


def csv_rows(text: str, separator: str, faults: TableProblems) -> Iterator[SheetRow]:
    """The rows of a CSV text by the lines on which they begin; broken records are recorded.

    A broken record gives one broken row for each of its lines. A quote that is never closed breaks
    only its own line.
    """
    lines = list(io.StringIO(text, newline=""))
    begins, unclosed = 1, 0
    while begins <= len(lines) and unclosed <= MOST:
        reader = csv.reader(islice(lines, begins - 1, None), delimiter=separator, strict=True)
        before, cells = begins - 1, list[str]()
        while begins <= len(lines):
            fault = ""
            try:
                cells = next(reader)
            except csv.Error as error:
                fault = str(error)
                faults.add(InTable(faults.name, begins), *broken(fault))
            ends = before + reader.line_num
            if ends > LAST_ROW:
                raise too_large(
                    faults.name, message("more than {last_row} lines", last_row=LAST_ROW)
                )
            is_open = "unexpected end" in fault or "field larger" in fault
            ends = begins if is_open else ends
            goes_on = ends > begins and any("\n" in c or "\r" in c for c in cells)
            if not fault and goes_on:
                found = message("a cell goes on to row {ends}", ends=ends)
                hint = message("is a closing quote missing?")
                faults.add(InTable(faults.name, begins), found, message("a cell on one row"), hint)
            if fault or goes_on:
                for i in range(begins, ends + 1):
                    yield SheetRow(i, tuple(loose_cells(lines[i - 1], separator)), broken=begins)
            else:
                yield SheetRow(begins, tuple(cells))
            begins = ends + 1
            if is_open:
                unclosed += 1
                break
    if unclosed > MOST:
        found, hint = (
            message("more than {most} quotes that are never closed", most=MOST),
            message("the rest is not read"),
        )
        raise RosterError.at(faults.name, found, message('a closing " in each cell'), hint)


def loose_cells(line: str, separator: str) -> list[str]:
    """The cells of a broken line, without quotes."""
    return line.replace('"', "").rstrip("\r\n").split(separator)


def broken(fault: str) -> tuple[Message, Message, Message]:
    """A fault that the CSV reader finds, in plain words: found, expected, hint."""
    if "unexpected end" in fault:
        found = message("a quote that is opened and never closed")
        return found, message('a closing "'), NO_WORDS
    if "expected after" in fault:
        found = message("a quote in the middle of a quoted cell")
        hint = message('a quote within quotes is written twice: "Ann ""Nan"" Lee"')
        return found, message("the end of the cell after it"), hint
    if "field larger" in fault:
        most = message("at most {most} characters", most=LONGEST)
        return message("a cell that is too long"), most, message("is a quote missing?")
    return message("cannot be read: {reason}", reason=fault), NO_WORDS, NO_WORDS


def sheet_of(
    name: str,
    rows: Iterable[SheetRow],
    separator: str,
    faults: TableProblems,
    heads: Sequence[str] = (),
) -> Spreadsheet:
    """The table made of these rows, without empty ones: its head, and the rows below the head."""
    left_out: list[SheetRow] = []
    head, body = below_titles(whole_rows(map(tidied, rows), left_out), heads)
    if left_out and (head is None or left_out[0].line < head.line):
        raise RosterError(faults.problems)
    if head is None:
        faults.stop()
        raise RosterError.at(
            name, message("the table is empty"), message("a head, then a row for each student")
        )
    width = len(head.cells)
    if width > MOST_COLUMNS:
        raise too_large(name, message("{width} columns", width=width))
    twice = repeated([folded(cell) for cell in head.cells if cell])
    for i, cell in enumerate(head.cells):
        refuse_hidden(faults, InTable(name, head.line, i + 1), cell)
        if folded(cell) in twice:
            found = message('two columns are called "{cell}"', cell=visible(cell))
            faults.add(InTable(name, head.line), found, message("one"))
            twice.discard(folded(cell))
    rows_found = []
    for count, row in enumerate(body, 1):
        if count > MOST_ROWS or count * width > MOST_CELLS:
            raise too_large(
                name,
                message("more than {count} rows of {width} columns", count=count - 1, width=width),
            )
        cells = row.cells
        if len(cells) > width:
            words = message(
                "{count} cells, and the head has {width}", count=len(cells), width=width
            )
            hint = message(
                "a cell that holds {separators} is written in quotes",
                separators=SEPARATORS[separator],
            )
            faults.add(
                InTable(name, row.line),
                words,
                message("at most {most}", most=width),
                hint,
            )
            left_out.append(replace(row, broken=row.line))
            continue
        for i, cell in enumerate(cells):
            refuse_hidden(faults, InTable(name, row.line, visible(head.cells[i])), cell)
        whole = cells + ("",) * (width - len(cells))
        rows_found.append(SheetRow(row.line, whole, row.numbers))
    return Spreadsheet(name, head.cells, tuple(rows_found), separator, tuple(left_out))


def whole_rows(rows: Iterable[SheetRow], left_out: list[SheetRow]) -> Iterator[SheetRow]:
    """The rows that hold something; broken rows go to ``left_out``."""
    for row in rows:
        if row.broken:
            left_out.append(row)
        elif row.cells:
            yield row


def below_titles(
    rows: Iterator[SheetRow], heads: Sequence[str]
) -> tuple[SheetRow | None, Iterator[SheetRow]]:
    """The head of a table and the rows below it.

    The head is the first row, unless one of the next rows, below titles, has more known names of
    columns, at least two.
    """
    known = {folded(head) for head in heads}
    first = list(islice(rows, TITLES))
    counts = [known_in(row.cells, known) for row in first]
    best = max(range(len(first)), key=lambda i: (counts[i] if counts[i] > 1 else 0, -i), default=0)
    if not first:
        return None, iter(())
    best = best if counts[best] > counts[0] else 0
    return first[best], chain(first[best + 1 :], rows)


def tidied(row: SheetRow) -> SheetRow:
    """The row with tidy cells, without the empty ones at its end."""
    cells = [tidy(cell) for cell in row.cells]
    while cells and not cells[-1]:
        cells.pop()
    return replace(row, cells=tuple(cells))


def tidy(cell: str) -> str:
    """A cell without blanks around it, in composed letters (NFC)."""
    return unicodedata.normalize("NFC", cell.strip().strip("\ufeff").strip())


def repeated(names: Sequence[str]) -> set[str]:
    """The names that occur more than once."""
    return {name for name in names if names.count(name) > 1}


def refuse_hidden(faults: TableProblems, place: InTable, cell: str) -> None:
    """Record a cell that is too long or has control or bidirectional characters."""
    if len(cell) > LONGEST:
        faults.add(
            place,
            message("{count} characters", count=len(cell)),
            message("at most {most}", most=LONGEST),
        )
        return
    for character in cell:
        if character not in "\n\r\t" and unicodedata.category(character) in ("Cc", "Cf", "Cs"):
            faults.add(
                place,
                message("the control character {character!a}", character=character),
                message("printable text"),
            )
            return


def folded(head: str) -> str:
    """The name of a column as names are compared: no case, accents, blanks or signs."""
    apart = unicodedata.normalize("NFKD", head.strip().strip("\ufeff"))
    return "".join(c for c in apart.casefold() if c.isalnum())


def columns(sheet: Spreadsheet, names: Mapping[str, Sequence[str]]) -> dict[str, int]:
    """The column of each key, found by the key or any of its names in any language.

    If several columns match, the one whose name comes first in ``names`` is used.
    """
    found: dict[str, int] = {}
    cells = {folded(cell): i for i, cell in reversed(list(enumerate(sheet.head))) if folded(cell)}
    for what, every in names.items():
        heads = (cells.get(folded(name)) for name in (what, *every))
        place = next((i for i in heads if i is not None), None)
        if place is not None:
            found[what] = place
    return found


# --- the active sheet of an XLSX file as rows of texts, with numbers as they would be typed -------


LARGEST_UNPACKED, MOST_ELEMENTS = 64 * 1024 * 1024, 1_000_000
"""The most bytes and XML elements of an XLSX once unpacked, against ZIP bombs.

A cell with a number has two elements.
"""
BLOCK = 1 << 20
MACROS = "xl/vbaProject.bin"
"""The part of a workbook with its macros."""
PADDED = re.compile(r"0+")
"""A number format that shows leading zeros: 0000."""


def xlsx_rows(data: bytes, name: str) -> Iterator[SheetRow]:
    """The rows of the active sheet; leading zeros that a cell's format shows are kept."""
    with opened(data, name, data_only=True) as book:
        for number, cells in full_rows(open_sheet(book), name):
            bare = frozenset(i for i, cell in enumerate(cells) if is_bare(cell))
            yield SheetRow(number, tuple(map(cell_text, cells)), bare)


def open_sheet(book: Any) -> Any:
    """The sheet that was active when the workbook was saved."""
    return book.active if book.active is not None else book.worksheets[0]


def full_rows(sheet: Any, name: str) -> Iterator[tuple[int, Sequence[Any]]]:
    """The rows of a sheet that hold something, each with its number, which counts from 1.

    The cells reach as far as the last one of the row. Raises RosterError as soon as there are too
    many.
    """
    sheet.reset_dimensions()  # the size written in the file may be wrong
    count = 0
    for number, cells in enumerate(sheet.iter_rows(), 1):
        count += len(cells)
        if number > LAST_ROW or count > MOST_CELLS:
            raise too_large(
                name,
                message(
                    "{number} rows, and {count} cells as far as there", number=number, count=count
                ),
            )
        if any(cell.value not in (None, "") for cell in cells):
            yield number, cells


@contextmanager
def opened(data: bytes, name: str, *, data_only: bool, read_only: bool = True) -> Iterator[Any]:
    """The workbook: its values, or the formulas that give them.

    It is opened for reading row by row, or whole with macros and the fonts within cells. Raises
    RosterError if openpyxl is missing or the file is not a workbook.
    """
    try:
        from openpyxl import load_workbook
    except ImportError:
        hint = message("or install it: pip install 'graphkin[class]'")
        found = message("is an XLSX file, and openpyxl, which reads those, is not installed")
        raise RosterError.at(name, found, message("the table saved as CSV UTF-8"), hint) from None
    try:
        refuse_bomb(data, name)
        with catch_warnings():  # openpyxl warns of parts it skips, which are not written either
            simplefilter("ignore")
            book = load_workbook(
                io.BytesIO(data),
                read_only=read_only,
                data_only=data_only,
                keep_links=not read_only,
                keep_vba=not read_only and MACROS in zipfile.ZipFile(io.BytesIO(data)).namelist(),
                rich_text=not read_only,
            )
            with closing(book), closing(book.vba_archive or book):
                yield book
    except GraphkinError:
        raise
    except Exception as error:
        raise unreadable(name) from error


def refuse_bomb(data: bytes, name: str) -> None:
    """Raise RosterError if a file is far larger unpacked; BadZipFile if it is not a ZIP."""
    expected = message(
        "at most {largest_unpacked} MiB and {most_elements} XML elements",
        largest_unpacked=LARGEST_UNPACKED >> 20,
        most_elements=MOST_ELEMENTS,
    )
    with zipfile.ZipFile(io.BytesIO(data)) as packed:
        size = sum(part.file_size for part in packed.infolist())
        if size > LARGEST_UNPACKED:
            raise RosterError.at(name, message("is far larger unpacked"), expected)
        elements = sum(map(elements_of, map(packed.open, packed.infolist())))
    if elements > MOST_ELEMENTS:
        raise RosterError.at(
            name, message("holds about {elements} XML elements", elements=elements), expected
        )


def elements_of(part: IO[bytes]) -> int:
    """The approximate number of XML elements of a part: its tags that are not closing tags."""
    blocks = iter(lambda: part.read(BLOCK), b"")
    return sum(block.count(b"<") - block.count(b"</") for block in blocks)


def unreadable(name: str) -> RosterError:
    """The error for a file that is not a workbook."""
    hint = message("open it in a spreadsheet and save it again, or as CSV UTF-8")
    return RosterError.at(name, message("cannot be read as XLSX"), message("a workbook"), hint)


def is_bare(cell: Any) -> bool:
    """Whether a cell is a number shown without leading zeros, so that 0041 would be 41."""
    number = isinstance(cell.value, int | float) and not isinstance(cell.value, bool)
    return number and not PADDED.fullmatch(getattr(cell, "number_format", "") or "")


def cell_text(cell: Any) -> str:
    """A cell as it would be typed: whole numbers without a point, with the leading zeros shown."""
    value = cell.value
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        value = int(value)
    if isinstance(value, int):
        shown = getattr(cell, "number_format", "") or ""
        zeros = len(shown) if PADDED.fullmatch(shown) else 0
        return f"{value:0{zeros}d}" if zeros else str(value)
    if isinstance(value, datetime | date):
        return value.isoformat()
    return repr(value) if isinstance(value, float) else str(value)
