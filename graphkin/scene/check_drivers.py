"""What a driver moves: a link that is there, and that can move so."""

from __future__ import annotations

from collections import Counter

from graphkin.scene.findings import Findings
from graphkin.scene.known_names import known_link, known_point, named, place_of, quoted
from graphkin.scene.model import FRAME, Driver, Link, Scene


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
    if driver.kind != "turn" and not findings.inside(place_of(link.name)):
        check_led(scene, driver, link, place, findings)


def check_led(scene: Scene, driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """A driver that slides or rolls a link has a guide, or a straight track, to move it along."""
    straight = [joint.on for joint in link.rolls if joint.through is not None]
    tracks = straight if driver.kind == "roll" else [joint.on for joint in link.slides]
    if driver.against in tracks:
        return
    verb = "slides" if driver.kind == "slide" else "rolls straight"
    if tracks:
        found = f"link {link.name} {verb} on {named(tracks[0])}, not on {named(driver.against)}"
        findings.add(place, found, f"against = {quoted(tracks[0])}")
        return
    can = [quoted(each.name) for each in scene.links.values() if each.slides]
    if driver.kind == "slide":
        found = f"link {link.name} has no guide to slide along"
        expected = f"slide = {' or '.join(can[:3])}" if can else "a link with slides = { … }"
        findings.add(f"{place}.slide", found, expected)
    elif link.rolls:
        found = f"link {link.name} rolls on a wheel, which has no coordinate"
        findings.add(f"{place}.roll", found, f"turn = {quoted(link.name)}, or a straight track")
    else:
        found = f"link {link.name} has no straight track to roll on"
        findings.add(f"{place}.roll", found, "rolls = { on, through, angle } in that link")


def check_repeated(scene: Scene, findings: Findings) -> None:
    """No motion is given twice."""
    seen = Counter((driver.kind, driver.link, driver.against) for driver in scene.drivers)
    for (kind, link, against), times in seen.items():
        if times > 1:
            found = f"{kind} = {link} against {against} is given {times} times"
            findings.add("drivers", found, "one driver for one motion")
