"""PDF files of our own put one behind the other into one, page by page, in little memory.

The files are those that ``writers.pdf`` writes: a plain table of objects, no object streams, no
encryption. Each object is copied with its number changed; only the list of pages, the catalogue
and the bookmarks are new (ISO 32000-1, 7.5).
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterable
from dataclasses import dataclass
from hashlib import sha256
from itertools import pairwise
from typing import BinaryIO

HEADER = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"
REFERENCE = re.compile(rb"\b(\d+) 0 R\b")
PARENT = re.compile(rb"/Parent \d+ 0 R")
OBJECT = re.compile(rb"\s*\d+ 0 obj\s")
STREAM = re.compile(rb"\bstream\r?\n")
CATALOGUE, PAGES, INFO, OUTLINES = 1, 2, 3, 4
"""Numbers of the objects that are new."""


@dataclass(frozen=True, slots=True)
class PdfPart:
    """A PDF file to be put in, and the words of its bookmark (none where they are empty)."""

    data: bytes
    bookmark: str = ""


def join(parts: Iterable[PdfPart], stream: BinaryIO, title: str, language: str) -> int:
    """Write one PDF with the pages of all parts in order; gives how many pages there are.

    Only one part is held at a time; the same parts give the same bytes.
    """
    joined = Joined(stream)
    for part in parts:
        joined.append(part)
    joined.finish(title, language)
    return len(joined.pages)


class Joined:
    """A PDF that grows: everything but a few numbers goes to the stream at once."""

    def __init__(self, stream: BinaryIO) -> None:
        self.stream = stream
        self.offsets = array("Q", [0] * (OUTLINES + 1))
        self.place = 0
        self.hash = sha256()
        self.pages: list[int] = []
        self.bookmarks: list[tuple[str, int]] = []
        self.put(HEADER)

    def put(self, data: bytes) -> None:
        """Write some bytes."""
        self.stream.write(data)
        self.hash.update(data)
        self.place += len(data)

    def new(self) -> int:
        """A number for an object."""
        self.offsets.append(0)
        return len(self.offsets) - 1

    def add(self, number: int, body: bytes) -> None:
        """Write an object."""
        self.offsets[number] = self.place
        self.put(b"%d 0 obj\n%s\nendobj\n" % (number, body))

    def append(self, part: PdfPart) -> None:
        """Put in all pages of a file. Raises ValueError when it is no PDF of ours."""
        objects, root = objects_of(part.data)
        listed = pages_of(objects, root)
        for page in listed:
            objects[page] = PARENT.sub(b"/Parent @", objects[page])
        needed = reached(objects, listed)
        numbers = {old: self.new() for old in needed}
        for old, number in numbers.items():
            body = renumbered(objects[old], numbers)
            parent = b"/Parent %d 0 R" % PAGES
            self.add(number, body.replace(b"/Parent @", parent) if old in listed else body)
        if part.bookmark and listed:
            self.bookmarks.append((part.bookmark, numbers[listed[0]]))
        self.pages += (numbers[old] for old in listed)

    def finish(self, title: str, language: str) -> None:
        """Write the list of pages, the bookmarks, the catalogue and the table of objects."""
        kids = b" ".join(b"%d 0 R" % page for page in self.pages)
        self.add(PAGES, b"<< /Type /Pages /Count %d /Kids [ %s ] >>" % (len(self.pages), kids))
        self.add(INFO, b"<< /Title %s /Creator %s >>" % (words(title), words("graphkin")))
        self.outline()
        self.add(
            CATALOGUE,
            b"<< /Type /Catalog /Pages %d 0 R /Outlines %d 0 R /Lang %s"
            b" /ViewerPreferences << /PrintScaling /None >> >>"
            % (PAGES, OUTLINES, words(language)),
        )
        sign, start = self.hash.hexdigest()[:32].encode(), self.place
        self.put(b"xref\n0 %d\n0000000000 65535 f \n" % len(self.offsets))
        for offset in self.offsets[1:]:
            self.put(b"%010d 00000 n \n" % offset)
        self.put(
            b"trailer\n<< /Size %d /Root %d 0 R /Info %d 0 R /ID [<%s><%s>] >>\n"
            % (len(self.offsets), CATALOGUE, INFO, sign, sign)
        )
        self.put(b"startxref\n%d\n%%%%EOF\n" % start)

    def outline(self) -> None:
        """Write the bookmarks, one below the other."""
        first = len(self.offsets)
        for i, (text, page) in enumerate(self.bookmarks):
            before = b" /Prev %d 0 R" % (first + i - 1) if i else b""
            after = b" /Next %d 0 R" % (first + i + 1) if i < len(self.bookmarks) - 1 else b""
            body = b"<< /Title %s /Parent %d 0 R /Dest [ %d 0 R /Fit ]%s%s >>"
            self.add(self.new(), body % (words(text), OUTLINES, page, before, after))
        ends = b""
        if self.bookmarks:
            ends = b" /First %d 0 R /Last %d 0 R" % (first, len(self.offsets) - 1)
        self.add(OUTLINES, b"<< /Type /Outlines /Count %d%s >>" % (len(self.bookmarks), ends))


def words(text: str) -> bytes:
    """A text as a PDF string."""
    return b"<FEFF%s>" % text.encode("utf-16-be").hex().upper().encode()


def objects_of(data: bytes) -> tuple[dict[int, bytes], int]:
    """The bodies of a file's objects by number, and the number of its catalogue."""
    trailer = data[data.rfind(b"trailer") :]
    root = re.search(rb"/Root (\d+) 0 R", trailer)
    table = re.search(rb"startxref\s+(\d+)\s+%%EOF\s*$", trailer)
    if root is None or table is None:
        raise ValueError("no table of objects")
    start = int(table[1])
    head = re.match(rb"xref\s+0 (\d+)\s+", data[start:])
    if head is None:
        raise ValueError("no plain table of objects")
    rows = data[start + head.end() :].split(b"\n", int(head[1]))[: int(head[1])]
    places = {number: int(row[:10]) for number, row in enumerate(rows) if row[17:18] == b"n"}
    ends = sorted([*places.values(), start])
    after = dict(pairwise(ends))
    return {number: body(data[at : after[at]]) for number, at in places.items()}, int(root[1])


def body(written: bytes) -> bytes:
    """What stands between ``obj`` and ``endobj``."""
    head = OBJECT.match(written)
    end = written.rfind(b"endobj")
    if head is None or end < 0:
        raise ValueError("an object that does not stand where the table says")
    return written[head.end() : end].rstrip(b"\r\n ")


def pages_of(objects: dict[int, bytes], root: int) -> list[int]:
    """The numbers of a file's pages in order, from its one list of pages."""
    tree = re.search(rb"/Pages (\d+) 0 R", objects[root])
    kids = re.search(rb"/Kids \[([^\]]*)\]", objects[int(tree[1])]) if tree else None
    if kids is None:
        raise ValueError("no list of pages")
    return [int(number) for number in REFERENCE.findall(kids[1])]


def reached(objects: dict[int, bytes], pages: list[int]) -> list[int]:
    """The objects that some pages need, the pages among them, in the order of the file."""
    found: set[int] = set()
    waiting = list(pages)
    while waiting:
        number = waiting.pop()
        if number not in found:
            found.add(number)
            waiting += (int(other) for other in REFERENCE.findall(parted(objects[number])[0]))
    return sorted(found)


def parted(written: bytes) -> tuple[bytes, bytes]:
    """An object's dictionary, and its stream, which is copied as it is."""
    stream = STREAM.search(written)
    return (written[: stream.start()], written[stream.start() :]) if stream else (written, b"")


def renumbered(written: bytes, numbers: dict[int, int]) -> bytes:
    """An object with the numbers that its dictionary calls changed."""
    head, stream = parted(written)
    return REFERENCE.sub(lambda called: b"%d 0 R" % numbers[int(called[1])], head) + stream
