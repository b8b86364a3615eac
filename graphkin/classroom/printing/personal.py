"""A student's own sheets: the name and the opaque code on every page, the square where it fits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from unicodedata import category, normalize

from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.printing.qr_code import stamped
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.documents.overlay import FOOT
from graphkin.drawing.areas import A3_AREA
from graphkin.drawing.frame import STUDENT, STUDENTS, fitting, room_in
from graphkin.drawing.glyphs import known, measures
from graphkin.drawing.marks import Page, Text
from graphkin.drawing.symbol_markup import escape
from graphkin.text.errors import PageError

UNKNOWN = "?"
"""What stands for a sign that the sheet's font does not have."""
OVERLAY_FOOT = (A3_AREA[0] + 12, A3_AREA[3] - FOOT + 4.6)
"""Where an overlay says whose it is, in mm: below its caption."""


class Owner(Struct, frozen=True):
    """Whose a sheet is: the name as it is printed, with the group, and the opaque code."""

    name: str
    code: str

    @property
    def line(self) -> str:
        """Name and code on one line."""
        return f"{self.name}   {self.code}"


def owner(taker: Taker) -> Owner:
    """Whose the sheets of a student are."""
    return Owner(shortened(printable_name(taker.student)), taker.code)


def printable_name(student: Student) -> str:
    """A student's name and group in signs of the sheet's font; one without a name, or of whose
    name it has no letter, is called by the id."""
    name = student.name if is_readable(student.name) else student.id
    return ", ".join(filter(None, (writable(name) or UNKNOWN, writable(student.group))))


def is_readable(name: str) -> bool:
    """Whether the font has some letter of a name."""
    return any(sign.isalnum() for sign in writable(name))


def writable(text: str) -> str:
    """A text in signs of the sheet's font: letters without their marks, ? for what is unknown."""
    face = measures(italic=False)
    found = []
    for sign in known(normalize("NFC", " ".join(text.split()))):
        bare = next((part for part in normalize("NFKD", sign) if part in face), UNKNOWN)
        if category(sign)[0] != "C":
            found.append(sign if sign in face else bare)
    return "".join(found).strip()


def lost(text: str) -> tuple[str, ...]:
    """The signs of a text that are printed as ?, each once."""
    signs = dict.fromkeys(normalize("NFC", text))
    return tuple(sign for sign in signs if sign != UNKNOWN and writable(sign) == UNKNOWN)


def shortened(text: str) -> str:
    """A text that fits the title block, its end left out where it does not."""
    kept = text
    while kept and not fits(kept):
        kept = kept.removesuffix("…")[:-1].rstrip()
        kept += "…" if kept else ""
    return kept


def fits(text: str) -> bool:
    """Whether a name fits the title block in the smallest lettering."""
    try:
        _, rect, most = next(cell for cell in STUDENTS if cell[0] == STUDENT)
        fitting(STUDENT, text, *room_in(rect), most)
    except PageError:
        return False
    return True


def owned(drawing: Drawing, whose: Owner) -> Drawing:
    """A drawing whose title block names its student and bears the code."""
    number = drawing.scene.sheet.number
    both = f"{number} / {whose.code}" if number else whose.code
    return with_sheet(drawing, student=whose.name, number=both)


def owned_pages(drawings: Sequence[Drawing], whose: Owner) -> list[Drawing]:
    """Drawings whose calculation pages name their student and the code at the foot."""
    return [with_sheet(drawing, student=whose.line) for drawing in drawings]


def with_sheet(drawing: Drawing, **said: str) -> Drawing:
    """A drawing whose sheet says something else."""
    scene = drawing.scene
    return replace(drawing, scene=replace(scene, sheet=replace(scene.sheet, **said)))


def signed(pages: Sequence[Page], view: str, whose: Owner) -> Iterator[Page]:
    """The pages with their student's square; overlays, which have no title block, with the name."""
    for page in pages:
        if view == "overlay":
            x, y = OVERLAY_FOOT
            foot = Text(x, y, escape(whose.line), "caption", 2.5, name="owner")
            yield replace(page, marks=(*page.marks, foot))
        elif view == "task":
            yield stamped(page, whose.code)
        else:
            yield page
