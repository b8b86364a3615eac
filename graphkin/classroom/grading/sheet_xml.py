"""The XML of a workbook with other numbers in some cells; every other byte stays as it is.

Where formulas stand, the results that the file kept of them are left out, so that every program
computes them anew from the new numbers.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NoReturn
from xml.parsers.expat import ParserCreate

from openpyxl.utils import column_index_from_string, get_column_letter

ROW = ["worksheet", "sheetData", "row"]
CELL = [*ROW, "c"]
FORMULA, VALUE = [*CELL, "f"], [*CELL, "v"]
PLACE = re.compile(r"([A-Z]+)[0-9]+")
TYPE = re.compile(rb"""\st\s*=\s*("[^"]*"|'[^']*')""")
COMPUTES = re.compile(rb"<([\w.-]+:)?calcPr\b[^>]*>")
COMPUTED = re.compile(rb"""\sfullCalcOnLoad\s*=\s*("[^"]*"|'[^']*')""")
BEFORE = re.compile(rb"</([\w.-]+:)?(?:sheets|functionGroups|externalReferences|definedNames)\s*>")
"""The ends of elements behind which a workbook says how it computes."""


def with_numbers(xml: bytes, numbers: Mapping[tuple[int, int], str]) -> bytes:
    """A worksheet with numbers in cells, by row and column from 1; results of formulas left out.

    Every row of a number holds some cell already. Raises ExpatError or ValueError where the bytes
    are no worksheet that can be changed.
    """
    if b"\0" in xml:
        raise ValueError("not UTF-8")
    return Worksheet(xml, numbers).changed()


class Worksheet:
    """A worksheet while it is read: where in it what is to stand instead of what."""

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
        """The bytes with everything in its place."""
        self.parser.Parse(self.xml, True)
        found, at = [], 0
        for begin, end, new in self.pieces:
            found += [self.xml[at:begin], new]
            at = end
        return b"".join([*found, self.xml[at:]])

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """An element begins."""
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
        """An element ends."""
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
        """Put the numbers of a row whose cells are missing before a column, or at its end."""
        waiting = self.rows.get(self.row, {})
        for each in [each for each in waiting if column is None or each < column]:
            self.pieces.append((here, here, self.cell(each, waiting.pop(each))))

    def cell(self, column: int, number: str, style: str = "") -> bytes:
        """A cell with a number; its format is kept."""
        prefix = self.tag[:-1]
        form = f' s="{style}"' if style else ""
        place = f"{get_column_letter(column)}{self.row}"
        return (
            f'<{self.tag} r="{place}"{form}><{prefix}v>{number}</{prefix}v></{self.tag}>'.encode()
        )

    def behind(self, name: str, here: int) -> int:
        """The place behind an element that ends: behind its tag, unless that is the first as well.

        For an element of one tag the parser has passed it already.
        """
        tag = f"</{name}".encode()
        ends = self.xml.startswith(tag, here) and self.xml[here + len(tag)] in b"> \t\r\n"
        return self.xml.index(b">", here) + 1 if ends else here


def refuse(*_: object) -> NoReturn:
    """No worksheet has declarations, in which places would not be those of the file."""
    raise ValueError("a document type")


def computed_anew(xml: bytes) -> bytes:
    """The XML of a workbook that tells whoever opens it to compute all formulas."""
    found = COMPUTES.search(xml)
    if found:
        name = (found[1] or b"") + b"calcPr"
        tag = COMPUTED.sub(b"", found[0])
        tag = tag.replace(b"<" + name, b"<" + name + b' fullCalcOnLoad="1"', 1)
        return xml[: found.start()] + tag + xml[found.end() :]
    *_, last = BEFORE.finditer(xml)
    tag = b"<" + (last[1] or b"") + b'calcPr fullCalcOnLoad="1"/>'
    return xml[: last.end()] + tag + xml[last.end() :]
