"""Touching profiles, replaced by an instantaneously equivalent link between centres of curvature.

Up to the second order, two profiles move like their circles of curvature. The centres of these
circles keep their distance, so a link between them (the associated mechanism) has the same
velocities and accelerations. The common normal runs along this link, and the contact is on it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.scene.findings import Table, listed, nearest, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Link
from graphkin.scene.phrases import is_link_name, is_name, line_words, link_name
from graphkin.scene.read_joints import tables
from graphkin.text.errors import message

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
                touch.findings.add(
                    touch.at("link"),
                    message("link {called} is there already", called=name),
                    expected,
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
    owned |= {on: points_of(frame)} if on == FRAME else {}
    owned |= {on: list(links[on].points)} if on in links else {}
    for end, link in zip(centres, (own, on), strict=True):
        if end not in owned.get(link, ()):
            found = message("{end} is no point of link {link}", end=end, link=link)
            hint = nearest(end, owned.get(link, ()))
            findings.add(table.at("centres"), found, listed(owned.get(link, ())), hint)
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


def points_of(table: Table) -> list[str]:
    """The points named in the keys of a link's table."""
    return [point for key in table.raw for point in key.split("-")]
