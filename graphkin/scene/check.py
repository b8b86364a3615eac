"""What the parts of a scene say of each other: every name that is used is one that is written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection

from graphkin.scene.findings import Findings, listed, nearest, numbered
from graphkin.scene.model import FRAME, Branch, Driver, Link, Rolling, Scene, Side, Slide, Way


def check_scene(scene: Scene, findings: Findings) -> None:
    """Note every name that is unknown or used for two things, and every link left alone."""
    check_namespace(scene, findings)
    check_capitals(scene, findings)
    for link in (scene.frame, *scene.links.values()):
        check_link(scene, link, findings)
    check_alone(scene, findings)
    for driver in scene.drivers:
        check_driver(scene, driver, driver.position.place.rpartition(".")[0], findings)
    check_repeated(scene, findings)
    check_branches(scene, findings)
    check_ask(scene, findings)


def all_points(scene: Scene) -> dict[str, None]:
    """Every point of every link, once, in the order written."""
    every = (scene.frame, *scene.links.values())
    return dict.fromkeys(point for link in every for point in link.points)


def known_link(scene: Scene, name: str, place: str, findings: Findings) -> Link | None:
    """The link of a name; None, with a problem noted, when there is none."""
    if name == FRAME or name in scene.links:
        return scene.link(name)
    found = f"link {name} is not in [links]"
    findings.add(place, found, listed((FRAME, *scene.links)), nearest(name, scene.links))
    return None


def known_point(
    name: str, points: Collection[str], where: str, place: str, findings: Findings
) -> bool:
    """Whether a point is among those of ``where``; a problem is noted when it is not."""
    if name not in points:
        expected = listed(points) or "a point that is written"
        findings.add(place, f"{name} is no point of {where}", expected, nearest(name, points))
    return name in points


def check_namespace(scene: Scene, findings: Findings) -> None:
    """One name, one thing: a point and a link do not share it."""
    points = all_points(scene)
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


def place_of(name: str) -> str:
    """Where a link is written."""
    return "frame" if name == FRAME else f"links.{name}"


def check_link(scene: Scene, link: Link, findings: Findings) -> None:
    """Guides, tracks and wheels of a link name points and links that are there."""
    place = place_of(link.name)
    for index, wheel in enumerate(link.wheels):
        where = numbered(f"{place}.wheel", index, len(link.wheels))
        if wheel.centre:
            known_point(wheel.centre, link.points, "this link", f"{where}.centre", findings)
    for index, slide in enumerate(link.slides):
        where = numbered(f"{place}.slides", index, len(link.slides))
        check_guide(scene, link, slide, where, findings)
    for index, rolling in enumerate(link.rolls):
        where = numbered(f"{place}.rolls", index, len(link.rolls))
        check_rolling(scene, link, rolling, where, findings)
    check_guides(scene, link, findings)


def check_guides(scene: Scene, link: Link, findings: Findings) -> None:
    """No two guides of a block lie on one link, and no two links are guides of one another."""
    place = f"{place_of(link.name)}.slides"
    ways = Counter(slide.on for slide in link.slides)
    for on, times in ways.items():
        if times > 1:
            found = (
                f"{times} guides on {named(on)}: parallel ones hold the block twice, others fast"
            )
            findings.add(place, found, "one guide on one link", "leave one out")
        other = scene.links.get(on)
        earlier = other is not None and list(scene.links).index(on) < list(scene.links).index(
            link.name
        )
        if other is not None and earlier and link.name in [slide.on for slide in other.slides]:
            found = f"links {on} and {link.name} slide on one another, guides in a circle"
            findings.add(place, found, "slides in one of the two links only")


def check_alone(scene: Scene, findings: Findings) -> None:
    """Every moving link has points and touches another: by a pin, a guide, a track or a wheel."""
    links = (scene.frame, *scene.links.values())
    tracks = {rolling.on for link in links for rolling in link.rolls}
    carriers = tracks | {slide.on for link in links for slide in link.slides}
    shared = Counter(point for link in links for point in link.points)
    for link in scene.links.values():
        place = f"links.{link.name}"
        if findings.inside(place):
            continue
        pinned = any(shared[point] > 1 for point in link.points)
        if not link.points:
            findings.add(place, "a link without points", "points, such as P = [0, 0] or P-Q = 30")
        elif not (pinned or link.slides or link.rolls or link.wheels or link.name in carriers):
            found = f"link {link.name} touches no other"
            findings.add(place, found, "a point that another link has too, slides or rolls")
    for link in links:
        place = place_of(link.name)
        if link.wheels and not link.rolls and link.name not in tracks:
            found = "a wheel without a track: it rolls on nothing, and nothing rolls on it"
            expected = f"rolls = {{ on = LINK, … }} here, or rolls = {{ on = {link.name} }} there"
            findings.add(f"{place}.wheel", found, expected)


def check_guide(
    scene: Scene, link: Link, joint: Slide | Rolling, place: str, findings: Findings
) -> None:
    """A guide or a track is on another link, and the points it names are that link's."""
    if joint.on == link.name:
        findings.add(f"{place}.on", f"link {link.name} itself", "another link")
        return
    on = known_link(scene, joint.on, f"{place}.on", findings)
    if on is None:
        return
    where = "the frame" if joint.on == FRAME else f"link {joint.on}"
    if isinstance(joint.through, str):
        known_point(joint.through, on.points, where, f"{place}.through", findings)
    if isinstance(joint, Slide) and joint.along:
        for point in joint.along:
            known_point(point, on.points, where, f"{place}.along", findings)


def check_rolling(
    scene: Scene, link: Link, rolling: Rolling, place: str, findings: Findings
) -> None:
    """A wheel rolls on a line, or on a wheel of another link; its start names known links."""
    check_guide(scene, link, rolling, place, findings)
    if not link.wheels:
        expected = 'wheel = { centre = "P", radius = … }'
        findings.add(place, f"link {link.name} has no wheel", expected)
    on = scene.links.get(rolling.on, scene.frame if rolling.on == FRAME else None)
    if rolling.through is None and on is not None and not on.wheels and on is not link:
        expected = "a wheel there, or through and angle for a straight track"
        findings.add(place, f"link {rolling.on} has no wheel to roll on", expected)
    for name in rolling.start:
        known_link(scene, name, f"{place}.start.{name}", findings)


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
    if findings.inside(place_of(link.name)):
        return
    if driver.kind != "turn":
        check_led(scene, driver, link, place, findings)
    elif driver.against in turning_with(scene, driver.link):
        found = f"link {link.name} cannot turn against {named(driver.against)}: slides join them"
        expected = f"slide = {link.name}" if link.slides else "a link that a pin joins"
        findings.add(f"{place}.turn", found, expected)


def turning_with(scene: Scene, name: str) -> set[str]:
    """The links that a link cannot turn against: those that slides join it to, one by one."""
    found, grown = {name}, True
    while grown:
        joined = [{link.name, slide.on} for link in scene.links.values() for slide in link.slides]
        more = set().union(*(pair for pair in joined if pair & found)) - found
        found |= more
        grown = bool(more)
    return found


def check_led(scene: Scene, driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """A driver that slides or rolls a link has a guide, or a straight track, to move it along."""
    straight = [joint.on for joint in link.rolls if joint.through is not None]
    tracks = straight if driver.kind == "roll" else [joint.on for joint in link.slides]
    if driver.against in tracks:
        return
    verb = "slides" if driver.kind == "slide" else "rolls straight"
    if tracks:
        found = f"link {link.name} {verb} on {named(tracks[0])}, not on {named(driver.against)}"
        findings.add(place, found, f"against = {tracks[0]}")
        return
    can = [each.name for each in scene.links.values() if each.slides]
    if driver.kind == "slide":
        found = f"link {link.name} has no guide to slide along"
        expected = f"slide = {' or '.join(can[:3])}" if can else "a link with slides = { … }"
        findings.add(f"{place}.slide", found, expected)
    elif link.rolls:
        found = f"link {link.name} rolls on a wheel, which has no coordinate"
        findings.add(f"{place}.roll", found, f"turn = {link.name}, or a straight track")
    else:
        found = f"link {link.name} has no straight track to roll on"
        findings.add(f"{place}.roll", found, "rolls = { on, through, angle } in that link")


def named(link: str) -> str:
    """A link in words."""
    return "the frame" if link == FRAME else f"link {link}"


def check_repeated(scene: Scene, findings: Findings) -> None:
    """No motion is given twice."""
    seen = Counter((driver.kind, driver.link, driver.against) for driver in scene.drivers)
    for (kind, link, against), times in seen.items():
        if times > 1:
            found = f"{kind} = {link} against {against} is given {times} times"
            findings.add("drivers", found, "one driver for one motion")


def check_branches(scene: Scene, findings: Findings) -> None:
    """A side is chosen for a point, a way or a closure for a link."""
    points = all_points(scene)
    for name, branch in scene.branches.items():
        place = f"branches.{name}"
        if name not in points and name not in scene.links:
            known = [*points, *scene.links]
            findings.add(place, f"{name} is no point or link", listed(known), nearest(name, known))
        elif isinstance(branch, Side):
            if name not in points:
                expected = '"forward", "backward", "closure 1"'
                hint = f"sides are written under the pin's name: {side_of_pin(scene, name, branch)}"
                findings.add(place, f"a side for link {name}", expected, hint)
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
            findings.add(place, found, expected, hint if blocks else "")


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


def check_ask(scene: Scene, findings: Findings) -> None:
    """Only known points and links are asked for, and slides only of links that slide."""
    points = all_points(scene)
    for key in ("velocity", "acceleration"):
        for index, asked in enumerate(getattr(scene.ask, key)):
            place = f"ask.{key}[{index}]"
            point, _, link = asked.partition("@")
            known_point(point, points, "the mechanism", place, findings)
            if link:
                known_link(scene, link, place, findings)
    for index, name in enumerate(scene.ask.curves):
        known_point(name, points, "the mechanism", f"ask.curves[{index}]", findings)
    for pair in scene.ask.pairs:
        for name in pair.split("-"):
            known_link(scene, name, "ask.centres", findings)
    for key in ("omega", "epsilon", "poles", "centres", "centrodes", "slides", "inflection"):
        for index, name in enumerate(getattr(scene.ask, key)):
            place = f"ask.{key}[{index}]"
            link_asked = known_link(scene, name, place, findings)
            if key == "slides" and link_asked is not None and not link_asked.slides:
                findings.add(place, f"link {name} does not slide", "a link with slides")
