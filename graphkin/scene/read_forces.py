"""The forces of a scene from its file: masses, gravity, loads and what [ask] wants of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import pairwise
from math import ceil, pi

from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.forces import ByDriver, Components, Directed, Forces, Load, Mass, Size, Spring
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, MASS_KEYS, Scene, link_words
from graphkin.scene.phrases import (
    FRAME_WORD,
    THE_MECHANISM,
    known_link,
    known_point,
    link_name,
    point_name,
)
from graphkin.scene.quantity import STANDARD_GRAVITY, Quantity, exact, size_in_si
from graphkin.text.errors import Message, message

GRAVITY = "9.81"
"""The acceleration of ``gravity = true``, m/s² downwards."""
MOST = 500
SENSES = {"along": 1, "against": -1}
"""The sense of a force beside the velocity of its point, by its word."""


def read_forces(top: Table, asked: Table, scene: Scene, measures: Measures) -> Forces | None:
    """The forces of a scene; None if it says nothing of forces. Problems are noted.

    Names are checked against the scene, whose links are already read.
    """
    read = Forces(
        masses=dict(masses(top, scene, measures)),
        gravity=gravity(top, measures),
        loads=tuple(loads(top, scene, measures)),
        reactions=reactions(asked, scene),
        balance=asked.flag("balance"),
        springs=tuple(springs(top, scene, measures)),
    )
    nothing = Forces(masses={}, gravity=None, loads=())
    return None if read == nothing else read


def masses(top: Table, scene: Scene, measures: Measures) -> Iterator[tuple[str, Mass]]:
    """The masses of links, as written."""
    findings, links = measures.findings, top.raw.get("links")
    frame = top.raw.get(FRAME_WORD)
    if isinstance(frame, dict):
        for key in filter(frame.__contains__, MASS_KEYS):
            place = f"{FRAME_WORD}.{key}"
            findings.add(place, message("the frame is at rest"), message("a moving link"))
    for name, raw in links.items() if isinstance(links, dict) else ():
        if name not in scene.links or not any(key in raw for key in MASS_KEYS):
            continue
        table = Table(f"links.{name}", raw, findings)
        given = {key: table.take(key) for key in MASS_KEYS}
        if given["mass"] is None:
            unit = measures.mechanical("kg")
            expected = message("mass = … in {unit}, beside centre and inertia", unit=unit)
            findings.add(table.place, message("no mass"), expected)
        mass = measures.number(table.at("mass"), given["mass"] or 0, measures.mechanical("kg"))
        not_below_zero(mass, measures)
        centre = centre_of(table, given["centre"], scene, name)
        inertia = given["inertia"]
        unit = measures.mechanical("kg·m²")
        read = None if inertia is None else measures.number(table.at("inertia"), inertia, unit)
        if read is not None:
            not_below_zero(read, measures)
        yield name, Mass(mass, centre, read)


def not_below_zero(read: Quantity, measures: Measures) -> None:
    """Note a mass or a moment of inertia below zero."""
    if read.number(measures.values) < 0:
        measures.findings.add(read.place, shown(read.text), message("a number not below 0"))


def centre_of(table: Table, raw: object, scene: Scene, name: str) -> str:
    """The centre of mass of a link; a link with one point has it there."""
    points = scene.link(name).points
    if raw is None and len(points) == 1:
        return points[0]
    found = point_name(table.at("centre"), raw, table.findings)
    if found is None:
        return ""
    known_point(found, points, link_words(name), table.at("centre"), table.findings)
    return found


def gravity(top: Table, measures: Measures) -> Components | None:
    """``gravity = true`` or two components, in m/s² or in the units of a scene in pounds."""
    raw = top.take("gravity")
    if raw is None or raw is False:
        return None
    unit = measures.mechanical("m/s²")
    g = Fraction(GRAVITY) if unit == "m/s²" else STANDARD_GRAVITY / size_in_si(unit)[0]
    if raw is True:
        return exact(0, unit), exact(-g, unit, "gravity")
    if not isinstance(raw, list):
        expected = message(
            "true for {g} {unit} downwards, or components [x, y]", g=f"{float(g):.7g}", unit=unit
        )
        top.findings.add("gravity", shown(raw), expected)
        return None
    return components(top, "gravity", raw, unit, measures)


def components(
    table: Table, key: str, raw: object, unit: str, measures: Measures
) -> Components | None:
    """Two components in a unit, x right and y up."""
    place = table.at(key)
    if not isinstance(raw, list) or len(raw) != 2:
        table.findings.add(place, shown(raw), message("two components [x, y] in {unit}", unit=unit))
        return None
    x, y = (measures.number(f"{place}[{n}]", each, unit) for n, each in enumerate(raw))
    return x, y


def tables_of(top: Table, key: str, expected: Message, findings: Findings) -> Iterator[Table]:
    """The tables of ``[[key]]``, whose other entries are noted as problems."""
    raw = top.take(key)
    if raw is None:
        return
    if not isinstance(raw, list) or len(raw) > MOST:
        many = message("[[{key}]] in double brackets, at most {most}", key=key, most=MOST)
        findings.add(key, shown(raw), many)
        return
    for index, each in enumerate(raw):
        place = f"{key}[{index}]"
        if not isinstance(each, dict):
            findings.add(place, shown(each), expected)
            continue
        yield Table(place, each, findings)


def loads(top: Table, scene: Scene, measures: Measures) -> Iterator[Load]:
    """The loads, from ``[[loads]]``."""
    expected = message("a table with force and at, or moment and link")
    for table in tables_of(top, "loads", expected, measures.findings):
        if load := read_load(table, scene, measures):
            yield load


def springs(top: Table, scene: Scene, measures: Measures) -> Iterator[Spring]:
    """The springs, from ``[[springs]]``."""
    findings = measures.findings
    expected = message("a table with between, stiffness and free")
    for table in tables_of(top, "springs", expected, findings):
        between, on = table.take("between"), table.take("links")
        stiffness = measures.number(
            table.at("stiffness"), table.take("stiffness"), measures.mechanical("N/m")
        )
        free = measures.length(table.at("free"), table.take("free"))
        not_below_zero(stiffness, measures)
        not_below_zero(free, measures)
        table.finish()
        ends = between.split("-") if isinstance(between, str) else []
        known = [point for link in scene.every_link for point in link.points]
        if len(ends) != 2 or ends[0] == ends[1]:
            expected = message('two points, such as "A-B"')
            table.wrong("between", shown(between), expected)
            continue
        for end in ends:
            known_point(end, known, THE_MECHANISM, table.at("between"), findings)
        if not {*ends} <= {*known}:
            continue
        owners = [owner_of(scene, end) for end in ends]
        if on is not None:
            given = on if isinstance(on, list) and len(on) == 2 else []
            owners = [link_name(table.at("links"), e, findings) or "" for e in given]
            if len(owners) != 2 or any(known_link_or_frame(scene, e) is None for e in owners):
                expected = message("the links that hold the two ends, such as [2, 0]")
                table.wrong("links", shown(on), expected)
                continue
        for end, owner in zip(ends, owners, strict=True):
            link = scene.frame if owner == FRAME else scene.link(owner)
            known_point(end, link.points, link_words(owner), table.at("between"), findings)
        yield Spring((ends[0], ends[1]), (owners[0], owners[1]), stiffness, free)


def known_link_or_frame(scene: Scene, name: str) -> str | None:
    """A link by its name, the frame included; None for another name."""
    return name if name == FRAME or name in scene.links else None


def owner_of(scene: Scene, point: str) -> str:
    """The frame if it has a point, else the first link that has it."""
    if point in scene.frame.points:
        return FRAME
    return next(link.name for link in scene.links.values() if point in link.points)


def read_load(table: Table, scene: Scene, measures: Measures) -> Load | None:
    """One load; a force without ``link`` acts on the first moving link that has its point."""
    findings = table.findings
    at, link, force, moment, over = map(table.take, ("at", "link", "force", "moment", "over"))
    table.finish()
    if force is None and moment is None:
        expected = message("a table with force and at, or moment and link")
        findings.add(table.place, message("no force and no moment"), expected)
    point = "" if at is None and force is None else point_name(table.at("at"), at, findings)
    name = ""
    if link is not None:
        name = link_name(table.at("link"), link, findings) or ""
        if name == FRAME:
            found = message("the frame, which is at rest")
            table.wrong("link", found, message("a moving link"))
            name = ""
        elif name and known_link(scene, name, table.at("link"), findings) is None:
            name = ""
    elif point:
        name = next((each.name for each in scene.links.values() if point in each.points), "")
        if not name:
            moving = [p for each in scene.links.values() for p in each.points]
            known_point(point, moving, THE_MECHANISM, table.at("at"), findings)
    elif at is None:
        findings.add(table.place, message("no link"), message("the link on which the moment acts"))
    read = None if force is None else force_of(table, force, over, scene, measures)
    couple = None
    if moment is not None:
        couple = size_of(
            table.at("moment"), moment, measures.mechanical("N·m"), (table, over), scene, measures
        )
    if point and name:
        known_point(point, scene.link(name).points, link_words(name), table.at("at"), findings)
    return Load(name, point, read, couple) if name and point is not None else None


def force_of(
    table: Table, raw: object, over: object, scene: Scene, measures: Measures
) -> Components | Directed | None:
    """A force: two components, or a table with its size and its direction."""
    if not isinstance(raw, dict):
        return components(table, "force", raw, measures.mechanical("N"), measures)
    own = Table(table.at("force"), raw, measures.findings)
    size, angle, motion = own.take("size"), own.take("angle"), own.take("motion")
    own.finish()
    read = size_of(own.at("size"), size, measures.mechanical("N"), (table, over), scene, measures)
    if motion is None:
        return Directed(read, measures.angle(own.at("angle"), angle))
    if motion not in SENSES or angle is not None:
        expected = message('an angle, or motion = "along" or "against"')
        own.wrong("motion", shown(motion), expected)
        return None
    return Directed(read, exact(0, "deg"), SENSES[str(motion)])


def size_of(
    place: str,
    raw: object,
    unit: str,
    beside: tuple[Table, object],
    scene: Scene,
    measures: Measures,
) -> Size:
    """A number, or a table ``[[coordinate, number], …]`` over a driver's coordinate."""
    if not isinstance(raw, list):
        return measures.number(place, raw, unit)
    table, over = beside
    findings, nothing = measures.findings, exact(0, unit, place)
    if not 2 <= len(raw) <= MOST or not all(isinstance(e, list) and len(e) == 2 for e in raw):
        expected = message("at least two points [coordinate, number], at most {most}", most=MOST)
        findings.add(place, shown(raw), expected)
        return nothing
    links = [driver.link for driver in scene.drivers]
    name = links[0] if over is None and links else link_name(table.at("over"), over, findings)
    if name not in links or (over is None and len(links) > 1):
        expected = message("over = the link of a driver, {names}", names=listed(links))
        table.wrong("over", shown(over), expected)
        return nothing
    number = links.index(name)
    turns = scene.drivers[number].kind == "turn"
    read = measures.angle if turns else measures.length
    places = tuple(read(f"{place}[{k}][0]", each[0]) for k, each in enumerate(raw))
    numbers = tuple(
        measures.number(f"{place}[{k}][1]", each[1], unit) for k, each in enumerate(raw)
    )
    known = [each.si({}) for each in places if not each.uses()]
    if len(known) < len(places) or any(a >= b for a, b in pairwise(known)):
        expected = message("numbers without parameters, each greater than the one before")
        findings.add(place, shown([each[0] for each in raw]), expected)
        return nothing
    if not turns:
        return ByDriver(number, places, numbers, None)
    wide = float(known[-1] - known[0]) / (2 * pi)
    turn = 360 if measures.units["angle"] == "deg" else None
    period = max(1, ceil(wide - 1e-9))
    whole = measures.angle(place, f"{2 * period}*pi" if turn is None else turn * period)
    return ByDriver(number, places, numbers, whole)


def reactions(asked: Table, scene: Scene) -> tuple[str, ...]:
    """The pins, blocks and wheels whose reactions are asked, without repetition."""
    raw, findings = asked.take("reactions"), asked.findings
    place = asked.at("reactions")
    if raw is None:
        return ()
    if not isinstance(raw, list):
        findings.add(place, shown(raw), message("a list, such as {what}", what='["A", "B"]'))
        return ()
    known = asked_names(scene)
    found = []
    for index, each in enumerate(raw):
        name = str(each) if isinstance(each, str | int) and not isinstance(each, bool) else ""
        if name in known:
            found.append(name)
            continue
        hint = nearest(name, known)
        findings.add(
            f"{place}[{index}]",
            shown(each),
            message("a pin, a block or a wheel, {names}", names=listed(known)),
            hint,
        )
    return tuple(dict.fromkeys(found))


def asked_names(scene: Scene) -> Mapping[str, None]:
    """The points that links share, and the links that slide, roll or follow a cam."""
    owners: dict[str, int] = {}
    for link in scene.every_link:
        for point in link.points:
            owners[point] = owners.get(point, 0) + 1
    pins = [point for point, count in owners.items() if count > 1]
    return dict.fromkeys(
        [*pins, *(e.name for e in scene.links.values() if e.slides or e.rolls or e.cam)]
    )
