"""A motion along a guide in a plan, given by a driver, a trial value or a rolling wheel."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from graphkin.construction.core.component import end_before
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand
from graphkin.construction.core.naming import (
    driver_index,
    driver_of_rate,
    has_no_length,
    length_drawn,
    letter_at,
    nearest_side,
    vector_of,
)
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import OwnStep
from graphkin.construction.core.quantities import EPSILON, RATES
from graphkin.construction.core.relation import Relation, answer
from graphkin.construction.core.vocabulary import action
from graphkin.construction.velocity.relative_motion import (
    AlongGuide,
    LaidOffByRate,
    falls_key,
)
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.numbers.plane import Line
from graphkin.scene.link_points import lettered, under

LETTERS = {each.target: each.letter for each in RATES} | {"v": "v", "a": "a"}
"""The letters of drivers' given rates, by the names of the rates."""
SPEEDS = {EPSILON: "ω", "a": "v"}
"""The letter of the speed of which each acceleration is the rate."""


@action("driven-slide")
def driven_slide(start: Point, line: Line, speed: Real, way: int) -> Point:
    """The end of a given speed or acceleration along a guide, from a point of a plan.

    ``way`` is +1 along the guide, -1 against it.
    """
    return start + line.along * (way * speed / abs(line.along))


class DrivenSlide(AlongGuide, LaidOffByRate, frozen=True, kw_only=True):
    """The motion of a ``point`` along a guide, laid off from ``start`` to its ``image``.

    ``speed`` is the speed or acceleration along the guide.
    """

    reasons: ClassVar[Mapping[str, str]] = {"image": "why.driven"}
    pencil: ClassVar[Mapping[str, ByHand]] = {"image": ByHand.LAID_OFF}
    lines_before: ClassVar[tuple[str, ...]] = ("start",)
    imaged: ClassVar[frozenset[str]] = frozenset({"image"})

    point: str
    speed: int
    image: OwnStep

    def tried_rate(self, role: str) -> int:
        """The speed or acceleration."""
        return self.speed

    def symbols(self) -> Mapping[str, str]:
        """The symbols of the point and of the guide, the latter named by its block."""
        return {"q": symbol(self.point), "g": escape(self.guide)}

    # --- sentences -------------------------------------------------------------------------------

    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """The ends, the guide, the drawn length and the sense, for the sentences."""
        return {
            **self.symbols(),
            "s": drawing.symbol(letter_at(drawing, end_before(drawing, self.start))),
            "name": drawing.lettered(self.image),
            "guide": self.way(drawing),
            "vector": self.vector_along(drawing, self.image) or self.relative(drawing),
            "drawn": length_drawn(drawing, self.start, self.image),
            "way": self.side(drawing),
        }

    def side(self, drawing: Drawing) -> str:
        """The side to which the motion is laid off along its guide."""
        values = drawing.trace.values
        return drawing.words(f"page.to_{nearest_side(values[self.image] - values[self.start])}")

    def relative(self, drawing: Drawing) -> str:
        """The point's motion relative to the guide, if no vector of the plan has its name."""
        return drawing.symbol(
            f"{drawing.vector.letter}_{''.join(self.slider(drawing, self.point))}"
        )

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How the motion is laid off; if it is zero, why the point is on the previous one."""
        fields = self.fields(drawing, role)
        if has_no_length(drawing, self.image):
            key, rate = self.fallen(drawing, fields["s"])
            return drawing.words(key, rate=rate, **fields)
        key = "step.driven-slide" if fields["s"] else "step.driven-slide-end"
        return drawing.words(key, **fields)

    def fallen(self, drawing: Drawing, start: str) -> tuple[str, str]:
        """The key of the sentence for a zero motion, and the rate in that sentence."""
        key, driver = falls_key(drawing, self.image, start), driver_of_rate(drawing, self.speed)
        name = drawing.trace.program.steps[self.speed].name
        if driver is None:
            return key.removesuffix("-zero"), ""
        steady = name in SPEEDS and driver.acceleration.is_zero()
        key = key.replace("-zero", "-constant") if steady else key
        letter = (SPEEDS if steady else LETTERS)[name]
        return key, f"*{letter}*_{{{driver_index(driver)}}}"

    # --- marks and relations ---------------------------------------------------------------------

    def laid_by_driver(self, drawing: Drawing, size: float) -> Relation:
        """The driver's rate along the guide, and its drawn length in each plan."""
        drawn = length_drawn(drawing, self.start, self.image)
        return Relation(
            self.vector_along(drawing, self.image) or self.relative(drawing),
            self.rate_given(drawing),
            "",
            answer(drawing, size),
            drawing.vector.caret_unit,
            drawing.words("calculation.guide_drawn", guide=self.way(drawing), drawn=drawn),
        )

    def rate_given(self, drawing: Drawing) -> str:
        """The speed or acceleration as in the data; for a trial value, with the guide's index."""
        driver = driver_of_rate(drawing, self.speed)
        index = driver_index(driver) if driver else escape(self.guide)
        return f"*{drawing.vector.letter}*_{{{index}}}"

    def slider(self, drawing: Drawing, sought: str) -> tuple[str, str]:
        """The sliding point and the point at which it slides.

        The foot of a cylinder is lettered as a point under another point, and slides at that point.
        """
        scene = drawing.scene
        for point in (
            *scene.frame.points,
            *(p for link in scene.links.values() for p in link.points),
        ):
            if any(lettered(under(point, link)) == self.point for link in scene.links):
                return self.point, point
        return super().slider(drawing, sought)

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """The given motion along the guide, then the relative motion on a guide that moves.

        For a trial value, only the relative motion.
        """
        rate = self.rate_given(drawing)
        motion = self.motion_of(drawing, self.point, rate)
        if self.image in drawing.auxiliary:
            yield motion
            return
        default = drawing.symbol(f"{drawing.vector.letter}_{self.point}")
        yield Relation(
            vector_of(drawing, self.start, self.image, default),
            rate,
            "",
            answer(drawing, abs(float(drawing.trace.values[self.speed]))),
            drawing.vector.caret_unit,
            f"∥ {self.way(drawing)}",
        )
        if drawing.trace.program.steps[self.start].name != drawing.pole:
            yield motion


def slide_image(
    pen: Pen, point: str, guide: str, steps: tuple[int, int, int], *, name: str, way: int
) -> int:
    """Draw the image of a point that slides by a given rate.

    ``steps`` are the start in the plan, the guide and the speed. ``way`` is the sense in which the
    speed is counted.
    """
    start, _, speed = steps
    image = pen.draw(driven_slide, *steps, name=name, extra=(way,))
    pen.make(DrivenSlide(point=point, guide=guide, start=start, speed=speed, image=image))
    return image
