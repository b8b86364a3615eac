"""The rate of a crank that turns on a moving link: that link's rate and the given one."""

from __future__ import annotations

from typing import ClassVar

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import GivesRate
from graphkin.construction.core.naming import driver_index, rate_symbol, sense
from graphkin.construction.core.pen import Pen
from graphkin.construction.core.relation import FINE, Relation, figure, within
from graphkin.construction.core.vocabulary import difference, sum_of
from graphkin.drawing.symbol_markup import symbol
from graphkin.scene.model import Driver


class SummedRate(GivesRate, frozen=True, kw_only=True):
    """The ``rate`` of a ``link`` from that of the one against which a driver turns it.

    Of the link against which another is turned the given rate ``own`` is taken away.
    """

    gives: ClassVar[tuple[str, ...]] = ("rate",)

    link: str
    driver: int
    other: int
    own: int
    rate: int

    def sign(self, drawing: Drawing) -> str:
        """The sign of the given rate."""
        return "+" if drawing.scene.drivers[self.driver].link == self.link else "−"

    def whole(self, drawing: Drawing) -> str:
        """Markup of the sum or the difference."""
        other = rate_symbol(drawing, self.other, drawing.rate.letter)
        index = driver_index(drawing.scene.drivers[self.driver])
        return f"{other} {self.sign(drawing)} *{drawing.rate.letter}*_{{{index}}}"

    def source_of_rate(self, drawing: Drawing) -> str:
        """The sum with its value."""
        value = drawing.words.significant(float(drawing.trace.values[self.rate]))
        return f" = {self.whole(drawing)} = {value} {drawing.rate.caret_unit}"

    def relation(self, drawing: Drawing) -> Relation:
        """The sum with its figures."""
        one, two = (float(drawing.trace.values[each]) for each in (self.other, self.own))
        sign = self.sign(drawing)
        value = one + two if sign == "+" else one - two
        return Relation(
            symbol(f"{drawing.rate.letter}_{self.link}"),
            self.whole(drawing),
            f"{figure(drawing, one, FINE)} {sign} {within(drawing, two)}",
            figure(drawing, value, FINE),
            drawing.rate.caret_unit,
            sense(drawing.words, value),
            turns=True,
        )


def summed_rate(pen: Pen, driver: Driver, link: str, other: int, own: int) -> int:
    """The rate of a driven link on top of the other's, or of that on which it is driven."""
    rate = pen.draw(sum_of if driver.link == link else difference, other, own, name=link)
    number = pen.scene.drivers.index(driver)
    found = SummedRate(link=link, driver=number, other=other, own=own, rate=rate)
    return pen.make(found).rate
