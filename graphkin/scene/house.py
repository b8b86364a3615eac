"""A school's conventions: the keys of house.toml, listed once, and the record that they give.

A scene has the conventions of the house.toml beside it, or of the one that a command names. What
the scene itself states goes before them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from io import BytesIO
from typing import Any, Literal

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.scene.file_limits import LARGEST, decoded, tables_of, whole_file
from graphkin.scene.findings import Findings, Table, listed, nearest, plain_text, shown
from graphkin.scene.measures import FloatText
from graphkin.text import LANGUAGES, paths
from graphkin.text.errors import NO_WORDS, HouseError, Message, SceneError, message
from graphkin.text.school_signs import MEANINGS, NAMES, SCHOOLS, USUAL, SchoolSigns

HOUSE = "house.toml"
"""The name of the file."""
FORMAT = 1
SET = "set"
"""The key of a set of signs, beside those of single signs."""
SIGN = r"[A-Za-zα-ωΑ-Ω]{1,4}(_[A-Za-z0-9α-ω]{1,3})?[′']?"
"""A sign as it is written: letters, perhaps an index after an underscore, perhaps a prime."""
MOST_LINES, LARGEST_LOGO, MOST_PIXELS = 2, 2 << 20, 16_000_000
"""The most lines of a header, bytes of a logo, and pixels of a picture."""
PNG = b"\x89PNG\r\n\x1a\n"
INKS = ("colour", "black")
THICK, GROUPS = 0.5, (0.25, 0.35, 0.5, 0.7)
"""The usual width of thick lines in mm, and the line groups of ISO 128."""
RESULTS = ("SI", "scene", "mm", "cm", "m", "in", "ft")
"""The units of results: metres, the unit of the scene, or a unit of length."""
PAPERS: Mapping[str, tuple[float, float]] = {
    "A4": (210.0, 297.0),
    "A3": (420.0, 297.0),
    "A2": (594.0, 420.0),
    "A1": (841.0, 594.0),
    "ANSI B": (431.8, 279.4),
    "ANSI C": (558.8, 431.8),
}
"""The papers of sheets, with their widths and heights in mm (ISO 216, ASME Y14.1)."""
USUAL_PAPER = "A3"
FRAMES = ("ISO", "GOST")
"""The frames of the papers of ISO 216; those of ANSI have the frame of ASME Y14.1."""
CELLS = (
    *("title", "creator", "legal_owner", "document_type", "approved_by", "scale"),
    *("identification", "revision", "date_of_issue", "language", "sheet"),
)
"""The cells of a title block whose labels a house may change; not the student's."""


class Logo(Struct, frozen=True):
    """A picture: the name of its file, its bytes, and its width over its height."""

    name: str
    data: bytes
    aspect: float

    @property
    def kind(self) -> Literal["png", "svg"]:
        """Whether it is a PNG or an SVG picture."""
        return "png" if self.data.startswith(PNG) else "svg"


class House(Struct, frozen=True):
    """The conventions of a school; ``text`` is the exact text of its file, for copies of a lab."""

    header: tuple[str, ...] = ()
    logo: Logo | None = None
    author: str = ""
    approved: str = ""
    labels: Mapping[str, str] = field(default_factory=dict)
    language: str = "en"
    paper: str = USUAL_PAPER
    frame: str = ""
    ink: Literal["colour", "black"] = "colour"
    signs: SchoolSigns = USUAL
    results: str = ""
    steps: tuple[float, ...] = ()
    thick: float = THICK
    text: str = ""

    @property
    def files(self) -> dict[str, bytes]:
        """The file and its logo by name; empty without a file."""
        if not self.text:
            return {}
        logo = {self.logo.name: self.logo.data} if self.logo else {}
        return {HOUSE: self.text.encode(), **logo}


PLAIN = House()
"""The conventions without any file."""


class HouseKey(Struct, frozen=True):
    """A key of house.toml: its table and name, its reader, its meaning, and an example in TOML.

    ``gives`` is the field of the record; the keys of signs give one record together.
    """

    table: str
    name: str
    reads: Callable[[Table, str, str], Any]
    words: str
    example: str
    gives: str = ""


# --- readers of single keys -----------------------------------------------------------------------


def text(table: Table, key: str, folder: str) -> str:
    return table.text(key)


def lines(table: Table, key: str, folder: str) -> tuple[str, ...]:
    """One or two lines of text."""
    raw, place = table.take(key), table.at(key)
    if raw is None:
        return ()
    many = raw if isinstance(raw, list) else [raw]
    if not 0 < len(many) <= MOST_LINES:
        expected = message('one or two texts, such as ["Faculty", "Department"]')
        table.findings.add(place, shown(raw), expected)
        return ()
    found = (plain_text(f"{place}[{i}]", each, table.findings) for i, each in enumerate(many))
    return tuple(" ".join(each.split()) for each in found)


def labels(table: Table, key: str, folder: str) -> dict[str, str]:
    """The labels of cells, by the names of the cells."""
    inner = table.table(key)
    found = {name: inner.text(name) for name in CELLS if name in inner}
    inner.known.extend(CELLS)
    inner.finish()
    return found


def choice(*words: str) -> Callable[[Table, str, str], str]:
    """The reader of one of some words, the first by default."""
    return lambda table, key, folder: table.choice(key, words, words[0])


def paper(table: Table, key: str, folder: str) -> str:
    """The name of a paper."""
    return table.choice(key, tuple(PAPERS), USUAL_PAPER)


def frame(table: Table, key: str, folder: str) -> str:
    """The name of a frame; empty where none is stated."""
    return table.choice(key, FRAMES, FRAMES[0]) if key in table else ""


def results(table: Table, key: str, folder: str) -> str:
    """The unit of results; empty where none is stated."""
    return table.choice(key, RESULTS, RESULTS[0]) if key in table else ""


def steps(table: Table, key: str, folder: str) -> tuple[float, ...]:
    """The first digits of scales: numbers from 1 to below 10."""
    raw, place = table.take(key), table.at(key)
    if raw is None:
        return ()
    found = [number_of(each) for each in raw] if isinstance(raw, list) else [None]
    kept = sorted({each for each in found if each is not None and 1 <= each < 10})
    if not kept or len(kept) < len(found):
        expected = message("a list of numbers from 1 to below 10, each once, such as [1, 2, 5]")
        table.findings.add(place, shown(raw), expected)
    return tuple(kept)


def thick(table: Table, key: str, folder: str) -> float:
    """The width of thick lines in mm: a line group of ISO 128."""
    raw = table.take(key)
    found = THICK if raw is None else number_of(raw)
    if found not in GROUPS:
        expected = message("one of {names}", names=", ".join(f"{each:g}" for each in GROUPS))
        table.wrong(key, shown(raw), expected)
        return THICK
    return found


def number_of(raw: object) -> float | None:
    """A plain number of a file; None for anything else."""
    return float(raw) if isinstance(raw, int | FloatText) and not isinstance(raw, bool) else None


def logo(table: Table, key: str, folder: str) -> Logo | None:
    """A picture in the folder of the file."""
    name, place = table.text(key), table.at(key)
    if not name:
        return None
    expected = message("the name of a PNG or SVG file beside {file}", file=HOUSE)
    if paths.name_of(name) != name:
        table.findings.add(place, shown(name), expected, message("copy the picture there"))
        return None
    try:
        data = whole_file(paths.within(folder, name), LARGEST_LOGO)
    except (OSError, ValueError) as error:
        table.findings.add(place, unreadable(error), expected)
        return None
    aspect = aspect_of_png(data) if data.startswith(PNG) else aspect_of_svg(data)
    if not 0.05 <= aspect <= 20:
        found = message("is no picture that can be drawn")
        table.findings.add(place, found, expected, message("save it again as PNG"))
        return None
    return Logo(name, data, aspect)


def unreadable(error: Exception) -> Message:
    """Why a file cannot be read."""
    said = getattr(error, "strerror", None) or ""
    reason = f"{said[:1].lower()}{said[1:]}" or message("cannot be opened")
    return message("cannot be read: {reason}", reason=reason)


def aspect_of_png(data: bytes) -> float:
    """The width of a PNG picture over its height; 0 for one that cannot be drawn."""
    from PIL import Image

    try:
        with Image.open(BytesIO(data), formats=("PNG",)) as image:
            width, height = image.size
            if width * height > MOST_PIXELS:
                return 0.0
            image.load()
    except (OSError, SyntaxError, ValueError):
        return 0.0
    return width / height


def aspect_of_svg(data: bytes) -> float:
    """The width of an SVG picture over its height; 0 for one that cannot be drawn."""
    from xml.etree.ElementTree import ParseError

    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root = fromstring(data)
    except (ParseError, DefusedXmlException, ValueError):
        return 0.0
    box = re.findall(r"-?[\d.]+", root.get("viewBox", ""))
    size = [re.match(r"[\d.]+(?!.*%)", root.get(side, "")) for side in ("width", "height")]
    try:
        wide, high = (float(each[0]) for each in size if each) if all(size) else map(float, box[2:])
        return wide / high if root.tag.endswith("}svg") else 0.0
    except (ValueError, ZeroDivisionError):
        return 0.0


# --- the list of keys -----------------------------------------------------------------------------


def quoted(words: Iterator[str] | tuple[str, ...]) -> str:
    """Words in quotes, as the values of a key."""
    return ", ".join(f'"{word}"' for word in words)


HOUSE_KEYS = (
    HouseKey(
        "header",
        "lines",
        lines,
        "one or two lines: in the title block, and above the frame of A4 pages",
        '["University of Somewhere", "Department of Mechanisms"]',
        "header",
    ),
    HouseKey(
        "header",
        "logo",
        logo,
        "a picture beside the lines in the title block: a PNG or SVG file beside this file",
        '"logo.png"',
        "logo",
    ),
    HouseKey("title", "author", text, "who made the sheets", '"A. Lecturer"', "author"),
    HouseKey("title", "approved", text, "who approved them", '"B. Lecturer"', "approved"),
    HouseKey(
        "title",
        "labels",
        labels,
        f"other labels of cells: {', '.join(CELLS)}; the student's box keeps its own",
        '{ legal_owner = "School", creator = "Author" }',
        "labels",
    ),
    HouseKey(
        "pages",
        "language",
        choice("en", *(code for code in LANGUAGES if code != "en")),
        f"the language of pages: {quoted(LANGUAGES)}",
        '"en"',
        "language",
    ),
    HouseKey(
        "pages",
        "paper",
        paper,
        f"the paper of sheets: {quoted(tuple(PAPERS))}. On A4, mechanism and plan are on two pages"
        " that lie side by side",
        '"ANSI B"',
        "paper",
    ),
    HouseKey(
        "pages",
        "frame",
        frame,
        f"the frame and the title block of A1 to A4: {quoted(FRAMES)} (2.104, form 1). By default"
        " GOST with the russian signs, else ISO; ANSI papers have those of ASME Y14.1",
        '"GOST"',
        "frame",
    ),
    HouseKey(
        "pages",
        "ink",
        choice(*INKS),
        "black: for printers without colour; line styles distinguish the vectors",
        '"black"',
        "ink",
    ),
    HouseKey(
        "units",
        "results",
        results,
        f"the unit of lengths in results: {quoted(RESULTS)}; speeds are per s. By default inches"
        " for a scene in inches, feet for one in feet, else metres. Forces are in lbf with inches"
        " or feet, else in N",
        '"scene"',
        "results",
    ),
    HouseKey(
        "scales",
        "steps",
        steps,
        "the first digits n of the scales 1:n and n:1 among which the program chooses. By default"
        " those of ISO 5455 first, and 1, 2, 4 and 8 for a scene in inches or feet",
        "[1, 2, 5]",
        "steps",
    ),
    HouseKey(
        "lines",
        "thick",
        thick,
        "the width of thick lines in mm, with which all others change: 0.25, 0.35, 0.5 or 0.7",
        "0.35",
        "thick",
    ),
    HouseKey("signs", SET, text, f"the signs of a school: {quoted(tuple(SCHOOLS))}", '"english"'),
    *(HouseKey("signs", name, text, MEANINGS[name], f'"{getattr(USUAL, name)}"') for name in NAMES),
)
"""Every key of house.toml, in the order of its template."""
HEADINGS: Mapping[str, str] = {
    "header": "who hands the sheets out",
    "title": "the title block",
    "pages": "all pages",
    "units": "units of results",
    "scales": "rules of scales",
    "lines": "drawing rules",
    "signs": "signs of quantities: a school's set, then single signs that differ from it",
}
"""What each table of house.toml is about."""


# --- the file -------------------------------------------------------------------------------------


def read_house(path: paths.Named) -> House:
    """The conventions in a file. Raises HouseError with all mistakes of the file."""
    try:
        data = whole_file(path, LARGEST)
    except (OSError, ValueError) as error:
        hint = message("graphkin new house writes one")
        raise HouseError.at(str(path), unreadable(error), NO_WORDS, hint) from None
    try:
        return house_of(decoded(data), paths.folder_of(path))
    except SceneError as error:
        raise HouseError(replace(each, file=str(path)) for each in error.problems) from None


def is_house(path: paths.Named) -> bool:
    """Whether a file has the conventions of a school: it is called house.toml, or has its tables.

    ``graphkin new house`` writes house.toml, but a lecturer may keep one file for each school.
    """
    if not paths.is_file(path) or paths.name_of(path) == HOUSE:
        return paths.is_file(path)
    try:
        tables = tables_of(decoded(whole_file(path, LARGEST)), Findings())
    except (OSError, ValueError, SceneError):
        return False
    named = {*tables} - {"graphkin"}
    return bool(named) and named <= {*HEADINGS}


def house_beside(path: paths.Named) -> House:
    """The conventions in the folder of a scene's file; plain ones without a house.toml there."""
    file = paths.within(paths.folder_of(path), HOUSE)
    return read_house(file) if paths.is_file(file) else PLAIN


def house_of(written: str, folder: str) -> House:
    """The conventions in a text, whose pictures are in a folder."""
    findings = Findings()
    top = Table("", tables_of(written, findings), findings)
    check_format(top)
    tables = {name: top.table(name) for name in HEADINGS if name != "signs"}
    found = {
        key.gives: key.reads(tables[key.table], key.name, folder) for key in HOUSE_KEYS if key.gives
    }
    for table in tables.values():
        table.finish()
    signs = read_signs(top, "signs")
    top.finish()
    findings.stop()
    return House(**found, signs=signs, text=written)


def check_format(top: Table) -> None:
    """Note a missing or unknown version of the format."""
    version = top.take("graphkin")
    if version != FORMAT or isinstance(version, bool):
        found = message("is missing") if version is None else shown(version)
        expected = message("the first line graphkin = {format}", format=FORMAT)
        top.findings.add("graphkin", found, expected)


def template() -> str:
    """A house.toml to start from: every key with its meaning, none of them in force."""
    parts = [
        f"graphkin = {FORMAT}",
        "",
        "# The conventions of a school. Remove the # before a key to use it.",
        "# What a scene states goes before this file.",
    ]
    for heading, about in HEADINGS.items():
        parts += ["", f"[{heading}]  # {about}"]
        for key in HOUSE_KEYS:
            if key.table == heading:
                parts += [f"# {key.name} = {key.example}", f"#   {key.words}"]
    return "\n".join(parts) + "\n"


# --- signs ----------------------------------------------------------------------------------------


def read_signs(holder: Table, key: str, default: SchoolSigns = USUAL) -> SchoolSigns:
    """The signs under a key: the name of a school's set, or a table of a set and single signs.

    Signs that are not stated are those of ``default``.
    """
    raw = holder.raw.get(key)
    if isinstance(raw, str):
        holder.known.append(key)
        return school_set(holder.at(key), raw, holder.findings, default)
    table = holder.table(key)
    named = table.take(SET)
    base = default if named is None else school_set(table.at(SET), named, table.findings, default)
    own = {name: getattr(base, name) for name in NAMES}
    for name in NAMES:
        sign = table.text(name)
        if sign and not re.fullmatch(SIGN, sign):
            expected = message("one to four letters, such as {sign}", sign=getattr(USUAL, name))
            table.wrong(name, shown(sign), expected)
        elif sign:
            own[name] = sign.replace("'", "′")
    table.finish()
    return SchoolSigns(**own)


def school_set(place: str, raw: object, findings: Findings, default: SchoolSigns) -> SchoolSigns:
    """The set of signs of a school's name."""
    if isinstance(raw, str) and raw in SCHOOLS:
        return SCHOOLS[raw].signs
    hint = nearest(raw, SCHOOLS) if isinstance(raw, str) else NO_WORDS
    findings.add(place, shown(raw), listed(SCHOOLS), hint)
    return default
