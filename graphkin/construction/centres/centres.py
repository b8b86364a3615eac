"""Instantaneous centres by the normals to velocities, acceleration poles by similar triangles,
and the inflection circle.

Relative centres of any two links are found in ``kennedy``.
"""

from __future__ import annotations

from itertools import combinations

from graphkin.construction.centres.centre_actions import (
    inflection_circle,
    inflection_meet,
    inflection_point,
    inflection_pole,
    inflection_square,
    normals_meet,
    relative_centre,
    turned_pole,
)
from graphkin.construction.centres.kennedy import relative
from graphkin.construction.core.bases import Base
from graphkin.construction.core.pen import Pen, Says, named
from graphkin.construction.core.program import Part, Plane
from graphkin.construction.core.vocabulary import (
    acceleration_pole,
    instant_centre,
    meet,
    pole_ray,
    velocity_normal,
)
from graphkin.construction.coriolis.coincident_points import omega_of
from graphkin.numbers.plane import cross
from graphkin.scene.model import FRAME

FLAT = 1e-3
"""Sine of the flattest crossing of two rays by which a hand looks for an inflection pole."""

__all__ = ["centre", "inflection", "pole", "relative"]


def centre(pen: Pen, base: Base) -> None:
    """The instantaneous centre of a link: where the normals to two velocities cross (Chasles)."""
    points = two_points(pen, base)
    if points is None:
        by_turning(pen, base)
        return
    o = pen.pole(Plane.VELOCITIES)
    places = [pen.the("position", point) for point in points]
    images = [pen.the("velocity", point) for point in points]
    name = centre_name("I", base.link)
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        by_hand = None
        if o not in images:
            with pen.hands_way():
                by_hand = pen.draw(meet, *normals(pen, points, places, images))
        found = pen.draw(
            instant_centre,
            o,
            *places,
            *images,
            name=name,
            by_hand=by_hand,
            k=base.link,
            p=points[0],
            q=points[1],
        )
    pen.want("centre", base.link, found)


def normals(pen: Pen, points: tuple[str, str], places: list[int], images: list[int]) -> list[int]:
    """The perpendiculars to the velocities of two points."""
    o = pen.pole(Plane.VELOCITIES)
    return [
        pen.draw(velocity_normal, place, o, img, p=point, s=named(pen, img))
        for point, place, img in zip(points, places, images, strict=True)
    ]


def two_points(pen: Pen, base: Base) -> tuple[str, str] | None:
    """Two constructed points of a link that turns; None for a link with one, or in translation."""
    known = known_points(pen, base)
    return (known[0], known[1]) if len(known) > 1 and pen.turns(base.link) else None


def known_points(pen: Pen, base: Base) -> list[str]:
    """The constructed points of a link, its own before those under others such as a contact.

    The normal at a contact runs through the wheel's centre, as the one there does.
    """
    points = [base.start, *([base.end] if base.end else []), *base.others]
    moving = ("position", "velocity", "acceleration")
    known = [p for p in dict.fromkeys(points) if all(pen.has(what, p) for what in moving)]
    return sorted(known, key=lambda point: "@" in point)


def by_turning(pen: Pen, base: Base) -> None:
    """The centre of a link of which one point is known, and how it turns: with its guide."""
    if not pen.has("omega", base.link) or not pen.has("velocity", base.start):
        return
    o, nought = pen.pole(Plane.VELOCITIES), pen.given("nought")
    ends = [pen.the(what, base.start) for what in ("position", "velocity")]
    says: Says = {"j": FRAME, "k": base.link, "p": base.start}
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        turning = pen.the("omega", base.link)
        name = centre_name("I", base.link)
        found = pen.draw(relative_centre, *ends, turning, o, o, nought, name=name, **says)
    pen.want("centre", base.link, found)


def pole(pen: Pen, base: Base) -> None:
    """The acceleration pole of a link: on base AB a triangle similar to o′a′b′ (Mehmke)."""
    points = two_points(pen, base)
    if points is None:
        pole_by_turning(pen, base)
        return
    o = pen.pole(Plane.ACCELERATIONS)
    places = [pen.the("position", point) for point in points]
    images = [pen.the("acceleration", point) for point in points]
    with pen.on(Part.POLE, Plane.MECHANISM):
        by_hand = None
        if o not in images:
            with pen.hands_way():
                by_hand = meet_of_rays(pen, points, places, images, o)
        says: Says = {"p": points[0], "q": points[1], "k": base.link}
        says |= {"a": named(pen, images[0]), "b": named(pen, images[1])}
        found = pen.draw(
            acceleration_pole,
            o,
            *places,
            *images,
            name=centre_name("J", base.link),
            by_hand=by_hand,
            **says,
        )
    pen.want("pole", base.link, found)


def pole_by_turning(pen: Pen, base: Base) -> None:
    """The pole of a link that turns and of which one point is known: by its ω and ε."""
    if not pen.turns(base.link) or not pen.has("acceleration", base.start):
        return
    ends = [pen.the(what, base.start) for what in ("position", "acceleration")]
    rates = omega_of(pen, base.link), omega_of(pen, base.link, "epsilon")
    says: Says = {"k": base.link, "p": base.start, "how": "turned"}
    with pen.on(Part.POLE, Plane.MECHANISM):
        name = centre_name("J", base.link)
        found = pen.draw(turned_pole, *ends, *rates, name=name, **says)
    pen.want("pole", base.link, found)


def centre_name(letter: str, link: str) -> str:
    """J3 for a numbered link, J_rod for one with a name."""
    return letter + (link if link.isdigit() else f"_{link}")


def meet_of_rays(
    pen: Pen, points: tuple[str, str], places: list[int], images: list[int], o: int
) -> int:
    """The hand's way to a pole: the plan's angles at a′ and b′ set at A and B."""
    rays = []
    for here, other in ((0, 1), (1, 0)):
        says: Says = {"p": points[here], "q": points[other]}
        says |= {"a": named(pen, images[here]), "b": named(pen, images[other])}
        ends = places[here], places[other], o, images[here], images[other]
        rays.append(pen.draw(pole_ray, *ends, **says))
    return pen.draw(meet, *rays)


def inflection(pen: Pen, base: Base) -> None:
    """The inflection pole W of a link that is asked, and the circle on I and W.

    By hand a point of the circle is laid off on each of two rays to I, and Thales gives W.
    """
    points = two_points(pen, base)
    if base.link not in pen.scene.ask.inflection or points is None:
        return
    start = [pen.the(what, base.start) for what in ("position", "velocity", "acceleration")]
    turning = pen.the("omega", base.link)
    name = centre_name("W", base.link)
    with pen.on(Part.POLE, Plane.MECHANISM):
        says: Says = {"k": base.link, "p": base.start, "i": centre_name("I", base.link)}
        rays = squarest(pen, known_points(pen, base))
        by_hand = meet_of_squares(pen, rays, says) if rays else None
        if pen.pole(Plane.VELOCITIES) == start[1]:
            says["how"] = "pin"
        rates = turning, pen.the("epsilon", base.link)
        pole = pen.draw(inflection_pole, *start, *rates, name=name, by_hand=by_hand, **says)
        name = f"inflection {base.link}"
        pen.arrow(inflection_circle, *start[:2], turning, pole, name=name, **says)
        still = pen.pole(Plane.VELOCITIES)
        opposite = pen.draw(
            relative_centre, *start[:2], turning, still, still, pen.given("nought"), **says
        )
    pen.want("inflection", base.link, pole)
    pen.want("inflection centre", base.link, opposite)


def squarest(pen: Pen, points: list[str]) -> tuple[str, str] | None:
    """The two points whose rays to the instantaneous centre cross most squarely here.

    None where no two do: a link that turns about a fixed pin has that pin for its circle.
    """
    ways = {}
    for point in points:
        velocity = pen.peek(pen.the("velocity", point))
        if velocity:
            ways[point] = velocity / abs(velocity)
    if pen.pole(Plane.VELOCITIES) in (pen.the("velocity", point) for point in points):
        return None
    pairs = [(abs(cross(ways[p], ways[q])), p, q) for p, q in combinations(ways, 2)]
    sine, *pair = max(pairs, key=lambda found: found[0], default=(0.0, "", ""))
    return (pair[0], pair[1]) if sine > FLAT else None


def meet_of_squares(pen: Pen, points: tuple[str, str], says: Says) -> int:
    """The hand's way to the inflection pole: a point of the circle on each ray, then Thales."""
    places = [pen.the("position", point) for point in points]
    images = [pen.the("velocity", point) for point in points]
    with pen.hands_way():
        rays = normals(pen, points, places, images)
        pen.arrow(normals_meet, *rays, name=says["i"], p=points[0], k=says["k"])
        squares = []
        for point, place, image, ray in zip(points, places, images, rays, strict=True):
            ends = place, ray, pen.the("acceleration", point), *places, *images
            name = f"{point}_w"
            found = pen.draw(inflection_point, *ends, name=name, **{**says, "p": point})
            squares.append(pen.draw(inflection_square, found, image, w=name, p=point))
        return pen.draw(inflection_meet, *squares)
