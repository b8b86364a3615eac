"""A mechanism as a file of another program: Linkage, pylinkage, PMKS+.

All three know pins, bars and plates, cranks about fixed pins, and blocks with one pin. Linkage and
PMKS+ have guides on the frame and along two joints of a link; pylinkage has them on the frame only.
PMKS+ has one crank. Anything else is refused, never left out.

The file of PMKS+ has the content of the address with which it shares a mechanism (class
StringTranscoder of github.com/PMKS-Web/PMKSWeb): thousandths as numbers in base 64, flags as bits,
and the length of the text at the end. PMKS+ reads whole revolutions per minute, then a time step,
and no further number. The third number is the exact speed, for a reader that wants it.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import floor, pi
from string import ascii_lowercase, ascii_uppercase, digits
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from msgspec.json import encode, format

from graphkin.mechanism import Mechanism
from graphkin.scene.model import FRAME, Link, Scene, Slide
from graphkin.scene.quantity import METRES
from graphkin.structure.turning import body, guide_line, metres
from graphkin.text.errors import NO_WORDS, Hint, Message, PageError, Problem, message

LEAST = 1e-9
"""The distance (m) under which a joint is on a guide."""


def without_counterpart(
    scene: Scene, program: str, hint: Hint, *, moving_guides: bool
) -> Iterator[Problem]:
    """A problem for each link with more than pins, blocks of one pin, and straight guides."""
    for link in scene.links.values():
        place = f"links.{link.name}"
        if link.has_wheels or link.cam or link.profiles:
            yield Problem(
                place,
                message("{program} has no wheels, cams or profiles", program=program),
                message("pins and guides"),
                hint,
            )
        if link.slides and (len(link.points) > 1 or len(link.slides) > 1):
            yield Problem(
                place,
                message(
                    "{program} has no block with more than one point or guide", program=program
                ),
                message("a block with one pin on one guide"),
                hint,
            )
        elif any(slide.on != FRAME for slide in link.slides) and not moving_guides:
            found = message("{program} has no guide that moves", program=program)
            yield Problem(place, found, message("a guide on the frame"), hint)
        elif any(slide.on != FRAME and len(along(scene, slide)) < 2 for slide in link.slides):
            yield Problem(
                place,
                message(
                    "{program} moves a guide only along two joints of its link", program=program
                ),
                message("a guide along two points, without offset"),
                hint,
            )


def not_cranks(scene: Scene) -> list[Message]:
    """What is wrong with the drivers where each must turn a link about a fixed pin."""
    fixed = {*scene.frame.points}
    return [
        message("{driver} turns no crank about a fixed pin", driver=f"drivers.{number}")
        for number, driver in enumerate(scene.drivers, 1)
        if driver.kind != "turn"
        or driver.against != FRAME
        or not {*scene.link(driver.link).points} & fixed
    ]


def along(scene: Scene, slide: Slide) -> tuple[str, ...]:
    """The two points of a link between which a guide runs; none where there are fewer."""
    if metres(scene, slide.offset):
        return ()
    if slide.along:
        return slide.along
    line, points = guide_line(scene, slide), body(scene, slide.on)
    on = [p for p, z in points.items() if abs(((z - line.point) / line.along).imag) < LEAST]
    return (on[0], on[-1]) if len(on) > 1 and points[on[0]] != points[on[-1]] else ()


PROGRAM = "PMKS+"
ALPHABET = f"{digits}{ascii_uppercase}{ascii_lowercase}_-"
LETTERS = f"{ascii_uppercase}{ascii_lowercase}"
"""Names of joints: PMKS+ joins them to form names of links, and splits those again."""
LETTER_OF_LENGTH = f"{digits}{LETTERS}"
MASS, THOUSANDTH = 1.0, 1000
EXACT = 10**9
"""Parts of one revolution per minute in the exact speed."""
CENTIMETRES, INCHES = "1", "0"
DEGREES, NEWTONS = "0", "1"
GRIDS = 0b11000
"""Both grids are shown."""
CURVE, GROUND, INPUT, PRISMATIC = 16, 4, 2, 1
COLOURS = ("c5cae9", "303e9f", "0d125a", "b2dfdb", "26a69a", "00695c")
SIZE = 0.3
"""Drawn size of joints, in parts of a third of the mechanism's extent."""


def pmks_file(mechanism: Mechanism, hint: Hint = NO_WORDS) -> bytes:
    """A mechanism as the text of a ``.pmks`` file, with lengths to 0.01 mm (in inches to 0.001 in).

    Raises PageError for everything that PMKS+ has no joint or link for, with a problem for each and
    the hint.
    """
    scene = mechanism.scene
    refused = list(unknown(scene, hint))
    if refused:
        raise PageError(refused)
    return PmksText(mechanism).text().encode("ascii")


def unknown(scene: Scene, hint: Hint) -> Iterator[Problem]:
    """The problems of a scene that PMKS+ does not support."""
    yield from without_counterpart(scene, PROGRAM, hint, moving_guides=True)
    if len(scene.drivers) != 1 or not_cranks(scene):
        yield Problem(
            "drivers",
            message("PMKS+ moves one crank about a fixed pin"),
            message("one crank"),
            hint,
        )
    points = {point for link in (scene.frame, *scene.links.values()) for point in link.points}
    if len(points) + sum(bool(link.slides) for link in scene.links.values()) > len(LETTERS):
        yield Problem(
            "links",
            message("more than {count} joints", count=len(LETTERS)),
            message("fewer points"),
            hint,
        )


class PmksText:
    """Joints and links of a scene, each as PMKS+ writes it."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.scene = scene = mechanism.scene
        self.motion = mechanism.solve()
        self.inches = scene.units["length"] == "in"
        metre = METRES["in" if self.inches else "cm"]
        found = {name: point.position for name, point in self.motion.points.items()}
        held = {point for link in scene.links.values() for point in link.points}
        self.at = {p: complex(z) / metre for p, z in found.items() if z is not None and p in held}
        self.ids = dict(zip(self.at, LETTERS, strict=False))
        self.guides = dict(zip(self.blocks(), LETTERS[len(self.ids) :], strict=False))

    def blocks(self) -> Iterable[str]:
        """The blocks on guides."""
        return (name for name, link in self.scene.links.items() if link.slides)

    def text(self) -> str:
        """The complete file, with its length as the last letter."""
        driver = self.scene.drivers[0]
        omega = float(self.motion.links[driver.link].omega or 0.0)
        xs, ys = ([getattr(z, part) for z in self.at.values()] for part in ("real", "imag"))
        extent = max(max(xs) - min(xs), max(ys) - min(ys))
        shown = whole(GRIDS | (omega < 0)).rjust(2, "0")
        rpm = abs(omega) * 30 / pi
        speeds = f"{whole(round(rpm))},0,{whole(round(EXACT * rpm))}"
        units = f"{INCHES if self.inches else CENTIMETRES}{DEGREES}{NEWTONS}"
        joints = "".join(f"{joint}." for joint in self.joints())
        links = "".join(f"{link}." for link in self.links())
        said = f"{shown}.{decimal(SIZE * extent)}.{speeds}.{units}.{joints}.{links}..N_"
        return said + LETTER_OF_LENGTH[len(said) % len(LETTER_OF_LENGTH)]

    def joints(self) -> Iterator[str]:
        """Every pin, then the guide of every block."""
        driven = set(self.scene.link(self.scene.drivers[0].link).points)
        for point, place in self.at.items():
            fixed = point in self.scene.frame.points
            flags = CURVE | (GROUND if fixed else 0) | (INPUT if fixed and point in driven else 0)
            yield self.joint(flags, self.ids[point], point, place, 0.0)
        for name, own in self.guides.items():
            link = self.scene.links[name]
            slide, place = link.slides[0], self.at[link.points[0]]
            if slide.on == FRAME:
                angle = direction(guide_line(self.scene, slide).along)
                yield self.joint(CURVE | GROUND | PRISMATIC, own, own, place, angle)
            else:
                on = self.held(self.scene.links[slide.on])
                ends = ",".join(self.ids[point] for point in along(self.scene, slide))
                joint = self.joint(CURVE | PRISMATIC, own, own, place, 0.0)
                yield f"{joint},{''.join(on)},{ends}"

    def joint(self, flags: int, own: str, name: str, at: complex, angle: float) -> str:
        place = f"{decimal(at.real)},{decimal(at.imag)},{decimal(angle)}"
        return f"{whole(flags)}{own},{name},{place}"

    def links(self) -> Iterator[str]:
        """Every bar and plate, and the piston of every block."""
        for number, link in enumerate(self.scene.links.values()):
            held = self.held(link)
            if link.slides:
                yield self.link("P", link, held, 0j, "")
            else:
                middle = sum(self.at[point] for point in link.points) / len(held)
                yield self.link("R", link, held, middle, COLOURS[number % len(COLOURS)])

    def held(self, link: Link) -> list[str]:
        """The joints of a link; those of a block are its pin and its guide."""
        own = [self.guides[link.name]] if link.slides else []
        return [*(self.ids[point] for point in link.points), *own]

    def link(self, kind: str, link: Link, held: Sequence[str], middle: complex, ink: str) -> str:
        """One link, without links welded to it."""
        inertia = decimal(MASS if kind == "R" else 0.0)
        centre = f"{decimal(middle.real)},{decimal(middle.imag)}"
        joints = "".join(f"{each}," for each in held)
        own = "".join(held)
        return f"Y{kind}{own},{link.name},{decimal(MASS)},{inertia},{centre},{ink},{joints},"


def direction(way: complex) -> float:
    """The angle of a line in radians, from 0 to below a half turn."""
    return phase(way) % pi


def decimal(number: float) -> str:
    """A number to a thousandth."""
    return whole(floor(number * THOUSANDTH + 0.5))


def whole(number: int) -> str:
    """A whole number in base 64; a leading zero makes it negative."""
    rest, found = abs(number), ""
    while rest or not found:
        rest, digit = divmod(rest, len(ALPHABET))
        found = ALPHABET[digit] + found
    return f"0{found}" if number < 0 else found


PER_INCH = 96
LAYER = "16"
"""The layer of mechanisms in Linkage."""
DIGITS = 9
"""Decimals of a coordinate."""


def linkage_file(mechanism: Mechanism) -> bytes:
    """A mechanism as a ``.linkage2`` file. Raises PageError for what Linkage does not have.

    The ends of a fixed guide are anchors on a link of their own.
    """
    sent = SentMechanism(mechanism, "Linkage", moving_guides=True)
    inches = mechanism.scene.units["length"] == "in"
    root = Element("linkage2")
    SubElement(root, "program", units="Inches" if inches else "Millimeters", scalefactor="1")
    ids = {point: str(number) for number, point in enumerate(sent.at, 1)}
    tracks: list[tuple[str, str]] = []
    later: list[tuple[str, complex]] = []
    for point, place in sent.at.items():
        more = {"anchor": "true"} if point in sent.fixed else {}
        speed = next((speed for about, speed in sent.cranks.values() if about == point), None)
        if speed is not None:
            more |= {"input": "true", "rpm": in_digits(speed * 30 / pi)}
        connector = add_connector(root, ids[point], place, name=point, **more)
        if slide := sent.slides.get(point):
            connector.set("slider", "true")
            if slide.on == FRAME:
                ends = (str(len(ids) + len(later) + n) for n in (1, 2))
                track = (next(ends), next(ends))
                way = guide_line(mechanism.scene, slide).along * sent.extent
                later += zip(track, (place - way, place + way), strict=True)
                tracks.append(track)
            else:
                one, other = along(mechanism.scene, slide)
                track = (ids[one], ids[other])
            for end in track:
                SubElement(connector, "slidelimit", id=end)
    for own, place in later:
        add_connector(root, own, place, anchor="true")
    held = [(name, [ids[point] for point in points]) for name, points in sent.bodies.items()]
    held += [("", [*track]) for track in tracks]
    for number, (name, owns) in enumerate(held):
        link = SubElement(root, "Link", id=str(number), layer=LAYER, name=name)
        for own in owns:
            SubElement(link, "connector", id=own)
    indent(root)
    return f"{tostring(root, encoding='unicode')}\n".encode()


def add_connector(root: Element, own: str, place: complex, **more: str) -> Element:
    """Add a connector at a place in metres."""
    x, y = (in_digits(part / METRES["in"] * PER_INCH) for part in (place.real, place.imag))
    return SubElement(root, "connector", {"id": own, "layer": LAYER, "x": x, "y": y, **more})


def pylinkage_file(mechanism: Mechanism) -> bytes:
    """A mechanism as the JSON of pylinkage, in mm and in radians per second for its steps.

    Raises PageError for what pylinkage does not have.
    """
    sent = SentMechanism(mechanism, "pylinkage", moving_guides=False)
    joints: list[dict[str, Any]] = []
    links: list[dict[str, Any]] = [{"id": "ground", "type": "ground", "joints": [*sent.fixed]}]
    for point, place in sent.at.items():
        kind = "ground" if point in sent.fixed else "revolute"
        joint = {"id": point, "type": kind, "position": in_mm(place)}
        if slide := sent.slides.get(point):
            axis = guide_line(mechanism.scene, slide).along
            joint |= {"type": "prismatic", "axis": [axis.real, axis.imag]}
            joint["line_point"] = joint["position"]
        joints.append(joint)
    for name, points in sent.bodies.items():
        link: dict[str, Any] = {"id": name, "type": "link", "joints": points}
        if name in sent.cranks:
            about, speed = sent.cranks[name]
            tip = next((sent.at[point] for point in points if point != about), sent.at[about] + 1)
            link |= {"type": "driver", "motor_joint": about, "angular_velocity": speed}
            link["initial_angle"] = phase(tip - sent.at[about])
        links.append(link)
    whole = {"name": mechanism.scene.name, "joints": joints, "links": links, "ground": "ground"}
    return format(encode(whole), indent=1) + b"\n"


Writer = Callable[[Mechanism], bytes]
PROGRAMS: Mapping[str, Writer] = {
    "linkage": linkage_file,
    "pmks": pmks_file,
    "pylinkage": pylinkage_file,
}
"""The writer of each program's file, by the program's name."""


class SentMechanism:
    """The joints, bodies, guides and cranks of a mechanism, where a program has them all."""

    def __init__(self, mechanism: Mechanism, program: str, *, moving_guides: bool) -> None:
        scene = mechanism.scene
        refused = [*without_counterpart(scene, program, NO_WORDS, moving_guides=moving_guides)]
        refused += [Problem("drivers", found, message("cranks")) for found in not_cranks(scene)]
        if refused:
            raise PageError(refused)
        motion = mechanism.solve()
        links = scene.links.values()
        held = {point for link in links for point in link.points}
        places = {p: complex(motion.points[p].position or 0j) for p in motion.points if p in held}
        self.at = places
        self.fixed = [point for point in places if point in scene.frame.points]
        self.slides: dict[str, Slide] = {
            link.points[0]: link.slides[0] for link in links if link.slides
        }
        driven = {driver.link for driver in scene.drivers}
        self.bodies = {
            link.name: [*link.points]
            for link in sorted(links, key=lambda link: link.name not in driven)
            if not link.slides
        }
        self.cranks = {
            name: (pivot(scene.link(name), self.fixed), float(motion.links[name].omega or 0.0))
            for name in driven
        }
        self.extent = 2 * max(abs(a - b) for a in places.values() for b in places.values())


def pivot(link: Link, fixed: list[str]) -> str:
    return next(point for point in link.points if point in fixed)


def in_mm(place: complex) -> list[float]:
    return [round(part / METRES["mm"], DIGITS) for part in (place.real, place.imag)]


def in_digits(number: float) -> str:
    return f"{number:.{DIGITS}f}"
