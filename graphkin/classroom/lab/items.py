"""The fields of a lab's form: what a student reads off the drawing, computes, and gives a sense to.

Every field has a name in plain letters, for files and rubrics. v_D_mm is the segment measured in
the plan, and v_D the velocity in m/s. omega_3 is in rad/s, and omega_3_sense its sense.
R_12_mm is a side of a polygon of forces, R_12 the reaction of link 1 on link 2 in N. J_3_x_mm is
a place on paper, measured to the right and up from the first fixed pivot. The components ν, τ and c
are written nu, tau and cor.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from fractions import Fraction

from msgspec.structs import replace

from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.construction.core.program import PlanVector, Program, plan_vector
from graphkin.construction.core.quantities import (
    BY_TARGET,
    CENTRES,
    FORCES,
    RATES,
    SHEETS,
    SLIDING,
    STROKE,
    SWING,
    TIME_RATIO,
    TRAVEL,
    VECTORS,
    MotionQuantity,
    names_asked,
)
from graphkin.construction.forces.loads import STRANDS, is_asked
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.mechanism import Mechanism
from graphkin.scene.forces import Forces
from graphkin.scene.link_points import lettered, point_of
from graphkin.scene.model import Scene
from graphkin.text import words
from graphkin.text.school_signs import USUAL, SchoolSigns

GREEK = {"ν": "nu", "τ": "tau", "c": "cor"}
ARROW = "arrow"
"""The quantity of a field that is an arrow of a plan, identified by its symbol (``Item.of``)."""
UNITS = {each.plane: each.unit for each in VECTORS}


def items(mechanism: Mechanism, lab: Lab) -> tuple[Item, ...]:
    """The fields of a lab's form: what the scene asks, then what else the rubric names."""
    asked = asked_fields(mechanism)
    more = {name: item for name, item in all_fields(mechanism).items() if name not in asked}
    return (*asked.values(), *(more[name] for name in more if name in lab.rubric.points))


def asked_fields(mechanism: Mechanism) -> dict[str, Item]:
    """The fields that the scene asks for, in the order of its [ask]."""
    return named(printed(mechanism, asked(mechanism)))


def all_fields(mechanism: Mechanism) -> dict[str, Item]:
    """Every field that a rubric may name: what is asked, all motions, and each arrow of a plan."""
    shown = arrows(mechanism.program, mechanism.scene.sheet.signs)
    return named(printed(mechanism, [*asked(mechanism), *moving(mechanism), *shown]))


def printed(mechanism: Mechanism, found: Iterable[Item]) -> Iterator[Item]:
    """Items with their units as the sheets print them: in/s for a scene in inches."""
    unit = words("en", length=mechanism.scene.unit_of_results).unit
    for item in found:
        own = item.unit if item.unit == "mm" else unit(item.unit)
        yield item if own == item.unit else replace(item, unit=own)


def named(found: Iterable[Item]) -> dict[str, Item]:
    """Items by their fields.

    A repeated field is kept once. Another quantity with the same name gets a tail, except an arrow,
    which is then dropped.
    """
    fields: dict[str, Item] = {}
    for item in found:
        own, tail = item, 1
        while own.field in fields and meant(fields[own.field]) != meant(item):
            if item.quantity == ARROW:
                break  # the vector itself is already a field
            tail += 1
            own = replace(item, tail=f"_{tail}")
        fields.setdefault(own.field, own)
    return fields


def meant(item: Item) -> tuple[str, str]:
    """The quantity of an item, and its point or link."""
    return item.quantity, item.of


def asked(mechanism: Mechanism) -> Iterator[Item]:
    """The items that the scene asks for; everything it can ask where it asks nothing."""
    ask, scene = mechanism.scene.ask, mechanism.scene
    forces = scene.forces
    nothing = not ask.anything and not (forces is not None and forces.asked)
    for quantity in VECTORS:
        points = [point_of(scene, name) for name in names_asked(ask, quantity)]
        for point in moving_points(mechanism) if nothing else points:
            yield from vector_items(quantity, point)
    for quantity in RATES:
        for link in scene.links if nothing else names_asked(ask, quantity):
            yield from rate_items(quantity, link, scene.sheet.signs)
    for block in ask.slides:
        yield from slide_items(block, scene.links[block].slides[0].on)
    for quantity in CENTRES:
        for name in names_asked(ask, quantity):
            own = point_of(scene, name) if quantity.whose == "points" else name
            if mechanism.gives((quantity.target, own)):
                yield from place_items(quantity, own)
    yield from travel_asked(scene)
    if forces is not None:
        yield from forces_asked(mechanism, forces)


def travel_asked(scene: Scene) -> Iterator[Item]:
    """The strokes, swings and time ratios that the scene asks for."""
    for name in scene.ask.strokes:
        yield travel_item(STROKE if scene.links[name].slides else SWING, name)
    for name in scene.ask.time_ratios:
        yield travel_item(TIME_RATIO, name)


def forces_asked(mechanism: Mechanism, forces: Forces) -> Iterator[Item]:
    """The reactions in the pairs that are asked, and the balance, by the symbols of the plan."""
    scene = mechanism.scene
    targets = mechanism.with_forces.program.targets
    asked = [target for target in targets if is_asked(scene, forces, target)]
    for quantity in FORCES:
        for target, name in asked:
            if target == quantity.target:
                yield from force_items(quantity, name, scene.sheet.signs)


def moving(mechanism: Mechanism) -> Iterator[Item]:
    """The motions of every point and link of a scene."""
    for quantity in VECTORS:
        for point in moving_points(mechanism):
            if mechanism.gives((quantity.target, point)):
                yield from vector_items(quantity, point)
    for quantity in RATES:
        for link in mechanism.scene.links:
            if mechanism.gives((quantity.target, link)):
                yield from rate_items(quantity, link, mechanism.scene.sheet.signs)


def motion_of(item: Item) -> MotionQuantity:
    """The quantity of an item; for an arrow, the quantity of its plan."""
    if item.vector is None:
        return BY_TARGET[item.quantity]
    return next(each for each in VECTORS if each.letter == item.vector.letter)


def moving_points(mechanism: Mechanism) -> list[str]:
    """The points that move, as the scene names them."""
    links = mechanism.scene.links.values()
    fixed = mechanism.scene.fixed_points
    return list(dict.fromkeys(p for link in links for p in link.points if p not in fixed))


def arrows(program: Program, signs: SchoolSigns) -> Iterator[Item]:
    """The vectors of the plans, with components, by their symbols."""
    for step in program.steps:
        vector = plan_vector(step)
        if vector is not None and step.plane in UNITS:
            yield from arrow_items(vector, UNITS[step.plane], signs)


def arrow_items(vector: PlanVector, unit: str, signs: SchoolSigns = USUAL) -> Iterator[Item]:
    """The segment of an arrow in its plan, and its true size."""
    tail = f"_{GREEK.get(vector.sign, plain(vector.sign))}" if vector.sign else ""
    name = f"{vector.letter}_{plain(vector.index)}{tail}"
    sign = symbol(vector.symbol, signs=signs)
    own = ARROW, vector.symbol, vector
    yield Item(name, "segment", sign, "mm", *own)
    yield Item(name, "value", sign, unit, *own)


def arrow_steps(program: Program) -> Mapping[str, int]:
    """The step of the arrow with each symbol; the first where there are several."""
    found: dict[str, int] = {}
    for number, step in enumerate(program.steps):
        vector = plan_vector(step)
        if vector is not None and step.plane in UNITS:
            found.setdefault(vector.symbol, number)
    return found


def vector_items(quantity: MotionQuantity, point: str) -> Iterator[Item]:
    """The segment of a vector in its plan, and its true size."""
    letter = quantity.letter
    name, sign = f"{letter}_{plain(point)}", symbol(f"{letter}_{lettered(point)}")
    yield from with_segment(name, sign, quantity, point)


def with_segment(name: str, sign: str, quantity: MotionQuantity, of: str) -> Iterator[Item]:
    """The segment of a vector, and its true size."""
    yield Item(name, "segment", sign, "mm", quantity.target, of)
    yield Item(name, "value", sign, quantity.unit, quantity.target, of)


def rate_items(quantity: MotionQuantity, link: str, signs: SchoolSigns = USUAL) -> Iterator[Item]:
    """An angular velocity or acceleration, and its sense."""
    sign = symbol(f"{quantity.letter}_{link}", signs=signs)
    yield from with_sense(f"{quantity.name}_{plain(link)}", sign, quantity, link)


def slide_items(block: str, guide: str) -> Iterator[Item]:
    """The speed and the acceleration of a block along its guide, each with its sense."""
    for sheet in SHEETS:
        letter = SLIDING[sheet].letter
        sign = f"*{letter}*_{{{escape(block)}/{escape(guide)}}}"
        yield from with_sense(f"{letter}_slide_{plain(block)}", sign, SLIDING[sheet], block)


def with_sense(name: str, sign: str, quantity: MotionQuantity, of: str) -> Iterator[Item]:
    """A magnitude and its sense."""
    yield Item(name, "value", sign, quantity.unit, quantity.target, of)
    yield Item(name, "sense", sign, "", quantity.target, of)


def force_items(quantity: MotionQuantity, name: str, signs: SchoolSigns = USUAL) -> Iterator[Item]:
    """A side of a polygon of forces and its force, or a balancing moment and its sense."""
    make = with_segment if quantity.sort == "vector" else with_sense
    field = plain(name)
    for strand, (prime, _) in STRANDS.items():
        if name.startswith(f"R{prime}_"):
            field = f"{plain(name.replace(prime, ''))}_{strand}"
    yield from make(field, symbol(name, signs=signs), quantity, name)


def travel_item(quantity: MotionQuantity, of: str) -> Item:
    """The stroke of a block, the swing of a link, or the time ratio of either."""
    sign = symbol(f"{quantity.letter}_{of}")
    return Item(f"{quantity.name}_{plain(of)}", "value", sign, quantity.unit, quantity.target, of)


def is_of_travel(item: Item) -> bool:
    """Whether a field takes the whole motion of a follower, not one position."""
    return motion_of(item) in TRAVEL


def place_items(quantity: MotionQuantity, of: str) -> Iterator[Item]:
    """The coordinates of a centre of a link or a point on paper, from the first fixed pivot."""
    for axis in ("x", "y"):
        name = f"{quantity.name}_{plain(of)}"
        sign = f"*{axis}*({symbol(f'{quantity.letter}_{lettered(of)}')})"
        yield Item(name, "place", sign, "mm", quantity.target, of, axis=axis)


def plain(name: str) -> str:
    """A name as part of a field: A@3 becomes A3 where this is unambiguous, else A_3."""
    joined = lettered(name)
    return re.sub(r"\W+", "_", joined, flags=re.ASCII).strip("_") or "x"


# --- one student's form: a segment that is too short is not measured ------------------------------


def is_left_out(item: Item, points: Mapping[str, Fraction], compute: Collection[str]) -> bool:
    """Whether a segment is not asked, since it is too short to measure.

    Its value is computed, and must be worth points of its own.
    """
    left = item.what == "segment" and item.field in compute
    return left and bool(points.get(item.beside("value")))


def worth(item: Item, points: Mapping[str, Fraction], compute: Collection[str]) -> Fraction | None:
    """The points of a field, with those of a segment left out; None where the rubric gives none."""
    if is_left_out(item, points, compute):
        return None
    own = points.get(item.field)
    more = points.get(item.segment) if item.segment in compute else None
    return own if more is None else (own or 0) + more


def asked_of(
    form: Iterable[Item], points: Mapping[str, Fraction], compute: Collection[str]
) -> tuple[tuple[Item, ...], dict[str, Fraction]]:
    """The fields of one student's form, and the points of those that are worth any."""
    items = tuple(item for item in form if not is_left_out(item, points, compute))
    worths = {item.field: worth(item, points, compute) for item in items}
    return items, {field: found for field, found in worths.items() if found is not None}
