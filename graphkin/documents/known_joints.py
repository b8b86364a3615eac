"""What of a scene another program has joints and links for."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.scene.model import FRAME, Scene, Slide
from graphkin.structure.link_axes import body, guide_line, metres
from graphkin.text.errors import Hint, Message, Problem, message

LEAST = 1e-9
"""The distance (m) under which a joint is on a guide."""


def unknown(scene: Scene, program: str, hint: Hint, *, moving_guides: bool) -> Iterator[Problem]:
    """A problem for each link with more than pins, blocks of one pin, and straight guides."""
    for link in scene.links.values():
        place = f"links.{link.name}"
        if link.has_wheels or link.cam or link.profiles:
            yield Problem(
                place,
                message("{program} has no wheels, cams or profiles", program=program),
                message("pins and guides"),
                hint,
            )
        if link.slides and (len(link.points) > 1 or len(link.slides) > 1):
            yield Problem(
                place,
                message(
                    "{program} has no block with more than one point or guide", program=program
                ),
                message("a block with one pin on one guide"),
                hint,
            )
        elif any(slide.on != FRAME for slide in link.slides) and not moving_guides:
            found = message("{program} has no guide that moves", program=program)
            yield Problem(place, found, message("a guide on the frame"), hint)
        elif any(slide.on != FRAME and len(along(scene, slide)) < 2 for slide in link.slides):
            yield Problem(
                place,
                message(
                    "{program} moves a guide only along two joints of its link", program=program
                ),
                message("a guide along two points, without offset"),
                hint,
            )


def not_cranks(scene: Scene) -> list[Message]:
    """What is wrong with the drivers where each must turn a link about a fixed pin."""
    fixed = {*scene.frame.points}
    return [
        message("{driver} turns no crank about a fixed pin", driver=f"drivers.{number}")
        for number, driver in enumerate(scene.drivers, 1)
        if driver.kind != "turn"
        or driver.against != FRAME
        or not {*scene.link(driver.link).points} & fixed
    ]


def along(scene: Scene, slide: Slide) -> tuple[str, ...]:
    """The two points of a link between which a guide runs; none where there are fewer."""
    if metres(scene, slide.offset):
        return ()
    if slide.along:
        return slide.along
    line, points = guide_line(scene, slide), body(scene, slide.on)
    on = [p for p, z in points.items() if abs(((z - line.point) / line.along).imag) < LEAST]
    return (on[0], on[-1]) if len(on) > 1 and points[on[0]] != points[on[-1]] else ()
