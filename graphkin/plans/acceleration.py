"""The acceleration plan: normal components by the right triangle, perpendiculars, crossings."""

from __future__ import annotations

from graphkin.plans.links import Base, crank_tip
from graphkin.plans.pen import PRIME, Pen, Says, about, second_image
from graphkin.plans.position import crosses_well
from graphkin.plans.shape import Shapes
from graphkin.plans.velocity import along_guide, named
from graphkin.steps.program import Part, Plane
from graphkin.steps.vocabulary import (
    alike,
    bar_line,
    centripetal,
    driven_tangential,
    epsilon,
    join,
    lay_off,
    meet,
    normal,
    normal_by_hand,
    set_on_twice,
    set_velocity,
    similar_point,
    square_at,
    square_to,
    turn_over,
)
from graphkin.structure.graph import Pin
from graphkin.structure.groups import Crank, Dyad


def frame(pen: Pen) -> None:
    """All fixed points have their image in the pole o′."""
    for point in pen.scene.frame.points:
        pen.want("acceleration", point, pen.pole(Plane.ACCELERATIONS))


def crank(pen: Pen, group: Crank) -> None:
    """Acceleration of a driven tip: from tip to pivot, and square to the bar if it speeds up."""
    pivot, tip = group.pivot, crank_tip(pen.scene, group)
    ends = pen.the("position", pivot), pen.the("position", tip)
    start = pen.the("acceleration", pivot)
    says: Says = {"p": pivot, "q": tip, "s": named(pen, start)}
    rate = pen.given("number", group.driver.acceleration, name="epsilon")
    pen.want("epsilon", group.link, rate)
    steady = group.driver.acceleration.is_zero()
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        name = second_image(tip) if steady else ""
        found = pen.draw(centripetal, start, *ends, pen.the("omega", group.link), name=name, **says)
        if not steady:
            component_arrow(pen, start, found, "ν", tip, pivot)
            corner = found
            found = pen.draw(driven_tangential, found, *ends, rate, name=second_image(tip), **says)
            component_arrow(pen, corner, found, "τ", tip, pivot)
    pen.want("acceleration", tip, found)
    arrow_to(pen, tip)


def dyad(pen: Pen, group: Dyad) -> None:
    """Second image of an inner pin: normal components laid off, tangential ones crossed."""
    assert isinstance(group.left, Pin) and isinstance(group.inner, Pin)
    left, pin = group.left.point, group.inner.point
    rights = [group.right.point] if isinstance(group.right, Pin) else []
    normals = {pivot: normal_component(pen, pivot, pin) for pivot in (left, *rights)}
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        lines: list[int] = []
        corners: dict[str, int] = {}
        for pivot, vector in normals.items():
            corners[pivot] = lay_off_normal(pen, pivot, pin, vector)
            lines.append(square(pen, pivot, pin, corners[pivot]))
        if not isinstance(group.right, Pin):
            lines.append(along_guide(pen, group.right, Plane.ACCELERATIONS))
        found = pen.draw(meet, *lines, name=second_image(pin))
        for pivot, corner in corners.items():
            component_arrow(pen, corner, found, "τ", pin, pivot)
    pen.want("acceleration", pin, found)
    arrow_to(pen, pin)


def normal_component(pen: Pen, pivot: str, pin: str) -> int:
    """The normal component of a pin about a pivot; by hand the right triangle on the mechanism."""
    places = pen.the("position", pivot), pen.the("position", pin)
    images = pen.the("velocity", pivot), pen.the("velocity", pin)
    index = about(pen, pin, pivot)
    says: Says = {"p": pivot, "q": pin, "i": index}
    with pen.on(Part.NORMAL, Plane.MECHANISM):
        by_hand = right_triangle(pen, places, images, says)
    with pen.on(Part.NORMAL, Plane.NUMBERS):
        name = f"a_{index}^ν"
        return pen.draw(normal, *places, *images, name=name, by_hand=by_hand, **says)


def right_triangle(pen: Pen, places: tuple[int, int], images: tuple[int, int], says: Says) -> int:
    """Velocity at the pin, perpendicular at its tip, cut with the bar, turned over (figure 4)."""
    seconds = pen.seconds()
    pivot, pin = places
    letter, index = says["q"].lower(), says["i"]
    with pen.hands_way():
        tip = pen.draw(set_velocity, pin, *images, seconds, name=f"{letter}″_{index}", **says)
        edge = pen.draw(square_at, tip, pivot, **says, tip=f"{letter}″_{index}")
        line = pen.draw(bar_line, pivot, pin, **says)
        cut = pen.draw(meet, edge, line, name=f"{letter}‴_{index}", **says)
        end = pen.draw(turn_over, cut, pin, name=f"{letter}⁗_{index}", **says)
        with pen.on(Part.NORMAL, Plane.NUMBERS):
            return pen.draw(normal_by_hand, pin, end, seconds, **says)


def lay_off_normal(pen: Pen, pivot: str, pin: str, vector: int) -> int:
    """The normal component laid off from the pivot's second image, parallel to the bar."""
    start = pen.the("acceleration", pivot)
    says: Says = {"p": pivot, "q": pin, "s": named(pen, start), "i": about(pen, pin, pivot)}
    end = pen.draw(lay_off, start, vector, **says)
    component_arrow(pen, start, end, "ν", pin, pivot)
    return end


def square(pen: Pen, pivot: str, pin: str, corner: int) -> int:
    """Through the end of a normal component the perpendicular to its bar."""
    ends = pen.the("position", pivot), pen.the("position", pin)
    return pen.draw(square_to, corner, *ends, p=pivot, q=pin, i=about(pen, pin, pivot))


def plate_points(pen: Pen, shapes: Shapes, base: Base) -> None:
    """Second images of the other points of a link, similar to the link (Mehmke)."""
    if base.end is None:
        block_points(pen, base)
        return
    ends = pen.the("acceleration", base.start), pen.the("acceleration", base.end)
    for point in base.others:
        if pen.has("acceleration", point):
            continue
        by_hand: int | None = None
        corners: dict[str, int] = {}
        if crosses_well(pen, shapes, base, point):
            by_hand, corners = two_perpendiculars(pen, base, point)
        ratio = shapes.ratio(base.link, base.start, base.end, point)
        says: Says = {"p": base.start, "q": base.end, "r": point}
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            found = pen.draw(
                similar_point, *ends, ratio, name=second_image(point), by_hand=by_hand, **says
            )
            for pivot, corner in corners.items():
                component_arrow(pen, corner, found, "τ", point, pivot)
        pen.want("acceleration", point, found)
        arrow_to(pen, point)


def block_points(pen: Pen, base: Base) -> None:
    """All points of a block on a fixed guide have one second image."""
    for point in base.others:
        if not pen.has("acceleration", point):
            start = pen.the("acceleration", base.start)
            with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
                found = pen.draw(alike, start, name=second_image(point), p=base.start, q=point)
            pen.want("acceleration", point, found)
            arrow_to(pen, point)


def two_perpendiculars(pen: Pen, base: Base, point: str) -> tuple[int, dict[str, int]]:
    """The hand's way to a plate point: normal and perpendicular about each end of the base."""
    assert base.end is not None
    lines: list[int] = []
    corners: dict[str, int] = {}
    with pen.hands_way():
        for pivot in (base.start, base.end):
            vector = normal_component(pen, pivot, point)
            with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
                corners[pivot] = lay_off_normal(pen, pivot, point, vector)
                lines.append(square(pen, pivot, point, corners[pivot]))
        with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
            return pen.draw(meet, *lines), corners


def turning(pen: Pen, base: Base) -> None:
    """Angular acceleration of a link: tangential component over length, with its sense."""
    if base.end is None or pen.has("epsilon", base.link):
        return
    ends = [
        pen.the(what, point)
        for what in ("position", "acceleration")
        for point in (base.start, base.end)
    ]
    with pen.on(Part.RESULT, Plane.NUMBERS):
        found = pen.draw(epsilon, *ends, name=base.link, p=base.start, q=base.end)
    pen.want("epsilon", base.link, found)


def arrow_to(pen: Pen, pin: str) -> None:
    """The arrow from the pole to a second image, and the same acceleration on the mechanism."""
    o, tip = pen.pole(Plane.ACCELERATIONS), pen.the("acceleration", pin)
    with pen.on(Part.ACCELERATION, Plane.ACCELERATIONS):
        pen.arrow(join, o, tip, name=f"o{PRIME}{second_image(pin)}", symbol=f"a_{pin}", q=pin, p="")


def set_on_mechanism(pen: Pen, point: str) -> None:
    """The absolute acceleration of a point, set on the mechanism."""
    o = pen.pole(Plane.ACCELERATIONS)
    ends = pen.the("position", point), o, pen.the("acceleration", point)
    with pen.on(Part.ACCELERATION, Plane.MECHANISM):
        name = f"a_{point}"
        pen.arrow(set_on_twice, *ends, pen.seconds(), name=name, symbol=name)


def component_arrow(pen: Pen, tail: int, tip: int, kind: str, pin: str, pivot: str) -> None:
    """The arrow of a normal (ν) or tangential (τ) component."""
    symbol = f"a_{about(pen, pin, pivot)}^{kind}"
    pen.arrow(join, tail, tip, name=symbol, symbol=symbol, kind=kind, q=pin, p=pivot)
