"""Lines of links in words a hand can draw by: through which point, at what angle to what."""

from __future__ import annotations

from cmath import phase
from math import degrees

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.quantities import in_mm, number_of, written
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.model import FRAME, At, GuideOrTrack, Link
from graphkin.scene.quantity import Quantity, shortest

FINE = 4
"""Decimals of angles and places that are reckoned from those of the scene."""


def straight(drawing: Drawing, path: GuideOrTrack, *, on_paper: bool = False) -> str:
    """A line through a point at an angle: to the axis of the frame, or of a link that turns.

    Its point is told as the scene has it, or as it is drawn.
    """
    assert path.angle is not None and path.through is not None
    words, link = drawing.words, drawing.scene.link(path.on)
    through = place(drawing, path.on, path.through, on_paper=on_paper)
    fields = {"k": escape(path.on), "through": through}
    if path.on == FRAME:
        return words("page.line", angle=written(drawing.scene, words, path.angle), **fields)
    lean = leaning(drawing, link)
    if lean is not None:
        turn = lean * complex(path.angle.direction(drawing.scene.values))
        return words("page.line_moved", angle=f"{number(drawing, degrees(phase(turn)))}°", **fields)
    if path.angle.is_zero() and not (len(link.points) > 1 or bool(link.slides)):
        return words("page.line_free", **fields)
    turn_to = written(drawing.scene, words, path.angle)
    return words("page.line_of", angle=turn_to, axis=axis_of(drawing, link), **fields)


def place(
    drawing: Drawing, on: str, through: str | tuple[Quantity, Quantity], *, on_paper: bool = False
) -> str:
    """A point by its name, or by its coordinates; on a link that does not turn from its pin.

    The coordinates are as the scene has them, or as they are drawn.
    """
    if isinstance(through, str):
        return symbol(through)
    words, link = drawing.words, drawing.scene.link(on)
    lean, away, pin = leaning(drawing, link), metres(drawing, through), ""
    if lean is not None and link.points:
        start = next(p for p in link.placings if isinstance(p, At) and p.point == link.points[0])
        away, pin = (away - metres(drawing, (start.x, start.y))) * lean, start.point
    unit = "mm" if on_paper else through[0].unit
    if on_paper:
        x, y = (in_mm(words, drawing.on_paper(part)) for part in (away.real, away.imag))
    elif pin:
        x, y = (number(drawing, drawing.length(part)) for part in (away.real, away.imag))
    else:
        x, y = (number_of(drawing.scene, words, each) for each in through)
    if not pin:
        return f"{drawing.words.place(x, y)} {unit}"
    return words("page.away", place=words.place(x, y), unit=unit, point=symbol(pin))


def metres(drawing: Drawing, pair: tuple[Quantity, Quantity]) -> complex:
    """A point of a link by its coordinates."""
    return complex(*(float(each.si(drawing.scene.values)) for each in pair))


def leaning(drawing: Drawing, link: Link) -> complex | None:
    """The direction of the axis of a link that a guide of the frame keeps from turning."""
    if link.name == FRAME or not link.slides or link.slides[0].on != FRAME:
        return None
    if len(link.points) != 1:
        return None
    return drawing.standing.axis(link.name)


def axis_of(drawing: Drawing, link: Link) -> str:
    """The *x* axis of a link by what is drawn: its bar, its guide, or as the axis of the link.

    What keeps a wheel on a track is not drawn: its axis is the track.
    """
    scene = drawing.scene
    if link.name in scene.unseen and link.slides:
        _, track = scene.keepers[link.name]
        if track.angle is not None and track.angle.is_zero():
            return axis_of(drawing, scene.link(track.on))
        return drawing.words("page.axis_track", k=escape(track.on))
    own = drawing.words("page.axis_link", k=escape(link.name))
    if len(link.points) > 1:
        coordinates = sum(isinstance(placing, At) for placing in link.placings)
        return own if coordinates > 1 else bar(*link.points[:2])
    if link.slides and link.slides[0].along:
        return bar(*link.slides[0].along)
    blocks = [other for other in scene.links.values() if is_along(other, link)]
    for block in (link, *blocks):
        if block.slides and block.name not in scene.unseen:
            return drawing.words("page.axis_guide", g=escape(block.name))
    return own


def is_along(block: Link, link: Link) -> bool:
    """True for a block that slides along the axis of another link."""
    ways = (slide for slide in block.slides if slide.on == link.name)
    return any(way.angle is not None and way.angle.is_zero() for way in ways)


def number(drawing: Drawing, value: float) -> str:
    """A reckoned number without noughts at its end, never minus nought."""
    return drawing.words.decimal(shortest(round(value, FINE) + 0.0))


def heading(way: complex) -> str:
    """Which side of a point a direction leads to: the nearest of right, above, left, below."""
    sides = ("right", "above", "left", "below")
    return sides[round(degrees(phase(way)) / 90) % 4]
