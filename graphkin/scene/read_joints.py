"""The guides of blocks and the profiles of links, with shared readers for lines and tables."""

from __future__ import annotations

from math import degrees

from graphkin.scene.findings import Findings, Table, numbered, one_or_many, shown
from graphkin.scene.known_names import THE_MECHANISM, known_point, place_of
from graphkin.scene.measures import FloatText, Measures, Pair
from graphkin.scene.model import FRAME, At, Link, Profile, Scene, Slide, link_words
from graphkin.scene.phrases import line_words, link_name, point_name
from graphkin.scene.quantity import Quantity
from graphkin.text.errors import message

MOST = 20
GUIDE = message("the link that carries the guide, 0 for the frame")


def tables(table: Table, key: str) -> list[Table]:
    """The tables of a key that may hold one table or a list of them."""
    raws = one_or_many(table.take(key))
    if len(raws) > MOST:
        table.findings.add(
            table.at(key),
            message("a list of {count}", count=len(raws)),
            message("at most {most}", most=MOST),
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
                measures.findings.add(
                    table.at(key), message("{key} beside along", key=key), expected
                )
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
        measures.findings.add(table.at("through"), shown(raw), expected)
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
