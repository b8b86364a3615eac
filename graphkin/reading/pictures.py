"""Photographs and scans, opened safely as upright grey pictures.

The metadata that a camera adds (place, time, owner) is not used and is never passed on.
"""

from __future__ import annotations

import io
import warnings
import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.numbers.arithmetic import np
from graphkin.scene.file_limits import file_bytes
from graphkin.text.errors import FileError, Problem, message
from graphkin.writers.files import file_part

KINDS = (".jpg", ".jpeg", ".png", ".heic", ".heif", ".pdf")
"""The endings of the files that are read."""
FORMATS = ("JPEG", "PNG", "HEIF")
"""The picture formats that are read; only the first picture of a file is used."""
OTHERS = (
    *(".tif", ".tiff", ".gif", ".bmp", ".webp", ".avif", ".jp2", ".jxl", ".dng", ".raw", ".svg"),
    *(".zip", ".docx", ".odt"),
)
"""Files in a folder that may hold a drawing but are not read: each is refused by name."""
MOST_BYTES = 200 << 20
MOST_PIXELS, MOST_SIDE, LEAST_SIDE = 120_000_000, 20_000, 900
"""The most pixels of a picture and of its longer side, and the fewest of its shorter side."""
MOST_UNPACKED = 4 * MOST_PIXELS
"""The most bytes that any part of a PDF file may take when unpacked."""
GROWTH = {"/LZWDecode": 1400, "/LZW": 1400, "/RunLengthDecode": 64, "/RL": 64}
"""The largest growth of other compression filters when unpacked."""
HALVES = "-left", "-right"
"""The name endings for pictures of a sheet's halves."""
MOST_PAGES = 2000
"""The most pages of a PDF file; a longer file is refused."""
EXPECTED = message("a JPEG, PNG, HEIC or PDF file")


class Photograph(Struct, frozen=True):
    """A picture under the name of its reading: its file, and the page of a PDF.

    ``left`` is the picture of the left half of a sheet when this picture is its right half.
    ``refused`` is the reason why the picture is not read, if any.
    """

    name: str
    path: Path
    page: int | None = None
    left: Photograph | None = None
    refused: str = ""

    @property
    def shown_name(self) -> str:
        """The name of the picture's own file, where its reading has that name."""
        whole = self.path.stem if self.page is None and self.left is None else self.name
        return whole if file_part(whole) == self.name else self.name


class Unreadable(Exception):
    """The reason why a picture cannot be read, in one line."""


def photographs(paths: list[Path]) -> list[Photograph]:
    """The pictures in some files and folders; pictures that share a name are all refused.

    Raises FileError, with all problems at once, for paths that do not exist and folders without
    pictures.
    """
    found: list[Photograph] = []
    problems: list[Problem] = []
    for path in paths:
        if path.is_dir():
            inside = list(pictures_in(path))
            if not any(each.suffix.lower() in KINDS for each in inside):
                problems.append(Problem(str(path), message("holds no picture"), EXPECTED))
            for file in inside:
                found += pages_of(file)
        elif path.exists():
            found += pages_of(path)
        else:
            problems.append(Problem(str(path), message("is not there"), EXPECTED))
    if problems:
        raise FileError(problems)
    found = list({(str(each.path), each.page): each for each in found}.values())
    times = Counter(each.name for each in found)
    return with_halves([each if times[each.name] == 1 else twin(each, found) for each in found])


def pictures_in(folder: Path) -> Iterator[Path]:
    """The files of a folder that are, or may be meant as, pictures; and its picture folders."""
    for path in sorted(folder.iterdir()):
        if path.is_dir():
            inside = [each.name.lower() for each in path.iterdir()]
            is_ours = any(name.endswith(".reading.json") for name in inside)
            if not is_ours and any(name.endswith(KINDS) for name in inside):
                yield path
        elif path.suffix.lower() in (*KINDS, *OTHERS) and not path.name.startswith("."):
            yield path


def twin(own: Photograph, every: list[Photograph]) -> Photograph:
    """A refused copy of a picture whose name others share, because readings are kept by name."""
    others = [each for each in every if each.name == own.name and each is not own]
    said = f"has the name of {others[0].path}: rename one of them, readings are kept by name"
    page = f", page {own.page + 1}" if own.page is not None else ""
    return replace(own, name=f"{own.path}{page}", refused=said)


def with_halves(found: list[Photograph]) -> list[Photograph]:
    """The pictures, with the two halves of a sheet (NAME-left, NAME-right) as one picture."""
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
    """The pictures of a file: the file itself, or the pages of a PDF."""
    stem, kind = file_part(path.stem), path.suffix.lower()
    if path.is_dir():
        yield Photograph(str(path), path, refused="is a folder within a folder: name it as well")
    elif kind in OTHERS:
        yield Photograph(str(path), path, refused=f"is not read: {EXPECTED} is expected")
    elif kind != ".pdf":
        yield Photograph(stem, path)
    elif (count := count_of_pages(path)) > MOST_PAGES:
        said = f"has {count} pages, {MOST_PAGES} at most: split it"
        yield Photograph(str(path), path, refused=said)
    else:
        for page in range(count):
            yield Photograph(stem if count == 1 else f"{stem}-{page + 1}", path, page)


def count_of_pages(path: Path) -> int:
    """The number of pages of a PDF file; 1 if unreadable, so that reading reports the error."""
    try:
        with opened_pdf(file_bytes(path, MOST_BYTES)) as pdf:
            return len(pdf.pages)
    except Exception:  # reading the page reports whatever is wrong
        return 1


@contextmanager
def opened_pdf(data: bytes) -> Iterator[Any]:
    """An open PDF file, with a limit on unpacked sizes where pikepdf supports one."""
    import pikepdf

    limit = getattr(pikepdf.settings, "set_qpdf_limits", None)
    before = limit(flate_max_memory=MOST_UNPACKED) if limit is not None else {}
    try:
        with pikepdf.open(io.BytesIO(data)) as pdf:
            yield pdf
    finally:
        if limit is not None:
            limit(**before)


def hash_of_picture(photograph: Photograph) -> str:
    """A hash of a picture's file and page."""
    try:
        changed = photograph.path.stat().st_mtime_ns
    except OSError:
        changed = 0
    found = hash_of_file(photograph.path, changed).copy()
    other = hash_of_picture(photograph.left) if photograph.left else ""
    found.update(f"{photograph.page}{other}".encode())
    return str(found.hexdigest())


@lru_cache(maxsize=4)
def hash_of_file(path: Path, changed: int) -> Any:
    """The hash of a file's bytes, computed once for all its pages until the file changes."""
    try:
        return sha256(file_bytes(path, MOST_BYTES))
    except (OSError, ValueError):
        return sha256()


def grey_of(photograph: Photograph) -> Any:
    """The picture as an upright array of greys. Raises Unreadable with the reason."""
    return darkest(colours_of(photograph))


def colours_of(photograph: Photograph) -> Any:
    """The picture as an upright array of bytes: red, green and blue, or greys alone.

    Raises Unreadable with the reason.
    """
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
            return np.ascontiguousarray(np.asarray(in_colour(ImageOps.exif_transpose(image))))
    except Unreadable:
        raise
    except UnidentifiedImageError:
        raise Unreadable(f"is no picture: {EXPECTED} is expected") from None
    except Image.DecompressionBombError:
        raise Unreadable(f"has more than {MOST_PIXELS // 10**6} million pixels") from None
    except Exception:  # a decoder may raise anything for a damaged file
        raise Unreadable("is cut short or damaged") from None


def darkest(picture: Any) -> Any:
    """The darkest colour of each place, so that coloured pencil is as dark as grey pencil."""
    if picture.ndim == 2:
        return picture
    red, green, blue = (picture[..., k] for k in range(3))
    return np.minimum(np.minimum(red, green), blue)


def in_colour(image: Any) -> Any:
    """A picture in red, green and blue, or in greys where it has no colours."""
    from PIL import Image

    if image.mode in ("1", "L"):
        return image.convert("L")
    if image.mode.startswith(("I", "F")):
        return Image.fromarray(in_bytes(np.asarray(image)))
    if image.has_transparency_data:
        paper = Image.new("RGBA", image.size, "white")
        image = Image.alpha_composite(paper, image.convert("RGBA"))
    return image.convert("RGB")


def in_bytes(greys: Any) -> Any:
    """Greys of more than eight bits as bytes; the largest value implies the bit depth."""
    most = float(greys.max(initial=0))
    top = next((top for top in (255.0, 4095.0, 65535.0) if most <= top), most)
    return np.clip(greys * (255.0 / top), 0, 255).astype(np.uint8)


def opened(data: bytes) -> Any:
    """A picture whose pixels are not yet read."""
    from PIL import Image
    from pillow_heif import register_heif_opener

    register_heif_opener(thumbnails=False)
    image = Image.open(io.BytesIO(data), formats=FORMATS)
    refuse_size(*image.size)
    return image


def refuse_size(width: int, height: int) -> None:
    """Raise Unreadable for a picture that is too large, or too small to show a sheet's lines."""
    if width * height > MOST_PIXELS:
        found = f"has {width * height / 1e6:.0f} million pixels"
        raise Unreadable(f"{found}, {MOST_PIXELS // 10**6} at most")
    if max(width, height) > MOST_SIDE:
        raise Unreadable(f"is {width} × {height} pixels, {MOST_SIDE} at most on a side")
    if min(width, height) < LEAST_SIDE:
        raise Unreadable(f"is {width} × {height} pixels, too few for an A3 sheet")


def scanned(data: bytes, page: int) -> Any:
    """The largest picture on a page of a PDF file, which is the scan that fills it."""
    import pikepdf

    try:
        with opened_pdf(data) as pdf:
            images: list[Any] = list(pdf.pages[page].images.values())
            if not images:
                raise Unreadable("holds no scanned picture on this page")
            largest = max(images, key=lambda each: int(each.Width) * int(each.Height))
            refuse_size(int(largest.Width), int(largest.Height))
            refuse_bomb(largest)
            image = pikepdf.PdfImage(largest).as_pil_image()
            turn = int(pdf.pages[page].obj.get("/Rotate", 0))
            return image.rotate(-turn, expand=True) if turn else image
    except Unreadable:
        raise
    except Exception:  # other colours, other ways to pack, damage: pikepdf raises many kinds
        raise Unreadable("is no PDF file whose scan can be read: save it as JPEG") from None


def refuse_bomb(image: Any) -> None:
    """Raise Unreadable where a picture in a PDF file unpacks to far more bytes than it needs.

    The data is unpacked only up to the expected size.
    """
    rows, bits = int(image.Height), int(image.get("/BitsPerComponent", 8))
    expected = rows * (int(image.Width) * 4 * bits // 8 + 2) + 1024
    filters = image.get("/Filter", [])
    names = [str(filters)] if str(filters).startswith("/") else [str(each) for each in filters]
    data = image.read_raw_bytes()
    for place, name in enumerate(names):
        is_last = place == len(names) - 1
        most = expected if is_last else MOST_BYTES
        if name in ("/FlateDecode", "/Fl"):
            data = zlib.decompressobj().decompress(data, most + 1)
        if name in GROWTH and len(data) * GROWTH[name] > MOST_UNPACKED:
            raise Unreadable("is packed in a way that is not read: save it as JPEG")
        if name in ("/FlateDecode", "/Fl") and len(data) > most:
            found = f"holds more than {most / 1e6:.0f} MB"
            raise Unreadable(f"{found}, and its picture has {rows * int(image.Width) / 1e6:.0f} MP")
