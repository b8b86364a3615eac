"""Several PDF files as one: the same pages, the same bytes, bookmarks, little memory."""

from __future__ import annotations

import io

import pikepdf
import pypdf
import pytest

from graphkin.drawing.frame import TitleBlock, page_frame, sheet_frame
from graphkin.drawing.marks import Page, Text
from graphkin.writers.pdf import PdfPart, join, write_pdf


def a3(text):
    words = Text(50, 60, f"*ω*_1 {text}", "label", 3.5)
    return Page(420, 297, (*sheet_frame(TitleBlock(title=text)), words), text, "ro")


def a4(text):
    return Page(210, 297, (*page_frame((text, ""), ("", "1/1")),), text, "ro")


FILES = [write_pdf([a3("Ștefan 1"), a4("one 1 0 R")]), write_pdf([a4("two")]), write_pdf([a3("3")])]


@pytest.fixture
def files(tmp_path):
    """The files on the disk."""
    for number, data in enumerate(FILES):
        (tmp_path / f"{number}.pdf").write_bytes(data)
    return sorted(tmp_path.glob("*.pdf"))


def joined(parts, title="Class", language="ro"):
    stream = io.BytesIO()
    count = join(parts, stream, title, language)
    return count, stream.getvalue()


def read(data):
    return pypdf.PdfReader(io.BytesIO(data), strict=True)


def test_the_pages_of_all_files_follow_one_another_unchanged(files):
    count, data = joined(map(PdfPart, files))
    before = [page for file in FILES for page in read(file).pages]
    after = read(data).pages
    assert count == len(before) == len(after) == 4
    tree = read(data).trailer["/Root"]["/Pages"]
    assert {page["/Parent"].indirect_reference.idnum for page in after} == {
        tree.indirect_reference.idnum
    }
    for old, new in zip(before, after, strict=True):
        assert new.mediabox == old.mediabox
        assert new.get_contents().get_data() == old.get_contents().get_data()
        assert new.extract_text() == old.extract_text()
        fonts, others = new["/Resources"]["/Font"], old["/Resources"]["/Font"]
        assert fonts.keys() == others.keys()
        for name in fonts:
            inner = fonts[name]["/FontDescriptor"]["/FontFile2"].get_data()
            assert inner == others[name]["/FontDescriptor"]["/FontFile2"].get_data()


def test_the_same_files_give_the_same_bytes_and_others_another_sign(files):
    assert joined(map(PdfPart, files)) == joined(map(PdfPart, files))
    one, other = (read(joined(map(PdfPart, part))[1]).trailer["/ID"] for part in (files, files[:2]))
    assert one != other


def test_each_student_has_a_bookmark_to_the_first_page(files):
    _, data = joined(
        [PdfPart(files[0], "Ștefan, 331"), PdfPart(files[1]), PdfPart(files[2], "Ana")]
    )
    reader = read(data)
    assert [mark.title for mark in reader.outline] == ["Ștefan, 331", "Ana"]
    pages = [reader.get_destination_page_number(mark) for mark in reader.outline]
    assert pages == [0, 3]


def test_no_files_make_a_file_without_pages():
    count, data = joined([])
    assert count == 0
    assert len(read(data).pages) == 0


@pytest.mark.parametrize("data", [b"", b"%PDF-1.4 nothing", FILES[0][:-20], FILES[0][:3000]])
def test_what_is_no_whole_file_is_refused(tmp_path, data):
    (tmp_path / "part.pdf").write_bytes(data)
    with pytest.raises(pikepdf.PdfError):
        joined([PdfPart(tmp_path / "part.pdf")])
