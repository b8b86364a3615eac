"""Cams by their law: what is written of them, and the equivalent linkage that stands for each.

At an instant a cam moves its follower as the circle of its curvature would: a bar from the centre
of curvature to the roller's centre, or a block at the centre on the follower's face. The follower
slides on a guide of the frame, or swings about a pin of it.
"""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from graphkin.numbers.cam_motions import MOTIONS
from graphkin.scene.cam_tables import is_table, read_table
from graphkin.scene.findings import Table, listed, nearest, numbered, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Cam, CamLever, CamPiece, Conjugate, Link, Slide
from graphkin.scene.phrases import SIDES, is_link_name, is_name, link_name
from graphkin.scene.quantity import exact

TIPS = ("roller", "knife", "flat")
MOST_PIECES = 24
CAM = "the link of the cam"
OTHER_CAMS = (
    "any other cam is written for an instant: a straight flank as a guide on it, an arc with "
    "touches, by its centre of curvature"
)
"""What to write where the cam slides or stands still, or where the follower's guide moves."""


def with_cams(
    written: Mapping[str, Table], frame: Link, links: Mapping[str, Link], measures: Measures
) -> dict[str, Link]:
    """The links with their cams, and with the equivalent linkage of each."""
    found = dict(links)
    many = sum("cam" in table for table in written.values()) > 1
    count = 0
    for name, table in written.items():
        if "cam" not in table:
            continue
        raw = table.take("cam")
        if not isinstance(raw, dict):
            measures.findings.add(table.at("cam"), shown(raw), "a table { on = …, law = [ … ] }")
            continue
        count += 1
        own = Table(table.at("cam"), raw, measures.findings)
        cam = read_cam(name, own, frame, found, measures, f"K{count}" if many else "K")
        if cam is not None:
            join(found, name, cam, measures)
    return found


def join(links: dict[str, Link], follower: str, cam: Cam, measures: Measures) -> None:
    """Put the equivalent linkage of a cam among the links."""
    own, disc = links[follower], links[cam.on]
    links[follower] = replace(own, cam=cam)
    links[cam.on] = replace(disc, points=(*disc.points, cam.centre))
    if cam.is_flat:
        links[cam.link] = Link(cam.link, (cam.centre,), (), (face_of(follower, cam, measures),))
    else:
        links[cam.link] = Link(cam.link, (cam.centre, cam.point), ())


def face_of(follower: str, cam: Cam, measures: Measures) -> Slide:
    """The guide of the block that stands for a flat face: along a lever, or square to its guide."""
    if cam.lever:
        none = exact(0, measures.units["length"])
        return Slide(follower, None, None, (cam.lever.pin, cam.point), none)
    square = exact(90, "deg") if measures.units["angle"] == "deg" else measures.angle("", "pi/2")
    return Slide(follower, cam.point, square, None, exact(0, measures.units["length"]))


def read_cam(
    follower: str,
    table: Table,
    frame: Link,
    links: Mapping[str, Link],
    measures: Measures,
    letter: str,
) -> Cam | None:
    """One cam, as ``{ on, tip, base, roller, law, start, … }``; None where none
    can be."""
    findings = measures.findings
    before = len(findings.problems)
    swings = not links[follower].slides
    on = link_name(table.at("on"), table.take("on"), findings, CAM)
    tip = choice(table, "tip", TIPS)
    base = measures.length(table.at("base"), table.take("base"), positive=True)
    raw = table.take("roller")
    if tip == "roller" and raw is None:
        findings.add(table.at("roller"), "is missing", "the radius of the roller")
    elif tip != "roller" and raw is not None:
        findings.add(table.at("roller"), f"a roller on a {tip} follower", 'tip = "roller"')
    if tip == "roller" and raw is not None:
        roller = measures.length(table.at("roller"), raw, positive=True)
    else:
        roller = exact(0, measures.units["length"])
    law = read_law(table, measures, swings=swings)
    turned = table.take("start")
    start = measures.angle(table.at("start"), 0 if turned is None else turned)
    sense = -1 if table.flag("clockwise") else 1
    centre = table.text("centre", letter)
    name = table.text("link", next_name(links))
    found = lever_of(follower, tip, table, frame, links, measures) if swings else None
    first = found[0] if found else next(iter(links[follower].points), "")
    conjugate = conjugate_of(follower, first, table, frame, links, measures)
    table.finish()
    if not swings:
        check_guide(follower, links, table)
    pivot = pivot_of(follower, on, table, frame, links)
    if not is_name(centre) or any(centre in link.points for link in (frame, *links.values())):
        taken = f"{shown(centre)} for the centre of curvature"
        findings.add(table.at("centre"), taken, "the name of a new point")
    if not is_link_name(name) or name in links:
        findings.add(table.at("link"), f"{shown(name)}", "the name of a new link")
    if len(findings.problems) > before or on is None:
        return None
    point, lever = found or (links[follower].points[0], None)
    if lever and lever.pin == pivot:
        findings.add(table.at("on"), f"both links turn about {pivot}", "a cam on another pin")
        return None
    parts = on, pivot, tip, base, roller, law, start, sense, centre, name, point, lever
    return Cam(*parts, conjugate)


def conjugate_of(
    follower: str,
    first: str,
    table: Table,
    frame: Link,
    links: Mapping[str, Link],
    measures: Measures,
) -> Conjugate | None:
    """A second roller, ``conjugate = { at, roller }``, about another point than the ``first``."""
    raw = table.take("conjugate")
    if raw is None:
        return None
    findings, place = measures.findings, table.at("conjugate")
    if not isinstance(raw, dict):
        findings.add(place, shown(raw), "a table { at = …, roller = … }")
        return None
    own = Table(place, raw, findings)
    at = own.text("at", "")
    roller = measures.length(own.at("roller"), own.take("roller"), positive=True)
    own.finish()
    free = [p for p in links[follower].points if p != first and p not in frame.points]
    if at not in free:
        findings.add(own.at("at"), shown(at), listed(free) or "another point of the follower")
        return None
    return Conjugate(at, roller)


def next_name(links: Mapping[str, Link]) -> str:
    """A name for an equivalent link: the next number after the others', or a letter of its own."""
    if all(name.isdigit() for name in links):
        return str(max(map(int, links)) + 1)
    letters = ("e", *(f"e{number}" for number in range(2, len(links) + 2)))
    return next(letter for letter in letters if letter not in links)


def choice(table: Table, key: str, choices: tuple[str, ...]) -> str:
    """One of some words."""
    raw = table.take(key)
    if isinstance(raw, str) and raw in choices:
        return raw
    found = "is missing" if raw is None else shown(raw)
    hint = nearest(raw, choices) if isinstance(raw, str) else ""
    table.findings.add(table.at(key), found, listed(choices), hint)
    return choices[0]


def lever_of(
    follower: str,
    tip: str,
    table: Table,
    frame: Link,
    links: Mapping[str, Link],
    measures: Measures,
) -> tuple[str, CamLever] | None:
    """The tip of a follower that is pinned to the frame, and how it swings."""
    own, findings = links[follower], measures.findings
    pins = [point for point in own.points if point in frame.points]
    tips = [point for point in own.points if point not in frame.points]
    if len(pins) != 1 or not tips:
        found = f"link {follower} neither slides on a guide of the frame nor swings about a pin"
        expected = "slides = { on = 0, … }, or one point of the frame and the tip as the next point"
        findings.add(table.place, found, expected)
        table.take("side"), table.take("face")
        return None
    side = choice(table, "side", tuple(SIDES))
    raw = table.take("face")
    if raw is not None and tip != "flat":
        findings.add(table.at("face"), f"a face on a {tip} follower", 'tip = "flat"')
    face = measures.length(table.at("face"), 0 if raw is None else raw)
    return tips[0], CamLever(pins[0], SIDES[side], face)


def check_guide(follower: str, links: Mapping[str, Link], table: Table) -> None:
    """A follower that slides is a block on one guide of the frame."""
    own = links[follower]
    if len(own.slides) != 1 or own.slides[0].on != FRAME or not own.points:
        found = f"link {follower} does not slide on a guide of the frame"
        expected = "a follower with slides = { on = 0, … }, its first point the roller's centre"
        table.findings.add(table.place, found, expected, "" if not own.slides else OTHER_CAMS)


def pivot_of(
    follower: str, on: str | None, table: Table, frame: Link, links: Mapping[str, Link]
) -> str:
    """The pin of the cam on the frame."""
    findings = table.findings
    if on is None:
        return ""
    if on not in links or on == follower:
        expected = listed(name for name in links if name != follower)
        hint = OTHER_CAMS if on == FRAME else ""
        findings.add(table.at("on"), f"link {on}", f"the link of the cam: {expected}", hint)
        return ""
    pivots = [point for point in links[on].points if point in frame.points]
    if len(pivots) != 1:
        found = f"link {on} has {len(pivots)} points of the frame"
        findings.add(table.at("on"), found, "a cam on one pin of the frame", OTHER_CAMS)
        return ""
    return pivots[0]


def read_law(table: Table, measures: Measures, *, swings: bool) -> tuple[CamPiece, ...]:
    """The pieces of a law: they follow one another to a whole turn and come back to nought."""
    findings, raw, place = measures.findings, table.take("law"), table.at("law")
    if isinstance(raw, list) and is_table(raw):
        return read_table(place, raw, measures, swings=swings)
    if not isinstance(raw, list) or not 0 < len(raw) <= MOST_PIECES:
        found = "is missing" if raw is None else shown(raw)
        expected = f"at most {MOST_PIECES} pieces: [ {{ to = 120, rise = 20, motion = … }}, … ]"
        findings.add(place, found, expected)
        return ()
    pieces, bad = [], len(findings.problems)
    for index, each in enumerate(raw):
        where = numbered(place, index, len(raw))
        if isinstance(each, dict):
            pieces.append(read_piece(Table(where, each, findings), measures, swings=swings))
        else:
            findings.add(where, shown(each), "a table { to = …, rise = …, motion = … }")
    if len(findings.problems) > bad:
        return ()
    check_law(place, pieces, measures)
    return tuple(pieces)


def read_piece(table: Table, measures: Measures, *, swings: bool) -> CamPiece:
    """One piece, ``{ to, rise, motion }``; without a rise it is a dwell, a lever's is an angle."""
    to = measures.angle(table.at("to"), table.take("to"))
    raw, motion = table.take("rise"), table.take("motion")
    reading = measures.angle if swings else measures.length
    rise = reading(table.at("rise"), 0 if raw is None else raw)
    table.finish()
    if raw is None and motion is None:
        return CamPiece(to, rise, "uniform")
    if not isinstance(motion, str) or motion not in MOTIONS:
        found = "is missing" if motion is None else shown(motion)
        hint = nearest(motion, MOTIONS) if isinstance(motion, str) else ""
        table.findings.add(table.at("motion"), found, listed(MOTIONS), hint)
        motion = "uniform"
    if raw is None:
        hint = "a dwell has neither rise nor motion"
        table.findings.add(table.at("rise"), "is missing", "how far it lifts", hint)
    return CamPiece(to, rise, motion)


def check_law(place: str, pieces: list[CamPiece], measures: Measures) -> None:
    """Angles grow to a whole turn, and the follower comes back."""
    values, findings = measures.values, measures.findings
    unit = measures.units["angle"]
    low, lift = 0.0, 0.0
    for index, piece in enumerate(pieces):
        to = float(piece.to.number(values))
        if to <= low:
            found = f"{to:g} after {low:g}"
            findings.add(f"{numbered(place, index, len(pieces))}.to", found, "angles that grow")
        low, lift = to, lift + float(piece.rise.number(values))
        if lift < -1e-9 * abs(float(piece.rise.number(values))):
            where = f"{numbered(place, index, len(pieces))}.rise"
            found = f"the follower stands {-lift:g} below where the law begins"
            hint = "the base circle is the smallest: let the law begin at its lowest place"
            findings.add(where, found, "0 or more", hint)
    whole = 360.0 if unit == "deg" else 6.283185307179586
    if abs(low - whole) > 1e-9 * whole:
        findings.add(place, f"ends at {low:g}", '360 (in rad "2*pi")', "a cam turns round")
    size = max(abs(float(piece.rise.number(values))) for piece in pieces)
    if abs(lift) > 1e-9 * size:
        found = f"the rises add up to {lift:g}"
        findings.add(place, found, "0: after a whole turn the follower stands as before")
