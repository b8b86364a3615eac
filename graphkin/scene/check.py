"""Consistency of a scene's parts: names, drivers, blocks on guides, and distant coordinates.

Names must exist, drivers must be able to move their links, and coordinates must resolve the
lengths.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from graphkin.scene.findings import Findings, listed, nearest, numbered
from graphkin.scene.known_names import (
    check_guide,
    known_link,
    known_point,
    place_of,
    quoted,
)
from graphkin.scene.link_names import check_names
from graphkin.scene.model import (
    FRAME,
    LEADING,
    At,
    Driver,
    Link,
    Scene,
    Side,
    Way,
    lengths_of,
    link_words,
)
from graphkin.scene.quantity import Quantity, shortest
from graphkin.scene.read_joints import check_profiles
from graphkin.scene.requests import ANY_LINK, WAYS_OF_LINK, sides
from graphkin.scene.wheels import check_centres, check_driven, check_tracks
from graphkin.text.errors import SceneError, Written


def check_scene(scene: Scene, findings: Findings) -> None:
    """Record every unknown or ambiguous name, and every isolated link."""
    check_namespace(scene, findings)
    check_capitals(scene, findings)
    for link in scene.every_link:
        check_link(scene, link, findings)
    check_alone(scene, findings)
    check_blocks(scene, findings)
    check_drivers(scene, findings)
    check_branches(scene, findings)
    check_names(scene, findings)
    check_far(scene, findings)


def check_namespace(scene: Scene, findings: Findings) -> None:
    """Record points and links that share a name."""
    points = scene.points
    for name in scene.links:
        if name in points:
            findings.add(f"links.{name}", f"{name} is a point too", "one name for one thing")


def check_capitals(scene: Scene, findings: Findings) -> None:
    """Record a point of a single link whose name equals another link's point but for capitals.

    The plans write the image of B as b, so that the two names could not be distinguished there.
    """
    links = scene.every_link
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
    """Record guides, tracks, wheels and profiles that name missing points or links."""
    place = place_of(link.name)
    check_centres(link, place, findings)
    for index, slide in enumerate(link.slides):
        where = numbered(f"{place}.slides", index, len(link.slides))
        check_guide(scene, link, slide, where, findings)
    check_tracks(scene, link, place, findings)
    check_guides(scene, link, findings)
    check_profiles(scene, link, findings)


def check_guides(scene: Scene, link: Link, findings: Findings) -> None:
    """Record two links that are guides of one another."""
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
    """Record moving links without points, or without a pin, guide, track or wheel contact."""
    links = scene.every_link
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
    """Record a side that is not stated for a point, or a way or closure not stated for a link.

    A way may also be stated for a pin, where a link has several guides.
    """
    points = scene.points
    for name, branch in scene.branches.items():
        place = f"branches.{name}"
        if name not in points and name not in scene.links:
            known = [*points, *scene.links]
            free = (each for each in known if each not in scene.branches)
            findings.add(place, f"{name} is no point or link", listed(known), nearest(name, free))
        elif isinstance(branch, Side):
            if name not in points:
                hint = ways_hint(scene, name, branch)
                findings.add(place, f"a side for link {name}", WAYS_OF_LINK, hint, ANY_LINK)
            for point in (branch.first, branch.second):
                known_point(point, points, "the mechanism", place, findings)
            if name in (branch.first, branch.second):
                findings.add(place, f"{name} on a side of itself", "a line of two other points")
        elif isinstance(branch, Way) and is_of_several_ways(scene, name):
            continue
        elif name not in scene.links:
            found = f"forward, backward or a closure for point {name}"
            findings.add(place, found, *sides(name, scene.links, branch))


def is_of_several_ways(scene: Scene, point: str) -> bool:
    """Whether a point belongs to a link with several guides or tracks, or to one of these."""
    several = [link for link in scene.links.values() if len(link.paths) > 1]
    near = {name for link in several for name in (link.name, *(path.on for path in link.paths))}
    return any(point in scene.link(name).points for name in near if name != FRAME)


def ways_hint(scene: Scene, name: str, side: Side) -> str:
    """A hint for a side stated under a link: a block takes a way, a pin takes a side."""
    pin = side_of_pin(scene, name, side)
    if scene.links[name].paths:
        ways = f'{name} = "forward" or "backward"'
        return f"link {name} {LEADING}: {ways}; a side is for a pin"
    return f"sides are written under the pin's name: {pin}"


def side_of_pin(scene: Scene, name: str, side: Side) -> str:
    """A side as written under a pin that a link shares with another."""
    shared = Counter(point for link in scene.links.values() for point in link.points)
    points = [p for p in scene.links[name].points if shared[p] > 1]
    pins = [p for p in points if p not in (side.first, side.second)]
    return f'{pins[0] if pins else "P"} = "{side}"'


def check_blocks(scene: Scene, findings: Findings) -> None:
    """Record links held only by one pin, and blocks that cannot slide on their guide."""
    for link in scene.links.values():
        if not findings.inside(place_of(link.name)):
            check_bare(scene, link, findings)
            check_locked(scene, link, findings)


def check_bare(scene: Scene, link: Link, findings: Findings) -> None:
    """Record a link on one pin and nothing else, which could spin unless a driver turns it."""
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
    """A hint where another link at the same pin has slides that seem to be this link's."""
    others = [
        other.name
        for other in scene.links.values()
        if other is not link and other.slides and link.points[0] in other.points
    ]
    return f"link {others[0]} has slides: are they link {link.name}'s?" if others else ""


def check_locked(scene: Scene, link: Link, findings: Findings) -> None:
    """Record a block that slides on a link to which it is pinned, so that it cannot move."""
    place = f"{place_of(link.name)}.slides"
    for index, slide in enumerate(link.slides):
        if slide.on == link.name or slide.on not in (FRAME, *scene.links):
            continue
        shared = [point for point in link.points if point in scene.link(slide.on).points]
        if shared:
            found = (
                f"link {link.name} slides on {link_words(slide.on)} and is pinned to it at "
                f"{shared[0]}: it cannot move against it"
            )
            where = f"{numbered(place, index, len(link.slides))}.on"
            expected, on = f"a link that does not have {shared[0]}", meant(scene, link)
            hint = f"did you mean on = {on}?" if on else ""
            findings.add(where, found, expected, hint, (Written(on),) if on else ())


def meant(scene: Scene, block: Link) -> str:
    """The one link on a single pin, which may lack this guide, as a text writes it."""
    shut = {slide.on for slide in block.slides}
    loose = [
        name
        for name, link in scene.links.items()
        if link is not block and name not in shut and hangs(scene, link)
    ]
    return quoted(loose[0]) if len(loose) == 1 else ""


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


def check_drivers(scene: Scene, findings: Findings) -> None:
    """Record drivers that cannot move their link, and motions that are given twice."""
    for driver in scene.drivers:
        check_driver(scene, driver, driver.position.place.rpartition(".")[0], findings)
    check_repeated(scene, findings)


def check_driver(scene: Scene, driver: Driver, place: str, findings: Findings) -> None:
    """Record a driver whose link, reference, guide or track is missing."""
    link = known_link(scene, driver.link, f"{place}.{driver.kind}", findings)
    against = known_link(scene, driver.against, f"{place}.against", findings)
    if link is None or against is None:
        return
    if driver.link == driver.against:
        what = "the frame, which is at rest" if driver.link == FRAME else "itself"
        ends = other_ends(scene, link) if driver.kind == "slide" else []
        expected = " or ".join(f"{end.key} = {end.value}" for end in ends) or "a link that moves"
        findings.add(f"{place}.{driver.kind}", f"against {what}", expected, changes=tuple(ends))
        return
    for point in driver.of or ():
        known_point(point, link.points, f"link {link.name}", f"{place}.of", findings)
    if driver.kind == "turn" or findings.inside(place_of(link.name)):
        return
    if driver.kind == "slide":
        check_slid(scene, driver, link, place, findings)
    else:
        check_driven(driver, link, place, findings)


def other_ends(scene: Scene, link: Link) -> list[Written]:
    """The choices for a driver along a link's guide: blocks on it, or its own guides."""
    pairs = [(each.name, slide.on) for each in scene.links.values() for slide in each.slides]
    blocks = [("slide", block) for block, on in pairs if on == link.name]
    guides = [("against", on) for block, on in pairs if block == link.name]
    return [Written(quoted(name), key) for key, name in (blocks + guides)[:3]]


def check_slid(scene: Scene, driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """Record a driver that slides a link without a guide."""
    guides = [slide.on for slide in link.slides]
    if driver.against in guides:
        return
    if guides:
        on, against = link_words(guides[0]), link_words(driver.against)
        findings.add(
            place,
            f"link {link.name} slides on {on}, not on {against}",
            f"against = {quoted(guides[0])}",
        )
        return
    can = [quoted(each.name) for each in scene.links.values() if each.slides]
    found = f"link {link.name} has no guide to slide along"
    expected = f"slide = {' or '.join(can[:3])}" if can else "a link with slides = { … }"
    findings.add(f"{place}.slide", found, expected, changes=tuple(map(Written, can[:3])))


def check_repeated(scene: Scene, findings: Findings) -> None:
    """Record motions that are given twice."""
    seen = Counter((driver.kind, driver.link, driver.against) for driver in scene.drivers)
    for (kind, link, against), times in seen.items():
        if times > 1:
            found = f"{kind} = {link} against {against} is given {times} times"
            findings.add("drivers", found, "one driver for one motion")


FARTHEST = 1e9
"""Distance, in lengths of the shortest bar, beyond which 16 digits resolve it too coarsely."""
BESIDE = 1e3
"""Distance, in lengths of the whole mechanism, beyond which it is far from the origin."""


def check_far(scene: Scene, findings: Findings) -> None:
    """Record a frame so far from the origin that its bars have less than seven digits."""
    if findings.problems:
        return
    try:
        bars = [abs(metres(scene, length)) for length in bar_lengths(scene)]
        places = [(metres(scene, x), metres(scene, y)) for x, y in fixed_places(scene)]
    except SceneError:
        return
    bars = [bar for bar in bars if bar]
    if not bars or not places:
        return
    far = min(max(abs(x), abs(y)) for x, y in places)
    if far > FARTHEST * min(bars) and far > BESIDE * sum(bars):
        findings.add(
            "frame",
            f"it lies {metres_written(far)} m from the origin, and the shortest length is "
            f"{metres_written(min(bars))} m: coordinates of 16 digits are too coarse for that",
            f"at most {metres_written(FARTHEST * min(bars))} m",
            "put the origin near the mechanism",
        )


def bar_lengths(scene: Scene) -> Iterator[Quantity]:
    """Every length of a bar that the scene states."""
    for link in scene.every_link:
        for placing in link.placings:
            yield from (length for _, _, length in lengths_of(placing))


def fixed_places(scene: Scene) -> Iterator[tuple[Quantity, Quantity]]:
    """The coordinates of the frame's points and of guides and tracks through coordinates."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            yield placing.x, placing.y
    for link in scene.links.values():
        for joint in link.paths:
            if joint.on == FRAME and isinstance(joint.through, tuple):
                yield joint.through


def metres(scene: Scene, length: Quantity) -> float:
    """A length in metres."""
    return float(length.si(scene.values))


def metres_written(length: float) -> str:
    """A length in few digits."""
    return shortest(float(f"{length:.3g}"))
