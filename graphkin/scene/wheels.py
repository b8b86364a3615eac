"""Wheels: their data, the tracks and belts they run on, and the letters of their contacts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, count
from math import prod
from typing import Literal

from msgspec import Struct
from msgspec.structs import replace

from graphkin.scene.expression import Call, Number
from graphkin.scene.expression import Pair as Product
from graphkin.scene.findings import Findings, Table, numbered, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import (
    FRAME,
    TENSIONS,
    At,
    Belt,
    Driver,
    Link,
    Rolling,
    Scene,
    StrandTension,
    Wheel,
    between_centres,
    lengths_of,
    link_words,
)
from graphkin.scene.phrases import (
    SIDES,
    check_guide,
    known_link,
    known_point,
    link_name,
    point_name,
    quoted,
)
from graphkin.scene.quantity import Quantity, combined, exact, shortest
from graphkin.scene.read_joints import MOST, read_line, tables
from graphkin.text.errors import NO_WORDS, Hint, Mend, SceneError, joined, message

BY_RADIUS_OR_TEETH = message("radius = …, or teeth = … and module = …")
OTHER = message("the link that carries the other wheel, 0 for the frame")
TRACK = message("the link that carries the track or the other wheel, 0 for the frame")
STEMS = ("T", "K", "H")
"""The letters tried in turn; after them come TT, TTT and so on."""
MANY = 1000
"""Number of turns up to which a driver's angle is used as written: three digits lost at most."""


def read_wheels(table: Table, measures: Measures, module: Quantity | None) -> tuple[Wheel, ...]:
    """The wheels of a link, from ``wheel`` or ``wheels``."""
    both = tables(table, "wheel") + tables(table, "wheels")
    return tuple(read_wheel(each, measures, module) for each in both)


def read_wheel(table: Table, measures: Measures, module: Quantity | None) -> Wheel:
    """One wheel: a centre with a radius, or with teeth and a module that give the radius.

    Teeth alone leave the radius open; ``sized_by_teeth`` finds it.
    """
    centre = point_name(table.at("centre"), table.take("centre"), measures.findings) or ""
    raw_radius, raw_teeth, own = table.take("radius"), table.take("teeth"), table.take("module")
    if own is not None:
        module = measures.length(table.at("module"), own, positive=True)
    radius = teeth = None
    if raw_teeth is not None:
        teeth = read_teeth(table.at("teeth"), raw_teeth, measures)
    if raw_radius is not None:
        radius = measures.length(table.at("radius"), raw_radius, positive=True)
        if own is not None:
            table.wrong("module", message("module beside radius"), message("one of the two"))
    elif teeth is not None and module is not None:
        radius = pitch_radius(teeth, module)
    elif teeth is None:
        measures.findings.add(table.place, message("no radius"), BY_RADIUS_OR_TEETH)
    inside = table.flag("inside")
    table.finish()
    return Wheel(centre, radius, teeth, inside)


def read_teeth(place: str, raw: object, measures: Measures) -> Quantity:
    """A whole number of teeth."""
    teeth = measures.number(place, raw, positive=True)
    value = teeth.number(measures.values)
    if not isinstance(value, Fraction) or value.denominator != 1:
        measures.findings.add(place, shown(raw), message("a whole number of teeth"))
    return teeth


def pitch_radius(teeth: Quantity, module: Quantity) -> Quantity:
    """Half the module times the number of teeth."""
    tree = Product("/", Product("*", module.tree, teeth.tree), Number(Fraction(2)))
    text = f"({module.text})*({teeth.text})/2"
    return Quantity(text, tree, module.unit, teeth.place)


# --- wheels known by their teeth alone -----------------------------------------------------------

PROPOSED = {
    "mm": Fraction(2),
    "cm": Fraction(1, 5),
    "m": Fraction(1, 500),
    "in": Fraction(1, 10),
    "ft": Fraction(1, 120),
}
"""The module, in each unit, of a train of which no length is known."""

Key = tuple[str, int]
"""A wheel: its link, and its index in the link's list."""


class WheelPair(Struct, frozen=True):
    """Two wheels that touch or that a belt joins."""

    ends: tuple[Key, Key]
    wheels: tuple[Wheel, Wheel]
    belt: bool

    @property
    def axles(self) -> frozenset[str]:
        """The centres of both wheels."""
        return frozenset(wheel.centre for wheel in self.wheels)

    @property
    def toothed(self) -> bool:
        """Whether both wheels have teeth, and so one module."""
        return all(wheel.teeth is not None for wheel in self.wheels)

    def reach(self, sizes: Sequence[Quantity]) -> Quantity:
        """The sum of the wheels' sizes, or in a ring their difference."""
        return between_centres(self.wheels, sizes)


def sized_by_teeth(links: Mapping[str, Link], measures: Measures) -> dict[str, Link]:
    """The links, with radii for the wheels that are known by their teeth alone.

    Wheels in mesh have one module. It follows from a wheel of the train whose radius is known, or
    from the distance of two centres: written in a link, or kept by wheels on the same two axles.
    Where the scene has no such length, a module is proposed. A rack needs a written module.
    """
    wheels = {(k.name, i): wheel for k in links.values() for i, wheel in enumerate(k.wheels)}
    alone = {key for key, wheel in wheels.items() if wheel.radius is None and wheel.teeth}
    if not alone:
        return dict(links)
    meshes = [*meshes_of(links, alone, measures)]
    train = {key: {key} for key in wheels}
    for mesh in meshes:
        if mesh.toothed and train[mesh.ends[0]] is not train[mesh.ends[1]]:
            both = train[mesh.ends[0]] | train[mesh.ends[1]]
            train.update(dict.fromkeys(both, both))
    racked = {(k.name, k.wheels.index(k.rim)) for k in links.values() if on_rack(k)}
    modules: dict[Key, Quantity] = {}
    sources: dict[Key, Literal["distance", "proposed"]] = {}

    def settle(key: Key, module: Quantity, source: Literal["distance", "proposed"]) -> None:
        modules.update(dict.fromkeys(train[key], module))
        sources.update(dict.fromkeys(train[key], source))

    for key, wheel in wheels.items():
        if wheel.radius is not None and wheel.teeth is not None and key not in modules:
            settle(key, combined("/", doubled(wheel.radius), wheel.teeth), "distance")
    reached = {axles: far for m in meshes if (far := distance(links, axles := m.axles)) is not None}
    while True:
        spread(meshes, wheels, modules, reached, settle, measures)
        free = (key for key in alone if key not in modules and not train[key] & racked)
        open_ = min(free, key=[*wheels].index, default=None)
        if open_ is None:
            break
        belts = (m for m in meshes if m.belt and open_ in m.ends and m.axles in reached)
        if (belt := next(belts, None)) is not None:  # both rims within the distance of the centres
            teeth = [wheel.teeth for wheel in belt.wheels if wheel.teeth is not None]
            settle(open_, combined("/", reached[belt.axles], combined("+", *teeth)), "proposed")
        else:
            unit = measures.units["length"]
            settle(open_, exact(PROPOSED[unit], unit), "proposed")
    return {name: with_radii(link, modules, sources, measures) for name, link in links.items()}


def spread(
    meshes: Sequence[WheelPair],
    wheels: Mapping[Key, Wheel],
    modules: Mapping[Key, Quantity],
    reached: dict[frozenset[str], Quantity],
    settle: Callable[[Key, Quantity, Literal["distance"]], None],
    measures: Measures,
) -> None:
    """Take modules from distances and distances from modules until neither adds any."""
    touching = [mesh for mesh in meshes if not mesh.belt]
    before = -1
    while before < (before := len(modules) + len(reached)):
        for mesh in touching:
            sizes = [size_of(wheels[end], modules.get(end)) for end in mesh.ends]
            known = [size for size in sizes if size is not None]
            if len(known) == 2 and mesh.axles not in reached:
                reached[mesh.axles] = mesh.reach(known)
            far, teeth = reached.get(mesh.axles), [w.teeth for w in mesh.wheels if w.teeth]
            if far is not None and mesh.toothed and mesh.ends[0] not in modules:
                many = mesh.reach(teeth)
                if many.number(measures.values) > 0:
                    settle(mesh.ends[0], combined("/", doubled(far), many), "distance")


def size_of(wheel: Wheel, module: Quantity | None) -> Quantity | None:
    """The radius of a wheel as written, or from its teeth and a module; None if unknown."""
    if wheel.radius is not None or wheel.teeth is None or module is None:
        return wheel.radius
    return pitch_radius(wheel.teeth, module)


def meshes_of(
    links: Mapping[str, Link], alone: Collection[Key], measures: Measures
) -> Iterator[WheelPair]:
    """The contacts of wheels with wheels; one that may be of several pairs is noted."""
    for link in links.values():
        for index, rolling in enumerate(link.rolls):
            on = links.get(rolling.on)
            if on is None or on is link or rolling.through is not None:
                continue
            ways = [
                WheelPair(((link.name, i), (on.name, k)), (own, other), rolling.belt is not None)
                for i, own in enumerate(link.wheels)
                for k, other in enumerate(on.wheels)
                if rolling.wheels in (None, (i, k)) and not (own.inside and other.inside)
            ]
            ways = [way for way in ways if len(way.axles) == 2]
            if len(ways) == 1:
                yield ways[0]
            elif any(alone.__contains__(end) for way in ways for end in way.ends):
                place = "frame" if link.name == FRAME else f"links.{link.name}"
                place = numbered(f"{place}.rolls", index, len(link.rolls))
                found = message("several wheels known by their teeth alone may mesh here")
                expected = message(
                    "wheels = [1, 2]: the wheel of this link and that of the other, counted from 1"
                )
                measures.findings.add(place, found, expected)


def with_radii(
    link: Link,
    modules: Mapping[Key, Quantity],
    sources: Mapping[Key, Literal["distance", "proposed"]],
    measures: Measures,
) -> Link:
    """A link whose wheels have the radii that modules give; a wheel without one is noted."""
    found = list[Wheel]()
    for index, wheel in enumerate(link.wheels):
        module = modules.get((link.name, index))
        if wheel.radius is not None or wheel.teeth is None:
            found.append(wheel)
        elif module is not None:
            radius, source = pitch_radius(wheel.teeth, module), sources[link.name, index]
            found.append(replace(wheel, radius=radius, sized=source))
        else:
            found.append(wheel)
            place = "frame" if link.name == FRAME else f"links.{link.name}"
            hint = message("the travel of a rack depends on the module of its pinion")
            measures.findings.add(
                numbered(f"{place}.wheel", index, len(link.wheels)),
                message("teeth without a module"),
                BY_RADIUS_OR_TEETH,
                hint,
            )
    return replace(link, wheels=tuple(found))


def on_rack(link: Link) -> bool:
    """Whether a wheel of a link rolls on a straight track."""
    return bool(link.wheels) and any(rolling.through is not None for rolling in link.rolls)


def distance(links: Mapping[str, Link], ends: Collection[str]) -> Quantity | None:
    """The distance of two points that a link gives by its length or by coordinates."""
    for link in links.values():
        if not set(ends) <= set(link.points):
            continue
        for placing in link.placings:
            for one, other, length in lengths_of(placing):
                if {one, other} == set(ends):
                    return length
        places = [p for p in link.placings if isinstance(p, At) and p.point in ends]
        if len(places) == 2:
            x, y = (
                combined("-", *pair) for pair in zip(*((p.x, p.y) for p in places), strict=True)
            )
            square = combined("+", combined("*", x, x), combined("*", y, y))
            return Quantity(f"sqrt({square.text})", Call("sqrt", square.tree), x.unit, x.place)
    return None


def doubled(one: Quantity) -> Quantity:
    """Twice a quantity."""
    tree = Product("*", Number(Fraction(2)), one.tree)
    return Quantity(f"2*({one.text})", tree, one.unit, one.place)


# --- tracks and belts ----------------------------------------------------------------------------


def read_tracks(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The tracks that the wheels of a link roll on, then the belts that run on them."""
    belts = (read_belt(each, measures) for each in tables(table, "belt"))
    return (*read_rolls(table, measures), *belts)


def read_rolls(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The tracks, straight or circular, that the wheels of a link roll on."""
    return tuple(read_rolling(each, measures) for each in tables(table, "rolls"))


def read_rolling(table: Table, measures: Measures) -> Rolling:
    """One track: ``{ on, through, angle, start, turns, side, link, wheels }``.

    A track on another wheel has no line.
    """
    on = link_name(table.at("on"), table.take("on"), measures.findings, TRACK) or FRAME
    through, angle = None, None
    if "through" in table or "angle" in table:
        through, angle = read_line(table, measures)
    start = by_link(table, "start", measures, measures.units["angle"])
    turns = by_link(table, "turns", measures, "")
    raw = table.take("side")
    side = SIDES.get(raw) if isinstance(raw, str) else None
    if raw is not None and side is None:
        table.wrong("side", shown(raw), message('"left" or "right"'))
    if raw is not None and "through" not in table:
        table.wrong("side", message("a side without through"), message("a straight track"))
    table.take("through"), table.take("angle")
    keeper = ""
    if (name := table.take("link")) is not None:
        keeper = link_name(table.at("link"), name, measures.findings) or ""
    wheels = read_pair(table, measures)
    if wheels is not None and through is not None:
        table.wrong("wheels", message("wheels beside through"), message("one of the two"))
    table.finish()
    return Rolling(on, through, angle, start, side or 1, turns, keeper=keeper, wheels=wheels)


def read_drums(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The bars that roll on wheels of the frame; ``start`` gives the angle of the bar.

    Relative to the bar, the wheel is then turned by the opposite angle.
    """
    found = []
    for rolling in read_rolls(table, measures):
        start = dict(rolling.start)
        if rolling.on in start and rolling.through is not None:
            start.setdefault(FRAME, start[rolling.on].negative())
        found.append(replace(rolling, start=start))
    return tuple(found)


def read_belt(table: Table, measures: Measures) -> Rolling:
    """One belt: ``{ on, crossed, wheels, start, turns }``, with its tension.

    ``wheels`` count from one.
    """
    on = link_name(table.at("on"), table.take("on"), measures.findings, OTHER) or FRAME
    crossed, wheels = table.flag("crossed"), read_pair(table, measures) or (0, 0)
    start = by_link(table, "start", measures, measures.units["angle"])
    turns = by_link(table, "turns", measures, "")
    belt = Belt(crossed, read_tension(table, measures))
    table.finish()
    return Rolling(on, None, None, start, 1, turns, belt, wheels=wheels)


def read_tension(table: Table, measures: Measures) -> StrandTension | None:
    """The tension that a belt states; None for a belt without one."""
    given = {key: raw for key in TENSIONS if (raw := table.take(key)) is not None}
    if not given:
        return None
    key = next(iter(given))
    place, findings = table.at(key), measures.findings
    if len(given) > 1:
        found = message("both {keys}", keys=joined(", ", given))
        findings.add(table.place, found, message("one of {keys}", keys=joined(", ", TENSIONS)))
    number = measures.number(place, given[key], measures.mechanical(TENSIONS[key]))
    least = 1 if key == "ratio" else 0
    value = number.number(measures.values)
    if value < least or (key == "ratio" and value == least):
        above = message("a number above 1")
        findings.add(place, shown(number.text), above if least else message("a number not below 0"))
    return StrandTension(key, number)


def read_pair(table: Table, measures: Measures) -> tuple[int, int] | None:
    """The indices of the two wheels of a contact, from ``wheels``; None where it is absent."""
    match raw := table.take("wheels"):
        case None:
            return None
        case [int(own), int(other)] if 0 < own <= MOST and 0 < other <= MOST:
            return own - 1, other - 1
    expected = message("[1, 2]: the wheel of this link and that of the other, counted from 1")
    table.wrong("wheels", shown(raw), expected)
    return None


def by_link(table: Table, key: str, measures: Measures, unit: str) -> dict[str, Quantity]:
    """A number for each link named in a table: an angle of ``start``, a count of ``turns``."""
    found: dict[str, Quantity] = {}
    inner = table.table(key)
    for link, raw in inner.raw.items():
        name = link_name(inner.at(link), link, measures.findings)
        number = measures.number(inner.at(link), raw, unit)
        if name is not None:
            found[name] = number
    return found


def check_centres(link: Link, place: str, findings: Findings) -> None:
    """Note wheels of a link whose centre is not a point of it."""
    for index, wheel in enumerate(link.wheels):
        where = numbered(f"{place}.wheel", index, len(link.wheels))
        if wheel.centre:
            known_point(
                wheel.centre, link.points, message("this link"), f"{where}.centre", findings
            )


def check_tracks(scene: Scene, link: Link, place: str, findings: Findings) -> None:
    """Note tracks and belts of a link that lack a wheel, or name unknown links or points."""
    tracks = [rolling for rolling in link.rolls if rolling.belt is None]
    belts = [rolling for rolling in link.rolls if rolling.belt is not None]
    for key, rollings in (("rolls", tracks), ("belt", belts)):
        for index, rolling in enumerate(rollings):
            where = numbered(f"{place}.{key}", index, len(rollings))
            check_rolling(scene, link, rolling, where, findings)
            check_pair(scene, link, rolling, where, findings)


def check_rolling(
    scene: Scene, link: Link, rolling: Rolling, place: str, findings: Findings
) -> None:
    """Note a track without a wheel or line, unknown links in it, and turns that are not whole."""
    check_guide(scene, link, rolling, place, findings)
    on = scene.links.get(rolling.on, scene.frame if rolling.on == FRAME else None)
    if not link.wheels:
        expected = message('wheel = {{ centre = "P", radius = … }}')
        hint: Hint = NO_WORDS
        if link.slides and on is not None and on.wheels and rolling.belt is None:
            hint = message(
                "if link {rack} is a rack, write rolls = {{ on = {quoted}, through = …, "
                "angle = … }} in {wheel}",
                rack=link.name,
                quoted=quoted(link.name),
                wheel=link_words(rolling.on),
            )
        findings.add(place, message("link {name} has no wheel", name=link.name), expected, hint)
    elif rolling.through is not None and rolling.belt is None and link.rim.inside:
        expected = message("a rim outside; of a hoop: wheels = [{{ …, inside = true }}, {{ … }}]")
        findings.add(
            place,
            message("the ring of {name} on a straight track", name=link_words(link.name)),
            expected,
        )
    if rolling.through is None and on is not None and not on.wheels and on is not link:
        expected = message("a wheel there, or through and angle for a straight track")
        if rolling.belt is not None:
            expected = message('a wheel there: wheel = {{ centre = "P", radius = … }}')
        wheels = [name for name, each in scene.links.items() if each.wheels and each is not link]
        hint = NO_WORDS
        if len(wheels) == 1:
            hint = Mend(f"on = {quoted(rolling.on)}", f"on = {quoted(wheels[0])}")
        found = message("{on} has no wheel to roll on", on=link_words(rolling.on))
        if rolling.belt is not None:
            found = message("{on} has no wheel to run on", on=link_words(rolling.on))
        findings.add(place, found, expected, hint)
    for name in rolling.start:
        known_link(scene, name, f"{place}.start.{name}", findings)
    for name, turns in rolling.turns.items():
        known_link(scene, name, f"{place}.turns.{name}", findings)
        number = turns.number(scene.values)
        if not isinstance(number, Fraction) or number.denominator != 1:
            findings.add(
                turns.place,
                message("{number} turns", number=shortest(number)),
                message("a whole number of turns"),
            )


def check_pair(scene: Scene, link: Link, rolling: Rolling, place: str, findings: Findings) -> None:
    """Note a contact of wheels that do not exist, and a belt on a ring."""
    on = scene.links.get(rolling.on, scene.frame if rolling.on == FRAME else None)
    if rolling.wheels is None or on is None:
        return
    for each, index in zip((link, on), rolling.wheels, strict=True):
        if each.wheels and index >= len(each.wheels):
            found = message(
                "wheel {index} of {name}, which has {count}",
                index=index + 1,
                name=link_words(each.name),
                count=len(each.wheels),
            )
            findings.add(
                f"{place}.wheels", found, message("a number up to {count}", count=len(each.wheels))
            )
        elif rolling.belt is not None and each.wheels and each.wheels[index].inside:
            found = message("the wheel of {name} is a ring", name=link_words(each.name))
            findings.add(place, found, message("a wheel with a rim outside, for a belt to run on"))


def check_driven(driver: Driver, link: Link, place: str, findings: Findings) -> None:
    """Note a driver that rolls a link without a straight track."""
    tracks = [rolling.on for rolling in link.rolls if rolling.through is not None]
    if driver.against in tracks:
        return
    if tracks:
        on, against = link_words(tracks[0]), link_words(driver.against)
        found = message(
            "link {name} rolls straight on {on}, not on {against}",
            name=link.name,
            on=on,
            against=against,
        )
        findings.add(place, found, message("against = {guides}", guides=quoted(tracks[0])))
    elif link.rolls:
        found = message("link {name} rolls on a wheel, which has no coordinate", name=link.name)
        findings.add(
            f"{place}.roll",
            found,
            message("turn = {name}, or a straight track", name=quoted(link.name)),
        )
    else:
        found = message("link {name} has no straight track to roll on", name=link.name)
        findings.add(
            f"{place}.roll", found, message("rolls = {{ on, through, angle }} in that link")
        )


def contact_letters(scene: Scene) -> dict[str, tuple[str, ...]]:
    """The letters of the contacts of each link that rolls, in the order written.

    A single contact has no number, so that T3, the point of link 3 at the contact T, is not
    mistaken for another contact. A letter that names a point of the scene, in either case, is not
    used.
    """
    total = sum(len(link.rolls) for link in scene.every_link)
    stem = free_stem(scene)
    numbers = iter(range(1, total + 1))
    return {
        link.name: tuple(f"{stem}{next(numbers)}" if total > 1 else stem for _ in link.rolls)
        for link in scene.every_link
        if link.rolls
    }


def free_stem(scene: Scene) -> str:
    """The first letter that no point of the scene has, alone or before a number."""
    names = {point.upper() for link in scene.every_link for point in link.points}
    taken = {name.rstrip("0123456789") for name in names}
    return next(s for s in chain(STEMS, ("T" * n for n in count(2))) if s not in taken)


def angle_less_cycles(scene: Scene, driver: Driver) -> Quantity:
    """The angle of a driver, without whole cycles of the wheels where it is many turns.

    The cycles are subtracted from the number as written, without rounding, so that a wheel's
    position is right after any number of turns. Angles in radians, or from roots or sines, are
    kept.
    """
    try:
        angle = driver.position.number(scene.values)
    except SceneError:
        return driver.position
    turns = cycle(scene)
    plain = isinstance(angle, Fraction) and driver.position.unit == "deg"
    if turns is None or not plain or abs(angle) <= 360 * MANY:
        return driver.position
    return driver.position.less(360 * turns * round(angle / (360 * turns)))


def cycle(scene: Scene) -> int | None:
    """The number of turns of any link after which all wheels are as before; None if unknown.

    A wheel that turns another in the ratio p : q is as before after p·q turns of either. A wheel on
    a straight track moves on with each turn and never returns.
    """
    ratios = list[Fraction]()
    for link in scene.every_link:
        for rolling in link.rolls:
            found = ratio(scene, link.name, rolling)
            if found is None:
                return None
            ratios.append(found)
    return prod(each.numerator * each.denominator for each in ratios)


def ratio(scene: Scene, name: str, rolling: Rolling) -> Fraction | None:
    """The ratio of two rolling wheels of fixed radii, if they are their links' only ones."""
    wheels = *scene.link(name).wheels, *scene.link(rolling.on).wheels
    if rolling.through is not None or len(wheels) != 2:
        return None
    radii = [wheel.radius for wheel in wheels if wheel.radius is not None]
    exact = [r for each in radii if not each.uses() and isinstance(r := each.number({}), Fraction)]
    return exact[0] / exact[1] if len(exact) == 2 else None
