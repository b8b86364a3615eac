"""The image of a rigid link in a plan is a figure similar to the link (Burmester, Mehmke).

The point of a link that coincides with another link's point: its images in both plans.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, ClassVar

from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.kind import (
    ByHand,
    Canvas,
    Construction,
    FallsOnImage,
    FindsImage,
    construction,
)
from graphkin.construction.core.palette import (
    COINCIDE,
    PERPENDICULAR,
    ErrorPicks,
    KnownError,
    Move,
    place_and_image,
)
from graphkin.construction.core.pen import Pen, letter
from graphkin.construction.core.program import OwnStep, Part, Plane, Step
from graphkin.construction.core.relation import Relation, Term, VectorEquation
from graphkin.construction.core.vocabulary import action, in_proportion, meet, similar_point
from graphkin.construction.plan import Plan
from graphkin.construction.velocity.relative_motion import as_relation, known_term
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, pick
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME
from graphkin.structure.pairs import is_in_scene


@action("alike", move=Move(COINCIDE, place_and_image))
def alike(image: Point) -> Point:
    """The image of a point that moves as another point does: a block does not turn."""
    return image


class TranslatedImage(FallsOnImage, frozen=True, kw_only=True):
    """The ``image`` of a point ``q``, which coincides with the image ``start`` of ``p``."""

    reasons: ClassVar[Mapping[str, str]] = {"image": "why.alike"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"image": ByHand.KNOWN}
    imaged: ClassVar[frozenset[str]] = frozenset({"image"})

    p: str
    q: str
    start: int
    image: OwnStep

    @property
    def falls_on(self) -> int:
        """The other image."""
        return self.start

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that both images coincide."""
        name = drawing.lettered(self.image)
        return drawing.words("step.alike", name=name, p=symbol(self.p), q=symbol(self.q))

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The equation that its vector equals that of the other point."""
        whole = Term(drawing.symbol(f"{drawing.vector.letter}_{self.q}"))
        yield as_relation(VectorEquation(whole, ((known_term(drawing, self.p),),)))


def translated_image(pen: Pen, start: int, ends: tuple[str, str], name: str) -> int:
    """The image of the second of two points, at that of the first, under its name in the plan."""
    image = pen.draw(alike, start, name=name)
    pen.make(TranslatedImage(p=ends[0], q=ends[1], start=start, image=image))
    return image


class CrossedImage(FindsImage, frozen=True, kw_only=True):
    """The ``image`` of a ``point`` where its lines ``first`` and ``second`` meet.

    Without a ``point`` it only shows by hand what similarity finds.
    """

    reasons: ClassVar[Mapping[str, str]] = {"image": "why.meet"}
    lines_before: ClassVar[tuple[str, ...]] = ("first", "second")
    imaged: ClassVar[frozenset[str]] = frozenset({"image"})

    point: str
    first: int
    second: int
    image: OwnStep

    @property
    def sought(self) -> str:
        return self.point

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence that both lines meet in the image."""
        name = drawing.lettered(self.image)
        return drawing.words("step.meet", name=name)

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the image, after its lines have sentences of their own."""
        name = drawing.lettered(self.image)
        return drawing.words("step.meet-apart", name=name)


def crossed_image(pen: Pen, first: int, second: int, *, name: str = "", of: str = "") -> int:
    """The image of a point where two lines meet, under its name in the plan."""
    image = pen.draw(meet, first, second, name=name)
    pen.make(CrossedImage(point=of, first=first, second=second, image=image))
    return image


IN_LINE = 1e-9
"""Largest distance of a collinear point from its line, as a fraction of its distance along it."""


class ImageOfLink(Construction, frozen=True, kw_only=True):
    """The ``image`` of a point ``r`` of a link, from the known images of ``p`` and ``q``.

    ``first`` and ``second`` are those images. ``ratio`` gives the place of r relative to p and q.
    ``hand`` is the step that finds the same image by crossing two lines; None where only similarity
    does. ``whole`` is the index of its own vector. ``touching`` are the names of the contact images
    in p and q.
    """

    pencil: ClassVar[Mapping[str, ByHand]] = {"image": ByHand.LAID_OFF}

    p: str
    q: str
    r: str
    whole: str
    first: int
    second: int
    ratio: int
    hand: int | None
    image: OwnStep
    touching: tuple[str, ...] = ()

    def symbols(self) -> Mapping[str, str]:
        """The three points, and the bar between the first two."""
        names = {"p": symbol(self.p), "q": symbol(self.q), "r": symbol(self.r)}
        return {**names, "bar": bar(self.p, self.q)}

    def crossing(self, drawing: Drawing) -> CrossedImage | None:
        """The crossing that finds it by hand on a sheet; None where similarity finds it."""
        if self.hand not in drawing.trace.values:
            return None
        assert self.hand is not None
        kind = construction(drawing.trace.program.steps[self.hand])
        assert isinstance(kind, CrossedImage)
        return kind

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """The sides of its link drawn from each other's images: the triangle on the other side."""
        if self.hand is None:
            return
        lines = steps[self.hand].args
        for line, other in (lines, lines[::-1]):
            _, *ends = steps[line].args
            start = picks.point_or_line(steps[other].args[0])
            yield KnownError("turn.wrong.mirrored", line, PERPENDICULAR, (start, picks.bar(*ends)))

    def is_in_line(self, drawing: Drawing) -> bool:
        """Whether the point is collinear with the two points from which it follows."""
        ratio = drawing.trace.values[self.ratio]
        return bool(abs(ratio.imag) <= IN_LINE * abs(ratio))

    def figures(self, drawing: Drawing) -> dict[str, str]:
        """The name of the image, the two similar figures, and the points of the link."""
        name = drawing.lettered(self.image)
        images = drawing.lettered(self.first) + drawing.lettered(self.second)
        figure = bar(self.p, self.q) + symbol(self.r)
        drawn = {"images": images, "image": images + name, "figure": figure}
        return {"name": name, **drawn, **self.symbols()}

    # --- drawing it ------------------------------------------------------------------------------

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the image, with the sides of the figure that nothing else draws."""
        drawing = canvas.drawing.choosing
        sides = [*self.undrawn_sides(drawing)]
        if len(sides) == 3 and self.is_in_line(drawing):
            share = canvas.value(self.ratio).real
            first, second, image = map(canvas.value, (self.first, self.second, self.image))
            start = pick(share < 0, second, first)
            canvas.side(start, pick(abs(share - 0.5) > 0.5, image, second))
            sides = []
        for start, end in sides:
            canvas.side(canvas.value(start), canvas.value(end))
        canvas.image()

    def undrawn_sides(self, drawing: Drawing) -> Iterator[tuple[int, int]]:
        """The sides of the figure without an arrow along them, by the steps of their ends.

        None where the point is found by crossing two lines. For three collinear points with an
        arrow on part of the longest side, the sides between neighbours.
        """
        if self.hand in drawing.trace.values:
            return
        corners = [self.first, self.second, self.image]
        sides = [*combinations(corners, 2)]
        bare = [side for side in sides if not is_arrow_drawn(drawing, *side)]
        if bare != sides and self.is_in_line(drawing):
            share = drawing.trace.values[self.ratio].real
            along = dict(zip(corners, (0.0, 1.0, share), strict=True))
            whole = max(sides, key=lambda side: abs(along[side[1]] - along[side[0]]))
            if whole not in bare:
                return
            bare.remove(whole)
        yield from bare

    # --- its sentences ---------------------------------------------------------------------------

    def reason(self, drawing: Drawing, role: str) -> str:
        """The key of the reason: similarity, or the lines that find the image by hand."""
        return "why.similar" if self.crossing(drawing) is None else "why.meet"

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The lines that find it by hand."""
        crossing = self.crossing(drawing)
        return crossing.said_before(drawing, role) if crossing else ()

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence on the similar figures, or on the lines that meet."""
        fields = self.figures(drawing)
        if self.crossing(drawing) is not None:
            return drawing.words("step.meet", **fields)
        if not self.is_in_line(drawing):
            return drawing.words("step.similar-point", **fields)
        if not self.touching:
            return drawing.words("step.similar-in-line", **fields)
        touching = dict(zip("cd", map(symbol, self.touching), strict=True))
        return drawing.words("step.similar-touch", **touching, **fields)

    def point_apart(self, drawing: Drawing, role: str) -> str:
        """The sentence for the crossing, after its lines have sentences of their own."""
        if self.crossing(drawing) is None:
            return ""
        return drawing.words("step.meet-apart", **self.figures(drawing))

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Its vector by similarity to the link, where no lines find it."""
        if self.crossing(drawing) is None:
            vector = drawing.symbol(f"{drawing.vector.letter}_{self.whole}")
            key = "similar_in_line" if self.is_in_line(drawing) else "similar"
            fields = self.figures(drawing)
            yield Relation(drawing.words(f"calculation.{key}", vector=vector, **fields))


def is_arrow_drawn(drawing: Drawing, one: int, other: int) -> bool:
    """Whether a plan draws an arrow between two of its points, or between coinciding points."""
    values, near = drawing.trace.values, NOISE * drawing.largest
    for (tail, tip), step in drawing.joins.items():
        if drawing.number_of(step) in values and (
            {tail, tip} == {one, other}
            or is_same(values, (tail, tip), (one, other), near)
            or is_same(values, (tip, tail), (one, other), near)
        ):
            return True
    return False


def is_same(
    values: Mapping[int, Any], ends: tuple[int, int], side: tuple[int, int], near: float
) -> bool:
    """Whether two points of a plan, drawn by then, coincide with two others."""
    pairs = zip(ends, side, strict=True)
    return max(ends) <= max(side) and all(abs(values[a] - values[b]) <= near for a, b in pairs)


# --- writing its steps ---------------------------------------------------------------------------


def image_of_link(
    pen: Pen,
    images: tuple[int, int, int],
    points: tuple[str, str, str],
    *,
    name: str = "",
    whole: str = "",
    hand: int | None = None,
    touching: tuple[str, ...] = (),
) -> int:
    """The image of the third of three ``points``, with letters as in figures, under its ``name``.

    ``images`` are the steps of the first two images and of the ratio. ``whole`` is the index of its
    vector where that differs from its letter. ``hand`` is the step that crosses two lines.
    """
    first, second, ratio = images
    image = pen.draw(similar_point, *images, name=name, by_hand=hand)
    p, q, r = points
    pen.make(
        ImageOfLink(
            p=p,
            q=q,
            r=r,
            whole=whole or r,
            first=first,
            second=second,
            ratio=ratio,
            hand=hand,
            image=image,
            touching=touching,
        )
    )
    return image


def image_under(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The image in a plan of the point of a known link that coincides with a given point.

    A link that does not turn has one image for all its points. Otherwise, the plan has a figure
    similar to the link.
    """
    if link == FRAME:
        return pen.pole(plan.plane)
    if not pen.turns(link):
        return shifted(pen, link, point, plan)
    if point in pen.scene.link(link).points:
        return pen.the(plan.quantity, point)
    base, name = pen.bases[link], under(point, link)
    if not pen.has(plan.quantity, name):
        pen.want("position", name, pen.the("position", point))
        pen.want(plan.quantity, name, found_under(pen, link, point, plan))
        plan.arrows(pen, name, base.start if base.end is None else None)
    return pen.the(plan.quantity, name)


def shifted(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The image of a point of a translating link: that of its other points, with its own letter."""
    start, name = pen.bases[link].start, under(point, link)
    number = pen.the(plan.quantity, start)
    if point in pen.scene.link(link).points or not is_in_scene(point):
        return number
    if not pen.has(plan.quantity, name):
        pen.want("position", name, pen.the("position", point))
        with pen.on(pen.steps[number].part, pen.steps[number].plane):
            ends = letter(start), letter(name)
            found = translated_image(pen, number, ends, plan.named(name))
        pen.shared["fallen", found] = number
        pen.want(plan.quantity, name, found)
    return pen.the(plan.quantity, name)


def source_of(pen: Pen, number: int) -> int:
    """The image with which a translating link's image coincides, or the image itself."""
    return pen.shared.get(("fallen", number), number)


def found_under(pen: Pen, link: str, point: str, plan: Plan) -> int:
    """The step that finds the image of a link's point under another point."""
    base, name = pen.bases[link], under(point, link)
    if base.end is None:
        return found_by_turning(pen, link, name, plan)
    if base.end == name:
        return pen.the(plan.quantity, base.end)
    places = [pen.the("position", each) for each in (base.start, base.end, point)]
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        ratio = pen.draw(in_proportion, *places)
    letters = letter(base.start), letter(base.end), letter(name)
    images = pen.the(plan.quantity, base.start), pen.the(plan.quantity, base.end), ratio
    with plan.drawn(pen):
        called, whole = plan.named(name), plan.lettered(name)
        return image_of_link(pen, images, letters, name=called, whole=whole)


def found_by_turning(pen: Pen, link: str, name: str, plan: Plan) -> int:
    """The image of a point of a link of known rotation, from the image of its base."""
    base = pen.bases[link].start
    start, steady = pen.the(plan.quantity, base), plan.is_steady(pen, link)
    with plan.drawn(pen):
        return plan.turned(pen, link, base, name, start, steady=steady)
