"""What a driver moves: a link that is there, and that can move so."""

from __future__ import annotations

from collections import Counter

from graphkin.scene.findings import Findings
from graphkin.scene.known_names import known_link, known_point, named, place_of, quoted
from graphkin.scene.model import FRAME, Driver, Link, Scene
from graphkin.scene.wheels import check_driven


def check_drivers(scene: Scene, findings: Findings) -> None:
    """Every driver moves a known link that can move so, and no motion is given twice."""
    for driver in scene.drivers:
        check_driver(scene, driver, driver.position.place.rpartition(".")[0], findings)
    check_repeated(scene, findings)


def check_driver(scene: Scene, driver: Driver, place: str, findings: Findings) -> None:
    """A driver moves a known link against another, along a guide or a track that is there."""
    link = known_link(scene, driver.link, f"{place}.{driver.kind}", findings)
    against = known_link(scene, driver.against, f"{place}.against", findings)
    if link is None or against is None:
        return
    if driver.link == driver.against:
        what = "the frame, which is at rest" if driver.link == FRAME else "itself"
        findings.add(f"{place}.{driver.kind}", f"against {what}", "a link that moves")
        return
    for point in driver.of or ():
        known_point(point, link.points, f"link {link.name}", f"{place}.of", findings)
    if driver.kind == "turn" or findings.inside(place_of(link.name)):
        return
    if driver.kind == "slide":
        check_slid(scene, driver, link, place, findings)
    else:
        check_driven(driver, link, place, findings)


def check_slid(scene: Scene, driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """A driver that slides a link has a guide to move it along."""
    guides = [slide.on for slide in link.slides]
    if driver.against in guides:
        return
    if guides:
        on, against = named(guides[0]), named(driver.against)
        findings.add(
            place,
            f"link {link.name} slides on {on}, not on {against}",
            f"against = {quoted(guides[0])}",
        )
        return
    can = [quoted(each.name) for each in scene.links.values() if each.slides]
    found = f"link {link.name} has no guide to slide along"
    expected = f"slide = {' or '.join(can[:3])}" if can else "a link with slides = { … }"
    findings.add(f"{place}.slide", found, expected)


def check_repeated(scene: Scene, findings: Findings) -> None:
    """No motion is given twice."""
    seen = Counter((driver.kind, driver.link, driver.against) for driver in scene.drivers)
    for (kind, link, against), times in seen.items():
        if times > 1:
            found = f"{kind} = {link} against {against} is given {times} times"
            findings.add("drivers", found, "one driver for one motion")
