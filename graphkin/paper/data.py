"""What is given, in words: parameters, driver, lengths, fixed points, sides and guides."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from math import degrees

from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import escape
from graphkin.paper.symbolic import bar, symbol
from graphkin.scene.expression import TIME
from graphkin.scene.model import (
    Angled,
    At,
    Driver,
    Link,
    OnLine,
    Polar,
    Scene,
    Side,
    Slide,
    Triangle,
    Way,
)
from graphkin.scene.quantity import Quantity, shortest
from graphkin.text import MINUS, Words

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
    speed = "*n*" if driver.kind == "turn" else "*v*"
    if not driver.speed.unit.startswith("rev"):
        speed = "*ω*" if driver.kind == "turn" else "*v*"
    index = f"_{{{escape(driver.link)}}}"
    yield f"{angle_symbol(scene, driver)} = {written(scene, words, driver.position)}"
    steady = driver.acceleration.is_zero()
    tail = f" = {words('page.constant')}" if steady else ""
    yield f"{speed}{index} = {with_sense(scene, words, driver, driver.speed, tail)}"
    if not steady:
        yield f"*ε*{index} = {with_sense(scene, words, driver, driver.acceleration)}"


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
    """Symbol of a driver's position, with its link's name where several drive."""
    index = f"_{{{escape(driver.link)}}}" if len(scene.drivers) > 1 else ""
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
    line = drawing.guide(slide)
    fields = {"point": symbol(link.points[0]), "way": "", "offset": ""}
    branch = scene.branches.get(link.name)
    if line and isinstance(branch, Way) and link.name in drawing.pivots:
        side = words(f"page.{heading(line[1] * branch.way)}")
        fields["way"] = words("page.way", side=side, pivot=symbol(drawing.pivots[link.name]))
    if line and not slide.offset.is_zero():
        amount = written(scene, words, slide.offset).removeprefix(MINUS)
        sign = 1 if float(slide.offset.si(scene.values)) > 0 else -1
        side = words(f"page.{heading(1j * line[1] * sign)}")
        fields["offset"] = words("page.offset", offset=amount, side=side)
    if slide.along:
        return words("page.guide_along", bar=bar(*slide.along), **fields)
    assert slide.angle is not None
    fields["angle"] = words.decimal(slide.angle.written(scene.values))
    if isinstance(slide.through, str):
        return words("page.guide", through=symbol(slide.through), **fields)
    assert slide.through is not None
    x, y = (words.decimal(q.written(scene.values)) for q in slide.through)
    return words("page.guide_xy", x=x, y=y, unit=slide.through[0].unit, **fields)


def heading(way: complex) -> str:
    """Which side of a point a direction leads to: the nearest of right, above, left, below."""
    sides = ("right", "above", "left", "below")
    return sides[round(degrees(phase(way)) / 90) % 4]
