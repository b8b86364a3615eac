"""What is given of slides, wheels and closures, in words."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from math import degrees

from graphkin.paper.amounts import written
from graphkin.paper.drawing import Drawing
from graphkin.paper.richtext import escape
from graphkin.paper.settings import after_parameter
from graphkin.paper.symbolic import bar, symbol
from graphkin.scene.contacts import contact_letters
from graphkin.scene.model import FRAME, Closure, Link, Rolling, Scene, Slide, Way, Wheel
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
        return {**fields, "radius": after_parameter(scene, words, wheel.radius, "r")}
    teeth = after_parameter(scene, words, wheel.teeth, "z")
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
    """What rolls on what in which point, and the start it counts from; that there is no slip."""
    letters = contact_letters(scene)
    for link in scene.links.values():
        for rolling, letter in zip(link.rolls, letters.get(link.name, ()), strict=True):
            fields = {"k": escape(link.name), "start": start_of(scene, words, link, rolling)}
            fields["touch"] = symbol(letter)
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
