"""Parquet files, read back by a small reader that is written here from the format's definition."""

from __future__ import annotations

import csv
import struct
from math import isnan
from pathlib import Path
from typing import Any

import pytest

from graphkin.writers.parquet import parquet
from tests.running import Run


class CompactReader:
    """Thrift's compact protocol, as far as a Parquet file uses it."""

    def __init__(self, data: bytes, at: int) -> None:
        self.data, self.at = data, at

    def varint(self) -> int:
        found = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            found |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return found

    def value(self, kind: int) -> Any:
        if kind in (5, 6):
            found = self.varint()
            return (found >> 1) ^ -(found & 1)
        if kind == 8:
            size = self.varint()
            self.at += size
            return self.data[self.at - size : self.at]
        if kind == 9:
            head = self.data[self.at]
            self.at += 1
            size = head >> 4 if head >> 4 < 15 else self.varint()
            return [self.value(head & 15) for _ in range(size)]
        assert kind == 12
        return self.struct()

    def struct(self) -> dict[int, Any]:
        found: dict[int, Any] = {}
        which = 0
        while head := self.data[self.at]:
            self.at += 1
            assert head >> 4
            which += head >> 4
            found[which] = self.value(head & 15)
        self.at += 1
        return found


def read_back(data: bytes) -> dict[str, list[Any]]:
    """The columns of a file by name."""
    assert data[:4] == data[-4:] == b"PAR1"
    (size,) = struct.unpack("<i", data[-8:-4])
    footer = CompactReader(data, len(data) - 8 - size).struct()
    root, *schema = footer[2]
    assert root[5] == len(schema)
    (group,) = footer[4]
    assert group[3] == footer[3]
    assert group[2] <= len(data)
    columns: dict[str, list[Any]] = {}
    for element, chunk in zip(schema, group[1], strict=True):
        about = chunk[3]
        assert element[3] == about[4] == 0
        assert about[3] == [element[4]]
        assert about[1] == element[1]
        assert about[5] == footer[3]
        page = CompactReader(data, about[9])
        head = page.struct()
        assert head[1] == 0
        assert head[5][1] == footer[3]
        assert head[5][2] == 0
        assert page.at - about[9] + head[3] == about[7]
        body = data[page.at : page.at + head[3]]
        columns[element[4].decode()] = values_in(body, element[1], footer[3])
    return columns


def values_in(body: bytes, kind: int, count: int) -> list[Any]:
    if kind == 5:
        return list(struct.unpack(f"<{count}d", body))
    found, at = [], 0
    for _ in range(count):
        (size,) = struct.unpack_from("<i", body, at)
        found.append(body[at + 4 : at + 4 + size].decode())
        at += 4 + size
    assert at == len(body)
    return found


@pytest.mark.parametrize("count", [0, 1, 3, 700])
def test_what_is_written_is_read_back(count: int):
    body = [[i / 7, f"țăst {i}", None if i == 2 else -i] for i in range(count)]
    found = read_back(parquet([["φ", "name", "v"], *body]))
    assert [*found] == ["φ", "name", "v"]
    assert list(map(float, found["φ"])) == [row[0] for row in body]
    assert found["name"] == [row[1] for row in body]
    assert [isnan(float(each)) for each in found["v"]] == [i == 2 for i in range(count)]


def test_a_table_of_many_columns():
    """From fifteen on, a list's length has bytes of its own."""
    found = read_back(parquet([[f"c{i}" for i in range(40)], list(map(float, range(40)))]))
    assert found == {f"c{i}": [float(i)] for i in range(40)}


def test_the_tables_of_a_cycle_are_the_same_as_csv(run: Run, tmp_path: Path):
    options = ("--steps", 6, "--positions", 3, "--format", "parquet")
    run("cycle", "offset-slider-crank", "-o", tmp_path, *options)
    for kind in ("cycle", "extremes", "positions"):
        stem = tmp_path / f"offset-slider-crank-{kind}"
        head, *rows = csv.reader(stem.with_suffix(".csv").read_text("utf-8").splitlines())
        found = read_back(stem.with_suffix(".parquet").read_bytes())
        assert [*found] == head
        for name, column in zip(head, zip(*rows, strict=True), strict=True):
            for cell, value in zip(column, found[name], strict=True):
                same = isnan(value) if cell == "" and isinstance(value, float) else None
                assert same or (float(cell) == value if isinstance(value, float) else cell == value)
