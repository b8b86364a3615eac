"""Instantaneous centres by the normals to velocities, acceleration poles by similar triangles."""

from __future__ import annotations

from graphkin.plans.links import Base
from graphkin.plans.pen import Pen, Says
from graphkin.plans.velocity import named
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    acceleration_pole,
    instant_centre,
    meet,
    pole_ray,
    velocity_normal,
)


def centre(pen: Pen, base: Base) -> None:
    """The instantaneous centre of a link: where the normals to two velocities cross (Chasles)."""
    if base.end is None:
        return
    o = pen.pole(Plane.VELOCITIES)
    points = (base.start, base.end)
    places = [pen.the("position", point) for point in points]
    images = [pen.the("velocity", point) for point in points]
    name = centre_name("I", base.link)
    with pen.on(Part.CENTRE, Plane.MECHANISM):
        by_hand = None
        if o not in images:
            with pen.hands_way():
                rays = [
                    pen.draw(velocity_normal, place, o, img, p=point, s=named(pen, img))
                    for point, place, img in zip(points, places, images, strict=True)
                ]
                by_hand = pen.draw(meet, *rays)
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


def pole(pen: Pen, base: Base) -> None:
    """The acceleration pole of a link: on base AB a triangle similar to o′a′b′ (Mehmke)."""
    if base.end is None:
        return
    o = pen.pole(Plane.ACCELERATIONS)
    points = (base.start, base.end)
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
