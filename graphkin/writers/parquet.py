"""Tables as Apache Parquet files: flat columns without gaps, plain and uncompressed.

The layout is that of the public format: pages, then the metadata in Thrift's compact protocol.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from math import nan

from msgspec import Struct

from graphkin.text.tables import Cell

MAGIC = b"PAR1"
MAKER = "graphkin"
I32, I64, BINARY, LIST, STRUCT = 5, 6, 8, 9, 12
"""Types of fields in Thrift's compact protocol."""
DOUBLE, TEXT = 5, 6
"""Physical types of columns: 64-bit floats, and byte arrays that hold UTF-8."""
PLAIN, RUNS = 0, 3
"""Encodings: of values, and of levels, of which columns without gaps have none."""
SHORT = 15
"""Number of items from which a list's length has bytes of its own."""
Field = tuple[int, int, bytes]
"""The number of a field, its type, and its bytes."""


class TableColumn(Struct, frozen=True):
    """A column: its name, its physical type, its values as bytes, and their number."""

    name: str
    kind: int
    values: bytes
    count: int


def parquet(rows: Sequence[Sequence[Cell]]) -> bytes:
    """A table whose first row is the head, as a Parquet file.

    A column of numbers has NaN for an empty cell, any other one an empty text.
    """
    head, *body = rows
    columns = [column(str(name), [row[i] for row in body]) for i, name in enumerate(head)]
    out = bytearray(MAGIC)
    chunks = []
    for each in columns:
        start = len(out)
        out += page(each) + each.values
        chunks.append(chunk(each, start, len(out) - start))
    size = sum(len(each.values) for each in columns)
    group = record((1, *listed(STRUCT, chunks)), (2, *long(size)), (3, *long(len(body))))
    schema = [record((4, *text("schema")), (5, *number(len(columns)))), *map(element, columns)]
    footer = record(
        (1, *number(1)),
        (2, *listed(STRUCT, schema)),
        (3, *long(len(body))),
        (4, *listed(STRUCT, [group])),
        (6, *text(MAKER)),
    )
    return bytes(out) + footer + struct.pack("<i", len(footer)) + MAGIC


def column(name: str, cells: Sequence[Cell]) -> TableColumn:
    """A column of numbers where all its cells are numbers or empty, otherwise of texts."""
    filled = [cell for cell in cells if cell not in (None, "")]
    if filled and all(isinstance(cell, int | float) for cell in filled):
        numbers = [nan if cell in (None, "") else float(cell or 0) for cell in cells]
        return TableColumn(name, DOUBLE, struct.pack(f"<{len(numbers)}d", *numbers), len(cells))
    texts = [("" if cell is None else str(cell)).encode() for cell in cells]
    values = b"".join(struct.pack("<i", len(each)) + each for each in texts)
    return TableColumn(name, TEXT, values, len(cells))


def page(own: TableColumn) -> bytes:
    """The head of the only page of a column."""
    size = number(len(own.values))
    levels = number(RUNS)
    data = record((1, *number(own.count)), (2, *number(PLAIN)), (3, *levels), (4, *levels))
    return record((1, *number(0)), (2, *size), (3, *size), (5, STRUCT, data))


def chunk(own: TableColumn, start: int, size: int) -> bytes:
    """The metadata of a column whose page lies at a place in the file."""
    about = record(
        (1, *number(own.kind)),
        (2, *listed(I32, [number(PLAIN)[1]])),
        (3, *listed(BINARY, [text(own.name)[1]])),
        (4, *number(0)),
        (5, *long(own.count)),
        (6, *long(size)),
        (7, *long(size)),
        (9, *long(start)),
    )
    return record((2, *long(start)), (3, STRUCT, about))


def element(own: TableColumn) -> bytes:
    """A column in the schema: required, texts as UTF-8."""
    fields: list[Field] = [(1, *number(own.kind)), (3, *number(0)), (4, *text(own.name))]
    return record(*fields, *([(6, *number(0))] if own.kind == TEXT else []))


# --- Thrift's compact protocol --------------------------------------------------------------------


def record(*fields: Field) -> bytes:
    """A struct: fields by rising numbers that differ by less than 16."""
    out, last = bytearray(), 0
    for which, kind, data in fields:
        out += bytes([(which - last) << 4 | kind]) + data
        last = which
    return bytes(out) + b"\0"


def number(value: int) -> tuple[int, bytes]:
    """A 32-bit number."""
    return I32, varint(value << 1)


def long(value: int) -> tuple[int, bytes]:
    """A 64-bit number."""
    return I64, varint(value << 1)


def text(value: str) -> tuple[int, bytes]:
    """A text, after its length."""
    data = value.encode()
    return BINARY, varint(len(data)) + data


def listed(kind: int, items: Iterable[bytes]) -> tuple[int, bytes]:
    """A list of items of one type."""
    some = list(items)
    size = len(some)
    head = bytes([size << 4 | kind]) if size < SHORT else bytes([0xF0 | kind]) + varint(size)
    return LIST, head + b"".join(some)


def varint(value: int) -> bytes:
    """A number without sign, seven bits a byte, the lowest first."""
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*out, value])
