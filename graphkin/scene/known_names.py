"""Checks of the names used in a scene against the names defined in it."""

from __future__ import annotations

from collections.abc import Collection

from graphkin.scene.findings import Findings, listed, nearest
from graphkin.scene.model import FRAME, GuideOrTrack, Link, Scene, Slide, link_words
from graphkin.text.errors import Message, message

THE_MECHANISM = message("the mechanism")


def known_link(scene: Scene, name: str, place: str, findings: Findings) -> Link | None:
    """The link with a name; None, with a problem noted, when there is none."""
    if name == FRAME or name in scene.links:
        return scene.link(name)
    found = message("link {name} is not in [links]", name=name)
    findings.add(place, found, listed((FRAME, *scene.links)), nearest(name, scene.links))
    return None


def known_point(
    name: str, points: Collection[str], where: Message, place: str, findings: Findings
) -> bool:
    """Whether a point is among those of ``where``; a problem is noted when it is not."""
    if name not in points:
        expected = listed(points) or message("a point that is written")
        findings.add(
            place,
            message("{name} is no point of {where}", name=name, where=where),
            expected,
            nearest(name, points),
        )
    return name in points


def place_of(name: str) -> str:
    """The place of a link in the file."""
    return "frame" if name == FRAME else f"links.{name}"


def quoted(link: str) -> str:
    """A link's name as a scene writes it as a value: 2, but "arm"."""
    return link if link.isdigit() else f'"{link}"'


def check_guide(
    scene: Scene, link: Link, joint: GuideOrTrack, place: str, findings: Findings
) -> None:
    """Note a guide or track on its own or an unknown link, or through points which that lacks."""
    if joint.on == link.name:
        findings.add(
            f"{place}.on", message("link {name} itself", name=link.name), message("another link")
        )
        return
    on = known_link(scene, joint.on, f"{place}.on", findings)
    if on is None:
        return
    where = link_words(joint.on)
    if isinstance(joint.through, str):
        known_point(joint.through, on.points, where, f"{place}.through", findings)
    if isinstance(joint, Slide) and joint.along:
        for point in joint.along:
            if point in on.points or point not in link.points:
                known_point(point, on.points, where, f"{place}.along", findings)
            else:
                found = message(
                    "{point} is a point of link {name}, not of {where}",
                    point=point,
                    name=link.name,
                    where=where,
                )
                if joint.on == FRAME:
                    hint = message(
                        "to slide {where} along this link, write slides in {where}", where=where
                    )
                else:
                    hint = message(
                        "to slide {where} along this link, write slides in {where}, "
                        "with on = {name}",
                        where=where,
                        name=quoted(link.name),
                    )
                findings.add(f"{place}.along", found, listed(on.points), hint)


def next_name(links: Collection[str]) -> str:
    """A name for an equivalent link: the next number after the others, or a new name in letters."""
    if all(name.isdigit() for name in links):
        return str(max(map(int, links)) + 1)
    letters = ("e", *(f"e{number}" for number in range(2, len(links) + 2)))
    return next(letter for letter in letters if letter not in links)
