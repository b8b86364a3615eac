"""The centre of two links: a pin, a guide's at infinity, or where two lines of centres meet.

The centres of three links lie on one line (Kennedy, Aronhold). Every centre is a Ratio, start +
shift/size, since it may lie at infinity.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from graphkin.construction.centres.centre import (
    Centre,
    LineToCentre,
    Places,
    far_words,
    meet_anywhere,
    way_to,
)
from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Sentence, construction, together
from graphkin.construction.core.palette import CUTS, JOIN, Move, two
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point, Real, pick
from graphkin.numbers.plane import Line, Ratio, crossing_sine
from graphkin.scene.model import FRAME


@action("pin-centre")
def pin_centre(pin: Point) -> Ratio:
    """The centre of two links at their pin, or at the contact point of a wheel and its track."""
    return Ratio(pin, 0 * pin, 1.0)


@action("guide-centre")
def guide_centre(point: Point, guide: Line) -> Ratio:
    """The centre of a block and its guide: at infinity, perpendicular to the guide."""
    return Ratio(point, 1j * guide.along, 0.0)


@action("relative-centre")
def relative_centre(
    p: Point, image_p: Point, omega_p: Real, q: Point, image_q: Point, omega_q: Real
) -> Ratio:
    """The point of two links with one velocity on both: p + i·(v_p - v_q at p)/(ω_p - ω_q).

    p is a point of the first link, q one of the second. The error is 8·eps of the larger distance.
    """
    there = image_q + 1j * (p - q) * omega_q
    return Ratio(p, 1j * (image_p - there), omega_p - omega_q)


@action("kennedy-line", move=Move(JOIN, two))
def kennedy_line(a: Ratio, b: Ratio) -> Line:
    """The line of two centres of three links, on which the third lies (Kennedy, Aronhold).

    It is anchored at the centre nearer to its own start, never at infinity. For two centres at
    infinity the direction is zero: their line lies at infinity.
    """
    nearer = abs(a.shift) * abs(b.size) <= abs(b.shift) * abs(a.size)
    start, shift, size = (pick(nearer, x, y) for x, y in zip(a, b, strict=True))
    along = (b.start - a.start) * a.size * b.size + b.shift * a.size - a.shift * b.size
    return Line(start + shift / size, along)


@action("kennedy-meet", margin=crossing_sine, move=CUTS)
def kennedy_meet(m: Line, n: Line) -> Ratio:
    """The centre of two links, where two lines of centres meet."""
    return meet_anywhere(m, n)


@action("kennedy-endless")
def kennedy_endless(line: Line) -> Ratio:
    """The centre at infinity on a line of centres; the other line lies wholly at infinity."""
    return Ratio(line.point, line.along, 0.0)


@action("normals-meet", margin=crossing_sine)
def normals_meet(m: Line, n: Line) -> Ratio:
    """The instantaneous centre, where the normals to two velocities meet (Chasles)."""
    return meet_anywhere(m, n)


# --- the constructions ---------------------------------------------------------------------------


class LineOfCentres(LineToCentre, frozen=True, kw_only=True):
    """The line of two centres, by their letters and the steps that hold them."""

    reasons: ClassVar[Mapping[str, str]] = {"line": "why.kennedy"}
    lines: ClassVar[Mapping[str, str]] = {"line": "the line of centres"}

    letters: tuple[str, str]
    ends: tuple[int, int]

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause with both centres; a centre at infinity is named last."""
        places = [drawing.place(drawing.trace.values[end]) for end in self.ends]
        m, n = map(symbol, self.letters if places[0] is not None else self.letters[::-1])
        return drawing.words(f"step.kennedy-line{'-far' if None in places else ''}", m=m, n=n)

    def places(self, drawing: Drawing) -> Places:
        """The centres that do not lie at infinity."""
        values = drawing.trace.values
        places = zip(self.letters, (drawing.place(values[end]) for end in self.ends), strict=True)
        return {letter: place for letter, place in places if place is not None}


class PairCentre(Centre, frozen=True, kw_only=True):
    """The centre of two links, ``first`` and ``link``, in the order of the scene."""

    first: str

    def title(self, role: str) -> str:
        """The name in a report: its link, and the other link where that is not the frame."""
        against = "" if self.first == FRAME else f" against link {self.first}"
        return super().title(role) + against if role == "found" else ""

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with both links."""
        return super().fields(drawing) | {"j": escape(self.first)}


class PinCentre(PairCentre, frozen=True, kw_only=True):
    """A pin of two links."""

    key: ClassVar[str] = "pin-centre"
    reasons: ClassVar[Mapping[str, str]] = {"found": "why.pin"}

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw a ring around the pin."""
        canvas.ring(canvas.value(self.found).start)


class GuideCentre(PairCentre, frozen=True, kw_only=True):
    """The centre of a ``block`` and its guide."""

    key: ClassVar[str] = "guide-centre"

    block: str

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw a ray towards the centre at infinity."""
        value = canvas.value(self.found)
        text = far_words(canvas.drawing, self.value(canvas.drawing), self.name, self.point)
        canvas.away(value.start, way_to(value), text)

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the guide by its block."""
        return super().fields(drawing) | {"g": escape(self.block)}


class RelativeCentre(PairCentre, frozen=True, kw_only=True):
    """The centre of two links by their velocities; by hand where two lines of centres meet.

    ``touching`` links have it at their contact point. ``belted`` links have it where the strands of
    their belt meet the line of centres. ``aside``: no line is drawn from its point.
    """

    key: ClassVar[str] = "relative-centre"

    touching: bool = False
    belted: bool = False
    aside: bool = False

    def same(self, drawing: Drawing) -> int | None:
        """The step of the instantaneous centre on this sheet that coincides with this centre."""
        if FRAME not in (self.first, self.link):
            return None
        link = self.link if self.first == FRAME else self.first
        number = drawing.trace.program.targets.get(("centre", link), self.found)
        return None if number == self.found or number not in drawing.trace.values else number

    def equal(self, drawing: Drawing) -> str:
        """The letter of the coinciding instantaneous centre; empty where there is none."""
        same = self.same(drawing)
        return "" if same is None else drawing.lettered(same)

    def mark_far(self, canvas: Canvas) -> None:
        """Mark a far centre; if it has another letter already, only that the two are equal."""
        drawing, value = canvas.drawing, self.value(canvas.drawing)
        way, same = way_to(value), self.equal(drawing)
        if drawing.is_everywhere(value) or not way or not same:
            super().mark_far(canvas)
            return
        text = f"{drawing.symbol(self.name)} = {same}"
        canvas.away(value.start, way, text, ray=self.needs_ray(canvas), headed=False)

    def needs_ray(self, canvas: Canvas) -> bool:
        """Whether a ray is necessary: also where the lines do not begin at its point."""
        return self.aside or super().needs_ray(canvas)

    def sentence_key(self, drawing: Drawing) -> str:
        """The key by the way its lines meet, or by its special case."""
        if not self.is_by_hand(drawing):
            known = "belt" if self.belted else "touch" if self.touching else ""
            suffix = self.oddity(drawing) or known
            return f"{self.key}-{suffix}" if suffix else self.key
        if len(self.ways) == 1:
            return "kennedy-endless"
        if odd := self.oddity(drawing):
            return f"{self.key}-{odd}"
        if not isinstance(self.ways[0], LineOfCentres):
            return "normals-meet"
        return "kennedy-meet-again" if self.equal(drawing) else "kennedy-meet"

    def fields(self, drawing: Drawing) -> dict[str, str]:
        """The fields of a sentence, with the letter by which the centre is known already."""
        return super().fields(drawing) | {"same": self.equal(drawing)}

    def crossed(self, drawing: Drawing) -> str:
        """The centre with the two lines of centres that meet in it, as I₁₃ (I₁₂I₂₃, I₁₄I₃₄).

        Empty where two such lines do not meet, or meet at infinity.
        """
        lines = [line for line in self.ways if isinstance(line, LineOfCentres)]
        if len(lines) != 2 or not self.is_by_hand(drawing) or self.oddity(drawing):
            return ""
        pairs = ("".join(map(symbol, line.letters)) for line in lines)
        same, name = self.equal(drawing), drawing.symbol(self.name)
        called = f"{name} = {same}" if same else name
        return f"{called} ({drawing.words('list_mark').join(pairs)})"


def with_centres_together(drawing: Drawing, found: list[Sentence]) -> list[Sentence]:
    """The centres known at once in one sentence, and the centres by two lines in another.

    Of the latter, the first has a full sentence, and so has each with unusual lines.
    """
    steps, words = drawing.trace.program.steps, drawing.words
    kinds = [(said, construction(steps[said.step])) for said in found if said.step >= 0]
    at_once = [said for said, kind in kinds if isinstance(kind, PinCentre | GuideCentre)]
    crossed = [
        (said, markup)
        for said, kind in kinds
        if isinstance(kind, RelativeCentre) and (markup := kind.crossed(drawing))
    ]
    if at_once:
        guided = any(isinstance(kind, GuideCentre) for _, kind in kinds)
        listed = words("list_mark").join(said.markup for said in at_once)
        markup = words(f"step.centres-{'guided' if guided else 'pinned'}", list=listed)
        found = together(found, at_once, markup)
    if len(crossed) > 2:
        listed = words("list_mark").join(markup for _, markup in crossed[1:])
        some = [said for said, _ in crossed[1:]]
        found = together(found, some, words("step.centres-crossed", list=listed))
    return found
