"""Normal components: by hand the right triangle on the mechanism, then laid off in the plan."""

from __future__ import annotations

from string import digits

from graphkin.plans.arrows import relative_arrow
from graphkin.plans.pen import Pen, Says, about, against, letter, named, owned
from graphkin.steps.effect import Effect
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    bar_line,
    join,
    lay_off,
    meet,
    normal,
    normal_by_hand,
    set_velocity,
    square_at,
    square_to,
    turn_over,
)


def normal_component(pen: Pen, pivot: str, pin: str) -> int:
    """The normal component of a pin about a pivot; by hand the right triangle on the mechanism."""
    key = ("normal", pivot, pin)
    if key in pen.shared:
        return pen.shared[key]
    places = pen.the("position", pivot), pen.the("position", pin)
    images = pen.the("velocity", pivot), pen.the("velocity", pin)
    relative_arrow(pen, pin, pivot)
    index = about(pen, pin, pivot)
    says: Says = {"p": letter(pivot), "q": letter(pin), "i": index, "v": against(pen, pin, pivot)}
    with pen.on(Part.NORMAL, Plane.MECHANISM), pen.calls_for(Effect.NORMAL):
        by_hand = right_triangle(pen, places, images, says)
    with pen.on(Part.NORMAL, Plane.NUMBERS), pen.calls_for(Effect.NORMAL):
        name = f"a_{index}^ν"
        return pen.draw_shared(key, normal, *places, *images, name=name, by_hand=by_hand, **says)


def right_triangle(pen: Pen, places: tuple[int, int], images: tuple[int, int], says: Says) -> int:
    """Velocity at the pin, perpendicular at its tip, cut with the bar, turned over (figure 4)."""
    seconds = pen.seconds()
    pivot, pin = places
    letter, index = bare(says["q"]), says["i"]
    with pen.hands_way():
        tip = pen.draw(set_velocity, pin, *images, seconds, name=f"{letter}″_{index}", **says)
        edge = pen.draw(square_at, tip, pivot, **says, tip=f"{letter}″_{index}")
        line = pen.draw(bar_line, pivot, pin, **says)
        cut = pen.draw(meet, edge, line, name=f"{letter}‴_{index}", **says)
        end = pen.draw(turn_over, cut, pin, name=f"{letter}⁗_{index}", **says)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            return pen.draw(normal_by_hand, pin, end, seconds, **says)


def bare(point: str) -> str:
    """The small letter of a point without its index: b for B, B2 and B_left."""
    return point.partition(",")[0].partition("_")[0].rstrip(digits).lower()


def lay_off_normal(pen: Pen, pivot: str, pin: str, vector: int) -> int:
    """The normal component laid off from the pivot's second image, parallel to the bar."""
    start = pen.the("acceleration", pivot)
    says: Says = {"p": letter(pivot), "q": letter(pin), "s": named(pen, start)}
    says["i"] = about(pen, pin, pivot)
    with pen.calls_for(Effect.NORMAL):
        end = pen.draw(lay_off, start, vector, **says)
    component_arrow(pen, start, end, "ν", pin, pivot)
    return end


def square(pen: Pen, pivot: str, pin: str, corner: int) -> int:
    """Through the end of a normal component the perpendicular to its bar."""
    ends = pen.the("position", pivot), pen.the("position", pin)
    says: Says = {"p": letter(pivot), "q": letter(pin), "i": about(pen, pin, pivot)}
    says |= {"w": owned(pin), "x": owned(pivot)}
    with pen.calls_for(Effect.TANGENTIAL):
        return pen.draw(square_to, corner, *ends, **says)


def component_arrow(pen: Pen, tail: int, tip: int, kind: str, pin: str, pivot: str) -> None:
    """The arrow of a normal (ν) or tangential (τ) component."""
    symbol = f"a_{about(pen, pin, pivot)}^{kind}"
    pen.arrow(join, tail, tip, name=symbol, symbol=symbol, kind=kind, q=owned(pin), p=owned(pivot))
