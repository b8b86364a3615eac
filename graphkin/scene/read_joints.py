"""The guides of blocks and the profiles of links, with shared readers for lines and tables.

Touching profiles, replaced by an instantaneously equivalent link between centres of curvature.

Up to the second order, two profiles move like their circles of curvature. The centres of these
circles keep their distance, so a link between them (the associated mechanism) has the same
velocities and accelerations. The common normal runs along this link, and the contact is on it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees

from graphkin.scene.findings import Findings, Table, listed, nearest, numbered, one_or_many, shown
from graphkin.scene.measures import FloatText, Measures, Pair
from graphkin.scene.model import FRAME, At, Link, Profile, Scene, Slide, link_words
from graphkin.scene.phrases import (
    THE_MECHANISM,
    is_link_name,
    is_name,
    known_point,
    line_words,
    link_name,
    place_of,
    point_name,
)
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import message

MOST = 20
GUIDE = message("the link that carries the guide, 0 for the frame")


def tables(table: Table, key: str) -> list[Table]:
    """The tables of a key that may hold one table or a list of them."""
    raws = one_or_many(table.take(key))
    if len(raws) > MOST:
        table.wrong(
            key, message("a list of {count}", count=len(raws)), message("at most {most}", most=MOST)
        )
    found = []
    for index, raw in enumerate(raws[:MOST]):
        place = numbered(table.at(key), index, len(raws))
        if isinstance(raw, dict):
            found.append(Table(place, raw, table.findings))
        else:
            table.findings.add(place, shown(raw), message("a table {{ … }}, or a list of them"))
    return found


def read_slides(table: Table, measures: Measures) -> tuple[Slide, ...]:
    """The guides of a block."""
    return tuple(read_slide(each, measures) for each in tables(table, "slides"))


def read_slide(table: Table, measures: Measures) -> Slide:
    """One guide: ``{ on, through, angle, offset }`` or ``{ on, along = "P-Q", offset }``."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, GUIDE) or FRAME
    raw = table.take("along")
    through, angle, along = None, None, None
    if raw is None:
        through, angle = read_line(table, measures)
    else:
        along = line_words(table.at("along"), raw, measures.findings)
        for key in ("through", "angle"):
            if table.take(key) is not None:
                expected = message('either along = "P-Q", or through and angle')
                table.wrong(key, message("{key} beside along", key=key), expected)
    raw = table.take("offset")
    offset = measures.length(table.at("offset"), 0 if raw is None else raw)
    pin = table.flag("pin")
    table.finish()
    return Slide(on, through, angle, along, offset, pin)


def read_line(table: Table, measures: Measures) -> tuple[str | Pair | None, Quantity | None]:
    """A line, by a point on it and its angle to the x axis of its link."""
    raw, turned = table.take("through"), table.take("angle")
    if raw is None:
        expected = message('through = "P" or [x, y], with an angle, or along = "P-Q"')
        measures.findings.add(table.place, message("no through"), expected)
    elif turned is None:
        measures.findings.add(
            table.place, message("through without an angle"), message("angle = …")
        )
    through: str | Pair | None
    if isinstance(raw, list):
        through = measures.point(table.at("through"), raw)
    elif raw is None:
        through = None
    elif isinstance(raw, str) and not isinstance(raw, FloatText):
        through = point_name(table.at("through"), raw, measures.findings)
    else:
        through, expected = None, message('the name of a point, "P", or two coordinates [x, y]')
        table.wrong("through", shown(raw), expected)
    angle = None if turned is None else measures.angle(table.at("angle"), turned)
    return through, angle


OTHERWISE = message("a profile is an arc: it needs a radius")
"""The hint where the centre of a profile is on the profile."""
FULL = 360
"""The whole circle of a profile, in degrees."""


def read_profiles(table: Table, measures: Measures) -> tuple[Profile, ...]:
    """The profiles of a link."""
    return tuple(read_profile(each, measures) for each in tables(table, "profiles"))


def read_profile(table: Table, measures: Measures) -> Profile:
    """One profile, ``{ about, through, arc, hollow }``; a point that cannot be read is ""."""
    about, through = (
        point_name(table.at(key), table.take(key), table.findings) or ""
        for key in ("about", "through")
    )
    raw = table.take("arc")
    arc = None if raw is None else measures.angle(table.at("arc"), raw)
    hollow = table.flag("hollow")
    table.finish()
    return Profile(about, through, arc, hollow)


def check_profiles(scene: Scene, link: Link, findings: Findings) -> None:
    """Note profiles about unknown points, through their own centre, or with arcs out of range."""
    place = place_of(link.name)
    sound, points = not findings.inside(place), scene.points
    for index, profile in enumerate(link.profiles):
        where = numbered(f"{place}.profiles", index, len(link.profiles))
        about, through = profile.about, profile.through
        if about:
            known_point(about, link.points, link_words(link.name), f"{where}.about", findings)
        if through:
            known_point(through, points, THE_MECHANISM, f"{where}.through", findings)
        if about and about == through:
            found, expected = (
                message("about {about} and through it", about=about),
                message("a point where it touches"),
            )
            findings.add(f"{where}.through", found, expected, OTHERWISE)
        elif sound and at_one_spot(scene, link, profile):
            found = message(
                "{about} and {through} are written at one spot", about=about, through=through
            )
            findings.add(where, found, message("a centre and another place"), OTHERWISE)
        over = degrees(float(profile.arc.si(scene.values))) if profile.arc else FULL
        if not 0 < over <= FULL:
            expected = message("more than 0° and at most 360°, the whole circle")
            findings.add(f"{where}.arc", message("an arc over {over:g}°", over=over), expected)


def at_one_spot(scene: Scene, link: Link, profile: Profile) -> bool:
    """Whether both points of a profile are written with the same coordinates of its link."""
    spots = [
        (placing.x.number(scene.values), placing.y.number(scene.values))
        for placing in link.placings
        if isinstance(placing, At) and placing.point in (profile.about, profile.through)
    ]
    return len(spots) == 2 and spots[0] == spots[1]


OTHER = message("the link of the other profile, 0 for the frame")


def normals(
    written: Mapping[str, Table], frame: Table, links: Mapping[str, Link], measures: Measures
) -> Iterator[tuple[str, Table]]:
    """The links that replace touching profiles, each with a table from which it can be read.

    ``written`` are the tables of the moving links, ``links`` the links read from them.
    """
    taken = set(links)
    for own, table in written.items():
        for touch in tables(table, "touches"):
            found = normal(own, touch, frame, links, measures)
            if found is None:
                continue
            name, raw = found
            if name in taken:
                expected = message("another name: link = …")
                touch.wrong(
                    "link", message("link {called} is there already", called=name), expected
                )
                continue
            taken.add(name)
            yield name, Table(touch.place, raw, touch.findings)


def normal(
    own: str, table: Table, frame: Table, links: Mapping[str, Link], measures: Measures
) -> tuple[str, dict[str, object]] | None:
    """The name of the link along one common normal, and its lengths as a scene would write them."""
    findings = measures.findings
    on = link_name(table.at("on"), table.take("on"), findings, OTHER)
    centres = line_words(table.at("centres"), table.take("centres"), findings)
    inside = table.flag("inside")
    radii = two_radii(table, measures, inside=inside)
    raw = table.take("contact")
    name = table.take("link")
    table.finish()
    if on is None or centres is None or radii is None:
        return None
    owned = {own: list(links[own].points)} if own in links else {}
    owned |= {on: [point for key in frame.raw for point in key.split("-")]} if on == FRAME else {}
    owned |= {on: list(links[on].points)} if on in links else {}
    for end, link in zip(centres, (own, on), strict=True):
        if end not in owned.get(link, ()):
            found = message("{end} is no point of link {link}", end=end, link=link)
            hint = nearest(end, owned.get(link, ()))
            table.wrong("centres", found, listed(owned.get(link, ())), hint)
            return None
    contact = raw if isinstance(raw, str) else f"{centres[0]}{centres[1]}"
    called = str(name) if name is not None else f"n{own}_{on}"
    if not is_name(contact) or not is_link_name(called):
        findings.add(
            table.place,
            message("{contact}, {called}", contact=shown(contact), called=shown(called)),
            message("names of point and link"),
        )
        return None
    return called, between(centres, radii, contact, inside)


def two_radii(table: Table, measures: Measures, *, inside: bool) -> tuple[str, str] | None:
    """The radii of curvature of both profiles, as expressions.

    If one profile is inside the hollow of the other, the hollow has the larger radius.
    """
    raw = table.take("radii")
    place = table.at("radii")
    if not isinstance(raw, list) or len(raw) != 2:
        expected = message("two radii of curvature, such as [44, 16]")
        measures.findings.add(place, message("is missing") if raw is None else shown(raw), expected)
        return None
    before = len(measures.findings.problems)
    read = [
        measures.length(f"{place}[{index}]", each, positive=True) for index, each in enumerate(raw)
    ]
    if inside and len(measures.findings.problems) == before:
        own, hollow = (radius.number(measures.values) for radius in read)
        if own >= hollow:
            found = message(
                "the hollow's {hollow:g} is no more than this profile's {own:g}",
                hollow=float(hollow),
                own=float(own),
            )
            expected = message("the profile's radius, then the larger one of the hollow")
            hint = message("touches is written on the link that lies in the hollow")
            if own == hollow:
                hint = message(
                    "both have one centre: write a pin, and both arcs as profiles, the "
                    "hollow's with hollow = true"
                )
            measures.findings.add(place, found, expected, hint)
            return None
    return str(raw[0]), str(raw[1])


def between(
    centres: tuple[str, str], radii: tuple[str, str], contact: str, inside: bool
) -> dict[str, object]:
    """The lengths of a link from the first centre to the second, with the contact on its line.

    A profile inside the hollow of the other touches it beyond its own centre.
    """
    (first, second), (r, s) = centres, radii
    if inside:
        return {
            f"{second}-{first}": f"({s}) - ({r})",
            f"{first}-{contact}": r,
            contact: f"beyond {first} on {second}-{first}",
        }
    return {
        f"{first}-{second}": f"({r}) + ({s})",
        f"{first}-{contact}": r,
        contact: f"on {first}-{second}",
    }
