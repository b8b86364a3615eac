"""What is given, in words: parameters, drivers, lengths, points, sides, guides and wheels."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from math import degrees

from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import escape
from graphkin.paper.symbolic import bar, symbol
from graphkin.scene.expression import TIME
from graphkin.scene.model import (
    FRAME,
    Angled,
    At,
    Closure,
    Driver,
    Link,
    OnLine,
    Polar,
    Rolling,
    Scene,
    Side,
    Slide,
    Triangle,
    Way,
    Wheel,
)
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text import MINUS, Words

WHEELS = {
    (False, False): "page.wheel",
    (False, True): "page.wheel_teeth",
    (True, False): "page.ring",
    (True, True): "page.ring_teeth",
}
"""The sentences of wheels and of rings, without teeth and with them."""
ROLLS = {
    (False, False): "page.rolls_wheel",
    (False, True): "page.meshes",
    (True, False): "page.rolls_fixed",
    (True, True): "page.meshes_fixed",
}
"""The sentences of wheels on moving and on fixed ones, without teeth and with them."""
LONGEST = 9
"""Signs of the longest number printed in full among the data."""


def given(drawing: Drawing) -> list[str]:
    """The data of a scene as short pieces of markup, in the order of the scene."""
    scene, words = drawing.scene, drawing.words
    return [
        *parameters(drawing),
        *(piece for driver in scene.drivers for piece in of_driver(scene, words, driver)),
        *lengths(scene, words),
        *fixed_points(scene, words),
        *plates(scene, words),
        *sides(scene, words),
        *(of_guide(drawing, link, slide) for link in scene.links.values() for slide in link.slides),
        *wheels(scene, words),
        *tracks(scene, words),
        *closures(scene, words),
        *(escape(note) for note in [scene.notes.get(words.language)] if note),
    ]


def parameters(drawing: Drawing) -> list[str]:
    """The parameters as set."""
    values = drawing.scene.values
    return [parameter(drawing.words, name, value) for name, value in values.items()]


def parameter(words: Words, name: str, value: object) -> str:
    """A parameter as set; t is the moment of laws of time, in seconds."""
    unit = " s" if name == TIME else ""
    return f"*{escape(name)}* = {words.decimal(shortest(value))}{unit}"


def written(scene: Scene, words: Words, quantity: Quantity) -> str:
    """A quantity as printed: in its written unit, in the language's own way."""
    unit = words(f"unit.{quantity.unit}") if words.has(f"unit.{quantity.unit}") else quantity.unit
    text = quantity.written(scene.values)
    if len(text) > LONGEST:
        text = f"{float(text):.{LONGEST - 3}g}"
    return words.decimal(text) + ("" if unit == "°" else " ") + unit


def of_driver(scene: Scene, words: Words, driver: Driver) -> Iterator[str]:
    """Position, speed and acceleration of a driver."""
    speed = "*v*"
    if driver.kind == "turn":
        speed = "*n*" if driver.speed.unit.startswith("rev") else "*ω*"
    index = f"_{{{driver_index(driver)}}}"
    yield f"{angle_symbol(scene, driver)} = {written(scene, words, driver.position)}"
    steady = driver.acceleration.is_zero()
    tail = f" = {words('page.constant')}" if steady else ""
    yield f"{speed}{index} = {with_sense(scene, words, driver, driver.speed, tail)}"
    if not steady:
        rate = "*ε*" if driver.kind == "turn" else "*a*"
        yield f"{rate}{index} = {with_sense(scene, words, driver, driver.acceleration)}"


def driver_index(driver: Driver) -> str:
    """Markup of a driver's index: its link, and the one it moves against where that moves."""
    index = escape(driver.link)
    return index if driver.against == FRAME else f"{index}/{escape(driver.against)}"


def with_sense(
    scene: Scene, words: Words, driver: Driver, quantity: Quantity, tail: str = ""
) -> str:
    """A driver's speed or acceleration; of a crank the magnitude, and its sense in words."""
    text, value = written(scene, words, quantity), float(quantity.si(scene.values))
    if driver.kind != "turn" or not value:
        return text + tail
    key = "page.turning_anticlockwise" if value > 0 else "page.turning_clockwise"
    return f"{text.removeprefix(MINUS)}{tail}, {words(key)}"


def angle_symbol(scene: Scene, driver: Driver) -> str:
    """Symbol of a driver's position, with its link's name where several drive or one moves."""
    many = len(scene.drivers) > 1 or driver.against != FRAME
    index = f"_{{{driver_index(driver)}}}" if many else ""
    return ("*φ*" if driver.kind == "turn" else "*s*") + index


def lengths(scene: Scene, words: Words) -> Iterator[str]:
    """The lengths of bars, those of equal length together."""
    equal: dict[str, list[str]] = {}
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            for p, q, length in placing.lengths():
                equal.setdefault(written(scene, words, length), []).append(bar(p, q))
    for text, bars in equal.items():
        yield " = ".join([*bars, text])


def fixed_points(scene: Scene, words: Words) -> Iterator[str]:
    """The coordinates of the frame's points."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            yield f"{coordinates(scene, words, placing)} {placing.x.unit}"


def plates(scene: Scene, words: Words) -> Iterator[str]:
    """Points of links that are given by coordinates or by an angle."""
    for link in (scene.frame, *scene.links.values()):
        fixed = link is scene.frame
        places = [placing for placing in link.placings if isinstance(placing, At)]
        if not fixed and len(places) > 1:
            points = ", ".join(coordinates(scene, words, placing) for placing in places)
            yield f"{points} {places[0].x.unit}, {words('page.on_link', k=escape(link.name))}"
        for placing in link.placings:
            point = symbol(placing.point)
            if isinstance(placing, Polar):
                key = "page.polar_frame" if fixed else "page.polar"
                turn = written(scene, words, placing.angle)
                yield words(key, bar=bar(placing.start, placing.point), angle=turn)
            elif isinstance(placing, Angled):
                turn = written(scene, words, placing.angle)
                yield f"∠{symbol(placing.arm)}{symbol(placing.vertex)}{point} = {turn}"


def coordinates(scene: Scene, words: Words, placing: At) -> str:
    """A point with its coordinates."""
    x, y = (words.decimal(q.written(scene.values)) for q in (placing.x, placing.y))
    return f"{symbol(placing.point)} ({x}; {y})"


def sides(scene: Scene, words: Words) -> Iterator[str]:
    """The sides on which points lie, of plates and of closures."""
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            if isinstance(placing, Triangle):
                yield side(words, placing.point, placing.first, placing.second, placing.side)
            elif isinstance(placing, OnLine):
                key = "page.on_line" if lies_between(placing) else "page.beyond"
                fields = {"point": symbol(placing.point), "start": symbol(placing.start)}
                yield words(key, bar=bar(placing.first, placing.second), **fields)
    for point, branch in scene.branches.items():
        if isinstance(branch, Side):
            yield side(words, point, branch.first, branch.second, branch.side)


def lies_between(placing: OnLine) -> bool:
    """True for a point on the bar itself, false for one on the bar produced."""
    return (placing.start == placing.first) is (placing.sense > 0)


def side(words: Words, point: str, p: str, q: str, sign: int) -> str:
    """Words for the side of a directed line."""
    key = "page.left_handed" if sign > 0 else "page.right_handed"
    return words(key, point=symbol(point), p=symbol(p), q=symbol(q))


def of_guide(drawing: Drawing, link: Link, slide: Slide) -> str:
    """Words for a block's guide, and for which of the two crossings it stands at."""
    scene, words = drawing.scene, drawing.words
    fields = {"point": symbol(link.points[0]), "way": which_way(drawing, link, slide)}
    fields["offset"] = aside(drawing, slide)
    if slide.along:
        fields["line"] = bar(*slide.along)
    else:
        fields["line"] = straight(scene, words, slide)
    return words("page.slot" if slide.pin else "page.guide", **fields)


def which_way(drawing: Drawing, link: Link, slide: Slide) -> str:
    """Words for the one of two closures at which a block stands, seen from a known pin."""
    words, branch, line = drawing.words, drawing.scene.branches.get(link.name), drawing.guide(slide)
    if not isinstance(branch, Way) or slide is not link.slides[0]:
        return ""
    if line and link.name in drawing.pivots:
        side = words(f"page.{heading(line[1] * branch.way)}")
        return words("page.way", side=side, pivot=symbol(drawing.pivots[link.name]))
    return words("page.forward" if branch.way > 0 else "page.backward")


def aside(drawing: Drawing, slide: Slide) -> str:
    """Words for the distance that a block's point keeps from the line it slides along."""
    if slide.offset.is_zero():
        return ""
    words, line = drawing.words, drawing.guide(slide)
    amount = written(drawing.scene, words, slide.offset).removeprefix(MINUS)
    sign = 1 if float(slide.offset.si(drawing.scene.values)) > 0 else -1
    if line:
        side = words(f"page.{heading(1j * line[1] * sign)}")
    else:
        side = words("page.left" if sign > 0 else "page.right")
    return words("page.offset", offset=amount, side=side)


def straight(scene: Scene, words: Words, path: Slide | Rolling) -> str:
    """Words for a line of a link through a point at an angle to its axis."""
    assert path.angle is not None and path.through is not None
    fields = {"through": place(scene, words, path.through), "k": escape(path.on)}
    fields["angle"] = words.decimal(path.angle.written(scene.values))
    return words("page.line" if path.on == FRAME else "page.line_of", **fields)


def place(scene: Scene, words: Words, through: str | tuple[Quantity, Quantity]) -> str:
    """The name of a point, or its coordinates with their unit."""
    if isinstance(through, str):
        return symbol(through)
    x, y = (words.decimal(q.written(scene.values)) for q in through)
    return f"({x}; {y}) {through[0].unit}"


def wheels(scene: Scene, words: Words) -> Iterator[str]:
    """The wheels: centre and radius, of gears the number of teeth and the module."""
    for link in (scene.frame, *scene.links.values()):
        for wheel in link.wheels:
            yield words(
                WHEELS[wheel.inside, wheel.teeth is not None],
                **of_wheel(scene, words, wheel),
                k=link_name(words, link.name),
            )


def of_wheel(scene: Scene, words: Words, wheel: Wheel) -> dict[str, str]:
    """The words for a wheel's centre and size."""
    assert wheel.radius is not None
    fields = {"centre": symbol(wheel.centre)}
    if wheel.teeth is None:
        return {**fields, "radius": written(scene, words, wheel.radius)}
    teeth = wheel.teeth.written(scene.values)
    return {**fields, "teeth": teeth, "module": module(scene, words, wheel)}


def module(scene: Scene, words: Words, wheel: Wheel) -> str:
    """The module of a gear: its pitch circle's diameter over its number of teeth."""
    assert wheel.radius is not None and wheel.teeth is not None
    size = 2 * wheel.radius.number(scene.values) / wheel.teeth.number(scene.values)
    return f"{words.decimal(shortest(size))} {wheel.radius.unit}"


def link_name(words: Words, name: str) -> str:
    """The name of a link, of the frame in words."""
    return words("page.fixed") if name == FRAME else escape(name)


def tracks(scene: Scene, words: Words) -> Iterator[str]:
    """What rolls on what, and the start from which it counts; then that there is no slip."""
    for link in scene.links.values():
        for rolling in link.rolls:
            fields = {"k": escape(link.name), "start": start_of(scene, words, link, rolling)}
            if rolling.angle is None:
                toothed = any(w.teeth for w in (*link.wheels, *scene.link(rolling.on).wheels))
                key = ROLLS[rolling.on == FRAME, toothed]
                yield words(key, other=escape(rolling.on), **fields)
            else:
                side = words("page.beneath") if rolling.side < 0 else ""
                key = "page.rack" if any(w.teeth for w in link.wheels) else "page.rolls"
                yield words(key, line=straight(scene, words, rolling), side=side, **fields)
    if any(link.rolls for link in scene.links.values()):
        yield words("page.no_slip")


def start_of(scene: Scene, words: Words, link: Link, rolling: Rolling) -> str:
    """Words for the angles at which a wheel touches its track where the track begins."""
    start = rolling.start
    if rolling.angle is None:
        angles = [(name, start[name]) for name in start if not start[name].is_zero()]
    else:
        angles = [(link.name, start[link.name])] if link.name in start else []
    text = [f"*φ*_{{{escape(name)}}} = {written(scene, words, angle)}" for name, angle in angles]
    if rolling.angle is None:
        return words("page.counted", angles=", ".join(text)) if text else ""
    assert rolling.through is not None
    said = ", ".join(text) or f"*φ*_{{{escape(link.name)}}} = 0°"
    return words("page.start", through=place(scene, words, rolling.through), angles=said)


def closures(scene: Scene, words: Words) -> Iterator[str]:
    """The numbers of the closures of groups of higher class."""
    for name, branch in scene.branches.items():
        if isinstance(branch, Closure):
            yield words("page.closure", k=escape(name), number=str(branch.number))


def heading(way: complex) -> str:
    """Which side of a point a direction leads to: the nearest of right, above, left, below."""
    sides = ("right", "above", "left", "below")
    return sides[round(degrees(phase(way)) / 90) % 4]
