"""Blocks written the wrong way: without a guide, or on the link that they are pinned to."""

from __future__ import annotations

from graphkin.scene.findings import Findings, numbered
from graphkin.scene.known_names import named, place_of, quoted
from graphkin.scene.model import FRAME, Link, Scene


def check_blocks(scene: Scene, findings: Findings) -> None:
    """Every link with one point is held by more than its pin, and no block by its guide's link."""
    for link in scene.links.values():
        if not findings.inside(place_of(link.name)):
            check_bare(scene, link, findings)
            check_locked(scene, link, findings)


def check_bare(scene: Scene, link: Link, findings: Findings) -> None:
    """A link on one pin and nothing else would spin about it unless a driver turns it."""
    if len(link.points) != 1 or link.paths or link.wheels:
        return
    point = link.points[0]
    if carries(scene, link.name) or is_driven(scene, link.name):
        return
    found = f"link {link.name} has the point {point} alone and no slides: nothing keeps it"
    findings.add(
        place_of(link.name),
        found,
        "slides = { on = …, … } for a block, or a second point for a bar",
        lent_slides(scene, link),
    )


def lent_slides(scene: Scene, link: Link) -> str:
    """A hint where another link at the same pin has the slides that seem to be this one's."""
    others = [
        other.name
        for other in scene.links.values()
        if other is not link and other.slides and link.points[0] in other.points
    ]
    return f"link {others[0]} has slides: are they link {link.name}'s?" if others else ""


def check_locked(scene: Scene, link: Link, findings: Findings) -> None:
    """A block does not slide on a link that it is pinned to: it could not move against it."""
    place = f"{place_of(link.name)}.slides"
    for index, slide in enumerate(link.slides):
        if slide.on == link.name or slide.on not in (FRAME, *scene.links):
            continue
        shared = [point for point in link.points if point in scene.link(slide.on).points]
        if shared:
            found = (
                f"link {link.name} slides on {named(slide.on)} and is pinned to it at "
                f"{shared[0]}: it cannot move against it"
            )
            where = f"{numbered(place, index, len(link.slides))}.on"
            findings.add(where, found, f"a link that does not have {shared[0]}", meant(scene, link))


def meant(scene: Scene, block: Link) -> str:
    """A hint with the one link that hangs by a single pin, and so may lack this guide."""
    shut = {slide.on for slide in block.slides}
    loose = [
        name
        for name, link in scene.links.items()
        if link is not block and name not in shut and hangs(scene, link)
    ]
    return f"did you mean on = {quoted(loose[0])}?" if len(loose) == 1 else ""


def hangs(scene: Scene, link: Link) -> bool:
    """Whether a link has one pin and no guide, no track, no wheel and no driver."""
    others = (scene.frame, *(each for each in scene.links.values() if each is not link))
    pins = [point for point in link.points if any(point in other.points for other in others)]
    free = not (link.paths or link.wheels or carries(scene, link.name))
    return free and len(pins) == 1 and not is_driven(scene, link.name)


def carries(scene: Scene, name: str) -> bool:
    """Whether a guide or a track lies on a link."""
    links = scene.links.values()
    return any(path.on == name for link in links for path in link.paths)


def is_driven(scene: Scene, name: str) -> bool:
    """Whether a driver moves a link, or another link against it."""
    return any(name in (driver.link, driver.against) for driver in scene.drivers)
