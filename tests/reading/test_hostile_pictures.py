"""Hostile pictures among good ones: each is refused by its name, the others are read as ever."""

from __future__ import annotations

import io
import itertools
import json
import secrets
import shutil
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pikepdf
import pytest
from click.testing import CliRunner, Result
from pikepdf import Array, Dictionary, Name
from PIL import Image

from graphkin.cli.main import app
from graphkin.reading import pictures, read_sheet
from graphkin.reading.pictures import Unreadable, grey_of, photographs
from graphkin.reading.settled_points import READING
from graphkin.text.errors import PLAIN_TRACEBACK
from tests.reading.camera import scan
from tests.reading.hand import printed

WIDE, HIGH = 2000, 1400
WHITE = zlib.compress(b"\xff" * (WIDE * HIGH))


def call(*words: object) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)


@pytest.fixture(scope="module")
def a_class(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A class of one, whose code hangs on no chance."""
    folder, count = tmp_path_factory.mktemp("class"), itertools.count()
    (folder / "class.csv").write_text("Nr.;Matricol;Nume\n7;0042;Ana Pop\n", encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(secrets, "token_hex", lambda size: f"{next(count):02x}" * size)
        call("variants", "pump", folder / "class.csv", "-o", folder / "class")
    return folder / "class"


@pytest.fixture(scope="module")
def sheet(a_class: Path) -> bytes:
    """A scan of a printed sheet on which nothing is drawn."""
    manifest = json.loads((a_class / "manifest.json").read_text(encoding="utf-8"))
    return scan(printed(a_class, manifest["students"][0]["code"], "velocity"), 150, 0.0, 1).data


@pytest.fixture(scope="module")
def alone(a_class: Path, sheet: bytes, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of readings of that sheet alone."""
    folder = tmp_path_factory.mktemp("alone")
    (folder / "good.jpg").write_bytes(sheet)
    found = call("read", a_class, folder / "good.jpg", "-o", folder / "read", "--jobs", "1")
    assert found.exit_code == 0, found.output
    return folder / "read"


# --- files ---------------------------------------------------------------------------------------


def pdf(data: bytes, packed: Any, colours: Any = Name.DeviceGray, bits: int = 8) -> bytes:
    """A PDF file with one picture, its bytes as they are."""
    made, out = pikepdf.new(), io.BytesIO()
    picture = made.make_stream(data)
    picture.Type, picture.Subtype = Name.XObject, Name.Image
    picture.Width, picture.Height, picture.BitsPerComponent = WIDE, HIGH, bits
    picture.ColorSpace, picture.Filter = colours, packed
    made.add_blank_page(page_size=(1190, 842)).Resources = Dictionary(XObject={"/Im": picture})
    made.save(out, stream_decode_level=pikepdf.StreamDecodeLevel.none, compress_streams=False)
    return out.getvalue()


def bomb(size: int) -> bytes:
    """So many MiB of nothing, packed."""
    packing = zlib.compressobj(9)
    return b"".join(packing.compress(bytes(1 << 20)) for _ in range(size)) + packing.flush()


def png(width: int, height: int) -> bytes:
    out = io.BytesIO()
    Image.new("1", (width, height), 1).save(out, "PNG")
    return out.getvalue()


SEPARATION = [Name.Separation, Name.Black, Name.DeviceGray]
TINT = {"FunctionType": 2, "Domain": [0, 1], "C0": [1], "C1": [0], "N": 1}
NOT_READ = "save it as JPEG"


def hostile() -> dict[str, tuple[bytes, str]]:
    """Files, and what is said of each."""
    tint = Dictionary({f"/{key}": value for key, value in TINT.items()})
    twice = Array([Name.FlateDecode, Name.FlateDecode])
    bits = zlib.compress(bytes(WIDE * HIGH // 8))
    return {
        "jbig2.pdf": (pdf(bytes(100), Name.JBIG2Decode, bits=1), NOT_READ),
        "separation.pdf": (pdf(WHITE, Name.FlateDecode, Array([*SEPARATION, tint])), NOT_READ),
        "bomb.pdf": (pdf(bomb(100), Name.FlateDecode), "holds more than 11 MB"),
        "bomb-twice.pdf": (pdf(zlib.compress(bomb(100)), twice), "holds more than 11 MB"),
        "runs.pdf": (pdf(b"\x81\xff" * (5 << 20), Name.RunLengthDecode), NOT_READ),
        "stream.pdf": (pdf(WHITE[:50], Name.FlateDecode), NOT_READ),
        "blank.pdf": (pdf(bits, Name.FlateDecode, bits=1), "no code is found"),
        "begun.pdf": (pdf(WHITE, Name.FlateDecode)[:300], "no scanned picture"),
        "none.pdf": (b"%PDF-1.7", NOT_READ),
        "long.png": (png(100_000, 1_100), "is 100000 × 1100 pixels, 20000 at most on a side"),
        "large.png": (png(19_000, 19_000), "120 million pixels"),
        "small.png": (png(100, 100), "too few"),
        "cut.png": (png(WIDE, HIGH)[:200], "cut short or damaged"),
        "text.jpg": (b"no picture", "is no picture"),
        "empty.heic": (b"", "is no picture"),
        "drawing.tif": (b"II*\0", "is not read"),
        "drawings.zip": (b"PK\3\4", "is not read"),
    }


def test_one_hostile_picture_keeps_no_other_back(
    a_class: Path, alone: Path, sheet: bytes, tmp_path: Path
) -> None:
    """Whenever it is read, and beside whatever, a reading is the same to the byte."""
    photos, out = tmp_path / "photos", tmp_path / "read"
    (photos / "more").mkdir(parents=True)
    wrong = hostile()
    for name, (data, _) in wrong.items():
        (photos / name).write_bytes(data)
    for path in (photos / "good.jpg", photos / "more" / "other.jpg"):
        path.write_bytes(sheet)
    found = call("read", a_class, photos, "-o", out, "--jobs", "1", "--json")
    assert found.exit_code == 1, found.output
    for name, (_, why) in (wrong | {"more": (b"", "is a folder within a folder")}).items():
        stem = name.removesuffix(Path(name).suffix)
        lines = [line for line in found.output.splitlines() if stem in line.partition(": ")[0]]
        assert any(why in line for line in lines), (name, found.output)
    for name in (f"good{READING}", "good.jpg", "answers.csv"):
        assert (out / name).read_bytes() == (alone / name).read_bytes()


def test_a_fault_in_reading_one_picture_is_told_of_that_one(
    a_class: Path, sheet: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    of = read_sheet.found_sheet

    def found(grey: Any, *more: Any) -> Any:
        if grey.mean() < 200:
            raise StopIteration
        return of(grey, *more)

    monkeypatch.setattr(read_sheet, "found_sheet", found)
    monkeypatch.delenv(PLAIN_TRACEBACK, raising=False)
    (tmp_path / "good.jpg").write_bytes(sheet)
    dark = Image.open(io.BytesIO(sheet)).point(lambda value: value * 3 // 4)
    dark.save(tmp_path / "dark.jpg")
    result = call("read", a_class, tmp_path, "-o", tmp_path / "out", "--jobs", "1", "--by-hand")
    assert result.exit_code == 1, result.output
    assert "dark: refused: a fault in graphkin itself (StopIteration" in result.output
    assert "1 of 2 photographs read" in result.output


def test_pictures_of_one_name_are_refused_and_the_others_read(tmp_path: Path) -> None:
    """Readings are kept by name, and nobody is to get those of another."""
    for name in ("a.jpg", "a.png", "b.jpg"):
        (tmp_path / name).write_bytes(b"")
    found = {each.path.name: each.refused for each in photographs([tmp_path])}
    assert not found.pop("b.jpg")
    assert all("rename one of them" in why for why in found.values())
    assert len(photographs([tmp_path / "b.jpg", tmp_path / "b.jpg"])) == 1


def test_all_pages_of_a_pdf_are_read_or_it_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = pikepdf.new()
    for _ in range(450):
        made.add_blank_page()
    made.save(tmp_path / "many.pdf")
    found = photographs([tmp_path / "many.pdf"])
    assert [each.page for each in found] == list(range(450))
    monkeypatch.setattr(pictures, "MOST_PAGES", 449)
    (only,) = photographs([tmp_path / "many.pdf"])
    assert only.refused == "has 450 pages, 449 at most: split it"


# --- kinds of pictures that are read --------------------------------------------------------------


def saved(image: Image.Image, path: Path, **how: Any) -> Any:
    image.save(path, **how)
    (only,) = photographs([path])
    return grey_of(only)


def test_a_picture_is_as_grey_however_it_is_kept(sheet: bytes, tmp_path: Path) -> None:
    """Sixteen bits, transparent paper, the colours of a printer, several pictures in a file."""
    image = Image.open(io.BytesIO(sheet)).convert("L")
    plain = np.asarray(image, dtype=float)
    wide = Image.fromarray((np.asarray(image).astype(np.uint16) << 8) + 255)
    clear = Image.merge("RGBA", [Image.new("L", image.size)] * 3 + [image.point(lambda v: 255 - v)])
    again = [Image.new("L", image.size)]
    found = {
        "sixteen bits": saved(wide, tmp_path / "wide.png"),
        "transparent": saved(clear, tmp_path / "clear.png"),
        "grey and transparent": saved(image.convert("LA"), tmp_path / "la.png"),
        "palette": saved(image.convert("P"), tmp_path / "palette.png"),
        "printer": saved(image.convert("RGB").convert("CMYK"), tmp_path / "cmyk.jpg", quality=95),
        "animated": saved(image, tmp_path / "two.png", save_all=True, append_images=again),
    }
    for name, grey in found.items():
        assert grey.dtype == np.uint8
        assert np.abs(grey - plain).mean() < 2, name
    twelve = pictures.in_bytes(np.asarray(image).astype(np.uint16) << 4)
    assert np.abs(twelve - plain).mean() < 2


def test_what_a_decoder_raises_is_told_of_the_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(__file__, tmp_path / "a.png")
    (only,) = photographs([tmp_path / "a.png"])
    for error in (MemoryError, RecursionError, ZeroDivisionError, KeyError, StopIteration):

        def opened(data: bytes, raised: type[Exception] = error) -> Any:
            raise raised

        monkeypatch.setattr(pictures, "opened", opened)
        with pytest.raises(Unreadable, match="cut short or damaged"):
            grey_of(only)
