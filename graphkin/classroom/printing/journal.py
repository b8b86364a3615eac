"""The finished parts: a line for each part of a student's sheets, with the hashes of its files.

A line is written before its files are moved into place, so that files found there are known to be
from this program. A part is finished if all its files exist with exactly these hashes.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from hashlib import file_digest, sha256
from pathlib import Path

import msgspec
from msgspec import Struct, field

from graphkin.scene.file_limits import whole_file
from graphkin.writers.commit import put_in_place

JOURNAL = ".journal.jsonl"
LARGEST = 512 << 20
"""The largest journal, in bytes."""


class Entry(Struct, frozen=True):
    """A printed part: its name, a hash of everything that decides it, and the hashes of its files.

    ``settings`` are what goes into the first hash, by name, so that messages can say what differs.
    """

    part: str
    key: str
    files: Mapping[str, str]
    settings: Mapping[str, str] = field(default_factory=dict)

    def line(self) -> bytes:
        """The entry as a line of JSON."""
        entry = {"part": self.part, "key": self.key, "files": dict(self.files)}
        entry |= {"settings": dict(self.settings)} if self.settings else {}
        return json.dumps(entry, ensure_ascii=True).encode() + b"\n"


class Journal:
    """The journal of a folder: read whole, then extended line by line."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / JOURNAL
        self.entries: dict[str, Entry] = {}
        data = whole_file(self.path, LARGEST) if self.path.exists() else b""
        whole = data[: data.rfind(b"\n") + 1]
        if whole != data:  # the last write was interrupted
            with self.path.open("r+b") as stream:
                stream.truncate(len(whole))
        for line in whole.splitlines():
            entry = entry_of(line)
            if entry is not None:
                self.entries[entry.part] = entry

    def finished(self, part: str, key: str) -> bool:
        """Whether a part is finished with this key: all its files exist, byte for byte."""
        entry = self.entries.get(part)
        if entry is None or entry.key != key:
            return False
        return all(hash_of(self.folder / name) == found for name, found in entry.files.items())

    def otherwise(self, part: str, key: str) -> list[str]:
        """The existing files of a part that were made with other settings."""
        entry = self.entries.get(part)
        if entry is None or entry.key == key:
            return []
        return [name for name in entry.files if (self.folder / name).exists()]

    def ours(self, part: str, key: str) -> frozenset[str]:
        """The files recorded for a part with this key."""
        entry = self.entries.get(part)
        return frozenset(entry.files) if entry is not None and entry.key == key else frozenset()

    def write(self, entries: Sequence[Entry]) -> None:
        """Add lines; if the disk is full, leave no partial line."""
        start = self.path.stat().st_size if self.path.exists() else 0
        try:
            with self.path.open("ab") as stream:
                stream.write(b"".join(entry.line() for entry in entries))
        except OSError:
            if self.path.exists():
                os.truncate(self.path, start)
            raise
        self.entries |= {entry.part: entry for entry in entries}

    def settle(self, order: Iterable[str]) -> None:
        """Rewrite the journal with each part once, in the given order, then the other parts."""
        parts = dict.fromkeys(part for part in order if part in self.entries)
        parts |= dict.fromkeys(sorted(self.entries.keys() - parts))
        data = b"".join(self.entries[part].line() for part in parts)
        if not self.path.exists() or self.path.read_bytes() != data:
            put_in_place(self.folder, {self.path: data})


def entry_of(line: bytes) -> Entry | None:
    """The entry of a line; None for an invalid line, which is ignored."""
    try:
        return msgspec.json.decode(line, type=Entry)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        return None


def hash_of(path: Path) -> str:
    """The SHA-256 of a file; empty if it cannot be read."""
    try:
        with path.open("rb") as stream:
            return file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def key_of(*parts: object) -> str:
    """A hash of everything that decides the bytes of a part."""
    return sha256(json.dumps(parts, ensure_ascii=True, sort_keys=True).encode()).hexdigest()[:32]
