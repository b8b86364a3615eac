"""Names that a scene uses, compared with the names that it defines."""

from __future__ import annotations

from collections.abc import Collection

from graphkin.scene.findings import Findings, listed, nearest
from graphkin.scene.model import FRAME, GuideOrTrack, Link, Scene, Slide, link_words


def known_link(scene: Scene, name: str, place: str, findings: Findings) -> Link | None:
    """The link of a name; None, with a problem recorded, if there is none."""
    if name == FRAME or name in scene.links:
        return scene.link(name)
    found = f"link {name} is not in [links]"
    findings.add(place, found, listed((FRAME, *scene.links)), nearest(name, scene.links))
    return None


def known_point(
    name: str, points: Collection[str], where: str, place: str, findings: Findings
) -> bool:
    """Whether a point is among those of ``where``; a problem is recorded if it is not."""
    if name not in points:
        expected = listed(points) or "a point that is written"
        findings.add(place, f"{name} is no point of {where}", expected, nearest(name, points))
    return name in points


def place_of(name: str) -> str:
    """The place of a link in a scene."""
    return "frame" if name == FRAME else f"links.{name}"


def quoted(link: str) -> str:
    """The name of a link as written as a value in a scene: 2, but "arm"."""
    return link if link.isdigit() else f'"{link}"'


def check_guide(
    scene: Scene, link: Link, joint: GuideOrTrack, place: str, findings: Findings
) -> None:
    """Record a guide or track that is not on another link, or names points of other links."""
    if joint.on == link.name:
        findings.add(f"{place}.on", f"link {link.name} itself", "another link")
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
                found = f"{point} is a point of link {link.name}, not of {where}"
                hint = f"to slide {where} along this link, write slides in {where}"
                if joint.on != FRAME:
                    hint += f", with on = {quoted(link.name)}"
                findings.add(f"{place}.along", found, listed(on.points), hint)


def next_name(links: Collection[str]) -> str:
    """A name for an equivalent link: the next number, or a letter where names are not numbers."""
    if all(name.isdigit() for name in links):
        return str(max(map(int, links)) + 1)
    letters = ("e", *(f"e{number}" for number in range(2, len(links) + 2)))
    return next(letter for letter in letters if letter not in links)
