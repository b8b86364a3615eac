"""The rotation of wheels from the start, by the distance along a track or by another wheel."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees, pi

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import Construction
from graphkin.construction.core.naming import angle_symbol, place
from graphkin.construction.core.program import OwnStep, Step
from graphkin.construction.core.relation import Relation, as_read, bracketed, figure, put_in
from graphkin.construction.core.vocabulary import action
from graphkin.drawing.symbol_markup import escape, of_wheel, symbol
from graphkin.numbers.arithmetic import Point, Real, at, below, phase, pick
from graphkin.scene.model import FRAME, Driver, Wheel
from graphkin.scene.quantity import Quantity

SAME = 1e-6
"""Angles closer than this, in degrees, are equal."""


class RolledTurn(Construction, frozen=True, kw_only=True):
    """The ``turn``, in radians, of a ``link`` that its wheel has turned.

    ``start`` is the step of the angle at the start. ``leads`` are the steps for the rotation of the
    links that it depends on, by their names.
    """

    link: str
    start: int
    turn: OwnStep
    leads: Mapping[str, int]

    def since(self, drawing: Drawing) -> float:
        """The rotation from the start, in degrees."""
        now, start = (float(drawing.trace.values[each]) for each in (self.turn, self.start))
        return degrees(now - start)

    def lead(self, drawing: Drawing, link: str) -> float:
        """The rotation, in degrees, of a link that it depends on; zero for the frame."""
        return degrees(float(drawing.trace.values[self.leads[link]]))

    def relations(self, drawing: Drawing, stated: dict[str, float]) -> list[Relation]:
        """Its relation, after the relations for the links that it depends on.

        Links in ``stated`` have theirs already. Empty where one of those was from another start.
        """
        found: list[Relation] = []
        known = dict(stated)
        for link in self.leads:
            if link == FRAME:
                continue
            if link not in known and (kind := rolled_turn(drawing, link)):
                found += kind.relations(drawing, known)
            elif link not in known:
                known[link] = self.lead(drawing, link)
                found.append(read_turn(drawing, link, known[link]))
            before = known.get(link)
            if before is None or abs(before - self.lead(drawing, link)) > SAME:
                return []
        stated |= known | {self.link: self.since(drawing)}
        return [*found, *self.own(drawing)]

    def own(self, drawing: Drawing) -> Iterator[Relation]:
        raise NotImplementedError


class TurnOnTrack(RolledTurn, frozen=True, kw_only=True):
    """A wheel called ``sign`` that has rolled a ``way`` along a straight track on link ``on``.

    The ``radius`` is negative to the right of the track. The way is measured from the point
    ``through`` to the contact ``touching``. ``driver`` is the driver that gives the way, if any.
    """

    sign: str
    on: str
    through: str | tuple[Quantity, Quantity]
    touching: str
    way: int
    radius: int
    driver: Driver | None

    def own(self, drawing: Drawing) -> Iterator[Relation]:
        """The distance rolled, where it is measured, and the rotation in degrees from it."""
        words = drawing.words
        way, radius = (float(drawing.trace.values[each]) for each in (self.way, self.radius))
        s, r = str(of_wheel("s", self.sign)), of_wheel("r", self.sign)
        if self.driver is not None:
            s = angle_symbol(drawing.scene, self.driver)
        else:
            radius, way = (radius, way) if way >= 0 else (-radius, -way)
            ends = {"start": place(drawing, self.on, self.through), "end": symbol(self.touching)}
            read = as_read(drawing, drawing.on_paper(way), drawing.scales.kL / 1000)
            yield Relation(s, "", *read, "m", words("calculation.measured_way", **ends))
        sign, sense = ("−", -1) if radius > 0 else ("+", 1)
        turned = in_tenths(drawing, self.since(drawing))

        def worth(lead: float, along: float, across: float) -> float:
            return lead + sense * along / across * 180 / pi

        values = self.lead(drawing, self.on), way, abs(radius)
        lead, along, across = put_in(drawing, turned, worth, *values, shown_as=in_tenths)
        symbols, figures = f"{s}/{r}·180/π", f"{bracketed(along)}/{across}·180/π"
        if self.on == FRAME:
            before = sign.strip("+")
            symbols, figures = before + symbols, before + figures
        else:
            symbols = f"{turn_symbol(self.on)} {sign} {symbols}"
            figures = f"{lead} {sign} {figures}"
        yield Relation(turn_symbol(self.link), symbols, figures, turned, "°")


class TurnOnWheel(RolledTurn, frozen=True, kw_only=True):
    """A wheel that turns with another, both about points of an ``arm`` (Willis).

    ``wheels`` are this wheel and the wheel of the ``other`` link, ``signs`` their names, and
    ``radii`` the steps of their radii. The radii have opposite signs where both wheels turn in the
    same sense relative to the arm.
    """

    arm: str
    other: str
    wheels: tuple[Wheel, Wheel]
    signs: tuple[str, str]
    radii: tuple[int, int]

    def own(self, drawing: Drawing) -> Iterator[Relation]:
        """The rotation relative to the arm, by the radii or by the numbers of teeth."""
        own, other = (float(drawing.trace.values[each]) for each in self.radii)
        alike, letter, sizes = own * other < 0, "r", (abs(other), abs(own))
        teeth = [float(each.teeth.si(drawing.scene.values)) for each in self.wheels if each.teeth]
        if len(teeth) == 2:
            letter, sizes = "z", (teeth[1], teeth[0])
        carried, rolled = (self.lead(drawing, link) for link in (self.arm, self.other))
        sense = 1 if alike else -1
        turned = in_tenths(drawing, self.since(drawing))

        def worth(arm: float, track: float, large: float, small: float) -> float:
            return arm + sense * (track - arm) * large / small

        put = put_in(drawing, turned, worth, carried, rolled, *sizes, shown_as=in_tenths)
        names = [of_wheel(letter, sign) for sign in self.signs]
        fixed = self.arm == FRAME
        symbols = willis(
            "" if fixed else turn_symbol(self.arm),
            "0" if self.other == FRAME else turn_symbol(self.other),
            f"{names[1]}/{names[0]}",
            alike=alike,
        )
        figures = willis("" if fixed else put[0], put[1], f"{put[2]}/{put[3]}", alike=alike)
        yield Relation(turn_symbol(self.link), symbols, figures, turned, "°")


def in_tenths(drawing: Drawing, degrees: float) -> str:
    """An angle as sentences print it, in tenths of a degree."""
    return drawing.words.fixed(degrees, 1)


def read_turn(drawing: Drawing, link: str, angle: float) -> Relation:
    """The relation for a link's rotation in degrees, driven or measured."""
    driven = any(
        driver.kind == "turn" and (driver.link, driver.against) == (link, FRAME)
        for driver in drawing.scene.drivers
    )
    remark = drawing.words(f"calculation.turned_{'driven' if driven else 'measured'}")
    return Relation(turn_symbol(link), result=figure(drawing, angle), unit="°", remark=remark)


def turn_symbol(link: str) -> str:
    """Symbol of the angle by which a link has turned from the start."""
    return f"Δ*φ*_{{{escape(link)}}}"


def rolled_turn(drawing: Drawing, link: str) -> RolledTurn | None:
    """The rotation of a link by its wheel; None for other links, and where it is not known."""
    program = drawing.trace.program
    number = program.targets.get(("turned", link), -1)
    if number not in drawing.trace.values:
        return None
    kind = program.steps[number].of
    return kind if isinstance(kind, RolledTurn) else None


def willis(arm: str, track: str, ratio: str, *, alike: bool) -> str:
    """The rotation, or the rate, of a wheel that turns with another, in symbols or in figures.

    With an empty ``arm``, both turn about fixed pivots. ``alike`` means in the same sense relative
    to the arm.
    """
    if not arm:
        return f"{'' if alike else '−'}{bracketed(track)}·{ratio}"
    return f"{arm} {'+' if alike else '−'} ({bracketed(track)} − {bracketed(arm)})·{ratio}"


# --- links whose whole turns their pins leave open, though wheels depend on them ------------------


ROUND = 1e-9
"""Angle, in radians, by which rounding may put half a turn on its other side."""


@action("counted-near")
def counted_near(axis: Point, heading: Point, angle: Real) -> Real:
    """The angle in radians of an axis, within half a turn of a heading's ``angle``.

    An axis half a turn from the heading, up to rounding, has turned ahead and not back.
    """
    return angle + turned_ahead(axis * heading.conjugate())


def turned_ahead(way: Point) -> Real:
    """The angle of a direction; half a turn back, up to rounding, counts as half a turn ahead."""
    size = abs(way)
    quarter = phase(at(size * 0.0, size))
    since = phase(way)
    return pick(below(since, ROUND - 2 * quarter), since + 4 * quarter, since)


class CountedTurn(Construction, frozen=True, kw_only=True):
    """The ``turn`` of a ``link`` whose pins leave whole turns open, within half a turn of an angle.

    Two steps hold that angle: its ``heading`` and its ``radians``.
    """

    link: str
    heading: int
    radians: int
    turn: OwnStep


def counted_link(step: Step) -> str | None:
    """The link whose whole turns a step counts near a given angle; None for other steps."""
    return step.of.link if isinstance(step.of, CountedTurn) else None
