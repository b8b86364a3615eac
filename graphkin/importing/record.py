"""An imported mechanism: joints where the other program draws them, links, guides and inputs.

A drawing is completed to one: whoever imports it names its fixed points, the points that slide, and
the driven bar.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations, islice
from math import isfinite, radians
from xml.etree.ElementTree import Element, ParseError

from msgspec import Struct

from graphkin.text.errors import NO_WORDS, Message, SceneError, joined, message, verbatim

MOST = 200
"""The most joints, and the most links."""
FARTHEST = 1e6
"""The largest number that is read, in the unit of the file."""
LONGEST_NAME = 40


class DrawnJoint(Struct, frozen=True):
    """A joint by its id in the file: its name and place, and whether it is fixed."""

    name: str
    at: complex
    fixed: bool = False


class DrawnLink(Struct, frozen=True):
    """A link by its id in the file: its name and the ids of its joints."""

    name: str
    joints: tuple[str, ...]


class DrawnGuide(Struct, frozen=True):
    """The straight guide of a link: on another link, or on the frame where ``on`` is empty.

    ``first`` is the joint of the link that slides along it. The guide runs along two joints of
    ``on``, or through ``first``, at an ``angle`` to the drawing's x axis in radians. That of a
    cylinder's tube, whose only joint is ``tube``, runs from there through ``first``.
    """

    body: str
    first: str
    on: str = ""
    along: tuple[str, str] | None = None
    angle: float = 0.0
    tube: str = ""


class DrawnGear(Struct, frozen=True):
    """Two wheels about joints of two links, which mesh or carry a belt; only the ratio of their
    sizes counts.
    """

    one: str
    other: str
    centres: tuple[str, str]
    sizes: tuple[float, float]
    belt: bool = False


class DrawnInput(Struct, frozen=True):
    """What is driven: a link about a joint, in rev/min; along its guide where ``about`` is empty,
    in units of length per second.

    ``against`` is the other link at a joint that is not fixed.
    """

    body: str
    speed: float
    about: str = ""
    against: str = ""


class DrawnLoad(Struct, frozen=True):
    """A force in N on a link, at one of its joints."""

    body: str
    joint: str
    force: complex


class DrawnMass(Struct, frozen=True):
    """The mass of a link in kg, at one of its joints, and its moment of inertia there in kg·m²."""

    body: str
    centre: str
    mass: float
    inertia: float


class Imported(Struct, frozen=True):
    """A mechanism of another program; places in ``unit``, exact to ``rounding``.

    ``notes`` name what has no counterpart in a scene.
    """

    program: str
    unit: str
    rounding: float
    joints: Mapping[str, DrawnJoint]
    bodies: Mapping[str, DrawnLink]
    guides: tuple[DrawnGuide, ...]
    inputs: tuple[DrawnInput, ...]
    notes: tuple[Message, ...] = ()
    gears: tuple[DrawnGear, ...] = ()
    loads: tuple[DrawnLoad, ...] = ()
    masses: tuple[DrawnMass, ...] = ()
    gravity: bool = False


def letter_of(place: int) -> str:
    """The name of a joint without one, by its place in the file: A to Z, then P26, P27 …"""
    return chr(ord("A") + place) if place < 26 else f"P{place}"


def one_at_welds(welded: Iterable[str], bodies: dict[str, DrawnLink]) -> dict[str, str]:
    """Join the links that meet at welded joints, and tell which link each has become."""
    holders = {own: own for own in bodies}
    for joint in welded:
        at = [name for name, body in bodies.items() if joint in body.joints]
        for other in at[1:]:
            one, gone = bodies[at[0]], bodies.pop(other)
            joints = dict.fromkeys((*one.joints, *gone.joints))
            bodies[at[0]] = DrawnLink(f"{one.name}+{gone.name}", tuple(joints))
            holders = {part: at[0] if to == other else to for part, to in holders.items()}
    return holders


def refused(found: Message, expected: Message = NO_WORDS) -> SceneError:
    """The error of a text that cannot be imported."""
    return SceneError.at("import", found, expected)


def number(text: str, factor: float = 1.0) -> float:
    """A decimal number times a factor. Raises SceneError where it is none or too large."""
    try:
        value = float(text) * factor
    except ValueError:
        value = float("nan")
    if not isfinite(value) or abs(value) > FARTHEST:
        raise refused(message("{text} is no number that can be drawn", text=named(text)))
    return value


def named(text: str) -> str:
    """A name from a file in one short line, without characters that control a terminal."""
    shown = "".join(sign for sign in text if sign.isprintable())
    return shown[:LONGEST_NAME]


def safe_xml(text: str, expected: Message) -> Element:
    """The root of an XML text without entities. Raises SceneError for XML that is wrong."""
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root: Element = fromstring(text, forbid_dtd=True)
    except ParseError as error:
        why = verbatim(named(str(error)))
        raise refused(message("the XML breaks off or is wrong: {why}", why=why), expected) from None
    except (DefusedXmlException, ValueError):
        raise refused(message("the text is no XML that is safe to read")) from None
    return root


def unknown_unit(name: str, unit: str) -> Message:
    """The note on a unit of length that a file has and nobody knows."""
    return message(
        "unit {name} is unknown; lengths are taken in {unit}", name=named(name), unit=unit
    )


def few(count: int) -> None:
    """Raise SceneError for more joints or links than are read."""
    if count > MOST:
        raise refused(message("more than {most} joints or links", most=MOST))


def damaged() -> SceneError:
    """The error of a text that breaks off or does not keep to its format."""
    return refused(message("the text breaks off or is damaged"))


# --- a drawing of points and bars, which does not say what is fixed -------------------------------


USUAL = "mm"
SPEED = 60.0
"""Revolutions per minute of the driven bar."""
MOST_NAMED = 40
"""Points in one message."""
NEAR = 1e-6
"""The distance between two points that are one, in parts of the drawing."""


class Completion(Struct, frozen=True):
    """What a drawing does not say: names of fixed points, and of two points of the driven bar.

    ``slides`` gives each sliding point the direction of its fixed guide, in degrees. ``unit`` is
    empty where the drawing's own counts.
    """

    fixed: tuple[str, ...] = ()
    drive: tuple[str, ...] = ()
    slides: Mapping[str, str] = {}
    unit: str = ""


class BarFigure(Struct, frozen=True):
    """Points by name, and bars or plates by the names of their points. ``unit`` may be empty."""

    program: str
    points: Mapping[str, complex]
    bars: tuple[tuple[str, ...], ...]
    unit: str = ""
    notes: tuple[Message, ...] = ()


def traced(figure: BarFigure, tracing: Completion) -> Imported:
    """The mechanism of a drawing. Raises SceneError for nothing fixed or unknown names."""
    bars = [*reached(with_points_between(figure), tracing.fixed)]
    used = [point for point in figure.points if any(point in bar for bar in bars)]
    if not used:
        raise refused(message("the drawing has no bar"), message("segments, lines or polygons"))
    expected = message("--fixed with some of {points}", points=placed(figure, used))
    if not tracing.fixed:
        raise refused(message("a drawing does not say which points are fixed"), expected)
    for name in (*tracing.fixed, *tracing.drive, *tracing.slides):
        if name not in used:
            raise refused(message("no bar has a point {name}", name=named(name)), expected)
    if not {*tracing.fixed}.isdisjoint(tracing.slides):
        raise refused(message("a point cannot both be fixed and slide"))
    few(len(used))
    few(len(bars))
    still = {*tracing.fixed, *tracing.slides}
    links = plates(bar for bar in bars if not bar <= still)
    joints = {
        point: DrawnJoint(point, figure.points[point], point in tracing.fixed) for point in used
    }
    bodies = {f"bar {number}": DrawnLink("-".join(link), link) for number, link in enumerate(links)}
    guides = []
    for point, angle in tracing.slides.items():
        block = f"block {point}"
        bodies[block] = DrawnLink(block, (point,))
        guides.append(DrawnGuide(block, point, angle=radians(number(angle))))
    inputs = (*driven(links, tracing),)
    unit = tracing.unit or figure.unit or USUAL
    notes = list(figure.notes)
    if not (tracing.unit or figure.unit):
        notes.append(message("lengths have no unit in the file; mm are written"))
    loose = [named(point) for point in figure.points if point not in used]
    if loose:
        points = ", ".join([*loose[:MOST_NAMED], *(["…"] if len(loose) > MOST_NAMED else [])])
        notes.append(message("not connected, and left out: points {points}", points=points))
    if inputs:
        notes.append(message("the driven bar turns at {speed:g} rev/min", speed=SPEED))
    extent = max(abs(place) for place in figure.points.values()) or 1.0
    return Imported(
        figure.program, unit, NEAR * extent, joints, bodies, tuple(guides), inputs, tuple(notes)
    )


def placed(figure: BarFigure, points: Iterable[str]) -> Message:
    """The names of points with their places."""
    each = (
        message(
            "{name} ({x:.6g}, {y:.6g})",
            name=named(point),
            x=figure.points[point].real,
            y=figure.points[point].imag,
        )
        for point in points
    )
    return joined(", ", [*islice(each, MOST_NAMED)])


def driven(links: Iterable[tuple[str, ...]], tracing: Completion) -> Iterator[DrawnInput]:
    """The input of the bar with the two named points, about its fixed one."""
    if not tracing.drive:
        return
    owns = (own for own, link in enumerate(links) if {*tracing.drive} <= {*link})
    own = next(owns, None)
    about = next((point for point in tracing.drive if point in tracing.fixed), None)
    if own is None or about is None:
        raise refused(
            message("{points} is no bar with a fixed end", points="-".join(tracing.drive)),
            message("--drive with the two ends of a bar, one of them fixed"),
        )
    yield DrawnInput(f"bar {own}", SPEED, about)


def reached(bars: Iterable[frozenset[str]], fixed: tuple[str, ...]) -> list[frozenset[str]]:
    """The bars that hang together with fixed points; all where nothing is fixed."""
    found, rest, held = list[frozenset[str]](), [*bars], {*fixed}
    if not fixed:
        return rest
    while joining := [bar for bar in rest if bar & held]:
        found += joining
        rest = [bar for bar in rest if not bar & held]
        held.update(*joining)
    return found


def with_points_between(figure: BarFigure) -> Iterator[frozenset[str]]:
    """The points of each bar, with those drawn on it between its ends."""
    import numpy as np

    names = [*figure.points]
    places = np.array([*figure.points.values()], complex)
    near = NEAR * max(np.abs(places), default=1.0)
    for bar in figure.bars:
        if len(bar) == 2 and figure.points[bar[0]] != figure.points[bar[1]]:
            one, other = (figure.points[end] for end in bar)
            along = (places - one) / (other - one)
            on = np.abs(along.imag) * abs(other - one) < near
            (between,) = np.nonzero(on & (along.real > 0) & (along.real < 1))
            yield frozenset([*bar, *(names[own] for own in between)])
        else:
            yield frozenset(bar)


def plates(bars: Iterable[frozenset[str]]) -> list[tuple[str, ...]]:
    """Bars joined to plates: two with two points in common are one, and three of a triangle too."""
    found = [*dict.fromkeys(bar for bar in bars if len(bar) > 1)]
    for _ in range(MOST):
        pair = next((p for p in combinations(found, 2) if len(p[0] & p[1]) > 1), None)
        group = pair or next(triangles(found), None)
        if group is None:
            break
        whole = frozenset().union(*group)
        found = [whole if bar is group[0] else bar for bar in found if bar not in group[1:]]
    return [tuple(sorted(bar)) for bar in found]


def triangles(bars: list[frozenset[str]]) -> Iterator[tuple[frozenset[str], ...]]:
    """Three bars, each two of which share a point of their own."""
    for one, other in combinations(bars, 2):
        if one & other:
            for third in bars:
                corners = {*(one & other), *(other & third), *(third & one)}
                if (
                    third not in (one, other)
                    and len(corners) == 3
                    and one & third
                    and other & third
                ):
                    yield one, other, third
