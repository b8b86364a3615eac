"""The forces of a scene from its file: masses, gravity, loads and what [ask] wants of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.scene.findings import Table, listed, nearest, shown
from graphkin.scene.forces import Components, Forces, Load, Mass
from graphkin.scene.known_names import THE_MECHANISM, known_link, known_point
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, MASS_KEYS, Scene, link_words
from graphkin.scene.phrases import FRAME_WORD, link_name, point_name
from graphkin.scene.quantity import Quantity, exact
from graphkin.text.errors import message

GRAVITY = "9.81"
"""The acceleration of ``gravity = true``, m/s² downwards."""
MOST = 500


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
            expected = message("mass = … in kg, beside centre and inertia")
            findings.add(table.place, message("no mass"), expected)
        mass = measures.number(table.at("mass"), given["mass"] or 0, "kg")
        not_below_zero(mass, measures)
        centre = centre_of(table, given["centre"], scene, name)
        inertia = given["inertia"]
        read = None if inertia is None else measures.number(table.at("inertia"), inertia, "kg·m²")
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
    """``gravity = true`` or two components in m/s²."""
    raw = top.take("gravity")
    if raw is None or raw is False:
        return None
    if raw is True:
        return exact(0, "m/s²"), measures.number("gravity", f"-{GRAVITY}", "m/s²")
    return components(top, "gravity", raw, "m/s²", measures)


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


def loads(top: Table, scene: Scene, measures: Measures) -> Iterator[Load]:
    """The loads, from ``[[loads]]``."""
    raw = top.take("loads")
    if raw is None:
        return
    if not isinstance(raw, list) or len(raw) > MOST:
        expected = message("[[loads]] in double brackets, at most {most}", most=MOST)
        measures.findings.add("loads", shown(raw), expected)
        return
    for index, each in enumerate(raw):
        place = f"loads[{index}]"
        if not isinstance(each, dict):
            expected = message("a table with force and at, or moment and link")
            measures.findings.add(place, shown(each), expected)
        elif load := read_load(Table(place, each, measures.findings), scene, measures):
            yield load


def read_load(table: Table, scene: Scene, measures: Measures) -> Load | None:
    """One load; a force without ``link`` acts on the first moving link that has its point."""
    findings = table.findings
    at, link, force, moment = (table.take(key) for key in ("at", "link", "force", "moment"))
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
            findings.add(table.at("link"), found, message("a moving link"))
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
    read = None if force is None else components(table, "force", force, "N", measures)
    couple = None if moment is None else measures.number(table.at("moment"), moment, "N·m")
    if point and name:
        known_point(point, scene.link(name).points, link_words(name), table.at("at"), findings)
    return Load(name, point, read, couple) if name and point is not None else None


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
