"""Photographs and scans as they come, opened with care: grey, upright, and nothing else of them.

What a camera writes beside a picture (place, time, owner) is not read and goes nowhere.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

from msgspec import Struct

from graphkin.numbers.arrays import np
from graphkin.scene.file_limits import file_bytes
from graphkin.text.errors import FileError, Problem
from graphkin.writers.files import file_part

KINDS = (".jpg", ".jpeg", ".png", ".heic", ".heif", ".pdf")
"""The files that are read."""
FORMATS = ("JPEG", "PNG", "HEIF")
"""What they hold; of several pictures in one file the first."""
MOST_BYTES = 200 << 20
MOST_PIXELS, LEAST_SIDE = 120_000_000, 900
"""Pixels of a picture at most, and those of its shorter side at least."""
HALVES = "-left", "-right"
"""How the names of the pictures of a sheet's halves end."""
MOST_PAGES = 400
"""Pages of a PDF file."""
EXPECTED = "a JPEG, PNG, HEIC or PDF file"


class Photograph(Struct, frozen=True):
    """A picture by the name that its reading has: its file, and which page of a PDF it is.

    ``left`` is the picture of the left half of a sheet of which this one is the right half.
    """

    name: str
    path: Path
    page: int | None = None
    left: Photograph | None = None

    @property
    def shown_name(self) -> str:
        """The name of its own file, where a reading of it bears that name."""
        whole = self.path.stem if self.page is None and self.left is None else self.name
        return whole if file_part(whole) == self.name else self.name


class Unreadable(Exception):
    """Why a picture cannot be read, in one line."""


def photographs(paths: list[Path]) -> list[Photograph]:
    """The pictures in some files and folders, by name.

    Raises FileError, all at once, for what is not there and for two of one name.
    """
    found: list[Photograph] = []
    problems: list[Problem] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(p for p in path.iterdir() if p.suffix.lower() in KINDS)
            if not inside:
                problems.append(Problem(str(path), "holds no picture", EXPECTED))
            for file in inside:
                found += pages_of(file)
        elif path.exists():
            found += pages_of(path)
        else:
            problems.append(Problem(str(path), "is not there", EXPECTED))
    names: dict[str, Photograph] = {}
    for each in found:
        other = names.setdefault(each.name, each)
        if other is not each:
            hint = "rename one of them: readings are kept by name"
            problems.append(
                Problem(str(each.path), f"has the name of {other.path}", "one of each", hint)
            )
    if problems:
        raise FileError(problems)
    return with_halves(found)


def with_halves(found: list[Photograph]) -> list[Photograph]:
    """Some pictures, the two halves of a sheet (NAME-left, NAME-right) as one of the sheet."""
    named = {each.name: each for each in found}
    left, right = HALVES
    sheets = []
    for each in found:
        name, half = each.name.removesuffix(left), each.name.endswith(left)
        if half and f"{name}{right}" in named and name not in named:
            continue
        name = each.name.removesuffix(right)
        other = named.get(f"{name}{left}")
        if each.name.endswith(right) and other is not None and name not in named:
            sheets.append(Photograph(name, each.path, each.page, other))
        else:
            sheets.append(each)
    return sheets


def pages_of(path: Path) -> Iterator[Photograph]:
    """The pictures of a file: itself, or the pages of a PDF."""
    stem = file_part(path.stem)
    if path.suffix.lower() != ".pdf":
        yield Photograph(stem, path)
        return
    import pikepdf

    try:
        with pikepdf.open(io.BytesIO(file_bytes(path, MOST_BYTES))) as pdf:
            count = min(len(pdf.pages), MOST_PAGES)
    except (pikepdf.PdfError, OSError, ValueError):
        count = 1
    for page in range(count):
        yield Photograph(stem if count == 1 else f"{stem}-{page + 1}", path, page)


def hash_of_picture(photograph: Photograph) -> str:
    """A hash of a picture's file and page."""
    try:
        data = file_bytes(photograph.path, MOST_BYTES)
    except (OSError, ValueError):
        data = b""
    other = hash_of_picture(photograph.left) if photograph.left else ""
    return sha256(data + f"{photograph.page}{other}".encode()).hexdigest()


def grey_of(photograph: Photograph) -> Any:
    """The picture as an upright array of greys. Raises Unreadable with the reason."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        data = file_bytes(photograph.path, MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "cannot be opened"
        raise Unreadable(str(reason).lower()) from None
    if len(data) > MOST_BYTES:
        raise Unreadable(f"has more than {MOST_BYTES >> 20} MB")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            image = scanned(data, photograph.page) if photograph.page is not None else opened(data)
            refuse_size(*image.size)
            return np.ascontiguousarray(np.asarray(darkest(ImageOps.exif_transpose(image))))
    except UnidentifiedImageError:
        raise Unreadable(f"is no picture: {EXPECTED} is expected") from None
    except Image.DecompressionBombError:
        raise Unreadable(f"has more than {MOST_PIXELS // 10**6} million pixels") from None
    except (OSError, ValueError, SyntaxError, EOFError, MemoryError, RuntimeError):
        raise Unreadable("is cut short or damaged") from None


def darkest(image: Any) -> Any:
    """The darkest of a picture's colours at each place, as greys: a coloured pencil is as dark
    there as a grey one.
    """
    from PIL import ImageChops

    if image.mode in ("1", "L"):
        return image.convert("L")
    red, green, blue = image.convert("RGB").split()
    return ImageChops.darker(ImageChops.darker(red, green), blue)


def opened(data: bytes) -> Any:
    """A picture whose pixels are not yet read."""
    from PIL import Image
    from pillow_heif import register_heif_opener

    register_heif_opener(thumbnails=False)
    image = Image.open(io.BytesIO(data), formats=FORMATS)
    refuse_size(*image.size)
    return image


def refuse_size(width: int, height: int) -> None:
    """Raise Unreadable for a picture that is too large, or too small to hold a sheet's lines."""
    if width * height > MOST_PIXELS:
        found = f"has {width * height / 1e6:.0f} million pixels"
        raise Unreadable(f"{found}, {MOST_PIXELS // 10**6} at most")
    if min(width, height) < LEAST_SIDE:
        raise Unreadable(f"is {width} × {height} pixels, too few for an A3 sheet")


def scanned(data: bytes, page: int) -> Any:
    """The picture that fills a page of a PDF file: the largest on it."""
    import pikepdf

    try:
        with pikepdf.open(io.BytesIO(data)) as pdf:
            images: list[Any] = list(pdf.pages[page].images.values())
            if not images:
                raise Unreadable("holds no scanned picture on this page")
            largest = max(images, key=lambda each: int(each.Width) * int(each.Height))
            refuse_size(int(largest.Width), int(largest.Height))
            image = pikepdf.PdfImage(largest).as_pil_image()
            turn = int(pdf.pages[page].obj.get("/Rotate", 0))
            return image.rotate(-turn, expand=True) if turn else image
    except (pikepdf.PdfError, pikepdf.UnsupportedImageTypeError, NotImplementedError, KeyError):
        raise Unreadable("is no PDF file whose scan can be read: save it as JPEG") from None
