"""What the tests of the sheets share: sheets of the shipped labs and others, ink as geometry."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import hypot

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, lay_out
from graphkin.documents.calculation import calculation
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.field import A3
from graphkin.drawing.marks import Arc, CircleMark, LineMark, Mark, Page, Polyline, Text, reach
from graphkin.drawing.style import style_of
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from graphkin.text.errors import PageError
from tests.chosen import FOLDER, STUDENTS
from tests.mechanisms import SHIPPED, shipped
from tests.scene_files import scene_texts

KINDS = ("velocity", "acceleration")
VARIANTS = [(lab, n) for lab in SHIPPED for n in STUDENTS]
"""Variants of the shipped labs."""

VECTORS = (
    "velocity",
    "relative-velocity",
    "acceleration",
    "normal",
    "tangential",
    "coriolis",
    "sliding",
)

HEAD = """graphkin = 1
title = "{title}"
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
"""
OTHERS = scene_texts("documents/others")
"""Scenes beside the shipped ones."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """One sheet with what it was drawn from; ``marks`` holds those of its two fields."""

    drawing: Drawing
    layout: Layout
    page: Page
    marks: dict[str, tuple[Mark, ...]]

    def rect(self, field: str) -> tuple[float, float, float, float]:
        """The rectangle of a field."""
        return (self.layout.mechanism if field == "mechanism" else self.layout.plan).rect

    def labels(self, field: str) -> list[Labelled]:
        """The labels of a field, details left out."""
        return [label for label in labels_of(self.marks[field]) if label.text.name]

    def notes(self, field: str) -> str:
        """What is said at the foot of a field."""
        marks = self.marks[field]
        return "; ".join(m.markup for m in marks if isinstance(m, Text) and m.name == "note")

    def meaning(self, field: str, label: Labelled) -> str:
        """What a label says, a key number taken for what the legend says of it."""
        if not re.fullmatch(r"\d+\)", label.text.markup):
            return label.text.markup
        pieces = self.notes(field).split("; ")
        return next(p for p in pieces if p.startswith(label.text.markup)).partition(" ")[2]

    def called(self, field: str, label: Labelled) -> dict[str, str]:
        """What a label says of each thing it names, of several points where they fall together."""
        said, name = re.split(" [≡≈] ", self.meaning(field, label)), label.text.name
        return dict(zip(name.split(" ") if len(said) > 1 else [name], said, strict=True))

    def vectors(self, field: str) -> list[LineMark]:
        """The vectors of a field, details left out."""
        return [mark for mark in self.marks[field] if is_vector(mark)]


@dataclass(frozen=True)
class Labelled:
    """A label's text with its own leader and ring, if it has them."""

    text: Text
    leader: LineMark | None = None
    ring: CircleMark | Polyline | None = None

    def ink(self) -> BaseGeometry:
        """What the label takes up on the page."""
        if isinstance(self.ring, CircleMark):
            disc = shapely.Point(self.ring.cx, self.ring.cy)
            return disc.buffer(self.ring.r + half_width(self.ring), quad_segs=32)
        if self.ring:
            return shapely.Polygon(self.ring.points).buffer(half_width(self.ring))
        return shapely.box(*reach(self.text))


# --- sheets --------------------------------------------------------------------------------------


@cache
def mechanism_named(name: str, n: int | None = None) -> Mechanism:
    """A shipped lab for a student's number, or another scene by its name."""
    if n is not None:
        return shipped(name, n)
    if name in OTHERS:
        return Mechanism(read_text(HEAD.format(title=name) + OTHERS[name], name, None, {}))
    return load(str(FOLDER / f"{name}.toml"))


@cache
def drawings(name: str, n: int | None = None, language: str = "en") -> tuple[Drawing, ...]:
    """The material of both sheets."""
    mechanism = mechanism_named(name, n)
    return tuple(drawings_of(mechanism, proved(mechanism, mechanism.solve()), words(language)))


@cache
def attempt(
    name: str, n: int | None, kind: str, view: str, language: str
) -> tuple[Layout, Page | PageError]:
    """One sheet, or why it cannot be made; made only once."""
    drawing = drawing_of(name, n, kind, language)
    layout = lay_out(drawing)
    try:
        return layout, sheet(drawing, view, f"{KINDS.index(kind) + 1}/2", layout)[0]
    except PageError as error:
        return layout, error


def kinds_of(name: str, n: int | None = None) -> tuple[str, ...]:
    """Which sheets a scene has, by its text: some ask for nothing that accelerations lead to."""
    text = "" if n is not None else OTHERS.get(name) or (FOLDER / f"{name}.toml").read_text("utf-8")
    asked = text.partition("[ask]")[2]
    led_to = ("acceleration = ", "reactions = ", "balance = ")
    return KINDS if not asked or any(each in asked for each in led_to) else KINDS[:1]


def drawing_of(name: str, n: int | None, kind: str, language: str = "en") -> Drawing:
    """The material of one sheet."""
    return next(drawing for drawing in drawings(name, n, language) if drawing.kind == kind)


@cache
def drawn(name: str, n: int | None, kind: str, view: str = "key", language: str = "en") -> Drawn:
    """One sheet. Raises PageError when it cannot be made."""
    layout, page = attempt(name, n, kind, view, language)
    if isinstance(page, PageError):
        raise page
    drawing = drawing_of(name, n, kind, language)
    return Drawn(drawing, layout, page, fields_of(drawing, page))


def both(name: str, n: int | None = None, view: str = "key", language: str = "en") -> list[Drawn]:
    """The velocity and the acceleration sheet."""
    return [drawn(name, n, kind, view, language) for kind in KINDS]


@cache
def calculations(
    name: str, n: int | None = None, view: str = "key", language: str = "en"
) -> tuple[Page, ...]:
    """The calculation pages."""
    return calculation(drawings(name, n, language), view)


def fields_of(drawing: Drawing, page: Page) -> dict[str, tuple[Mark, ...]]:
    """The marks of the mechanism's field and of the plan's; each begins with its caption."""
    heads = []
    for field in ("mechanism", drawing.kind):
        caption = drawing.words.sentences[f"page.{field}_heading"].partition("{")[0]
        caption = caption.partition("  (")[0]  # where what stands in brackets has a line of its own
        captions = (
            i
            for i, mark in enumerate(page.marks)
            if isinstance(mark, Text) and mark.markup.startswith(caption) and mark.cls == "caption"
        )
        heads.append(next(captions))
    second = heads[1]
    heads = [last_line(page.marks, head) for head in heads]
    panel = (i for i, mark in enumerate(page.marks) if i > heads[1] and mark.cls == "panel")
    return {
        "mechanism": page.marks[heads[0] + 1 : second],
        "plan": page.marks[heads[1] + 1 : next(panel)],
    }


def last_line(marks: Sequence[Mark], head: int) -> int:
    """Where a caption in several lines ends."""
    while (mark := marks[head + 1]).cls == "caption" and isinstance(mark, Text):
        head += 1
    return head


def named(param: Sequence[object]) -> str:
    """The name of a sheet in the list of tests."""
    return "-".join(str(part) for part in param if part is not None)


# --- marks ---------------------------------------------------------------------------------------


def kind_of(mark: Mark) -> str:
    """The first class of a mark."""
    return mark.cls.split()[0]


def is_vector(mark: Mark) -> bool:
    """True for the line of a vector, outside of enlarged details."""
    return isinstance(mark, LineMark) and kind_of(mark) in VECTORS and "detail" not in mark.cls


def is_label(mark: Mark) -> bool:
    """True for a label, its leader or the ring around a link's number."""
    return kind_of(mark) in ("label", "leader", "number")


def length_of(line: LineMark) -> float:
    """Length of a line in mm."""
    return hypot(line.x2 - line.x1, line.y2 - line.y1)


def half_width(mark: Mark) -> float:
    """Half the width in mm of the line that a mark is drawn with."""
    return style_of(mark.cls).width / 2


def labels_of(marks: Sequence[Mark]) -> list[Labelled]:
    """The labels among marks; before its text stands a ring, if it has one, and before that its
    leader."""
    found = []
    for i, mark in enumerate(marks):
        if isinstance(mark, Text) and kind_of(mark) == "label":
            before = [*marks[max(i - 2, 0) : i]]
            ring = before.pop() if before and kind_of(before[-1]) == "number" else None
            leads = before and kind_of(before[-1]) == "leader" and before[-1].name == mark.name
            leader = before[-1] if leads else None
            found.append(Labelled(mark, leader, ring))
    return found


def outline(mark: Mark) -> BaseGeometry:
    """The middle line of a mark's stroke, to a thousandth of a millimetre."""
    if isinstance(mark, LineMark):
        return shapely.linestrings([(mark.x1, mark.y1), (mark.x2, mark.y2)])
    if isinstance(mark, Polyline):
        closing = mark.points[:1] if mark.closed else ()
        return shapely.linestrings([*mark.points, *closing])
    if isinstance(mark, CircleMark):
        return shapely.linestrings(around(mark.cx, mark.cy, mark.r, 0, 360))
    if isinstance(mark, Arc):
        return shapely.linestrings(around(mark.cx, mark.cy, mark.r, mark.start, mark.end))
    raise TypeError(mark)


def around(x: float, y: float, r: float, start: float, end: float) -> np.ndarray:
    """Points along an arc, a degree apart."""
    turns = np.radians(np.linspace(start, end, max(2, int(abs(end - start)) + 1) + 1))
    return np.column_stack([x + r * np.cos(turns), y - r * np.sin(turns)])


def within(mark: Mark, rect: tuple[float, float, float, float], slack: float = 1e-6) -> bool:
    """True when a mark lies in a rectangle of the page."""
    left, top, right, bottom = reach(mark)
    return (
        left >= rect[0] - slack
        and top >= rect[1] - slack
        and right <= rect[2] + slack
        and bottom <= rect[3] + slack
    )


def told(mark: Mark) -> str:
    """A mark in a failed test."""
    text = f" “{mark.markup}”" if isinstance(mark, Text) else ""
    place = ", ".join(f"{value:.2f}" for value in reach(mark))
    return f"{type(mark).__name__} {mark.cls} {mark.name}{text} ({place})"


# --- what may not be -----------------------------------------------------------------------------


def collisions(marks: Sequence[Mark]) -> list[str]:
    """Labels that stand on a line or an arrowhead, on another label, or on any other text.

    A label takes up the box around its letters, a line its width as it is drawn.
    """
    inked = [mark for mark in marks if not isinstance(mark, Text) and half_width(mark)]
    inked += [mark for mark in marks if kind_of(mark) == "arrowhead"]
    edges = np.array([outline(mark) for mark in inked])
    widths = np.array([half_width(mark) for mark in inked])
    labels = labels_of(marks)
    boxes = np.array([label.ink() for label in labels], dtype=object)
    tree = shapely.STRtree(edges)
    which, what = tree.query(boxes, predicate="dwithin", distance=widths.max())
    close = shapely.distance(boxes[which], edges[what]) <= widths[what]
    faults = [
        f"{told(labels[i].text)} on {told(inked[j])}"
        for i, j in zip(which[close], what[close], strict=True)
        if inked[j] not in (labels[i].leader, labels[i].ring)
    ]
    others = [mark for mark in marks if isinstance(mark, Text)]
    areas = shapely.box(*np.array([reach(mark) for mark in others]).T)
    which, what = shapely.STRtree(areas).query(boxes, predicate="intersects")
    faults += [
        f"{told(labels[i].text)} on {told(others[j])}"
        for i, j in zip(which, what, strict=True)
        if labels[i].text is not others[j]
    ]
    return faults


def outside(marks: Sequence[Mark]) -> list[str]:
    """Marks outside of the frame, but for the frame itself and what belongs to it."""
    free = ("frame", "border", "field")
    return [told(m) for m in marks if kind_of(m) not in free and not within(m, A3.area)]


def off_fields(page: Drawn) -> list[str]:
    """Marks of a drawing outside of its field."""
    return [
        f"{field}: {told(mark)}"
        for field, marks in page.marks.items()
        for mark in marks
        if not within(mark, page.rect(field))
    ]


# --- text ----------------------------------------------------------------------------------------


def texts(pages: Sequence[Page]) -> list[Text]:
    """All texts of some pages."""
    return [mark for page in pages for mark in page.marks if isinstance(mark, Text)]


def relation_lines(pages: Sequence[Page]) -> list[tuple[str, str]]:
    """The lines of calculation pages as (number or nothing, markup), each relation on one line.

    Headings and what is not numbered stand by themselves.
    """
    found: list[tuple[str, str]] = []
    for page in pages:
        rows: dict[float, dict[str, Text]] = {}
        for mark in page.marks:
            if isinstance(mark, Text) and mark.cls == "caption":
                rows.setdefault(mark.y, {})[mark.anchor] = mark
        for row in rows.values():
            number = row["end"].markup.strip("()") if "end" in row else ""
            text = row["start"].markup
            if found and text.startswith(("= ", "(")) and not found[-1][0]:
                text = f"{found.pop()[1]} {text}"
            found.append((number, text))
    return found
