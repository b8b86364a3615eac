"""What is given: parameters, drivers, lengths, points, sides, guides and wheels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from fractions import Fraction

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_pairs import closures, of_guide, tracks, wheels
from graphkin.construction.core.naming import (
    angle_symbol,
    axis_of,
    driver_index,
    speed_symbol,
)
from graphkin.construction.core.parameter_words import (
    after_parameter,
    has_own_relation,
    is_derived,
    law,
    lone,
    other_parameters,
    parameter,
)
from graphkin.construction.core.quantities import in_degrees, number_of, quantity_text
from graphkin.construction.core.relation import figure
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.model import (
    FRAME,
    Angled,
    At,
    Cam,
    CamPiece,
    Driver,
    OnLine,
    Polar,
    Scene,
    Side,
    Triangle,
    lengths_of,
)
from graphkin.scene.quantity import Quantity, exact
from graphkin.text import Words


class Datum(Struct, frozen=True):
    """One of the data as markup: a value with its ``name`` and what is said of it, or words alone.

    ``sign`` stands between name and value; a rate may be ``constant`` and have a ``sense``. ``of``
    is the number that it tells, ``parameters`` are those that it is set by.
    """

    words: str = ""
    name: str = ""
    value: str = ""
    sign: str = " = "
    constant: str = ""
    sense: str = ""
    of: Quantity | None = None
    parameters: tuple[str, ...] = ()

    @property
    def said(self) -> str:
        """It as a piece of a sentence."""
        if not self.value:
            return self.remark
        told = " = ".join(filter(None, (self.value, self.constant)))
        return self.name + self.sign + told + (f", {self.sense}" if self.sense else "")

    @property
    def remark(self) -> str:
        """What is said of it beside its value."""
        if self.constant:
            return f"{self.name} = {self.constant}" + (f", {self.sense}" if self.sense else "")
        return f"{self.name}: {self.sense}" if self.sense else self.words


def given(drawing: Drawing, *, solved: bool = True, laws: bool = False) -> list[str]:
    """The data of a scene as short pieces of markup, in the order of the scene.

    Unless ``solved``, without the numbers that a student reckons from the parameters; ``laws``
    stand for them, where no form beside says these.
    """
    return [datum.said for datum in data(drawing, solved=solved, laws=laws)]


def data(drawing: Drawing, *, solved: bool = True, laws: bool = False) -> list[Datum]:
    """The same, names and values apart."""
    scene, words = drawing.scene, drawing.words
    sentences = [
        *sides(scene, words),
        *(
            of_guide(drawing, link, slide)
            for link in scene.bare.links.values()
            if link.name not in scene.cam_links
            for slide in link.slides
        ),
        *wheels(scene, words),
        *tracks(drawing),
        *arcs(scene, words),
        *cams(drawing),
        *closures(drawing),
        *of_scales(drawing),
        *(escape(note) for note in [scene.notes.get(words.language)] if note),
    ]
    return [
        *(
            Datum(name=name, value=value, parameters=(of,))
            for of, name, value in other_parameters(scene, words)
        ),
        *(
            piece
            for driver in scene.drivers
            for piece in of_driver(scene, words, driver, solved=solved, laws=laws)
        ),
        *lengths(scene, words),
        *fixed_points(scene, words),
        *plates(drawing),
        *map(Datum, sentences),
    ]


def arcs(scene: Scene, words: Words) -> Iterator[str]:
    """The links that turn in the hollow of another along an arc about one centre."""
    for link in scene.every_link:
        for hollow in (each for each in link.profiles if each.hollow):
            for other in scene.every_link:
                for arc in (each for each in other.profiles if each.about == hollow.about):
                    if other is not link and not arc.hollow:
                        ends = {"p": symbol(arc.through), "q": symbol(hollow.through)}
                        links = {"g": escape(other.name), "k": escape(link.name)}
                        yield words("page.arcs", centre=symbol(arc.about), **links, **ends)


def cams(drawing: Drawing) -> Iterator[str]:
    """Each cam with its follower's tip, its circles and its law, piece by piece."""
    scene, words = drawing.scene, drawing.words
    for follower, cam in scene.cams.items():
        fields = {"g": escape(cam.on), "k": escape(follower)}
        fields["tip"] = cam_tip(scene, words, cam)
        base = quantity_text(scene, words, cam.base)
        senses = ("cam_forward", "cam_backward") if cam.slides else ("cam_counter", "cam_clockwise")
        sense = words(f"page.{senses[cam.sense < 0]}")
        start = words("page.cam_start", angle=quantity_text(scene, words, cam.start))
        turned = sense + ("" if cam.start.is_zero() else start)
        key = "page.cam_plate" if cam.slides else "page.cam"
        if cam.slides:
            fields["p"] = symbol(cam.pivot)
        if cam.lever:
            line, pin = bar(cam.pivot, cam.lever.pin), symbol(cam.lever.pin)
            fields["side"] = words("page.cam_left" if cam.lever.side > 0 else "page.cam_right")
            fields |= {"q": pin} if cam.slides else {"line": line}
            key += "_lever"
        yield words(key, base=base, **fields)
        if cam.carrier != FRAME and not cam.slides:
            yield words("page.cam_seen", g=fields["g"], c=escape(cam.carrier))
        if cam.conjugate:
            radius, at = quantity_text(scene, words, cam.conjugate.roller), symbol(cam.conjugate.at)
            yield words("page.cam_conjugate", radius=radius, p=at, **fields)
        if cam.slopes:
            points = cam_points(scene, words, cam)
            yield words("page.cam_table", sense=turned, points=points, **fields)
            continue
        first, *rest = (cam_piece(scene, words, piece) for piece in cam.law)
        by = "page.cam_plate_by" if cam.slides else "page.cam_by"
        yield words(by, sense=turned, piece=first, **fields)
        yield from rest


def cam_tip(scene: Scene, words: Words, cam: Cam) -> str:
    """What touches the cam; a lever's face runs along its bar, or beside it towards the cam."""
    if cam.lever and cam.is_flat:
        line, gap = bar(cam.lever.pin, cam.point), quantity_text(scene, words, cam.lever.face)
        beside = "" if cam.lever.face.is_zero() else words("page.cam_beside", gap=gap)
        return words("page.cam_face", bar=line) + beside
    return words(f"page.cam_{cam.tip}", radius=quantity_text(scene, words, cam.roller))


def cam_points(scene: Scene, words: Words, cam: Cam) -> str:
    """The points of a table, from one end of a cubic to the next."""
    at, lift, unit = exact(0, cam.law[0].to.unit), Fraction(0), cam.law[0].rise.unit
    points = []
    for piece in cam.law:
        height = number_of(scene, words, exact(lift))
        points.append(f"{quantity_text(scene, words, at)}: {height}")
        at, lift = piece.to, lift + piece.rise.number(scene.values)
    return ", ".join(points) + f" ({unit})"


def cam_piece(scene: Scene, words: Words, piece: CamPiece) -> str:
    """A piece of a law: how far it goes, and by which motion it lifts or lowers."""
    to, rise = quantity_text(scene, words, piece.to), piece.rise
    size = rise.number(scene.values)
    if size == 0:
        return words("page.cam_dwell", to=to)
    motion = words(f"page.motion_{piece.motion.replace(' ', '_')}")
    size = quantity_text(scene, words, rise if size > 0 else rise.negative())
    key = "page.cam_rise" if rise.number(scene.values) > 0 else "page.cam_return"
    return words(key, to=to, size=size, motion=motion)


def of_scales(drawing: Drawing) -> Iterator[str]:
    """What the scene says of the scale factors of the plans, so that a student can follow it."""
    m = drawing.scales.of_bar(drawing.kind)
    stated = drawing.kind == "acceleration" and drawing.scene.sheet.ka is not None
    if m not in (0, 1) and not stated:
        yield drawing.words(f"page.enlarged_{drawing.kind}", m=figure(drawing, m))


def of_driver(
    scene: Scene, words: Words, driver: Driver, *, solved: bool = True, laws: bool = False
) -> Iterator[Datum]:
    """Position, speed and acceleration of a driver."""
    if laws and not solved and has_own_relation(scene, driver.position):
        yield Datum(name=angle_symbol(scene, driver), value=law(scene, words, driver.position))
    elif solved or not has_own_relation(scene, driver.position):
        angle = in_degrees(scene, words, driver.position)
        place = after_parameter(scene, words, driver.position) + (f" = {angle}" if angle else "")
        yield Datum(name=angle_symbol(scene, driver), value=place, of=driver.position)
    steady = driver.acceleration.is_zero()
    rates = [(speed_symbol(driver), driver.speed, words("page.constant") if steady else "")]
    if not steady:
        rate = "*ε*" if driver.kind == "turn" else "*a*"
        rates.append((f"{rate}_{{{driver_index(driver)}}}", driver.acceleration, ""))
    for name, quantity, constant in rates:
        if not solved and is_derived(quantity):
            continue  # its law tells its sense, too
        size, sense = with_sense(scene, words, driver, quantity)
        told = size if solved or not has_own_relation(scene, quantity) else ""
        if laws and not told:
            told = law(scene, words, quantity)
        if told or constant or sense:
            by = tuple(filter(None, [lone(scene, quantity)]))
            yield Datum(
                name=name,
                value=told,
                constant=constant,
                sense=sense,
                of=quantity,
                parameters=by,
            )


def with_sense(scene: Scene, words: Words, driver: Driver, quantity: Quantity) -> tuple[str, str]:
    """A driver's speed or acceleration; of a crank the magnitude, and its sense in words."""
    value = float(quantity.si(scene.values))
    if driver.kind != "turn" or not value:
        return after_parameter(scene, words, quantity), ""
    if value > 0:
        return after_parameter(scene, words, quantity), words("page.turning_anticlockwise")
    return quantity_text(scene, words, quantity.negative()), words("page.turning_clockwise")


def lengths(scene: Scene, words: Words) -> Iterator[Datum]:
    """The lengths of bars, those of equal length together."""
    equal: dict[str, list[str]] = {}
    first: dict[str, Quantity] = {}
    for link in scene.bare.every_link:
        for placing in link.placings:
            for p, q, length in lengths_of(placing):
                text = after_parameter(scene, words, length)
                equal.setdefault(text, []).append(bar(p, q))
                first.setdefault(text, length)
    for text, bars in equal.items():
        by = tuple(filter(None, [lone(scene, first[text])]))
        yield Datum(name=" = ".join(bars), value=text, of=first[text], parameters=by)


def set_parameters(scene: Scene, words: Words, names: Iterable[str]) -> list[str]:
    """Some parameters as the sheet's data tell them, as markup: the length of a bar by its name."""
    bars = {name: datum.said for datum in lengths(scene, words) for name in datum.parameters}
    return [bars.get(name) or parameter(scene, words, name) for name in names]


def fixed_points(scene: Scene, words: Words) -> Iterator[Datum]:
    """The coordinates of the frame's points."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            place = f"{place_of(scene, words, placing)} {placing.x.unit}"
            yield Datum(name=symbol(placing.point), value=place, sign=" ")


def plates(drawing: Drawing) -> Iterator[Datum]:
    """Points of links that are given by coordinates or by an angle."""
    scene, words = drawing.scene, drawing.words
    for link in (scene.frame, *scene.links.values()):
        fixed = link is scene.frame
        places = [placing for placing in link.placings if isinstance(placing, At)]
        if not fixed and len(places) > 1:
            points = ", ".join(
                f"{symbol(placing.point)} {place_of(scene, words, placing)}" for placing in places
            )
            on_link = words("page.on_link", k=escape(link.name))
            yield Datum(f"{points} {places[0].x.unit}, {on_link}")
        for placing in link.placings:
            point = symbol(placing.point)
            if isinstance(placing, Polar):
                key = "page.polar_frame" if fixed else "page.polar"
                fields = {"bar": bar(placing.start, placing.point), "axis": axis_of(drawing, link)}
                yield Datum(words(key, angle=quantity_text(scene, words, placing.angle), **fields))
            elif isinstance(placing, Angled):
                arms, angle = [symbol(placing.arm), point], placing.angle
                if placing.clockwise:  # written from the point that it places
                    arms, angle = arms[::-1], angle.negative()
                name = f"∠{arms[0]}{symbol(placing.vertex)}{arms[1]}"
                told = quantity_text(scene, words, angle)
                within = abs(float(angle.si(scene.values))) < math.pi  # the side tells its sense
                yield Datum(name=name, value=told.removeprefix("−") if within else told)


def place_of(scene: Scene, words: Words, placing: At) -> str:
    """A point's coordinates."""
    x, y = (number_of(scene, words, q) for q in (placing.x, placing.y))
    return words.place(x, y)


def sides(scene: Scene, words: Words) -> Iterator[str]:
    """The sides on which points lie, of plates and of closures."""
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            if isinstance(placing, Triangle):
                yield side(words, placing.point, placing.first, placing.second, placing.side)
            elif isinstance(placing, Angled):
                way = math.sin(float(placing.angle.si(scene.values)))
                if abs(way) > 1e-9:
                    yield side(
                        words, placing.point, placing.vertex, placing.arm, 1 if way > 0 else -1
                    )
            elif isinstance(placing, OnLine) and placing.by_parts:
                parted = bar(placing.first, placing.point)
                yield words("page.on_line", point=symbol(placing.second), bar=parted)
            elif isinstance(placing, OnLine):
                is_between = (placing.start == placing.first) is (placing.sense > 0)
                key = "page.on_line" if is_between else "page.beyond"
                fields = {"point": symbol(placing.point), "start": symbol(placing.start)}
                yield words(key, bar=bar(placing.first, placing.second), **fields)
    for point, branch in scene.branches.items():
        if isinstance(branch, Side):
            yield side(words, point, branch.first, branch.second, branch.side)


def side(words: Words, point: str, p: str, q: str, sign: int) -> str:
    """Words for the side of a directed line."""
    key = "page.left_handed" if sign > 0 else "page.right_handed"
    return words(key, point=symbol(point), p=symbol(p), q=symbol(q))
