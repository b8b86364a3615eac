"""Profiles: the edges by which links touch others, which are only drawn."""

from __future__ import annotations

from math import degrees

from graphkin.scene.findings import Findings, Table, numbered
from graphkin.scene.known_names import known_point, named, place_of
from graphkin.scene.measures import Measures
from graphkin.scene.model import At, Link, Profile, Scene
from graphkin.scene.phrases import point_name
from graphkin.scene.read_joints import tables

OTHERWISE = "a profile is an arc: it needs a radius"
"""The hint where the centre of a profile lies on it."""
FULL = 360
"""The whole circle of a profile, in degrees."""


def read_profiles(table: Table, measures: Measures) -> tuple[Profile, ...]:
    """The profiles of a link."""
    return tuple(read_profile(each, measures) for each in tables(table, "profiles"))


def read_profile(table: Table, measures: Measures) -> Profile:
    """One profile, ``{ about, through, arc, hollow }``; a point that cannot be read is empty."""
    about, through = (
        point_name(table.at(key), table.take(key), table.findings) or ""
        for key in ("about", "through")
    )
    arc = measures.angle(table.at("arc"), table.take("arc")) if "arc" in table else None
    hollow = table.flag("hollow")
    table.finish()
    return Profile(about, through, arc, hollow)


def check_profiles(scene: Scene, link: Link, findings: Findings) -> None:
    """Every profile is about a point of its link, through another place of the mechanism."""
    place = place_of(link.name)
    sound, points = not findings.inside(place), scene.points
    for index, profile in enumerate(link.profiles):
        where = numbered(f"{place}.profiles", index, len(link.profiles))
        about, through = profile.about, profile.through
        if about:
            known_point(about, link.points, named(link.name), f"{where}.about", findings)
        if through:
            known_point(through, points, "the mechanism", f"{where}.through", findings)
        if about and about == through:
            found, expected = f"about {about} and through it", "a point where it touches"
            findings.add(f"{where}.through", found, expected, OTHERWISE)
        elif sound and at_one_spot(scene, link, profile):
            found = f"{about} and {through} are written at one spot"
            findings.add(where, found, "a centre and another place", OTHERWISE)
        over = degrees(float(profile.arc.si(scene.values))) if profile.arc else FULL
        if not 0 < over <= FULL:
            expected = "more than 0° and at most 360°, the whole circle"
            findings.add(f"{where}.arc", f"an arc over {over:g}°", expected)


def at_one_spot(scene: Scene, link: Link, profile: Profile) -> bool:
    """Whether both points of a profile are written by the same coordinates of its link."""
    spots = [
        (placing.x.number(scene.values), placing.y.number(scene.values))
        for placing in link.placings
        if isinstance(placing, At) and placing.point in (profile.about, profile.through)
    ]
    return len(spots) == 2 and spots[0] == spots[1]
