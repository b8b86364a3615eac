"""PDF files put one behind the other into one, page by page, with bookmarks."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import BinaryIO

import pikepdf
from msgspec import Struct
from pikepdf import Dictionary, Name, OutlineItem


class PdfPart(Struct, frozen=True):
    """A PDF file to be put in, and the words of its bookmark (none where they are empty)."""

    path: Path
    bookmark: str = ""


def join(parts: Iterable[PdfPart], stream: BinaryIO, title: str, language: str) -> int:
    """Write one PDF with the pages of all parts in order; gives how many pages there are.

    Streams are copied from file to file as they are; the same parts give the same bytes. Raises
    pikepdf.PdfError for a file that is no whole PDF.
    """
    with pikepdf.new() as joined:
        marks = []
        for part in parts:
            if part.bookmark:
                marks.append(OutlineItem(part.bookmark, len(joined.pages)))
            joined.pages.extend(pikepdf.open(part.path, attempt_recovery=False).pages)
        with joined.open_outline() as outline:
            outline.root.extend(marks)
        joined.docinfo.Title, joined.docinfo.Creator = title, "graphkin"
        joined.Root.Lang = language
        joined.Root.ViewerPreferences = Dictionary(PrintScaling=Name("/None"))
        joined.save(stream, min_version="1.4", compress_streams=False, deterministic_id=True)
        return len(joined.pages)
