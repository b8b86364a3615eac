"""The rate of a wheel on a fixed pin from that of another which turns it, by their radii."""

from __future__ import annotations

from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import rate_symbol
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import action
from graphkin.construction.rolling.rolling import seen_from
from graphkin.construction.rolling.touching import by_contact
from graphkin.drawing.symbol_markup import of_wheel
from graphkin.numbers.arithmetic import Real
from graphkin.structure.pairs import Contact


@action("rate-by-radii")
def rate_by_radii(rate: Real, track: Real, wheel: Real) -> Real:
    """The rate of a wheel whose rim moves as that of another about a fixed pin, too."""
    return -rate * (track / wheel)


class RateByRadii(Construction, frozen=True, kw_only=True):
    """The ``rate`` of a wheel, the ``link``, from that of ``other`` which turns it.

    ``radii`` are the steps of the other's and of its own, negative for a ring or by an open belt,
    ``signs`` what both wheels are called.
    """

    gives: ClassVar[tuple[str, ...]] = ("rate",)

    link: str
    other: str
    turning: int
    radii: tuple[int, int]
    signs: tuple[str, str]
    rate: int

    def source_of_rate(self, drawing: Drawing) -> str:
        """The other's rate by the radii, with its value."""
        values = drawing.trace.values
        track, wheel = (float(values[each]) for each in self.radii)
        sign = "" if track * wheel < 0 else "−"
        other = rate_symbol(drawing, self.turning, drawing.rate.letter)
        radii = "/".join(of_wheel("r", sign) for sign in self.signs)
        value = drawing.words.significant(float(values[self.rate]))
        return f" = {sign}{other}·{radii} = {value} {drawing.rate.caret_unit}"


@by_contact
def turned_by_radii(pen: Pen, contact: Contact, link: str, turning: int) -> int:
    """The rate of a wheel on a fixed pin; where the other's is nought whatever happens, that."""
    if pen.is_nought(turning):
        return turning
    side = seen_from(pen, contact, link)
    radii = side.track_radius, side.radius
    with pen.on(Part.RESULT, Plane.NUMBERS), pen.calls_for(None):
        rate = pen.draw(rate_by_radii, turning, *radii, name=link)
    signs = contact.sign_of(pen.scene, side.other), contact.sign_of(pen.scene, link)
    found = RateByRadii(
        link=link, other=side.other, turning=turning, radii=radii, signs=signs, rate=rate
    )
    return pen.make(found).rate
