"""What a scene asks of guides and wheels that they cannot do, whatever the groups are."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from graphkin.numbers.plane import cross
from graphkin.scene.known_names import quoted
from graphkin.scene.model import FRAME, Scene, Slide, link_words
from graphkin.structure.link_axes import guide_line, metres
from graphkin.structure.turning import LEVEL
from graphkin.text.errors import Problem, Written

APART = 1e-9
"""Distance of parallel guides (m) below which they are one line."""


def impossible(scene: Scene) -> list[Problem]:
    """Every guide, wheel and driver that cannot do what is written."""
    return [
        *wheels_alone(scene),
        *double_guides(scene),
        *unknown_leans(scene),
        *unturnable(scene),
    ]


def wheels_alone(scene: Scene) -> Iterator[Problem]:
    """Wheels by themselves; what looks for them is loaded for a scene that has some."""
    if any(link.wheels for link in scene.every_link):
        from graphkin.structure.touching_wheels import lone_wheels

        yield from lone_wheels(scene)


def double_guides(scene: Scene) -> Iterator[Problem]:
    """Blocks with two guides on one link, unless both lie on one line (the second is idle)."""
    for link in scene.links.values():
        for first, second in combinations(link.slides, 2):
            if first.on == second.on and (hinders := between_guides(scene, first, second)):
                yield Problem(
                    f"links.{link.name}.slides",
                    f"two guides on {link_words(first.on)} {hinders}",
                    "one guide on one link",
                    "leave one out, or give the other a block of its own",
                )


def between_guides(scene: Scene, first: Slide, second: Slide) -> str:
    """Why a block cannot move on two guides of one link; empty where they are one line."""
    one, other = guide_line(scene, first), guide_line(scene, second)
    if abs(cross(one.along, other.along)) > LEVEL:
        return "cross, so that the block is held fast"
    shifts = [metres(scene, slide.offset) for slide in (first, second)]
    sense = 1 if (one.along.conjugate() * other.along).real > 0 else -1
    gap = cross(one.along, other.point - one.point) + sense * shifts[1] - shifts[0]
    if abs(gap) <= APART:
        return ""
    return f"are parallel, {1e3 * abs(gap):.6g} mm apart: no block is on both"


def unknown_leans(scene: Scene) -> Iterator[Problem]:
    """Further guides of a block on links whose angle against it the scene does not say."""
    for link in scene.links.values():
        for slide in link.slides[1:]:
            if slide.on in turning_with(scene, link.name, first=True):
                continue
            if slide.on == FRAME:
                expected = "the guide on the frame first, the other from the other side"
            else:
                way = f"slides = {{ on = {quoted(link.name)}, through, angle }}"
                expected = f"the guide from the other side: {way} in links.{slide.on}"
            yield Problem(
                f"links.{link.name}.slides",
                f"the angle between this block and {link_words(slide.on)} is not known, for a "
                "block's x axis lies along its first guide",
                expected,
            )


def unturnable(scene: Scene) -> Iterator[Problem]:
    """Drivers that turn a link against another to which slides hold its direction."""
    for index, driver in enumerate(scene.drivers):
        if driver.kind == "turn" and driver.against in turning_with(scene, driver.link):
            link, own = scene.link(driver.link), quoted(driver.link)
            yield Problem(
                f"drivers[{index}].turn",
                f"link {driver.link} cannot turn against {link_words(driver.against)}: slides "
                "join them",
                f"slide = {own}" if link.slides else "a link that a pin joins",
                changes=(Written(own, "slide", "turn"),) if link.slides else (),
            )


def turning_with(scene: Scene, name: str, *, first: bool = False) -> set[str]:
    """The links that a link cannot turn against: those that slides join it to, one by one.

    ``first`` leaves out all but the first guide of each block.
    """
    joined = [
        {link.name, slide.on}
        for link in scene.links.values()
        for slide in (link.slides[:1] if first else link.slides)
    ]
    found = {name}
    while more := {link for pair in joined if pair & found for link in pair} - found:
        found |= more
    return found
