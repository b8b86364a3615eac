"""Cams by their law: how they are written, and the equivalent linkage of each.

At an instant a cam moves its follower like the circle of its curvature. That circle acts through a
bar from the centre of curvature to the roller's centre. For a flat face, it acts through a block at
the centre of curvature on the face. The follower slides on a guide of the link that carries the
cam, or swings about a pin of it. That link is the frame, or an arm that turns about a cam at rest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import chain, count
from typing import NamedTuple

from msgspec.structs import replace

from graphkin.numbers.cam_motions import MOTIONS
from graphkin.scene.expression import Number, Pair, Tree
from graphkin.scene.findings import Table, listed, numbered, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Cam, CamLever, CamPiece, Conjugate, Link, Slide, link_words
from graphkin.scene.phrases import SIDES, is_link_name, is_name, link_name, next_name
from graphkin.scene.quantity import Quantity, exact
from graphkin.text.errors import Written, either, message

LEAST_POINTS = 4
MOST_POINTS = 72
TABLE = "table"


def is_table(raw: object) -> bool:
    """Whether a law is written as a table: a list of pairs."""
    return isinstance(raw, list) and bool(raw) and all(isinstance(each, list) for each in raw)


def read_table(
    place: str, raw: Sequence[object], measures: Measures, *, swings: bool
) -> tuple[CamPiece, ...]:
    """The cubics through points ``[angle, lift]`` of a table.

    The first point is [0, 0]. Angles increase up to the end of the turn, which is not repeated.
    """
    findings, before = measures.findings, len(measures.findings.problems)
    if not LEAST_POINTS <= len(raw) <= MOST_POINTS:
        expected = message(
            "{least_points} to {most} points [angle, lift]",
            least_points=LEAST_POINTS,
            most=MOST_POINTS,
        )
        findings.add(place, message("{count} points", count=len(raw)), expected)
        return ()
    lifted = measures.angle if swings else measures.length
    angles, lifts = list[Fraction](), list[Quantity]()
    for index, pair in enumerate(raw):
        where = numbered(place, index, len(raw))
        if not isinstance(pair, list) or len(pair) != 2:
            findings.add(where, shown(pair), message("two numbers [angle, lift]"))
            continue
        read, lift = measures.angle(where, pair[0]), lifted(where, pair[1])
        if read.uses():
            findings.add(where, shown(pair), message("an angle without parameters"))
            continue
        angle = Fraction(read.number({}))
        if angles and angle <= angles[-1]:
            found = message("{to:g} after {low:g}", to=float(angle), low=float(angles[-1]))
            findings.add(where, found, message("angles that grow"))
        if lift.number(measures.values) < 0:
            hint = message(
                "the base circle is the smallest: let the table begin at the lowest place"
            )
            findings.add(where, shown(pair), message("a lift of 0 or more"), hint)
        angles.append(angle)
        lifts.append(lift)
    if len(findings.problems) > before:
        return ()
    whole = Fraction(360) if measures.units["angle"] == "deg" else None
    if angles[0] != 0 or not lifts[0].is_zero():
        findings.add(numbered(place, 0, len(raw)), shown(raw[0]), message("[0, 0]"))
    if whole is None:
        findings.add(
            place, message("a table with angles in rad"), message('units = {{ angle = "deg", … }}')
        )
    elif angles[-1] >= whole:
        hint = message("after a whole turn the table begins again")
        findings.add(
            numbered(place, len(raw) - 1, len(raw)), shown(raw[-1]), message("less than 360"), hint
        )
    if len(findings.problems) > before or whole is None:
        return ()
    return cubics(angles, lifts, whole, measures.units["angle" if swings else "length"])


def cubics(
    angles: Sequence[Fraction], lifts: Sequence[Quantity], whole: Fraction, unit: str
) -> tuple[CamPiece, ...]:
    """The pieces of the spline through the points, with lifts in ``unit``.

    The spline is linear in the lifts. Each lift with parameters adds its share as an expression.
    """
    spans = [b - a for a, b in zip(angles, [*angles[1:], whole], strict=True)]
    known = [Fraction(0) if lift.uses() else Fraction(lift.number({})) for lift in lifts]
    plain = shares(spans, known)
    open_ = [(i, lift.tree) for i, lift in enumerate(lifts) if lift.uses()]
    added = [(shares(spans, [Fraction(i == k) for k in range(len(lifts))]), t) for i, t in open_]
    found = []
    for i, end in enumerate([*angles[1:], whole]):
        rise, begin, finish = (
            summed(plain[i][k], [(each[i][k], tree) for each, tree in added], unit)
            for k in range(3)
        )
        found.append(CamPiece(exact(end, "deg"), rise, TABLE, (begin, finish)))
    return tuple(found)


def shares(spans: Sequence[Fraction], lifts: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
    """For each piece, its rise and its slopes at both ends times its angle."""
    rises = [b - a for a, b in zip(lifts, [*lifts[1:], lifts[0]], strict=True)]
    slopes = periodic_slopes(spans, rises)
    ends = zip(slopes, [*slopes[1:], slopes[0]], spans, strict=True)
    pairs = [(begin * span, finish * span) for begin, finish, span in ends]
    return [(rise, *pair) for rise, pair in zip(rises, pairs, strict=True)]


def summed(plain: Fraction, parts: Sequence[tuple[Fraction, Tree]], unit: str) -> Quantity:
    """A number plus multiples of expressions, as one quantity."""
    tree: Tree = Number(plain)
    for times, each in parts:
        if times:
            tree = Pair("+", tree, Pair("*", Number(times), each))
    return exact(plain, unit) if tree == Number(plain) else Quantity("", tree, unit)


def periodic_slopes(spans: Sequence[Fraction], rises: Sequence[Fraction]) -> list[Fraction]:
    """The derivatives at the points for which the second derivative is continuous.

    The cyclic system is solved without its corners, with a correction (Sherman and Morrison).
    """
    count = len(spans)
    near = [1 / span for span in spans]  # between point i and the next
    steep = [3 * rise / span**2 for rise, span in zip(rises, spans, strict=True)]
    right = [steep[i - 1] + steep[i] for i in range(count)]
    middle = [2 * (near[i - 1] + near[i]) for i in range(count)]
    corner = near[-1]
    middle[0] -= corner
    middle[-1] -= corner
    plain = tridiagonal(middle, near[:-1], right)
    ends = [Fraction(0)] * count
    ends[0] = ends[-1] = corner
    bent = tridiagonal(middle, near[:-1], ends)
    share = (plain[0] + plain[-1]) / (1 + bent[0] + bent[-1])
    return [one - share * other for one, other in zip(plain, bent, strict=True)]


def tridiagonal(
    middle: Sequence[Fraction], beside: Sequence[Fraction], right: Sequence[Fraction]
) -> list[Fraction]:
    """The solution of a symmetric tridiagonal system."""
    pivots, sides = [middle[0]], [right[0]]
    for i in range(1, len(middle)):
        factor = beside[i - 1] / pivots[-1]
        pivots.append(middle[i] - factor * beside[i - 1])
        sides.append(right[i] - factor * sides[-1])
    found = [sides[-1] / pivots[-1]]
    for i in range(len(middle) - 2, -1, -1):
        found.append((sides[i] - beside[i] * found[-1]) / pivots[i])
    return found[::-1]


# --- cams by their law ----------------------------------------------------------------------------


TIPS = ("roller", "knife", "flat")
MOST_PIECES = 24
CAM = message("the link of the cam")
CARRIED = message("a cam pinned to the link that carries its follower, or sliding on it")
OTHER_CAMS = message(
    "a cam whose follower is joined to other links than it is written for an instant: "
    "a straight flank as a guide on it, an arc with touches, by its centre of curvature"
)
"""What to write where no link carries both the cam and its follower."""


class Seat(NamedTuple):
    """The joint of a cam to the link ``carrier`` that guides its follower or carries its pin.

    The cam turns about its point ``pivot``, or slides along a guide, with ``pivot`` as a point of
    it.
    """

    carrier: str
    pivot: str
    slides: bool


def with_cams(
    written: Mapping[str, Table], frame: Link, links: Mapping[str, Link], measures: Measures
) -> tuple[Link, dict[str, Link]]:
    """The frame and the links with their cams, and with the equivalent linkage of each cam."""
    found = {FRAME: frame, **links}
    many = sum("cam" in table for table in written.values()) > 1
    count = 0
    for name, table in written.items():
        if "cam" not in table:
            continue
        raw = table.take("cam")
        if not isinstance(raw, dict):
            table.wrong("cam", shown(raw), message("a table {{ on = …, law = [ … ] }}"))
            continue
        count += 1
        own = Table(table.at("cam"), raw, measures.findings)
        cam = read_cam(name, own, found, measures, f"K{count}" if many else "K")
        if cam is not None:
            join(found, name, cam, measures)
    return found.pop(FRAME), found


def join(links: dict[str, Link], follower: str, cam: Cam, measures: Measures) -> None:
    """Add the equivalent linkage of a cam to the links."""
    own, disc = links[follower], links[cam.on]
    links[follower] = replace(own, cam=cam)
    links[cam.on] = replace(disc, points=(*disc.points, cam.centre))
    if cam.is_flat:
        links[cam.link] = Link(cam.link, (cam.centre,), (), (face_of(follower, cam, measures),))
    else:
        links[cam.link] = Link(cam.link, (cam.centre, cam.point), ())


def face_of(follower: str, cam: Cam, measures: Measures) -> Slide:
    """The guide of the block that replaces a flat face: along a lever, or normal to its guide."""
    if cam.lever:
        none = exact(0, measures.units["length"])
        return Slide(follower, None, None, (cam.lever.pin, cam.point), none)
    square = exact(90, "deg") if measures.units["angle"] == "deg" else measures.angle("", "pi/2")
    return Slide(follower, cam.point, square, None, exact(0, measures.units["length"]))


def read_cam(
    follower: str, table: Table, links: Mapping[str, Link], measures: Measures, letter: str
) -> Cam | None:
    """One cam, as ``{ on, tip, base, roller, law, start, … }``; None if it is not valid."""
    findings = measures.findings
    before = len(findings.problems)
    on = link_name(table.at("on"), table.take("on"), findings, CAM)
    swings = on is None or is_lever(follower, on, links)
    seat = seat_of(follower, on, table, links) if on is not None else None
    slides = seat is not None and seat.slides
    tip = table.choice("tip", TIPS)
    if tip == "flat" and slides:
        hint = message(
            "a plate lifts a roller or a knife, and a straight flank under a face is a guide on it"
        )
        table.wrong("tip", message("a flat face on a plate that slides"), listed(TIPS[:2]), hint)
    base = measures.length(table.at("base"), table.take("base"), positive=True)
    raw = table.take("roller")
    if tip == "roller" and raw is None:
        table.wrong("roller", message("is missing"), message("the radius of the roller"))
    elif tip != "roller" and raw is not None:
        said, change = message("a roller on a {tip} follower", tip=tip), Written('"roller"', "tip")
        table.wrong("roller", said, message('tip = "roller"'), changes=(change,))
    if tip == "roller" and raw is not None:
        roller = measures.length(table.at("roller"), raw, positive=True)
    else:
        roller = exact(0, measures.units["length"])
    law = read_law(table, measures, swings=swings, slides=slides)
    turned = table.take("start")
    counted = measures.length if slides else measures.angle
    start = counted(table.at("start"), 0 if turned is None else turned)
    sense = -1 if table.flag("backward" if slides else "clockwise") else 1
    centre = table.text("centre", free_name(letter, links))
    name = table.text("link", next_name([each for each in links if each != FRAME]))
    found = lever_of(follower, tip, seat, table, links, measures) if swings else None
    first = found[0] if found else next(iter(links[follower].points), "")
    held = links[seat.carrier].points if seat else ()
    conjugate = conjugate_of(follower, first, held, table, links, measures)
    if seat is None:
        table.flag("backward")
    table.finish()
    if not is_name(centre) or any(centre in link.points for link in links.values()):
        taken = message("{centre} for the centre of curvature", centre=shown(centre))
        table.wrong("centre", taken, message("the name of a new point"))
    if not is_link_name(name) or name in links:
        table.wrong("link", message("{name}", name=shown(name)), message("the name of a new link"))
    if len(findings.problems) > before or on is None or seat is None:
        return None
    point, lever = found or (links[follower].points[0], None)
    if lever and lever.pin == seat.pivot:
        table.wrong(
            "on",
            message("both links turn about {pivot}", pivot=seat.pivot),
            message("a cam on another pin"),
        )
        return None
    parts = on, seat.pivot, tip, base, roller, law, start, sense, centre, name, point, lever
    return Cam(*parts, conjugate, seat.carrier, seat.slides)


def free_name(letter: str, links: Mapping[str, Link]) -> str:
    """A letter for the centre of curvature, or K with a number if a point or link has that name."""
    taken = {*links, *(point for link in links.values() for point in link.points)}
    names = chain([letter], (f"K{number}" for number in count(1)))
    return next(name for name in names if name not in taken)


def conjugate_of(
    follower: str,
    first: str,
    held: Sequence[str],
    table: Table,
    links: Mapping[str, Link],
    measures: Measures,
) -> Conjugate | None:
    """A second roller, ``conjugate = { at, roller }``, about a further point of the follower.

    The point must be neither ``first`` nor one of ``held``.
    """
    raw = table.take("conjugate")
    if raw is None:
        return None
    findings, place = measures.findings, table.at("conjugate")
    if not isinstance(raw, dict):
        findings.add(place, shown(raw), message("a table {{ at = …, roller = … }}"))
        return None
    own = Table(place, raw, findings)
    at = own.text("at", "")
    roller = measures.length(own.at("roller"), own.take("roller"), positive=True)
    own.finish()
    free = [p for p in links[follower].points if p != first and p not in held]
    if at not in free:
        own.wrong("at", shown(at), listed(free) or message("another point of the follower"))
        return None
    return Conjugate(at, roller)


def lever_of(
    follower: str,
    tip: str,
    seat: Seat | None,
    table: Table,
    links: Mapping[str, Link],
    measures: Measures,
) -> tuple[str, CamLever] | None:
    """The tip of a follower that is pinned to the carrier, and how it swings."""
    own, findings = links[follower], measures.findings
    held = links[seat.carrier].points if seat else ()
    pins = [point for point in own.points if point in held]
    tips = [point for point in own.points if point not in held]
    if seat is None:
        table.take("side"), table.take("face")
        return None
    if len(pins) != 1 or not tips:
        found = message(
            "link {follower} has {count} pins on {carrier}",
            follower=follower,
            count=len(pins),
            carrier=link_words(seat.carrier),
        )
        expected = message("one, and the tip as another of its points")
        findings.add(table.place, found, expected)
        table.take("side"), table.take("face")
        return None
    side = table.choice("side", tuple(SIDES))
    raw = table.take("face")
    if raw is not None and tip != "flat":
        found, change = message("a face on a {tip} follower", tip=tip), Written('"flat"', "tip")
        table.wrong("face", found, message('tip = "flat"'), changes=(change,))
    face = measures.length(table.at("face"), 0 if raw is None else raw)
    return tips[0], CamLever(pins[0], SIDES[side], face)


def pinned_to(follower: str, on: str, links: Mapping[str, Link]) -> list[str]:
    """The links, except the cam's, to which a follower is pinned."""
    own = {*links[follower].points}
    beside = (name for name in links if name not in (on, follower))
    return [name for name in beside if own & {*links[name].points}]


def is_lever(follower: str, on: str, links: Mapping[str, Link]) -> bool:
    """Whether a follower swings about a pin: it does not slide, or slides off the cam's carrier."""
    own = links[follower]
    if not own.slides or on not in links:
        return not own.slides
    slid = {slide.on for slide in own.slides}
    if any(name in links and name != on and seated(on, name, links) for name in slid):
        return False
    held = (name for name in pinned_to(follower, on, links) if name not in slid)
    return any(seated(on, name, links) for name in held)


def seated(on: str, carrier: str, links: Mapping[str, Link]) -> Seat | None:
    """The joint of a cam to a link, by one pin or by its guide there; None without one."""
    guides = [slide for slide in links[on].slides[:1] if slide.on == carrier]
    pivots = [point for point in links[on].points if point in links[carrier].points]
    if guides and links[on].points:
        return Seat(carrier, links[on].points[0], True)
    return Seat(carrier, pivots[0], False) if len(pivots) == 1 else None


def seat_of(follower: str, on: str, table: Table, links: Mapping[str, Link]) -> Seat | None:
    """The link that carries both the cam and its follower, and the cam's joint to it."""
    findings, own = table.findings, links[follower]
    if on not in links or on == follower:
        expected = listed(name for name in links if name != follower)
        table.wrong(
            "on",
            message("link {on}", on=on),
            message("the link of the cam: {expected}", expected=expected),
        )
        return None
    if not is_lever(follower, on, links):
        carriers = [own.slides[0].on]
        if len(own.slides) > 1 or carriers[0] not in links or not own.points or on in carriers:
            found = message(
                "link {follower} does not slide on a guide beside the cam", follower=follower
            )
            expected = message(
                "a follower with slides = {{ on = 0, … }}, its first point the roller's centre"
            )
            findings.add(table.place, found, expected, OTHER_CAMS)
            return None
    else:
        carriers = pinned_to(follower, on, links)
        if not carriers:
            found = message(
                "link {follower} neither slides on a guide nor swings about a pin",
                follower=follower,
            )
            expected = message(
                "slides = {{ on = 0, … }}, or one point of the frame and the tip as the next"
            )
            findings.add(table.place, found, expected)
            return None
    for name in carriers:
        if seat := seated(on, name, links):
            return seat
    who = either(map(link_words, carriers))
    if on == FRAME and any(s.on == FRAME for name in carriers for s in links[name].slides):
        hint = message("let the plate slide and keep the follower's guide fixed: both move alike")
        table.wrong(
            "on", message("a plate at rest along which {who} slides", who=who), CARRIED, hint
        )
        return None
    found = message(
        "{on} has not one pin on {who}, which carries link {follower}",
        on=link_words(on),
        who=who,
        follower=follower,
    )
    table.wrong("on", found, CARRIED, OTHER_CAMS)
    return None


def read_law(
    table: Table, measures: Measures, *, swings: bool, slides: bool
) -> tuple[CamPiece, ...]:
    """The pieces of a law: they add up to a full turn and return to zero.

    The pieces of a cam that ``slides`` end at lengths and need not return.
    """
    findings, raw, place = measures.findings, table.take("law"), table.at("law")
    if isinstance(raw, list) and is_table(raw):
        if slides:
            findings.add(
                place,
                message("a table of a plate that slides"),
                message("pieces with to, rise, motion"),
            )
            return ()
        return read_table(place, raw, measures, swings=swings)
    if not isinstance(raw, list) or not 0 < len(raw) <= MOST_PIECES:
        found = message("is missing") if raw is None else shown(raw)
        expected = message(
            "at most {most} pieces: [ {{ to = 120, rise = 20, motion = … }}, … ]", most=MOST_PIECES
        )
        findings.add(place, found, expected)
        return ()
    pieces, bad = [], len(findings.problems)
    for index, each in enumerate(raw):
        where = numbered(place, index, len(raw))
        if isinstance(each, dict):
            pieces.append(read_piece(Table(where, each, findings), measures, swings, slides))
        else:
            findings.add(where, shown(each), message("a table {{ to = …, rise = …, motion = … }}"))
    if len(findings.problems) > bad:
        return ()
    check_law(place, pieces, measures, slides=slides)
    return tuple(pieces)


def read_piece(table: Table, measures: Measures, swings: bool, slides: bool) -> CamPiece:
    """One piece, ``{ to, rise, motion }``: without a rise a dwell; a lever's rise is an angle."""
    ending = measures.length if slides else measures.angle
    to = ending(table.at("to"), table.take("to"))
    raw, dwells = table.take("rise"), table.take("motion") is None
    reading = measures.angle if swings else measures.length
    rise = reading(table.at("rise"), 0 if raw is None else raw)
    table.finish()
    if raw is None and dwells:
        return CamPiece(to, rise, "uniform")
    motion = table.choice("motion", tuple(MOTIONS))
    if raw is None:
        hint = message("a dwell has neither rise nor motion")
        table.wrong("rise", message("is missing"), message("how far it lifts"), hint)
    return CamPiece(to, rise, motion)


def check_law(place: str, pieces: list[CamPiece], measures: Measures, *, slides: bool) -> None:
    """Check that angles increase to a full turn, lengths increase, and followers return."""
    values, findings = measures.values, measures.findings
    unit = measures.units["angle"]
    low, lift = 0.0, 0.0
    for index, piece in enumerate(pieces):
        to = float(piece.to.number(values))
        if to <= low:
            found = message("{to:g} after {low:g}", to=to, low=low)
            grow = message("lengths that grow") if slides else message("angles that grow")
            findings.add(f"{numbered(place, index, len(pieces))}.to", found, grow)
        low, lift = to, lift + float(piece.rise.number(values))
        if lift < -1e-9 * abs(float(piece.rise.number(values))):
            where = f"{numbered(place, index, len(pieces))}.rise"
            found = message("the follower is {lift:g} below where the law begins", lift=-lift)
            hint = message("the base circle is the smallest: let the law begin at its lowest place")
            findings.add(where, found, message("0 or more"), hint)
    if slides:
        return
    whole = 360.0 if unit == "deg" else 6.283185307179586
    if abs(low - whole) > 1e-9 * whole:
        findings.add(
            place,
            message("ends at {low:g}", low=low),
            message('360 (in rad "2*pi")'),
            message("a cam turns round"),
        )
    size = max(abs(float(piece.rise.number(values))) for piece in pieces)
    if abs(lift) > 1e-9 * size:
        found = message("the rises add up to {lift:g}", lift=lift)
        findings.add(place, found, message("0: after a whole turn the follower is where it began"))
