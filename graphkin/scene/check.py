"""What the parts of a scene say of each other: every name that is used is one that is written."""

from __future__ import annotations

from collections import Counter

from graphkin.scene.check_blocks import check_blocks
from graphkin.scene.check_drivers import check_drivers
from graphkin.scene.check_far import check_far
from graphkin.scene.findings import Findings, listed, nearest, numbered
from graphkin.scene.known_names import check_guide, known_point, place_of
from graphkin.scene.link_names import check_names
from graphkin.scene.model import LEADING, Branch, Link, Scene, Side, Way
from graphkin.scene.read_profiles import check_profiles
from graphkin.scene.wheels import check_centres, check_tracks


def check_scene(scene: Scene, findings: Findings) -> None:
    """Note every name that is unknown or used for two things, and every link left alone."""
    check_namespace(scene, findings)
    check_capitals(scene, findings)
    for link in (scene.frame, *scene.links.values()):
        check_link(scene, link, findings)
    check_alone(scene, findings)
    check_blocks(scene, findings)
    check_drivers(scene, findings)
    check_branches(scene, findings)
    check_names(scene, findings)
    check_far(scene, findings)


def check_namespace(scene: Scene, findings: Findings) -> None:
    """One name, one thing: a point and a link do not share it."""
    points = scene.points
    for name in scene.links:
        if name in points:
            findings.add(f"links.{name}", f"{name} is a point too", "one name for one thing")


def check_capitals(scene: Scene, findings: Findings) -> None:
    """A point that one link alone has is not another link's point in other capitals.

    The plans write the image of B as b, so that two such names could not be told apart there.
    """
    links = (scene.frame, *scene.links.values())
    owners: dict[str, list[str]] = {}
    for link in links:
        for point in link.points:
            owners.setdefault(point, []).append(link.name)
    folded: dict[str, list[str]] = {}
    for point in owners:
        folded.setdefault(point.lower(), []).append(point)
    for alike in folded.values():
        alone = [point for point in alike if len(owners[point]) == 1]
        if len(alike) == 1 or not alone:
            continue
        point = alone[-1]
        other = next(each for each in alike if each != point)
        if owners[other] != owners[point]:
            name = owners[point][0]
            place = f"{place_of(name)}.{point}"
            found = f"no other link has {point}"
            findings.add(place, found, other, f"{other} is written with another capital")


def check_link(scene: Scene, link: Link, findings: Findings) -> None:
    """Guides, tracks, wheels and profiles of a link name points and links that are there."""
    place = place_of(link.name)
    check_centres(link, place, findings)
    for index, slide in enumerate(link.slides):
        where = numbered(f"{place}.slides", index, len(link.slides))
        check_guide(scene, link, slide, where, findings)
    check_tracks(scene, link, place, findings)
    check_guides(scene, link, findings)
    check_profiles(scene, link, findings)


def check_guides(scene: Scene, link: Link, findings: Findings) -> None:
    """No two links are guides of one another."""
    order = list(scene.links)
    for on in dict.fromkeys(slide.on for slide in link.slides):
        other = scene.links.get(on)
        if other is None or order.index(on) >= order.index(link.name):
            continue
        if link.name in [slide.on for slide in other.slides]:
            found = f"links {on} and {link.name} slide on one another, guides in a circle"
            expected = "slides in one of the two links only"
            findings.add(f"{place_of(link.name)}.slides", found, expected)


def check_alone(scene: Scene, findings: Findings) -> None:
    """Every moving link has points and touches another: by a pin, a guide, a track or a wheel."""
    links = (scene.frame, *scene.links.values())
    carriers = {path.on for link in links for path in link.paths}
    shared = Counter(point for link in links for point in link.points)
    for link in scene.links.values():
        place = f"links.{link.name}"
        if findings.inside(place):
            continue
        pinned = any(shared[point] > 1 for point in link.points)
        if not link.points:
            findings.add(place, "a link without points", "points, such as P = [0, 0] or P-Q = 30")
        elif not (pinned or link.paths or link.wheels or link.name in carriers):
            found = f"link {link.name} touches no other"
            findings.add(place, found, f"a point that another link has too, {LEADING}")


def check_branches(scene: Scene, findings: Findings) -> None:
    """A side is chosen for a point, a way or a closure for a link."""
    points = scene.points
    for name, branch in scene.branches.items():
        place = f"branches.{name}"
        if name not in points and name not in scene.links:
            known = [*points, *scene.links]
            findings.add(place, f"{name} is no point or link", listed(known), nearest(name, known))
        elif isinstance(branch, Side):
            if name not in points:
                expected = '"forward", "backward", "closure 1"'
                findings.add(
                    place, f"a side for link {name}", expected, side_hint(scene, name, branch)
                )
            for point in (branch.first, branch.second):
                known_point(point, points, "the mechanism", place, findings)
            if name in (branch.first, branch.second):
                findings.add(place, f"{name} on a side of itself", "a line of two other points")
        elif name not in scene.links:
            expected = '"left of P-Q" or "right of P-Q"'
            blocks = [link for link in scene.links.values() if link.slides and name in link.points]
            hint = "a block's branch is written under the link's name: "
            hint += " or ".join(f"{block.name} = {written(branch)}" for block in blocks)
            found = f"forward, backward or a closure for point {name}"
            outer = f"P and Q are the outer pins of the two links that {name} joins"
            findings.add(place, found, expected, hint if blocks else outer)


def side_hint(scene: Scene, name: str, side: Side) -> str:
    """Where a side belongs that is written under a link: a block takes a way, a pin a side."""
    pin = side_of_pin(scene, name, side)
    if scene.links[name].paths:
        ways = f'{name} = "forward" or "backward"'
        return f"link {name} {LEADING}: {ways}; a side is for a pin"
    return f"sides are written under the pin's name: {pin}"


def side_of_pin(scene: Scene, name: str, side: Side) -> str:
    """A side as it is written under a pin that a link shares with another."""
    shared = Counter(point for link in scene.links.values() for point in link.points)
    points = [p for p in scene.links[name].points if shared[p] > 1]
    pins = [p for p in points if p not in (side.first, side.second)]
    return f"{pins[0] if pins else 'P'} = {written(side)}"


def written(branch: Branch) -> str:
    """A branch as a scene writes it."""
    if isinstance(branch, Side):
        return f'"{"left" if branch.side > 0 else "right"} of {branch.first}-{branch.second}"'
    if isinstance(branch, Way):
        return '"forward"' if branch.way > 0 else '"backward"'
    return f'"closure {branch.number}"'
