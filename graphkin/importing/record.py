"""An imported mechanism: joints where the other program draws them, links, guides and inputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isfinite
from xml.etree.ElementTree import Element, ParseError

from msgspec import Struct

from graphkin.text.errors import NO_WORDS, Message, SceneError, message, verbatim

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
