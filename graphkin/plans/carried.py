"""The point of a link under another link's point: its images in both plans, and Coriolis."""

from __future__ import annotations

from graphkin.plans.links import under
from graphkin.plans.pen import PRIME, Pen, Says, image, letter, second_image
from graphkin.scene.model import FRAME
from graphkin.steps.guides import (
    coriolis,
    coriolis_base,
    coriolis_by_hand,
    coriolis_ray,
)
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    centripetal,
    driven_tangential,
    epsilon,
    in_proportion,
    meet,
    omega,
    set_velocity,
    similar_point,
    square_at,
    turned_velocity,
)

RATES = {"omega": ("velocity", omega), "epsilon": ("acceleration", epsilon)}


def omega_of(pen: Pen, link: str, quantity: str = "omega") -> int:
    """Angular velocity (or acceleration) of a link: from its base, or as the link it is led by."""
    if link == FRAME:
        return pen.given("nought")
    if not pen.has(quantity, link):
        pen.want(quantity, link, rate_of(pen, link, quantity))
    return pen.the(quantity, link)


def rate_of(pen: Pen, link: str, quantity: str) -> int:
    """The step that finds an angular velocity or acceleration that is not known yet."""
    if not pen.turns(link):
        return pen.given("nought")
    base = pen.bases[link]
    if base.end is None:
        return omega_of(pen, pen.leads[link], quantity)
    plan, action = RATES[quantity]
    points = (base.start, base.end)
    ends = [pen.the(what, point) for what in ("position", plan) for point in points]
    with pen.on(Part.RESULT, Plane.NUMBERS):
        p, q = map(letter, points)
        return pen.draw(action, *ends, name=link, p=p, q=q)


def image_under(pen: Pen, link: str, point: str) -> int:
    """The image of the point of a known link that lies under a point: its velocity there."""
    return carried(pen, link, point, "velocity")


def second_image_under(pen: Pen, link: str, point: str) -> int:
    """The second image of the point of a known link under a point: its acceleration there."""
    return carried(pen, link, point, "acceleration")


def carried(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of the point of a link under another, in either plan.

    What does not turn has one image for all its points; else the link's figure is similar to it.
    """
    plane = Plane.VELOCITIES if quantity == "velocity" else Plane.ACCELERATIONS
    if link == FRAME:
        return pen.pole(plane)
    if not pen.turns(link):
        return pen.the(quantity, pen.bases[link].start)
    if point in pen.scene.link(link).points:
        return pen.the(quantity, point)
    name = under(point, link)
    if not pen.has(quantity, name):
        pen.want("position", name, pen.the("position", point))
        pen.want(quantity, name, found_under(pen, link, point, quantity))
    return pen.the(quantity, name)


def found_under(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The step that finds the image of a point of a link under another."""
    base, name = pen.bases[link], under(point, link)
    start = pen.the(quantity, base.start)
    places = [pen.the("position", base.start), pen.the("position", point)]
    if base.end is None:
        return found_by_turning(pen, link, point, quantity)
    if base.end == name:
        return pen.the(quantity, base.end)
    ends = start, pen.the(quantity, base.end)
    with pen.on(Part.SHAPE, Plane.NUMBERS):
        ratio = pen.draw(in_proportion, places[0], pen.the("position", base.end), places[1])
    says: Says = {"p": letter(base.start), "q": letter(base.end), "r": letter(name)}
    is_velocity = quantity == "velocity"
    part = Part.VELOCITY if is_velocity else Part.ACCELERATION
    plane = Plane.VELOCITIES if is_velocity else Plane.ACCELERATIONS
    with pen.on(part, plane):
        called = image(name) if is_velocity else second_image(name)
        return pen.draw(similar_point, *ends, ratio, name=called, **says)


def found_by_turning(pen: Pen, link: str, point: str, quantity: str) -> int:
    """The image of a point of a link whose turning is known, from that of its base."""
    base, name = pen.bases[link], under(point, link)
    start = pen.the(quantity, base.start)
    ends = pen.the("position", base.start), pen.the("position", point)
    says: Says = {"p": base.start, "q": letter(name), "s": pen.steps[start].name, "k": link}
    turning = omega_of(pen, link)
    if quantity == "velocity":
        with pen.on(Part.VELOCITY, Plane.VELOCITIES):
            return pen.draw(turned_velocity, start, *ends, turning, name=image(name), **says)
    rate = omega_of(pen, link, "epsilon")
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        corner = pen.draw(centripetal, start, *ends, turning, **says)
        return pen.draw(driven_tangential, corner, *ends, rate, name=second_image(name), **says)


# --- Coriolis ------------------------------------------------------------------------------------


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
        by_hand = coriolis_triangle(pen, link, tail, tip, point, says)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
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
            foot = pen.draw(coriolis_base, pivot, tail, tip, seconds, name=f"e_{index}", **says)
            edge = pen.draw(square_at, foot, pivot, **says, tip=f"e_{index}")
            lean = pen.draw(coriolis_ray, foot, pivot, pin, end, **says)
            top = pen.draw(meet, edge, lean, name=f"f_{index}", **says)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            return pen.draw(coriolis_by_hand, foot, top, seconds, **says)
