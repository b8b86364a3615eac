"""The acceleration of a pin about a pivot by known rates: ω²·l along the bar, ε·l across it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ByHand, EndsComponent, GivenVector
from graphkin.construction.core.naming import has_no_length, letter_at, rate_symbol
from graphkin.construction.core.palette import PERPENDICULAR, ErrorPicks, KnownError
from graphkin.construction.core.pen import Pen, about, component_arrow, letter
from graphkin.construction.core.program import OwnStep, Plane, Step
from graphkin.construction.core.quantities import EPSILON, OMEGA
from graphkin.construction.core.relation import Relation
from graphkin.construction.core.vocabulary import action, difference, speed_at_rim, sum_of
from graphkin.construction.velocity.turned_velocity import (
    LaidOffAboutPivot,
    by_bar,
    falls_key,
    length_drawn,
    rate_words,
)
from graphkin.drawing.symbol_markup import symbol
from graphkin.numbers.arithmetic import Point, Real
from graphkin.scene.link_points import lettered
from graphkin.text.markup import EQUALS, NOTHING


@action("centripetal")
def centripetal(start: Point, pivot: Point, pin: Point, omega: Real) -> Point:
    """The end of the centripetal component of a bar: omega squared times the bar."""
    return start + omega * omega * (pivot - pin)


@action("driven-tangential")
def driven_tangential(start: Point, pivot: Point, pin: Point, epsilon: Real) -> Point:
    """The end of the tangential component of a bar: epsilon times the bar, turned 90°."""
    return start + 1j * (pin - pivot) * epsilon


class TurnedAcceleration(LaidOffAboutPivot, GivenVector, EndsComponent, frozen=True, kw_only=True):
    """ω²·l and ε·l laid off in the acceleration plan from the image ``start`` of a pivot.

    The centripetal component ends in ``end``. The tangential component leads from there to the
    pin's ``image``. Where the ``link`` turns at a constant rate, there is none, and ``end`` is the
    pin's image.
    """

    reasons: ClassVar[Mapping[str, str]] = {"end": "why.normal", "image": "why.driven_tangential"}
    pencil: ClassVar[Mapping[str, ByHand]] = dict.fromkeys(("end", "image"), ByHand.LAID_OFF)
    imaged: ClassVar[frozenset[str]] = frozenset({"end", "image"})

    start: int
    omega: int
    epsilon: int | None
    end: OwnStep
    image: OwnStep | None

    @property
    def is_steady(self) -> bool:
        return self.image is None

    def tried_rate(self, role: str) -> int | None:
        """The angular acceleration for the tangential component; otherwise None."""
        return self.epsilon if role == "image" else None

    def index_at(self, role: str) -> str:
        return self.index

    def errors(self, picks: ErrorPicks, steps: Sequence[Step]) -> Iterator[KnownError]:
        """A line without the normal component."""
        start, pivot, pin, *_ = steps[self.end].args
        inputs = picks.point_or_line(start), picks.bar(pivot, pin)
        yield KnownError("turn.wrong.normal_forgotten", self.end, PERPENDICULAR, inputs)

    # --- its sentences ---------------------------------------------------------------------------

    def said_before(self, drawing: Drawing, role: str) -> tuple[int, ...]:
        """The centripetal component before the tangential one."""
        if role == "image":
            return (self.end,)
        return (self.start,) if self.is_steady else ()

    def fields(self, drawing: Drawing, role: str) -> dict[str, str]:
        """Ends, bar, rate and drawn length of one of the two components."""
        steps = drawing.trace.program.steps
        names = {**self.symbols(), "s": drawing.lettered(self.start)}
        if role == "end":
            whole = self.is_steady and steps[self.start].name == drawing.pole
            rate = rate_symbol(drawing, self.omega)
            return {
                **names,
                "name": drawing.lettered(self.end),
                "vector": drawing.symbol(f"a_{self.index}" + ("" if whole else "^ν")),
                "omega": rate,
                "rate": rate,
                "drawn": length_drawn(drawing, self.start, self.end),
            }
        assert self.image is not None and self.epsilon is not None
        return {
            **names,
            "name": drawing.lettered(self.image),
            "vector": drawing.symbol(f"a_{self.index}^τ"),
            "epsilon": rate_words(drawing, self.image, self.epsilon, self.link, "ε"),
            "drawn": length_drawn(drawing, self.end, self.image),
        }

    def clause(self, drawing: Drawing, role: str) -> str:
        """The clause for the centripetal component by its value, before the tangential one."""
        if role == "image" or self.is_steady:
            return ""
        key = "none" if has_no_length(drawing, self.end) else "computed"
        fields = self.fields(drawing, role)
        if foot := drawing.symbol(letter_at(drawing, self.end)) if key == "computed" else "":
            fields["vector"] = EQUALS.join((NOTHING.join((fields["s"], foot)), fields["vector"]))
        return drawing.words(f"step.lay-off-{key}", **fields)

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """The sentence on how the component that ends in the pin's image is laid off."""
        fields = self.fields(drawing, role)
        if role == "end":
            if has_no_length(drawing, self.end):
                return drawing.words(falls_key(drawing, self.end, fields["s"]), **fields)
            key = by_bar(drawing, self.omega, fields)
            if key == "-scaled" and not self.is_of_driver(drawing, self.omega):
                fields["vector"] += f" = {fields['omega']}^2·{self.bar}"
            return drawing.words(f"step.centripetal{key}", **fields)
        assert self.image is not None
        alone = has_no_length(drawing, self.end)
        if not alone:
            fields["s"] = drawing.symbol(letter_at(drawing, self.end))
        if has_no_length(drawing, self.image):
            key = "falls" if fields["s"] else "falls-end"
        else:
            key = "driven-tangential-only" if alone or fields["s"] else "driven-tangential"
        return drawing.words(f"step.{key}", **fields)

    # --- marks and relations ---------------------------------------------------------------------

    def equations(self, drawing: Drawing, role: str) -> Iterator[Relation]:
        """Euler's theorem, and both magnitudes; a driver's crank has relations of its own."""
        if role == "end":
            driven = self.is_of_driver(drawing, self.omega)
            if not (driven and self.is_steady):
                omega = rate_symbol(drawing, self.omega, link=self.link)
                spin = ""
                if self.epsilon is not None:
                    spin = rate_symbol(drawing, self.epsilon, "ε", self.link)
                yield self.euler(drawing, omega=omega, epsilon=spin, steady=self.is_steady)
            if not driven:
                yield self.by_turning(drawing, self.omega, "ν")
            return
        assert self.epsilon is not None
        if self.image not in drawing.auxiliary and not self.is_of_driver(drawing, self.epsilon):
            yield self.by_turning(drawing, self.epsilon, "τ")

    def known_by(self, drawing: Drawing) -> str:
        """Along its bar, where a driver's rate is constant; empty otherwise."""
        if not (self.is_steady and self.is_of_driver(drawing, self.omega)):
            return ""
        inward = f"{symbol(self.q)}→{symbol(self.p)}"
        return f"{inward}, {rate_symbol(drawing, self.omega)}^2·{self.bar}"

    def rate_taken(self, drawing: Drawing, role: str) -> str:
        """The angular acceleration; empty for the centripetal component."""
        if role == "end" or self.epsilon is None:
            return ""
        return rate_symbol(drawing, self.epsilon, "ε")


# --- writing its steps ---------------------------------------------------------------------------


def turned_image(
    pen: Pen, link: str, points: tuple[str, str], start: int, *, name: str, steady: bool
) -> int:
    """The acceleration image of the second of two ``points`` of a link with known rates.

    ``start`` is the image of the first point. Both components have arrows, except a single
    component that is the whole acceleration.
    """
    pivot, pin = points
    places = pen.the("position", pivot), pen.the("position", pin)
    omega = pen.the(OMEGA, link)
    with pen.calls_for("normal components"):
        end = pen.draw(centripetal, start, *places, omega, name=name if steady else "")
    if not steady or start != pen.pole(Plane.ACCELERATIONS):
        component_arrow(pen, start, end, "ν", pin, pivot)
    epsilon, image = None, None
    if not steady:
        epsilon = pen.the(EPSILON, link)
        with pen.calls_for(
            "driver acceleration" if accelerated(pen, epsilon) else "tangential components"
        ):
            image = pen.draw(driven_tangential, end, *places, epsilon, name=name)
        component_arrow(pen, end, image, "τ", pin, pivot)
    pen.make(
        TurnedAcceleration(
            p=letter(pivot),
            q=letter(pin),
            index=about(pen, pin, pivot),
            whole=lettered(pin),
            base=lettered(pivot),
            link=link,
            start=start,
            omega=omega,
            epsilon=epsilon,
            end=end,
            image=image,
        )
    )
    return end if image is None else image


def accelerated(pen: Pen, rate: int) -> bool:
    """Whether a rate is a driver's acceleration, alone or in a sum, that is not zero."""
    step = pen.steps[rate]
    if step.given is not None:
        given = {drive.acceleration for drive in pen.drives.values()}
        return rate in given and not pen.is_zero(rate)
    passed_on = step.action in (sum_of, difference, speed_at_rim)
    return passed_on and any(accelerated(pen, arg) for arg in step.args)
