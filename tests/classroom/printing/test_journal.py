"""The journal: what is finished is known by its bytes, whatever cut a run short."""

from __future__ import annotations

import errno
from hashlib import sha256
from pathlib import Path

import pytest

from graphkin.classroom.printing.print_run import JOURNAL, Entry, Journal, key_of


def entry(folder: Path, part: str, key: str, **files: bytes) -> Entry:
    """An entry whose files stand there."""
    for name, data in files.items():
        (folder / name).write_bytes(data)
    return Entry(part, key, {name: sha256(data).hexdigest() for name, data in files.items()})


def test_a_part_is_finished_when_all_its_files_stand_as_noted(tmp_path):
    Journal(tmp_path).write([entry(tmp_path, "A task pdf", "k", one=b"1", two=b"2")])
    assert Journal(tmp_path).finished("A task pdf", "k")
    assert not Journal(tmp_path).finished("A task pdf", "other settings")
    assert not Journal(tmp_path).finished("B task pdf", "k")
    (tmp_path / "two").write_bytes(b"3")
    assert not Journal(tmp_path).finished("A task pdf", "k")
    (tmp_path / "two").unlink()
    assert not Journal(tmp_path).finished("A task pdf", "k")


@pytest.mark.parametrize("cut", range(1, 60, 7))
def test_a_line_that_was_cut_short_is_as_if_not_written(tmp_path, cut):
    Journal(tmp_path).write([entry(tmp_path, part, "k", one=b"1") for part in ("A", "B")])
    path = tmp_path / JOURNAL
    path.write_bytes(path.read_bytes()[:-cut])
    again = Journal(tmp_path)
    assert list(again.entries) == ["A"]
    again.write([entry(tmp_path, "C", "k", two=b"2")])
    assert list(Journal(tmp_path).entries) == ["A", "C"]


def test_a_full_disk_leaves_no_part_of_a_line(tmp_path, monkeypatch):
    journal = Journal(tmp_path)
    journal.write([entry(tmp_path, "A", "k", one=b"1")])
    before = (tmp_path / JOURNAL).read_bytes()
    opened = Path.open

    class Full:
        """A stream on a disk that has room for ten bytes."""

        def __init__(self, stream):
            self.stream = stream

        def __enter__(self):
            return self

        def __exit__(self, *_):
            self.stream.close()

        def write(self, data):
            self.stream.write(data[:10])
            self.stream.flush()
            raise OSError(errno.ENOSPC, "No space left on device")

    def full(path, mode="r", *args, **kwargs):
        stream = opened(path, mode, *args, **kwargs)
        return Full(stream) if mode == "ab" else stream

    monkeypatch.setattr(Path, "open", full)
    with pytest.raises(OSError, match="No space"):
        journal.write([entry(tmp_path, "B", "k", two=b"2")])
    assert (tmp_path / JOURNAL).read_bytes() == before
    assert list(journal.entries) == ["A"]


def test_settling_puts_the_parts_in_the_order_of_the_roster(tmp_path):
    journal = Journal(tmp_path)
    for part in ("C", "class-task.pdf", "A", "B", "A"):
        journal.write([entry(tmp_path, part, "k", one=b"1")])
    journal.settle(["A", "B", "C", "D"])
    assert list(Journal(tmp_path).entries) == ["A", "B", "C", "class-task.pdf"]
    assert len((tmp_path / JOURNAL).read_bytes().splitlines()) == 4


def test_a_key_changes_with_anything_that_decides_the_bytes():
    assert key_of("a", {"n": "7"}, ("x",)) == key_of("a", {"n": "7"}, ["x"])
    assert key_of("a", {"n": "7"}) != key_of("a", {"n": "8"})
    assert key_of("ab", "c") != key_of("a", "bc")


def test_a_line_nested_beyond_reason_is_as_if_it_had_not_been_written(tmp_path):
    Journal(tmp_path).write([entry(tmp_path, "A", "k", one=b"1")])
    with (tmp_path / JOURNAL).open("ab") as stream:
        stream.write(b'{"part": ' + b"[" * 100_000 + b"\n")
    assert list(Journal(tmp_path).entries) == ["A"]
