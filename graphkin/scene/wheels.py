"""Wheels: their data, the tracks and belts they run on, and the letters of their contacts."""

from __future__ import annotations

from fractions import Fraction
from itertools import chain, count
from math import prod

from msgspec.structs import replace

from graphkin.scene.expression import Number
from graphkin.scene.expression import Pair as Product
from graphkin.scene.findings import Findings, Table, numbered, shown
from graphkin.scene.known_names import check_guide, known_link, known_point, quoted
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Belt, Driver, Link, Rolling, Scene, Wheel, link_words
from graphkin.scene.phrases import SIDES, link_name, point_name
from graphkin.scene.quantity import Quantity, shortest
from graphkin.scene.read_joints import MOST, read_line, tables
from graphkin.text.errors import NO_WORDS, Hint, Mend, SceneError, message

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
    """One wheel: a centre with a radius, or with teeth and a module that give the radius."""
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
            measures.findings.add(
                table.at("module"), message("module beside radius"), message("one of the two")
            )
    elif teeth is not None and module is not None:
        radius = pitch_radius(teeth, module)
    else:
        found = message("no radius") if teeth is None else message("teeth without a module")
        hint = (
            NO_WORDS
            if teeth is None
            else message("a module at the top of the file is that of every wheel")
        )
        measures.findings.add(
            table.place, found, message("radius = …, or teeth = … and module = …"), hint
        )
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


def read_tracks(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The tracks that the wheels of a link roll on, then the belts that run on them."""
    belts = (read_belt(each, measures) for each in tables(table, "belt"))
    return (*read_rolls(table, measures), *belts)


def read_rolls(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The tracks, straight or circular, that the wheels of a link roll on."""
    return tuple(read_rolling(each, measures) for each in tables(table, "rolls"))


def read_rolling(table: Table, measures: Measures) -> Rolling:
    """One track: ``{ on, through, angle, start, turns, side, link }``.

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
        measures.findings.add(table.at("side"), shown(raw), message('"left" or "right"'))
    if raw is not None and "through" not in table:
        measures.findings.add(
            table.at("side"), message("a side without through"), message("a straight track")
        )
    table.take("through"), table.take("angle")
    keeper = ""
    if (name := table.take("link")) is not None:
        keeper = link_name(table.at("link"), name, measures.findings) or ""
    table.finish()
    return Rolling(on, through, angle, start, side or 1, turns, keeper=keeper)


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
    """One belt: ``{ on, crossed, wheels, start, turns }``; ``wheels`` count from one."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, OTHER) or FRAME
    crossed, raw = table.flag("crossed"), table.take("wheels")
    wheels = (1, 1)
    match raw:
        case [int(own), int(other)] if 0 < own <= MOST and 0 < other <= MOST:
            wheels = own, other
        case _ if raw is not None:
            expected = message(
                "[1, 2]: the wheel of this link and that of the other, counted from 1"
            )
            measures.findings.add(table.at("wheels"), shown(raw), expected)
    start = by_link(table, "start", measures, measures.units["angle"])
    turns = by_link(table, "turns", measures, "")
    table.finish()
    belt = Belt(crossed, (wheels[0] - 1, wheels[1] - 1))
    return Rolling(on, None, None, start, 1, turns, belt)


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
            check_belt(scene, link, rolling, where, findings)


def check_rolling(
    scene: Scene, link: Link, rolling: Rolling, place: str, findings: Findings
) -> None:
    """Note a track without a wheel or line, unknown links in it, and turns that are not whole."""
    check_guide(scene, link, rolling, place, findings)
    if not link.wheels:
        expected = message('wheel = {{ centre = "P", radius = … }}')
        findings.add(place, message("link {name} has no wheel", name=link.name), expected)
    elif rolling.through is not None and rolling.belt is None and link.rim.inside:
        expected = message("a rim outside; of a hoop: wheels = [{{ …, inside = true }}, {{ … }}]")
        findings.add(
            place,
            message("the ring of {name} on a straight track", name=link_words(link.name)),
            expected,
        )
    on = scene.links.get(rolling.on, scene.frame if rolling.on == FRAME else None)
    if rolling.through is None and on is not None and not on.wheels and on is not link:
        expected = message("a wheel there, or through and angle for a straight track")
        if rolling.belt is not None:
            expected = message('a wheel there: wheel = {{ centre = "P", radius = … }}')
        wheels = [name for name, each in scene.links.items() if each.wheels and each is not link]
        hint: Hint = NO_WORDS
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


def check_belt(scene: Scene, link: Link, rolling: Rolling, place: str, findings: Findings) -> None:
    """Note a belt on wheels that do not exist or have no outer rim."""
    on = scene.links.get(rolling.on, scene.frame if rolling.on == FRAME else None)
    if rolling.belt is None or on is None:
        return
    for each, index in zip((link, on), rolling.belt.wheels, strict=True):
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
        elif each.wheels and each.wheels[index].inside:
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
