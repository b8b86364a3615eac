"""Points that slide on what turns: the Coriolis component, by hand from two like triangles."""

from __future__ import annotations

from graphkin.plans.carried import image_under, omega_of, second_image_under
from graphkin.plans.links import under
from graphkin.plans.pen import PRIME, Pen, Says, letter, named
from graphkin.scene.known import all_points
from graphkin.scene.model import FRAME, Scene
from graphkin.steps.effect import Effect
from graphkin.steps.guides import (
    coriolis,
    coriolis_base,
    coriolis_by_hand,
    coriolis_ray,
    lay_back,
    lay_off_turned,
)
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    join,
    meet,
    set_velocity,
    square_at,
)
from graphkin.structure.joints import Joint, partner

CORNERS = ("ef", "gh", "mn", "rs", "xy")
"""Letters for the corners of the triangle that is like the lever's."""


def coriolis_of(pen: Pen, link: str, tail: int, tip: int, point: str, block: str) -> int:
    """Coriolis acceleration of a relative velocity (tail to tip in the plan) on a turning link.

    ``point`` is where it slides, ``block`` what slides. By hand from two similar triangles: as the
    guide turns with its pivot, so does twice the relative velocity.
    """
    key = ("coriolis", link, tail, tip)
    if key not in pen.shared:
        says: Says = {
            "k": link,
            "q": point,
            "i": letter(point) + letter(under(point, link)),
            "g": block,
        }
        with pen.calls_for(Effect.CORIOLIS):
            by_hand = coriolis_triangle(pen, link, tail, tip, point, says)
        with pen.on(Part.NORMAL, Plane.NUMBERS), pen.calls_for(Effect.CORIOLIS):
            name = f"a_{says['i']}^c"
            rate = omega_of(pen, link)
            pen.shared[key] = pen.draw(
                coriolis, rate, tail, tip, name=name, by_hand=by_hand, **says
            )
    return pen.shared[key]


def coriolis_triangle(
    pen: Pen, link: str, tail: int, tip: int, point: str, says: Says
) -> int | None:
    """The hand's way: on the guide's pivot twice the relative velocity, and the like triangle."""
    owner = pen.turner(link)
    if owner is None or pen.bases[owner].end is None:
        return None
    base = pen.bases[owner]
    assert base.end is not None
    pivot, pin = (pen.the("position", name) for name in (base.start, base.end))
    images = pen.the("velocity", base.start), pen.the("velocity", base.end)
    seconds = pen.seconds()
    small, index = letter(point).lower(), says["i"]
    says = {**says, "p": letter(base.start), "q": letter(base.end)}
    with pen.hands_way():
        with pen.on(Part.NORMAL, Plane.MECHANISM):
            end = pen.draw(
                set_velocity, pin, *images, seconds, name=f"{small}{PRIME}_c{index}", **says
            )
            first, second = (f"{corner}_{index}" for corner in corners(pen.scene))
            foot = pen.draw(coriolis_base, pivot, tail, tip, seconds, name=first, **says)
            edge = pen.draw(square_at, foot, pivot, **says, tip=first)
            lean = pen.draw(coriolis_ray, foot, pivot, pin, end, **says)
            top = pen.draw(meet, edge, lean, name=second, **says)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            return pen.draw(coriolis_by_hand, foot, top, seconds, **says)


def corners(scene: Scene) -> str:
    """The letters of a Coriolis triangle's corners: e and f, or others where points bear these."""
    points = {name[0].lower() for name in all_points(scene)}
    return next((pair for pair in CORNERS if not points & {*pair}), CORNERS[0])


def slide_coriolis(pen: Pen, pair: Joint, link: str, name: str, point: str) -> int | None:
    """The Coriolis component of a slide; None where what guides does not turn.

    Where the point of a guide's link under a pin is sought (name A@3, point A), the pin's relative
    velocity counts, else that of the point against what it slides on.
    """
    known = partner(pair, link)
    if "@" in name:
        tail, tip = pen.the("velocity", name), pen.the("velocity", point)
        return coriolis_of(pen, link, tail, tip, point, pair.links[0])
    if not pen.turns(known):
        return None
    tail, tip = image_under(pen, known, point), pen.the("velocity", point)
    return coriolis_of(pen, known, tail, tip, point, pair.links[0])


def lay_off_coriolis(
    pen: Pen, pair: Joint, link: str, name: str, point: str, vector: int | None
) -> int:
    """The end of the Coriolis component, laid off from the point under the sliding one.

    Where that is the one that is sought, it is laid off backwards from the sliding one.
    """
    if "@" in name:
        assert vector is not None
        tip = pen.the("acceleration", point)
        says = coriolis_says(pen, link, point, named(pen, tip))
        with pen.calls_for(Effect.CORIOLIS):
            corner = pen.draw(lay_back, tip, vector, **says)
        coriolis_arrow(pen, corner, tip, says)
        return corner
    start = second_image_under(pen, partner(pair, link), point)
    if vector is None:
        return start
    says = coriolis_says(pen, partner(pair, link), point, named(pen, start))
    with pen.calls_for(Effect.CORIOLIS):
        key = ("laid off", start, vector)
        corner = pen.shared.get(key) or pen.draw_shared(key, lay_off_turned, start, vector, **says)
    coriolis_arrow(pen, start, corner, says)
    return corner


def guide_corner(pen: Pen, pair: Joint, link: str, point: str) -> int:
    """Where the known part of a sliding point's acceleration ends: the point under it, Coriolis."""
    vector = slide_coriolis(pen, pair, link, point, point)
    return lay_off_coriolis(pen, pair, link, point, point, vector)


def coriolis_says(pen: Pen, link: str, point: str, start: str) -> Says:
    """The names for a Coriolis component."""
    return {"i": letter(point) + letter(under(point, link)), "k": link, "q": point, "s": start}


def coriolis_arrow(pen: Pen, tail: int, tip: int, says: Says) -> None:
    """The arrow of a Coriolis component."""
    symbol = f"a_{says['i']}^c"
    if symbol not in pen.arrows:
        pen.arrow(join, tail, tip, name=symbol, symbol=symbol, kind="c", q=says["q"], p="")


def slide_arrow(pen: Pen, tail: int, tip: int, link: str, point: str) -> None:
    """The arrow of a relative acceleration along a guide that moves."""
    if link == FRAME:
        return
    symbol = f"a_{letter(point)}{letter(under(point, link))}^r"
    if symbol not in pen.arrows:
        pen.arrow(join, tail, tip, name=symbol, symbol=symbol, kind="r", q=point, p="")
