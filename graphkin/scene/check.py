"""Checks between the parts of a scene.

They cover names, drivers that can move their link, blocks on guides, and coordinates that are
precise enough for the lengths.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from graphkin.scene.findings import Findings, listed, nearest, numbered
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
from graphkin.scene.phrases import (
    THE_MECHANISM,
    check_guide,
    check_names,
    known_link,
    known_point,
    place_of,
    quoted,
)
from graphkin.scene.quantity import Quantity, shortest
from graphkin.scene.read_joints import check_profiles
from graphkin.scene.requests import ANY_LINK, WAYS_OF_LINK, sides
from graphkin.scene.wheels import check_centres, check_driven, check_tracks
from graphkin.text.errors import NO_WORDS, Message, SceneError, Written, either, message, verbatim


def check_scene(scene: Scene, findings: Findings) -> None:
    """Note every name that is unknown or used twice, and every link that touches no other."""
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
    """Note names that a point and a link share."""
    points = scene.points
    for name in scene.links:
        if name in points:
            findings.add(
                f"links.{name}",
                message("{name} is a point too", name=name),
                message("one name for one thing"),
            )


def check_capitals(scene: Scene, findings: Findings) -> None:
    """Note a point of a single link whose name differs only in capitals from another link's point.

    The plans write the image of B as b, so that two such names would look the same there.
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
            found = message("no other link has {point}", point=point)
            findings.add(
                place,
                found,
                verbatim(other),
                message("{other} is written with another capital", other=other),
            )


def check_link(scene: Scene, link: Link, findings: Findings) -> None:
    """Note names in guides, tracks, wheels and profiles of a link that do not exist."""
    place = place_of(link.name)
    check_centres(link, place, findings)
    for index, slide in enumerate(link.slides):
        where = numbered(f"{place}.slides", index, len(link.slides))
        check_guide(scene, link, slide, where, findings)
    check_tracks(scene, link, place, findings)
    check_guides(scene, link, findings)
    check_profiles(scene, link, findings)


def check_guides(scene: Scene, link: Link, findings: Findings) -> None:
    """Note two links that are guides of each other."""
    order = list(scene.links)
    for on in dict.fromkeys(slide.on for slide in link.slides):
        other = scene.links.get(on)
        if other is None or order.index(on) >= order.index(link.name):
            continue
        if link.name in [slide.on for slide in other.slides]:
            found = message(
                "links {on} and {name} slide on one another, guides in a circle",
                on=on,
                name=link.name,
            )
            expected = message("slides in one of the two links only")
            findings.add(f"{place_of(link.name)}.slides", found, expected)


def check_alone(scene: Scene, findings: Findings) -> None:
    """Note a moving link without points, or one that touches no other link.

    Links touch at a pin, a guide, a track or a wheel.
    """
    links = scene.every_link
    carriers = {path.on for link in links for path in link.paths}
    shared = Counter(point for link in links for point in link.points)
    for link in scene.links.values():
        place = f"links.{link.name}"
        if findings.inside(place):
            continue
        pinned = any(shared[point] > 1 for point in link.points)
        if not link.points:
            findings.add(
                place,
                message("a link without points"),
                message("points, such as P = [0, 0] or P-Q = 30"),
            )
        elif not (pinned or link.paths or link.wheels or link.name in carriers):
            found = message("link {name} touches no other", name=link.name)
            findings.add(
                place,
                found,
                message("a point that another link has too, {leading}", leading=LEADING),
            )


def check_branches(scene: Scene, findings: Findings) -> None:
    """Note branches of unknown names, and branches of the wrong kind.

    A point takes a side; a link takes a way or a closure. A pin may also take a way if its link, or
    the link that guides it, has several guides or tracks.
    """
    points = scene.points
    for name, branch in scene.branches.items():
        place = f"branches.{name}"
        if name not in points and name not in scene.links:
            known = [*points, *scene.links]
            free = (each for each in known if each not in scene.branches)
            findings.add(
                place,
                message("{name} is no point or link", name=name),
                listed(known),
                nearest(name, free),
            )
        elif isinstance(branch, Side):
            if name not in points:
                hint = ways_hint(scene, name, branch)
                findings.add(
                    place,
                    message("a side for link {name}", name=name),
                    WAYS_OF_LINK,
                    hint,
                    ANY_LINK,
                )
            for point in (branch.first, branch.second):
                known_point(point, points, THE_MECHANISM, place, findings)
            if name in (branch.first, branch.second):
                findings.add(
                    place,
                    message("{name} on a side of itself", name=name),
                    message("a line of two other points"),
                )
        elif isinstance(branch, Way) and is_of_several_ways(scene, name):
            continue
        elif name not in scene.links:
            found = message("forward, backward or a closure for point {name}", name=name)
            findings.add(place, found, *sides(name, scene.links, branch))


def is_of_several_ways(scene: Scene, point: str) -> bool:
    """Whether a point is on a link with several guides or tracks, or on one that carries them."""
    several = [link for link in scene.links.values() if len(link.paths) > 1]
    near = {name for link in several for name in (link.name, *(path.on for path in link.paths))}
    return any(point in scene.link(name).points for name in near if name != FRAME)


def ways_hint(scene: Scene, name: str, side: Side) -> Message:
    """A hint on where a side written under a link belongs: a block takes a way, a pin a side."""
    pin = side_of_pin(scene, name, side)
    if scene.links[name].paths:
        return message(
            'link {name} {leading}: {name} = "forward" or "backward"; a side is for a pin',
            name=name,
            leading=LEADING,
        )
    return message("sides are written under the pin's name: {pin}", pin=pin)


def side_of_pin(scene: Scene, name: str, side: Side) -> str:
    """The side as it would be written under a pin that the link shares with another."""
    shared = Counter(point for link in scene.links.values() for point in link.points)
    points = [p for p in scene.links[name].points if shared[p] > 1]
    pins = [p for p in points if p not in (side.first, side.second)]
    return f'{pins[0] if pins else "P"} = "{side}"'


def check_blocks(scene: Scene, findings: Findings) -> None:
    """Check the links with one point, and the blocks pinned to their own guide's link."""
    for link in scene.links.values():
        if not findings.inside(place_of(link.name)):
            check_bare(scene, link, findings)
            check_locked(scene, link, findings)


def check_bare(scene: Scene, link: Link, findings: Findings) -> None:
    """Note a link with one pin and nothing else: it would spin unless a driver turns it."""
    if len(link.points) != 1 or link.paths or link.wheels:
        return
    point = link.points[0]
    if carries(scene, link.name) or is_driven(scene, link.name):
        return
    found = message(
        "link {name} has the point {point} alone and no slides: nothing keeps it",
        name=link.name,
        point=point,
    )
    findings.add(
        place_of(link.name),
        found,
        message("slides = {{ on = …, … }} for a block, or a second point for a bar"),
        lent_slides(scene, link),
    )


def lent_slides(scene: Scene, link: Link) -> Message:
    """A hint where another link at the same pin has the slides that seem to belong to this one."""
    others = [
        other.name
        for other in scene.links.values()
        if other is not link and other.slides and link.points[0] in other.points
    ]
    return (
        message(
            "link {others} has slides: are they link {name}'s?", others=others[0], name=link.name
        )
        if others
        else NO_WORDS
    )


def check_locked(scene: Scene, link: Link, findings: Findings) -> None:
    """Note a block that slides on a link to which it is also pinned: it could not move."""
    place = f"{place_of(link.name)}.slides"
    for index, slide in enumerate(link.slides):
        if slide.on == link.name or slide.on not in (FRAME, *scene.links):
            continue
        shared = [point for point in link.points if point in scene.link(slide.on).points]
        if shared:
            found = message(
                "link {name} slides on {on} and is pinned to it at {shared}: it cannot "
                "move against it",
                name=link.name,
                on=link_words(slide.on),
                shared=shared[0],
            )
            where = f"{numbered(place, index, len(link.slides))}.on"
            expected, on = (
                message("a link that does not have {shared}", shared=shared[0]),
                meant(scene, link),
            )
            hint = message("did you mean on = {on}?", on=on) if on else NO_WORDS
            findings.add(where, found, expected, hint, (Written(on),) if on else ())


def meant(scene: Scene, block: Link) -> str:
    """The only link with a single pin, which may be the one meant to guide the block; else "".

    The name is quoted as a scene writes it.
    """
    shut = {slide.on for slide in block.slides}
    loose = [
        name
        for name, link in scene.links.items()
        if link is not block and name not in shut and hangs(scene, link)
    ]
    return quoted(loose[0]) if len(loose) == 1 else ""


def hangs(scene: Scene, link: Link) -> bool:
    """Whether a link has one pin and no guide, track, wheel or driver."""
    others = (scene.frame, *(each for each in scene.links.values() if each is not link))
    pins = [point for point in link.points if any(point in other.points for other in others)]
    free = not (link.paths or link.wheels or carries(scene, link.name))
    return free and len(pins) == 1 and not is_driven(scene, link.name)


def carries(scene: Scene, name: str) -> bool:
    """Whether a link carries a guide or a track."""
    links = scene.links.values()
    return any(path.on == name for link in links for path in link.paths)


def is_driven(scene: Scene, name: str) -> bool:
    """Whether a driver moves a link, or moves another link against it."""
    return any(name in (driver.link, driver.against) for driver in scene.drivers)


def check_drivers(scene: Scene, findings: Findings) -> None:
    """Note drivers whose link is unknown or cannot move so, and motions that are given twice."""
    for driver in scene.drivers:
        check_driver(scene, driver, driver.position.place.rpartition(".")[0], findings)
    check_repeated(scene, findings)


def check_driver(scene: Scene, driver: Driver, place: str, findings: Findings) -> None:
    """Note a driver of an unknown link, of a link against itself, or without a guide."""
    link = known_link(scene, driver.link, f"{place}.{driver.kind}", findings, moves=True)
    against = known_link(scene, driver.against, f"{place}.against", findings)
    if link is None or against is None:
        return
    if driver.link == driver.against:
        what = message("the frame, which is at rest") if driver.link == FRAME else message("itself")
        ends = other_ends(scene, link) if driver.kind == "slide" else []
        ways = either(f"{end.key} = {end.value}" for end in ends)
        expected = ways or message("a link that moves")
        findings.add(
            f"{place}.{driver.kind}",
            message("against {what}", what=what),
            expected,
            changes=tuple(ends),
        )
        return
    for point in driver.of or ():
        known_point(point, link.points, link_words(link.name), f"{place}.of", findings)
    if driver.kind == "turn" or findings.inside(place_of(link.name)):
        return
    if driver.kind == "slide":
        check_slid(scene, driver, link, place, findings)
    else:
        check_driven(driver, link, place, findings)


def other_ends(scene: Scene, link: Link) -> list[Written]:
    """For a driver along a link's guide: the blocks on that link, or the links it slides on."""
    pairs = [(each.name, slide.on) for each in scene.links.values() for slide in each.slides]
    blocks = [("slide", block) for block, on in pairs if on == link.name]
    guides = [("against", on) for block, on in pairs if block == link.name]
    return [Written(quoted(name), key) for key, name in (blocks + guides)[:3]]


def check_slid(scene: Scene, driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """Note a driver that slides a link without a guide on the driver's other link."""
    guides = [slide.on for slide in link.slides]
    if driver.against in guides:
        return
    if guides:
        on, against = link_words(guides[0]), link_words(driver.against)
        findings.add(
            place,
            message(
                "link {name} slides on {on}, not on {against}",
                name=link.name,
                on=on,
                against=against,
            ),
            message("against = {guides}", guides=quoted(guides[0])),
        )
        return
    can = [quoted(each.name) for each in scene.links.values() if each.slides]
    found = message("link {name} has no guide to slide along", name=link.name)
    expected = (
        message("slide = {can}", can=either(can[:3]))
        if can
        else message("a link with slides = {{ … }}")
    )
    findings.add(f"{place}.slide", found, expected, changes=tuple(map(Written, can[:3])))


def check_repeated(scene: Scene, findings: Findings) -> None:
    """Note motions that are given twice."""
    seen = Counter((driver.kind, driver.link, driver.against) for driver in scene.drivers)
    for (kind, link, against), times in seen.items():
        if times > 1:
            found = message(
                "{kind} = {link} against {against} is given {times} times",
                kind=kind,
                link=link,
                against=against,
                times=times,
            )
            findings.add("drivers", found, message("one driver for one motion"))


FARTHEST = 1e9
"""The largest distance from the origin, in lengths of the shortest bar.

Farther away, coordinates of 16 digits are too coarse for that bar.
"""
BESIDE = 1e3
"""A mechanism this many times its total length from the origin is far away."""


def check_far(scene: Scene, findings: Findings) -> None:
    """Note a frame so far from the origin that fewer than seven digits are left for its bars."""
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
            message(
                "it lies {far} m from the origin, and the shortest length is {bars} m: "
                "coordinates of 16 digits are too coarse for that",
                far=metres_written(far),
                bars=metres_written(min(bars)),
            ),
            message("at most {farthest} m", farthest=metres_written(FARTHEST * min(bars))),
            message("put the origin near the mechanism"),
        )


def bar_lengths(scene: Scene) -> Iterator[Quantity]:
    """Every bar length that the scene states."""
    for link in scene.every_link:
        for placing in link.placings:
            yield from (length for _, _, length in lengths_of(placing))


def fixed_places(scene: Scene) -> Iterator[tuple[Quantity, Quantity]]:
    """The coordinates of the frame's points, and those of the frame's guides and tracks."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            yield placing.x, placing.y
    for link in scene.links.values():
        for joint in link.paths:
            if joint.on == FRAME and isinstance(joint.through, tuple):
                yield joint.through


def metres(scene: Scene, length: Quantity) -> float:
    return float(length.si(scene.values))


def metres_written(length: float) -> str:
    """A length with three significant digits."""
    return shortest(float(f"{length:.3g}"))
