"""The acceleration of a rolling point of contact against a wheel: along the line of centres."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from graphkin.construction.core.component import OwnSizes, Size
from graphkin.construction.core.pen import Pen, letter, second_image
from graphkin.construction.core.plan_vector import PlanVector
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.relation import Relation, answer, figure, length_of, squared
from graphkin.construction.core.too_short import laid_off
from graphkin.construction.core.vocabulary import action, join, lay_off
from graphkin.construction.rolling.rolling_normal import RollingNormal
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.numbers.arithmetic import Point, Real

if TYPE_CHECKING:
    from graphkin.construction.core.drawn_scene import Drawing


@action("rolling-on-wheel")
def rolling_on_wheel(
    centre: Point, contact: Point, track: Point, omega: Real, omega_track: Real
) -> Point:
    """The acceleration of a wheel's point of contact against that of the wheel it rolls on.

    ``track`` is the centre of the latter. It is that on a straight track, made larger or smaller in
    the ratio of the distances of that centre from the contact and from the wheel's own: the
    diameter of the inflection circle takes the place of the radius (Euler, Savary).
    """
    relative = omega - omega_track
    return (centre - contact) * ((track - contact) / (track - centre)) * (relative * relative)


class RollingOnWheel(RollingNormal, frozen=True, kw_only=True):
    """a_ν = ω²·r·R/(R ± r) of a point of contact against that of the wheel that it rolls on.

    ``r`` names the centre of the other wheel, which stands at ``hub``.
    """

    r: str
    hub: int

    def formula(self, drawing: Drawing) -> str:
        """ω²·r·R/(R ± r), by the bars between the contact and both centres."""
        over = f"{bar(self.r, self.p)}/{bar(self.r, self.q)}"
        return f"{self.rate(drawing)}^2·{bar(self.p, self.q)}·{over}"

    def point_sentence(self, drawing: Drawing, role: str) -> str:
        """How it is laid off; why it lies along the line of centres, the first time."""
        first = self is next(self.alike(drawing))
        key = "step.lay-off-rolling-on" if first else "step.lay-off-named"
        return self.told(drawing, key, formula=self.formula(drawing))

    def relation(self, drawing: Drawing) -> Relation:
        """Square of the relative turning times the radius, in the ratio of the other distances."""
        values, size = drawing.trace.values, drawing.settled(self.size(drawing))
        rate = abs(float(values[self.omega]) - float(values[self.omega_track]))
        pairs = (self.p, self.q), (self.r, self.p), (self.r, self.q)
        own, far, apart = (figure(drawing, length_of(drawing, *pair)) for pair in pairs)
        return Relation(
            self.symbol,
            self.formula(drawing),
            f"{squared(figure(drawing, rate))}·{own}·{far}/{apart}",
            answer(drawing, size),
            "m/s^2",
            laid_off(drawing, "laid_off", size, p=symbol(self.q), q=symbol(self.p)),
            over=pairs,
        )

    def sizes(self, own: OwnSizes) -> Iterator[Size]:
        """Of own values; none against a wheel that turns, for own rates have no sense."""
        if any(track.size for track in own.turnings(self.omega_track)):
            return
        radius = own.length(self.foot, self.head)
        ratio = own.length(self.hub, self.foot) / own.length(self.hub, self.head)
        for omega in own.turnings(self.omega):
            yield Size((omega, omega), omega.size**2 * radius * ratio, radius)


# --- planning it ---------------------------------------------------------------------------------


def rolled_on(
    pen: Pen, start: int, rolls: str, ends: tuple[str, str, str], rates: tuple[int, int]
) -> int:
    """The second image of a wheel's point of contact, from that of the point which it touches.

    ``ends`` are the contact, the wheel's own centre and that of the wheel it rolls on; ``rates``
    the steps of the turning of both.
    """
    foot, head, hub = (pen.the("position", end) for end in ends)
    p, q, r = map(letter, ends)
    index = letter(rolls) + (q if letter(rolls) == p else p)
    name = f"a_{index}^ν"
    with pen.on(Part.NORMAL, Plane.NUMBERS):
        vector = pen.draw(rolling_on_wheel, head, foot, hub, *rates, name=name)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        image = pen.draw(lay_off, start, vector, name=second_image(rolls))
        pen.vector(join, start, image, of=PlanVector(name, q, p, "ν"))
    pen.make(
        RollingOnWheel(
            index=index,
            p=p,
            q=q,
            r=r,
            head=head,
            foot=foot,
            hub=hub,
            omega=rates[0],
            omega_track=rates[1],
            vector=vector,
            start=start,
            image=image,
        )
    )
    return pen.want("acceleration", rolls, image)
