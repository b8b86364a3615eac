"""Massless links that keep a wheel in contact where no link of the scene does.

Two wheels in contact keep the distance of their centres: a bar joins the centres. A wheel on a
straight track, held only by pins and wheels, keeps its centre on a parallel to the track: a block
slides there. Neither restricts the motion, and both count like the contact that they represent.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence

from msgspec.structs import replace

from graphkin.scene.findings import numbered, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import (
    FRAME,
    Apart,
    At,
    Driver,
    Link,
    Polar,
    Rolling,
    Slide,
    Wheel,
    between_centres,
    of_one_size,
)
from graphkin.scene.phrases import next_name
from graphkin.scene.quantity import Quantity, combined, exact
from graphkin.text.errors import message

ON_LINE = 1e-12
"""Distance from a track, relative to the length along it, within which a point lies on it."""


def with_keepers(
    frame: Link, links: Mapping[str, Link], drivers: Sequence[Driver], measures: Measures
) -> tuple[Link, dict[str, Link]]:
    """The frame and the links, with the links added that keep wheels in contact.

    A scene may name such a link, ``rolls = { …, link = "arm" }``, and so request it.
    """
    written = laid_on_rollers({FRAME: frame, **links}, drivers, measures)
    tracks = {
        r.on for link in written.values() for r in link.rolls if r.through and r.on in written
    }
    held = {name: joints_of(written, name, drivers) for name in tracks}
    turned = {d.link for d in drivers if d.kind == "turn" and d.against == FRAME}
    every = dict(written)
    for name, link in written.items():
        for index, rolling in enumerate(link.rolls):
            keeper = keeper_of(every, name, index, held, turned, measures)
            if keeper is None:
                continue
            every[keeper.name] = keeper
            rolls = list(every[name].rolls)
            rolls[index] = counted_alike(rolling, keeper.name)
            every[name] = replace(every[name], rolls=tuple(rolls))
    return every.pop(FRAME), every


def laid_on_rollers(
    written: Mapping[str, Link], drivers: Sequence[Driver], measures: Measures
) -> dict[str, Link]:
    """The links, with those that lie on rollers of one size made to slide along the rollers' track.

    Of two links that may lie on one another, a driven slide is chosen. Otherwise it is the link
    with fewer pins, and then the one written later.
    """
    free = {name: link for name, link in written.items() if name != FRAME and not link.slides}
    guides = {name: roller_guide(written, link, measures) for name, link in free.items()}
    shared = Counter(point for link in written.values() for point in link.points)
    slid = {driver.link for driver in drivers if driver.kind == "slide"}

    def rank(name: str) -> tuple[bool, int, int]:
        pins = sum(shared[point] > 1 for point in written[name].points)
        return name in slid, -pins, [*written].index(name)

    found = dict(written)
    for name, guide in guides.items():
        if guide is None:
            continue
        other = guides.get(guide.on)
        if other is None or other.on != name or rank(name) > rank(guide.on):
            found[name] = replace(free[name], slides=(guide,))
    return found


def roller_guide(written: Mapping[str, Link], plank: Link, measures: Measures) -> Slide | None:
    """The guide of a plank on rollers of one size: twice their radius from the rollers' track.

    None if the rollers do not form one: each must roll on one line of the plank and on one of
    another link. Links that slide on the plank, such as a rack, do not carry it.
    """
    borne = {name for name, link in written.items() if any(s.on == plank.name for s in link.slides)}
    pairs = [
        (link, upper, lower)
        for link in written.values()
        for upper in link.rolls
        for lower in link.rolls
        if upper.on == plank.name != lower.on not in borne and len(link.wheels) == 1
    ]
    rollers = tuple(dict.fromkeys(link.name for link, _, _ in pairs))
    if len(pairs) != len(rollers) or len(rollers) < 2:
        return None
    (first, upper, lower), *others = pairs
    size, height = first.wheels[0].radius, height_on(plank, upper)
    if size is None or height is None or lower.angle is None or lower.through is None:
        return None
    for link, above, below in others:
        alike = of_one_size(first.wheels[0], link.wheels[0])
        if not (alike and same_line(plank, upper, above, measures)):
            return None
        if not same_line(written[lower.on], lower, below, measures):
            return None
    if upper.side != -lower.side:
        return None
    apart = combined("+", size, size)
    apart = apart if lower.side > 0 else apart.negative()
    return Slide(
        lower.on, lower.through, lower.angle, None, combined("-", apart, height), rollers=rollers
    )


def height_on(plank: Link, track: Rolling) -> Quantity | None:
    """The distance of a track along a link's x axis to the left of the link's first point."""
    first = place_on(plank, plank.points[0]) if plank.points else None
    there = place_on(plank, track.through)
    if first is None or there is None or track.angle is None or not track.angle.is_zero():
        return None
    return combined("-", there, first)


def place_on(link: Link, point: str | tuple[Quantity, Quantity] | None) -> Quantity | None:
    """The written distance of a point of a link, or place on it, to the left of its x axis."""
    if isinstance(point, tuple):
        return point[1]
    return next((p.y for p in link.placings if isinstance(p, At) and p.point == point), None)


def same_line(link: Link, one: Rolling, other: Rolling, measures: Measures) -> bool:
    """Whether two tracks of a link are written as one line with one side."""
    if one.on != other.on or one.side != other.side or None in (one.angle, other.angle):
        return False
    assert one.angle is not None and other.angle is not None
    if one.angle.number(measures.values) != other.angle.number(measures.values):
        return False
    if one.through == other.through:
        return True
    heights = height_on(link, one), height_on(link, other)
    if heights[0] is not None and heights[1] is not None:
        return bool(heights[0].number(measures.values) == heights[1].number(measures.values))
    first, second = (written_place(link, each.through, measures) for each in (one, other))
    if first is None or second is None:
        return False
    way = (second - first) / complex(one.angle.direction(measures.values))
    return bool(abs(way.imag) <= ON_LINE * abs(way))


def written_place(
    link: Link, point: str | tuple[Quantity, Quantity] | None, measures: Measures
) -> complex | None:
    """The written position (m) of a point: by coordinates, or from a point that has them."""
    values = measures.values
    if isinstance(point, tuple):
        return complex(*(float(each.si(values)) for each in point))
    for placing in link.placings:
        if isinstance(placing, At) and placing.point == point:
            return complex(float(placing.x.si(values)), float(placing.y.si(values)))
        if isinstance(placing, Polar) and placing.point == point:
            start = written_place(link, placing.start, measures)
            way = float(placing.length.si(values)) * complex(placing.angle.direction(values))
            return None if start is None else start + way
    return None


def keeper_of(
    every: Mapping[str, Link],
    name: str,
    index: int,
    held: Mapping[str, int],
    turned: Collection[str],
    measures: Measures,
) -> Link | None:
    """The link that keeps a wheel in contact; None where none is needed.

    A bar ``turned`` by a driver on a drum of the frame needs one: bar and drum locate everything
    else.
    """
    own, rolling = every[name], every[name].rolls[index]
    on = every.get(rolling.on)
    if on is None or on is own or not own.wheels or rolling.belt is not None:
        return None
    asked = rolling.keeper
    if rolling.through is None:
        pair = loose_pair(every, own, on, rolling)
        made = bar_between(*pair, measures) if pair else None
    else:
        loose = held.get(rolling.on, 2) < 2 and not bears(every, name, rolling.on)
        needed = rolling.on != FRAME and (asked or loose)
        needed = needed or (name == FRAME and rolling.on in turned)
        made = block_on(own.rim, rolling, measures) if needed else None
    place = f"{'frame' if name == FRAME else f'links.{name}'}.rolls"
    place = f"{numbered(place, index, len(own.rolls))}.link"
    if made is None:
        if asked:
            found = message("{asked}: this wheel is kept where it rolls", asked=shown(asked))
            measures.findings.add(place, found, message("no name here"))
        return None
    called = asked or next_name({each: link for each, link in every.items() if each != FRAME})
    if called in every:
        measures.findings.add(
            place,
            message("link {called} is there already", called=called),
            message("the name of a new link"),
        )
        return None
    return replace(made, name=called)


def bears(links: Mapping[str, Link], wheel: str, track: str) -> bool:
    """Whether a wheel is a roller under a link on its track, and so does not hold it."""
    slides = (slide for link in links.values() for slide in link.slides)
    return any(slide.on == track and wheel in slide.rollers for slide in slides)


def counted_alike(rolling: Rolling, keeper: str) -> Rolling:
    """A rolling with its keeper, in which a block counts its angle like the bar it slides along."""
    start, turns = dict(rolling.start), dict(rolling.turns)
    if rolling.angle is not None:
        bar = start.get(rolling.on)
        start[keeper] = rolling.angle if bar is None else combined("+", bar, rolling.angle)
    if rolling.on in turns and rolling.angle is not None:
        turns[keeper] = turns[rolling.on]
    return replace(rolling, keeper=keeper, start=start, turns=turns)


def loose_pair(
    every: Mapping[str, Link], own: Link, on: Link, rolling: Rolling
) -> tuple[Wheel, Wheel] | None:
    """The wheel that rolls and its track wheel, where no third link carries both centres."""
    both = rolling.pairs(own.wheels, on.wheels) if on.wheels else []
    pairs = [(w, t) for w, t in both if not (w.inside and t.inside)]
    others = [set(link.points) for link in every.values() if link is not own and link is not on]
    kept = any({w.centre, t.centre} <= points for w, t in pairs for points in others)
    return pairs[0] if pairs and not kept and pairs[0][0].centre != pairs[0][1].centre else None


def bar_between(wheel: Wheel, track: Wheel, measures: Measures) -> Link | None:
    """The bar from the centre of the track wheel to the centre of the rolling wheel.

    None where a ring is no larger than the wheel within it; another check reports that.
    """
    if wheel.radius is None or track.radius is None:
        return None
    length = between_centres((wheel, track), (wheel.radius, track.radius))
    if not length.number(measures.values) > 0:
        return None
    ends = track.centre, wheel.centre
    return Link("", ends, (origin(ends[0], measures), Apart(ends[1], ends[0], length)))


def origin(point: str, measures: Measures) -> At:
    """A point at the origin of its link."""
    zero = exact(0, measures.units["length"])
    return At(point, zero, zero)


def block_on(wheel: Wheel, rolling: Rolling, measures: Measures) -> Link | None:
    """The block at a wheel's centre that slides along the track, at the radius from it."""
    if wheel.radius is None or rolling.angle is None:
        return None
    offset = wheel.radius if rolling.side > 0 else wheel.radius.negative()
    slide = Slide(rolling.on, rolling.through, rolling.angle, None, offset)
    return Link("", (wheel.centre,), (origin(wheel.centre, measures),), (slide,))


def joints_of(every: Mapping[str, Link], name: str, drivers: Collection[Driver]) -> int:
    """The number of pins, slides, drivers and own wheels that hold a link; 2 for the frame.

    Links attached to this link alone do not hold it. Neither does the equivalent linkage of a cam,
    which lifts a follower.
    """
    if name == FRAME:
        return 2
    link, firm = every[name], reached(every, name)
    shared = Counter(p for each in firm for p in every[each].points)
    pins = sum(shared[point] > 0 for point in link.points)
    slides = [s for s in link.slides if s.on in firm]
    slides += [s for each in firm for s in every[each].slides if s.on == name]
    moved = [d for d in drivers if moves(every, d, name, pins > 0) & firm]
    rolls = [r for r in link.rolls if r.on in firm]
    wheels = [r for each in firm for r in every[each].rolls if r.on == name and not r.through]
    return pins + 2 * len(slides) + 2 * len(moved) + len(rolls) + len(wheels)


def moves(every: Mapping[str, Link], driver: Driver, name: str, pinned: bool) -> set[str]:
    """The link against which a driver positions a link; none where the driver only turns it."""
    ends = {driver.link, driver.against}
    if name not in ends:
        return set()
    rolls = every[driver.link].rolls if driver.link in every else ()
    on_track = (r.on == driver.against and r.through for r in rolls)
    if driver.kind == "turn" and not pinned and not (name == driver.link and any(on_track)):
        return set()
    return ends - {name}


def reached(every: Mapping[str, Link], but: str) -> set[str]:
    """The links that joints connect to the frame without one given link."""
    cams = {link.cam.link for link in every.values() if link.cam is not None}
    beside: dict[str, set[str]] = {name: set() for name in every}
    owners: dict[str, str] = {}
    for link in (each for name, each in every.items() if name != but):
        near = [owners.setdefault(point, link.name) for point in link.points]
        for other in (*near, *(slide.on for slide in link.slides), *(r.on for r in link.rolls)):
            if other in every and other != but:
                beside[link.name].add(other)
                beside[other].add(link.name)
    found, waiting = {FRAME}, [FRAME]
    while waiting:
        for each in beside[waiting.pop()] - found - cams:
            found.add(each)
            waiting.append(each)
    return found
