"""The wheels of two links that touch or have a belt, and the link that keeps their distance."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from msgspec import Struct

from graphkin.numbers.plane import Line, cross
from graphkin.scene.model import FRAME, Belt, Rolling, Scene, Wheel, link_words, of_one_size
from graphkin.scene.phrases import next_name, quoted
from graphkin.structure.turning import LEVEL, body, metres, stands_along, through, unit
from graphkin.text.errors import NO_WORDS, Message, Problem, StructureError, WrittenInto, message

TOUCH = 1e-9
"""Gap between wheels that touch, as a share of their distance, that rounding may leave."""


class RollingContact(Struct, frozen=True):
    """The wheel that rolls, the wheel it rolls on (None: a straight track), and the arm."""

    wheel: Wheel
    track: Wheel | None
    arm: str | None


class WheelsApart(Struct, frozen=True):
    """Two wheels, or a wheel and a track, at a distance (m) that link ``arm`` keeps."""

    wheel: Wheel
    track: Wheel | None
    arm: str
    distance: float
    needed: float

    @property
    def touches(self) -> bool:
        """Whether the distance equals the one at which they touch."""
        return self.needed > 0 and miss(self) <= TOUCH * self.needed


def miss(apart: WheelsApart) -> float:
    """The difference between a distance and the required one."""
    return abs(apart.distance - apart.needed)


def touching(
    scene: Scene, name: str, rolling: Rolling, before: Sequence[tuple[Rolling, Wheel]]
) -> RollingContact:
    """The wheels of a rolling pair; ``before`` are the earlier straight tracks of the same link.

    Where a link keeps the distance, the radii select the wheels. Otherwise the wheels written first
    are taken. Raises StructureError for wheels that are held apart.
    """
    if rolling.belt is not None:
        return belted(scene, name, rolling, rolling.belt)
    link, on = scene.link(name), scene.link(rolling.on)
    if rolling.through is None:
        kept = list(kept_centres(scene, name, rolling))
        loose = RollingContact(*rolling.pairs(link.wheels, on.wheels)[0], None)
    else:
        kept = list(kept_heights(scene, name, rolling, before))
        loose = RollingContact(link.rim, None, None)
    found = next((apart for apart in kept if apart.touches), None)
    if found is not None:
        return RollingContact(found.wheel, found.track, found.arm)
    if kept:
        ring = next((apart for apart in kept if may_be_ring(scene, apart)), None)
        raise StructureError(gap(scene, name, rolling, ring or min(kept, key=miss)))
    return loose


def belted(scene: Scene, name: str, rolling: Rolling, belt: Belt) -> RollingContact:
    """The two wheels of a belt. Raises StructureError where the belt cannot run on them."""
    wheel, track = rolling.pairs(scene.links[name].wheels, scene.link(rolling.on).wheels)[0]
    arm = owner_of(scene, (wheel.centre, track.centre), (name, rolling.on))
    if arm is None:
        centres = f"{track.centre}-{wheel.centre}"
        found = message(
            "no link carries both centres, {track} and {wheel}",
            track=track.centre,
            wheel=wheel.centre,
        )
        hint = message("the belt is taut only while their distance is kept")
        raise StructureError.at(
            f"links.{name}.belt",
            found,
            message("an arm: a link with {centres} = …", centres=centres),
            hint,
        )
    points, radii = body(scene, arm), (radius(scene, wheel), radius(scene, track))
    distance = abs(points[wheel.centre] - points[track.centre])
    if distance <= sum(radii) * (1 + TOUCH):
        raise StructureError(overlap(scene, name, rolling, RollingContact(wheel, track, arm)))
    near = abs(radii[0] - radii[1]) <= TOUCH * max(radii)
    if not belt.crossed and near and not of_one_size(wheel, track):
        found = message(
            "an open belt on two wheels of radius {radii} by chance", radii=shown(scene, radii[0])
        )
        expected = message(
            "wheels of different radii for these parameters, or of one radius for all"
        )
        hint = message("wheels of one size turn alike; write the same radius for both")
        raise StructureError.at(f"links.{name}.belt", found, expected, hint)
    return RollingContact(wheel, track, arm)


def overlap(scene: Scene, name: str, rolling: Rolling, on: RollingContact) -> Problem:
    """The problem of two wheels that are too close for a belt round both."""
    assert on.track is not None and on.arm is not None
    own, other = radius(scene, on.wheel), radius(scene, on.track)
    points, centres = body(scene, on.arm), f"{on.track.centre}-{on.wheel.centre}"
    distance = abs(points[on.wheel.centre] - points[on.track.centre])
    found = message(
        "the wheels of radius {own} and {other} (on {on}) overlap or touch: {arm} "
        "keeps {centres} = {distance}",
        own=shown(scene, own),
        other=shown(scene, other),
        on=link_words(rolling.on),
        arm=link_words(on.arm),
        centres=centres,
        distance=shown(scene, distance),
    )
    expected = message("more than the sum of the radii, {own}", own=shown(scene, own + other))
    hint = message("wheels that touch are written with rolls")
    return Problem(f"links.{name}.belt", found, expected, hint)


def kept_centres(scene: Scene, name: str, rolling: Rolling) -> Iterator[WheelsApart]:
    """Every two wheels whose centres belong to one link, with their distance on it.

    External wheels touch at the sum of their radii; a ring and a wheel within it touch at the
    difference. Two rings cannot touch, nor can a ring and a larger wheel.
    """
    for wheel, track in rolling.pairs(scene.link(name).wheels, scene.link(rolling.on).wheels):
        arm = owner_of(scene, (wheel.centre, track.centre), (name, rolling.on))
        if arm is None or (wheel.inside and track.inside):
            continue
        points, own, other = body(scene, arm), radius(scene, wheel), radius(scene, track)
        distance = abs(points[wheel.centre] - points[track.centre])
        needed = other - own if track.inside else own - other if wheel.inside else own + other
        yield WheelsApart(wheel, track, arm, distance, needed)


def owner_of(scene: Scene, points: Sequence[str], but: Sequence[str]) -> str | None:
    """The first link, the frame before all, that has all of some points and is none of ``but``."""
    for link in scene.every_link:
        if link.name not in but and set(points) <= set(link.points):
            return link.name
    return None


def kept_heights(
    scene: Scene, name: str, rolling: Rolling, before: Sequence[tuple[Rolling, Wheel]]
) -> Iterator[WheelsApart]:
    """Every wheel whose centre is held at a distance from a straight track, on its proper side.

    A link that has the centre and only slides along the track may hold it (rack and pinion). So may
    an earlier track parallel to this one (roller between plates).
    """
    line = track_line(scene, rolling)
    standing = stands_along(scene, rolling.on, line.along)
    zero = cross(line.along, line.point)
    link = scene.link(name)
    for arm in (FRAME, *scene.links):
        if arm not in standing or arm in (name, rolling.on):
            continue
        points, stand = body(scene, arm), standing[arm]
        for wheel in link.wheels:
            if wheel.centre in points:
                height = stand.height + cross(line.along, stand.lean * points[wheel.centre]) - zero
                yield WheelsApart(wheel, None, arm, rolling.side * height, radius(scene, wheel))
    for other, rolled in before:
        if other.on not in standing or other.on == rolling.on:
            continue
        stand, track = standing[other.on], track_line(scene, other)
        if abs(cross(line.along, stand.lean * track.along)) > LEVEL:
            continue
        centre = track.point + 1j * other.side * radius(scene, rolled) * track.along
        height = stand.height + cross(line.along, stand.lean * centre) - zero
        for wheel in link.wheels:
            if wheel.centre == rolled.centre:
                yield WheelsApart(
                    wheel, None, other.on, rolling.side * height, radius(scene, wheel)
                )


def radius(scene: Scene, wheel: Wheel) -> float:
    """The radius of a wheel in metres."""
    assert wheel.radius is not None
    return metres(scene, wheel.radius)


def gap(scene: Scene, name: str, rolling: Rolling, apart: WheelsApart) -> Problem:
    """The problem of the gap between two wheels, or between a wheel and its track."""
    place, on = f"links.{name}.rolls", link_words(rolling.on)
    keeper = link_words(apart.arm)
    own = shown(scene, radius(scene, apart.wheel))
    if apart.track is None:
        lies = "left" if (rolling.side > 0) == (apart.distance > 0) else "right"
        found = message(
            "the wheel of radius {own} does not touch its track on {on}: {keeper} keeps its "
            "centre {centre} {distance} of it",
            own=own,
            on=on,
            keeper=keeper,
            centre=apart.wheel.centre,
            distance=aside(scene, apart.distance, left=lies == "left"),
        )
        expected = aside(scene, apart.needed, left=rolling.side > 0)
        if apart.distance >= 0:
            return Problem(place, found, expected)
        line = f'side = "{lies}"'
        return Problem(
            place, found, expected, message("write {lower}", lower=line), (WrittenInto(line),)
        )
    other = shown(scene, radius(scene, apart.track))
    centres = f"{apart.track.centre}-{apart.wheel.centre}"
    found = message(
        "wheels of radius {own} and {other} (on {on}) do not touch: {keeper} keeps "
        "{centres} = {distance}",
        own=own,
        other=other,
        on=on,
        keeper=keeper,
        centres=centres,
        distance=shown(scene, apart.distance),
    )
    if apart.needed <= 0:
        return Problem(place, found, message("a ring that is larger than the wheel within it"))
    needed = {"centres": centres, "needed": shown(scene, apart.needed)}
    expected = message("the sum of the radii, {centres} = {needed}", **needed)
    if apart.track.inside or apart.wheel.inside:
        expected = message("the difference of the radii, {centres} = {needed}", **needed)
    hint = teeth_hint(scene, rolling, apart)
    if may_be_ring(scene, apart):
        hint = message("write inside = true in the larger wheel, if it is a ring")
    return Problem(place, found, expected, hint)


def teeth_hint(scene: Scene, rolling: Rolling, apart: WheelsApart) -> Message:
    """Words for the number of teeth with which a track wheel would touch.

    Empty where the number is not whole, or where the scene writes the module.
    """
    wheel, track = apart.wheel, apart.track
    if not wheel.sized or wheel.teeth is None or track is None or track.teeth is None:
        return NO_WORDS
    own = radius(scene, wheel)
    teeth = wheel.teeth.number(scene.values) / own
    needed = apart.distance + own if track.inside else abs(apart.distance - own)
    many = round(float(teeth * needed))
    if many < 1 or abs(many - teeth * needed) > TOUCH * many:
        return NO_WORDS
    return message(
        "{many} teeth instead of {teeth} would touch there; for profile-shifted gears, write a "
        "radius for each centre distance",
        many=many,
        teeth=track.teeth.written(scene.values),
    )


def aside(scene: Scene, distance: float, *, left: bool) -> Message:
    """Words for a distance to one side of a track."""
    size = shown(scene, abs(distance))
    if left:
        return message("{distance} to the left", distance=size)
    return message("{distance} to the right", distance=size)


def may_be_ring(scene: Scene, apart: WheelsApart) -> bool:
    """Whether two wheels that do not touch would touch if the larger one were a ring."""
    if apart.track is None or apart.track.inside or apart.wheel.inside:
        return False
    within = abs(radius(scene, apart.track) - radius(scene, apart.wheel))
    return abs(within - apart.distance) <= TOUCH * apart.distance


def shown(scene: Scene, length: float) -> str:
    """A length in the unit of the scene."""
    unit = scene.units["length"]
    return f"{length / scene.unit_length:.10g} {unit}"


def track_line(scene: Scene, rolling: Rolling) -> Line:
    """A straight track in the axes of its link, along a unit vector."""
    return Line(through(scene, rolling), unit(scene, rolling.angle))


def lone_wheels(scene: Scene) -> Iterator[Problem]:
    """The problems of wheels that roll on nothing and on which nothing rolls."""
    links = scene.every_link
    tracks = {rolling.on for link in links for rolling in link.rolls}
    for link in links:
        if link.wheels and not link.rolls and link.name not in tracks:
            place = "frame.wheel" if link.name == FRAME else f"links.{link.name}.wheel"
            found = message("a wheel without a track: it rolls on nothing, and nothing rolls on it")
            expected = message(
                "rolls or belt = {{ on = {name} }} in a link with a wheel", name=quoted(link.name)
            )
            if link.name != FRAME:
                expected = message(
                    "rolls or belt = {{ on, … }} in this link, or {there}", there=expected
                )
            yield Problem(place, found, expected)


def keeper_hint(scene: Scene, loose: Sequence[str]) -> Message:
    """Words for a track without the link that keeps its wheel there; empty if there is none."""
    for name in loose:
        for rolling in scene.links[name].rolls:
            if rolling.through and rolling.on != FRAME and not rolling.keeper:
                return message("or, {keep}", keep=keeper_asked(scene.links, name, rolling.on))
    return NO_WORDS


def asked_of(scene: Scene, tracks: Sequence[str]) -> Message:
    """Words for what to write where a wheel rolls on a track that nothing holds.

    For a rack that slides across the track and has no other link attached, the words ask for the
    direction of its axes.
    """
    for track in tracks:
        hung = {p for k in scene.every_link if k.name != track for p in k.points}
        rack = scene.link(track).slides and hung.isdisjoint(scene.link(track).points)
        rolled = [(k, r) for k in scene.every_link for r in k.rolls if r.through is not None]
        wheels = [(link, rolling) for link, rolling in rolled if rolling.on == track]
        along = (unit(scene, rolling.angle) for _, rolling in wheels)
        if rack and any(abs(each.imag) > LEVEL for each in along):
            return message(
                "link {track} slides across the track: the x axis of a block lies "
                "along its guide, write angle = 0",
                track=track,
            )
        loose = next((link.name for link, rolling in wheels if not rolling.keeper), None)
        if loose is not None:
            return keeper_asked(scene.links, loose, track)
    return NO_WORDS


def keeper_asked(links: Collection[str], wheel: str, track: str) -> Message:
    """Words for a track that seems to be guided by links which it carries itself.

    The block that keeps its wheel in contact is only added if the scene names it.
    """
    whose = link_words(wheel)
    moving = [name for name in links if name != FRAME]
    return message(
        "if a pin and the wheel of {whose} alone hold link {track}, write link = "
        "{moving} in rolls of {whose}: a block of that name is put in, which keeps the "
        "wheel on its track",
        whose=whose,
        track=track,
        moving=quoted(next_name(moving)),
    )
